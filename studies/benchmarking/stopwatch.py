"""Measurements in a process of their own, so that one that takes too long can be ended.

A measurement is a generator. What it yields is sent as it comes, so a part of it is not lost with the rest.
"""

import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing.connection import Connection
from typing import Any, NamedTuple

from studies.benchmarking.row import LeftOutError
from support_exudyn import SimulationError
from support_exudyn.formulations.interruption import kept_from_children
from support_exudyn.sweeps.workers import CONTEXT

SHORT_RUN = 0.1  # shorter ones are done again until they have taken so long [s]
MOST_REPEATS = 20
COARSE = 1e-5  # a clock of the processor that ticks so slowly is not used [s]
BEGIN, END = 60.0, 5.0  # time for a process to begin and to end [s]
clock = time.process_time if time.get_clock_info("process_time").resolution <= COARSE else time.perf_counter
ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
BEGUN, SAID, DONE, FAILED = "begun", "said", "done", "failed"


class Heard(NamedTuple):
    """What a measurement said, and why it ended early; empty if it did not."""

    said: list[Any]
    reason: str


def fastest(run: Callable[[], object]) -> float:
    """Processor time of a run [s]; of a short one the least of several."""
    least, spent = float("inf"), 0.0
    for _ in range(MOST_REPEATS):
        began = clock()
        run()
        took = clock() - began
        least, spent = min(least, took), spent + took
        if spent >= SHORT_RUN:
            break
    return max(least, 1e-9)


class Stopwatch:
    """The process that measures; a new one is started after one had to be ended."""

    def __init__(self) -> None:
        self._process: Any = None
        self._pipe: Any = None

    def measure(self, work: Callable[..., Iterator[Any]], given: tuple[Any, ...], most: float) -> Heard:
        """All that a measurement yields within a time [s].

        work: of a module, a generator; given: its arguments, which can be pickled.
        """
        said: list[Any] = []
        try:
            if self._process is None:
                self._start()
            until = time.monotonic() + most
            self._pipe.send((work, given))
            while True:
                if not self._pipe.poll(max(0.0, until - time.monotonic())):
                    self.stop()
                    return Heard(said, f"ended after {most:.0f} s")
                kind, what = self._pipe.recv()
                if kind != SAID:
                    return Heard(said, what)
                said.append(what)
        except (EOFError, OSError):
            self.stop()
            return Heard(said, "its process ended")

    def stop(self) -> None:
        """End the process, whatever it does."""
        if self._process is not None:
            self._process.kill()
            self._process.join(END)
            self._pipe.close()
            self._process = None

    def _start(self) -> None:
        self._pipe, other = CONTEXT.Pipe()
        process = CONTEXT.Process(target=_serve, args=(other,), daemon=True)
        with kept_from_children(), on_one_core():
            process.start()
        self._process = process
        other.close()
        if not self._pipe.poll(BEGIN):
            raise OSError("the process does not begin")
        self._pipe.recv()


@contextmanager
def on_one_core() -> Iterator[None]:
    """Processes that are started in the block do their linear algebra on one core: others would count twice."""
    before = {name: os.environ.get(name) for name in ONE_THREAD}
    os.environ.update(ONE_THREAD)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


@contextmanager
def stopwatch() -> Iterator[Stopwatch]:
    """A stopwatch that is stopped at the end."""
    watch = Stopwatch()
    try:
        yield watch
    finally:
        watch.stop()


def _serve(pipe: Connection) -> None:
    """Work of the process: one measurement after the other, until the one that asks for them is gone."""
    try:
        pipe.send(BEGUN)
        while True:
            work, given = pipe.recv()
            try:
                for what in work(*given):
                    pipe.send((SAID, what))
            except SimulationError as error:
                pipe.send((FAILED, error.failure.reason))
            except LeftOutError as error:
                pipe.send((FAILED, str(error)))
            except Exception as error:  # whatever another program raises is a row of the table
                pipe.send((FAILED, f"{type(error).__name__}: {error}".splitlines()[0]))
            else:
                pipe.send((DONE, ""))
    except (EOFError, OSError):
        return
