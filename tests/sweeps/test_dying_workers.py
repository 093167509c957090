"""Processes that end in mid-work: which job it was, and that nothing else is lost."""

from __future__ import annotations

import faulthandler
import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from support_exudyn.sweeps.workers import ProcessEndedError, Workers, worker_pool
from tests import processes
from tests.hostile import posix_only

pytestmark = posix_only

# --- jobs; processes of their own import them from here ---


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


@pytest.fixture(scope="module", autouse=True)
def soon_started() -> Iterator[None]:
    """Processes come from one that has imported everything; spawned ones are in test_workers.py."""
    with processes.soon_started(__name__):
        yield


@pytest.fixture(scope="module")
def pool() -> Iterator[Workers]:
    with worker_pool(2) as pool:
        yield pool


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
    assert {n for n in range(9) if begun[n] >= 2} >= {1, 6, 7}
    assert max(begun.values()) == 2  # also of those that were under way beside them
