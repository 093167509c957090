"""Guides with clearance as they are drawn and told."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest

from support_exudyn import ClearanceGuide, Scenario, simulate
from support_exudyn.__main__ import main
from support_exudyn.postprocessing import summary
from support_exudyn.simulation.reported_numbers import measures
from tests.cases.guide_cases import BLOCK, slider_crank

GUIDE = ClearanceGuide.simple(gaps=(2e-3, 1e-3), block=BLOCK)


@pytest.fixture(scope="module")
def scene() -> Scenario:
    return slider_crank(1e9, 0.004, step=1e-4, impact_steps=16)


def test_impacts_are_told_by_corner(
    scene: Scenario, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    result = simulate(replace(scene, record_period=1e-4))
    rows = {row[0]: row for row in summary.impacts_table("impacts", result).rows}
    assert set(rows) == {f"guide.{corner}" for corner in GUIDE.contacts()}
    assert rows["guide.upper_left"][1] == "1 of 1"
    assert rows["guide.upper_left"][6].endswith("N")
    assert rows["guide.lower_left"][1] == "none"
    assert "guide.guide.upper_left.largest_force" in measures(result, 0.0, math.inf)
    assert any(
        name == "guide guide" and "ClearanceGuide" in said
        for name, said in summary.what_is_run(result.scenario)
    )
    path = tmp_path / "run.h5"
    result.save(path)
    assert main(["show", str(path), "--impacts"]) == 0
    assert "guide.upper_right" in capsys.readouterr().out
