"""Sweeps whose processes are interrupted and killed."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from support_exudyn.sweeps import read_sweep, sweep, work
from support_exudyn.sweeps.store import Store, StoredRun
from support_exudyn.sweeps.work import Task
from support_exudyn.sweeps.workers import ProcessEndedError
from tests.cases.sweep_cases import columns, rows, speeds, start, write_sweep
from tests.processes import linux_only, session_of, soon_started, wait_until

pytestmark = linux_only
RUNS = 18
SOON = 60.0  # [s]; what comes at all has come by then, on a busy machine too


def killed_at(place: int, store: Store, task: Task) -> StoredRun:
    """In a worker: what one does whose memory is short for a single run."""
    if task.scenario.machine.speed == 0.2:  # type: ignore[attr-defined]
        os.kill(os.getpid(), signal.SIGKILL)
    return work.run_into(store, task)


@pytest.fixture(autouse=True)
def _soon_started() -> Iterator[None]:
    with soon_started(__name__):
        yield


def test_a_run_whose_process_is_killed_is_a_row_and_is_tried_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write_sweep(tmp_path, '"machine.speed_m_per_s" = [0.1, 0.2, 0.3]')
    with monkeypatch.context() as patch:
        patch.setattr(work, "_do", killed_at)
        outcome = sweep(read_sweep(path), tmp_path / "store", workers=1)
    assert (outcome.done, outcome.killed) == (2, 1)
    table = columns(tmp_path / "store")
    assert table["status"] == ["done", "killed", "done"]
    assert table["reason"][1] == ProcessEndedError(0, 0.0, -signal.SIGKILL).reason
    outcome = sweep(read_sweep(path), tmp_path / "store", workers=1)
    assert (outcome.done, outcome.found) == (3, 2)


@pytest.mark.slow  # three sweeps of three processes
def test_interrupted_killed_and_hurt_it_ends_as_if_left_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write_sweep(tmp_path, speeds(RUNS), duration=0.02)
    store, processes = tmp_path / "store", []
    single, options = (("--workers", number, "--out", str(store)) for number in "12")
    try:
        # Ctrl-C in a terminal, which all processes get
        processes.append(start(path, *options))
        assert wait_until(lambda: len(rows(store)) > 2, SOON)
        os.killpg(processes[-1].pid, signal.SIGINT)
        _, errors = processes[-1].communicate(timeout=SOON)
        assert (processes[-1].returncode, "Traceback" in errors) == (130, False)
        first = rows(store)
        assert len(first) < RUNS
        assert columns(store)["status"].count("done") == len(first)
        assert not [one for one in store.rglob(".*") if one.is_file()]  # nothing half-written

        # the whole of it killed
        processes.append(start(path, *single))
        assert wait_until(lambda: len(rows(store)) >= len(first) + 3, SOON)
        processes[-1].kill()
        assert wait_until(lambda: not session_of(processes[-1].pid), SOON)
        second = rows(store)
        assert first.items() <= second.items()

        # one of its workers killed
        processes.append(start(path, *single))
        assert wait_until(lambda: len(rows(store)) >= len(second) + 3, SOON)
        for worker in sorted(session_of(processes[-1].pid))[-1:]:
            os.kill(worker, signal.SIGKILL)
        processes[-1].communicate(timeout=SOON)
        assert processes[-1].returncode == 0
        assert second.items() <= rows(store).items()
    finally:
        for process in processes:
            for one in session_of(process.pid):
                os.kill(one, signal.SIGKILL)
            process.communicate()
    whole = Store(tmp_path / "whole")
    monkeypatch.setattr(
        "support_exudyn.sweeps.run.in_processes",
        lambda tasks, *_: (work.run_into(whole, task) for task in tasks),  # here, one after the other
    )
    sweep(read_sweep(path), whole.folder)
    assert columns(store) == columns(tmp_path / "whole")
