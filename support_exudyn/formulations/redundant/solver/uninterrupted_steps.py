"""Integration in stretches of equal steps, in which the engine calls nothing of ours unless it has to.

The engine's own loop over steps is entered once a stretch. What generalised alpha keeps from step to step stays
in the solver, so that this is one integration: only where its steps end is told anew.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

ROUNDING = 1e-6  # of a step


class UninterruptedSteps(NamedTuple):
    """Equal steps: where the last ends [s], and how many they are."""

    end: float
    steps: int


def solve_uninterrupted(
    solver: Any,
    mbs: Any,
    settings: Any,
    following: Callable[[float], UninterruptedSteps | None],
    arrive: Callable[[float, int, int], float],
) -> bool:
    """Integrate from 0; whether it could be finished.

    Arguments:
        solver: the engine's; mbs: its system; settings: of the run, whose steps are set here.
        following: the stretch that begins at a time [s], None: the run ends there.
        arrive: is called at the start and after every stretch with the time [s], the number of steps taken, and
            how often one was repeated because Newton's method did not converge: with half the step, as are then
            all that are left of the stretch. It says from when the run goes on [s].
    """
    if not solver.InitializeSolver(mbs, settings):
        return False
    it = solver.it
    t = arrive(0.0, 0, 0)
    while (run_of_steps := following(t)) is not None:
        size = (run_of_steps.end - float(it.currentTime)) / run_of_steps.steps
        it.endTime = run_of_steps.end
        it.maxStepSize = it.currentStepSize = size
        if not solver.SolveSteps(mbs, settings):
            return False
        t = float(it.currentTime)
        if abs(t - run_of_steps.end) < ROUNDING * size:  # of a sum of steps; the next stretch makes up for it
            t = run_of_steps.end
        repeats = max(0, round(math.log2(size / float(it.currentStepSize))))
        t = arrive(t, int(it.currentStepIndex) - 1, repeats)  # the engine counts from 1 in every stretch
    solver.FinalizeSolver(mbs, settings)
    return True
