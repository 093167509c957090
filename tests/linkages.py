"""Linkages built by hand, and chains that are grown by pairs of bars."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.mechanics.postures import laid_out
from support_exudyn.model.linkage import GROUND, Body, Linkage, PinPlace, pinned

Place = tuple[float, float]


def place(point: np.ndarray) -> Place:
    return float(point[0]), float(point[1])


def towards(degrees: float, length: float, start: Place = (0.0, 0.0)) -> Place:
    angle = math.radians(degrees)
    return start[0] + length * math.cos(angle), start[1] + length * math.sin(angle)


def bar_of(a: Place, b: Place, mass: float = 1.0) -> Body:
    """A uniform bar whose angle is that from a to b."""
    return Body(
        mass=mass,
        inertia=mass * math.dist(a, b) ** 2 / 12.0,
        centre=((a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0),
        angle=math.atan2(b[1] - a[1], b[0] - a[0]),
    )


def apex(a: Place, b: Place, long: float, other: float, side: float = 1.0) -> Place | None:
    """Where two bars from a and b meet, left of the way from a to b (side > 0) or right; None if nowhere."""
    apart = math.dist(a, b)
    along = (long**2 - other**2 + apart**2) / (2.0 * apart)
    square = long**2 - along**2
    if square < 0.0:
        return None
    x, y = (b[0] - a[0]) / apart, (b[1] - a[1]) / apart
    across = math.copysign(math.sqrt(square), side)
    return a[0] + along * x - across * y, a[1] + along * y + across * x


def four_bar(
    crank: float, coupler: float, rocker: float, ground: float, degrees: float = 60.0, side: float = 1.0
) -> Linkage:
    """A closed four-bar: crank pivot O at the origin, rocker pivot C on x; A and B at the coupler's ends."""
    o, c, a = (0.0, 0.0), (ground, 0.0), towards(degrees, crank)
    b = apex(a, c, coupler, rocker, side)
    assert b is not None
    return Linkage(
        bodies={"crank": bar_of(o, a), "coupler": bar_of(a, b), "rocker": bar_of(c, b)},
        pins={
            "O": pinned(GROUND, "crank", o),
            "A": pinned("crank", "coupler", a),
            "B": pinned("coupler", "rocker", b),
            "C": pinned(GROUND, "rocker", c),
        },
    )


def drawn_roughly(linkage: Linkage, rng: np.random.Generator, shift: float, turn: float = 0.0) -> Linkage:
    """The linkage with every body shifted [m] and turned [rad] by itself, so that its pins lie apart."""
    count = len(linkage.bodies)
    moved = rng.uniform(-1.0, 1.0, 3 * count) * np.tile([shift, shift, turn], count)
    return laid_out(kinetics_of(linkage), moved)


def chain(rng: np.random.Generator, pairs: int, size: float = 1.0) -> Linkage:
    """A closed linkage with one freedom: a crank, and pairs of bars that join two points each.

    One pair is a four-bar, two are a six-bar of Watt's or Stephenson's kind, three an eight-bar. Bars have a
    third point beside them, from which the next pair may start; no loop is near a dead centre.
    """
    o, a = (0.0, 0.0), towards(rng.uniform(0.0, 360.0), 0.3 * size)
    bodies, pins = {"crank": bar_of(o, a)}, {"O": pinned(GROUND, "crank", o)}
    free: list[tuple[str, Place]] = [("crank", a)]
    grounds = [towards(rng.uniform(0.0, 360.0), rng.uniform(0.8, 1.5) * size) for _ in range(pairs)]
    for number in range(pairs):
        while True:
            # the crank moves the first pair; later ones hang on any two bodies
            first = free[0] if number == 0 else free[rng.integers(1, len(free))]
            others = [(GROUND, grounds[number]), *(one for one in free[1:] if one[0] != first[0])]
            second = others[rng.integers(0, len(others))] if number else others[0]
            apart = math.dist(first[1], second[1])
            if apart < 0.15 * size:
                continue
            long, other = rng.uniform(0.6, 1.4, 2) * apart
            top = apex(first[1], second[1], long, other, rng.choice([-1.0, 1.0]))
            angle = 0.0 if top is None else _corner(top, first[1], second[1])
            if top is not None and math.radians(35.0) < angle < math.radians(145.0):
                break
        one, two = f"link_{2 * number}", f"link_{2 * number + 1}"
        bodies |= {one: bar_of(first[1], top), two: bar_of(second[1], top)}
        pins |= {
            f"P{3 * number}": pinned(first[0], one, first[1]),
            f"P{3 * number + 1}": pinned(second[0], two, second[1]),
            f"P{3 * number + 2}": pinned(one, two, top),
        }
        free = [end for end in free if end not in (first, second)] if number else free
        for name, (start, end) in ((one, (first[1], top)), (two, (second[1], top))):
            aside = rng.uniform(-0.6, 0.6) * math.dist(start, end)
            free.append((name, towards(math.degrees(bodies[name].angle) + 90.0, aside, bodies[name].centre)))
    return Linkage(bodies=bodies, pins=pins)


def lengthened(linkage: Linkage, pins: Mapping[str, str], by: float) -> Linkage:
    """The linkage with the point of some pins on one of their bodies shifted along that body [m]."""
    changed = dict(linkage.pins)
    for name, body in pins.items():
        pin, angle = linkage.pins[name], linkage.bodies[body].angle
        step = by * math.cos(angle), by * math.sin(angle)
        field = "first_point" if pin.first == body else "second_point"
        point: Place = getattr(pin, field)
        changed[name] = replace(pin, **{field: (point[0] + step[0], point[1] + step[1])})
    return replace(linkage, pins=changed)


def sides(linkage: Linkage, loop: Mapping[str, tuple[str, str]]) -> dict[str, float]:
    """Distances between two pins of each body of a loop [m]."""

    def at(pin: PinPlace, body: str) -> Place:
        return pin.first_point if pin.first == body else pin.second_point

    return {body: math.dist(*(at(linkage.pins[pin], body) for pin in pins)) for body, pins in loop.items()}


def _corner(top: Place, a: Place, b: Place) -> float:
    one, two = np.subtract(a, top), np.subtract(b, top)
    return float(np.arccos(one @ two / np.linalg.norm(one) / np.linalg.norm(two)))
