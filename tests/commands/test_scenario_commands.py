"""`run` and `scenario`: a file is simulated, and the file of a run makes the same run again, to the bit."""

from __future__ import annotations

import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from studies.common.paper_machine import JACK, clearance_joint, oil_columns
from support_exudyn import (
    CubicStep,
    IdealPin,
    OwnBody,
    Result,
    Roof,
    Scenario,
    Steady,
    TableDrive,
    cylinders_and_rods,
    ravn_slider_crank,
    reference_support,
    simulate,
)
from support_exudyn.__main__ import main
from support_exudyn.files import read_scenario
from user_forces import CubicCoulomb

EXAMPLES = Path(__file__).parents[2] / "support_exudyn" / "files" / "examples"
STROKE = CubicStep(stroke=0.005, start=0.01, end=0.04)
BASE = Scenario(
    machine=reference_support(), drive=STROKE, duration=0.05, pins={"rear_base": clearance_joint(1.5, 0.25)}
)
POINTS = TableDrive(times=(0.0, 0.015, 0.035), extensions=(0.0, 0.005, 0.001))
ROOF = Roof(
    body="canopy",
    point=reference_support().linkage().bodies["canopy"].centre,
    descent=CubicStep(stroke=0.003, start=0.0, end=0.05),
    stiffness=1e7,
)
RUBBING = IdealPin(friction=CubicCoulomb(sliding_coefficient=0.1), radius=0.06)
SCENARIOS = {
    "exudyn": BASE,
    "compiled": replace(BASE, machine=reference_support(), formulation="compiled", actuators=oil_columns()),
    "space": replace(BASE, dimensions=3, duration=0.02, record_period=0.005),
    "accuracy": replace(BASE, accuracy="draft", channels=("tip.*",)),
    "oil": replace(BASE, actuators=oil_columns(), start="settled"),
    "two bodies": replace(BASE, actuators=cylinders_and_rods(), pins={"front_base": RUBBING}),
    "tail beam": replace(BASE, parts={"tail_beam": OwnBody(jack=JACK)}),
    "load": replace(BASE, loads={"roof": ROOF}, actuators=oil_columns()),
    "table": replace(BASE, drive=POINTS),
    "jumps": replace(BASE, drive=replace(POINTS, between="linear")),
    "apart": replace(BASE, actuators=oil_columns(), drives={"rear_column": POINTS}),
    "crank": Scenario(
        machine=ravn_slider_crank(), drive=Steady(rate=500.0), duration=0.01, step=1e-5, record_period=1e-4
    ),
}


def same(one: Result, other: Result) -> None:
    assert set(one.channels) == set(other.channels)
    for name in one.channels:
        assert np.array_equal(one[name], other[name]), name
    assert one.onsets == other.onsets
    assert one.impulses == other.impulses
    assert (one.coarser is None) == (other.coarser is None)
    if one.coarser is not None and other.coarser is not None:
        same(one.coarser, other.coarser)


def again(result: Result, folder: Path) -> Result:
    """The run of the scenario that the command writes of a run."""
    result.save(folder / "a.h5")
    assert main(["scenario", str(folder / "a.h5"), "--out", str(folder / "b.toml")]) == 0
    assert main(["run", str(folder / "b.toml")]) == 0
    return Result.load(folder / "b.h5")


LONGER = ("apart", "jumps", "load", "tail beam")


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.slow] * (name in LONGER)) for name in SCENARIOS]
)
def test_the_scenario_of_a_run_makes_it_again_to_the_bit(name: str, tmp_path: Path) -> None:
    result = simulate(SCENARIOS[name])
    same(again(result, tmp_path), result)


def test_a_run_with_errors_is_made_again_with_them(tmp_path: Path) -> None:
    scenario = replace(BASE, pins={}, duration=0.05, record_period=0.002, step=1e-3)
    result = simulate(scenario, errors=True)
    same(again(result, tmp_path), result)


def test_a_run_tells_what_came_out_and_where_it_is(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for one in EXAMPLES.glob("columns_apart.*"):
        shutil.copy(one, tmp_path)
    assert main(["run", str(tmp_path / "columns_apart.toml")]) == 0
    told = capsys.readouterr()
    assert told.err == ""  # no bar where there is no terminal
    lines = told.out.splitlines()
    assert lines[0] == "columns driven apart, 0 to 2 s (± estimated numerical error)"
    assert lines[-1] == str(tmp_path / "columns_apart.h5")
    for word in ("pin.rear_base.force.mean", "tip.y", "formulation"):
        assert any(line.strip().startswith(word) for line in lines)
    result = Result.load(tmp_path / "columns_apart.h5")
    asked = read_scenario(tmp_path / "columns_apart.toml")
    chosen = {"formulation": "compiled", "step": result.scenario.step, "solver": result.scenario.solver}
    assert result.scenario == replace(asked, **chosen, accuracy=None)
    assert result.met
    # which formulation ran, and why
    assert "compiled (auto: the cheapest, and it covers this scene)" in told.out
    assert main(["show", str(tmp_path / "columns_apart.h5")]) == 0
    assert "compiled (auto: the cheapest" in " ".join(capsys.readouterr().out.split())
    # the actuators' lengths are 160 and 150 mm more than at the start, within what oil gives: 1.5 mm at 300 kN
    ends = {name: float(np.ptp(result[f"{name}.length"])) for name in ("front_column", "rear_column")}
    assert ends == pytest.approx({"front_column": 0.16, "rear_column": 0.15}, abs=1.5e-3)


def refused(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    assert main(arguments) == 1
    told = capsys.readouterr()
    assert told.out == ""
    return told.err


def test_what_cannot_be_run_is_said_in_a_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "a.toml"
    path.write_text('machine = "reference"\nduration_s = -1\n')
    assert refused(["run", str(path)], capsys) == f"error: {path}: duration_s = -1: allowed: > 0\n"
    assert "no.toml" in refused(["run", str(tmp_path / "no.toml")], capsys)
    path.write_text('machine = "reference"\nduration_s = 1\n')
    assert "is the scenario itself" in refused(["run", str(path), "--out", str(path)], capsys)
    (tmp_path / "folder").mkdir()
    assert "irectory" in refused(["run", str(path), "--out", str(tmp_path / "folder")], capsys)
    assert [one.name for one in sorted(tmp_path.iterdir())] == ["a.toml", "folder"]


OWN = '''
from support_exudyn import ImpactStand
from user_forces import NormalLaw
from user_forces.normal.power_laws import Hertz
from user_forces.values.value import value

@value
class Twice(Hertz):
    """Hertz's law, twice as stiff."""
    @staticmethod
    def force(depth, rate, impact_velocity, stiffness, exponent):
        return 2.0 * stiffness * depth**exponent
    @staticmethod
    def elastic(depth, stiffness, exponent):
        return 2.0 * stiffness * depth**exponent
    @staticmethod
    def energy(depth, stiffness, exponent):
        return 2.0 * stiffness / (exponent + 1.0) * depth ** (exponent + 1.0)
'''
FALL = """
duration_s = 0.01
record_period_ms = 1
[machine]
type = "ImpactStand"
bore_mass_kg = 3
journal_mass_kg = 1
speed_m_per_s = 1
[pins.pin]
clearance_mm = 1
bore_radius_mm = 60
law = "Twice"
"""


def program(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "support_exudyn", *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def test_laws_of_ones_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "my_laws.py").write_text(OWN)
    (tmp_path / "a.toml").write_text(FALL)
    assert "pins.pin.law = 'Twice': allowed: " in refused(["run", "a.toml"], capsys)
    assert program("--import", "my_laws.py", "run", "a.toml", folder=tmp_path).returncode == 0
    moved = (tmp_path / "my_laws.py").rename(tmp_path / "laws_of_mine.py")  # the run knows where it was
    shown = program("show", "a.h5", folder=tmp_path)
    assert shown.returncode == 0
    assert shown.stderr.startswith(
        f"warning: a.h5: 'Twice' is a class of {tmp_path / 'my_laws.py'}, which is not"
    )
    assert shown.stderr.count("\n") == 1
    assert "Twice (" in shown.stdout
    told = program("show", "a.h5", "--import", str(moved), folder=tmp_path)
    assert (told.returncode, told.stderr) == (0, "")
    assert "peak pressure" not in shown.stdout
    assert "peak pressure" in told.stdout
    before = shown.stdout.partition("\n\nclearance pins")[0].partition("\n\nfirst impacts")[0]
    assert told.stdout.startswith(before)  # the same numbers
