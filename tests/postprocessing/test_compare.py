"""`compare`: differences of two runs with their errors, for eyes and for scripts."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import CubicStep, Result, simulate
from support_exudyn.__main__ import main
from support_exudyn.postprocessing.comparing.own_runs import compared, same_to_the_bit
from tests.cases.run_cases import loose_slider_crank, loose_support, support
from user_forces import InputError

STROKE = CubicStep(stroke=0.025, start=0.0, end=0.2)


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("runs")
    ideal = support(drive=STROKE, duration=0.2, start="settled")
    with_clearance = replace(loose_support(1.0, 0.25, duration=0.2), drive=STROKE, start="settled")
    simulate(ideal, accuracy="draft").save(folder / "ideal.h5")
    simulate(with_clearance, accuracy="draft").save(folder / "with_clearance.h5")
    simulate(ideal).save(folder / "plain.h5")
    simulate(replace(ideal, record_period=4e-3)).save(folder / "rare.h5")
    simulate(replace(ideal, record_period=3e-3)).save(folder / "other.h5")
    simulate(loose_slider_crank(0.05, formulation="compiled", record_period=5e-5)).save(folder / "crank.h5")
    return folder


def of(runs: Path, *names: str) -> list[Result]:
    return [Result.load(runs / f"{name}.h5") for name in names]


def test_differences_are_those_of_the_records(runs: Path) -> None:
    ideal, with_clearance = of(runs, "ideal", "with_clearance")
    found = compared(ideal, with_clearance, ["tip.x"], 0.05, 0.15)["tip.x"]
    inside = (ideal.time > 0.0495) & (ideal.time < 0.1505)
    apart = (with_clearance["tip.x"] - ideal["tip.x"])[inside]
    assert found.mean.value == apart.mean()
    assert found.largest.value == apart[np.abs(apart).argmax()]
    assert found.time == ideal.time[inside][np.abs(apart).argmax()]
    assert found.first.value == ideal["tip.x"][inside].mean()
    # pressed into its bore the journal takes the tip along by 0.98 to 1.27 mm per 0.5 mm (reference data)
    assert -2.6e-3 < found.mean.value < -1.9e-3


@pytest.mark.parametrize("accuracy", ["standard", pytest.param("reference", marks=pytest.mark.slow)])
def test_errors_cover_what_a_finer_run_finds(runs: Path, accuracy: str) -> None:
    ideal, with_clearance = of(runs, "ideal", "with_clearance")
    fine = simulate(with_clearance.scenario, accuracy=accuracy)
    names = ["tip.x", "tip.y", "pin.rear_base.force", "front_column.force"]
    rough, right = compared(ideal, with_clearance, names), compared(ideal, fine, names)
    for name in names:
        for number in ("mean", "largest"):
            mine, its = getattr(rough[name], number), getattr(right[name], number)
            assert 0.0 < mine.error < math.inf
            assert abs(mine.value - its.value) <= mine.error + its.error, (name, number)


def test_a_run_less_itself_is_nothing(runs: Path) -> None:
    (with_clearance,) = of(runs, "with_clearance")
    found = compared(with_clearance, with_clearance, ["tip.x"])["tip.x"]
    assert (found.mean.value, found.largest.value) == (0.0, 0.0)


def test_runs_of_the_same_bits_are_told(runs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ideal, with_clearance = of(runs, "ideal", "with_clearance")
    assert same_to_the_bit(with_clearance, Result.load(runs / "with_clearance.h5")) == len(
        with_clearance.channels
    )
    assert same_to_the_bit(ideal, with_clearance) == 0
    nudged = Result.load(runs / "with_clearance.h5")
    nudged["tip.x"][-1] = np.nextafter(nudged["tip.x"][-1], np.inf)
    assert same_to_the_bit(with_clearance, nudged) == 0
    loose_file = str(runs / "with_clearance.h5")
    assert main(["compare", loose_file, loose_file, "tip.x"]) == 0
    assert (
        f"the same to the bit: all records of {len(with_clearance.channels)} channels\n"
        in capsys.readouterr().out
    )
    assert main(["compare", str(runs / "ideal.h5"), loose_file, "tip.x"]) == 0
    assert "to the bit" not in capsys.readouterr().out


def test_common_records_of_different_periods_are_compared(runs: Path) -> None:
    plain, rare = of(runs, "plain", "rare")
    found = compared(plain, rare, ["tip.x"])["tip.x"]
    # both follow the same columns on the same steps; what is left is rounding
    assert abs(found.largest.value) < 1e-9
    assert math.isnan(found.mean.error)


def test_the_table_is_in_engineers_units(runs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", str(runs / "ideal.h5"), str(runs / "with_clearance.h5"), "--from", "0.1"]) == 0
    told = capsys.readouterr().out
    assert "with_clearance.h5 less ideal.h5, 0.1 to 0.2 s (± numerical errors of both runs)" in told
    row = next(line.split() for line in told.splitlines() if line.strip().startswith("tip.x"))
    ideal, with_clearance = of(runs, "ideal", "with_clearance")
    assert row[1] == "mm"
    mean = 1e3 * compared(ideal, with_clearance, ["tip.x"], 0.1)["tip.x"].mean.value
    # printed to the digits of its error, some 1e-6 mm
    assert float(row[8]) == pytest.approx(mean, abs=1e-4)
    assert "at [s]" in told


def test_scripts_get_si_units_and_null_for_errors_that_are_not_known(
    runs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["compare", str(runs / "plain.h5"), str(runs / "with_clearance.h5"), "tip.*", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert list(told) == ["tip.x", "tip.y"]
    assert told["tip.x"]["unit"] == "m"
    assert told["tip.x"]["mean"]["error"] is None
    assert told["tip.x"]["second"]["error"] > 0.0


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["ideal.h5", "crank.h5"], "no channel in common"),
        (["ideal.h5", "crank.h5", "tip.x"], "tip.x: the second run has no such channel"),
        (["ideal.h5", "with_clearance.h5", "tap.x"], "'tap.x': no such channel"),
        (["ideal.h5", "with_clearance.h5", "--from", "7"], "from 7 to 0.2 s: 0 records lie between"),
        (["ideal.h5", "no.h5"], "no.h5: no such file"),
    ],
)
def test_what_cannot_be_compared_is_said(
    arguments: list[str], said: str, runs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = [str(runs / word) if word.endswith(".h5") else word for word in arguments]
    assert main(["compare", *files]) == 1
    told = capsys.readouterr()
    assert told.out == ""
    assert said in told.err


def test_runs_without_a_common_record_are_refused(runs: Path) -> None:
    rare, other = of(runs, "rare", "other")
    with pytest.raises(InputError, match=r"no record at the same time"):
        compared(rare, other, ["tip.x"], 0.0025, 0.0045)
