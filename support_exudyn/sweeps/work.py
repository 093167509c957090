"""What is done for a run of a sweep, in threads and in processes; and a few runs whose results are wanted."""

import pickle
import threading
import time
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from itertools import chain, islice
from pathlib import Path

from support_exudyn.formulations.registry import formulation
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scenario.timescales import rounded
from support_exudyn.scene.contract import Failure, Progress, SimulationError, error_text, silent
from support_exudyn.simulation.automatic_settings import covered, settings_for
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.simulate import simulate
from support_exudyn.sweeps.key import own_sources
from support_exudyn.sweeps.measures import channels_of, numbers
from support_exudyn.sweeps.plan import Record
from support_exudyn.sweeps.store import StoredRun
from support_exudyn.sweeps.workers import ProcessEndedError, Workers, keep_memory, report, worker_pool
from user_forces.values.value import InputError, cleaned

MOST_RECORDS = 1000  # of a compiled run
THREADS_AHEAD = 2  # runs for each thread, one of them waiting


@dataclass(frozen=True)
class Task:
    """A run to make."""

    key: str
    scenario: Scenario
    record: Record
    errors: bool = False


def reduced(scenario: Scenario, record: Record) -> Scenario:
    """The same run with no more channels and records than its numbers and checks need.

    Numbers come from every step, whatever the records are; those of Exudyn may follow its records, and stay.
    """
    if not is_compiled(scenario):
        return scenario
    # of itself a scenario has no fewer records
    period = max(scenario.record_period or 0.0, rounded(scenario.duration / MOST_RECORDS, 0.0))
    channels = scenario.channels if not record.numbers else channels_of(record.numbers, scenario)
    return scenario.recorded_as(channels, min(period, scenario.duration))


def is_compiled(scenario: Scenario) -> bool:
    """Whether the run is integrated by compiled code."""
    if scenario.formulation == "auto":
        try:
            scenario = settings_for(scenario, scenario.goal) if scenario.goal else covered(scenario)
        except InputError:  # which is the reason of its row
            return False
    return formulation(scenario.formulation).name == "compiled"


def run_task(task: Task, progress: Progress = silent) -> StoredRun:
    """The row of a run: its numbers, or why there are none, whatever the reason is.

    A law of one's own may do anything; KeyboardInterrupt alone ends all runs.
    """
    began, noted = time.perf_counter(), task.record.digest
    try:
        scenario = reduced(task.scenario, task.record)
        result = simulate(scenario, errors=task.errors, progress=progress)
        reason = ""
        if result.goal is not None and not result.met:
            reason = f"accuracy {result.goal:g}: NOT met, {result.worst_error:.1g} is estimated; "
            reason += "a larger one may do"
        found = numbers(result, task.record)
        return StoredRun(task.key, "done", reason, result.wall_time, found, noted)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # also SystemExit
        return StoredRun(task.key, "failed", reason_of(error), time.perf_counter() - began, noted=noted)


def reason_of(error: BaseException) -> str:
    """Why there is no run, in a line."""
    expected = isinstance(error, (SimulationError, InputError))
    return cleaned(" ".join(str(error).split()) if expected else error_text(error))


# --- in processes ---


def in_processes(tasks: Iterable[Task], workers: int) -> Generator[StoredRun, None, None]:
    """Rows as they come. Of a run that cannot be sent to a process the row is "failed".

    The row of a run whose process ends, also when it is tried by itself, is "killed".

    workers: number of processes, >= 1.
    """
    keys: dict[int, str] = {}  # of runs under way
    unsent: list[StoredRun] = []

    def jobs() -> Iterator[tuple[bytes]]:
        for task in tasks:
            try:
                job = (pickle.dumps(task),)
            except Exception as error:  # of classes of one's own any
                unsent.append(StoredRun(task.key, "failed", reason_of(error), noted=task.record.digest))
                continue
            keys[len(keys)] = task.key
            yield job

    with worker_pool(workers) as pool:
        for number, row in pool.stream(jobs(), _run_packed):
            yield StoredRun(keys[number], "killed", row.reason) if isinstance(row, ProcessEndedError) else row
    yield from unsent


def _run_packed(place: int, packed: bytes) -> StoredRun:
    del place
    task: Task = pickle.loads(packed)
    return run_task(task)


# --- in threads ---


def suits_threads(task: Task) -> bool:
    """Whether a run goes well in a thread: compiled, and without own classes, which may do anything."""
    return is_compiled(task.scenario) and not own_sources(task.scenario.plain)


def here(tasks: Iterable[Task], workers: int) -> Generator[StoredRun, None, None]:
    """Rows as they come: of runs that suit threads, if the first does, then of all others from processes."""
    tasks, others = iter(tasks), list[Task]()
    if (first := next(tasks, None)) is None:
        return
    tasks = chain([first], tasks)
    if not suits_threads(first):
        yield from in_processes(tasks, workers)
        return

    def suiting() -> Iterator[Task]:
        for task in tasks:
            if suits_threads(task):
                yield task
            else:
                others.append(task)

    yield from in_threads(suiting(), workers)
    if others:
        yield from in_processes(others, workers)


def in_threads(tasks: Iterable[Task], workers: int) -> Generator[StoredRun, None, None]:
    """Rows as they come, of runs by compiled code, which threads of this process integrate side by side.

    An interruption ends them in mid-work. workers: number of threads, >= 1.
    """
    keep_memory()
    source, ended = iter(tasks), threading.Event()

    def check(share: float) -> None:
        del share
        if ended.is_set():
            raise KeyboardInterrupt

    def do(task: Task) -> StoredRun:
        check(0.0)
        return run_task(task, check)

    with ThreadPoolExecutor(workers) as pool:
        under_way: set[Future[StoredRun]] = set()
        try:
            while True:
                further = islice(source, THREADS_AHEAD * workers - len(under_way))
                under_way |= {pool.submit(do, task) for task in further}
                if not under_way:
                    return
                finished, under_way = wait(under_way, return_when=FIRST_COMPLETED)
                for one in finished:
                    yield one.result()
        finally:
            ended.set()


# --- a few runs whose results stay in memory ---

Shares = Callable[[Mapping[str, float]], None]  # receives the share done of every run, by name

ADVICE = (
    "Look at the memory that the run takes: it is less with fewer channels or records. Run fewer side by side, "
    "or run it by itself."
)


def _run(place: int, scenario: Scenario, file: Path | None) -> Result | Failure:
    result = simulate(scenario, progress=report, throw=False)
    if file is not None and isinstance(result, Result):
        result.save(file)
    return result


def _ignore(shares: Mapping[str, float]) -> None:
    del shares


def run_all(
    scenarios: Mapping[str, Scenario],
    *,
    workers: int | Workers = 2,
    progress: Shares = _ignore,
    files: Mapping[str, Path] | None = None,
) -> dict[str, Result | Failure]:
    """Run scenarios in parallel processes; the order given is the order in which they are started.

    Arguments:
        scenarios: what to run, by name.
        workers: number of processes, >= 1, or the pool to use.
        progress: called about ten times a second.
        files: where a run is written as soon as it has ended, by its name; none by default.

    Returns:
        For each name its Result, or the Failure that says why there is none: also of a run whose process was
        killed or crashed. Any other exception in a run (a bug, an interruption) ends all of them.
    """
    chosen = list(scenarios.values())
    jobs = [(scenario, (files or {}).get(name)) for name, scenario in scenarios.items()]

    def error_text(shares: list[float]) -> None:
        progress(dict(zip(scenarios, shares, strict=True)))

    def ended(error: ProcessEndedError) -> Failure:
        return Failure(error.reason, ADVICE, error.share * chosen[error.place].duration)

    number = workers if isinstance(workers, Workers) else min(workers, len(scenarios))
    with worker_pool(number) as pool:
        results = pool.run(jobs, _run, error_text, ended)
    return dict(zip(scenarios, results, strict=True))
