"""Processes that work side by side, and end with the one that started them.

The pool of `concurrent.futures` is broken as a whole when one of its processes ends, killed or by a crash. Here
the jobs that were under way are then done once more, one at a time in a process of their own, and all others go
on in a new pool. A job whose process ends again has an error of its own.
"""

from __future__ import annotations

import ctypes
import multiprocessing
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from multiprocessing.util import Finalize
from typing import Any, NamedTuple, TypeVar

from support_exudyn.formulations.interruption import kept_from_children

T = TypeVar("T")

CONTEXT = multiprocessing.get_context("spawn")  # the engine does not survive a fork
AHEAD = 2  # jobs for each process, one of them waiting
POLL = 0.1  # how often progress is reported [s]
NOT_BEGUN = -1.0  # in place of the share of a job that waits
MOMENT = 0.2  # [s]
TRIM_THRESHOLD, MMAP_THRESHOLD = -1, -3  # of mallopt of glibc
KEPT = 2**26  # bytes that a process keeps

# in a worker: the shared array of shares done, and the place in it of the job at work
_shares: Any = None
_slot = 0


class ProcessEndedError(RuntimeError):
    """The process of a job ended, killed or by a crash, and so did another that had nothing but this job.

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
    """A job under way: its number, its arguments, and where its share is reported."""

    number: int
    given: tuple[Any, ...]
    slot: int


Tell = Callable[[Mapping[int, float]], None]  # receives the shares done of the jobs under way, by number


class Workers:
    """A pool of processes. Starting them takes seconds, so several sweeps share one.

    The function that does a job is one of a module, and is called with the job's number, from 0, and its
    arguments, which must be picklable; it may call `report`. A job that raises ends all, those that wait are
    dropped, and its exception is raised here. NoProcessError is raised if processes end before they begin any
    job.
    """

    def __init__(self, pool: Executor, shares: Any, size: int = 1) -> None:
        self._pool = pool
        self._shares = shares
        self._size = size

    def run(
        self,
        jobs: Sequence[tuple[Any, ...]],
        work: Callable[..., T],
        progress: Callable[[list[float]], None],
        ended: Callable[[ProcessEndedError], T] | None = None,
    ) -> list[T]:
        """What `work` returns for every job, in their order; they are started in that order too.

        progress: receives the share done of every job ten times a second. ended: gives what to return for a job
        whose process ended; without it the first such error is raised when all others are done.
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
        if jobs:
            tell({})
        return [result(found[n]) for n in range(len(jobs))]

    def stream(
        self, jobs: Iterable[tuple[Any, ...]], work: Callable[..., T], tell: Tell | None = None
    ) -> Iterator[tuple[int, T | ProcessEndedError]]:
        """Number of a job and what `work` returns, as each ends; for any number of jobs.

        Jobs are taken as there is room for them, and nothing is held of those that have ended.

        tell: receives the shares done of the jobs under way, by number, ten times a second.
        """
        source = enumerate(jobs)
        free = list(range(AHEAD * self._size))
        held: dict[Future[T], _Job] = {}
        try:
            while True:
                lost: list[_Job] = []
                while free and not lost and (item := next(source, None)):
                    job = _Job(*item, free.pop())
                    try:
                        held[self._submit(job, work)] = job
                    except BrokenProcessPool:
                        lost.append(job)
                if not held and not lost:
                    return
                finished = self._ended(held, tell, whole=bool(lost))
                if any(map(_is_broken, finished)):  # then all that are under way end now
                    finished = self._ended(held, None, whole=True)
                for future in finished:
                    job = held.pop(future)
                    if _is_broken(future):
                        lost.append(job)
                    else:
                        free.append(job.slot)
                        yield job.number, future.result()
                if not lost:
                    continue
                self._renew(1)
                try:
                    for job in sorted(lost):
                        free.append(job.slot)
                        yield job.number, self._alone(job, work, tell)
                finally:
                    self._renew(self._size)
        finally:
            for future in held:
                future.cancel()

    def _submit(self, job: _Job, work: Callable[..., T]) -> Future[T]:
        self._shares[job.slot] = NOT_BEGUN
        with kept_from_children():  # they are started here
            try:
                return self._pool.submit(_do, job.slot, work, job.number, job.given)
            except OSError as error:  # a process ended while another was being started
                time.sleep(MOMENT)
                raise BrokenProcessPool from error

    def _ended(self, held: Mapping[Future[T], _Job], tell: Tell | None, whole: bool) -> set[Future[T]]:
        """Wait until any of the jobs has ended, or all of them, and report meanwhile how far they are."""
        waiting: set[Future[T]] = set(held)
        while waiting:
            _, waiting = wait(waiting, None if tell is None else POLL, FIRST_COMPLETED)
            if tell is not None:
                tell({job.number: self._share(job) for job in held.values()})
            if not whole and len(waiting) < len(held):
                break
        return set(held) - waiting

    def _alone(self, job: _Job, work: Callable[..., T], tell: Tell | None) -> T | ProcessEndedError:
        """Do a job that was under way when a process ended by itself, until it has been begun twice."""
        for _ in range(2 if self._shares[job.slot] == NOT_BEGUN else 1):
            try:
                with kept_from_children():
                    self._pool.submit(int).result()  # so that a process can be started at all
            except (BrokenProcessPool, OSError):
                raise NoProcessError from None
            try:
                future = self._submit(job, work)
                self._ended({future: job}, tell, whole=True)
                return future.result()
            except BrokenProcessPool:
                self._renew(1)
        return ProcessEndedError(job.number, self._share(job))

    def _share(self, job: _Job) -> float:
        """The share of a job that is done."""
        return max(0.0, float(self._shares[job.slot]))

    def _renew(self, size: int) -> None:
        """Go on with so many new processes."""
        self._pool.shutdown(wait=False, cancel_futures=True)
        self._pool = _pool(size, self._shares)

    def close(self) -> None:
        """Drop what waits, and wait for the processes to end."""
        self._pool.shutdown(cancel_futures=True)


def _is_broken(future: Future[Any]) -> bool:
    return isinstance(future.exception(), BrokenProcessPool)


@contextmanager
def worker_pool(workers: int | Workers) -> Iterator[Workers]:
    """A pool of so many processes, or the one that is there already.

    If the block ends with an exception the processes that it started end at once, in mid-work.
    """
    if isinstance(workers, Workers):
        yield workers
        return
    strangers = set(multiprocessing.active_children())
    size = max(1, workers)
    shares = CONTEXT.Array("d", AHEAD * size, lock=False)
    pool = Workers(_pool(size, shares), shares, size)
    try:
        yield pool
    except BaseException:
        for worker in set(multiprocessing.active_children()) - strangers:
            worker.terminate()  # else it would finish its work first
        raise
    finally:
        pool.close()


def _pool(size: int, shares: Any) -> Executor:
    return ProcessPoolExecutor(size, CONTEXT, _start, (shares,))


# --- in a worker ---


def report(share: float) -> None:
    """Report that so much of the job at work is done, 0 to 1; elsewhere than in a worker nothing happens."""
    if _shares is not None:
        _shares[_slot] = share


def _start(shares: Any) -> None:
    global _shares
    _shares = shares
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    keep_memory()
    Finalize(None, _leave, exitpriority=-1000)  # after all others
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _do(slot: int, work: Callable[..., T], number: int, given: tuple[Any, ...]) -> T:
    global _slot
    _slot = slot
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
