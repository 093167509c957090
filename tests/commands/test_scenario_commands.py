"""`run` and `scenario`: a file is simulated, and the file of a run makes the same run again, to the bit."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from studies.common.paper_machine import clearance_joint, oil_columns
from support_exudyn import (
    CubicStep,
    Result,
    Scenario,
    reference_support,
    simulate,
)
from support_exudyn.__main__ import main

STROKE = CubicStep(stroke=0.005, start=0.01, end=0.04)
BASE = Scenario(
    machine=reference_support(), drive=STROKE, duration=0.05, pins={"rear_base": clearance_joint(1.5, 0.25)}
)
SCENARIOS = {
    "exudyn": BASE,
    "compiled": replace(BASE, machine=reference_support(), formulation="compiled", actuators=oil_columns()),
    "space": replace(BASE, dimensions=3, duration=0.02, record_period=0.005),
    "accuracy": replace(BASE, accuracy="draft", channels=("tip.*",)),
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


@pytest.mark.parametrize("name", SCENARIOS)
def test_the_scenario_of_a_run_makes_it_again_to_the_bit(name: str, tmp_path: Path) -> None:
    result = simulate(SCENARIOS[name])
    result.save(tmp_path / "a.h5")
    assert main(["scenario", str(tmp_path / "a.h5"), "--out", str(tmp_path / "b.toml")]) == 0
    assert main(["run", str(tmp_path / "b.toml")]) == 0
    same(Result.load(tmp_path / "b.h5"), result)


def test_what_cannot_be_run_is_refused_in_a_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "a.toml"
    path.write_text('machine = "reference"\nduration_s = 1\n')
    (tmp_path / "folder").mkdir()
    for words, why in (
        (["run", str(tmp_path / "no.toml")], "no.toml"),
        (["run", str(path), "--solution", str(path)], "is the scenario itself"),
        (["run", str(path), "--out", str(tmp_path / "folder")], "irectory"),
    ):
        assert main(words) == 1
        printed = capsys.readouterr()
        assert (printed.out, why in printed.err) == ("", True)
    assert [each.name for each in sorted(tmp_path.iterdir())] == ["a.toml", "folder"]
