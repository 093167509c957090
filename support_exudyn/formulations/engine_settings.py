"""What the engine is told before a run: its settings, and to be quiet."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import exudyn

from support_exudyn.scenario.solver_settings import SolverSettings

SMALLEST_STEP = 1e-13  # [s]
TRIES = 30  # lines that may stand for steep friction in a step, one after another
# Beyond so many unknowns the sparse solver is faster: an ideal rise in space (some 70) takes half as long,
# in the plane (some 24) it makes no difference.
MANY = 40


def engine_settings(
    chosen: SolverSettings,
    duration: float,
    unknowns: int,
    rounding: float = 0.0,
    repeats: bool = False,
) -> Any:
    """The engine's settings for a run of this duration [s] with so many coordinates and multipliers.

    rounding: of its forces [N]. Where a machine rests, Newton's method has nothing else to solve, and without
    being told it would fail by it.
    repeats: whether constraints repeat each other, which full pivoting alone of the engine's methods solves.
    """
    settings = exudyn.SimulationSettings()
    integration = settings.timeIntegration
    integration.endTime = duration
    integration.numberOfSteps = 1  # sizes are set before every step
    integration.adaptiveStep = True  # else the engine computes times from a fixed step
    integration.adaptiveStepRecoverySteps = 2**30  # the engine never lengthens a step by itself
    integration.minimumStepSize = SMALLEST_STEP
    integration.verboseMode = 0
    integration.discontinuous.maxIterations = 2 * TRIES  # a line of friction after another, in every pin
    integration.discontinuous.ignoreMaxIterations = False
    integration.generalizedAlpha.spectralRadius = chosen.spectral_radius
    integration.newton.relativeTolerance = chosen.newton_tolerance
    norm = rounding / unknowns  # the engine's norm of a residual
    integration.newton.absoluteTolerance = max(integration.newton.absoluteTolerance, norm)
    integration.newton.useModifiedNewton = chosen.newton == "modified"
    integration.newton.modifiedNewtonContractivity = 0.1  # renew the Jacobian early: a fifth faster here
    if repeats:
        settings.linearSolver.solverType = exudyn.LinearSolverType.EigenDense
        settings.linearSolver.ignoreSingularJacobian = True
    elif unknowns > MANY:
        settings.linearSolver.solverType = exudyn.LinearSolverType.EigenSparse
    settings.solution.file.write = False
    return settings


@contextmanager
def quiet_engine() -> Iterator[None]:
    """Keep the engine from writing to the console; what it has to say comes as an exception.

    An interruption that it notices between two steps it leaves behind for Python, which takes that for an error
    of the engine: here it comes out as what it is.
    """
    before = exudyn.config.printToConsole
    exudyn.config.printToConsole = False
    try:
        yield
    except SystemError as error:
        if isinstance(error.__cause__, KeyboardInterrupt):
            raise error.__cause__ from None
        raise
    finally:
        exudyn.config.printToConsole = before
