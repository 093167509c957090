"""Linkages closed from rough drawings: against the exact ones, closed forms and the triangle inequality."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support_exudyn.mechanics.closure import assembled
from support_exudyn.model.linkage import (
    GROUND,
    Body,
    Gear,
    LinearActuator,
    Linkage,
    PinPlace,
    Slide,
    TracePoint,
    pinned,
)
from tests.drawn.drawn_linkages import apex, bar_of, chain, towards
from tests.linkages import drawn_roughly, four_bar, lengthened
from tests.often import often
from user_forces import InputError

CLOSE = 1e-11  # [m], [rad]
seeds = st.integers(0, 2**32 - 1)


def assert_same(found: Linkage, exact: Linkage) -> None:
    """Bodies and pins of two linkages lie at the same places."""
    for name, body in exact.bodies.items():
        np.testing.assert_allclose(found.bodies[name].centre, body.centre, rtol=0, atol=CLOSE)
        turned = math.remainder(found.bodies[name].angle - body.angle, 2.0 * math.pi)
        assert turned == pytest.approx(0.0, abs=CLOSE)
    for name, pin in exact.pins.items():
        np.testing.assert_allclose(found.pins[name].first_point, pin.first_point, rtol=0, atol=CLOSE)
        assert found.pins[name].first_point == found.pins[name].second_point


def said(drawing: Linkage, **asked: object) -> str:
    with pytest.raises(InputError) as raised:
        assembled(drawing, **asked)  # type: ignore[arg-type]
    return str(raised.value)


@settings(max_examples=often(20), deadline=None)
@given(seed=seeds, pairs=st.integers(1, 3))
def test_a_rough_drawing_closes_to_the_linkage_that_it_is_of(seed: int, pairs: int) -> None:
    rng = np.random.default_rng(seed)
    exact = chain(rng, pairs)
    rough = drawn_roughly(exact, rng, shift=0.01, turn=0.02)
    assert_same(assembled(rough, {"crank": exact.bodies["crank"].angle}), exact)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("degrees", [10.0, 60.0, 170.0, 185.0, -100.0])
def test_the_branch_is_that_of_the_drawing(degrees: float, side: float) -> None:
    sizes = 0.1, 0.4, 0.3, 0.35
    rough = drawn_roughly(four_bar(*sizes, 60.0, side), np.random.default_rng(3), shift=0.1, turn=0.2)
    found = assembled(rough, {"crank": math.radians(degrees)})
    assert_same(found, four_bar(*sizes, degrees, side))
    assert found.bodies["crank"].angle == math.radians(degrees)


def lengths(text: str) -> list[float]:
    """Distances of pins on their bodies [mm] in a message, sorted."""
    return sorted(float(one) for one in re.findall(r" ([\d.e+]+)[,m ]", text.partition("between pins:")[2]))


@settings(max_examples=often(12), deadline=None)
@given(seed=seeds, pairs=st.integers(1, 3), spread=st.floats(0.0, 0.6))
def test_a_chain_drawn_at_random_closes_or_is_refused_with_the_loop_that_does_not(
    seed: int, pairs: int, spread: float
) -> None:
    rng = np.random.default_rng(seed)
    drawing = chain(rng, pairs)
    for name, pin in list(drawing.pins.items()):
        drawing = lengthened(drawing, {name: pin.second}, float(rng.uniform(-spread, spread)))
    try:
        found = assembled(drawing)
    except InputError as error:
        text = str(error)
    else:
        assert_same(assembled(found), found)
        for name, body in drawing.bodies.items():  # bodies keep their shapes
            for pin in drawing.pins:
                for field in ("first", "second"):
                    one, other = drawing.pins[pin], found.pins[pin]
                    if getattr(one, field) == name:
                        long = math.dist(getattr(one, f"{field}_point"), body.centre)
                        now = math.dist(getattr(other, f"{field}_point"), found.bodies[name].centre)
                        assert now == pytest.approx(long, abs=CLOSE)
        return
    if "no way leads" in text:
        return
    sides = lengths(text)
    if len(sides) == text.count("pin "):  # a single loop
        assert sides[-1] > sum(sides[:-1])


def test_the_gap_of_a_four_bar_is_what_its_longest_side_is_too_long() -> None:
    exact = four_bar(0.1, 0.4, 0.3, 0.35)
    far = replace(exact.pins["C"], first_point=(0.95, 0.0))
    text = said(replace(exact, pins={**exact.pins, "C": far}))
    assert "pin O, pin A, pin B, pin C does not close: 150 mm stay open" in text
    assert "ground 950, crank 100, coupler 400, rocker 300 mm" in text


def test_an_angle_out_of_reach_is_told_with_its_limit() -> None:
    # the rocker is lowest where crank and coupler lie in line, (0.5, 0.3, 0.35)
    limit = 180.0 - math.degrees(math.acos((0.3**2 + 0.35**2 - 0.5**2) / (2.0 * 0.3 * 0.35)))
    text = said(four_bar(0.1, 0.4, 0.3, 0.35), angles={"rocker": math.radians(40.0)})
    assert "angle of rocker = 40 degrees: the chain of pin O, pin A, pin B, pin C does not close there" in text
    assert f"as far as {limit:.4g} degrees" in text


def test_two_angles_that_fight_are_named() -> None:
    exact = four_bar(0.1, 0.4, 0.3, 0.35, 50.0)
    fit = {name: exact.bodies[name].angle for name in ("crank", "rocker")}
    assert_same(assembled(drawn_roughly(exact, np.random.default_rng(1), 0.01), fit), exact)
    text = said(exact, angles={**fit, "rocker": math.radians(100.0)})
    assert "angle of crank = 50 degrees and angle of rocker = 100 degrees contradict each other" in text
    assert f"rocker comes to {math.degrees(fit['rocker']):.4g} degrees" in text


def test_bodies_that_hang_in_the_air_are_named() -> None:
    exact = four_bar(0.1, 0.4, 0.3, 0.35)
    one = replace(exact, bodies={**exact.bodies, "plate": bar_of((1.0, 0.0), (1.0, 1.0))})
    assert said(one).startswith("bodies.plate: hangs in the air")
    assert assembled(one, held=("plate",)) == one


def test_a_drawing_in_line_does_not_say_its_branch() -> None:
    o, a, b, c = (0.0, 0.0), (0.1, 0.0), (0.5, 0.0), (0.35, 0.0)
    flat = Linkage(
        bodies={"crank": bar_of(o, a), "coupler": bar_of(a, b), "rocker": bar_of(c, (0.65, 0.0))},
        pins={
            "O": pinned(GROUND, "crank", o),
            "A": pinned("crank", "coupler", a),
            "B": PinPlace(first="coupler", second="rocker", first_point=b, second_point=(0.65, 0.0)),
            "C": pinned(GROUND, "rocker", c),
        },
    )
    assert "does not say which posture is meant" in said(flat)


@pytest.mark.parametrize("degrees", [30.0, 180.0, -90.0])
def test_a_crank_in_its_dead_centre_moves_on(degrees: float) -> None:
    """A slider-crank drawn in line: driven by its crank it is no dead centre."""
    o, a, c = (0.0, 0.0), (0.05, 0.0), (0.17, 0.0)
    drawing = Linkage(
        bodies={
            "crank": bar_of(o, a),
            "rod": bar_of(a, c),
            "slider": Body(mass=1.0, inertia=1e-3, centre=c),
        },
        pins={
            "O": pinned(GROUND, "crank", o),
            "A": pinned("crank", "rod", a),
            "B": pinned("rod", "slider", c),
        },
        slides={"guide": Slide(body="slider", point=c)},
    )
    found = assembled(drawing, {"crank": math.radians(degrees)})
    y = 0.05 * math.sin(math.radians(degrees))
    x = 0.05 * math.cos(math.radians(degrees)) + math.sqrt(0.12**2 - y**2)
    np.testing.assert_allclose(found.slides["guide"].point, (x, 0.0), atol=CLOSE)


def test_a_guide_on_a_moving_body_is_followed() -> None:
    """A Whitworth quick return: a block on the crank slides along a lever, which points at the crank's end."""
    pivot, o = (0.0, -0.2), (0.0, 0.0)
    lever_end, pin = towards(80.0, 0.4, pivot), (0.1, 0.0)
    drawing = Linkage(
        bodies={
            "crank": bar_of(o, pin),
            "lever": bar_of(pivot, lever_end),
            "block": Body(mass=1.0, inertia=1e-3, centre=(0.03, 0.03), angle=math.radians(80.0)),
        },
        pins={
            "O": pinned(GROUND, "crank", o),
            "A": PinPlace(first="crank", second="block", first_point=pin, second_point=(0.03, 0.03)),
            "P": pinned(GROUND, "lever", pivot),
        },
        slides={"slot": Slide(body="block", point=(0.03, 0.03), direction=math.radians(80.0), against="lever")},
        points={"end": TracePoint(body="lever", point=lever_end)},
    )
    for degrees in (0.0, 30.0, 90.0, 170.0):
        found = assembled(drawing, {"crank": math.radians(degrees)}, origins={"slot": pivot})
        tip = towards(degrees, 0.1)
        lever = math.atan2(tip[1] + 0.2, tip[0])
        assert found.bodies["lever"].angle == pytest.approx(lever, abs=CLOSE)
        assert found.bodies["block"].angle == pytest.approx(lever, abs=CLOSE)
        assert found.slides["slot"].direction == pytest.approx(lever, abs=CLOSE)
        np.testing.assert_allclose(found.slides["slot"].point, tip, atol=CLOSE)
        np.testing.assert_allclose(
            found.points["end"].point, towards(math.degrees(lever), 0.4, pivot), atol=CLOSE
        )


def test_gears_hold() -> None:
    """A five-bar whose cranks turn against each other stays symmetric."""
    o, c = (-0.3, 0.0), (0.3, 0.0)
    a, b = towards(60.0, 0.2, o), towards(120.0, 0.2, c)
    drawing = Linkage(
        bodies={
            "left": bar_of(o, a),
            "right": bar_of(c, b),
            "one": bar_of(a, (0.0, 0.5)),
            "two": bar_of(b, (0.0, 0.5)),
        },
        pins={
            "O": pinned(GROUND, "left", o),
            "C": pinned(GROUND, "right", c),
            "A": pinned("left", "one", a),
            "B": pinned("right", "two", b),
            "T": pinned("one", "two", (0.0, 0.5)),
        },
        gears={"pair": Gear(first="left", second="right", ratio=-1.0)},
    )
    long = math.dist(a, (0.0, 0.5))
    for degrees in (20.0, 60.0, 100.0):
        found = assembled(drawing, {"left": math.radians(degrees)})
        assert math.degrees(found.bodies["right"].angle) == pytest.approx(180.0 - degrees, abs=1e-9)
        x, y = towards(degrees, 0.2, o)
        np.testing.assert_allclose(
            found.pins["T"].first_point, (0.0, y + math.sqrt(long**2 - x**2)), atol=CLOSE
        )


def test_a_pin_follows_its_slot() -> None:
    """An elliptic trammel: both ends of a bar in slots on the axes."""
    ends = (0.31, 0.02), (-0.01, 0.39)
    drawing = Linkage(
        bodies={"bar": bar_of(*ends)},
        slides={
            "across": Slide(body="bar", point=ends[0], turns=True),
            "up": Slide(body="bar", point=ends[1], direction=0.5 * math.pi, turns=True),
        },
    )
    found = assembled(drawing, {"bar": math.radians(150.0)}, origins={"across": (0.0, 0.0), "up": (0.0, 0.0)})
    x, y = towards(150.0, math.dist(*ends))
    np.testing.assert_allclose(found.slides["across"].point, (-x, 0.0), atol=CLOSE)
    np.testing.assert_allclose(found.slides["up"].point, (0.0, y), atol=CLOSE)


def boom() -> Linkage:
    """A boom on a cylinder, and an arm that hangs on it."""
    pivot, foot, head, tip = (0.0, 0.0), (0.5, -0.5), (1.0, 0.6), (2.0, 1.0)
    return Linkage(
        bodies={"boom": bar_of(pivot, tip)},
        pins={"P": pinned(GROUND, "boom", pivot)},
        actuators={"lift": LinearActuator(foot=GROUND, head="boom", foot_point=foot, head_point=head)},
    )


def test_an_actuator_has_the_length_that_is_asked_for() -> None:
    for length in (0.8, 1.2, 1.7):
        found = assembled(boom(), lengths={"lift": length})
        head = apex((0.0, 0.0), (0.5, -0.5), math.hypot(1.0, 0.6), length)
        assert head is not None
        np.testing.assert_allclose(found.actuators["lift"].head_point, head, atol=CLOSE)
