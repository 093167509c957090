"""Runs to an accuracy: settings chosen before the run, errors estimated after it, refined until as asked."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from support_exudyn.choose import settings_for
from support_exudyn.estimate import measured
from support_exudyn.progress import Progress
from support_exudyn.recipes import ALL_CHANNELS
from support_exudyn.result import Result
from support_exudyn.run_once import run_once
from support_exudyn.scenario import Scenario
from user_forces.values import InputError

FACTOR = 2.0  # by which steps are shorter from run to run
FEWEST_RUNS, MOST_RUNS = 3, 8
# If errors do not fall at least so much when a scene is refined, so often in a row, no step makes its numbers
# certain: each touch multiplies what the steps before it left.
FALLS, PATIENCE = 0.7, 2


def run_to_accuracy(scenario: Scenario, progress: Progress) -> Result:
    """Run a scenario that asks for an accuracy.

    At least three runs, each with half the steps' length of the one before; how errors follow from their
    distances is told in `estimate`. Refined until the worst of the numbers that the accuracy is of is as asked,
    or until refining does not help. A run whose steps did not follow its tolerance is the same as the one
    before, which tells nothing: it takes that one's place.

    Raises InputError if the formulation does not cover the scenario, SimulationError if a run fails.
    """
    goal = scenario.goal
    assert goal is not None
    chosen = with_measured(settings_for(scenario, goal))
    first = last = best = run_once(chosen, _part(progress, 0))
    wall_time, off, least, in_vain, different = last.wall_time, np.inf, np.inf, 0, 1
    for n in range(1, MOST_RUNS):
        if (finer_settings := _finer(chosen)) is None:
            break
        chosen = finer_settings
        finer = run_once(chosen, _part(progress, n))
        wall_time += finer.wall_time
        if is_the_same(last, finer):
            last = replace(finer, coarser=last.coarser, goal=goal)
            continue
        different += 1
        last = replace(finer, coarser=_without_oldest(last), goal=goal)
        if different < FEWEST_RUNS:
            continue
        before, off = off, last.worst_error
        if off < least or different == FEWEST_RUNS:  # with steps too short, rounding makes it worse again
            least, best = off, last
        in_vain = in_vain + 1 if off > FALLS * before else 0
        if off <= goal or in_vain == PATIENCE:
            break
    progress(1.0)
    if last.coarser is None:  # the same with every tolerance
        last = replace(last, coarser=first, goal=goal)
    return replace(best if best.coarser else last, wall_time=wall_time)


def with_measured(scenario: Scenario) -> Scenario:
    """The same that also records what errors are estimated by: they then do not depend on what is asked."""
    if scenario.channels == ALL_CHANNELS:
        return scenario
    missing = [name for name in measured(scenario) if name not in scenario.channels]
    return replace(scenario, channels=(*scenario.channels, *missing))


def is_the_same(run: Result, finer: Result) -> bool:
    """Whether two runs are the same to the bit: their steps follow something else than their tolerance.

    Nothing is to be told from them then, but where all is known in closed form and nothing is free to move.
    """
    scenario = finer.scenario
    if not (scenario.clearance_pins or scenario.giving) or run.counts != finer.counts:
        return False
    return all(np.array_equal(run[name], finer[name]) for name in finer.channels)


def _without_oldest(result: Result) -> Result:
    """Only three runs are kept: with the next finer one, this and the one before."""
    if result.coarser is None:
        return result
    return replace(result, coarser=replace(result.coarser, coarser=None))


def _finer(scenario: Scenario) -> Scenario | None:
    """The same with finer settings; None if there are none."""
    try:
        finer = scenario.refined(FACTOR)
    except InputError:
        return None
    return None if finer == scenario else finer


def _part(progress: Progress, n: int) -> Progress:
    """Of run n, each of which takes half of what is left: how many there will be is not known."""
    return lambda share: progress(1.0 - (2.0 - share) * 0.5 ** (n + 1))
