"""What is done for a run of a sweep, and the runs in processes on this machine."""

import time
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, replace
from itertools import count, islice
from pathlib import Path

from support_exudyn.files.whole_file import workshop
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.contract import SimulationError, told
from support_exudyn.simulation.result import Result, with_digest
from support_exudyn.simulation.simulate import simulate
from support_exudyn.sweeps.key import key
from support_exudyn.sweeps.measures import numbers
from support_exudyn.sweeps.plan import Inputs, Record
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


@dataclass(frozen=True)
class Wanted:
    """What a sweep makes of its points, see `Plan`, and whether it runs again what has failed before."""

    scenario: Callable[[Inputs], Scenario]
    record: Record
    errors: bool = False
    retry_failed: bool = False

    def task(self, inputs: Inputs) -> Task:
        """The run of a point. Raises what `scenario` does; InputError if nothing of it would be noted."""
        scenario = self.scenario(inputs)
        self.record.check(scenario)
        return Task(key(scenario, self.errors), scenario, self.record, self.errors)

    def looked_up(self, store: Store, task: Task) -> StoredRun | Task:
        """What the store has of a run, if that is what is wanted; otherwise what is to be done."""
        row = store.row(task.key)
        whole = row is not None and row.status == "done" and store.has_run(row)
        return row if row is not None and self.is_good(row, whole) else replace(task, again=whole)

    def is_good(self, row: StoredRun, whole: bool) -> bool:
        """Whether what is known of a run is what is wanted; whole: the run itself is there, too."""
        if row.status == "failed":
            return not self.retry_failed
        return row.status == "done" and row.noted == self.record.digest and (whole or not self.record.keep_runs)


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


def image_of(task: Task, result: Result | None) -> bytearray | None:
    """The bytes of a run that is to be kept, see `Result.image`; None if it is not, or has failed."""
    return result.image() if result is not None and task.record.keep_runs else None


def run_into(store: Store, task: Task) -> StoredRun:
    """Run it, or read it if it is kept, and put all of it into the store."""
    return _put(store, *_row_and_image(store, task))


def _row_and_image(store: Store, task: Task) -> tuple[StoredRun, bytearray | None]:
    if task.again:
        try:
            return row_of(task, Result.load(store.run_file(task.key))), None
        except (InputError, FileNotFoundError):  # damaged since, and in a way that its size and age do not tell
            pass
    row, result = computed(task)
    return row, image_of(task, result)


def _put(store: Store, row: StoredRun, image: bytearray | None, within: Path | None = None) -> StoredRun:
    return store.put(row, () if image is None else with_digest(image), within)


# --- in processes ---

LONG = 0.3  # [s] that a chunk is to take
MOST = 64  # runs of a chunk
Chunk = tuple[float, list[StoredRun]]  # how long it took [s], and its rows


def in_processes(tasks: Iterable[Task], store: Store, workers: int) -> Generator[StoredRun, None, None]:
    """Rows as they come; each process puts its runs into the store by itself.

    Small runs are sent many at a time. Of a chunk whose process ends each run is tried by itself; if its
    process ends again its row is "killed".

    workers: number of processes, >= 1.
    """
    source = iter(tasks)
    under_way: dict[int, list[Task]] = {}
    size = 1  # of a chunk, by what the last one took

    def jobs() -> Iterator[tuple[Store, list[Task]]]:
        for number in count():
            if not (chunk := list(islice(source, size))):
                return
            under_way[number] = chunk
            yield store, chunk

    with worker_pool(workers) as pool:
        while True:
            apart: list[Task] = []
            for place, found in pool.stream(jobs(), _do):
                chunk = under_way.pop(place)
                if isinstance(found, ProcessEndedError):
                    if len(chunk) > 1:
                        apart += chunk
                    else:
                        yield StoredRun(chunk[0].key, "killed", found.reason)
                else:
                    seconds, ended = found
                    if not apart:
                        size = max(1, min(MOST, int(LONG * len(chunk) / max(seconds, 1e-9))))
                    yield from ended
            if not apart:
                return
            source, size = iter(apart), 1


def _do(place: int, store: Store, tasks: list[Task]) -> Chunk:
    """In a worker: runs of tasks; each is written while the next is computed, and waited for after that."""
    began, rows = time.perf_counter(), list[Future[StoredRun]]()
    with workshop(store.folder) as within, ThreadPoolExecutor(1) as writer:
        for task in tasks:
            row, image = _row_and_image(store, task)
            if rows:
                rows[-1].result()
            rows.append(writer.submit(_put, store, row, image, within))
        ended = [row.result() for row in rows]
    return time.perf_counter() - began, ended


def refused(error: Exception) -> StoredRun:
    """The row of a point of which there can be no run."""
    return StoredRun("", "failed", reason_of(error))
