"""Whether a support that stands free tips: the angle by which its floor can be inclined to each side.

It tips about an edge of its base when the common centre of mass stands above that edge:

    angle = atan(horizontal distance of the edge / height above the floor)
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from support_exudyn.machines.strength.strength_data import BaseFrame
from support_exudyn.model.linkage import Linkage
from user_forces.values.value import InputError, Vector2


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


def tipping_of(linkage: Linkage, base: BaseFrame) -> Tipping:
    """Angles at which a support in this posture tips.

    Raises InputError if its centre of mass does not lie above the floor.
    """
    parts = [(one.mass, one.centre) for one in linkage.bodies.values()] + [(base.mass, base.centre)]
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
