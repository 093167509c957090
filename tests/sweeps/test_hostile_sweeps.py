"""Sweeps with points at which anything may happen: each is a row with its reason, and the others are done."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from support_exudyn import ClearancePin, Held, Scenario, SimulationError, simulate
from support_exudyn.__main__ import main
from support_exudyn.files import free_memory
from support_exudyn.simulation import memory
from support_exudyn.sweeps import Plan, Record, read_table, sweep, work
from tests.cases.run_cases import loose_support, paper_contact
from tests.cases.sweep_cases import run_by, write_sweep
from tests.processes import soon_started
from user_forces import FrictionLaw, InputError, value


@value
class Hostile(FrictionLaw):
    """Does something wrong at the first impact."""

    kind: str

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> Any:
        if normal_force == 0.0 or self.kind == "good":
            return 0.0
        match self.kind:
            case "zero":
                return 1.0 / 0.0
            case "overflow":
                return 10.0**400
            case "deep":
                return self(slip, normal_force)
            case "exit":
                sys.exit(0)
            case "memory":
                raise MemoryError
            case "file":
                raise OSError("no such table")
            case "type":
                return "many"
            case "letters":
                raise LookupError("\x1b[2J \udc80 \u202e")
            case "killed":
                os._exit(7)
        raise StopIteration


def scene(kind: str = "good") -> Scenario:
    good = paper_contact(1.5, 0.0)
    contact = type(good)(bearing=good.bearing, normal=good.normal, friction=Hostile(kind=kind))
    return replace(
        loose_support(drive=Held(), duration=0.02), pins={"rear_base": ClearancePin(contact=contact)}
    )


def made(inputs: Any) -> Scenario:
    """The scenario of a point, or what goes wrong before there is one."""
    kind = inputs["kind"]
    if kind == "making":
        raise ZeroDivisionError("division by zero")
    if kind == "long":
        return replace(scene(), duration=1e10, record_period=1e-3)
    if kind == "unsent":
        scenario = scene()
        scenario.__dict__["open"] = open(__file__, "rb")  # noqa: PTH123, SIM115
        return scenario
    return scene(kind)


@pytest.fixture(autouse=True)
def _soon_started() -> Iterator[None]:
    with soon_started(__name__):
        yield


REASONS = {
    "good": "",
    "zero": "division by zero",
    "overflow": "out of range",
    "deep": "RecursionError",
    "exit": "the program was asked to end: SystemExit: 0",
    "memory": "there is not enough memory",
    "file": "OSError: no such table",
    "type": "many",
    "letters": r"LookupError: \x1b[2J \udc80 \u202e",
    "killed": "the process that computed it ended: exit code 7",
    "making": "ZeroDivisionError: division by zero",
    "long": "1e+13 records of 66 channels take",
    "unsent": "",  # the process that runs it has made it
}


@pytest.mark.filterwarnings("ignore:unclosed file")
def test_whatever_happens_at_a_point_is_a_row_with_its_reason(tmp_path: Path) -> None:
    points = [{"kind": kind} for kind in (*REASONS, "good")]
    done = sweep(Plan(points=points, scenario=made, record=Record(("tip.x.mean",))), tmp_path, workers=2)
    assert (done.done, done.failed, done.killed) == (3, len(REASONS) - 3, 1)
    rows = {row["kind"]: row for row in read_table(tmp_path).to_pylist()}
    for kind, reason in REASONS.items():
        assert reason in rows[kind]["reason"], kind
        assert rows[kind]["reason"].isprintable()
        assert (rows[kind]["tip.x.mean_m"] is not None) is (not reason)


@pytest.mark.parametrize(
    ("values", "told"),
    [
        ([1, 2**63 - 1, 3], [1, 2**63 - 1, 3]),
        ([1, 10**20], [1.0, 1e20]),
        ([1, 10**19 + 1], ["1", "10000000000000000001"]),  # which a number of 64 bits would round
        ([1, 10**400], ["1", str(10**400)]),
        ([-(2**63) - 1, 0.5], ["-9223372036854775809", "0.5"]),
    ],
)
def test_whole_numbers_of_any_size_stand_in_the_table(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, values: list[Any], told: list[Any]
) -> None:
    run_by(monkeypatch, lambda tasks, store, *_: (work.run_into(store, task) for task in tasks))

    def scenario(inputs: Any) -> Scenario:
        if inputs["many"] != values[0]:
            raise InputError(f"many = {inputs['many']}: allowed: up to 1")
        return scene()

    done = sweep(Plan(points=[{"many": one} for one in values], scenario=scenario), tmp_path, workers=1)
    assert (done.done, done.failed) == (1, len(values) - 1)
    assert read_table(tmp_path).column("many").to_pylist() == told


def test_a_file_with_a_whole_number_that_is_too_large_is_swept(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write_sweep(tmp_path, '"duration_s" = [0.02, 100000000000000000000, 1e9]')
    with pytest.raises(SystemExit, match="3"):
        main(["sweep", str(path), "--workers", "1"])
    assert "1 done, 2 failed" in capsys.readouterr().out
    reasons = read_table(tmp_path / "sweep_sweep").column("reason").to_pylist()
    assert reasons[0] == ""
    assert all("records of" in reason and "GB are free" in reason for reason in reasons[1:])


# --- memory ---


def test_a_run_that_does_not_fit_into_memory_is_refused_before_it_begins() -> None:
    with pytest.raises(
        InputError, match=r"records of 66 channels take .* GB and more, .* GB are free"
    ) as caught:
        simulate(replace(scene(), duration=1e10))
    period = float(str(caught.value).rpartition("at least ")[2].removesuffix(" s apart"))
    memory.check_room(replace(scene(), duration=1e10, record_period=period))
    memory.check_room(replace(scene(), duration=1e10, record_period=1e2 * period))


def test_what_a_run_takes_follows_from_records_and_channels(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "available", lambda: 10**6)
    long = replace(scene(), duration=5.0)
    with pytest.raises(InputError, match="5e"):
        memory.check_room(long)
    memory.check_room(replace(long, channels=("tip.x",)))
    memory.check_room(replace(long, record_period=0.01))


def test_the_memory_that_is_free_is_known() -> None:
    assert 10**6 < free_memory.available() <= free_memory.UNKNOWN


# --- single runs ---


def test_a_law_that_ends_the_program_does_not_end_it_as_if_all_was_done() -> None:
    with pytest.raises(SimulationError, match="the program was asked to end: SystemExit: 0"):
        simulate(scene("exit"))


def test_what_an_own_module_does_wrong_is_said_in_a_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "wrong_law.py").write_text(
        "from user_forces import FrictionLaw, value\n\n@value\nclass WrongLaw(FrictionLaw):\n"
        "    def __call__(self, slip, normal_force, deflection=0.0):\n        return {}[slip]\n",
        encoding="utf-8",
    )
    (tmp_path / "run.toml").write_text(
        'machine = "reference"\nduration_s = 0.05\n[pins.rear_base]\nclearance_mm = 1.5\n'
        'friction = {type = "WrongLaw"}\n',
        encoding="utf-8",
    )
    assert main(["--import", "wrong_law", "run", str(tmp_path / "run.toml")]) == 1
    error = capsys.readouterr().err
    assert error.startswith("error: stopped at t = 0 s: rear_base: WrongLaw fails at a slip of 0 m/s")
    assert "KeyError" in error
    assert error.count("\n") == 1
