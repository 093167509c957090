"""Runs of all scenes, and the processor time of each: that of a shared machine is what others leave of it."""

import time
from collections.abc import Mapping
from dataclasses import dataclass, replace

from studies.common.runs import bar, with_coarser
from support_exudyn import Failure, Result, Scenario, SimulationError, simulate
from support_exudyn.sweeps.workers import Workers, report, worker_pool


@dataclass(frozen=True)
class Timed:
    """A run with errors of a case, and the processor times at its steps and at half of them [s]."""

    run: Result
    seconds: float
    half_seconds: float


def run_timed(cases: Mapping[str, Scenario], workers: int | Workers) -> dict[str, Timed]:
    """Run every case at its steps, at half and at a quarter of them, in parallel, under a progress bar.

    Raises SimulationError if a run fails.
    """
    half = {name: case.refined() for name, case in cases.items()}
    jobs = [*((name, case.refined()) for name, case in half.items()), *half.items(), *cases.items()]
    with bar(f"{len(jobs)} runs") as told, worker_pool(workers) as pool:
        done = pool.run(jobs, _run, told)
    found = {}
    for n, name in enumerate(cases):
        fine, middle, coarse = (_good(name, *done[k * len(cases) + n]) for k in range(3))
        found[name] = Timed(with_coarser([coarse[0], middle[0], fine[0]]), coarse[1], middle[1])
    return found


def _run(place: int, name: str, scenario: Scenario) -> tuple[Result | Failure, float]:
    del name
    begun = time.process_time()
    result = simulate(scenario, progress=report, throw=False)
    return result, time.process_time() - begun


def _good(name: str, result: Result | Failure, seconds: float) -> tuple[Result, float]:
    if isinstance(result, Failure):
        raise SimulationError(replace(result, reason=f"{name}: {result.reason}"))
    return result, seconds


def timed(scenario: Scenario) -> float:
    """Processor time of a run [s]."""
    begun = time.process_time()
    simulate(scenario)
    return time.process_time() - begun
