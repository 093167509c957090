"""Processes that work side by side, and end with the one that started them."""

from __future__ import annotations

import ctypes
import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping, MutableSequence, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from functools import partial
from typing import Any, NoReturn, TypeVar

from support_exudyn.formulations.interruption import kept_from_children

T = TypeVar("T")
Job = tuple[int, tuple[Any, ...]]  # its number, and its arguments
Tell = Callable[[Mapping[int, float]], None]  # receives the shares done of the jobs under way, by number

CONTEXT = multiprocessing.get_context("spawn")  # the engine does not survive a fork
POLL = 0.1  # how often progress is reported [s]
AHEAD = 2  # jobs for each process, one of them waiting
NOT_BEGUN = -1.0  # in place of the share of a job that waits
TRIM_THRESHOLD, MMAP_THRESHOLD = -1, -3  # of mallopt of glibc
KEPT = 2**26  # bytes that a process keeps

# in a worker: the shared array of shares done, and the place of the job at work
_shares: Any = None
_place = 0


class ProcessEndedError(RuntimeError):
    """The process of a job ended, killed or by a crash.

    place: of the job, from 0. share: that was done when it was last reported.
    """

    reason = "the process that computed it ended: killed (out of memory?), or by a crash"

    def __init__(self, place: int, share: float) -> None:
        self.place, self.share = place, share
        super().__init__(f"job {place + 1}: {self.reason}")


class NoProcessError(RuntimeError):
    """Processes end before they begin any work."""

    def __init__(self) -> None:
        super().__init__(
            "processes end before they begin their work; a script that starts some must do so below "
            "if __name__ == '__main__', and there must be memory left for them"
        )


def _raised(error: ProcessEndedError) -> NoReturn:
    raise error


class Workers:
    """Processes for several sweeps, for starting them takes seconds; each is started when it is needed.

    The function that does a job is one of a module, and is called with the job's number, from 0, and its
    arguments, which must be picklable; it may call `report`. A job that raises ends all, those that wait are
    dropped, and its exception is raised here. NoProcessError is raised if processes end before they begin any
    job.

    Arguments:
        shares: where jobs report, a number for each job that may be under way, and one for the start.
        pool: makes the pool of processes, anew if one of them ends.
    """

    def __init__(self, shares: MutableSequence[float], pool: Callable[[], Executor]) -> None:
        self._shares, self._new = shares, pool
        self._pool: Executor | None = None

    def run(
        self,
        jobs: Sequence[tuple[Any, ...]],
        work: Callable[..., T],
        progress: Callable[[list[float]], None],
        ended: Callable[[ProcessEndedError], T] = _raised,
    ) -> list[T]:
        """What `work` returns for every job, in their order; they are started in that order too.

        progress: receives the share done of every job ten times a second. ended: gives what to return for a job
        whose process ended, see `stream`; by default that is raised.
        """
        found: dict[int, T | ProcessEndedError] = {}

        def tell(shares: Mapping[int, float]) -> None:
            progress([1.0 if n in found else shares.get(n, 0.0) for n in range(len(jobs))])

        found.update(self.stream(jobs, work, tell))
        if jobs:
            tell({})
        results = (found[n] for n in range(len(jobs)))
        return [ended(one) if isinstance(one, ProcessEndedError) else one for one in results]

    def stream(
        self, jobs: Iterable[tuple[Any, ...]], work: Callable[..., T], tell: Tell | None = None
    ) -> Iterator[tuple[int, T | ProcessEndedError]]:
        """Number of a job and what `work` returns, as each ends; for any number of jobs.

        Jobs are taken as there is room for them, and nothing is held of those that have ended. If a process
        ends, the standard library ends all others. Each job that was under way is done at the end by itself;
        if its process ends then, the error comes in place of what `work` returns.

        tell: receives the shares done of the jobs under way, by number, ten times a second.
        """
        source: Iterator[Job] = iter(enumerate(jobs))
        free = list(range(len(self._shares) - 1))
        lost: list[Job] | None = []  # None while they are done by themselves
        held: dict[Future[T], tuple[Job, int, Executor]] = {}
        try:
            while True:
                while free and (job := next(source, None)) is not None:
                    place = free.pop()
                    held[self._submit(job, place, work)] = job, place, self._running()
                if not held:
                    if not lost:
                        return
                    source, free, lost = iter(lost), [0], None
                    continue
                finished, _ = wait(held, None if tell is None else POLL, FIRST_COMPLETED)
                if tell is not None:
                    tell({job[0]: max(0.0, self._shares[place]) for job, place, _ in held.values()})
                for future in finished:
                    job, place, pool = held.pop(future)
                    free.append(place)
                    if not isinstance(future.exception(), BrokenProcessPool):
                        yield job[0], future.result()
                        continue
                    self._renew(pool)
                    if lost is None:
                        yield job[0], ProcessEndedError(job[0], max(0.0, self._shares[place]))
                    else:
                        lost.append(job)
        finally:
            for future in held:
                future.cancel()

    def _submit(self, job: Job, place: int, work: Callable[..., T]) -> Future[T]:
        self._shares[place] = NOT_BEGUN
        number, given = job
        doing = partial(_do, place, work, number, given)
        with kept_from_children():  # a process is started here
            try:
                return self._running().submit(doing)
            except (BrokenProcessPool, OSError):  # a process ended without work
                self._renew(self._running())
                return self._running().submit(doing)

    def _running(self) -> Executor:
        if self._pool is None:
            self._shares[-1] = NOT_BEGUN
            self._pool = self._new()
        return self._pool

    def _renew(self, ended: Executor) -> None:
        """Take another pool in place of one that has ended. Raises NoProcessError if it never began."""
        if self._pool is ended:
            self.close()
            if self._shares[-1] == NOT_BEGUN:
                raise NoProcessError

    def close(self) -> None:
        """Drop what waits, and wait for the processes to end."""
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)
            self._pool = None


@contextmanager
def worker_pool(workers: int | Workers) -> Iterator[Workers]:
    """So many processes, or those that are there already.

    If the block ends with an exception the processes that it started end at once, in mid-work.
    """
    if isinstance(workers, Workers):
        yield workers
        return
    number, strangers = max(1, workers), set(multiprocessing.active_children())
    shares = CONTEXT.Array("d", AHEAD * number + 1, lock=False)
    pool = Workers(shares, lambda: ProcessPoolExecutor(number, CONTEXT, _start, (shares,)))
    try:
        yield pool
    except BaseException:
        for worker in set(multiprocessing.active_children()) - strangers:
            worker.terminate()  # else it would finish its work first
        raise
    finally:
        pool.close()


# --- in a worker ---


def report(share: float) -> None:
    """Report that so much of the job at work is done, 0 to 1; elsewhere than in a worker nothing happens."""
    if _shares is not None:
        _shares[_place] = share


def _start(shares: Any) -> None:
    global _shares
    _shares = shares
    _shares[-1] = 0.0
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    keep_memory()
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _do(place: int, work: Callable[..., T], number: int, given: tuple[Any, ...]) -> T:
    global _place
    _place = place
    report(0.0)  # it has begun
    return work(number, *given)


def keep_memory() -> None:
    """Let the C library keep what a run gives back, for the next one.

    Otherwise the system takes and clears thousands of pages in every run, which takes longer than the run is
    written. Only glibc can be told so.
    """
    with suppress(OSError, AttributeError, TypeError):
        library = ctypes.CDLL(None)
        for option in (TRIM_THRESHOLD, MMAP_THRESHOLD):
            library.mallopt(option, KEPT)


def _end_with_parent() -> None:
    """A killed process cannot tell its workers; left alone they would wait for work for ever."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
