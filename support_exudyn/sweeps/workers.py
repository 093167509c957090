"""Processes that work side by side, and end with the one that started them.

If one of them ends in mid-work, killed or by a crash, the job that it worked on is found and the others go on.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    FIRST_EXCEPTION,
    Executor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from functools import partial
from typing import Any, TypeVar

from support_exudyn.formulations.interruption import kept_from_children

T = TypeVar("T")

CONTEXT = multiprocessing.get_context("spawn")  # the engine does not survive a fork
PLACES = 4096  # jobs at once whose progress can be watched
AHEAD = 2  # jobs of a stream for each process, one of them waiting
POLL = 0.1  # how often progress is told [s]
NOT_BEGUN = -1.0  # in place of the share of a job that waits
TRIES = 2  # pools in a row whose processes may end before any work has begun
SOON = 5.0  # a process that has ended is known to within [s]

_shares: Any = None  # in a worker: the shared array of shares done


class ProcessEndedError(RuntimeError):
    """The process of a job ended, killed or by a crash, and so did another that had nothing but this job.

    place: of the job, from 0. share: that was done when it was last told. code: exit code, negative: the number
    of the signal, None: not known.
    """

    def __init__(self, place: int, share: float, code: int | None) -> None:
        self.place, self.share, self.code = place, share, code
        super().__init__(f"job {place + 1}: {self.reason}")

    @property
    def reason(self) -> str:
        """What happened, whatever the job."""
        return f"the process that computed it ended: {_told(self.code)}"

    def __reduce__(self) -> tuple[type[ProcessEndedError], tuple[int, float, int | None]]:
        return ProcessEndedError, (self.place, self.share, self.code)


class NoProcessError(RuntimeError):
    """Processes end before they begin any work."""

    def __init__(self) -> None:
        super().__init__(
            "processes end before they begin their work; a script that starts some must do so below "
            "if __name__ == '__main__', and there must be memory left for them"
        )


class Workers:
    """A pool of processes. Starting them takes seconds, so several sweeps share one."""

    def __init__(self, pool: Executor, shares: Any, size: int = 1) -> None:
        self._pool = pool
        self._shares = shares
        self._size = size
        self._code: Callable[[], int | None] = lambda: None  # with which the processes have ended

    def run(
        self,
        jobs: Sequence[tuple[Any, ...]],
        work: Callable[..., T],
        progress: Callable[[list[float]], None],
        ended: Callable[[ProcessEndedError], T] | None = None,
    ) -> list[T]:
        """What `work(place, *job)` returns for every job, in their order; they are started in that order too.

        Arguments:
            jobs: arguments for work, which like them must be picklable.
            work: a function of a module; it may call `report`.
            progress: is told the share done of every job ten times a second.
            ended: gives what to return for a job whose process ended.

        If a job raises, those that wait are dropped and the exception is raised here. If a process ends, the
        jobs that were begun are done once more, one at a time; of the one whose process ends again `ended` is
        told, or its ProcessEndedError is raised when all others are done. Raises NoProcessError if processes
        end before they begin any.
        """
        done: dict[int, T] = {}
        lost: dict[int, ProcessEndedError] = {}

        def go(places: Sequence[int]) -> bool:
            def tell(shares: Mapping[int, float]) -> None:
                progress([1.0 if n in done or n in lost else shares.get(n, 0.0) for n in range(len(jobs))])

            return self._go({place: jobs[place] for place in places}, work, tell, done)

        tries = TRIES
        while (left := [n for n in range(len(jobs)) if n not in done and n not in lost]) and not go(left):
            begun = [n for n in left if n not in done and n < PLACES and self._shares[n] != NOT_BEGUN]
            tries = TRIES if begun else tries - 1
            if not tries:
                raise NoProcessError
            try:
                for place in begun:
                    self._renew(1)
                    if not go([place]):
                        lost[place] = ProcessEndedError(place, max(0.0, self._shares[place]), self._code())
            finally:
                self._renew(self._size)
        if lost:
            progress([1.0] * len(jobs))  # since they were last told
            if ended is None:
                raise lost[min(lost)]
        return [done[n] if n in done or ended is None else ended(lost[n]) for n in range(len(jobs))]

    def stream(
        self, jobs: Iterable[tuple[Any, ...]], work: Callable[..., T]
    ) -> Iterator[tuple[int, T | ProcessEndedError]]:
        """Number of a job and what `work(place, *job)` returns, as each ends; for any number of jobs.

        Jobs are taken as there is room for them, and nothing is held of those that have ended. As with `run`, a
        job that raises ends all, and after the end of a process the jobs that were begun are done once more,
        one at a time; in place of what one returns whose process ends again stands its ProcessEndedError.
        """
        source = enumerate(jobs)
        free = list(range(min(PLACES, AHEAD * self._size)))
        again: deque[tuple[int, tuple[Any, ...]]] = deque()
        held: dict[Future[T], tuple[int, int, tuple[Any, ...]]] = {}  # place, number, job
        tries = TRIES
        try:
            while True:
                whole = True
                while whole and free and (item := again.popleft() if again else next(source, None)):
                    place = free.pop()
                    self._shares[place] = NOT_BEGUN
                    try:
                        with kept_from_children():
                            held[self._pool.submit(_do, place, work, item[1])] = (place, *item)
                    except BrokenProcessPool:
                        free.append(place)
                        again.appendleft(item)
                        whole = False
                if not held and whole:
                    return
                finished, _ = wait(held, return_when=FIRST_COMPLETED if whole else "ALL_COMPLETED")
                if any(isinstance(future.exception(), BrokenProcessPool) for future in finished):
                    whole = False
                    finished, _ = wait(held)
                lost = []
                for future in finished:
                    place, number, job = held.pop(future)
                    free.append(place)
                    if isinstance(future.exception(), BrokenProcessPool):
                        lost.append((number, place, job))
                    else:
                        tries = TRIES
                        yield number, future.result()
                if whole:
                    continue
                begun = [item for item in sorted(lost) if self._shares[item[1]] != NOT_BEGUN]
                again.extend(
                    (number, job) for number, place, job in sorted(lost) if (number, place, job) not in begun
                )
                tries = TRIES if begun else tries - 1
                if not tries:
                    raise NoProcessError
                yield from self._once_more(begun, work)
        finally:
            _cancel(dict(enumerate(held)))

    def _once_more(
        self, begun: Sequence[tuple[int, int, tuple[Any, ...]]], work: Callable[..., T]
    ) -> Iterator[tuple[int, T | ProcessEndedError]]:
        """Jobs beside which a process has ended, by number and place: each by itself, then a new pool."""
        try:
            for number, place, job in begun:
                self._renew(1)
                done: dict[int, T] = {}
                if self._go({place: job}, work, lambda shares: None, done):
                    yield number, done[place]
                else:
                    yield number, ProcessEndedError(number, max(0.0, self._shares[place]), self._code())
        finally:
            self._renew(self._size)

    def _go(
        self,
        jobs: Mapping[int, tuple[Any, ...]],
        work: Callable[..., T],
        tell: Callable[[Mapping[int, float]], None],
        done: dict[int, T],
    ) -> bool:
        """Do jobs, by their place; what they return goes into `done`. Whether no process has ended."""
        futures: dict[int, Future[T]] = {}
        whole = True
        others = set(multiprocessing.active_children())
        try:
            with kept_from_children():  # they are started here
                for place, job in jobs.items():
                    if place < PLACES:
                        self._shares[place] = NOT_BEGUN
                    futures[place] = self._pool.submit(_do, place, work, job)
                started = set(multiprocessing.active_children()) - others
                self._code = partial(_exit_code, self._pool, started)
        except BrokenProcessPool:
            whole = False
        except BaseException:
            _cancel(futures)
            raise
        try:
            waiting = set(futures.values())
            while waiting:
                finished, waiting = wait(waiting, timeout=POLL, return_when=FIRST_EXCEPTION)
                for future in finished:
                    error = future.exception()
                    if isinstance(error, BrokenProcessPool):
                        whole = False
                    elif error is not None:
                        raise error
                tell({place: self._share(place, future) for place, future in futures.items()})
        except BaseException:
            _cancel(futures)
            raise
        done.update({n: future.result() for n, future in futures.items() if future.exception() is None})
        return whole

    def _share(self, place: int, future: Future[T]) -> float:
        if future.done() and future.exception() is None:
            return 1.0
        return max(0.0, float(self._shares[place])) if place < PLACES else 0.0

    def _renew(self, size: int) -> None:
        """Go on with so many new processes."""
        self._pool.shutdown(wait=False, cancel_futures=True)
        self._pool = _pool(size, self._shares)

    def close(self) -> None:
        """Drop what waits, and wait for the processes to end."""
        self._pool.shutdown(cancel_futures=True)


def report(place: int, share: float) -> None:
    """In a worker: so much of a job is done, 0 to 1."""
    if _shares is not None and place < PLACES:
        _shares[place] = share


@contextmanager
def worker_pool(workers: int | Workers) -> Iterator[Workers]:
    """A pool of so many processes, or the one that is there already.

    If the block ends with an exception the processes that it started end at once, in mid-work.
    """
    if isinstance(workers, Workers):
        yield workers
        return
    strangers = set(multiprocessing.active_children())
    shares = CONTEXT.Array("d", PLACES, lock=False)
    size = max(1, workers)
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


def _cancel(futures: Mapping[int, Future[T]]) -> None:
    for future in futures.values():
        future.cancel()


def _exit_code(pool: Executor, processes: set[Any]) -> int | None:
    """Of the process that there was; None if that is not known."""
    pool.shutdown(
        cancel_futures=True
    )  # its thread asks for the code, too; not all kinds of processes tell it twice
    for process in processes:
        process.join(SOON)
        return process.exitcode  # type: ignore[no-any-return]
    return None


def _told(code: int | None) -> str:
    """What an exit code means."""
    if code is None:
        return "the system does not tell why"
    if code >= 0:
        return f"exit code {code}"
    named = {item.value: item.name for item in signal.Signals}.get(-code, "unknown")
    return f"signal {-code} ({named}{', out of memory?' if named == 'SIGKILL' else ''})"


# --- in a worker ---


def _start(shares: Any) -> None:
    global _shares
    _shares = shares
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _do(place: int, work: Callable[..., T], job: tuple[Any, ...]) -> T:
    report(place, 0.0)  # it has begun
    return work(place, *job)


def _end_with_parent() -> None:
    """A killed process cannot tell its workers; left alone they would wait for work for ever."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
