"""Workers that do every job at once, in the test's own process: no process has to be started."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor, Future
from typing import Any

from support_exudyn.sweeps.workers import Workers


class AtOnce(Executor):
    """An executor whose futures are done when they are handed out."""

    def submit(self, work: Callable[..., Any], /, *arguments: Any, **named: Any) -> Future[Any]:
        future: Future[Any] = Future()
        try:
            future.set_result(work(*arguments, **named))
        except Exception as error:
            future.set_exception(error)
        return future


def at_once() -> Workers:
    """What studies, sweeps and `run_all` take in place of a number of workers."""
    return Workers([0.0, 0.0], AtOnce)
