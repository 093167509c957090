"""A roof force beside the middle over the height, where all lateral dimensions that it needs are known."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.strength.off_middle import SpatialStatics
from support_exudyn.machines.strength.results import OffMiddle
from support_exudyn.machines.strength.roof_forces import Limits, RoofForce, RoofStatics
from support_exudyn.machines.strength.strength_data import StrengthData
from support_exudyn.machines.strength.used_postures import UsedPosture
from support_exudyn.model.linkage import Linkage
from support_exudyn.model.to_space import FILE_KEYS, Width
from user_forces.values.value import InputError

ASIDE = 0.25  # of the canopy's width: how far beside the middle a roof force is looked at, assumed
PAIRS = ("front_link",)  # bodies of a shield support that there are two of
MOST = 2  # cylinders of an actuator that the model in space has a place for


def beside_the_middle(
    data: MachineData,
    strength: StrengthData,
    told: Sequence[UsedPosture],
    pushes: Mapping[str, float],
    limits: Mapping[str, Limits],
) -> list[OffMiddle] | str:
    """A roof force beside the middle in some postures, or in words why it is not told.

    Arguments:
        pushes: of all actuators at yield [N]. limits: what they can do.
    """
    if reason := untold(data, strength):
        return reason
    width = data.machine.widths()
    assert width is not None  # or it would not be told
    aside = ASIDE * math.sqrt(12.0) * width.spreads[strength.canopy]
    try:
        found = [_in_posture(data, strength, one.linkage, pushes, limits, aside) for one in told]
    except InputError as error:
        return str(error)
    return [one for one in found if one is not None] or "no roof force balances the legs"


def untold(data: MachineData, strength: StrengthData) -> str:
    """Why a roof force beside the middle cannot be told, by keys of the machine's file; empty if it can."""
    linkage, width = data.machine.linkage(), data.machine.widths()
    if len(linkage.actuators) == 1:
        return "a single leg leaves open where along the canopy the roof force is"
    if width is None or not (width.spreads or width.pairs or width.actuators):
        return "no lateral dimensions of its bodies are known"
    missing = [*_missing(linkage, strength, width, isinstance(data.machine, FourBarShield))]
    if missing:
        return f"{', '.join(missing)} {'is' if len(missing) == 1 else 'are'} missing"
    return "; ".join(_contradictions(strength, width))


def _missing(linkage: Linkage, strength: StrengthData, width: Width, shield: bool) -> Iterator[str]:
    """Keys of the lateral dimensions that are needed and not there."""
    for name in linkage.bodies:
        if width.spreads.get(name, 0.0) <= 0.0:
            yield f"{FILE_KEYS['spreads']}.{name}"
    for name in PAIRS if shield else ():
        if name not in width.pairs:
            yield f"{FILE_KEYS['pairs']}.{name}"
    for name, one in strength.cylinders.items():
        if one.count > 1 and name not in width.actuators:
            yield f"{FILE_KEYS['actuators']}.{name}"


def _contradictions(strength: StrengthData, width: Width) -> Iterator[str]:
    for name, one in strength.cylinders.items():
        where = f"strength.cylinders.{name}.count = {one.count}"
        if one.count == 1 and name in width.actuators:
            yield f"{where} and {FILE_KEYS['actuators']}.{name}, the distance of two; allowed: one of them"
        elif one.count > MOST:
            yield f"{where}; allowed: 1 in the middle or 2 beside it"


def _in_posture(
    data: MachineData,
    strength: StrengthData,
    linkage: Linkage,
    pushes: Mapping[str, float],
    limits: Mapping[str, Limits],
    aside: float,
) -> OffMiddle | None:
    flat = RoofStatics(linkage, strength.canopy)
    roof: RoofForce | None = flat.balancing(pushes)
    if roof is None or roof.force <= 0.0:
        return None
    space = SpatialStatics(data.machine.in_space(linkage), strength.canopy, flat.contact.height)
    pushing = flat.pushes(roof)
    twisted, centred = (space.twist(roof, z, pushing, "moments") for z in (aside, 0.0))
    bent = space.twist(roof, aside, pushing, "forces")

    def largest(vectors: Mapping[str, np.ndarray]) -> dict[str, float]:
        return {
            pin: max(float(np.linalg.norm(vectors[name])) for name in space.linkage.parts_of_pin(pin))
            for pin in linkage.pins
        }

    return OffMiddle(
        height=flat.contact.height,
        aside=aside,
        nominal=roof.force,
        moment=roof.force * aside,
        pins=largest(twisted.bearings),
        centred=largest(centred.bearings),
        tilts=largest(bent.moments),
        links=[name for name, pin in linkage.pins.items() if strength.canopy not in (pin.first, pin.second)],
        legs_alone=space.legs_alone(roof.x, aside, limits),
    )
