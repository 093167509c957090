"""Friction laws: what holds for all of them, their values by hand, and LuGre's bristles."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from tests.cases.law_cases import LUGRE, STATELESS_FRICTION, kind_of
from tests.often import often
from user_forces import (
    Ambrosio,
    BengisuAkay,
    BrownMcPhee,
    CubicCoulomb,
    FrictionLaw,
    Frictionless,
    InputError,
    LuGre,
    Stribeck,
    Threlfall,
)

slips = st.one_of(st.floats(-1.0, 1.0), st.floats(-0.02, 0.02))  # the second: where laws bend
forces = st.floats(0.0, 1e6)
stateless = pytest.mark.parametrize("law", STATELESS_FRICTION, ids=kind_of)

# Largest coefficient, and largest slope of the coefficient [s/m], by hand from the formulas with the numbers of
# law_cases.py
LARGEST: dict[type[FrictionLaw], float] = {
    Frictionless: 0.0,
    Ambrosio: 0.25,
    CubicCoulomb: 0.25,
    Threlfall: 0.25 * (1.0 - math.exp(-3.0)),
    BengisuAkay: 0.3,
    Stribeck: 0.3,
    BrownMcPhee: 0.3,
}
STEEPEST: dict[type[FrictionLaw], float] = {
    Frictionless: 0.0,
    Ambrosio: 0.25 / (1e-2 - 1e-4),
    CubicCoulomb: 1.5 * 0.25 / 1e-2,
    Threlfall: 3.0 * 0.25 / 1e-2,
    BengisuAkay: 2.0 * 0.3 / 1e-3,
    Stribeck: 1.5 * 0.3 / 1e-3 + 0.1 * math.sqrt(2.0 / math.e) / 1e-2,  # of both factors
    BrownMcPhee: (4.0 * 0.2 + 16.0 / 9.0 * 0.1) / 1e-2,
}


# --- what holds for all of them ---


@stateless
@given(slip=slips, force=forces, times=st.floats(0.0, 10.0), change=st.floats(1e-8, 1e-2))
def test_friction_is_a_bounded_odd_continuous_share_of_the_normal_force_against_the_slip(
    law: FrictionLaw, slip: float, force: float, times: float, change: float
) -> None:
    found = law(slip, force)
    assert found * slip <= 0.0
    assert law(-slip, force) == -found
    assert law(0.0, force) == 0.0
    # rounding, and products below 1e-308
    assert law(slip, times * force) == pytest.approx(times * found, rel=1e-14, abs=1e-300)
    assert abs(found) <= LARGEST[type(law)] * force * (1.0 + 1e-15)
    difference = abs(law(slip + change, 1.0) - law(slip, 1.0))
    assert difference <= STEEPEST[type(law)] * change * (1.0 + 1e-7) + 1e-15
    # there is no state
    assert law(slip, force, 1e-3) == found
    assert law.next_deflection(1e-3, slip, 1e-3) == 1e-3
    assert law.deflection_rate(1e-3, slip) == 0.0
    assert law.swing_time(1.0, 1e5) == math.inf
    assert not law.has_state


TWO = {"static_coefficient": 0.3, "sliding_coefficient": 0.2}
ONE = {"sliding_coefficient": 0.2}


@pytest.mark.parametrize(
    ("kind", "fields", "field", "wrong", "allowed"),
    [
        *((kind, ONE, "sliding_coefficient", -0.1, ">= 0") for kind in (Ambrosio, CubicCoulomb, Threlfall)),
        *((kind, ONE, "sliding_coefficient", 50.0, "<= 5") for kind in (Ambrosio, CubicCoulomb, Threlfall)),
        *((kind, ONE, "dynamic_speed", 0.0, "> 0") for kind in (Ambrosio, CubicCoulomb, Threlfall)),
        *((BengisuAkay, TWO, field, 0.0, "> 0") for field in ("static_speed", "decay")),
        *((Stribeck, TWO, field, 0.0, "> 0") for field in ("stribeck_speed", "tolerance_speed")),
        (BrownMcPhee, TWO, "transition_speed", 0.0, "> 0"),
        *((LuGre, TWO, f, 0.0, "> 0") for f in ("sliding_coefficient", "stribeck_speed", "bristle_stiffness")),
        *((LuGre, TWO, field, -1.0, ">= 0") for field in ("bristle_damping", "viscosity")),
        (Ambrosio, ONE, "dynamic_speed", 1e-4, "> static_speed = 0.0001"),
        *((kind, TWO, "static_coefficient", 0.1, ">= sliding_coefficient = 0.2")
          for kind in (BengisuAkay, Stribeck, BrownMcPhee, LuGre)),
    ],
)  # fmt: skip
def test_a_number_out_of_range_is_refused(
    kind: type[FrictionLaw], fields: dict[str, float], field: str, wrong: float, allowed: str
) -> None:
    with pytest.raises(InputError, match=rf"{kind.__name__}(\.|: ){field} = {wrong}.*allowed: .*{allowed}"):
        kind(**fields | {field: wrong})


# --- values by hand, under 1000 N; rounding of products of numbers with few digits ---

BY_HAND: dict[FrictionLaw, dict[float, float]] = {
    # no force up to the static speed, half of it in the middle of the ramp, all of it from the dynamic speed on
    Ambrosio(sliding_coefficient=0.25, static_speed=1e-4, dynamic_speed=1e-2): {
        5e-5: 0.0,
        -1e-4: 0.0,
        (1e-4 + 1e-2) / 2.0: -125.0,
        1e-2: -250.0,
        -3.0: 250.0,
    },
    # 250 N times s^2 (3 - 2 s): 0.15625, 0.5, 0.84375 at a quarter, half and three quarters of 10 mm/s
    CubicCoulomb(sliding_coefficient=0.25, dynamic_speed=1e-2): {
        2.5e-3: -39.0625,
        5e-3: -125.0,
        -7.5e-3: 210.9375,
        1e-2: -250.0,
        3.0: -250.0,
    },
    # 1 - exp(-1), 1 - exp(-1.5) and 1 - exp(-3) of 250 N, which is printed as 0.95
    Threlfall(sliding_coefficient=0.25, dynamic_speed=1e-2): {
        1e-2 / 3.0: -250.0 * (1.0 - 1.0 / math.e),
        -5e-3: 194.217459962,
        1e-2: -237.553232908,
        2.0: -237.553232908,
    },
    # mu_s (1 - 1/4) in the middle of the rise, mu_s at its end, then mu_d and 100 N exp(-xi (v - v_0))
    BengisuAkay(**TWO, static_speed=1e-3, decay=100.0): {
        5e-4: -225.0,
        1e-3: -300.0,
        -1.1e-2: 200.0 + 100.0 / math.e,
        1.0: -200.0,
    },
    # half of the STEP times nearly mu_s; at v_S the Gaussian is 1/e; far beyond there is mu_d
    Stribeck(**TWO, stribeck_speed=1e-2, tolerance_speed=1e-3): {
        5e-4: -0.5 * (200.0 + 100.0 * math.exp(-0.0025)),
        1e-3: -(200.0 + 100.0 * math.exp(-0.01)),
        -1e-2: 200.0 + 100.0 / math.e,
        1.0: -200.0,
    },
    # x/(x^2/4 + 3/4)^2 is 1 at x = 1, 2/(7/4)^2 = 32/49 at x = 2 and (1/2)/(13/16)^2 at x = 1/2
    BrownMcPhee(**TWO, transition_speed=1e-2): {
        5e-3: -(200.0 * math.tanh(2.0) + 100.0 * 0.5 / 0.8125**2),
        -1e-2: 200.0 * math.tanh(4.0) + 100.0,
        2e-2: -(200.0 * math.tanh(8.0) + 100.0 * 32.0 / 49.0),
        1.0: -200.0 - 100.0 * 100.0 / 2500.75**2,
    },
}


@pytest.mark.parametrize("law", BY_HAND, ids=kind_of)
def test_values_by_hand(law: FrictionLaw) -> None:
    for slip, force in BY_HAND[law].items():
        assert law(slip, 1000.0) == pytest.approx(force, rel=1e-11)


# --- LuGre ---


def size(slip: float) -> float:
    """g of LUGRE: mu_d + (mu_s - mu_d) exp(-(slip/v_S)^2)."""
    return 0.2 + 0.1 * math.exp(-((slip / 1e-2) ** 2))


@given(slip=slips, force=forces)
def test_steady_slip_is_the_stribeck_curve_and_a_viscous_part(slip: float, force: float) -> None:
    direction = math.copysign(1.0, slip) if slip else 0.0
    z = direction * LUGRE.largest_deflection(slip)
    assert LUGRE.largest_deflection(slip) == pytest.approx(size(slip) / 1e5, rel=1e-14)  # rounding
    expected = -force * (size(slip) * direction + 0.01 * slip)
    # s1 abs(slip) up to 10 cancels in it, while g is 0.2 or more: rounding, some hundred times
    assert LUGRE(slip, force, z) == pytest.approx(expected, rel=1e-13, abs=1e-14 * force)
    if abs(slip) > 1e-3:
        assert LUGRE.steady_deflection(slip) == pytest.approx(z, rel=1e-12)


@given(slip=st.just(0.0) | slips, force=forces, z=st.floats(-3e-6, 3e-6))
def test_force_is_bristles_their_rate_and_viscosity(slip: float, force: float, z: float) -> None:
    rate = slip - 1e5 * abs(slip) * z / size(slip)
    expected = -force * (1e5 * z + 10.0 * rate + 0.01 * slip)
    # rounding of parts that may nearly cancel
    scale = force * (1e5 * abs(z) + 10.0 * (abs(slip) + abs(rate)))
    assert LUGRE(slip, force, z) == pytest.approx(expected, abs=1e-14 * scale)
    # (and the smallest numbers there are have no digits)
    assert LUGRE.deflection_rate(z, slip) == pytest.approx(rate, abs=1e-14 * (abs(slip) + abs(rate)) + 1e-300)
    assert slip != 0.0 or LUGRE.next_deflection(z, slip, 0.01) == z  # what sticks is a spring


@settings(max_examples=often(30))
@given(
    slip=slips.filter(lambda slip: slip == 0.0 or abs(slip) > 1e-100),
    z=st.floats(-3e-6, 3e-6),
    lengths=st.just(0.0) | st.floats(1e-9, 20.0),
    stribeck=st.floats(1e-3, 1e-1),
)
def test_next_deflection_is_exact_for_constant_slip(
    slip: float, z: float, lengths: float, stribeck: float
) -> None:
    law = LuGre(**TWO, stribeck_speed=stribeck)
    step = lengths * 3e-6 / max(abs(slip), 1e-6)  # in the time in which the bristles are bent

    def motion(_: float, y: np.ndarray) -> list[float]:
        g = 0.2 + 0.1 * math.exp(-((slip / stribeck) ** 2))
        return [step / 3e-6 * (slip - 1e5 * abs(slip) * 3e-6 * y[0] / g)]

    found = solve_ivp(motion, (0.0, 1.0), [z / 3e-6], "DOP853", rtol=1e-11, atol=1e-12)
    # the integrator's tolerance, relative to the largest deflection
    assert law.next_deflection(z, slip, step) == pytest.approx(3e-6 * found.y[0, -1], abs=1e-10 * 3e-6)
    half = law.next_deflection(law.next_deflection(z, slip, 0.5 * step), slip, 0.5 * step)
    assert law.next_deflection(z, slip, step) == pytest.approx(half, abs=1e-14 * 3e-6)  # rounding


@given(
    moves=st.lists(st.tuples(slips, st.floats(0.0, 1e-2)), min_size=1, max_size=30),
    share=st.just(0.0) | st.floats(1e-9, 0.999),
)
def test_bristles_are_bounded_and_passive_if_damped_little_enough(
    moves: list[tuple[float, float]], share: float
) -> None:
    z = 0.0
    for slip, step in moves:
        z = LUGRE.next_deflection(z, slip, step)
        assert abs(z) <= 0.3 / 1e5 * (1.0 + 1e-15)  # mu_s / s0
    # the docstring: passive if s1 abs(slip) < 4 g; the work done is at least the gain of energy s0 z^2/2
    slip = moves[-1][0]
    law = LuGre(**TWO, bristle_damping=share * 4.0 * size(slip) / max(abs(slip), 1e-3))
    work, gain = -law(slip, 1.0, z) * slip, 1e5 * z * law.deflection_rate(z, slip)
    assert work - gain >= -1e-13 * (abs(work) + abs(gain))  # rounding of the parts


@given(mass=st.floats(1e-3, 1e5), force=st.floats(1e-3, 1e7), stiffness=st.floats(1e2, 1e8))
def test_what_sticks_swings_on_the_bristles_spring_or_is_stopped_sooner(
    mass: float, force: float, stiffness: float
) -> None:
    def law(damping: float) -> LuGre:
        return LuGre(**TWO, bristle_stiffness=stiffness, bristle_damping=damping)

    # the spring by the law's own force, which without slip is linear in the deflection
    swing = math.sqrt(mass / (-law(0.0)(0.0, force, 1e-6) / 1e-6))
    critical = 2.0 * math.sqrt(mass * stiffness / force)  # s1 of critical damping
    for share, times in ((0.0, 1.0), (1.9, 1.0), (2.1, 2.0 / 2.1), (20.0, 0.1)):
        assert law(share * critical).swing_time(mass, force) == pytest.approx(times * swing, rel=1e-9)
    assert law(1.0).swing_time(mass, 0.0) == math.inf
    assert law(1.0).slip_speed(0.5) == 0.0


@pytest.mark.parametrize(
    ("slip", "steps", "order"),
    [
        (lambda t: 0.01 + 0.008 * math.sin(5e3 * t), 400, 4.0),  # always forward: 4 is of second order
        (lambda t: 0.02 * math.sin(5e3 * t + 0.4), 3200, None),  # where in a step it reverses hangs on the step
    ],
)
def test_next_deflection_is_of_second_order_for_a_varying_slip(
    slip: Callable[[float], float], steps: int, order: float | None
) -> None:
    def motion(t: float, y: np.ndarray) -> list[float]:
        v = slip(t)
        return [1e6 * (v - 1e5 * abs(v) * 1e-6 * y[0] / size(v))]

    def stepped(count: int) -> float:
        z, h = 0.0, 1e-3 / count
        for i in range(count):
            z = LUGRE.next_deflection(z, 0.5 * (slip(i * h) + slip((i + 1) * h)), h)
        return z

    exact: Any = solve_ivp(motion, (0.0, 1e-3), [0.0], "DOP853", rtol=1e-11, atol=1e-12, max_step=1e-5)
    end = 1e-6 * float(exact.y[0, -1])
    coarse, fine = (abs(stepped(count) - end) for count in ((200 if order is None else steps // 2), steps))
    if order is None:
        assert coarse / fine > 50.0  # 256 for second order
        assert fine < 1e-6 * 3e-6
    else:
        assert coarse / fine == pytest.approx(order, rel=0.01)
