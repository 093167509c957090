from __future__ import annotations

import math
from itertools import accumulate

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from support_exudyn.formulations.redundant.solver.within_steps import RunningIntegrals

coefficients = st.lists(st.floats(-5.0, 5.0), min_size=3, max_size=3)
# each step up to nearly four times as long as the one before, or shorter
growths = st.lists(st.floats(0.2, 3.9), min_size=1, max_size=8)


def times(growth: list[float]) -> list[float]:
    """Times from 0 to 1 whose steps grow by these factors."""
    ends = np.cumsum(list(accumulate([1.0, *growth], lambda step, factor: step * factor)))
    return [0.0, *(ends / ends[-1]).tolist()]


def test_nothing_is_integrated_before_the_first_step() -> None:
    integrals = RunningIntegrals(2)
    integrals.add(0.0, (3.0, 4.0))
    assert integrals.totals == [0.0, 0.0]


@given(slope=st.floats(-5.0, 5.0), value=st.floats(-5.0, 5.0), growth=growths)
def test_straight_lines_are_exact_from_the_first_step_on(
    slope: float, value: float, growth: list[float]
) -> None:
    integrals = RunningIntegrals(1)
    for t in times(growth):
        integrals.add(t, (value + slope * t,))
    # rounding of sums of numbers below 10
    assert integrals.totals[0] == pytest.approx(value + 0.5 * slope, abs=1e-13)


@given(coefficients=coefficients, growth=growths)
def test_parabolas_are_exact_after_the_first_step_whatever_the_steps(
    coefficients: list[float], growth: list[float]
) -> None:
    curve = Polynomial(coefficients)
    integrals = RunningIntegrals(1)
    grid = times(growth)
    for t in grid[:2]:
        integrals.add(t, (float(curve(t)),))
    first = integrals.totals[0]
    for t in grid[2:]:
        integrals.add(t, (float(curve(t)),))
    # rounding of sums of numbers below 15, times weights up to 3.9
    exact = float(curve.integ()(1.0) - curve.integ()(grid[1]))
    assert integrals.totals[0] - first == pytest.approx(exact, abs=1e-12)


def error_on_sine(number: int) -> float:
    integrals = RunningIntegrals(1)
    for t in np.linspace(0.0, 2.0, number + 1).tolist():
        integrals.add(t, (math.sin(t),))
    return abs(integrals.totals[0] - (1.0 - math.cos(2.0)))


def test_error_falls_with_the_third_power_of_the_step() -> None:
    errors = [error_on_sine(n) for n in (20, 40, 80, 160)]
    # third order; the next term of the expansion leaves a few hundredths at these steps
    np.testing.assert_allclose(np.log2(np.array(errors[:-1]) / errors[1:]), 3.0, atol=0.2)


def test_uneven_steps_are_of_third_order_too() -> None:
    def error(number: int) -> float:
        grid = np.linspace(0.0, 1.0, number + 1)
        integrals = RunningIntegrals(1)
        for t in (2.0 * (grid + 0.1 * np.sin(2.0 * np.pi * grid))).tolist():
            integrals.add(t, (math.sin(t),))
        return abs(integrals.totals[0] - (1.0 - math.cos(2.0)))

    # third order; the next term of the expansion is larger than with even steps
    assert math.log2(error(80) / error(160)) == pytest.approx(3.0, abs=0.3)


def integral_of_a_kink(kink: float, number: int, tell: bool) -> float:
    integrals = RunningIntegrals(1)
    for t in [*np.linspace(0.0, kink, number).tolist(), *np.linspace(kink, 1.0, number).tolist()[1:]]:
        integrals.add(t, (abs(t - kink),))
        if tell and t == kink:
            integrals.restart()
    return integrals.totals[0]


@given(kink=st.floats(0.25, 0.75), number=st.integers(4, 20))
def test_a_kink_does_no_harm_if_it_is_told(kink: float, number: int) -> None:
    exact = 0.5 * (kink**2 + (1.0 - kink) ** 2)
    # piecewise straight: rounding
    assert integral_of_a_kink(kink, number, tell=True) == pytest.approx(exact, abs=1e-14)


@given(kink=st.floats(0.25, 0.75), number=st.integers(4, 20))
def test_a_kink_that_is_not_told_is_rounded_off(kink: float, number: int) -> None:
    before, after = kink / (number - 1), (1.0 - kink) / (number - 1)
    # the parabola through slopes of -1 and 1 has the second derivative 4/(sum of both steps)
    missed = 4.0 / (before + after) * after**3 / 12.0
    exact = 0.5 * (kink**2 + (1.0 - kink) ** 2)
    # rounding
    assert exact - integral_of_a_kink(kink, number, tell=False) == pytest.approx(missed, abs=1e-14)


@given(
    lower=st.floats(-5.0, 5.0),
    upper=st.floats(-5.0, 5.0),
    jump=st.floats(0.25, 0.75),
    number=st.integers(4, 20),
)
def test_a_jump_does_no_harm_if_it_is_told(lower: float, upper: float, jump: float, number: int) -> None:
    integrals = RunningIntegrals(1)
    for t in np.linspace(0.0, jump, number).tolist():
        integrals.add(t, (lower,))
    integrals.jump(jump)
    for t in np.linspace(jump, 1.0, number).tolist()[1:]:
        integrals.add(t, (upper,))
    # piecewise constant: rounding of numbers up to 5
    assert integrals.totals[0] == pytest.approx(jump * lower + (1.0 - jump) * upper, abs=1e-14)


def test_a_jump_at_the_start_does_no_harm() -> None:
    integrals = RunningIntegrals(1)
    integrals.add(0.0, (0.0,))
    integrals.jump(0.0)
    for t in (0.5, 1.0):
        integrals.add(t, (3.0,))
    assert integrals.totals == [3.0]


def test_a_long_step_after_a_short_one_is_a_straight_line() -> None:
    # a parabola through two close values would magnify their rounding
    integrals = RunningIntegrals(1)
    for t, v in ((0.0, 1.0), (1e-9, 1.0 + 1e-6), (1.0, 2.0)):
        integrals.add(t, (v,))
    # the trapezium, to the change of 1e-6
    assert integrals.totals[0] == pytest.approx(1.5, abs=1e-6)


def test_quantities_do_not_mix() -> None:
    integrals = RunningIntegrals(3)
    for t in (0.0, 0.25, 0.5, 1.0):
        integrals.add(t, (1.0, -2.0, t))
    # rounding
    assert integrals.totals == pytest.approx([1.0, -2.0, 0.5], abs=1e-15)
