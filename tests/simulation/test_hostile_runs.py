"""Runs that are interrupted or fail, commands before anything else, and what stays behind."""

from __future__ import annotations

import gc
import io
import os
import signal
import subprocess
import sys
import tracemalloc
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import exudyn
import numpy as np
import pytest

from support_exudyn import (
    ClearancePin,
    Held,
    OilColumn,
    Result,
    Scenario,
    SolverSettings,
    simulate,
)
from support_exudyn.formulations.exudyn.scene.engine_scene import EngineScene
from support_exudyn.formulations.exudyn.scene.load_item import LoadItem
from support_exudyn.formulations.exudyn.solver.solver import SolverRun
from support_exudyn.model.loads.load import AnyLoad
from support_exudyn.simulation.at_start import DEGRADED, be_readable
from tests.cases.run_cases import PIN, loose_support, paper_contact
from tests.hostile import Interruption, posix_only
from tests.processes import ROOT, environment
from tests.roof_cases import over_the_canopy
from user_forces import LankaraniNikravesh, value
from user_forces.connector.clearance_joint import ClearanceJoint

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


# --- memory ---


def rattling(formulation: str, duration: float) -> Scenario:
    """A support whose pin rattles and swings for long; few records."""
    return loose_support(
        drive=Held(),
        duration=duration,
        record_period=duration / 4,
        step=2e-3,
        formulation=formulation,
        solver=SolverSettings(impact_steps=64, tolerance=1e-4),
    )


def peak(scenario: Scenario) -> int:
    """Most memory that Python rattling during a run [bytes]."""
    tracemalloc.start()
    try:
        simulate(scenario)
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize(
    ("formulation", "duration"), [pytest.param("exudyn", 0.4, marks=pytest.mark.slow), ("compiled", 10.0)]
)
def test_memory_is_flat_in_simulated_time(formulation: str, duration: float) -> None:
    simulate(rattling(formulation, 0.2))  # what is made once
    # of which the short one has more steps than become statistics at once, in as many intervals
    short, long = peak(rattling(formulation, duration)), peak(rattling(formulation, 4.0 * duration))
    # four times the time; impacts are recorded, a hundred bytes each
    assert long - short < 60_000


@pytest.fixture(scope="module")
def only_ours() -> Iterator[None]:
    """The collector looks at nothing that was there before."""
    gc.collect()
    gc.freeze()
    yield
    gc.unfreeze()


@pytest.mark.usefixtures("only_ours")
@pytest.mark.parametrize("loads", [{}, {"roof": over_the_canopy(0.1)}], ids=["free", "under a roof"])
def test_nothing_of_a_run_stays_behind(loads: dict[str, AnyLoad]) -> None:
    simulate(replace(rattling("exudyn", 0.1), loads=loads))
    # the engine would keep its user functions alive, and they all that they know
    gc.collect()
    assert not [item for item in gc.get_objects() if isinstance(item, (EngineScene, ClearanceJoint, LoadItem))]


# --- what commands do before anything else ---


INTERRUPTING = """
import os, signal, sys
sys.path.remove({folder!r})
del sys.modules["{name}"]
os.kill(os.getpid(), signal.SIGINT)
import {name}
"""
SHOWING = ["-m", "support_exudyn", "show", "--help"]  # which needs libraries; --version does not
STARTS = [["-m", "support_exudyn", "--version"], ["-m", "studies", "--help"]]


def started(words: list[str], folder: Path, more: dict[str, str]) -> subprocess.CompletedProcess[str]:
    """A command; the installed one as pip writes it."""
    if words[0] == "support-exudyn":
        script = folder / "support-exudyn"
        script.write_text("import sys\nfrom support_exudyn.__main__ import main\nsys.exit(main())\n", "utf-8")
        words = [str(script), *words[1:]]
    known = environment() | more
    known["PYTHONPATH"] = os.pathsep.join([more.get("PYTHONPATH", ""), known["PYTHONPATH"], str(ROOT)])
    return subprocess.run(
        [sys.executable, *words], cwd=ROOT, env=known, capture_output=True, text=True, timeout=120, check=False
    )


@posix_only
@pytest.mark.parametrize("words", [SHOWING, ["support-exudyn", *SHOWING[2:]]], ids=lambda words: words[1])
def test_an_interruption_while_libraries_are_imported_is_a_line(tmp_path: Path, words: list[str]) -> None:
    name = "numpy"
    (tmp_path / f"{name}.py").write_text(INTERRUPTING.format(folder=str(tmp_path), name=name), "utf-8")
    done = started(words, tmp_path, {"PYTHONPATH": str(tmp_path)})
    assert (done.returncode, done.stderr) == (130, "interrupted; nothing half-written is left\n")
    assert done.stdout == ""


@pytest.mark.parametrize(
    ("encoding", "shown"),
    [
        ("ascii", "5 +- 1 m/s^2, 3 A, 4 * 2 -> 1, \\u4e2d"),
        ("cp932", "5 ± 1 m/s^2, 3 A, 4 * 2 → 1, 中"),
        ("gbk", "5 ± 1 m/s^2, 3 A, 4 · 2 → 1, 中"),
        ("utf-8", "5 ± 1 m/s², 3 Å, 4 · 2 → 1, 中"),
    ],
)
def test_letters_that_a_console_has_not_are_written_in_others(
    encoding: str, shown: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    console = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
    monkeypatch.setattr(sys, "stdout", console)
    be_readable()
    assert console.errors == DEGRADED
    print("5 ± 1 m/s², 3 Å, 4 · 2 → 1, 中", end="", flush=True)
    assert console.buffer.getvalue().decode(encoding) == shown  # type: ignore[attr-defined]


@pytest.mark.parametrize("words", STARTS, ids=lambda words: words[1])
def test_commands_speak_on_the_poorest_console(tmp_path: Path, words: list[str]) -> None:
    done = started(words, tmp_path, {"PYTHONIOENCODING": "ascii"})
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout
