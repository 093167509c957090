"""One run of a scenario with the settings that it has."""

import gc
import time
from collections.abc import Iterator
from contextlib import contextmanager

from support_exudyn.files.free_memory import available
from support_exudyn.formulations.registry import formulation
from support_exudyn.mechanics.channels import chosen as chosen_channels
from support_exudyn.scenario.recorded_channels import asked, channels
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.contract import Failure, Progress, SimulationError, first_line
from support_exudyn.simulation.provenance import WARNINGS, provenance
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.result_checks import result_checks
from support_exudyn.simulation.slow_slip import friction_warnings
from user_forces.lawful import UNLAWFUL
from user_forces.values.value import InputError

NUMBER = 2 * 8  # bytes of a number at a record, and of the states that it follows from; 2.9 * 8 were measured
GIGA = 1e9


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


def check_room(scenario: Scenario) -> None:
    """Raise InputError if the records of a run do not fit into memory, with what does.

    What is asked for is the least that it takes.
    """
    records = scenario.duration / scenario.recorded_every + 1.0
    count = len(chosen_channels(scenario.channel_definitions, scenario.channels))
    needed, there = records * count * NUMBER, available()
    if needed > there:
        period = scenario.recorded_every * needed / there
        raise InputError(
            f"duration = {scenario.duration:g} s, record_period = {scenario.recorded_every:g} s: {records:.3g} "
            f"records of {count} channels take {needed / GIGA:.3g} GB and more, {there / GIGA:.3g} GB are "
            f"free; allowed: a shorter duration, fewer channels, or records at least {_up(period):g} s apart"
        )


def _up(number: float) -> float:
    """In two digits, not below it."""
    return float(f"{1.05 * number:.2g}")
