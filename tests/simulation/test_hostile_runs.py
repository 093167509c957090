"""Runs that are interrupted, and sweeps in which a process is killed."""

from __future__ import annotations

import gc
import signal
from collections.abc import Callable
from dataclasses import replace

import exudyn
import numpy as np
import pytest

from support_exudyn import (
    ClearancePin,
    Held,
    OilColumn,
    Result,
    Scenario,
    simulate,
)
from support_exudyn.formulations.exudyn.scene.engine_scene import EngineScene
from support_exudyn.formulations.exudyn.solver.solver import SolverRun
from tests.cases.run_cases import PIN, loose_support, paper_contact
from tests.hostile import Interruption, posix_only
from user_forces import LankaraniNikravesh, value

PROMPT = 2.0  # [s] of work, within which an interruption is asked to come out
LONG = 1000.0  # [s] that the machine is simulated for: minutes of work

OIL = OilColumn(bore_area=0.1, oil_length=0.5, bulk_modulus=1.5e9)
PLANE = loose_support(1.5, 0.1, drive=Held(), duration=0.04)
ACTUATORS = dict.fromkeys(PLANE.linkage.actuators, OIL)
RUNS = {
    "plane": PLANE,
    "space": replace(PLANE, dimensions=3),
    "compiled": replace(PLANE, formulation="compiled", actuators=ACTUATORS),
    "with an accuracy": replace(PLANE, accuracy="draft", formulation="exudyn"),
}


def long(scenario: Scenario) -> Scenario:
    """The same for minutes."""
    return replace(scenario, duration=LONG, record_period=LONG / 10.0)


@pytest.fixture
def released(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Models of the engine that have been let go of."""
    found: list[str] = []
    for kind in (EngineScene,):

        def release(model: object, before: Callable[[object], None] = kind.release) -> None:
            found.append(type(model).__name__)
            before(model)

        monkeypatch.setattr(kind, "release", release)
    return found


def same(one: Result, other: Result) -> bool:
    return all(np.array_equal(one[name], other[name]) for name in one.channels) and one.onsets == other.onsets


@posix_only
@pytest.mark.parametrize("name", RUNS)
def test_an_interruption_comes_out_at_once_and_leaves_nothing_behind(
    name: str, released: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    scenario = RUNS[name]
    before = simulate(scenario)
    released.clear()
    sent, begin = Interruption(), SolverRun.connect  # the last that is done before the engine is at work
    monkeypatch.setattr(SolverRun, "connect", lambda run: (begin(run), sent.now()))
    with pytest.raises(KeyboardInterrupt), sent:
        simulate(long(scenario), throw=False, progress=sent.now)
    assert 0.0 < sent.work < PROMPT
    assert exudyn.config.printToConsole
    assert gc.isenabled()
    assert len(released) == (scenario.formulation != "compiled")  # which has no model of the engine
    assert same(simulate(scenario), before)


class Calls:
    """Interrupts when it is called for the nth time."""

    left = 0

    @classmethod
    def count(cls) -> None:
        cls.left -= 1
        if cls.left == 0:
            signal.raise_signal(signal.SIGINT)


@value
class Interrupting(LankaraniNikravesh):
    """Is interrupted while its force is computed, which is in Python: numba cannot compile it."""

    @staticmethod
    def elastic(depth: float, stiffness: float, exponent: float) -> float:
        Calls.count()
        return float(stiffness * depth**exponent)


def interrupting(scenario: Scenario) -> Scenario:
    good = paper_contact(1.5, 0.0)
    law = Interrupting(stiffness=good.normal.stiffness, restitution=0.9)
    contact = type(good)(bearing=good.bearing, normal=law)
    return replace(scenario, pins={PIN: ClearancePin(contact=contact)})


@pytest.mark.filterwarnings("ignore:computed in Python")
@pytest.mark.parametrize(("name", "start"), [("plane", "concentric"), ("space", "settled")])
def test_an_interruption_in_a_law_is_not_taken_for_a_failed_run(name: str, start: str) -> None:
    Calls.left = 3
    with pytest.raises(KeyboardInterrupt):
        simulate(interrupting(replace(RUNS[name], start=start)), throw=False)
    assert Calls.left == 0
    assert exudyn.config.printToConsole
