"""Long steps before tiny ones: velocities are aligned with the constraints between them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from support_exudyn import Reciprocating, Scenario, SolverSettings, simulate
from support_exudyn.simulation.result_checks import turned_over
from tests.cases.run_cases import PIN, SLIDER_PIN, loose_slider_crank, loose_support

LONG = 1e-3  # [s]
SOLVER = SolverSettings(impact_steps=64, spectral_radius=0.287)
TIGHT = SolverSettings(tolerance=1e-9)
WEIGHTLESS, HEAVY = (0.0, 0.0), (0.0, -9.81)
# Energy that is open, of what was turned over, at steps of 1 ms: they are of second order. Measured: up to
# 1.2e-3 at 1 ms, 4 times that at 2 ms. (With velocities as steps leave them, five of the runs below could not
# be finished.)
OPEN = 2.5e-3


def shaken(clearance_mm: float, step: float, **changes: object) -> Scenario:
    """The support goes up and down ten times a second; the journal flies from side to side of its bore."""
    fields: dict[str, object] = {
        "drive": Reciprocating(stroke=0.01, period=0.1),
        "duration": 0.12,
        "gravity": WEIGHTLESS,
        "step": step,
        "record_period": step,
        "solver": SOLVER,
    }
    return loose_support(clearance_mm, **(fields | changes))


CASES = [
    (1.5, 2.0 * LONG, WEIGHTLESS), (1.65, 2.0 * LONG, HEAVY), (1.75, LONG, HEAVY), (2.0, LONG, WEIGHTLESS)
]  # fmt: skip


@pytest.mark.parametrize(("clearance_mm", "step", "gravity"), CASES)
def test_a_shaken_support_is_as_the_compiled_one(
    clearance_mm: float, step: float, gravity: tuple[float, float]
) -> None:
    scene = shaken(clearance_mm, step, gravity=gravity)
    result, exact = simulate(scene), simulate(replace(scene, formulation="compiled", solver=TIGHT))
    assert len(result.onsets[PIN]) >= 3
    assert result.energy_error < OPEN * (step / LONG) ** 2 * turned_over(result.channels)
    # second order; measured: 1.1e-3 of a step, 1.3e-4 of the speed
    for impact, true in zip(result.onsets[PIN][:2], exact.onsets[PIN][:2], strict=True):
        assert impact.time == pytest.approx(true.time, abs=2e-3 * step)
        assert impact.speed == pytest.approx(true.speed, rel=1e-3 * (step / LONG) ** 2)
    # forces that make up for wrong velocities would be thousands of times as large as these
    assert result.largest_force[PIN] == pytest.approx(exact.largest_force[PIN], rel=0.01)
    for name in result.channels:
        if name.endswith(".force"):
            assert result[name].max() == pytest.approx(exact[name].max(), rel=0.03), name


def rattling(step: float) -> Scenario:
    """The slider-crank at 5000 rpm until its journal has struck three times."""
    return loose_slider_crank(0.0008, step=step, record_period=1e-4, solver=SOLVER)


def test_a_crank_that_turns_far_in_a_step_is_finished_all_the_same() -> None:
    # 0.05 rad in a step: Newton's method gave up at the first impact
    result = simulate(rattling(1e-4))
    assert len(result.onsets[SLIDER_PIN]) == 3
    assert result.energy_error < 5e-3 * turned_over(result.channels)  # measured: 1.1e-3
