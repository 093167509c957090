"""Sweeps: continued after any end, in the order of their plan, with failures as rows."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import Result, Scenario
from support_exudyn.commands.app import main
from support_exudyn.scene.contract import Failure, Progress, SimulationError
from support_exudyn.sweeps import SweepOutcome, open_run, read_sweep, read_table, sweep, work
from support_exudyn.sweeps.run import known
from support_exudyn.sweeps.store import StoredRun
from support_exudyn.sweeps.work import Task, run_task
from tests.cases.sweep_cases import columns, rows, run_by, speeds, write_sweep
from user_forces.values.value import InputError


@pytest.fixture
def ran(monkeypatch: pytest.MonkeyPatch) -> list[Task]:
    """Runs are made in this process, one after the other; which they were."""
    done: list[Task] = []

    def here(tasks: Iterable[Task], workers: int) -> Iterator[StoredRun]:
        assert workers >= 1
        for task in tasks:
            done.append(task)
            yield run_task(task)

    run_by(monkeypatch, here)
    return done


def do(path: Path, **options: object) -> SweepOutcome:
    return sweep(read_sweep(path), path.parent / "store", **options)  # type: ignore[arg-type]


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
    for number, name in enumerate(table["run"]):
        run = open_run(read_sweep(path), name)
        assert run.scenario.machine.speed == table["machine.speed_m_per_s"][number]  # type: ignore[attr-defined]
        assert table["pin.pin.force.mean_N"][number] == run.window("pin.pin.force").mean
        assert table["pin.pin.force.largest_N"][number] == run.window("pin.pin.force").greatest[0]
        assert table["pin.pin.largest_force_N"][number] == run.largest_force["pin"]
        assert table["journal.x.last_m"][number] == pytest.approx(run["journal.x"][-1], rel=1e-12)
    with pytest.raises(InputError, match="run = 'run_9': there is none of this name"):
        open_run(read_sweep(path), "run_9")


def test_a_run_is_computed_again_as_a_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write_sweep(tmp_path, speeds(2))
    assert main(["sweep", str(path), "--out", str(tmp_path), "--open-run", "run_2"]) == 0
    run = Result.load(capsys.readouterr().out.strip())
    assert run.scenario.machine.speed == 0.3  # type: ignore[attr-defined]


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
    run = open_run(read_sweep(path), table["run"][0])
    for name, (value, error, unit) in run.numbers(after=0.001).items():
        title = next(column for column in table if column.startswith(f"{name}_") and "error" not in column)
        assert table[title][0] == value, unit
        if np.isfinite(error):
            assert table[f"{title}_error"][0] == error


def test_a_number_that_no_run_can_have_is_refused_before_any_is_made(tmp_path: Path, ran: list[Task]) -> None:
    path = write_sweep(tmp_path, speeds(2), record='numbers = ["pin.hinge.force.mean"]')
    with pytest.raises(InputError, match=r"runs have no channel 'pin.hinge.force'; allowed"):
        do(path)
    assert not ran


# --- going on ---


def test_what_is_there_is_not_made_again(tmp_path: Path, ran: list[Task]) -> None:
    path = write_sweep(tmp_path, '"machine.speed_m_per_s" = [0.1, 0.2, 0.3]')
    do(path)
    before, table = rows(path.parent / "store"), columns(path.parent / "store")
    assert known(read_sweep(path), path.parent / "store").found == 3
    outcome = do(path)
    assert (outcome.found, outcome.done, len(ran)) == (3, 3, 3)
    assert rows(path.parent / "store") == before
    assert columns(path.parent / "store") == table
    path = write_sweep(tmp_path, '"machine.speed_m_per_s" = [0.1, 0.25, 0.3]')
    outcome = do(path)
    assert (outcome.found, len(ran)) == (2, 4)
    assert ran[-1].scenario.machine.speed == 0.25  # type: ignore[attr-defined]
    assert columns(tmp_path / "store")["machine.speed_m_per_s"] == [0.1, 0.25, 0.3]
    assert len(rows(tmp_path / "store")) == 4  # that which is no longer asked for stays,
    assert do(path, prune=True).pruned == 1  # until it is removed
    assert set(rows(tmp_path / "store")) == set(columns(tmp_path / "store")["key"])
    assert do(path).found == 3


DAMAGE: dict[str, Callable[[bytes], bytes]] = {
    "cut": lambda whole: whole[: len(whole) // 2],
    "changed": lambda whole: whole[:-9] + bytes([whole[-9] ^ 1]) + whole[-8:],
    "empty": lambda whole: b"",
}


@pytest.mark.parametrize("way", DAMAGE)
@pytest.mark.parametrize("number", [0, 1, 2])
def test_a_damaged_row_is_made_again(tmp_path: Path, ran: list[Task], way: str, number: int) -> None:
    path = write_sweep(tmp_path, speeds(3))
    do(path)
    table, file = columns(tmp_path / "store"), tmp_path / "store" / "rows.txt"
    lines = file.read_bytes().splitlines(keepends=True)
    lines[number] = DAMAGE[way](lines[number])
    file.write_bytes(b"".join(lines))
    # what follows a line that was cut off is lost with it
    lost = table["key"][number : number + (2 if way == "cut" else 1)]
    assert do(path).found == 3 - len(lost)
    assert [task.key for task in ran[3:]] == lost
    assert columns(tmp_path / "store") == table
    assert do(path).found == 3


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
