"""What a support must stand: its support force, its pins, legs and joints at yield, buckling, tipping."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.strength.parts import (
    KnownPin,
    buckling_loads,
    cylinder_masses,
    pin_data,
    stresses,
    tipping_of,
)
from support_exudyn.machines.strength.results import Buckling, PinLoad, StandReport, SupportForce
from support_exudyn.machines.strength.roof_forces import Limits, RoofForce, RoofStatics
from support_exudyn.machines.strength.strength_data import (
    EYE_YIELD,
    PIN_YIELD,
    CylinderStrength,
    StrengthData,
)
from support_exudyn.machines.strength.used_postures import UsedPosture, legs_of, used_postures
from user_forces.values.value import InputError

__all__ = ["FACTORS", "FRICTION", "StandReport", "stand"]

POSTURES = 21  # over the used height
FACTORS = (1.0, 1.2)  # on the yield forces; the second of EN 1804-1, 4.3.2
FRICTION = 0.2  # of the roof on the canopy, assumed
PLACES = 81  # on the canopy, for the curve of the force over it


def stand(data: MachineData) -> StandReport:
    """What a machine must stand, by its data on strength.

    Raises InputError where these are missing, or its forces cannot be told by statics in the plane.
    """
    strength = checked(data)
    told = used_postures(data, POSTURES)
    statics = {
        mu: [RoofStatics(one.linkage, strength.canopy, mu) for one in told] for mu in (0.0, -FRICTION, FRICTION)
    }
    if statics[0.0][-1].contact.height < statics[0.0][0].contact.height:
        told, statics = told[::-1], {mu: every[::-1] for mu, every in statics.items()}
    linkage = data.machine.linkage()
    legs, pins = legs_of(linkage), {name: pin_data(data, name) for name in linkage.pins}
    for every in statics.values():
        _check_held(every, limits(strength.cylinders, legs))
    buckling, unbuckled = _buckling(told, strength.cylinders)
    rated = strength.rated_force
    return StandReport(
        name=data.name,
        kind=data.kind,
        cylinders=strength.cylinders,
        legs=legs,
        forces=[
            _support_force(
                one.stroke, {mu: every[n] for mu, every in statics.items()}, strength.cylinders, legs
            )
            for n, one in enumerate(told)
        ],
        rated=rated or math.fsum(strength.cylinders[name].push for name in legs),
        rated_is_assumed=rated is None,
        pins={name: _pin_load(name, one, statics, strength.cylinders, legs) for name, one in pins.items()},
        unknown_pins=[name for name, one in pins.items() if one is None],
        buckling=buckling,
        unbuckled=unbuckled,
        tipping=None
        if strength.base is None
        else [tipping_of(one.linkage, strength.base, cylinder_masses(data, one.linkage)) for one in told],
        assumed=list(_assumed(data, strength, pins)),
        sources=list(_sources(data)),
    )


# --- sections ---


def checked(data: MachineData) -> StrengthData:
    """The strength data of a machine.

    Raises InputError unless they are there and fit to the machine.
    """
    linkage = data.machine.linkage()
    if not linkage.actuators:
        raise InputError("machine: it has no actuators that could carry a roof; allowed: legs or columns")
    if data.strength is None:
        raise InputError(
            "strength: missing; bores and yield pressures tell what the legs stand; allowed: a table "
            "[strength.cylinders.NAME] with bore_mm and yield_pressure_MPa for each of "
            f"{', '.join(linkage.actuators)}"
        )
    strength = data.strength
    _check_names("strength.cylinders", strength.cylinders, linkage.actuators)
    _check_names("strength.pins", strength.pins, linkage.pins)
    missing = [name for name in linkage.actuators if name not in strength.cylinders]
    if missing:
        raise InputError(f"strength.cylinders.{missing[0]}: missing; allowed: bore_mm and yield_pressure_MPa")
    if linkage.cranks or len(linkage.actuators) != 2:
        raise InputError(
            f"machine: {len(linkage.actuators)} actuators and {len(linkage.cranks)} cranks hold it; allowed: "
            "two actuators and no crank, which a roof force and its place determine"
        )
    if data.machine.loads:
        raise InputError(
            f"machine: {', '.join(data.machine.loads)} act on it besides weight and roof; allowed: none"
        )
    if not legs_of(linkage):
        raise InputError(
            "actuators: none has its foot on the ground; allowed: a leg or column between ground and canopy"
        )
    return strength


def _check_names(where: str, named: Mapping[str, object], known: Mapping[str, object]) -> None:
    for name in named:
        if name not in known:
            raise InputError(f"{where}.{name}: there is none; allowed: {', '.join(known) or 'none'}")


def _check_held(statics: Sequence[RoofStatics], within: Mapping[str, Limits]) -> None:
    """Raise InputError if in some posture cylinders at their yield force hold no roof force at all."""
    for one in statics:
        if not one.corners(within):
            weight = ", ".join(f"{name} {part[0]:.6g} N" for name, part in one.actuators.items())
            said = ", ".join(f"{name} {low:.6g} to {high:.6g} N" for name, (low, high) in within.items())
            raise InputError(
                f"strength.cylinders: at yield they push {said}, and hold the weight alone in no way with the "
                f"roof {one.contact.height:.4g} m high and friction {one.friction:g}; allowed: pushes that do; "
                f"without a roof the weight asks for {weight}"
            )


def pushes(
    cylinders: Mapping[str, CylinderStrength], legs: Sequence[str], factor: float = 1.0, rams: float = 0.0
) -> dict[str, float]:
    """Pushes of all actuators [N]: legs at a factor times yield, rams at a share of their push or pull."""
    found = {}
    for name, one in cylinders.items():
        ram = rams * (one.push if rams > 0.0 else one.pull)
        found[name] = factor * (one.push if name in legs else ram)
    return found


def limits(
    cylinders: Mapping[str, CylinderStrength], legs: Sequence[str], factor: float = 1.0
) -> dict[str, Limits]:
    """What all actuators can do at a factor times yield: a leg pushes only, a ram pulls too."""
    return {
        name: Limits(0.0 if name in legs else 0.0 - factor * one.pull, factor * one.push)
        for name, one in cylinders.items()
    }


def _support_force(
    stroke: float,
    statics: Mapping[float, RoofStatics],
    cylinders: Mapping[str, CylinderStrength],
    legs: Sequence[str],
) -> SupportForce:
    smooth = statics[0.0]
    at_yield, within = pushes(cylinders, legs), limits(cylinders, legs)
    setting = {
        name: (one.setting_pressure or 0.0) * one.area * (name in legs) for name, one in cylinders.items()
    }
    rams = len(legs) < len(cylinders)
    contact = smooth.contact
    known = all(cylinders[name].setting_pressure is not None for name in legs)
    return SupportForce(
        stroke=stroke,
        contact=contact,
        setting=smooth.balancing(setting) if known else None,
        yielding=smooth.balancing(at_yield),
        rubbed={mu: one.balancing(at_yield) for mu, one in statics.items() if mu != 0.0},
        pull=smooth.balancing(pushes(cylinders, legs, rams=-1.0)) if rams else None,
        push=smooth.balancing(pushes(cylinders, legs, rams=1.0)) if rams else None,
        over=[
            RoofForce(smooth.largest_at(x, within), x)
            for x in np.linspace(contact.rear, contact.front, PLACES).tolist()
        ],
        largest=max(smooth.corners(within), key=lambda roof: roof.force),
    )


def _pin_load(
    pin: str,
    known: KnownPin | None,
    statics: Mapping[float, Sequence[RoofStatics]],
    cylinders: Mapping[str, CylinderStrength],
    legs: Sequence[str],
) -> PinLoad:
    def worst(frictions: Sequence[float], factor: float) -> float:
        within = limits(cylinders, legs, factor)
        return max(
            float(np.hypot(*one.pins(corner)[pin]))
            for mu in frictions
            for one in statics[mu]
            for corner in one.corners(within)
        )

    def nominal(factor: float) -> float:
        at_yield = pushes(cylinders, legs, factor)
        held = [(one, roof) for one in statics[0.0] if (roof := one.balancing(at_yield)) is not None]
        return max((float(np.hypot(*one.pins(roof)[pin])) for one, roof in held), default=math.nan)

    smooth = {factor: worst([0.0], factor) for factor in FACTORS}
    rubbed = {factor: worst(list(statics), factor) for factor in FACTORS}
    told = None
    if known is not None:
        eyes, diameter, _ = known
        told = stresses(eyes, diameter, smooth[FACTORS[1]]), stresses(eyes, diameter, rubbed[FACTORS[1]])
    return PinLoad(
        nominal={factor: nominal(factor) for factor in FACTORS},
        worst=smooth,
        rubbed=rubbed,
        stresses=told,
        yields=known and known[0].yields,
        assumed=known is not None and known[2],
    )


def _buckling(
    told: Sequence[UsedPosture], cylinders: Mapping[str, CylinderStrength]
) -> tuple[dict[str, Buckling], dict[str, str]]:
    found, untold = {}, {}
    for name, one in cylinders.items():
        if not one.stages:
            untold[name] = "its stages are not known"
            continue
        length = max(posture.linkage.actuators[name].start_length for posture in told)
        try:
            euler, johnson = buckling_loads(one, length)
        except InputError as error:
            raise InputError(f"strength.cylinders.{name}.{error}") from None
        found[name] = Buckling(length, one.push / one.count, euler, johnson)
    return found, untold


def _assumed(data: MachineData, strength: StrengthData, pins: Mapping[str, KnownPin | None]) -> Iterator[str]:
    """What was assumed because nothing says it."""
    linkage = data.machine.linkage()
    yield (
        "the roof lies between rearmost and foremost joint or traced point of the canopy, as high as the "
        f"highest; rough: friction {FRICTION:g} either way"
    )
    yield "pins and cylinders without play and friction; legs only push, as rams without a rod do"
    known = {name: one for name, one in pins.items() if one is not None}
    if eyes := [name for name, (_, _, assumed) in known.items() if assumed]:
        yield f"eyes of {', '.join(eyes)}: one of half the pin's length between two of a quarter"
    steels = {
        "pins": f"35CrMo, which yields at {1e-6 * PIN_YIELD:.0f} MPa",
        "eyes": f"S355, which yields at {1e-6 * EYE_YIELD:.0f} MPa in plates of 16 to 40 mm, thicker at less",
    }
    unsaid = {
        "pins": [name for name, (pin, *_) in known.items() if pin.pin_yield_stress is None],
        "eyes": [name for name, (pin, *_) in known.items() if pin.eye_yield_stress is None],
    }
    for word, names in unsaid.items():
        if names:
            of = "" if len(names) == len(linkage.pins) else f" of {', '.join(names)}"
            yield f"{word}{of}: of {steels[word]}"
    weightless = [name for name in linkage.actuators if name not in data.actuators]
    if strength.base is not None and weightless:
        yield f"cylinders of {', '.join(weightless)}: masses not known, left out of section 6"
    if strength.rated_force is None:
        yield "rated force: pushes of all legs at their yield pressure, added up"


def _sources(data: MachineData) -> Iterator[str]:
    """Where it all comes from: the source of the section, then those of cylinders and pins, each once."""
    own = data.sources.get("strength", "")
    if own:
        yield f"strength: {' '.join(own.split())}"
    said: dict[tuple[str, str], list[str]] = {}
    for place, one in data.sourced.items():
        kind, _, inner = place.removeprefix("strength.").partition(".")
        if place.startswith("strength.") and kind in ("cylinders", "pins") and one.source not in ("", own):
            name, _, key = inner.partition(".")
            said.setdefault((key, one.source), []).append(name)
    for (key, source), names in said.items():
        yield f"{key} of {', '.join(names)}: {' '.join(source.split())}"
