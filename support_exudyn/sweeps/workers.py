"""Processes that work side by side, and end with the one that started them.

Each is a pool of `concurrent.futures` of its own with one process: if that ends, killed or by a crash, no other
loses its work, and whose work it did is known. The pools of several processes of the standard library and of
loky are broken as a whole then and do not name the job; that of pebble waits for ever for a job that
leaves with exit code 0.
"""

from __future__ import annotations

import ctypes
import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping, MutableSequence, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from functools import partial
from multiprocessing.util import Finalize
from typing import Any, NamedTuple, TypeVar

from support_exudyn.formulations.interruption import kept_from_children

T = TypeVar("T")

CONTEXT = multiprocessing.get_context("spawn")  # the engine does not survive a fork
POLL = 0.1  # how often progress is reported [s]
NOT_BEGUN = -1.0  # in place of the share of a job that waits
TRIM_THRESHOLD, MMAP_THRESHOLD = -1, -3  # of mallopt of glibc
KEPT = 2**26  # bytes that a process keeps

# in a worker: the shared array of shares done, and its place in it
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

    def __reduce__(self) -> tuple[type[ProcessEndedError], tuple[int, float]]:
        return ProcessEndedError, (self.place, self.share)


class NoProcessError(RuntimeError):
    """Processes end before they begin any work."""

    def __init__(self) -> None:
        super().__init__(
            "processes end before they begin their work; a script that starts some must do so below "
            "if __name__ == '__main__', and there must be memory left for them"
        )


class _Job(NamedTuple):
    """A job under way: its number, its arguments, and which process does it."""

    number: int
    given: tuple[Any, ...]
    place: int


Tell = Callable[[Mapping[int, float]], None]  # receives the shares done of the jobs under way, by number


class Workers:
    """Processes for several sweeps, for starting them takes seconds; each is started when it is needed.

    The function that does a job is one of a module, and is called with the job's number, from 0, and its
    arguments, which must be picklable; it may call `report`. A job that raises ends all, those that wait are
    dropped, and its exception is raised here. NoProcessError is raised if processes end before they begin any
    job.

    Arguments:
        shares: where jobs report, a number for each process.
        pool: makes a pool of one process.
    """

    def __init__(self, shares: MutableSequence[float], pool: Callable[[], Executor]) -> None:
        self._shares, self._pool = shares, pool
        self._pools: list[Executor | None] = [None] * len(shares)

    def run(
        self,
        jobs: Sequence[tuple[Any, ...]],
        work: Callable[..., T],
        progress: Callable[[list[float]], None],
        ended: Callable[[ProcessEndedError], T] | None = None,
    ) -> list[T]:
        """What `work` returns for every job, in their order; they are started in that order too.

        A job whose process ends is done once more when all others are done, without any other at the same time.

        progress: receives the share done of every job ten times a second. ended: gives what to return for a job
        whose process ended again; without it the first such error is raised when all others are done.
        """
        found: dict[int, T | ProcessEndedError] = {}

        def tell(shares: Mapping[int, float]) -> None:
            progress([1.0 if n in found else shares.get(n, 0.0) for n in range(len(jobs))])

        def result(one: T | ProcessEndedError) -> T:
            if not isinstance(one, ProcessEndedError):
                return one
            if ended is None:
                raise one
            return ended(one)

        found.update(self.stream(jobs, work, tell))
        lost = [n for n in range(len(jobs)) if isinstance(found[n], ProcessEndedError)]
        for n in lost:
            del found[n]
        found.update(self.stream([jobs[n] for n in lost], work, tell, lost, alone=True))
        if jobs:
            tell({})
        return [result(found[n]) for n in range(len(jobs))]

    def stream(
        self,
        jobs: Iterable[tuple[Any, ...]],
        work: Callable[..., T],
        tell: Tell | None = None,
        numbers: Iterable[int] | None = None,
        *,
        alone: bool = False,
    ) -> Iterator[tuple[int, T | ProcessEndedError]]:
        """Number of a job and what `work` returns, as each ends; for any number of jobs.

        Jobs are taken as there is room for them, and nothing is held of those that have ended. Of a job whose
        process ends the error comes in place of what `work` returns.

        Arguments:
            tell: receives the shares done of the jobs under way, by number, ten times a second.
            numbers: of the jobs; from 0 on if None.
            alone: whether jobs are done one after the other.
        """
        source = enumerate(jobs) if numbers is None else zip(numbers, jobs, strict=True)
        free = list(range(1 if alone else len(self._pools)))[::-1]
        held: dict[Future[T], _Job] = {}
        try:
            while True:
                while free and (item := next(source, None)):
                    job = _Job(*item, free.pop())
                    held[self._submit(job, work)] = job
                if not held:
                    return
                for future in self._ended(held, tell):
                    job = held.pop(future)
                    free.append(job.place)
                    if isinstance(future.exception(), BrokenProcessPool):
                        yield job.number, self._lost(job)
                    else:
                        yield job.number, future.result()
        finally:
            for future in held:
                future.cancel()

    def _submit(self, job: _Job, work: Callable[..., T]) -> Future[T]:
        self._shares[job.place] = NOT_BEGUN
        doing = partial(_do, job.place, work, job.number, job.given)
        with kept_from_children():  # a process is started here
            try:
                return self._of(job.place).submit(doing)
            except (BrokenProcessPool, OSError):  # it ended while it had no work
                return self._renewed(job.place).submit(doing)

    def _of(self, place: int) -> Executor:
        found = self._pools[place]
        if found is None:
            found = self._pools[place] = self._pool()
        return found

    def _renewed(self, place: int) -> Executor:
        """Another process in place of one that has ended."""
        self._of(place).shutdown(wait=False, cancel_futures=True)
        self._pools[place] = None
        return self._of(place)

    def _ended(self, held: Mapping[Future[T], _Job], tell: Tell | None) -> set[Future[T]]:
        """Wait until any of the jobs has ended, and report meanwhile how far they are."""
        while True:
            finished, _ = wait(held, None if tell is None else POLL, FIRST_COMPLETED)
            if tell is not None:
                tell({job.number: max(0.0, self._shares[job.place]) for job in held.values()})
            if finished:
                return finished

    def _lost(self, job: _Job) -> ProcessEndedError:
        """The error of a job whose process has ended; raises NoProcessError if none can be started."""
        share = self._shares[job.place]
        pool = self._renewed(job.place)
        if share == NOT_BEGUN:
            try:
                with kept_from_children():
                    pool.submit(int).result()
            except (BrokenProcessPool, OSError):
                raise NoProcessError from None
        return ProcessEndedError(job.number, max(0.0, share))

    def close(self) -> None:
        """Drop what waits, and wait for the processes to end."""
        for pool in filter(None, self._pools):
            pool.shutdown(cancel_futures=True)


@contextmanager
def worker_pool(workers: int | Workers) -> Iterator[Workers]:
    """So many processes, or those that are there already.

    If the block ends with an exception the processes that it started end at once, in mid-work.
    """
    if isinstance(workers, Workers):
        yield workers
        return
    strangers = set(multiprocessing.active_children())
    shares = CONTEXT.Array("d", max(1, workers), lock=False)
    pool = Workers(shares, lambda: ProcessPoolExecutor(1, CONTEXT, _start, (shares,)))
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
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    keep_memory()
    Finalize(None, _leave, exitpriority=-1000)  # after all others
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


def _leave() -> None:
    """End at once, as a forked process does: to take all apart that was imported takes some tenths of a second.

    One that ends by an exception goes on to tell it.
    """
    if sys.exc_info()[0] is None:
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:
                stream.flush()
        os._exit(0)


def _end_with_parent() -> None:
    """A killed process cannot tell its workers; left alone they would wait for work for ever."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
