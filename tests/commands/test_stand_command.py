"""`python -m support_exudyn stand MACHINE`: page, JSON, figure, exit codes."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from support_exudyn.__main__ import main
from tests.machine_files import OURS, written


def test_a_shipped_support_is_told_on_a_page(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["stand", "two_leg_shield"]) == 0
    said = capsys.readouterr()
    assert said.err == ""
    assert said.out.startswith("two-leg shield 20/32 (own design, masses assumed): what it must stand\n")
    assert len(said.out.splitlines()) <= 60


def test_numbers_are_one_object_in_si(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["stand", "zf18000", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["rated_force_N"] == 18e6
    assert len(told["postures"]) == 21
    assert told["postures"][0]["yield"]["force_N"] == pytest.approx(17.77e6, rel=1e-3)
    assert told["pins"]["rear_base"]["stresses"]["safeties"]["bearing"] > 1.0
    assert told["figures"] == []


def test_a_scenario_and_a_figure(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    section = "\n".join(
        f"[strength.cylinders.{name}]\nbore_mm = 200\nyield_pressure_MPa = 40\n"
        for name in ("front_column", "rear_column")
    )
    written(tmp_path, text=f"{OURS}\n{section}")
    scenario = tmp_path / "rise.toml"
    scenario.write_text('machine = "ours.toml"\nduration_s = 1\n', encoding="utf-8")
    assert main(["stand", str(scenario), "--figure", str(tmp_path / "figures")]) == 0
    said = capsys.readouterr().out
    figure = tmp_path / "figures" / "rise_stand.png"
    assert str(figure) in said
    assert "6 eccentric load and torsion: not told, no lateral dimensions" in said
    pixels = np.asarray(Image.open(figure).convert("L"))
    assert 0.01 < (pixels < 200).mean() < 0.3
    edge = np.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
    assert edge.min() > 200  # nothing is cut off
    assert figure.with_suffix(".pdf").read_bytes().startswith(b"%PDF")


def test_what_cannot_be_told_is_said_in_a_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, why in (
        (str(written(tmp_path)), "strength: missing"),
        ("slider_crank", "it has no actuators"),
        ("nothing", "there is none of this name"),
    ):
        assert main(["stand", name]) == 1
        said = capsys.readouterr()
        assert said.out == ""
        assert said.err.startswith("error: ")
        assert why in said.err
        assert len(said.err.splitlines()) == 1
