"""Journal falling from the middle of its bore: impacts located in time.

Independent integrator with the impact speed taken exactly at zero depth; columns held, c = 1.5 mm, no
friction, restitution 0.9.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import Held, Result, Scenario, SolverSettings, simulate
from tests.cases.run_cases import PIN, loose_support

TIMES = (0.01744754, 0.03958171, 0.07192809)  # [s]
SPEEDS = (0.17192479, 0.07643214, 0.07207929)  # [m/s]


def dropping(step: float, duration: float = 0.08, impact_steps: int = 512) -> Scenario:
    solver = SolverSettings(impact_steps=impact_steps)
    return loose_support(drive=Held(), duration=duration, step=step, record_period=1e-3, solver=solver)


def drop(step: float, duration: float = 0.08) -> Result:
    return simulate(dropping(step, duration))


@pytest.mark.parametrize("step", [1e-3, 1e-4, 1e-5])
def test_first_onset_does_not_depend_on_the_step(step: float) -> None:
    first = drop(step, duration=0.02).onsets[PIN][0]
    # asked for: 1e-6 s and 1e-3; the cubic through a step of free flight is right to 1e-8
    assert first.time == pytest.approx(TIMES[0], abs=2e-8)
    assert first.speed == pytest.approx(SPEEDS[0], rel=1e-7)


def test_all_onsets_of_the_compiled_formulation_are_those_printed() -> None:
    solver = SolverSettings(tolerance=1e-12)
    onsets = simulate(replace(dropping(5e-4), formulation="compiled", solver=solver)).onsets[PIN]
    # half of the last printed digit
    np.testing.assert_allclose([onset.time for onset in onsets], TIMES, rtol=0.0, atol=6e-9)
    np.testing.assert_allclose([onset.speed for onset in onsets], SPEEDS, rtol=0.0, atol=6e-9)


def test_later_onsets_converge_with_second_order() -> None:
    coarse = dropping(5e-4, impact_steps=64)
    runs = [simulate(coarse.refined(factor)).onsets[PIN] for factor in (1, 2, 4)]
    for n, enough in ((1, 1e-3), (2, 1e-2)):
        errors = np.array([abs(run[n].speed / SPEEDS[n] - 1.0) for run in runs])
        # asked for at the finest step
        assert errors[-1] < enough
        # at least the square of the step; impacts cut the steps unevenly, hence the 0.3
        assert np.log2(errors[0] / errors[-1]) / 2 > 1.7
        # times to 1e-6 of a flight of 20 ms (their print is rounded to 5e-9 s)
        assert runs[-1][n].time == pytest.approx(TIMES[n], abs=2e-6)


def test_energy_of_the_drop_is_accounted_for() -> None:
    coarse = dropping(5e-4)
    result = simulate(coarse)
    # asked for: 1e-4 of what is dissipated, at the default step
    assert result.energy_error < 1e-4 * result.dissipated
    finer = simulate(coarse.refined())
    assert result.energy_error / finer.energy_error > 3.0  # 4 for second order
