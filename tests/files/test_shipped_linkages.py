"""Shipped linkages against what is published of them, by circles; and the page that shows all machines."""

from __future__ import annotations

import math

import numpy as np
import pytest

from support_exudyn import CubicStep, Scenario, machine, simulate
from support_exudyn.machines.planar_linkage import PlanarLinkage

A1, A2, A3, A4, A5, A6 = 674.0, 1360.0, 382.0, 1310.0, 1427.70, 1809.68  # mm, of Velenje's support
BASE = (510.0, 440.0)  # from the rear pivot to the front one: N, O - Q


def meeting(first: complex, radius: float, second: complex, other: float, side: int) -> complex:
    """Where two circles meet; side: 1 on the left of the way from the first centre to the second."""
    way = second - first
    along = (radius**2 - other**2 + abs(way) ** 2) / (2.0 * abs(way))
    return first + way / abs(way) * complex(along, side * math.sqrt(radius**2 - along**2))


def test_the_hinge_of_velenje_goes_where_its_published_lengths_say() -> None:
    shield = machine("velenje_shield")
    pins = shield.linkage().pins
    front, rear = (1e3 * complex(*pins[name].first_point) for name in "AB")
    assert abs(front - rear) == pytest.approx(A1, abs=1e-3)
    assert front - rear == pytest.approx(A1 * complex(*BASE) / math.hypot(*BASE), abs=1e-2)
    result = simulate(
        Scenario(machine=shield, drive=CubicStep(stroke=0.6, start=0.0, end=1.0), duration=1.0, step=1e-3)
    )
    places = []
    for turn in result["front_link.angle"].tolist():
        # the front link's angle says where E is, circles the rest
        e = front + A2 * complex(math.cos(turn), math.sin(turn))
        d = meeting(rear, A4, e, A3, 1)
        places.append(meeting(e, A5, d, A6, -1))
    found = 1e3 * (result["hinge.x"] + 1j * result["hinge.y"])
    # the lengths are published to 0.01 mm, which a triangle as flat as theirs makes a fifth of a millimetre of
    assert np.abs(found - np.array(places)).max() < 0.3
    assert np.ptp(found.real) < 13.0  # it rises nearly straight up,
    assert np.ptp(found.imag) > 700.0  # over the height that the source looks at
    assert 1.325 < result["leg.length"].min() < result["leg.length"].max() < 2.25


def test_the_press_is_slowest_where_it_presses() -> None:
    found = machine("toggle_press")
    assert isinstance(found, PlanarLinkage)
    pins = found.linkage().pins
    assert math.dist(pins["T"].first_point, pins["K"].first_point) == pytest.approx(0.4, abs=1e-12)
    assert math.dist(pins["R"].first_point, pins["knee"].first_point) == pytest.approx(0.45, abs=1e-12)
