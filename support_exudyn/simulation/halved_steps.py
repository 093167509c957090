"""Runs at the steps that a scenario has, at half and at a quarter of them: every number has its error.

The first two tell an error of the second. The third has to agree with the second within that error. If it does
not, if errors are too large to tell anything, or if steps were too long for the run to be finished, steps are
halved again, a few times. If that does not help, nothing is known of the numbers, and the run is refused.
"""

from dataclasses import replace

from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scenario.solver_settings import REFINED_TOLERANCE, SMALLEST_TOLERANCE
from support_exudyn.scene.contract import Failure, Progress, SimulationError
from support_exudyn.simulation.estimate import disagreement, rounding_share
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.single_run import single_run
from support_exudyn.simulation.to_accuracy import finer_than, is_the_same, with_measured
from user_forces.values.value import InputError

SHARES = (1.0 / 7.0, 2.0 / 7.0, 4.0 / 7.0)  # of the work, run by run, if these will do
MOST_RUNS = 6
LARGEST_ERROR = 0.5  # of the worst number: beyond it a run tells nothing
SAME = "its runs are the same to the bit, whatever their tolerance: no error is to be told from them"
FOLLOWED = "Take a smaller `solver.tolerance`, or ask for an accuracy, which finds one that matters."
UNCERTAIN = (
    "Take a smaller `step` and more `solver.impact_steps` (in space rounding shows with steps below 2e-5 s: "
    "there a larger one), or ask for an accuracy. Where each of many impacts multiplies the errors of those "
    "before, no step makes such numbers certain: take a shorter duration."
)


def run_halving_steps(scenario: Scenario, progress: Progress) -> Result:
    """The run at a quarter of a scenario's steps, whose `coarser` ones are those at half of them and at them.

    At still shorter steps where those do not do, with up to three coarser runs.

    Raises InputError if the formulation does not cover the scenario, or has no finer settings; SimulationError
    if a run fails, or if its numbers do not settle when steps are halved.
    """
    chosen: Scenario | None = _coarsest(scenario)
    result: Result | None = None
    doubt: Failure | None = None
    done, wall_time = 0.0, 0.0
    for n in range(MOST_RUNS):
        assert chosen is not None
        share = SHARES[n] if n < len(SHARES) else 0.0
        try:
            run = single_run(chosen, _part(progress, done, share))
        except SimulationError as error:
            if not error.failure.finer:
                raise error if doubt is None else SimulationError(doubt) from error
            result, doubt = None, doubt or error.failure
        else:
            wall_time += run.wall_time
            if result is not None and is_the_same(result, run):
                doubt, result = doubt or Failure(SAME, FOLLOWED, scenario.duration), result.coarser
            result = replace(run, coarser=_without_oldest(result))
            if result.coarser is not None and result.coarser.coarser is not None:
                found = _doubt(result, scenario.duration)
                if found is None:
                    progress(1.0)
                    return replace(result, wall_time=wall_time)
                doubt = doubt or found
        done += share
        if (chosen := finer_than(chosen)) is None:
            break
    assert doubt is not None  # else one of them would do
    raise SimulationError(doubt)


def _doubt(result: Result, duration: float) -> Failure | None:
    """Why the numbers of a run of this duration [s] are not to be believed; None if they are."""
    before = result.coarser
    assert before is not None
    told = before.worst_error + rounding_share(result)
    moved = disagreement(before, result)
    if not moved <= told:
        reason = (
            f"its numbers do not settle: halving the steps tells an error of {told:.2g}, halving them again "
            f"moves the numbers by {moved:.2g}"
        )
        return Failure(reason, UNCERTAIN, duration)
    if not result.worst_error <= LARGEST_ERROR:
        reason = f"its numbers are uncertain by {result.worst_error:.0%}; allowed: {LARGEST_ERROR:.0%}"
        return Failure(reason, UNCERTAIN, duration)
    return None


def _without_oldest(result: Result | None) -> Result | None:
    """A run with its two coarser ones: what the estimate of its error takes."""
    if result is None or result.coarser is None or result.coarser.coarser is None:
        return result
    return replace(
        result, coarser=replace(result.coarser, coarser=replace(result.coarser.coarser, coarser=None))
    )


def _coarsest(scenario: Scenario) -> Scenario:
    """The scenario as it is run first. Raises InputError, before anything is run, if two finer ones are not."""
    coarse = with_measured(scenario)
    least = SMALLEST_TOLERANCE * 2.0 ** (2 * REFINED_TOLERANCE)
    if coarse.chooses_steps and coarse.solver.tolerance < least:
        raise InputError(
            f"solver.tolerance = {coarse.solver.tolerance:g}: cannot be made finer twice; allowed with errors: "
            f"from {least:g} on"
        )
    coarse.refined().refined()
    return coarse


def _part(progress: Progress, done: float, share: float) -> Progress:
    return lambda of_run: progress(min(1.0, done + share * of_run))
