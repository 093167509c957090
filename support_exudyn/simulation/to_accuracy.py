"""Runs to an accuracy: settings chosen before the run, errors estimated after it, refined until as asked."""

import math
from dataclasses import replace

import numpy as np

from support_exudyn.mechanics.channels import ALL_CHANNELS
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scenario.solver_settings import MOST_SECTIONS
from support_exudyn.scene.contract import Progress, SimulationError, silent
from support_exudyn.simulation.automatic_settings import settings_for
from support_exudyn.simulation.reported_numbers import ROUNDING, measured, measures
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.single_run import single_run
from user_forces.values.value import InputError

FEWEST_RUNS, MOST_RUNS = 3, 8
# If errors do not fall at least so much when a scene is refined, so often in a row, no step makes its numbers
# certain: each impact multiplies what the steps before it left.
FALLS, PATIENCE = 0.7, 2


def run_to_accuracy(scenario: Scenario, progress: Progress) -> Result:
    """Run a scenario that asks for an accuracy.

    At least three runs, each with half the steps' length of the one before; how errors follow from their
    distances is told in `estimate`. Refined until the worst of the numbers that the accuracy is of is as asked,
    or until refining does not help. A run whose steps were too long to finish it does not count; once there is
    a result with its errors, one that fails ends the refining. A run whose steps did not follow its tolerance
    is the same as the one before, which tells nothing: it takes that one's place.

    In space sections of clearance pins become more from run to run, too, which costs as much as the steps do;
    after three runs only if they tell anything.

    Raises InputError if the formulation does not cover the scenario, SimulationError if no three runs in a row
    can be finished.
    """
    goal = scenario.goal
    assert goal is not None
    chosen: Scenario | None = with_measured(settings_for(scenario, goal))
    last: Result | None = None
    best: Result | None = None
    same: Result | None = None
    first: Result | None = None
    sections: int | None = None  # that are enough; None: that is not known
    trouble: SimulationError | None = None
    wall_time, off, least, in_vain, in_a_row = 0.0, np.inf, np.inf, 0, 0
    for n in range(MOST_RUNS):
        assert chosen is not None
        try:
            run = single_run(chosen, _part(progress, n))
        except SimulationError as error:
            if best is not None:
                break
            if not error.failure.finer:
                raise trouble or error from None
            last, in_a_row, trouble = None, 0, trouble or error
        else:
            wall_time += run.wall_time
            first = first or run
            if last is not None and is_the_same(last, run):
                same, last = last, replace(run, coarser=last.coarser, goal=goal)
            else:
                in_a_row += 1
                last = replace(run, coarser=_without_oldest(last), goal=goal)
                if in_a_row >= FEWEST_RUNS:
                    before, off = off, last.worst_error
                    if off < least or best is None:  # with steps too short, rounding makes it worse again
                        least, best = off, last
                    in_vain = in_vain + 1 if off > FALLS * before else 0
                    if off <= goal or in_vain == PATIENCE:
                        break
        if sections is None and best is not None and first is not None and scenario.dimensions == 3:
            sections, taken = _sections_enough(first, chosen.solver.sections)
            wall_time += taken
        if (chosen := finer_than(chosen)) is None:
            break
        if sections is not None:
            chosen = _with_sections(chosen, min(sections, chosen.solver.sections))
    progress(1.0)
    found = best or last
    if found is None or (trouble is not None and best is None):
        assert trouble is not None  # else something would have been found
        raise trouble
    # the same with every tolerance: two that are the same stand for its runs
    return replace(found, coarser=found.coarser or same, wall_time=wall_time)


def with_measured(scenario: Scenario) -> Scenario:
    """A scenario that also records what errors are estimated by: they then do not depend on what is asked."""
    if scenario.channels == ALL_CHANNELS:
        return scenario
    missing = [name for name in measured(scenario) if name not in scenario.channels]
    return replace(scenario, channels=(*scenario.channels, *missing))


def is_the_same(run: Result, finer: Result) -> bool:
    """Whether two runs are the same to the bit: their steps follow something else than their tolerance.

    Nothing is to be told from them then, but where all is known in closed form and nothing is free to move.
    """
    scenario = finer.scenario
    if not (scenario.contact_places or scenario.compliant_actuators) or run.counts != finer.counts:
        return False
    return all(np.array_equal(run[name], finer[name]) for name in finer.channels)


def _sections_enough(first: Result, most: int) -> tuple[int, float]:
    """How many sections of clearance pins are enough, and how long it took to know that [s].

    Those of the first run, if so many make none of its numbers another one; else any number is worth it.
    """
    few = first.scenario.solver.sections
    if not first.scenario.clearance_pins or most <= few:
        return MOST_SECTIONS, 0.0
    try:
        run = single_run(_with_sections(first.scenario, most), silent)
    except SimulationError:
        return MOST_SECTIONS, 0.0
    for kind in measures(first, 0.0, math.inf).values():
        value = kind.measure(first)
        nothing = max(kind.left, ROUNDING) * max(abs(value), kind.size, kind.values)
        if not abs(kind.measure(run) - value) <= nothing:
            return MOST_SECTIONS, run.wall_time
    return few, run.wall_time


def _with_sections(scenario: Scenario, sections: int) -> Scenario:
    return replace(scenario, solver=replace(scenario.solver, sections=sections))


def _without_oldest(result: Result | None) -> Result | None:
    """Only three runs are kept: with the next finer one, this and the one before."""
    if result is None or result.coarser is None:
        return result
    return replace(result, coarser=replace(result.coarser, coarser=None))


def finer_than(scenario: Scenario) -> Scenario | None:
    """The scenario with steps half as long; None if there are no finer settings."""
    try:
        finer = scenario.refined()
    except InputError:
        return None
    return None if finer == scenario else finer


def _part(progress: Progress, n: int) -> Progress:
    """Of run n, each of which takes half of what is left: how many there will be is not known."""
    return lambda share: progress(1.0 - (2.0 - share) * 0.5 ** (n + 1))
