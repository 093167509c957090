"""Whether a support that stands free tips: the angle by which its floor can be inclined to each side.

It tips about an edge of its base when the common centre of mass stands above that edge:

    angle = atan(horizontal distance of the edge / height above the floor)
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.machines.shield_layout import RODS
from support_exudyn.machines.strength.strength_data import BaseFrame
from support_exudyn.model.linkage import Linkage
from user_forces.values.value import InputError, Vector2

Mass = tuple[float, Vector2]  # [kg], and its centre [m]


@dataclass(frozen=True)
class Tipping:
    """How far a support can be inclined.

    Arguments:
        mass: of all with the base [kg].
        centre: of that mass, x and y [m].
        angles: "forward", "rearward" and "sideways" [rad]; negative: it tips on level ground. Left and right
            are alike: a machine of the plane is symmetric.
    """

    mass: float
    centre: Vector2
    angles: dict[str, float]


def cylinder_masses(data: MachineData, linkage: Linkage) -> list[Mass]:
    """Cylinders in a posture of the linkage, with those rods that no body of it contains, as far as known."""
    parts = data.machine.parts if isinstance(data.machine, FourBarShield) else {}
    told = {part.name for some in parts.values() for part in some}
    found: list[Mass] = []
    for name, one in data.actuators.items():
        place = linkage.actuators[name]
        foot, head = place.foot_point, place.head_point
        found.append((one.cylinder_mass, _between(foot, head, one.cylinder_centre)))
        if name + RODS not in told:
            found.append((one.rod_mass, _between(head, foot, one.rod_centre)))
    return found


def _between(start: Vector2, end: Vector2, far: float) -> Vector2:
    """The point so far [m] from the start towards the end."""
    share = far / math.dist(start, end)
    return start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1])


def tipping_of(linkage: Linkage, base: BaseFrame, besides: Sequence[Mass] = ()) -> Tipping:
    """Angles at which a support in this posture tips.

    besides: masses that are not among the bodies of the linkage, with their centres.

    Raises InputError if its centre of mass does not lie above the floor.
    """
    parts = [(one.mass, one.centre) for one in linkage.bodies.values()]
    parts += [*besides, (base.mass, base.centre)]
    mass = math.fsum(part for part, _ in parts)
    x, y = (math.fsum(part * centre[k] for part, centre in parts) / mass for k in (0, 1))
    height = y - base.floor
    if height <= 0.0:
        raise InputError(
            f"strength.base.floor = {base.floor:.6g} m: the common centre of mass is {y:.6g} m high; allowed: "
            "a floor below it"
        )
    ways = {"forward": base.front - x, "rearward": x - base.rear, "sideways": 0.5 * base.width}
    return Tipping(mass, (x, y), {name: math.atan2(way, height) for name, way in ways.items()})
