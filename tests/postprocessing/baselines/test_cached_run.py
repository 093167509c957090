"""Runs that are kept: made once, read alike, made again when they are damaged or the program is another."""

from __future__ import annotations

import os
import threading
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import Failure, SimulationError, simple_scenario
from support_exudyn.postprocessing.comparing import in_tests
from support_exudyn.postprocessing.comparing.in_tests import RunCache

SCENE = simple_scenario(
    "crank_rocker", duration_s=0.01, drives={"crank": {"type": "Steady", "rate_rad_per_s": 60}}
)


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[object]:
    """What was simulated."""
    found: list[object] = []
    simulate = in_tests.simulate

    def counted(scenario: object, **more: bool) -> object:
        found.append(scenario)
        return simulate(scenario, **more)  # type: ignore[arg-type]

    monkeypatch.setattr(in_tests, "simulate", counted)
    return found


def test_a_run_is_made_once(made: list[object], tmp_path: Path) -> None:
    first, again = (RunCache(tmp_path).run(SCENE) for _ in range(2))
    assert len(made) == 1
    assert all(np.array_equal(first[name], again[name]) for name in first.channels)
    again["crank.moment"][:] = 0.0  # what a test does to its result
    assert np.abs(RunCache(tmp_path).run(SCENE)["crank.moment"]).max() > 0.0
    with_errors = RunCache(tmp_path).run(SCENE, errors=True)
    assert (len(made), with_errors.coarser is not None, first.coarser) == (2, True, None)


def test_another_program_makes_its_own(
    made: list[object], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = RunCache(tmp_path)
    first.run(SCENE)
    monkeypatch.setattr(in_tests, "program", lambda: {"sources": "others"})
    RunCache(tmp_path).run(SCENE)
    assert len(made) == 2
    os.utime(first.folder, (0.0, 0.0))  # what another program has left is removed once it is old
    monkeypatch.setattr(in_tests, "program", lambda: {"sources": "third"})
    RunCache(tmp_path)
    assert not first.folder.exists()


def test_who_asks_for_the_same_waits_and_a_run_that_fails_is_not_kept(
    made: list[object], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(scenario: object, **more: bool) -> object:
        raise SimulationError(Failure("stuck", "take shorter steps", 0.1))

    cache, found = RunCache(tmp_path), []
    with monkeypatch.context() as patch:
        patch.setattr(in_tests, "simulate", fails)
        with pytest.raises(SimulationError, match="stuck"):
            cache.run(SCENE)
    assert list(tmp_path.rglob("run.h5")) == []  # and nothing is locked
    threads = [threading.Thread(target=lambda: found.append(cache.run(SCENE))) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert (len(found), len(made)) == (3, 1)
