"""`python -m support_exudyn check FILE`: text, JSON, figures, exit codes."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from support_exudyn.__main__ import main
from support_exudyn.files.machines import SHIPPED
from support_exudyn.files.starters import starter
from tests.machine_files import written

# shields as the reference support is one
ALIKE = ("zf18000", "two_leg_shield")


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.slow] * (name in ALIKE)) for name in SHIPPED]
)
def test_shipped_machines_are_drawn(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", name, "--out", str(tmp_path)]) == 0
    said = capsys.readouterr()
    assert "degrees of freedom: " in said.out
    free = name == "slider_crank_guide"  # which nobody drives
    assert f"left: {int(free)}" in said.out
    assert said.err == ""
    pixels = np.asarray(Image.open(tmp_path / f"{name}_check.png").convert("L"))
    assert 0.01 < (pixels < 200).mean() < 0.3  # lines on white paper
    edge = np.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
    assert edge.min() > 200  # nothing is cut off


def test_a_file_of_ones_own_gets_its_figure(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", str(written(tmp_path)), "--json", "--stroke-mm", "300"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["stroke_m"], told["warnings"], len(told["stations"])) == (0.3, [], 11)
    assert told["figures"] == [str(tmp_path / f"ours_check.{kind}") for kind in ("png", "pdf")]
    assert all(Path(figure).exists() for figure in told["figures"])


# dead centre of the starter with a crank of 220 mm: where it and the ground make coupler and rocker straight
STRAIGHT = math.degrees(math.acos((0.22**2 + 0.28**2 - 0.45**2) / (2 * 0.22 * 0.28)))


def test_a_scenario_has_its_own_machine_checked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    texts, module = starter("own_machine"), tmp_path / "rocker_22.py"
    module.write_text(texts["crank_rocker.py"].replace("CrankRocker", "Rocker22"), encoding="utf-8")
    text = texts["ideal.toml"].replace("crank_rocker.py:CrankRocker", "rocker_22.py:Rocker22")
    path = tmp_path / "ideal.toml"
    path.write_text(text.replace("crank = 0.10", "crank = 0.22"), encoding="utf-8")
    assert main(["--import", str(module), "check", str(path)]) == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    assert f"crank at {STRAIGHT:.2f} degrees: dead centre: coupler in line with rocker" in printed.out
    assert (tmp_path / "ideal_check.png").exists()


SCENARIO = """
machine = "reference"
duration_s = 5
drive = { mode = 2 }

[pins.rear_base]
clearance_mm = 1.5
friction = 0.25
stiffness = "paper"
"""


def test_a_scenario_is_told_how_hard_its_pins_are_pressed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "rise.toml"
    path.write_text(SCENARIO, "utf-8")
    assert main(["check", str(path), "--json"]) == 0
    (pin,) = json.loads(capsys.readouterr().out)["pins_under_static_load"]
    assert (pin["pin"], pin["length_m"], pin["conformal"]) == ("rear_base", 0.7, False)
    # as a line, whatever the law; the depth is that of Eq. 5
    assert pin["peak_pressure_Pa"] == pytest.approx(30.8e6 * math.sqrt(pin["force_N"] / 51.4e3), rel=0.01)
    assert pin["depth_m"] == pytest.approx(153e-6 * (pin["force_N"] / 51.4e3) ** (2.0 / 3.0), rel=0.01)
