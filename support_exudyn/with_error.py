"""Runs at the steps that a scenario has, at half and at a quarter of them: every number has its error.

The first two tell an error of the second. The third has to agree with the second within that error; else
nothing is known of the numbers, and the run is refused.
"""

from __future__ import annotations

from dataclasses import replace

from support_exudyn.errors import Failure, SimulationError
from support_exudyn.estimate import disagreement, rounding_share
from support_exudyn.progress import Progress
from support_exudyn.result import Result
from support_exudyn.run_once import run_once
from support_exudyn.scenario import Scenario
from support_exudyn.solver_settings import ERROR_CONTROLLED, REFINED_TOLERANCE, SMALLEST_TOLERANCE
from support_exudyn.to_accuracy import is_the_same, with_measured
from user_forces.values import InputError

SHARES = (1.0 / 7.0, 2.0 / 7.0, 4.0 / 7.0)  # of the work, run by run
LARGEST_ERROR = 0.5  # of the worst number: beyond it a run tells nothing
SAME = "its runs are the same to the bit, whatever their tolerance: no error is to be told from them"
FOLLOWED = "Take a smaller `solver.tolerance`, or ask for an accuracy, which finds one that matters."
UNCERTAIN = (
    "Take a smaller `step` and more `solver.impact_steps` (with steps below 2e-5 s rounding shows: then a "
    "larger one), or ask for an accuracy. Where each of many touches multiplies the errors of those before, no "
    "step makes such numbers certain: take a shorter duration."
)


def run_with_error(scenario: Scenario, progress: Progress) -> Result:
    """The run at a quarter of a scenario's steps, whose `coarser` ones are those at half of them and at them.

    Raises InputError if the formulation does not cover the scenario, or has no finer settings; SimulationError
    if a run fails, or if its numbers do not settle when steps are halved.
    """
    done, runs = 0.0, []
    for chosen, share in zip(_settings(scenario), SHARES, strict=True):
        runs.append(run_once(chosen, _part(progress, done, share)))
        done += share
    progress(1.0)
    first, second, third = runs
    if is_the_same(first, second) or is_the_same(second, third):
        raise SimulationError(Failure(SAME, FOLLOWED, scenario.duration))
    second = replace(second, coarser=first)
    result = replace(third, coarser=second, wall_time=sum(run.wall_time for run in runs))
    told = second.worst_error + rounding_share(third)
    moved = disagreement(second, third)
    if not moved <= told:
        reason = (
            f"its numbers do not settle: halving the steps tells an error of {told:.2g}, halving them again "
            f"moves the numbers by {moved:.2g}"
        )
        raise SimulationError(Failure(reason, UNCERTAIN, scenario.duration))
    if not result.worst_error <= LARGEST_ERROR:
        reason = f"its numbers are uncertain by {result.worst_error:.0%}; allowed: {LARGEST_ERROR:.0%}"
        raise SimulationError(Failure(reason, UNCERTAIN, scenario.duration))
    return result


def _settings(scenario: Scenario) -> tuple[Scenario, Scenario, Scenario]:
    """The scenario and two finer ones. Raises InputError, before anything is run, if there are none."""
    coarse = with_measured(scenario)
    least = SMALLEST_TOLERANCE * 2.0 ** (2 * REFINED_TOLERANCE)
    if coarse.formulation in ERROR_CONTROLLED and coarse.solver.tolerance < least:
        raise InputError(
            f"solver.tolerance = {coarse.solver.tolerance:g}: cannot be made finer twice; allowed with errors: "
            f"from {least:g} on"
        )
    half = coarse.refined()
    return coarse, half, half.refined()


def _part(progress: Progress, done: float, share: float) -> Progress:
    return lambda of_run: progress(min(1.0, done + share * of_run))
