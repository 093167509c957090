"""What is done for a run of a sweep, and the runs in processes on this machine."""

import time
from collections.abc import Generator, Iterable, Iterator
from dataclasses import dataclass

from support_exudyn.formulations.contract import SimulationError, told
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.simulate import simulate
from support_exudyn.sweeps.measures import numbers
from support_exudyn.sweeps.plan import Record
from support_exudyn.sweeps.store import Store, StoredRun
from support_exudyn.sweeps.workers import ProcessEndedError, worker_pool
from user_forces.values.value import InputError, cleaned


@dataclass(frozen=True)
class Task:
    """A run to make, or, if `again` is set, one that is kept and of which other numbers are to be noted."""

    key: str
    scenario: Scenario
    record: Record
    errors: bool = False
    again: bool = False


def computed(task: Task) -> tuple[StoredRun, Result | None]:
    """Run it. The Result is None if it fails, whatever the reason is, which the row tells.

    A law of one's own may do anything; KeyboardInterrupt alone ends all runs.
    """
    began = time.perf_counter()
    try:
        result = simulate(task.scenario, errors=task.errors)
        return row_of(task, result), result
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # also SystemExit
        took = time.perf_counter() - began
        return StoredRun(task.key, "failed", reason_of(error), took, noted=task.record.digest), None


def reason_of(error: BaseException) -> str:
    """Why there is no run, in a line."""
    expected = isinstance(error, (SimulationError, InputError))
    return cleaned(" ".join(str(error).split()) if expected else told(error))


def row_of(task: Task, result: Result) -> StoredRun:
    """The row of a run that was finished."""
    found = numbers(result, task.record)
    met = result.goal is None or result.met
    reason = (
        ""
        if met
        else f"accuracy {result.goal:g}: NOT met, {result.worst_error:.1g} is estimated; a larger one may do"
    )
    return StoredRun(task.key, "done", reason, result.wall_time, found, task.record.digest)


def run_into(store: Store, task: Task) -> StoredRun:
    """Run it, or read it if it is kept, and put all of it into the store."""
    if task.again:
        try:
            return store.put(row_of(task, Result.load(store.run_file(task.key))))
        except (InputError, FileNotFoundError):  # damaged since, and in a way that its size and age do not tell
            pass
    row, result = computed(task)
    if result is not None and task.record.keep_runs:
        result.save(store.run_file(task.key))
    return store.put(row)


# --- in processes ---


def in_processes(tasks: Iterable[Task], store: Store, workers: int) -> Generator[StoredRun, None, None]:
    """Rows as they come; each process puts its runs into the store by itself.

    A run whose process ends is tried once more by itself; if that ends too its row is "killed".

    workers: number of processes, >= 1.
    """
    keys: dict[int, str] = {}  # of those under way

    def jobs() -> Iterator[tuple[Store, Task]]:
        for number, task in enumerate(tasks):
            keys[number] = task.key
            yield store, task

    with worker_pool(workers) as pool:
        for number, found in pool.stream(jobs(), _do):
            key = keys.pop(number)
            yield StoredRun(key, "killed", found.reason) if isinstance(found, ProcessEndedError) else found


def _do(place: int, store: Store, task: Task) -> StoredRun:
    del place
    return run_into(store, task)
