"""Processes side by side: what comes back, what is told of them, and that none is left over."""

from __future__ import annotations

import faulthandler
import multiprocessing
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest

from support_exudyn.sweeps.workers import ProcessEndedError, Workers, report, worker_pool
from tests.hostile import posix_only
from tests.processes import ROOT, alive, environment, linux_only, wait_until

SOON = 10.0  # [s]; what ends at once has ended by then, on a busy machine too
LONG = 120.0  # [s]; work that nobody waits for


# --- jobs; processes of their own import them from here ---


def squared(place: int, number: int) -> tuple[int, int, int]:
    return place, number**2, os.getpid()


def stay(place: int, seconds: float) -> None:
    report(0.5)
    time.sleep(seconds)


def stay_until_told(place: int, folder: Path) -> None:
    """Until the one that follows the shares has seen that it is at work."""
    report(0.5)
    assert wait_until((folder / str(place)).exists, LONG)


def refuse(place: int, wrong: int, folder: Path) -> int:
    (folder / str(place)).touch()
    if place == wrong:
        raise LookupError(f"no {place}")
    return place


def end(place: int, way: str, folder: Path) -> int:
    """Mark that the job was begun, and end as asked."""
    with (folder / str(place)).open("a") as marks:
        marks.write("x")
    if way == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    elif way == "crashed":
        faulthandler.disable()  # what it writes is not looked at
        os.abort()
    elif way == "left":
        os._exit(3)
    return place


def times_begun(folder: Path) -> dict[int, int]:
    return {int(path.name): path.stat().st_size for path in folder.iterdir()}


def show_processes(shares: list[float]) -> None:
    """For the script that is killed: one process idles, one works."""
    if shares == [1.0, 0.5]:
        print(*(process.pid for process in multiprocessing.active_children()), flush=True)


@pytest.fixture(scope="module")
def pool() -> Iterator[Workers]:
    with worker_pool(2) as pool:
        yield pool


def silent(shares: list[float]) -> None:
    del shares


# --- work ---


def test_results_come_back_in_the_order_of_the_jobs(pool: Workers) -> None:
    found = pool.run([(n,) for n in range(20)], squared, silent)
    assert [(place, square) for place, square, _ in found] == [(n, n * n) for n in range(20)]
    processes = {process for *_, process in found}
    assert os.getpid() not in processes
    assert len(processes) <= 2


def test_shares_are_told_while_a_job_works_and_end_at_one(pool: Workers, tmp_path: Path) -> None:
    told: list[list[float]] = []

    def tell(shares: list[float]) -> None:
        told.append(list(shares))
        for place, share in enumerate(shares):
            if share == 0.5:
                (tmp_path / str(place)).touch()

    pool.run([(tmp_path,)] * 2, stay_until_told, tell)
    assert told[-1] == [1.0, 1.0]
    assert all(a <= b for one, other in pairwise(told) for a, b in zip(one, other, strict=True))


def test_an_exception_of_a_job_is_raised_here_and_the_rest_is_dropped(pool: Workers, tmp_path: Path) -> None:
    with pytest.raises(LookupError, match="no 3"):
        pool.run([(3, tmp_path)] * 2000, refuse, silent)
    assert len(pool.run([(n,) for n in range(4)], squared, silent)) == 4  # the pool lives on
    assert len(list(tmp_path.iterdir())) < 100


# --- ends ---


@posix_only
def test_the_job_whose_process_ends_is_told_and_all_others_are_done(pool: Workers, tmp_path: Path) -> None:
    ways = ["good", "killed", *["good"] * 4, "crashed", "left", "good"]
    told: list[ProcessEndedError] = []
    shares: list[list[float]] = []

    def ended(error: ProcessEndedError) -> int:
        told.append(error)
        return -error.place

    found = pool.run([(way, tmp_path) for way in ways], end, shares.append, ended)
    assert found == [0, -1, 2, 3, 4, 5, -6, -7, 8]
    assert [error.place for error in told] == [1, 6, 7]
    assert shares[-1] == [1.0] * 9
    begun = times_begun(tmp_path)
    assert set(begun) == set(range(9))
    assert max(begun.values()) <= 2  # also of those that were under way beside them


@pytest.mark.slow  # three processes
@linux_only
def test_processes_end_with_a_parent_that_is_killed() -> None:
    script = (
        "from support_exudyn.sweeps.workers import worker_pool\n"
        "from tests.sweeps.test_workers import LONG, show_processes, stay\n"
        "with worker_pool(2) as pool:\n"
        "    pool.run([(0.0,), (LONG,)], stay, show_processes)\n"
    )
    with subprocess.Popen(
        [sys.executable, "-c", script], cwd=ROOT, env=environment(), stdout=subprocess.PIPE, text=True
    ) as parent:
        assert parent.stdout is not None
        processes = {int(pid) for pid in parent.stdout.readline().split()}
        try:
            assert len(processes) == 2
            assert alive(processes) == processes
            parent.kill()
            parent.wait()
            assert wait_until(lambda: not alive(processes), SOON)
        finally:
            parent.kill()
            for process in alive(processes):
                os.kill(process, signal.SIGKILL)
