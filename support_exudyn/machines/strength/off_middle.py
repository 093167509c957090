"""A roof force beside the plane of symmetry: what the linkage carries by torsion, and what the legs alone do.

Rigid bodies in space, ideal bearings, spherical ends of cylinders. A roof force Q at z = e turns the canopy
over by Q e. Two limits are told, between which a support with its elastic parts and its play lies:

- all legs push alike, each at its share of the force in the plane, as yield valves hold them: the joint of the
  canopy passes the whole moment on, and the linkage is twisted by it. Rigid parts leave open how links share
  it: told is what comes with the least moments in bearings (a pair of links carries it by forces that differ),
  and what comes with the least forces (wide links carry it by moments). Neither depends on a unit of length;
- the linkage passes no roll on, as loose pins do not: cylinders alone carry it, the ones nearer to the force
  more, until one of them yields. The largest Q is found by linear programming.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.linalg import null_space
from scipy.optimize import linprog

from support_exudyn.machines.check.statics import GRAVITY, Array
from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.strength.results import OffMiddle
from support_exudyn.machines.strength.roof_forces import Limits, RoofForce, RoofStatics
from support_exudyn.machines.strength.strength_data import StrengthData
from support_exudyn.machines.strength.used_postures import UsedPosture
from support_exudyn.mechanics.body_motion import SpatialMotion
from support_exudyn.mechanics.constraints import SAME, constraints_in_space, matrix
from support_exudyn.mechanics.kinetics import weight_of
from support_exudyn.mechanics.reactions import bearing_load
from support_exudyn.model.linkage import Linkage
from support_exudyn.model.spatial_linkage import SpatialLinkage
from support_exudyn.model.to_space import FILE_KEYS
from user_forces.values.value import InputError

UNBALANCED = 1e-7  # of the roof force: what may be left of it for rounding
ASIDE = 0.25  # of the canopy's width: how far beside the middle the roof force acts, assumed
PAIRS = ("front_link",)  # bodies of a shield support that there are two of
MOST = 2  # cylinders of an actuator that the model in space has a place for


@dataclass(frozen=True)
class Twist:
    """What bearings carry while all legs push alike, of the first body on the second.

    Arguments:
        bearings: force of each bearing, by name, (3,) [N].
        moments: moment of each bearing, by name, (3,) about x, y, z [N m].
    """

    bearings: dict[str, Array]
    moments: dict[str, Array]


class SpatialStatics:
    """Equilibrium in space of one posture.

    linkage: the machine in space, laid out there. canopy: the body that carries the roof. height: y of the roof
    on it [m].
    """

    def __init__(self, linkage: SpatialLinkage, canopy: str, height: float) -> None:
        self.linkage, self.canopy, self.height = linkage, canopy, height
        self.motion = SpatialMotion.at_start(linkage)
        self.weight = weight_of(self.motion, (*GRAVITY, 0.0))[0]

    def roof(self, x: float, z: float) -> Array:
        """What a vertical roof force of 1 N at x, z does to all coordinates (6 bodies,)."""
        i = 6 * list(self.linkage.bodies).index(self.canopy)
        arm = np.array([x, self.height, z]) - np.array(self.linkage.bodies[self.canopy].centre)
        down = np.array([0.0, -1.0, 0.0])
        found = np.zeros(self.weight.size)
        found[i : i + 3], found[i + 3 : i + 6] = down, np.cross(arm, down)
        return found

    def twist(
        self, roof: RoofForce, aside: float, pushes: Mapping[str, float], least: Literal["forces", "moments"]
    ) -> Twist:
        """What bearings carry under a roof force at z = aside [m] while cylinders push as in the plane [N].

        least: of which the sum of squares is the least where rigid bearings leave open how they share a load;
        where that leaves something open, the sum of the others is.

        Raises InputError if the cylinders do not hold the roof force.
        """
        one = self.linkage.actuators
        driven = [row for row in constraints_in_space(self.linkage, (), one) if row.kind == "actuator"]
        push = np.array([part.share * pushes[part.actuator] for part in one.values()])
        given = self.weight + roof.force * self.roof(roof.x, aside)
        given = given + matrix(self.motion, driven)[0].T @ push
        rows = constraints_in_space(self.linkage)
        c = matrix(self.motion, rows)[0].T
        found = np.linalg.lstsq(c, -given, rcond=None)[0]
        open_ways = null_space(c, rcond=SAME)  # loads that bearings put on each other
        moments = np.array([row.kind.startswith("tilt") for row in rows])
        for kept in (moments, ~moments) if least == "moments" else (~moments, moments):
            change = open_ways[kept]
            found = found - open_ways @ np.linalg.lstsq(change, found[kept], rcond=SAME)[0]
            open_ways = open_ways @ null_space(change, rcond=SAME)
        rest = float(np.abs(c @ found + given).max())
        if rest > UNBALANCED * max(roof.force, float(np.abs(self.weight).max())):
            raise InputError(
                f"machine in space: {rest:.3g} N of the roof force {roof.force:.6g} N are not balanced; "
                "allowed: pushes of its cylinders that hold it"
            )
        twist = Twist({}, {})
        for name in self.linkage.bearings:
            force, moment = bearing_load(self.motion, rows, -found[None], name)
            twist.bearings[name], twist.moments[name] = force[0], moment[0]
        return twist

    def legs_alone(self, x: float, aside: float, limits: Mapping[str, Limits]) -> float:
        """The largest roof force [N] at x, z [m] with no roll passed on by the canopy's joints; 0 if none.

        limits: of the actuators of the plane; a part of one has its share of them.
        """
        rows = [
            row
            for row in constraints_in_space(self.linkage, (), self.linkage.actuators)
            if not (row.kind == "tilt_1" and self._on_canopy(row.name))
        ]
        size = max(1.0, *(abs(bound) for limit in limits.values() for bound in limit))
        balance = np.column_stack([matrix(self.motion, rows)[0].T, self.roof(x, aside)])
        bounds: list[tuple[float | None, float | None]] = []
        for row in rows:
            if row.kind == "actuator":
                part = self.linkage.actuators[row.name]
                low, high = (part.share * bound / size for bound in limits[part.actuator])
                bounds.append((low, high))
            else:
                bounds.append((None, None))
        cost = np.zeros(balance.shape[1])
        cost[-1] = -1.0
        found = linprog(cost, A_eq=balance, b_eq=-self.weight / size, bounds=[*bounds, (0.0, None)])
        return 0.0 if found.x is None else max(float(found.x[-1]), 0.0) * size

    def _on_canopy(self, bearing: str) -> bool:
        one = self.linkage.bearings[bearing]
        return self.canopy in (one.first, one.second)


# --- over the height ---


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
    if width is None or not (width.spreads or width.pairs or width.actuators):
        return "no lateral dimensions of its bodies are known"
    several = [name for name, one in strength.cylinders.items() if one.count > 1]
    needed = {
        "spreads": [name for name in linkage.bodies if width.spreads.get(name, 0.0) <= 0.0],
        "pairs": [
            name for name in PAIRS if isinstance(data.machine, FourBarShield) and name not in width.pairs
        ],
        "actuators": [name for name in several if name not in width.actuators],
    }
    if missing := [f"{FILE_KEYS[kind]}.{name}" for kind, names in needed.items() for name in names]:
        return f"{', '.join(missing)} {'is' if len(missing) == 1 else 'are'} missing"
    wrong = []
    for name, one in strength.cylinders.items():
        where = f"strength.cylinders.{name}.count = {one.count}"
        if one.count == 1 and name in width.actuators:
            pair = f"{FILE_KEYS['actuators']}.{name}"
            wrong.append(f"{where} and {pair}, the distance of two; allowed: one of them")
        elif one.count > MOST:
            wrong.append(f"{where}; allowed: 1 in the middle or 2 at its sides")
    return "; ".join(wrong)


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
