"""The compiled formulation at a tolerance, and the engine for comparison."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

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


def same_channels(ours: Result, theirs: Result) -> dict[str, np.ndarray]:
    """Differences of all channels as a share of the largest value; names, units and times agree.

    Left out is what is nothing but rounding, in both below 1e-5 of the largest value in the same unit, and the
    energy balance, which is nothing but errors.
    """
    assert list(ours.channels) == list(theirs.channels)
    assert [c.unit for c in ours.channels.values()] == [c.unit for c in theirs.channels.values()]
    np.testing.assert_array_equal(ours.time, theirs.time)
    size = {name: max(np.abs(run[name]).max() for run in (ours, theirs)) for name in ours.channels}
    size["energy.balance"] = 0.0
    scale = {ours.unit(name): 0.0 for name in size}
    for name, largest in size.items():
        scale[ours.unit(name)] = max(scale[ours.unit(name)], largest)
    return {
        name: np.abs(ours[name] - theirs[name]) / largest
        for name, largest in size.items()
        if largest > 1e-5 * scale[ours.unit(name)]
    }
