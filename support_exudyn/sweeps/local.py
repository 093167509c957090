"""The runs of a sweep in processes on this machine."""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator

from support_exudyn.scenario.scenario import Scenario
from support_exudyn.sweeps.row import Row
from support_exudyn.sweeps.store import Store
from support_exudyn.sweeps.work import Task, run_into
from support_exudyn.sweeps.workers import ProcessEndedError, worker_pool


def in_processes(tasks: Iterable[Task], store: Store, workers: int) -> Generator[Row, None, None]:
    """Rows as they come; each process puts its runs into the store by itself.

    A run whose process ends is tried once more by itself; if that ends too its row is "killed".

    workers: number of processes, >= 1.
    """
    keys: dict[int, str] = {}  # of those under way
    compiled = False

    def jobs() -> Iterator[tuple[Store, Task]]:
        nonlocal compiled
        for number, task in enumerate(tasks):
            if not (compiled or task.again) and _is_compiled(task.scenario):
                from support_exudyn.sweeps.precompile import warm_up  # and numba

                warm_up()  # once, for all processes
                compiled = True
            keys[number] = task.key
            yield store, task

    with worker_pool(workers) as pool:
        for number, found in pool.stream(jobs(), _do):
            key = keys.pop(number)
            yield Row(key, "killed", found.reason) if isinstance(found, ProcessEndedError) else found


def _is_compiled(scenario: Scenario) -> bool:
    """Whether its formulation is, or may be, one that is compiled."""
    return scenario.chooses_steps or (scenario.formulation == "auto" and scenario.goal is not None)


def _do(place: int, store: Store, task: Task) -> Row:
    del place
    return run_into(store, task)
