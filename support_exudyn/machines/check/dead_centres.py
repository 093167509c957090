"""What lies in line where a linkage is in a dead centre."""

from __future__ import annotations

import math

import numpy as np

from support_exudyn.machines.check.freedoms import Movement, movement
from support_exudyn.mechanics.closing import Conditions
from support_exudyn.mechanics.kinetics import Matrix
from support_exudyn.model.linkage import GROUND

STRAIGHT = 1e-3  # sine of an angle below which two lines are one: dead centres are found to about 1e-5 rad
LOADED = 1e-3  # of the largest force: what bears less bears none
Places = dict[tuple[str, str, str], Matrix]  # of joints of a body: field of the linkage, name, end


def in_line(conditions: Conditions, moved: Matrix, rows: Matrix) -> tuple[str, Movement]:
    """What lies in line in a dead centre, and how the linkage can move there although it is held.

    The least singular value of the conditions gives the movement, and forces that hold each other; bodies that
    bear them at two points, and actuators, lie along them.

    Arguments:
        moved: coordinates counted by arms (n,). rows: the conditions, driven parts held (m, n).

    Returns words, empty if nothing lies in line, such as "coupler in line with rocker".
    """
    left, _, right = np.linalg.svd(rows)
    size = rows.shape[1]
    loose = movement(conditions, moved, right[-1])
    forces = left[:, size - 1] if len(rows) >= size else np.zeros(len(rows))
    place = moved / conditions.arms
    loaded = {
        owner
        for owner, force in zip(conditions.kinetics.owners(), forces, strict=True)
        if abs(force) > LOADED * np.abs(forces).max(initial=0.0)
    }
    points = {
        body: {joint: at for joint, at in found.items() if joint[:2] in loaded}
        for body, found in _points(conditions, place).items()
    }
    lines: dict[str, Places] = {
        body: found
        for body, found in points.items()
        if len(found) == 2 and body in loose.bodies and np.ptp(list(found.values()), axis=0).max() > 0.0
    }
    for kind, name in loaded:
        if kind == "actuators":
            one = conditions.linkage.actuators[name]
            ends = ((one.foot, one.foot_point, "foot"), (one.head, one.head_point, "head"))
            lines[name] = {
                (kind, name, end): conditions.kinetics.point(place, body, point)[0] for body, point, end in ends
            }
    said = [
        f"{first} in line with {second}"
        for n, first in enumerate(lines)
        for second in list(lines)[n + 1 :]
        if set(lines[first]) & set(lines[second]) and _parallel(lines[first], lines[second])
    ]
    guides = {
        name: slide
        for name, slide in conditions.linkage.slides.items()
        if ("slides", name) in loaded and slide.body in loose.bodies
    }
    said += [
        f"{body} across guide {name}"
        for body, line in lines.items()
        for name, slide in guides.items()
        if set(line) & set(points[slide.body]) and _across(conditions, place, line, name)
    ]
    return " and ".join(said), loose


def _points(conditions: Conditions, place: Matrix) -> dict[str, Places]:
    """By body, where its pins, ends of actuators and guides are, each by field, name and end."""
    linkage, kinetics = conditions.linkage, conditions.kinetics
    found: dict[str, Places] = {name: {} for name in (GROUND, *linkage.bodies)}
    for name, pin in linkage.pins.items():
        for body, point in ((pin.first, pin.first_point), (pin.second, pin.second_point)):
            found[body]["pins", name, ""] = kinetics.point(place, body, point)[0]
    for name, one in linkage.actuators.items():
        found[one.foot]["actuators", name, "foot"] = kinetics.point(place, one.foot, one.foot_point)[0]
        found[one.head]["actuators", name, "head"] = kinetics.point(place, one.head, one.head_point)[0]
    for name, slide in linkage.slides.items():
        found[slide.body]["slides", name, ""] = kinetics.point(place, slide.body, slide.point)[0]
    return found


def _direction(line: Places) -> Matrix:
    first, second = line.values()
    way: Matrix = second - first
    return way / float(np.hypot(*way))


def _parallel(one: Places, other: Places) -> bool:
    (x, y), (u, v) = _direction(one), _direction(other)
    return bool(abs(x * v - y * u) < STRAIGHT)


def _across(conditions: Conditions, place: Matrix, line: Places, name: str) -> bool:
    slide = conditions.linkage.slides[name]
    carried = 0.0 if slide.against == GROUND else place[conditions.kinetics.bodies[slide.against].first + 2]
    x, y = _direction(line)
    return bool(
        abs(x * math.cos(slide.direction + carried) + y * math.sin(slide.direction + carried)) < STRAIGHT
    )
