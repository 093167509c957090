"""Sweeps of runs of some milliseconds: a journal that bounces in a bore."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

import pytest

from support_exudyn.sweeps import read_table
from support_exudyn.sweeps.work import run_task
from tests.processes import ROOT, environment

STAND = """
[scenario]
duration_s = {duration}
record_period_s = 1e-4
step_s = 1e-4
gravity_m_per_s2 = [0.0, 0.0]
[scenario.machine]
type = "ImpactStand"
bore_mass_kg = 10.0
journal_mass_kg = 1.0
speed_m_per_s = 0.2
[scenario.pins.pin]
clearance_mm = 1.0
bore_radius_mm = 65.5
"""
NUMBERS = ["pin.pin.force.mean", "pin.pin.force.largest", "pin.pin.largest_force", "journal.x.last"]


def write_sweep(folder: Path, vary: str, *, head: str = "", record: str = "", duration: float = 0.02) -> Path:
    """The file of a sweep of the stand.

    vary: lines of its table. head: of its top. record: lines in place of those that note NUMBERS.
    """
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "sweep.toml"
    noted = record or f"numbers = {NUMBERS}"
    text = f"{head}\n{STAND.format(duration=duration)}\n[vary]\n{vary}\n[record]\n{noted}\n"
    path.write_text(text, encoding="utf-8")
    return path


def speeds(number: int) -> str:
    """So many speeds, all different."""
    return f'"machine.speed_m_per_s" = {{from = 0.1, to = 0.3, steps = {number}}}'


def start(path: Path, *options: str) -> subprocess.Popen[str]:
    """The command as a process in a session of its own."""
    return subprocess.Popen(
        [sys.executable, "-m", "support_exudyn", "sweep", str(path), *options],
        cwd=ROOT,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def run_by(monkeypatch: pytest.MonkeyPatch, here: Any = None) -> None:
    """Let sweeps make their runs by a generator; by default in this process, one after the other."""
    one_by_one = here or (lambda tasks, workers: map_closed(run_task, tasks))
    monkeypatch.setattr("support_exudyn.sweeps.run.here", one_by_one)


def map_closed(function: Callable[[Any], Any], items: Iterable[Any]) -> Iterator[Any]:
    """As `map`, which has no `close`."""
    for item in items:
        yield function(item)


def rows(store: Path) -> dict[str, str]:
    """Lines of finished runs by key; the time that one took changes if it is made again."""
    file = store / "rows.txt"
    lines = file.read_text(encoding="utf-8").splitlines() if file.exists() else []
    return {line.partition(" ")[0]: line for line in lines if line.endswith("}")}


def columns(store: Path) -> dict[str, list[Any]]:
    """The table but for times that runs took."""
    table = read_table(store).to_pydict()
    del table["wall_time_s"]
    return table
