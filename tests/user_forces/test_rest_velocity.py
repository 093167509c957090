"""The rest velocity: the damping of contacts that stay closed, its default, and files of earlier versions."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from tests.cases.law_cases import law_rebound
from tests.often import often
from user_forces import Exact, InputError, NormalLaw, PowerLaw, Value
from user_forces.normal.hysteresis import REST_VELOCITY

exponents, masses = st.floats(1.0, 3.0), st.floats(0.5, 5e3)


def law(**changes: object) -> PowerLaw:
    fields: dict[str, object] = {"stiffness": 2.7e10, "restitution": 0.9}
    return Exact(**fields | changes)


@pytest.mark.parametrize("speed", [0.0, 1e-9, 4.9e-3])
def test_a_soft_impact_is_damped_as_at_the_rest_velocity(speed: float) -> None:
    normal = law(rest_velocity=5e-3)
    assert normal(1e-4, 0.1, speed) == normal(1e-4, 0.1, 5e-3) != normal(1e-4, 0.1, 6e-3)


@settings(max_examples=often(30))
@given(
    e=st.floats(0.05, 1.0),
    n=exponents,
    stiffness=st.floats(1e7, 1e11),
    mass=masses,
    speed=st.floats(0.011, 2.0),
)
def test_an_impact_above_the_rest_velocity_delivers_its_restitution(
    e: float, n: float, stiffness: float, mass: float, speed: float
) -> None:
    # the integrator's tolerance of 1e-10 a step, over some hundred steps
    assert law_rebound(law(stiffness=stiffness, exponent=n, restitution=e), mass, speed) == pytest.approx(
        e, abs=3e-8
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
        force = normal(depth * (1.0 + amplitude * y[0]), depth * amplitude * y[1] / beat, 0.0)
        return [y[1], (load - force) * beat**2 / (mass * depth * amplitude)]

    def turning(_: float, y: np.ndarray) -> float:
        return float(y[1])

    turning.direction = -1.0  # type: ignore[attr-defined]
    found = solve_ivp(motion, (0.0, 20.0), [0.0, 1.0], "DOP853", events=turning, rtol=1e-9, atol=1e-11)
    first, second = (float(y[0]) for y in found.y_events[0][:2])
    decrement = math.log(first / second)
    return decrement / math.hypot(2.0 * math.pi, decrement)


@settings(max_examples=often(20))
@given(depth=st.floats(1e-6, 1e-3), n=exponents, mass=masses, ratio=st.floats(0.02, 0.3))
def test_small_vibrations_of_a_loaded_contact_decay_as_the_docstring_has_it(
    depth: float, n: float, mass: float, ratio: float
) -> None:
    normal = law(exponent=n)
    frequency = math.sqrt(n * normal.elastic_force(depth) / depth / mass)
    rest = normal.damping_factor * frequency * depth / (2.0 * n * ratio)
    # swings of 1e-5 of the depth are unequal by about as much, against a logarithm of 0.1 or more
    assert decay(law(exponent=n, rest_velocity=rest), depth, mass) == pytest.approx(ratio, rel=1e-3)


@pytest.mark.parametrize("rest", [0.0, -1e-3])
def test_a_rest_velocity_that_divides_by_zero_is_refused(rest: float) -> None:
    with pytest.raises(InputError, match=rf"Exact\.rest_velocity = {rest}: .*allowed: > 0"):
        law(rest_velocity=rest)


def test_laws_of_earlier_versions_are_read() -> None:
    kept = {key: item for key, item in law().to_data().items() if key != "rest_velocity"}
    old = kept | {"damping_speed": {"type": "ImpactVelocity", "floor": 2e-3}}
    assert Value.from_data(old) == law(rest_velocity=2e-3)
    with pytest.warns(UserWarning, match="IndentationVelocity is no longer there; .* of 10 mm/s"):
        assert Value.from_data(kept | {"damping_speed": {"type": "IndentationVelocity"}}) == law()
    assert law().rest_velocity == REST_VELOCITY == 0.01
    with pytest.raises(InputError, match=r"damping_speed = .*no such field any more; give rest_velocity"):
        law(damping_speed=1.0)
