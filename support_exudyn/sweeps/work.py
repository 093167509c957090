"""What is done for a run of a sweep, and the runs in processes on this machine."""

import math
import pickle
import time
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import repeat
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from support_exudyn.files.whole_file import workshop
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.contract import SimulationError, told
from support_exudyn.simulation.result import Result, with_digest
from support_exudyn.simulation.simulate import simulate
from support_exudyn.sweeps.chunks import Chunks
from support_exudyn.sweeps.key import key
from support_exudyn.sweeps.measures import numbers
from support_exudyn.sweeps.plan import Inputs, Record
from support_exudyn.sweeps.store import Store, StoredRun
from support_exudyn.sweeps.workers import ProcessEndedError, worker_pool
from user_forces.values.value import InputError, cleaned

Numbered = tuple[int, Inputs]  # a point, and which of its plan it is


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


class Ended(NamedTuple):
    """What came of an item: its row, and whether that was in the store before."""

    row: StoredRun
    before: bool = False


T = TypeVar("T")
Chunk = tuple[float, list[Ended] | None]  # how long it took [s], and what came of its items


def in_processes(tasks: Iterable[Task], store: Store, workers: int) -> Generator[StoredRun, None, None]:
    """Rows as they come; each process puts its runs into the store by itself.

    A run whose process ends is tried once more by itself; if that ends too its row is "killed".

    workers: number of processes, >= 1.
    """

    def job(chunk: list[Task]) -> tuple[Any, ...]:
        return store, chunk

    for task, ended in _streamed(iter(tasks), math.inf, job, _do, workers):
        assert ended is not None  # tasks can be read everywhere
        yield ended.row if isinstance(ended, Ended) else StoredRun(task.key, "killed", ended.reason)


def points_in_processes(
    points: Iterable[Numbered], number: int, wanted: Wanted, store: Store, workers: int
) -> Generator[tuple[Numbered, Ended | ProcessEndedError | None], None, None]:
    """Points and what came of each as they come; the processes make the scenarios, too.

    None of a point that another process cannot read: there is no more than a name of the function that makes
    its scenario, which was typed into a console, say.

    Arguments:
        points: what is varied, with numbers.
        number: of the points.
        wanted: what can be pickled.
        workers: number of processes, >= 1.
    """
    sent = pickle.dumps(wanted)

    def job(chunk: list[Numbered]) -> tuple[Any, ...]:
        return store, sent, pickle.dumps([inputs for _, inputs in chunk])

    return _streamed(iter(points), number, job, _make, workers)


def _streamed(
    items: Iterator[T],
    number: float,
    job: Callable[[list[T]], tuple[Any, ...]],
    work: Callable[..., Chunk],
    workers: int,
) -> Generator[tuple[T, Ended | ProcessEndedError | None], None, None]:
    """Items with what came of each; of a chunk whose process ended each is tried by itself."""
    with worker_pool(workers) as pool:
        while True:
            apart: list[T] = []
            chunks = Chunks(items, number, workers)
            for place, found in pool.stream(map(job, chunks), work):
                if isinstance(found, ProcessEndedError):
                    chunk = chunks.ended(place, math.inf)
                    if len(chunk) > 1:
                        apart += chunk
                    else:
                        yield chunk[0], found
                else:
                    seconds, ended = found
                    chunk = chunks.ended(place, seconds)
                    yield from zip(chunk, ended or repeat(None, len(chunk)), strict=True)
            if not apart:
                return
            items, number = iter(apart), 1


def _do(place: int, store: Store, tasks: list[Task]) -> Chunk:
    """In a worker: runs of tasks."""
    del place
    return _all(store, tasks)


def _make(place: int, store: Store, sent: bytes, points: bytes) -> Chunk:
    """In a worker: runs of points as far as they are not in the store."""
    del place
    try:
        wanted, inputs = _read(sent), pickle.loads(points)
    except Exception:  # of somebody's own classes any
        return 0.0, None
    return _all(store, _looked_up(store, wanted, inputs))


@lru_cache(maxsize=1)
def _read(sent: bytes) -> Wanted:
    wanted: Wanted = pickle.loads(sent)
    return wanted


def _looked_up(store: Store, wanted: Wanted, points: Iterable[Inputs]) -> Iterator[Task | Ended]:
    """What is to be run of some points, and what came of the others."""
    return (_found(store, wanted, inputs) for inputs in points)


def _found(store: Store, wanted: Wanted, inputs: Inputs) -> Task | Ended:
    try:
        found = wanted.looked_up(store, wanted.task(inputs))
    except Exception as error:  # of classes of one's own any
        return Ended(refused(error))
    return found if isinstance(found, Task) else Ended(found, before=True)


def _all(store: Store, asked: Iterable[Task | Ended]) -> Chunk:
    """What comes of each; a run is written while the next one is computed, and waited for after that."""
    began, found = time.perf_counter(), list[Ended | Future[StoredRun]]()
    with workshop(store.folder) as within, ThreadPoolExecutor(1) as writer:
        written: Future[StoredRun] | None = None
        for one in asked:
            if isinstance(one, Ended):
                found.append(one)
                continue
            row, image = _row_and_image(store, one)
            if written is not None:
                written.result()
            written = writer.submit(_put, store, row, image, within)
            found.append(written)
        ended = [one if isinstance(one, Ended) else Ended(one.result()) for one in found]
    return time.perf_counter() - began, ended


def refused(error: Exception) -> StoredRun:
    """The row of a point of which there can be no run."""
    return StoredRun("", "failed", reason_of(error))
