"""Processes that work side by side, and end with the one that started them."""

from __future__ import annotations

import multiprocessing
import os
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from typing import Any

CONTEXT = multiprocessing.get_context("spawn")  # the engine does not survive a fork


def _nothing() -> None:
    pass


@contextmanager
def worker_pool(
    workers: int, start: Callable[..., None] = _nothing, arguments: tuple[Any, ...] = ()
) -> Iterator[ProcessPoolExecutor]:
    """A pool of so many processes. If the block ends with an exception they end at once, in mid-work.

    Arguments:
        workers: number of processes, >= 1.
        start: called with the arguments once in every process.
    """
    strangers = set(multiprocessing.active_children())
    with ProcessPoolExecutor(workers, CONTEXT, _start, (start, arguments)) as pool:
        try:
            yield pool
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            for worker in set(multiprocessing.active_children()) - strangers:
                worker.terminate()  # else it would finish its work first
            raise


def _start(start: Callable[..., None], arguments: tuple[Any, ...]) -> None:
    threading.Thread(target=_end_with_parent, daemon=True).start()
    start(*arguments)


def _end_with_parent() -> None:
    """A killed process cannot tell its workers; left alone they would wait for work for ever."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
