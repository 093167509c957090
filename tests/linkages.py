"""Linkages built by hand."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.mechanics.postures import laid_out
from support_exudyn.model.linkage import GROUND, Linkage, pinned
from tests.drawn.drawn_linkages import Place, apex, bar_of, towards


def place(point: np.ndarray) -> Place:
    return float(point[0]), float(point[1])


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
