"""The README's tutorial, from its text alone: its commands run, its answer is right."""

from __future__ import annotations

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import root

from support_exudyn import Result
from support_exudyn.__main__ import main
from support_exudyn.files.machines.read import read_machine
from support_exudyn.machines.four_column_support import HydraulicSupport
from tests.cases.sweep_cases import run_by

README = Path(__file__).parents[2] / "README.md"
FIRST, LAST = "## Your own support in ten minutes\n", "\n## Ask for an accuracy"


def section() -> str:
    """The part of the README that shows commands."""
    return README.read_text(encoding="utf-8").partition(FIRST)[2].partition(LAST)[0]


def commands() -> list[list[str]]:
    """The words of the commands of the section, in their order."""
    shown = re.findall(r"```sh\n(.*?)```", section(), re.DOTALL)
    return [shlex.split(line, comments=True) for text in shown for line in text.splitlines()]


def test_all_commands_work_on_a_run_of_a_moment(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    run_by(monkeypatch)
    for words in commands():
        if words[0] == "cd":
            monkeypatch.chdir(words[1])
            for path in Path().glob("*.toml"):
                path.write_text(shortened(path.read_text(encoding="utf-8")), encoding="utf-8")
            continue
        assert words[0] == "support-exudyn"
        given = ["0.05" if word == "1" else word for word in words[1:]]  # --still 1
        assert main(given) == 0, words
        assert "error" not in capsys.readouterr().err
    assert {"machine_check.png", "clearance_0.05s.png"} <= {path.name for path in Path().glob("*.png")}
    assert list(Path("sizes_sweep/figures").glob("*.png"))


def shortened(text: str) -> str:
    """A file of the tutorial with a run of a moment."""
    short = re.sub(r"^(duration_s|end_s) = 2$", r"\1 = 0.05", text, flags=re.MULTILINE)
    short = re.sub(r"^stroke_mm = 600$", "stroke_mm = 15", short, flags=re.MULTILINE)
    return short.replace("[0.5, 1.0, 1.5, 2.0]", "[1.0, 2.0]")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What is there when all has been done as the page says, and what was printed, as COMMAND.out."""
    where = tmp_path_factory.mktemp("tutorial")
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    for words in commands():
        if words[0] == "cd":
            where /= words[1]
            continue
        done = subprocess.run(
            words, cwd=where, env={**os.environ, "PATH": path}, capture_output=True, text=True, timeout=300,
            check=False,
        )  # fmt: skip
        told = [
            line for line in done.stderr.splitlines() if not line.startswith("compiling (")
        ]  # once a machine
        assert (done.returncode, told) == (0, []), words
        (where / f"{words[1]}.out").write_text(done.stdout, encoding="utf-8")
    return where


@pytest.mark.slow  # the runs of the page take half a minute
def test_the_answer_is_that_of_the_page(folder: Path) -> None:
    text = " ".join(section().split())
    found = re.search(r"moves the tip ([\d.]+) ± ([\d.]+) mm to the rear and ([\d.]+) ± ([\d.]+) mm up", text)
    assert found is not None
    back, back_error, up, up_error = map(float, found.groups())
    ideal, with_clearance = (Result.load(folder / f"{name}.h5") for name in ("ideal", "clearance"))
    # the page's own errors cover those of the runs and the rounding of what is printed
    moved = [with_clearance.window(f"tip.{axis}").mean - ideal.window(f"tip.{axis}").mean for axis in "xy"]
    assert -1e3 * moved[0] == pytest.approx(back, abs=back_error)
    assert 1e3 * moved[1] == pytest.approx(up, abs=up_error)
    printed = (folder / "compare.out").read_text(encoding="utf-8")
    row = next(line.split() for line in printed.splitlines() if line.strip().startswith("tip.x"))
    assert float(row[5]) == pytest.approx(-back, abs=back_error)


@pytest.mark.slow  # the runs of the page take half a minute
def test_the_tip_moves_as_geometry_has_it(folder: Path) -> None:
    """The journal lies where the bore's force holds it; all lengths stay, and the four-bar closes anew."""
    ideal, with_clearance = (Result.load(folder / f"{name}.h5") for name in ("ideal", "clearance"))
    machine = read_machine("machine.toml", folder).machine
    assert isinstance(machine, HydraulicSupport)

    def middle(result: Result, name: str) -> float:  # 1 s, where the columns have extended by half the stroke
        return float(result[name][np.searchsorted(result.time, 1.0)])

    force = np.array([middle(ideal, f"pin.rear_base.force_{axis}") for axis in "xy"])
    offset = -(0.001 + middle(with_clearance, "pin.rear_base.depth")) * force / np.hypot(*force)
    shift = np.array([middle(with_clearance, f"tip.{axis}") - middle(ideal, f"tip.{axis}") for axis in "xy"])
    # friction and inertia turn the force a little away from that of the ideal pin, which moves some percent
    np.testing.assert_allclose(shift, shifted(machine, 0.3, offset), atol=0.03 * np.hypot(*shift))


def shifted(machine: HydraulicSupport, stroke: float, offset: np.ndarray) -> np.ndarray:
    """By how much the tip moves [m] if the rear link's lower end is so far off its pivot, its columns held."""
    posture = machine.extended(stroke)
    assert posture is not None
    points = {
        name: np.array(getattr(posture, name)) for name in ("rear_shield", "front_shield", "hinge", "tip")
    }
    heads = [np.array(posture.ends["front_head"]), np.array(posture.ends["rear_head"])]
    feet = [np.array(machine.front_foot), np.array(machine.rear_foot)]
    base = np.array(machine.rear_base), np.array(machine.front_base)

    def turned(point: np.ndarray, hinge: np.ndarray, angle: float) -> np.ndarray:
        c, s = np.cos(angle), np.sin(angle)
        return np.asarray(hinge + np.array([[c, -s], [s, c]]) @ (point - points["hinge"]))

    def lengths(unknown: np.ndarray, rear_pivot: np.ndarray) -> np.ndarray:
        c, d, i, angle = unknown[:2], unknown[2:4], unknown[4:6], unknown[6]
        links = (c - rear_pivot, d - base[1], d - c, i - c, i - d)
        columns = (turned(head, i, angle) - foot for head, foot in zip(heads, feet, strict=True))
        return np.array([np.hypot(*line) for line in (*links, *columns)])

    start = np.concatenate([points["rear_shield"], points["front_shield"], points["hinge"], [0.0]])
    kept = lengths(start, base[0])
    found = root(lambda x: lengths(x, base[0] + offset) - kept, start, tol=1e-12).x
    return turned(points["tip"], found[4:6], found[6]) - points["tip"]


@pytest.mark.slow  # the runs of the page take half a minute
def test_the_sweep_is_a_straight_line(folder: Path) -> None:
    rows = (folder / "sizes_sweep" / "table.csv").read_text(encoding="utf-8").splitlines()
    head = [json.loads(cell) for cell in rows[0].split(",")]
    table = [dict(zip(head, row.split(","), strict=True)) for row in rows[1:]]
    sizes = [float(row["pins.rear_base.clearance_mm"]) for row in table]
    tips = [float(row["tip.x.mean_m"]) for row in table]
    assert sizes == [0.5, 1.0, 1.5, 2.0]
    line = np.polyfit(sizes, tips, 1)
    # geometry is linear in so small a shift: what is left is of its second order and of the depth's change
    np.testing.assert_allclose(tips, np.polyval(line, sizes), atol=2e-6)
    assert -2.4e-3 < line[0] < -1.8e-3
    # from 1 mm on friction sets the pin vibrating: its force swings by a half, but it does not part
    peaks = [float(row["pin.rear_base.largest_force_N"]) for row in table]
    assert peaks[0] < 26e3
    assert all(36e3 < peak < 41e3 for peak in peaks[1:])
