"""A shield support over its stroke: postures, angles, forces, and where it would lock beyond."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from support_exudyn.machines.check.statics import Statics, statics
from support_exudyn.machines.four_bar_shield import LONGEST_STEP, FourBarShield
from support_exudyn.machines.shield_layout import BODIES
from support_exudyn.model.linkage import Linkage
from support_exudyn.model.plane_geometry import direction, distance, minus, moved
from user_forces.values.value import InputError, Vector2

Shield = FourBarShield[Any]
WANDER = 0.080  # [m] that MT/T 556-1996, 4.6.4 allows the tip
STATIONS = 11  # postures that are told
SHARE = 0.3  # of the shortest column: the stroke if nobody says one
STRIDE = 0.005  # of the shortest column: step to where it locks
FINEST = 1e-6  # [m] to which that is found
IN_LINE = math.radians(3.0)  # what is left of an angle when the way has ended
STUCK = "the columns cannot move the linkage farther"
FARTHEST = 3.0  # times the shortest column: no farther is looked for it


@dataclass(frozen=True)
class Station:
    """A posture of the stroke; angles [rad] from +x, lengths [m], forces [N].

    Arguments:
        stroke: by how much the driven columns are longer than at the start.
        posture: where everything is.
        links: angles of rear link, front link, and shield beam (from C to the hinge).
        columns: angles from foot to head, by name. lengths: of columns, by name.
        transmission: angles in the pins on the shield beam between it and the links, 0 to pi; by pin.
        residual: by how much lengths of links and columns are missed [m].
        forces: what holds the weight.
        crossed: whether rear and front link cross.
    """

    stroke: float
    posture: Any
    links: dict[str, float]
    columns: dict[str, float]
    lengths: dict[str, float]
    transmission: dict[str, float]
    residual: float
    forces: Statics
    crossed: bool


@dataclass(frozen=True)
class Limit:
    """The end of the way of a support, up or down.

    Arguments:
        height: of the hinge [m]. margin: how far that is from the used range [m]. stroke: the extension
            there [m]. why: in words.
    """

    height: float
    margin: float
    stroke: float
    why: str


def usual_stroke(machine: Shield) -> float:
    """The stroke that is looked at if nobody says one [m]."""
    return SHARE * min(machine.column_lengths(machine.start()))


def stations(machine: Shield, stroke: float, count: int = STATIONS) -> list[Station]:
    """Postures evenly over the stroke [m], from the start on.

    Raises InputError if the columns cannot go so far.
    """
    machine.check_extension(min(0.0, stroke), max(0.0, stroke))
    linkage, posture, found = machine.linkage(), machine.start(), []
    reached = 0.0
    for goal in np.linspace(0.0, stroke, count):
        posture = _walk(machine, posture, reached, float(goal))
        reached = float(goal)
        found.append(_station(machine, linkage, reached, posture))
    return found


def _walk(machine: Shield, posture: Any, reached: float, goal: float) -> Any:
    """From a posture at one extension to that at another [m]; steps become shorter where it is tight."""
    step = 4.0 * STRIDE * _shortest(machine)
    while reached != goal:
        target = goal if abs(goal - reached) <= step else reached + math.copysign(step, goal - reached)
        following = machine.extended(target, posture)
        if following is not None and abs(following.rear_link - posture.rear_link) < LONGEST_STEP:
            reached, posture = target, following
        elif step > FINEST:
            step /= 2.0
        else:
            raise InputError(
                f"stroke = {goal} m: the columns cannot close the linkage there; allowed: up to {reached:.4f} m"
            )
    return posture


def _shortest(machine: Shield) -> float:
    return min(machine.column_lengths(machine.start()))


def _station(machine: Shield, linkage: Linkage, stroke: float, posture: Any) -> Station:
    b, a = machine.rear_base, machine.front_base
    c, d, i = posture.rear_shield, posture.front_shield, posture.hinge
    ends = {
        name: (machine.place(*strut.foot, posture), machine.place(*strut.head, posture))
        for name, strut in machine.STRUTS.items()
    }
    start = dict(zip(machine.STRUTS, machine.column_lengths(machine.start()), strict=True))
    lengths = {name: distance(*pair) for name, pair in ends.items()}
    missed = [
        distance(b, c) - distance(machine.rear_base, machine.rear_shield),
        distance(a, d) - distance(machine.front_base, machine.front_shield),
        distance(c, d) - distance(machine.rear_shield, machine.front_shield),
        distance(c, i) - distance(machine.rear_shield, machine.hinge),
        *(lengths[name] - start[name] - stroke for name in machine.alike),
    ]
    return Station(
        stroke=stroke,
        posture=posture,
        links={"rear_link": direction(b, c), "front_link": direction(a, d), "shield": direction(c, i)},
        columns={name: direction(*pair) for name, pair in ends.items()},
        lengths=lengths,
        transmission={"rear_shield": _between(c, b, d), "front_shield": _between(d, a, c)},
        residual=max(map(abs, missed)),
        forces=statics(linkage, moved_by(machine, linkage, posture)),
        crossed=_cross(b, c, a, d),
    )


def moved_by(machine: Shield, linkage: Linkage, posture: Any) -> np.ndarray:
    """Coordinates of all bodies: how far they have come from the start posture (12,) [m], [rad]."""
    start = machine.start()
    pivots: dict[str, tuple[Vector2, Vector2]] = {
        "rear_link": (machine.rear_base, machine.rear_base),
        "front_link": (machine.front_base, machine.front_base),
        "shield": (start.rear_shield, posture.rear_shield),
        "canopy": (start.hinge, posture.hinge),
    }
    found = np.zeros(3 * len(linkage.bodies))
    for n, name in enumerate(linkage.bodies):
        assert name in BODIES  # nothing is modelled further
        turned = getattr(posture, name) - getattr(start, name)
        centre = linkage.bodies[name].centre
        found[3 * n : 3 * n + 3] = *minus(moved(centre, *pivots[name], turned), centre), turned
    return found


def limit(machine: Shield, used: tuple[Station, Station], up: bool) -> Limit | None:
    """The posture in which the support locks above (below) the used range; None if that is far.

    used: the lowest and the highest posture.
    """
    begin = used[1] if up else used[0]
    shortest = _shortest(machine)
    step, sign = STRIDE * shortest, 1.0 if up else -1.0
    reached, posture = begin.stroke, begin.posture
    why = ""
    while abs(reached - begin.stroke) < FARTHEST * shortest and step > FINEST:
        following = machine.extended(reached + sign * step, posture)
        if why := _obstacle(machine, posture, following, up):
            step /= 2.0
        else:
            reached, posture = reached + sign * step, following
    if step > FINEST:
        return None
    height = posture.hinge[1]
    return Limit(height, abs(height - begin.posture.hinge[1]), reached, why)


def _obstacle(machine: Shield, posture: Any, following: Any, up: bool) -> str:
    """Why the way does not lead from a posture to the one that follows; empty if it does."""
    if following is None or abs(following.rear_link - posture.rear_link) > LONGEST_STEP:
        angle = _between(posture.front_shield, machine.front_base, posture.rear_shield)
        if min(angle, math.pi - angle) < IN_LINE:
            return "the four-bar opens: front link and shield beam are in line"
        return STUCK
    if (following.hinge[1] > posture.hinge[1]) is not up:
        return f"the hinge is at its {'highest' if up else 'lowest'}: the links move it sideways only"
    before, after = (np.linalg.det(machine.column_rates(one)) for one in (posture, following))
    return STUCK if before * after <= 0.0 else ""


def _between(corner: Vector2, first: Vector2, second: Vector2) -> float:
    """Angle at a corner [rad], 0 to pi."""
    (x, y), (u, v) = minus(first, corner), minus(second, corner)
    return math.atan2(abs(x * v - y * u), x * u + y * v)


def _cross(a: Vector2, b: Vector2, c: Vector2, d: Vector2) -> bool:
    """Whether the way from a to b crosses that from c to d."""

    def turn(p: Vector2, q: Vector2, r: Vector2) -> float:
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

    return turn(a, b, c) * turn(a, b, d) < 0.0 and turn(c, d, a) * turn(c, d, b) < 0.0
