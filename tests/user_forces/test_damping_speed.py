"""What hysteresis damping is scaled with: in a free impact, and in a contact that does not part."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from tests.cases.law_cases import NORMAL_LAWS, kind_of, law_rebound
from tests.often import often
from user_forces import (
    DampingSpeed,
    Exact,
    Hysteresis,
    Impact,
    ImpactVelocity,
    IndentationVelocity,
    InputError,
    NormalLaw,
    PowerLaw,
)

speeds = st.floats(0.02, 2.0)
masses = st.floats(0.5, 5e3)
energies = st.floats(0.0, 1e4)
exponents = st.floats(1.0, 3.0)
restitutions = st.floats(0.05, 1.0)


def law(**changes: object) -> PowerLaw:
    fields: dict[str, object] = {"stiffness": 2.7e10, "restitution": 0.9}
    return Exact(**fields | changes)


# --- IndentationVelocity ---


@given(speed=speeds, mass=masses, share=st.floats(0.0, 1.0))
def test_depth_speed_is_the_touch_speed_as_deep_as_a_free_impact_goes(
    speed: float, mass: float, share: float
) -> None:
    stored = share * 0.5 * mass * speed**2
    # rounding of a square and its root, at the deepest point
    assert IndentationVelocity()(Impact(speed, mass), stored) == pytest.approx(speed, rel=1e-15)


@given(speed=speeds, mass=masses, times=st.floats(1.0, 1e6))
def test_depth_speed_deeper_down_is_that_of_an_impact_that_turns_there(
    speed: float, mass: float, times: float
) -> None:
    stored = times * 0.5 * mass * speed**2
    w = IndentationVelocity()(Impact(speed, mass), stored)
    # rounding of a square and its root
    assert 0.5 * mass * w**2 == pytest.approx(stored, rel=1e-14)


@given(speed=st.floats(0.0, 2.0), mass=masses, stored=energies)
def test_depth_speed_is_never_zero(speed: float, mass: float, stored: float) -> None:
    assert IndentationVelocity()(Impact(speed, mass), stored) > 0.0


def test_depth_speed_is_not_zero_where_nothing_moves_and_nothing_is_stored() -> None:
    assert IndentationVelocity()(Impact(0.0, 3.0), 0.0) > 0.0


@given(v=st.floats(0.0, 2.0), dv=st.floats(0.0, 0.1), stored=energies, more=st.floats(0.0, 1.0), mass=masses)
def test_depth_speed_is_continuous(v: float, dv: float, stored: float, more: float, mass: float) -> None:
    change = IndentationVelocity()(Impact(v + dv, mass), stored + more) - IndentationVelocity()(
        Impact(v, mass), stored
    )
    swing = math.sqrt(2.0 * (stored + more) / mass) - math.sqrt(2.0 * stored / mass)
    # the larger of two numbers changes by no more than either; rounding of speeds up to 200 m/s
    assert 0.0 <= change <= max(dv, swing) + 1e-12


@given(depth=st.floats(1e-6, 1e-3), rate=st.floats(-1.0, 1.0), n=exponents, mass=masses)
def test_force_does_not_jump_where_the_depth_takes_over(
    depth: float, rate: float, n: float, mass: float
) -> None:
    normal = law(exponent=n)
    speed = math.sqrt(2.0 * normal.elastic_energy(depth) / mass)  # its free impact turns at this depth
    at = normal(depth, rate, Impact(speed, mass))
    size = normal.elastic_force(depth) * (1.0 + normal.damping_factor * abs(rate) / speed)
    # all exponents of depth and speed are below 5, so a change of 1e-9 changes the force by less than 1e-8
    assert normal(depth * (1.0 + 1e-9), rate, Impact(speed, mass)) == pytest.approx(at, abs=1e-8 * size)
    assert normal(depth * (1.0 - 1e-9), rate, Impact(speed, mass)) == pytest.approx(at, abs=1e-8 * size)
    assert normal(depth, rate, Impact(speed * (1.0 + 1e-9), mass)) == pytest.approx(at, abs=1e-8 * size)
    assert normal(depth, rate, Impact(speed * (1.0 - 1e-9), mass)) == pytest.approx(at, abs=1e-8 * size)


@settings(max_examples=often(30))
@given(e=restitutions, n=exponents, stiffness=st.floats(1e7, 1e11), mass=masses, speed=st.floats(0.01, 2.0))
def test_free_impact_is_the_same_with_either_speed(
    e: float, n: float, stiffness: float, mass: float, speed: float
) -> None:
    fields = {"stiffness": stiffness, "exponent": n, "restitution": e}
    by_depth = law_rebound(law(damping_speed=IndentationVelocity(), **fields), mass, speed)
    by_touch = law_rebound(law(damping_speed=ImpactVelocity(floor=1e-3), **fields), mass, speed)
    # the integrator's tolerance of 1e-10 a step, over some hundred steps; and both deliver what was asked
    assert by_depth == pytest.approx(by_touch, abs=3e-8)
    assert by_depth == pytest.approx(e, abs=3e-8)


@given(depth=st.floats(1e-6, 1e-3), rate=st.floats(-1.0, 1.0), n=exponents, mass=masses, e=restitutions)
def test_contact_without_a_touch_speed_is_damped_as_tsuji_has_it(
    depth: float, rate: float, n: float, mass: float, e: float
) -> None:
    normal = law(exponent=n, restitution=e)
    alpha = normal.damping_factor * math.sqrt((n + 1.0) / 2.0)
    dashpot = alpha * math.sqrt(mass * normal.stiffness) * depth ** ((n - 1.0) / 2.0)
    elastic = normal.stiffness * depth**n
    # the same in another order: rounding, of the larger part where both nearly cancel
    assert normal(depth, rate, Impact(0.0, mass)) == pytest.approx(
        elastic + dashpot * rate, abs=1e-13 * (elastic + dashpot * abs(rate))
    )


def decay(normal: NormalLaw, depth: float, mass: float) -> float:
    """Damping ratio of small vibrations about a depth at which a constant force holds the law, by scipy.

    From two following largest depths, whose distances from the middle have the ratio
    exp(2 pi zeta / sqrt(1 - zeta^2)).
    """
    load = normal.elastic_force(depth)
    amplitude = 1e-5  # of the depth: what is not linear is smaller by that factor
    slope = (normal.elastic_force(depth * 1.0001) - normal.elastic_force(depth * 0.9999)) / 2e-4  # times depth
    beat = math.sqrt(mass * depth / slope)  # a radian of it [s]

    def motion(_: float, y: np.ndarray) -> list[float]:
        force = normal(depth * (1.0 + amplitude * y[0]), depth * amplitude * y[1] / beat, Impact(0.0, mass))
        return [y[1], (load - force) * beat**2 / (mass * depth * amplitude)]

    def turning(_: float, y: np.ndarray) -> float:
        return float(y[1])

    turning.direction = -1.0  # type: ignore[attr-defined]
    found = solve_ivp(motion, (0.0, 20.0), [0.0, 1.0], "DOP853", events=turning, rtol=1e-9, atol=1e-11)
    first, second = (float(y[0]) for y in found.y_events[0][:2])
    decrement = math.log(first / second)
    return decrement / math.hypot(2.0 * math.pi, decrement)


@settings(max_examples=often(20))
@given(depth=st.floats(1e-6, 1e-3), n=exponents, mass=masses, e=st.floats(0.6, 0.95))
def test_small_vibrations_of_a_loaded_contact_decay_alike_at_any_load(
    depth: float, n: float, mass: float, e: float
) -> None:
    normal = law(exponent=n, restitution=e)
    expected = normal.damping_factor * math.sqrt((n + 1.0) / (8.0 * n))
    # swings of 1e-5 of the depth are unequal by about as much, against a logarithm of 0.2 or more
    assert decay(normal, depth, mass) == pytest.approx(expected, rel=2e-4)


def test_small_vibrations_of_a_hertzian_contact() -> None:
    # 0.46 chi, as the docstring has it: half of its last digit
    normal = law(exponent=1.5, restitution=0.9)
    assert decay(normal, 1e-4, 500.0) / normal.damping_factor == pytest.approx(0.46, abs=5e-3)


# --- ImpactVelocity ---


@given(speed=st.floats(0.0, 2.0), floor=st.floats(1e-6, 1.0), mass=masses, stored=energies)
def test_touch_speed_is_the_larger_of_touch_and_floor(
    speed: float, floor: float, mass: float, stored: float
) -> None:
    assert ImpactVelocity(floor=floor)(Impact(speed, mass), stored) == max(speed, floor)


@pytest.mark.parametrize("speed", [0.0, 1e-9, 4.9e-3])
def test_very_soft_touch_is_damped_as_at_the_floor(speed: float) -> None:
    normal = law(damping_speed=ImpactVelocity(floor=5e-3))
    assert normal(1e-4, 0.1, Impact(speed, 3.0)) == normal(1e-4, 0.1, Impact(5e-3, 3.0))


def test_floor_is_a_millimetre_a_second_unless_said_otherwise() -> None:
    assert ImpactVelocity()(Impact(0.0, 3.0), 0.0) == 1e-3


@pytest.mark.parametrize("floor", [0.0, -1e-3])
def test_floor_that_divides_by_zero_is_refused(floor: float) -> None:
    with pytest.raises(InputError, match=rf"ImpactVelocity\.floor = {floor}: .*allowed: > 0"):
        ImpactVelocity(floor=floor)


# --- what is forgotten ---


@pytest.mark.parametrize(
    ("damping_speed", "forgets"), [(IndentationVelocity(), True), (ImpactVelocity(), False)]
)
def test_law_forgets_as_its_damping_speed_does(damping_speed: DampingSpeed, forgets: bool) -> None:
    assert damping_speed.forgets is forgets
    assert law(damping_speed=damping_speed).forgets is forgets


@pytest.mark.parametrize("normal", NORMAL_LAWS, ids=kind_of)
def test_only_hysteresis_has_a_touch_to_forget(normal: NormalLaw) -> None:
    assert normal.forgets is isinstance(normal, Hysteresis)  # whose default is IndentationVelocity


def test_depth_speed_is_the_default() -> None:
    assert law().damping_speed == IndentationVelocity()
