from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from tests.analytic import contact_time, delivered_restitution, greatest_depth, reduced_mass
from tests.often import often
from user_forces import (
    InputError,
    LankaraniNikravesh,
)

stiffnesses = st.floats(1e7, 1e11)
exponents = st.floats(1.0, 3.0)
masses = st.floats(0.5, 50.0)
speeds = st.floats(0.02, 2.0)
depths = st.floats(1e-6, 1e-3)


rest_velocities = st.sampled_from([1e-2, 1e-3])


def law(**changes: object) -> LankaraniNikravesh:
    fields: dict[str, object] = {"stiffness": 2.7e10, "restitution": 0.9} | changes
    return LankaraniNikravesh(**fields)


def impact(normal: LankaraniNikravesh, one: float, two: float, speed: float) -> tuple[float, float, float]:
    """Free impact of two masses: restitution, duration [s] and greatest depth [m], by scipy.

    Depth and time are measured by those of the elastic impact, so that tolerances mean something.
    """
    depth_scale = greatest_depth(normal.stiffness, normal.exponent, reduced_mass(one, two), speed)
    time_scale = depth_scale / speed
    impact = speed

    def motion(_: float, y: np.ndarray) -> list[float]:
        depth, rate = (y[0] - y[2]) * depth_scale, (y[1] - y[3]) * speed
        # odd beyond the separation, so that a step across it meets no kink
        force = math.copysign(normal(abs(depth), rate, impact), depth)
        kick = force * time_scale / speed
        return [y[1], -kick / one, y[3], kick / two]

    def separation(_: float, y: np.ndarray) -> float:
        return y[0] - y[2]

    separation.terminal, separation.direction = True, -1.0  # type: ignore[attr-defined]
    found = solve_ivp(
        motion,
        (0.0, 100.0),
        [0.0, 1.0, 0.0, 0.0],
        "DOP853",
        events=separation,
        rtol=1e-10,
        atol=1e-12,
        max_step=0.2,
    )
    end = found.y_events[0][0]
    deepest = (found.y[0] - found.y[2]).max() * depth_scale
    return float(end[3] - end[1]), float(found.t_events[0][0]) * time_scale, float(deepest)


@settings(max_examples=often(40))
@given(
    restitution=st.floats(0.0, 0.99),
    n=exponents,
    stiffness=stiffnesses,
    one=masses,
    two=masses,
    speed=speeds,
    rest_velocity=rest_velocities,
)
def test_free_impact_delivers_what_the_closed_form_says(
    restitution: float,
    n: float,
    stiffness: float,
    one: float,
    two: float,
    speed: float,
    rest_velocity: float,
) -> None:
    normal = law(stiffness=stiffness, restitution=restitution, exponent=n, rest_velocity=rest_velocity)
    delivered, _, _ = impact(normal, one, two, speed)
    # the integrator's tolerance is 1e-10 a step; chi of the law as published
    closed_form = delivered_restitution(0.75 * (1.0 - restitution**2))
    assert delivered == pytest.approx(closed_form, abs=1e-6)


# published for this law (and in its docstring), to three digits
@pytest.mark.parametrize(
    ("asked", "delivered"), [(0.9, 0.913), (0.7, 0.796), (0.5, 0.725), (0.3, 0.684), (0.1, 0.665)]
)
def test_delivered_restitution_is_the_published_one(asked: float, delivered: float) -> None:
    got, _, _ = impact(law(restitution=asked), 3.0, 2.0, 0.3)
    # half of the last printed digit
    assert got == pytest.approx(delivered, abs=5e-4)


def test_restitution_of_one_gives_all_speed_back() -> None:
    got, _, _ = impact(law(restitution=1.0), 3.0, 2.0, 0.3)
    # the integrator's tolerance
    assert got == pytest.approx(1.0, abs=1e-8)


@pytest.mark.parametrize("n", [1.0, 1.5, 2.5])
def test_elastic_impact_lasts_as_long_as_the_closed_form_says(n: float) -> None:
    normal = law(restitution=1.0, exponent=n)
    _, duration, _ = impact(normal, 3.0, 2.0, 0.3)
    depth = greatest_depth(normal.stiffness, n, 1.2, 0.3)  # reduced mass of 3 and 2 kg
    # the integrator's tolerance
    assert duration == pytest.approx(contact_time(depth, n, 0.3), rel=1e-7)


def test_linear_elastic_impact_is_half_a_swing() -> None:
    _, duration, deepest = impact(law(stiffness=1e6, restitution=1.0, exponent=1.0), 3.0, 2.0, 0.3)
    frequency = np.sqrt(1e6 / 1.2)
    # the integrator's tolerance
    assert duration == pytest.approx(np.pi / frequency, rel=1e-8)
    # the greatest of the steps taken, 1/60 of the impact apart, is that close to the top
    assert deepest == pytest.approx(0.3 / frequency, rel=1e-2)


def test_damping_grows_as_restitution_falls() -> None:
    # 3 (1 - 0.8^2) / 4 by hand; rounding
    assert law(restitution=0.8).damping_factor == pytest.approx(0.27, rel=1e-14)


@given(depth=depths, speed=speeds, rest_velocity=rest_velocities)
def test_force_at_rest_is_the_elastic_one(depth: float, speed: float, rest_velocity: float) -> None:
    normal = law(rest_velocity=rest_velocity)
    assert normal(depth, 0.0, (speed)) == normal.elastic_force(depth)


@given(depth=depths, rate=st.floats(1e-3, 1.0), speed=speeds, rest_velocity=rest_velocities)
def test_closing_contact_pushes_harder_than_an_opening_one(
    depth: float, rate: float, speed: float, rest_velocity: float
) -> None:
    normal, impact = law(rest_velocity=rest_velocity), (speed)
    assert normal(depth, rate, impact) > normal.elastic_force(depth) > normal(depth, -rate, impact)


@given(
    depth=depths,
    rate=st.floats(-1.0, 1.0),
    speed=speeds,
    restitution=st.floats(0.0, 1.0),
    rest_velocity=rest_velocities,
)
def test_damping_never_gives_energy(
    depth: float, rate: float, speed: float, restitution: float, rest_velocity: float
) -> None:
    normal = law(restitution=restitution, rest_velocity=rest_velocity)
    assert (normal(depth, rate, (speed)) - normal.elastic_force(depth)) * rate >= 0.0


def test_damping_is_inverse_to_the_approach_speed() -> None:
    normal = law(restitution=0.5, rest_velocity=1e-3)
    elastic = normal.elastic_force(1e-4)
    slow, fast = normal(1e-4, 0.1, (0.2)) - elastic, normal(1e-4, 0.1, (0.4)) - elastic
    # rounding of the difference
    assert slow == pytest.approx(2.0 * fast, rel=1e-12)


@pytest.mark.parametrize("speed", [0.0, 1e-9, 4.9e-3])
def test_very_soft_closing_is_damped_as_at_the_floor(speed: float) -> None:
    normal = law(rest_velocity=5e-3)
    assert normal(1e-4, 0.1, (speed)) == normal(1e-4, 0.1, (5e-3))


def test_floor_does_not_touch_faster_approach() -> None:
    high, low = law(rest_velocity=5e-3), law(rest_velocity=1e-6)
    # rounding
    assert high(1e-4, 0.1, (0.2)) == pytest.approx(low(1e-4, 0.1, (0.2)), rel=1e-15)


def test_a_contact_torn_open_is_under_tension() -> None:
    normal, impact = law(restitution=0.5, rest_velocity=1e-3), (0.1)
    # chi = 9/16, so the factor 1 + chi rate/v0 is zero at rate = -16/9 v0
    assert normal(1e-4, -1.7 * 0.1, impact) > 0.0 > normal(1e-4, -1.8 * 0.1, impact)


def test_force_by_hand() -> None:
    normal = law(stiffness=4e10, restitution=0.6, rest_velocity=1e-3)
    # 4e10 (1e-4)^1.5 (1 + 3/4 (1 - 0.6^2) 0.05/0.2) = 4e4 * 1.12; rounding
    assert normal(1e-4, 0.05, (0.2)) == pytest.approx(44800.0, rel=1e-13)


@given(depth=depths, stiffness=stiffnesses, n=exponents)
def test_elastic_energy_is_the_work_of_the_elastic_force(depth: float, stiffness: float, n: float) -> None:
    normal = law(stiffness=stiffness, exponent=n)
    work = quad(lambda share: normal.elastic_force(share * depth) * depth, 0.0, 1.0, epsabs=0.0, epsrel=1e-9)[0]
    # ten times the tolerance of the quadrature
    assert normal.elastic_energy(depth) == pytest.approx(work, rel=1e-8)


@given(depth=depths, n=exponents)
def test_elastic_force_is_the_slope_of_the_elastic_energy(depth: float, n: float) -> None:
    normal = law(exponent=n)
    h = 1e-4 * depth
    slope = (normal.elastic_energy(depth + h) - normal.elastic_energy(depth - h)) / (2.0 * h)
    # error of the central difference: h^2/6 of the third derivative, at most (n^2 - 1) 1e-8 / 6 n, n <= 3
    assert normal.elastic_force(depth) == pytest.approx(slope, rel=2e-8)


@given(depth=depths, stiffness=stiffnesses, n=exponents)
def test_resting_depth_inverts_the_elastic_force(depth: float, stiffness: float, n: float) -> None:
    normal = law(stiffness=stiffness, exponent=n)
    # two powers: rounding
    assert normal.resting_depth(normal.elastic_force(depth)) == pytest.approx(depth, rel=1e-13)


def test_nothing_rests_at_depth_zero_but_no_force() -> None:
    assert law().resting_depth(0.0) == 0.0


def test_depth_under_the_weight_on_the_pin() -> None:
    # 51.4 kN on 2.713054e10 N/m^1.5 press it 0.153 mm deep: half of the last printed digit
    assert law(stiffness=2.713054e10).resting_depth(51400.0) == pytest.approx(0.153e-3, abs=5e-7)


@pytest.mark.parametrize(
    ("field", "wrong", "allowed"),
    [
        ("stiffness", 0.0, "> 0"),
        ("stiffness", -1.0, "> 0"),
        ("restitution", 1.1, ">= 0 and <= 1"),
        ("restitution", -0.1, ">= 0 and <= 1"),
        ("exponent", 0.9, ">= 1 and <= 3"),
        ("exponent", 3.1, ">= 1 and <= 3"),
    ],
)
def test_number_out_of_range_is_refused(field: str, wrong: float, allowed: str) -> None:
    with pytest.raises(InputError, match=rf"LankaraniNikravesh\.{field} = {wrong}: .*allowed: {allowed}"):
        law(**{field: wrong})
