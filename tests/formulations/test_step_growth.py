"""Lengths of the engine's steps, and what happens within one: states between its ends, tops of forces."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from support_exudyn.formulations.exudyn.solver.step_growth import StepGrowth
from support_exudyn.formulations.exudyn.solver.within_steps import StepEnd, between
from user_forces.roots import has_a_top, peak

MASS = np.array([2.0, 2.0, 1.0])
WEIGHT = math.sqrt(2.0) * 9.81


def steps(longest: float = 16.0) -> StepGrowth:
    return StepGrowth(1.0, longest, MASS, WEIGHT)


# --- states inside a step ---


def state(t: float, position: Polynomial, integral: Polynomial) -> StepEnd:
    velocity, acceleration, power = position.deriv(), position.deriv(2), integral.deriv()
    line = np.array([3.0 - 2.0 * t])
    return StepEnd(
        t,
        np.array([position(t)]),
        np.array([velocity(t)]),
        np.array([acceleration(t)]),
        line,
        np.array([integral(t)]),
        np.array([power(t)]),
    )


@pytest.mark.parametrize("t", [0.5, 0.7, 0.9999, 1.5])
def test_quintics_cubics_and_lines_are_met(t: float) -> None:
    cubic, quintic = Polynomial([1.0, -2.0, 0.5, 0.3]), Polynomial([1.0, -2.0, 0.5, 0.3, -0.7, 0.2])
    # rounding of numbers up to 3
    position, _, memory, totals = between(state(0.5, quintic, cubic), state(1.5, quintic, cubic), t)
    assert position == pytest.approx(state(t, quintic, cubic).position, abs=1e-14)
    assert totals == pytest.approx(state(t, quintic, cubic).totals, abs=1e-14)
    assert memory == pytest.approx([3.0 - 2.0 * t], abs=1e-14)
    _, velocity, _, _ = between(state(0.5, cubic, cubic), state(1.5, cubic, cubic), t)
    assert velocity == pytest.approx(state(t, cubic, cubic).velocity, abs=1e-14)


# --- tops of forces ---


@pytest.mark.parametrize("top", [0.01, 0.3, 0.5, 0.93, 0.99])
def test_a_corner_is_found_wherever_it_lies_in_a_step(top: float) -> None:
    assert peak(lambda x: 1.0 - abs(x - top), 0.0) == pytest.approx(1.0, abs=1e-4)
    assert peak(lambda x: 1.0 - abs(x - top), 10.0) == 10.0
    assert has_a_top(lambda x: 1.0 - abs(x - top), 1.0 - top, top)


@pytest.mark.parametrize("slope", [-1.0, 0.0, 1.0])
def test_a_force_that_rises_or_falls_throughout_has_no_top_inside(slope: float) -> None:
    assert not has_a_top(lambda x: 5.0 + slope * x, 5.0, 5.0 + slope)
