"""`python -m support_exudyn stand MACHINE`: page, JSON, figure, exit codes."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from support_exudyn.__main__ import main
from tests.machine_files import OURS, written


def test_the_page_and_its_numbers_in_si(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["stand", "zf18000"]) == 0
    printed = capsys.readouterr()
    assert (printed.err, len(printed.out.splitlines()) <= 60) == ("", True)
    assert main(["stand", "zf18000", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert (report["rated_N"], len(report["forces"]), report["figures"]) == (18e6, 21, [])
    assert report["forces"][0]["yielding"]["force_N"] == pytest.approx(17.774e6, rel=1e-4)
    assert report["pins"]["rear_base"]["stresses"][0]["safeties"]["bearing"] > 1.0


def test_a_scenario_and_a_figure(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    section = "\n".join(
        f"[strength.cylinders.{name}]\nbore_mm = 200\nyield_pressure_MPa = 40\n"
        for name in ("front_column", "rear_column")
    )
    written(tmp_path, text=f"{OURS}\n{section}")
    scenario = tmp_path / "rise.toml"
    scenario.write_text('machine = "ours.toml"\nduration_s = 1\n', encoding="utf-8")
    assert main(["stand", str(scenario), "--figure", str(tmp_path / "figures")]) == 0
    figure = tmp_path / "figures" / "rise_stand.png"
    assert str(figure) in capsys.readouterr().out
    pixels = np.asarray(Image.open(figure).convert("L"))
    assert 0.01 < (pixels < 200).mean() < 0.3
    edge = np.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
    assert edge.min() > 200  # nothing is cut off


@pytest.mark.parametrize(
    ("name", "why"),
    [
        (None, "strength: missing"),
        ("slider_crank", "it has no actuators"),
        ("nothing", "there is none of this name"),
    ],
)
def test_what_has_no_strength_is_refused_in_a_line(
    name: str | None, why: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["stand", name or str(written(tmp_path))]) == 1
    printed = capsys.readouterr()
    assert (printed.out, printed.err[:7], len(printed.err.splitlines())) == ("", "error: ", 1)
    assert why in printed.err


SECTION = """
[strength.cylinders.front_column]
bore_mm = 200
yield_pressure_MPa = 40
setting_pressure_MPa = 30
stages = [{ outer_diameter_mm = 250, length_mm = 900 }, { outer_diameter_mm = 190, length_mm = 2000 }]

[strength.cylinders.rear_column]
bore_mm = 200
yield_pressure_MPa = 40

[strength.base]
rear_mm = -100
front_mm = 2000
width_mm = 1000
mass_kg = 2000
centre_mm = [900, 250]
floor_mm = -50
"""


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("setting_pressure_MPa = 30", "setting_pressure_MPa = 50", "setting_pressure = 50 MPa"),
        ("floor_mm = -50", "floor_mm = 5000", "strength.base.floor = 5 m: the common centre of mass is 1"),
        ("length_mm = 900 }", "length_mm = 5000 }", "strength.cylinders.front_column.stages[0].length"),
        ("length_mm = 2000 }", "length_mm = 200 }", "stages: together 1.1 m long"),
        ("stroke_mm = 600", "stroke_mm = 3000", "ours.toml: stroke = 3 m: the linkage locks before"),
    ],
)
def test_refusals_name_the_file_and_what_is_wrong(
    old: str, new: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = written(tmp_path, old, new, text=OURS + SECTION)
    assert main(["stand", str(path)]) != 0
    assert said in capsys.readouterr().err
