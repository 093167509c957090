"""Sweeps whose processes are interrupted and killed."""

from __future__ import annotations

import copyreg
import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from support_exudyn import Scenario
from support_exudyn.sweeps import SweepOutcome, read_sweep, sweep
from support_exudyn.sweeps.workers import ProcessEndedError
from tests.cases.sweep_cases import columns, rows, run_by, speeds, start, write_sweep
from tests.processes import linux_only, session_of, soon_started, wait_until

pytestmark = linux_only
RUNS = 18
SPEED = "machine.speed_m_per_s"
SOON = 60.0  # [s]; what comes at all has come by then, on a busy machine too


def end_process() -> None:
    """What happens to a process whose memory is short."""
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.fixture(autouse=True)
def _soon_started() -> Iterator[None]:
    with soon_started(__name__):
        yield


def test_a_run_whose_process_is_killed_is_a_row_and_is_tried_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    number, middle = 3, 1
    plan = read_sweep(write_sweep(tmp_path, speeds(number)))
    killing = float(plan.points[middle][SPEED])

    def sent(scenario: Scenario) -> object:
        """One of the scenarios ends the process that reads it."""
        deadly = scenario.machine.speed == killing  # type: ignore[attr-defined]
        return (end_process, ()) if deadly else scenario.__reduce_ex__(2)

    monkeypatch.setitem(copyreg.dispatch_table, Scenario, sent)
    outcome = sweep(plan, tmp_path / "store", workers=1)
    assert (outcome.done, outcome.killed) == (number - 1, 1)
    table = columns(tmp_path / "store")
    assert table["status"] == ["done" if n != middle else "killed" for n in range(number)]
    assert table["reason"][middle] == ProcessEndedError.reason
    monkeypatch.undo()
    outcome = sweep(plan, tmp_path / "store", workers=1)
    assert (outcome.done, outcome.found) == (number, number - 1)
    assert sorted(rows(tmp_path / "store")) == sorted(columns(tmp_path / "store")["key"])


def test_processes_make_the_same_as_this_one_and_the_same_run_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    some = ", ".join(["0.1", *(f"0.2{n:02}" for n in range(8)), "0.1", "-0.5", "0.15"])
    path = write_sweep(tmp_path, f'"{SPEED}" = [{some}]')
    outcome = sweep(read_sweep(path), tmp_path / "store", workers=2)
    assert (outcome.done, outcome.failed, outcome.found) == (11, 1, 0)
    run_by(monkeypatch)
    sweep(read_sweep(path), tmp_path / "here")
    assert columns(tmp_path / "store") == columns(tmp_path / "here")


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
    run_by(monkeypatch)
    sweep(read_sweep(path), tmp_path / "whole")
    assert columns(store) == columns(tmp_path / "whole")


def test_threads_are_interrupted_and_the_rest_is_done_by_the_next_call(tmp_path: Path) -> None:
    path = write_sweep(tmp_path, speeds(40), duration=0.2)
    text = path.read_text(encoding="utf-8").replace("[scenario]", '[scenario]\nformulation = "compiled"')
    path.write_text(text, encoding="utf-8")
    plan, seen = read_sweep(path), list[int]()

    def interrupt(so_far: SweepOutcome) -> None:
        seen.append(so_far.done)
        if so_far.done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep(plan, tmp_path / "store", workers=2, progress=interrupt)
    kept = rows(tmp_path / "store")
    assert 3 <= len(kept) < 40
    assert columns(tmp_path / "store")["status"].count("done") == len(kept)
    outcome = sweep(plan, tmp_path / "store", workers=2)
    assert (outcome.done, outcome.found) == (40, len(kept))
    assert kept.items() <= rows(tmp_path / "store").items()
    one = sweep(plan, tmp_path / "alone", workers=1)
    assert (one.done, columns(tmp_path / "alone")) == (40, columns(tmp_path / "store"))
