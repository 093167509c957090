from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import Scenario, SliderCrank, Steady, ravn_slider_crank
from user_forces import InputError

angles = st.floats(-10.0, 10.0)
speeds = st.floats(-1e3, 1e3)
H = 1e-3  # of the numerical differentiation [rad]


def machine(crank_length: float = 0.05, ratio: float = 2.4, start_angle: float = 0.0) -> SliderCrank:
    """A slider-crank whose rod is so many times longer than its crank."""
    return SliderCrank(
        crank_length=crank_length,
        rod_length=crank_length * ratio,
        crank_mass=0.3,
        rod_mass=0.2,
        slider_mass=0.1,
        crank_inertia=1e-4,
        rod_inertia=2e-4,
        start_angle=start_angle,
    )


machines = st.builds(machine, crank_length=st.floats(0.01, 2.0), ratio=st.floats(1.2, 10.0), start_angle=angles)


def slope(function: Callable[[float], float], x: float) -> float:
    """Derivative by five points: its error is h^4/30 of the fifth derivative."""
    near, far = function(x + H) - function(x - H), function(x + 2 * H) - function(x - 2 * H)
    return (8.0 * near - far) / (12.0 * H)


# --- closed form ---


@given(one=machines, angle=angles)
def test_slider_is_a_rods_length_from_the_crank_pin(one: SliderCrank, angle: float) -> None:
    r, x = one.crank_length, one.slider_position(angle)
    # rounding
    assert math.hypot(x - r * math.cos(angle), r * math.sin(angle)) == pytest.approx(one.rod_length, rel=1e-14)
    # of the two places where it could be, the one ahead of the crank pin
    assert x > r * math.cos(angle)


@given(one=machines, angle=angles, speed=speeds)
def test_speed_is_the_derivative_of_the_position(one: SliderCrank, angle: float, speed: float) -> None:
    expected = slope(one.slider_position, angle) * speed
    # fifth derivatives up to 80 crank lengths, at rods of 1.2, and rounding of 10 of them over h: 3e-12 each
    scale = one.crank_length * abs(speed)
    assert one.slider_speed(angle, speed) == pytest.approx(expected, abs=1e-11 * scale + 1e-300)


@given(one=machines, angle=angles, speed=speeds)
def test_acceleration_is_the_derivative_of_the_speed(one: SliderCrank, angle: float, speed: float) -> None:
    expected = slope(lambda a: one.slider_speed(a, speed), angle) * speed
    # sixth derivatives of the position up to 600 crank lengths, at rods of 1.2: 2e-11
    scale = one.crank_length * speed**2
    assert one.slider_acceleration(angle, speed) == pytest.approx(expected, abs=4e-11 * scale + 1e-300)


def test_dead_centres_by_hand() -> None:
    ravn = ravn_slider_crank()
    # 120 mm plus and minus 50 mm; rounding
    assert ravn.slider_position(0.0) == pytest.approx(0.17, rel=1e-15)
    assert ravn.slider_position(math.pi) == pytest.approx(0.07, rel=1e-15)
    # it stands there; sin(pi) is 1e-16
    assert ravn.slider_speed(0.0, 100.0) == 0.0
    assert ravn.slider_speed(math.pi, 100.0) == pytest.approx(0.0, abs=1e-14)
    # w^2 r (1 + r/l) and w^2 r (1 - r/l); rounding
    assert ravn.slider_acceleration(0.0, 100.0) == pytest.approx(-1e4 * 0.05 * (1.0 + 5.0 / 12.0), rel=1e-14)
    assert ravn.slider_acceleration(math.pi, 100.0) == pytest.approx(1e4 * 0.05 * (1.0 - 5.0 / 12.0), rel=1e-14)


# --- the mechanism ---


@given(one=machines)
def test_pins_coincide_and_bodies_have_their_lengths(one: SliderCrank) -> None:
    linkage = one.linkage()
    place = {name: np.array(pin.first_point) for name, pin in linkage.pins.items()}
    for name, pin in linkage.pins.items():
        assert pin.second_point == pytest.approx(place[name], abs=0.0)
    main, crank_pin, slider_pin = (place[name] for name in ("main", "crank_pin", "slider_pin"))
    assert main == pytest.approx(np.zeros(2), abs=0.0)
    # rounding
    assert np.linalg.norm(crank_pin) == pytest.approx(one.crank_length, rel=1e-14)
    assert np.linalg.norm(slider_pin - crank_pin) == pytest.approx(one.rod_length, rel=1e-14)
    assert slider_pin == pytest.approx([one.slider_position(one.start_angle), 0.0], abs=0.0)
    # the engine takes it with ideal pins
    Scenario(machine=one, drive=Steady(rate=1.0), duration=1.0)


# --- bad input, and back from data ---


@pytest.mark.parametrize("ratio", [1.0, 0.5])
def test_a_rod_that_does_not_let_the_crank_round_is_refused(ratio: float) -> None:
    length = 0.05 * ratio
    with pytest.raises(InputError, match=rf"rod_length = {length} m: allowed: > crank_length = 0\.05 m"):
        machine(ratio=ratio)
