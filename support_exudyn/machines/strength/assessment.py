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
from support_exudyn.machines.strength.roof_forces import (
    Limits,
    RoofForce,
    RoofStatics,
    UsedPosture,
    legs_of,
    used_postures,
)
from support_exudyn.machines.strength.strength_data import (
    EYE_YIELD,
    PIN_YIELD,
    CylinderStrength,
    StrengthData,
)
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
    strength = _checked(data)
    cylinders, linkage = strength.cylinders, data.machine.linkage()
    postures = used_postures(data, POSTURES)
    statics = {
        mu: [RoofStatics(one.linkage, strength.canopy, mu) for one in postures]
        for mu in (0.0, -FRICTION, FRICTION)
    }
    if statics[0.0][-1].contact.height < statics[0.0][0].contact.height:
        postures, statics = postures[::-1], {mu: every[::-1] for mu, every in statics.items()}
    legs, pins = legs_of(linkage), {name: pin_data(data, name) for name in linkage.pins}
    within = {factor: _limits(cylinders, legs, factor) for factor in FACTORS}
    _check_held([one for every in statics.values() for one in every], within[1.0])
    forces = [
        _support_force(one.stroke, {mu: every[n] for mu, every in statics.items()}, cylinders, legs)
        for n, one in enumerate(postures)
    ]
    # by factor on the yield forces and by friction, the largest force in each pin under any roof force
    worst = {
        factor: {
            mu: _largest([(one, roof) for one in every for roof in one.corners(limits)])
            for mu, every in statics.items()
        }
        for factor, limits in within.items()
    }
    nominal = {
        factor: _largest([(one, one.balancing(_pushes(cylinders, legs, factor))) for one in statics[0.0]])
        for factor in FACTORS
    }
    loads = {}
    for name, known in pins.items():
        smooth = {factor: every[0.0][name] for factor, every in worst.items()}
        rubbed = {factor: max(one[name] for one in every.values()) for factor, every in worst.items()}
        judged = [stresses(known[0], known[1], one[FACTORS[1]]) for one in (smooth, rubbed) if known]
        loads[name] = PinLoad(
            nominal={factor: every.get(name, math.nan) for factor, every in nominal.items()},
            worst=smooth,
            rubbed=rubbed,
            stresses=(judged[0], judged[1]) if judged else None,
            yields=known and known[0].yields,
            assumed=known is not None and known[2],
        )
    masses = [cylinder_masses(data, one.linkage) for one in postures]
    base = strength.base
    rated = strength.rated_force
    return StandReport(
        name=data.name,
        kind=data.kind,
        cylinders=cylinders,
        legs=legs,
        forces=forces,
        rated=rated or math.fsum(cylinders[name].push for name in legs),
        rated_is_assumed=rated is None,
        pins=loads,
        unknown_pins=[name for name, one in pins.items() if one is None],
        buckling=_buckling(postures, cylinders),
        unbuckled={name: "its stages are not known" for name, one in cylinders.items() if not one.stages},
        tipping=None
        if base is None
        else [tipping_of(one.linkage, base, besides) for one, besides in zip(postures, masses, strict=True)],
        assumed=list(_assumed(data, strength, pins)),
        sources=list(_sources(data)),
    )


def _checked(data: MachineData) -> StrengthData:
    """The strength data of a machine.

    Raises InputError unless they are there and fit to the machine.
    """
    linkage, strength = data.machine.linkage(), data.strength
    if not linkage.actuators:
        raise InputError("machine: it has no actuators that could carry a roof; allowed: legs or columns")
    if strength is None:
        raise InputError(
            "strength: missing; bores and yield pressures tell what the legs stand; allowed: a table "
            "[strength.cylinders.NAME] with bore_mm and yield_pressure_MPa for each of "
            f"{', '.join(linkage.actuators)}"
        )
    parts: tuple[tuple[str, Mapping[str, object], Mapping[str, object]], ...] = (
        ("cylinders", strength.cylinders, linkage.actuators),
        ("pins", strength.pins, linkage.pins),
    )
    for where, named, known in parts:
        for name in named:
            if name not in known:
                raise InputError(
                    f"strength.{where}.{name}: there is none; allowed: {', '.join(known) or 'none'}"
                )
    for name in linkage.actuators:
        if name not in strength.cylinders:
            raise InputError(f"strength.cylinders.{name}: missing; allowed: bore_mm and yield_pressure_MPa")
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


# --- forces ---


def _pushes(
    cylinders: Mapping[str, CylinderStrength], legs: Sequence[str], factor: float = 1.0, rams: float = 0.0
) -> dict[str, float]:
    """Pushes of all actuators [N]: legs at a factor times yield, rams at a share of their push or pull."""
    found = {}
    for name, one in cylinders.items():
        ram = rams * (one.push if rams > 0.0 else one.pull)
        found[name] = factor * (one.push if name in legs else ram)
    return found


def _limits(
    cylinders: Mapping[str, CylinderStrength], legs: Sequence[str], factor: float = 1.0
) -> dict[str, Limits]:
    """What all actuators can do at a factor times yield: a leg pushes only, a ram pulls too."""
    return {
        name: Limits(0.0 if name in legs else 0.0 - factor * one.pull, factor * one.push)
        for name, one in cylinders.items()
    }


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


def _support_force(
    stroke: float,
    statics: Mapping[float, RoofStatics],
    cylinders: Mapping[str, CylinderStrength],
    legs: Sequence[str],
) -> SupportForce:
    smooth, contact = statics[0.0], statics[0.0].contact
    at_yield, within = _pushes(cylinders, legs), _limits(cylinders, legs)
    setting = {
        name: (one.setting_pressure or 0.0) * one.area * (name in legs) for name, one in cylinders.items()
    }
    rams = len(legs) < len(cylinders)
    known = all(cylinders[name].setting_pressure is not None for name in legs)
    return SupportForce(
        stroke=stroke,
        contact=contact,
        setting=smooth.balancing(setting) if known else None,
        yielding=smooth.balancing(at_yield),
        rubbed={mu: one.balancing(at_yield) for mu, one in statics.items() if mu != 0.0},
        pull=smooth.balancing(_pushes(cylinders, legs, rams=-1.0)) if rams else None,
        push=smooth.balancing(_pushes(cylinders, legs, rams=1.0)) if rams else None,
        over=[
            RoofForce(smooth.largest_at(x, within), x)
            for x in np.linspace(contact.rear, contact.front, PLACES).tolist()
        ],
        largest=max(smooth.corners(within), key=lambda roof: roof.force),
    )


def _largest(roofs: Sequence[tuple[RoofStatics, RoofForce | None]]) -> dict[str, float]:
    """The largest force in each pin [N] under roof forces in several postures; none where none balances."""
    sizes = [
        {pin: float(np.hypot(*force)) for pin, force in statics.pins(roof).items()}
        for statics, roof in roofs
        if roof is not None
    ]
    return {pin: max(one[pin] for one in sizes) for pin in (sizes[0] if sizes else ())}


def _buckling(
    postures: Sequence[UsedPosture], cylinders: Mapping[str, CylinderStrength]
) -> dict[str, Buckling]:
    """Buckling of all cylinders whose stages are known."""
    found = {}
    for name, one in cylinders.items():
        length = max(posture.linkage.actuators[name].start_length for posture in postures)
        try:
            if one.stages:
                found[name] = Buckling(length, one.push / one.count, *buckling_loads(one, length))
        except InputError as error:
            raise InputError(f"strength.cylinders.{name}.{error}") from None
    return found


# --- sentences ---


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
    steels = (
        ("pins", "pin_yield_stress", f"35CrMo, which yields at {1e-6 * PIN_YIELD:.0f} MPa"),
        (
            "eyes",
            "eye_yield_stress",
            f"S355, which yields at {1e-6 * EYE_YIELD:.0f} MPa in plates of 16 to 40 mm, thicker at less",
        ),
    )
    for word, field, steel in steels:
        if names := [name for name, (pin, *_) in known.items() if getattr(pin, field) is None]:
            of = "" if len(names) == len(linkage.pins) else f" of {', '.join(names)}"
            yield f"{word}{of}: of {steel}"
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
