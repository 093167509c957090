"""The words of four-bar shield supports: bodies and pivots, a posture, a column, a body that is laid out."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from support_exudyn.model.linkage import Body, Part, turned_moments
from support_exudyn.model.plane_geometry import moved
from user_forces.values.value import Vector2

BODIES = ("rear_link", "front_link", "shield", "canopy")
TAIL = "tail_beam"  # part of the shield, and the body that it can be
TAIL_PLACES = ("tail_hinge", "tail_jack_foot", "tail_jack_head")
RODS = "_rods"  # after a column's name: parts that stand for its mass as long as it has none
PINS = ("rear_base", "front_base", "rear_shield", "front_shield", "shield_canopy")
FRAME = ("rear_base", "front_base", "rear_shield", "front_shield", "hinge", "tip")  # pivots of all of them


@dataclass(frozen=True)
class Posture:
    """Where everything is with ideal pins: turns from the reference posture [rad], and pivots [m].

    Turns are those of rear link, front link, shield beam and canopy; pivots are C, D, I and T; ends are the
    moving ends of the columns, by their pivots.
    """

    rear_link: float
    front_link: float
    shield: float
    canopy: float
    rear_shield: Vector2
    front_shield: Vector2
    hinge: Vector2
    tip: Vector2
    ends: Mapping[str, Vector2] = field(default_factory=dict)


class ShieldColumn(NamedTuple):
    """A column of a support: the bodies of its foot and its head, each with the name of the pivot on it."""

    foot: tuple[str, str]
    head: tuple[str, str]


def placed(lump: Part, turned: float, reference: Vector2, now: Vector2, angle: float) -> Body:
    """A body that has turned by so much [rad] and a point of which has gone from one place to another."""
    return Body(
        mass=lump.mass,
        inertia=lump.inertia,
        centre=moved(lump.centre, reference, now, turned),
        angle=angle,
        moments=turned_moments(lump.second_moments, turned),
    )


def turn(before: float, after: float) -> float:
    """Smallest turn [rad] from one direction to another."""
    return math.remainder(after - before, 2.0 * math.pi)
