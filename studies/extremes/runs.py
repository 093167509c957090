"""All cases and long runs in parallel processes, each watched: hangs and crashes are silent failures, too."""

import signal
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

from studies.common.runs import bar
from studies.extremes import judge, long_runs
from studies.extremes.judge import SILENT, Case, Judgement
from studies.extremes.long_runs import LongRun
from support_exudyn import SimulationError
from support_exudyn.sweeps.workers import Workers, report, worker_pool

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


def judged(place: int, case: Case) -> Judgement:
    """Judge a case, in a worker."""
    del place
    report(0.0)
    try:
        with patience(PATIENCE):
            return judge.judge(case.scenario)
    except HangError as error:
        return Judgement(SILENT, f"hang: {error}")


def lasted(place: int, name: str, duration: float) -> LongRun | str:
    """Make a long run, in a worker; return why there is none if it fails."""
    del place
    try:
        return long_runs.run(long_runs.SCENES[name](duration), report)
    except SimulationError as error:
        return str(error)


def judge_all(cases: Sequence[Case], workers: int | Workers) -> list[Judgement]:
    """Verdicts on cases, in their order, under a progress bar.

    workers: number of processes, or a pool.
    """
    with worker_pool(workers) as pool, bar(f"{len(cases)} scenes") as told:
        return pool.run(
            [(case,) for case in cases],
            judged,
            told,
            lambda error: Judgement(SILENT, f"crash: {error.reason}"),
        )


def run_long(durations: Mapping[str, float], workers: int | Workers) -> dict[str, LongRun | str]:
    """Long runs by their names, under a progress bar; of a run that failed why.

    durations: of the runs [s]. workers: number of processes, or a pool.
    """
    with worker_pool(workers) as pool, bar(f"{len(durations)} long runs") as told:
        found = pool.run([*durations.items()], lasted, told, lambda error: f"crash: {error.reason}")
    return dict(zip(durations, found, strict=True))
