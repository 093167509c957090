"""Runs at the steps that a scenario has, and at half of them, so that every number has its error."""

from __future__ import annotations

from dataclasses import replace

from support_exudyn.errors import Failure, SimulationError
from support_exudyn.progress import Progress
from support_exudyn.result import Result
from support_exudyn.run_once import run_once
from support_exudyn.scenario import Scenario
from support_exudyn.to_accuracy import with_measured

LARGEST_ERROR = 0.5  # of the worst number: beyond it a run tells nothing
UNCERTAIN = (
    "Take a smaller `step` and more `solver.impact_steps`, or ask for an accuracy. Where each of many touches "
    "multiplies the errors of those before, no step makes such numbers certain: take a shorter duration."
)


def run_with_error(scenario: Scenario, progress: Progress) -> Result:
    """The run at half the steps of a scenario; the run at its steps is its `coarser` one.

    Raises InputError if the formulation does not cover the scenario, or has no finer settings; SimulationError if
    a run fails, or if the numbers change by more than half of themselves when steps are halved.
    """
    scenario = with_measured(scenario)
    coarse = run_once(scenario, lambda share: progress(share / 3.0))
    fine = run_once(scenario.refined(), lambda share: progress((1.0 + 2.0 * share) / 3.0))
    result = replace(fine, coarser=coarse, wall_time=coarse.wall_time + fine.wall_time)
    if not result.worst_error <= LARGEST_ERROR:
        reason = f"its numbers are uncertain by {result.worst_error:.0%}; allowed: {LARGEST_ERROR:.0%}"
        raise SimulationError(Failure(reason, UNCERTAIN, scenario.duration))
    return result
