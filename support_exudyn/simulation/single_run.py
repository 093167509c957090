"""One run of a scenario with the settings that it has."""

import gc
import time
from collections.abc import Iterator
from contextlib import contextmanager

from support_exudyn.formulations.registry import formulation
from support_exudyn.scenario.recorded_channels import asked, channels
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.contract import Failure, Progress, SimulationError, first_line
from support_exudyn.simulation.memory import check_room
from support_exudyn.simulation.provenance import WARNINGS, provenance
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.result_checks import result_checks
from support_exudyn.simulation.slow_slip import friction_warnings
from user_forces.lawful import UNLAWFUL


def single_run(scenario: Scenario, progress: Progress) -> Result:
    """Run a scenario.

    Raises InputError if its formulation does not cover it, SimulationError if it fails, or if it has finished
    but does not stand up to its `result_checks`.
    """
    chosen = formulation(scenario.formulation)
    chosen.check(scenario)
    check_room(scenario)
    began = time.perf_counter()
    try:
        with paused_collector():
            outcome = chosen.run(scenario, progress)
            found = channels(scenario, outcome.trajectory)
    except ArithmeticError as error:  # of a law or a drive, where nothing is computed step by step
        raise SimulationError(Failure(first_line(error), UNLAWFUL, 0.0)) from error
    warnings: list[str] = []
    if scenario.solver.result_checks:
        if (failure := result_checks(scenario, outcome, found)) is not None:
            raise SimulationError(failure)
        warnings = friction_warnings(scenario, outcome)
    return Result(
        scenario=scenario,
        channels=asked(scenario, found),
        onsets=outcome.onsets,
        largest_force=outcome.largest_force,
        largest_force_time=outcome.largest_force_time,
        impulses=outcome.impulses,
        oil_events=outcome.oil_events,
        statistics=outcome.statistics,
        counts=outcome.counts,
        wall_time=time.perf_counter() - began,
        provenance=provenance() | ({WARNINGS: "\n".join(warnings)} if warnings else {}),
    )


@contextmanager
def paused_collector() -> Iterator[None]:
    """Pause it: a run makes next to none, and the search costs a fifth of its time."""
    before = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if before:
            gc.enable()
