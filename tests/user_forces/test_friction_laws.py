"""Friction laws: what holds for all of them, their values by hand, and LuGre's bristles."""

from __future__ import annotations

import json
import math
import pickle
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from tests.cases.law_cases import FRICTION_LAWS, LUGRE, STATELESS_FRICTION, kind_of
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
    Value,
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
@given(slip=slips, force=forces)
def test_friction_never_drives(law: FrictionLaw, slip: float, force: float) -> None:
    assert law(slip, force) * slip <= 0.0


@stateless
@given(slip=slips, force=forces)
def test_friction_is_odd_in_the_slip(law: FrictionLaw, slip: float, force: float) -> None:
    assert law(-slip, force) == -law(slip, force)


@stateless
@given(slip=slips, force=forces, times=st.floats(0.0, 10.0))
def test_friction_is_proportional_to_the_normal_force(
    law: FrictionLaw, slip: float, force: float, times: float
) -> None:
    # rounding, and products below 1e-308
    assert law(slip, times * force) == pytest.approx(times * law(slip, force), rel=1e-14, abs=1e-300)


@stateless
@given(slip=slips, force=forces)
def test_friction_is_bounded_by_the_larger_coefficient(law: FrictionLaw, slip: float, force: float) -> None:
    # rounding
    assert abs(law(slip, force)) <= LARGEST[type(law)] * force * (1.0 + 1e-15)


@stateless
@given(force=forces)
def test_there_is_no_friction_without_slip(law: FrictionLaw, force: float) -> None:
    assert law(0.0, force) == 0.0


@stateless
@given(slip=slips, change=st.floats(-8.0, -2.0).map(lambda power: 10.0**power))
def test_friction_is_continuous(law: FrictionLaw, slip: float, change: float) -> None:
    difference = abs(law(slip + change, 1.0) - law(slip, 1.0))
    # rounding of coefficients below 1
    assert difference <= STEEPEST[type(law)] * change * (1.0 + 1e-7) + 1e-15


@stateless
@given(slip=slips, force=forces, deflection=st.floats(-1e-3, 1e-3))
def test_law_without_a_state_has_none(law: FrictionLaw, slip: float, force: float, deflection: float) -> None:
    assert not law.has_state
    assert law(slip, force, deflection) == law(slip, force)
    assert law.next_deflection(deflection, slip, 1e-3) == deflection


@pytest.mark.parametrize("law", FRICTION_LAWS, ids=kind_of)
def test_law_survives_pickle_and_plain_data(law: FrictionLaw) -> None:
    assert pickle.loads(pickle.dumps(law)) == law
    assert Value.from_data(json.loads(json.dumps(law.to_data()))) == law


@pytest.mark.parametrize("kind", [BengisuAkay, Stribeck, BrownMcPhee, LuGre], ids=kind_of)
def test_static_coefficient_below_the_sliding_one_is_refused(kind: type[FrictionLaw]) -> None:
    said = rf"{kind.__name__}: static_coefficient = 0\.1: allowed: >= sliding_coefficient = 0\.2"
    with pytest.raises(InputError, match=said):
        kind(static_coefficient=0.1, sliding_coefficient=0.2)


@pytest.mark.parametrize("kind", [BengisuAkay, Stribeck, BrownMcPhee, LuGre], ids=kind_of)
def test_both_coefficients_may_be_the_same(kind: type[FrictionLaw]) -> None:
    assert kind(static_coefficient=0.2, sliding_coefficient=0.2)(0.5, 1.0, 0.0) <= 0.0


@pytest.mark.parametrize(
    ("kind", "field", "wrong", "allowed"),
    [
        (CubicCoulomb, "sliding_coefficient", -0.1, ">= 0"),
        (CubicCoulomb, "dynamic_speed", 0.0, "> 0"),
        (Threlfall, "sliding_coefficient", -0.1, ">= 0"),
        (Threlfall, "dynamic_speed", 0.0, "> 0"),
        (BengisuAkay, "static_speed", 0.0, "> 0"),
        (BengisuAkay, "decay", 0.0, "> 0"),
        (Stribeck, "stribeck_speed", 0.0, "> 0"),
        (Stribeck, "tolerance_speed", 0.0, "> 0"),
        (BrownMcPhee, "transition_speed", 0.0, "> 0"),
        (LuGre, "sliding_coefficient", 0.0, "> 0"),
        (LuGre, "stribeck_speed", 0.0, "> 0"),
        (LuGre, "bristle_stiffness", 0.0, "> 0"),
        (LuGre, "bristle_damping", -1.0, ">= 0"),
        (LuGre, "viscosity", -1.0, ">= 0"),
    ],
)
def test_number_out_of_range_is_refused(
    kind: type[FrictionLaw], field: str, wrong: float, allowed: str
) -> None:
    fields = {"sliding_coefficient": 0.2}
    if kind not in (CubicCoulomb, Threlfall):
        fields["static_coefficient"] = 0.3
    with pytest.raises(InputError, match=rf"{kind.__name__}\.{field} = {wrong}: .*allowed: {allowed}"):
        kind(**fields | {field: wrong})


# --- values by hand, under 1000 N; rel: rounding of products of numbers with few digits ---


# 250 N times s^2 (3 - 2 s): 0.15625, 0.5, 0.84375 at a quarter, half and three quarters of 10 mm/s
@pytest.mark.parametrize(
    ("slip", "force"), [(2.5e-3, -39.0625), (5e-3, -125.0), (-7.5e-3, 210.9375), (1e-2, -250.0), (3.0, -250.0)]
)
def test_cubic_coulomb_by_hand(slip: float, force: float) -> None:
    law = CubicCoulomb(sliding_coefficient=0.25, dynamic_speed=1e-2)
    assert law(slip, 1000.0) == pytest.approx(force, rel=1e-14)


# 1 - exp(-1), 1 - exp(-1.5) and 1 - exp(-3) of 250 N, to the digits printed
@pytest.mark.parametrize(
    ("slip", "force"),
    [(1e-2 / 3.0, -158.0301397), (-5e-3, 194.2174600), (1e-2, -237.5532329), (2.0, -237.5532329)],
)
def test_threlfall_by_hand(slip: float, force: float) -> None:
    law = Threlfall(sliding_coefficient=0.25, dynamic_speed=1e-2)
    assert law(slip, 1000.0) == pytest.approx(force, abs=5.1e-8)


def test_threlfall_beyond_its_ramp_is_the_printed_share_nearly() -> None:
    # printed as 0.95, which is 0.0002 less
    assert Threlfall(sliding_coefficient=1.0)(1.0, 1.0) == pytest.approx(-0.95, abs=2.2e-4)


# mu_s (1 - 1/4) in the middle of the rise, mu_s at its end, then mu_d and 100 N exp(-xi (v - v_0))
@pytest.mark.parametrize(
    ("slip", "force"),
    [(5e-4, -225.0), (1e-3, -300.0), (-1.1e-2, 200.0 + 100.0 / math.e), (1.0, -200.0)],
)
def test_bengisu_and_akay_by_hand(slip: float, force: float) -> None:
    law = BengisuAkay(static_coefficient=0.3, sliding_coefficient=0.2, static_speed=1e-3, decay=100.0)
    assert law(slip, 1000.0) == pytest.approx(force, rel=1e-13)


# half of the STEP times nearly mu_s; at v_S the Gaussian is 1/e; far beyond there is mu_d
@pytest.mark.parametrize(
    ("slip", "force"),
    [
        (5e-4, -0.5 * (200.0 + 100.0 * math.exp(-0.0025))),
        (1e-3, -(200.0 + 100.0 * math.exp(-0.01))),
        (-1e-2, 200.0 + 100.0 / math.e),
        (1.0, -200.0),
    ],
)
def test_stribeck_by_hand(slip: float, force: float) -> None:
    law = Stribeck(static_coefficient=0.3, sliding_coefficient=0.2, stribeck_speed=1e-2, tolerance_speed=1e-3)
    assert law(slip, 1000.0) == pytest.approx(force, rel=1e-13)


# x/(x^2/4 + 3/4)^2 is 1 at x = 1, 2/(7/4)^2 = 32/49 at x = 2, 3/3^2 at x = 3 and (1/2)/(13/16)^2 at x = 1/2
@pytest.mark.parametrize(
    ("x", "share"), [(0.5, 0.5 / 0.8125**2), (1.0, 1.0), (2.0, 32.0 / 49.0), (3.0, 1.0 / 3.0), (-1.0, -1.0)]
)
def test_brown_and_mcphee_by_hand(x: float, share: float) -> None:
    law = BrownMcPhee(static_coefficient=0.3, sliding_coefficient=0.2, transition_speed=1e-2)
    expected = -(200.0 * math.tanh(4.0 * x) + 100.0 * share)
    assert law(x * 1e-2, 1000.0) == pytest.approx(expected, rel=1e-13)


def test_brown_and_mcphee_is_the_static_coefficient_at_the_transition() -> None:
    law = BrownMcPhee(static_coefficient=0.3, sliding_coefficient=0.2, transition_speed=1e-2)
    # 1 - tanh(4) = 1/1491 of mu_d is missing
    assert law(1e-2, 1.0) == pytest.approx(-0.3, abs=0.2 / 1490.0)
    # 0.29987 is the peak in notes.md: half of the last printed digit
    assert -min(law(1e-2 * x, 1.0) for x in np.linspace(0.9, 1.1, 201)) == pytest.approx(0.29987, abs=5e-6)


@given(slip=slips, force=forces)
def test_frictionless_does_nothing(slip: float, force: float) -> None:
    assert Frictionless()(slip, force) == 0.0


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


@given(force=forces, z=st.floats(-3e-6, 3e-6))
def test_sticking_is_a_spring(force: float, z: float) -> None:
    # rounding
    assert LUGRE(0.0, force, z) == pytest.approx(-force * 1e5 * z, rel=1e-14)
    assert LUGRE.next_deflection(z, 0.0, 0.01) == z
    assert LUGRE.deflection_rate(z, 0.0) == 0.0


@given(slip=slips, force=forces, z=st.floats(-3e-6, 3e-6))
def test_force_is_bristles_their_rate_and_viscosity(slip: float, force: float, z: float) -> None:
    rate = slip - 1e5 * abs(slip) * z / size(slip)
    expected = -force * (1e5 * z + 10.0 * rate + 0.01 * slip)
    # rounding of parts that may nearly cancel
    scale = force * (1e5 * abs(z) + 10.0 * (abs(slip) + abs(rate)))
    assert LUGRE(slip, force, z) == pytest.approx(expected, abs=1e-14 * scale)
    # (and the smallest numbers there are have no digits)
    assert LUGRE.deflection_rate(z, slip) == pytest.approx(rate, abs=1e-14 * (abs(slip) + abs(rate)) + 1e-300)


@settings(max_examples=often(30))
@given(slip=slips, z=st.floats(-3e-6, 3e-6), lengths=st.floats(0.0, 20.0), stribeck=st.floats(1e-3, 1e-1))
def test_next_deflection_is_exact_for_constant_slip(
    slip: float, z: float, lengths: float, stribeck: float
) -> None:
    assume(slip == 0.0 or abs(slip) > 1e-100)  # of less the integrator's own step is no number
    law = LuGre(static_coefficient=0.3, sliding_coefficient=0.2, stribeck_speed=stribeck)
    step = lengths * 3e-6 / max(abs(slip), 1e-6)  # in the time in which the bristles are bent

    def motion(_: float, y: np.ndarray) -> list[float]:
        g = 0.2 + 0.1 * math.exp(-((slip / stribeck) ** 2))
        return [step / 3e-6 * (slip - 1e5 * abs(slip) * 3e-6 * y[0] / g)]

    found = solve_ivp(motion, (0.0, 1.0), [z / 3e-6], "DOP853", rtol=1e-11, atol=1e-12)
    # the integrator's tolerance, relative to the largest deflection
    assert law.next_deflection(z, slip, step) == pytest.approx(3e-6 * found.y[0, -1], abs=1e-10 * 3e-6)


@given(slip=slips, z=st.floats(-3e-6, 3e-6), one=st.floats(0.0, 1e-3), two=st.floats(0.0, 1e-3))
def test_two_steps_of_constant_slip_are_one(slip: float, z: float, one: float, two: float) -> None:
    both = LUGRE.next_deflection(LUGRE.next_deflection(z, slip, one), slip, two)
    # rounding of deflections of 3e-6 m
    assert LUGRE.next_deflection(z, slip, one + two) == pytest.approx(both, abs=1e-14 * 3e-6)


def swinging(t: float) -> float:
    """A slip [m/s] that varies, always forward."""
    return 0.01 + 0.008 * math.sin(5e3 * t)


def reversing(t: float) -> float:
    """A slip [m/s] that swings back and forth."""
    return 0.02 * math.sin(5e3 * t + 0.4)


def stepped(slip: Callable[[float], float], steps: int) -> float:
    """Deflection [m] after 1 ms, with the mean slip of both ends of each step."""
    z, h = 0.0, 1e-3 / steps
    for i in range(steps):
        z = LUGRE.next_deflection(z, 0.5 * (slip(i * h) + slip((i + 1) * h)), h)
    return z


def integrated(slip: Callable[[float], float]) -> float:
    """The same by scipy."""

    def motion(t: float, y: np.ndarray) -> list[float]:
        v = slip(t)
        return [1e6 * (v - 1e5 * abs(v) * 1e-6 * y[0] / size(v))]

    found = solve_ivp(motion, (0.0, 1e-3), [0.0], "DOP853", rtol=1e-11, atol=1e-12, max_step=1e-5)
    return 1e-6 * float(found.y[0, -1])


def test_next_deflection_is_of_second_order_for_a_varying_slip() -> None:
    exact = integrated(swinging)
    errors = [abs(stepped(swinging, steps) - exact) for steps in (200, 400, 800)]
    # 4 for second order; the term after it is smaller by about the square of the phase of a step, 0.025
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.01)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.01)


def test_reversals_of_the_slip_cost_no_order() -> None:
    exact = integrated(reversing)
    errors = [abs(stepped(reversing, steps) - exact) for steps in (200, 3200)]
    # 256 for second order; where in a step the slip passes zero changes the error by its own size or so
    assert errors[0] / errors[1] > 50.0
    assert errors[1] < 1e-6 * 3e-6  # and it is small against the largest deflection


@given(moves=st.lists(st.tuples(slips, st.floats(0.0, 1e-2)), min_size=1, max_size=30))
def test_bristles_never_bend_further_than_static_friction_bends_them(moves: list[tuple[float, float]]) -> None:
    z = 0.0
    for slip, step in moves:
        z = LUGRE.next_deflection(z, slip, step)
        # mu_s / s0: rounding
        assert abs(z) <= 0.3 / 1e5 * (1.0 + 1e-15)


def test_loaded_pin_rests_on_its_bristles() -> None:
    # 250 N hold 250/(1e5 1000) m below mu_s F_n = 300 N: rounding
    assert LUGRE(0.0, 1000.0, 2.5e-6) == pytest.approx(-250.0, rel=1e-14)


@given(slip=slips, z=st.floats(-3e-6, 3e-6), share=st.just(0.0) | st.floats(1e-9, 0.999))
def test_bristles_that_are_damped_little_enough_are_passive(slip: float, z: float, share: float) -> None:
    # the docstring: passive if s1 abs(slip) < 4 g; the work done is at least the gain of energy s0 z^2/2
    damping = share * 4.0 * size(slip) / max(abs(slip), 1e-3)
    law = LuGre(static_coefficient=0.3, sliding_coefficient=0.2, bristle_damping=damping)
    work = -law(slip, 1.0, z) * slip
    gain = 1e5 * z * law.deflection_rate(z, slip)
    # rounding of the parts
    assert work - gain >= -1e-13 * (abs(work) + abs(gain))


def test_lugre_has_a_state() -> None:
    assert LUGRE.has_state


@given(mass=st.floats(1e-3, 1e5), force=st.floats(1e-3, 1e7), stiffness=st.floats(1e2, 1e8))
def test_what_sticks_swings_on_the_bristles_spring(mass: float, force: float, stiffness: float) -> None:
    law = LuGre(
        static_coefficient=0.3, sliding_coefficient=0.2, bristle_stiffness=stiffness, bristle_damping=0.0
    )
    # the spring by the law's own force, which without slip is linear in the deflection
    spring = -law(0.0, force, 1e-6) / 1e-6
    assert law.swing_time(mass, force) == pytest.approx(math.sqrt(mass / spring), rel=1e-9)


def test_bristles_damped_far_more_than_critically_stop_what_sticks_sooner() -> None:
    mass, force, stiffness = 400.0, 5e4, 1e5
    critical = 2.0 * math.sqrt(mass * stiffness / force)  # s1 of critical damping
    times = {}
    for share in (1.0, 1.9, 2.1, 20.0):
        law = LuGre(
            static_coefficient=0.3,
            sliding_coefficient=0.2,
            bristle_stiffness=stiffness,
            bristle_damping=share * critical,
        )
        times[share] = law.swing_time(mass, force)
    swing = math.sqrt(mass / (stiffness * force))
    assert times[1.0] == times[1.9] == pytest.approx(swing, rel=1e-12)
    assert times[2.1] == pytest.approx(swing * 2.0 / 2.1, rel=1e-12)
    assert times[20.0] == pytest.approx(swing / 10.0, rel=1e-12)


def test_nothing_swings_where_nothing_is_pressed() -> None:
    assert LUGRE.swing_time(3.0, 0.0) == math.inf


@stateless
def test_laws_without_a_state_hold_nothing_that_swings(law: FrictionLaw) -> None:
    assert law.swing_time(1.0, 1e5) == math.inf
