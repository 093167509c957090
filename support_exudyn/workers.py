"""Processes that work side by side, and end with the one that started them."""

from __future__ import annotations

import multiprocessing
import os
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_EXCEPTION, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from typing import Any, TypeVar

T = TypeVar("T")

CONTEXT = multiprocessing.get_context("spawn")  # the engine does not survive a fork
PLACES = 4096  # jobs at once whose progress can be watched
POLL = 0.1  # how often progress is told [s]

_shares: Any = None  # in a worker: the shared array of shares done


class Workers:
    """A pool of processes. Starting them takes seconds, so several sweeps share one."""

    def __init__(self, pool: ProcessPoolExecutor, shares: Any) -> None:
        self._pool = pool
        self._shares = shares

    def run(
        self, jobs: Sequence[tuple[Any, ...]], work: Callable[..., T], progress: Callable[[list[float]], None]
    ) -> list[T]:
        """What `work(place, *job)` returns for every job, in their order; they are started in that order too.

        Arguments:
            jobs: arguments for work, which like them must be picklable.
            work: a function of a module; it may call `report`.
            progress: is told the share done of every job ten times a second.

        If a job raises, those that wait are dropped and the exception is raised here.
        """
        self._shares[: min(len(jobs), PLACES)] = [0.0] * min(len(jobs), PLACES)
        futures = [self._pool.submit(work, place, *job) for place, job in enumerate(jobs)]
        try:
            waiting = set(futures)
            while waiting:
                done, waiting = wait(waiting, timeout=POLL, return_when=FIRST_EXCEPTION)
                for future in done:
                    future.result()
                progress([self._share(place, future) for place, future in enumerate(futures)])
        except BaseException:
            for future in futures:
                future.cancel()
            raise
        return [future.result() for future in futures]

    def _share(self, place: int, future: Future[T]) -> float:
        if future.done():
            return 1.0
        return float(self._shares[place]) if place < PLACES else 0.0


def report(place: int, share: float) -> None:
    """In a worker: so much of a job is done, 0 to 1."""
    if place < PLACES:
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
    with ProcessPoolExecutor(max(1, workers), CONTEXT, _start, (shares,)) as pool:
        try:
            yield Workers(pool, shares)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            for worker in set(multiprocessing.active_children()) - strangers:
                worker.terminate()  # else it would finish its work first
            raise


def _start(shares: Any) -> None:
    global _shares
    _shares = shares
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """A killed process cannot tell its workers; left alone they would wait for work for ever."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
