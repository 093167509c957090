"""All cases and long runs in parallel processes, each watched: hangs and crashes are silent failures, too."""

import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from studies.common.runs import bar
from studies.extremes import judge, long_runs
from studies.extremes.cases import BOX, CLEARANCE_SPEED
from studies.extremes.judge import SILENT, Case, Judgement
from studies.extremes.long_runs import LongRun
from support_exudyn import SimulationError
from support_exudyn.sweeps.workers import ProcessEndedError, Workers, report, worker_pool

PATIENCE = 300.0  # [s]; a run that takes longer hangs
# what a scene takes on average [s], of those that do not take a second: the longest are begun first
SECONDS = {
    "dead centre": 12.0, "slider-crank": 8.0, "space": 4.0, "hang-up": 3.0, BOX: 2.0, CLEARANCE_SPEED: 1.5,
}  # fmt: skip
OTHERS = 0.8  # [s]
OF_LONG = 15.0  # [s], of a long run
Job = tuple[Any, ...]


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


def judged(case: Case) -> Judgement:
    """Judge a case, in a worker."""
    report(0.0)
    try:
        with patience(PATIENCE):
            return judge.judge(case.scenario)
    except HangError as error:
        return Judgement(SILENT, f"hang: {error}")


def lasted(name: str, duration: float) -> LongRun | str:
    """Make a long run, in a worker; return why there is none if it fails."""
    try:
        return long_runs.run(long_runs.scene(name, duration), name, report)
    except SimulationError as error:
        return str(error)


def run_all(
    cases: Sequence[Case], durations: dict[str, float], workers: int | Workers
) -> tuple[list[Judgement], dict[str, LongRun | str]]:
    """Verdicts on cases, in their order, and long runs by name, under a progress bar.

    Arguments:
        cases: the cases.
        durations: of long runs, by their names [s].
        workers: number of processes, or a pool.

    A long run that failed says why.
    """
    jobs: list[tuple[float, Job]] = [
        (OF_LONG, (lasted, name, duration)) for name, duration in durations.items()
    ]
    jobs += [(SECONDS.get(case.group, OTHERS), (judged, case)) for case in cases]
    order = sorted(range(len(jobs)), key=lambda n: -jobs[n][0])
    seconds = [jobs[n][0] for n in order]
    mean = sum(seconds) / max(1, len(seconds))

    def crashed(error: ProcessEndedError) -> Judgement | str:
        said = f"crash: {error.reason}"
        return said if order[error.place] < len(durations) else Judgement(SILENT, said)

    title = f"{len(cases)} scenes" + (f", {len(durations)} long runs" if durations else "")
    with worker_pool(workers) as pool, bar(title) as told:

        def tell(shares: Sequence[float]) -> None:
            told([share * one / mean for share, one in zip(shares, seconds, strict=True)])

        found = pool.run([jobs[n][1] for n in order], _do, tell, crashed)
    results = [one for _, one in sorted(zip(order, found, strict=True), key=lambda pair: pair[0])]
    verdicts = [one for one in results if isinstance(one, Judgement)]
    return verdicts, {
        name: one for name, one in zip(durations, results, strict=False) if not isinstance(one, Judgement)
    }


def _do(place: int, work: Callable[..., Judgement | LongRun | str], *given: Any) -> Judgement | LongRun | str:
    del place
    return work(*given)
