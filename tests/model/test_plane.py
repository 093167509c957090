from __future__ import annotations

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from support_exudyn.model.plane_geometry import (
    circle_intersection,
    direction,
    distance,
    minus,
    moved,
    rotated,
    side,
)

coordinates = st.floats(-10.0, 10.0)
points = st.tuples(coordinates, coordinates)
angles = st.floats(-math.pi, math.pi)
radii = st.floats(0.1, 10.0)


def test_quarter_turn_is_counter_clockwise() -> None:
    # cos(pi/2) is 6e-17
    assert rotated((2.0, 3.0), math.pi / 2) == pytest.approx((-3.0, 2.0), abs=1e-15)


@pytest.mark.parametrize(
    ("b", "angle"),
    [((2.0, 1.0), 0.0), ((1.0, 2.0), math.pi / 2), ((0.0, 1.0), math.pi), ((1.0, 0.0), -math.pi / 2)],
)
def test_direction_is_measured_from_x_counter_clockwise(b: tuple[float, float], angle: float) -> None:
    assert direction((1.0, 1.0), b) == angle


@given(a=points, b=points, origin=points, to=points, angle=angles)
def test_moving_keeps_a_body_rigid(
    a: tuple[float, float],
    b: tuple[float, float],
    origin: tuple[float, float],
    to: tuple[float, float],
    angle: float,
) -> None:
    one, two = moved(a, origin, to, angle), moved(b, origin, to, angle)
    # rounding of coordinates up to 40
    assert minus(two, one) == pytest.approx(rotated(minus(b, a), angle), abs=2e-14)


@given(a=points, ra=radii, b=points, rb=radii, which=st.sampled_from([1.0, -1.0]))
def test_intersection_lies_on_both_circles_and_on_the_side_asked_for(
    a: tuple[float, float], ra: float, b: tuple[float, float], rb: float, which: float
) -> None:
    d = distance(a, b)
    assume(d > 0.1)
    found = circle_intersection(a, ra, b, rb, which)
    reach = 1e-9 * (ra + rb)
    if abs(ra - rb) + reach < d < ra + rb - reach:
        assert found is not None
        # radii up to 10 enter squared over distances from 0.1: rounding of 1e-16 * 100 / 0.1
        assert distance(a, found) == pytest.approx(ra, abs=1e-12)
        assert distance(b, found) == pytest.approx(rb, abs=1e-12)
        assert side(a, b, found) == which
    elif d > ra + rb + reach or d < abs(ra - rb) - reach:
        assert found is None


def test_touching_circles_meet_in_one_point() -> None:
    assert circle_intersection((0.0, 0.0), 1.0, (3.0, 0.0), 2.0, 1.0) == (1.0, 0.0)
