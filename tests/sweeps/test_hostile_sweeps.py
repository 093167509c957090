"""Sweeps with points at which anything may happen: each is a row with its reason, and the others are done."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from support_exudyn import ClearancePin, Held, Scenario
from support_exudyn.sweeps import Plan, Record, read_table, sweep
from tests.cases.run_cases import loose_support, paper_contact
from tests.processes import soon_started
from user_forces import FrictionLaw, value

pytestmark = pytest.mark.filterwarnings("ignore:computed in Python")  # which no machine code can do
KINDS = ("good", "zero", "overflow", "deep", "exit", "memory", "file", "type", "letters", "killed")


@value
class Hostile(FrictionLaw):
    """Does something wrong at the first impact."""

    kind: str

    @property
    def number(self) -> float:
        """Of the kind, since a law's function takes numbers."""
        return float(KINDS.index(self.kind))

    @staticmethod
    def force(slip: float, normal_force: float, number: float) -> Any:
        if normal_force == 0.0 or KINDS[int(number)] == "good":
            return 0.0
        match KINDS[int(number)]:
            case "zero":
                return 1.0 / 0.0
            case "overflow":
                return 10.0**400
            case "deep":
                return Hostile.force(slip, normal_force, number)
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
        scenario = replace(scene(), duration=0.01)  # else it is the same run as a good one
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
    "killed": "the process that computed it ended",
    "making": "ZeroDivisionError: division by zero",
    "long": "1e+13 records of 66 channels take",
    "unsent": "cannot pickle",
}


@pytest.mark.filterwarnings("ignore:unclosed file")
def test_whatever_happens_at_a_point_is_a_row_with_its_reason(tmp_path: Path) -> None:
    points = [{"kind": kind} for kind in (*REASONS, "good")]
    done = sweep(Plan(points=points, scenario=made, record=Record(("tip.x.mean",))), tmp_path, workers=2)
    assert (done.done, done.failed, done.killed) == (2, len(REASONS) - 2, 1)
    rows = {row["kind"]: row for row in read_table(tmp_path).to_pylist()}
    for kind, reason in REASONS.items():
        assert reason in rows[kind]["reason"], kind
        assert rows[kind]["reason"].isprintable()
        assert (rows[kind]["tip.x.mean_m"] is not None) is (not reason)
