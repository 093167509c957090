"""All cases and long runs in parallel processes, each watched: hangs and crashes are silent failures, too."""

import signal
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from typing import Any

from studies.common.runs import bar
from studies.extremes import long_runs
from studies.extremes.cases import cases
from studies.extremes.judge import SILENT, Case, Judgement, judge
from studies.extremes.long_runs import LongRun
from support_exudyn import SimulationError
from support_exudyn.sweeps.workers import ProcessEndedError, Workers, report, worker_pool

PATIENCE = 300.0  # [s]; a run that takes longer hangs


class HangError(BaseException):
    """A run has taken too long. No Exception: nothing that judges or mends failures is to take it for one."""


@contextmanager
def patience(seconds: float) -> Iterator[None]:
    """Raise HangError if the block takes longer [s]; where the system knows no alarm it may take any time."""
    if not hasattr(signal, "setitimer"):
        yield
        return

    def too_long(number: int, frame: Any) -> None:
        del number, frame
        raise HangError(f"no end after {seconds:g} s")

    before = signal.signal(signal.SIGALRM, too_long)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


@cache
def _cases(quick: bool) -> list[Case]:
    return cases(quick)


def judged(place: int, quick: bool, number: int) -> Judgement:
    """Judge a case, in a worker."""
    report(0.0)
    try:
        with patience(PATIENCE):
            return judge(_cases(quick)[number].scenario)
    except HangError as error:
        return Judgement(SILENT, f"hang: {error}")


def lasted(place: int, name: str, duration: float) -> LongRun | str:
    """Make a long run, in a worker; return why there is none if it fails."""
    try:
        return long_runs.run(long_runs.scene(name, duration), name, report)
    except SimulationError as error:
        return str(error)


def run_cases(
    found: Sequence[Case], quick: bool, workers: int | Workers, places: Sequence[int] | None = None
) -> list[Judgement]:
    """Verdicts on cases, in their order, under a progress bar.

    Arguments:
        found: the cases.
        quick: whether they are those of the quick form.
        workers: number of processes, or a pool.
        places: where each stands among all cases of that form; None: they are all of them.
    """

    def crashed(error: ProcessEndedError) -> Judgement:
        return Judgement(SILENT, f"crash: {error.reason}")

    jobs = [(quick, number) for number in (range(len(found)) if places is None else places)]
    with worker_pool(workers) as pool, bar(f"{len(found)} scenes") as told:
        return pool.run(jobs, judged, told, crashed)


def run_long(duration: float, workers: int | Workers) -> dict[str, LongRun | str]:
    """Long runs by name; those that failed say why."""
    jobs = [(name, duration) for name in long_runs.SCENES]
    with worker_pool(workers) as pool, bar(f"{len(jobs)} long runs") as told:
        found = pool.run(jobs, lasted, told, lambda error: f"crash: {error.reason}")
    return dict(zip(long_runs.SCENES, found, strict=True))
