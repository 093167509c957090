"""The compiled formulation at a tolerance, and the engine for comparison."""

from __future__ import annotations

from dataclasses import replace

from support_exudyn import Result, Scenario, simulate
from support_exudyn.scenario.solver_settings import MOST_STEPS
from support_exudyn.scene.contract import Progress, silent


def simulate_compiled(
    scenario: Scenario,
    tolerance: float = 1e-8,
    progress: Progress = silent,
    most_steps: int = MOST_STEPS,
) -> Result:
    """Run a scenario by the compiled formulation."""
    solver = replace(scenario.solver, tolerance=tolerance, most_steps=most_steps)
    return simulate(replace(scenario, formulation="compiled", solver=solver), progress=progress)


def simulate_on_exudyn(scenario: Scenario) -> Result:
    """Run a scenario with the engine's bodies and constraints."""
    return simulate(replace(scenario, formulation="exudyn"))
