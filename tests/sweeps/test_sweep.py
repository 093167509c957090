"""Sweeps: continued after any end, in the order of their plan, with failures as rows."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import Result, Scenario
from support_exudyn.scene.contract import Failure, Progress, SimulationError
from support_exudyn.sweeps import SweepOutcome, open_run, read_sweep, read_table, sweep, work
from support_exudyn.sweeps.run import known
from support_exudyn.sweeps.store import Store
from support_exudyn.sweeps.work import Task
from tests.cases.sweep_cases import columns, rows, run_by, speeds, write_sweep
from user_forces.values.value import InputError


@pytest.fixture
def ran(monkeypatch: pytest.MonkeyPatch) -> list[Task]:
    """Runs are made in this process, one after the other; which they were."""
    done: list[Task] = []

    def here(tasks, store, workers):  # type: ignore[no-untyped-def]
        for task in tasks:
            done.append(task)
            yield work.run_into(store, task)

    run_by(monkeypatch, here)
    return done


def do(path: Path, **options: object) -> SweepOutcome:
    return sweep(read_sweep(path), path.parent / "store", **options)  # type: ignore[arg-type]


def store_of(path: Path) -> Store:
    return Store(path.parent / "store")


# --- the table ---


def test_rows_are_in_the_order_of_the_plan_with_numbers_of_their_runs(tmp_path: Path, ran: list[Task]) -> None:
    path = write_sweep(
        tmp_path, '"pins.pin.clearance_mm" = [0.5, 1.0]\n"machine.speed_m_per_s" = [0.3, 0.1, 0.2]'
    )
    outcome = do(path)
    assert (outcome.runs, outcome.done, outcome.failed, outcome.found) == (6, 6, 0, 0)
    table = read_table(outcome.table).to_pydict()
    assert table["pins.pin.clearance_mm"] == [0.5, 0.5, 0.5, 1.0, 1.0, 1.0]
    assert table["machine.speed_m_per_s"] == [0.3, 0.1, 0.2] * 2
    assert table["status"] == ["done"] * 6
    for number, name in enumerate(table["key"]):
        run = Result.load(store_of(path).run_file(name))
        assert run.scenario.machine.speed == table["machine.speed_m_per_s"][number]  # type: ignore[attr-defined]
        assert table["pin.pin.force.mean_N"][number] == run.window("pin.pin.force").mean
        assert table["pin.pin.force.largest_N"][number] == run.window("pin.pin.force").greatest[0]
        assert table["pin.pin.largest_force_N"][number] == run.largest_force["pin"]
        assert table["journal.x.last_m"][number] == pytest.approx(run["journal.x"][-1], rel=1e-12)
        assert table["wall_time_s"][number] == run.wall_time


def test_the_table_says_its_units_and_what_it_was_made_of(tmp_path: Path, ran: list[Task]) -> None:
    path = write_sweep(tmp_path, speeds(2))
    table = read_table(do(path).table)
    field = table.schema.field("pin.pin.force.mean_N")
    assert field.metadata == {b"unit": b"N", b"meaning": b"pin.pin.force.mean of the run"}
    about = json.loads(table.schema.metadata[b"support_exudyn"])
    assert about["sweep"] == path.read_text(encoding="utf-8")
    assert about["program"]["exudyn"]


def test_without_a_list_the_usual_numbers_are_noted_with_their_errors(tmp_path: Path, ran: list[Task]) -> None:
    path = write_sweep(tmp_path, speeds(2), record="after_s = 0.001")
    text = path.read_text(encoding="utf-8").replace("[scenario]\n", '[scenario]\naccuracy = "draft"\n')
    path.write_text(text, encoding="utf-8")
    table = read_table(do(path).table).to_pydict()
    run = Result.load(store_of(path).run_file(table["key"][0]))
    for name, (value, error, unit) in run.numbers(after=0.001).items():
        title = next(column for column in table if column.startswith(f"{name}_") and "error" not in column)
        assert table[title][0] == value, unit
        if np.isfinite(error):
            assert table[f"{title}_error"][0] == error


def test_a_run_that_is_not_kept_is_computed_again_when_it_is_opened(tmp_path: Path, ran: list[Task]) -> None:
    path = write_sweep(tmp_path, speeds(3), record='numbers = ["pin.pin.force.mean"]\nkeep_runs = false')
    table = read_table(do(path).table).to_pydict()
    assert not list(store_of(path).runs.iterdir())
    run = open_run(read_sweep(path), table["run"][1], store_of(path).folder)
    assert run.window("pin.pin.force").mean == table["pin.pin.force.mean_N"][1]
    assert "journal.x" in run.channels
    with pytest.raises(InputError, match="run = 'run_9': there is none of this name"):
        open_run(read_sweep(path), "run_9")


def test_a_number_that_no_run_can_have_is_refused_before_any_is_made(tmp_path: Path, ran: list[Task]) -> None:
    path = write_sweep(tmp_path, speeds(2), record='numbers = ["pin.hinge.force.mean"]')
    with pytest.raises(InputError, match=r"runs have no channel 'pin.hinge.force'; allowed"):
        do(path)
    assert not ran


def test_what_ends_after_an_interruption_stands_in_the_table(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(tasks, store, workers):  # type: ignore[no-untyped-def]
        for task in tasks:
            work.run_into(store, task)
            raise KeyboardInterrupt
        yield

    run_by(monkeypatch, interrupted)
    with pytest.raises(KeyboardInterrupt):
        do(write_sweep(tmp_path, speeds(2)))
    assert columns(tmp_path / "store")["status"] == ["done", "waiting"]


# --- going on ---


def test_what_is_there_is_not_made_again(tmp_path: Path, ran: list[Task]) -> None:
    path = write_sweep(tmp_path, speeds(4))
    do(path)
    before, table = rows(path.parent / "store"), columns(path.parent / "store")
    assert known(read_sweep(path), path.parent / "store").found == 4
    outcome = do(path)
    assert (outcome.found, outcome.done, len(ran)) == (4, 4, 4)
    assert rows(path.parent / "store") == before
    assert columns(path.parent / "store") == table


def test_a_changed_input_makes_only_what_it_touches(tmp_path: Path, ran: list[Task]) -> None:
    do(write_sweep(tmp_path, '"machine.speed_m_per_s" = [0.1, 0.2, 0.3]'))
    path = write_sweep(tmp_path, '"machine.speed_m_per_s" = [0.1, 0.25, 0.3]')
    outcome = do(path)
    assert (outcome.found, len(ran)) == (2, 4)
    assert ran[-1].scenario.machine.speed == 0.25  # type: ignore[attr-defined]
    assert columns(tmp_path / "store")["machine.speed_m_per_s"] == [0.1, 0.25, 0.3]
    assert len(rows(tmp_path / "store")) == 4  # that which is no longer asked for stays,
    assert do(path, prune=True).pruned == 1  # until it is removed
    assert set(rows(tmp_path / "store")) == set(columns(tmp_path / "store")["key"])


def test_other_numbers_are_noted_of_runs_that_are_kept(tmp_path: Path, ran: list[Task]) -> None:
    do(write_sweep(tmp_path, speeds(2), record='numbers = ["pin.pin.force.largest"]'))
    runs = {path: path.stat().st_mtime_ns for path in (tmp_path / "store" / "runs").iterdir()}
    path = write_sweep(tmp_path, speeds(2), record='numbers = ["journal.x.max"]')
    do(path)
    assert len(ran) == 2
    assert {path: path.stat().st_mtime_ns for path in (tmp_path / "store" / "runs").iterdir()} == runs
    noted = columns(tmp_path / "store")
    assert "pin.pin.force.largest_N" not in noted
    do(write_sweep(tmp_path / "anew", speeds(2), record='numbers = ["journal.x.max"]'))
    assert columns(tmp_path / "anew" / "store") == noted


DAMAGE: dict[str, Callable[[bytes], bytes]] = {
    "cut": lambda whole: whole[: len(whole) // 2],
    "changed": lambda whole: whole[:-9] + bytes([whole[-9] ^ 1]) + whole[-8:],
    "empty": lambda whole: b"",
}


@pytest.mark.parametrize("way", DAMAGE)
@pytest.mark.parametrize("which", ["rows", "runs"])
def test_a_damaged_file_is_found_and_made_again(tmp_path: Path, ran: list[Task], way: str, which: str) -> None:
    path = write_sweep(tmp_path, speeds(3))
    do(path)
    table = columns(tmp_path / "store")
    (damaged,) = (tmp_path / "store" / which).glob(f"{table['key'][1]}.*")
    damaged.write_bytes(DAMAGE[way](damaged.read_bytes()))
    assert do(path).found == 2
    assert [task.key for task in ran[3:]] == [table["key"][1]]
    assert columns(tmp_path / "store") == table
    assert Result.load(store_of(path).run_file(table["key"][1])).time.size


# --- failures ---


def test_refused_and_failed_runs_are_rows_with_their_reason(
    tmp_path: Path, ran: list[Task], monkeypatch: pytest.MonkeyPatch
) -> None:
    real = work.simulate

    def simulate(scenario: Scenario, errors: bool, progress: Progress) -> Result:
        if scenario.machine.speed == 0.2:  # type: ignore[attr-defined]
            raise SimulationError(Failure("the journal is lost", "Look there.", 0.01))
        return real(scenario, errors=errors, progress=progress)

    monkeypatch.setattr(work, "simulate", simulate)
    path = write_sweep(tmp_path, '"machine.speed_m_per_s" = [0.1, -0.5, 0.2]')
    outcome = do(path)
    assert (outcome.done, outcome.failed) == (1, 2)
    table = columns(tmp_path / "store")
    assert table["status"] == ["done", "failed", "failed"]
    assert "speed_m_per_s = -0.5: allowed: >= 0" in table["reason"][1]
    assert "the journal is lost" in table["reason"][2]
    assert table["pin.pin.force.mean_N"][1:] == [None, None]
    do(path)
    assert len(ran) == 2  # what fails would fail again
    monkeypatch.setattr(work, "simulate", real)
    assert do(path, retry_failed=True).done == 2
    assert len(ran) == 3
