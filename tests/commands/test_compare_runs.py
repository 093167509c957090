"""`compare` with runs: differences with their errors, for eyes and for scripts."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import trapezoid

from support_exudyn import CubicStep, Result, compare_files, simulate
from support_exudyn.__main__ import main
from support_exudyn.postprocessing.comparing.compared_channel import ComparedChannel
from support_exudyn.postprocessing.comparing.compared_file import of_run
from support_exudyn.postprocessing.comparing.files_compared import same_to_the_bit
from tests.cases.run_cases import loose_slider_crank, loose_support, support

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


def one(runs: Path, first: str, second: str, channel: str, **more: Any) -> ComparedChannel:
    """A channel of two runs, compared."""
    return compare_files(*of(runs, first, second), channels=[channel], **more).pairs[0].channels[channel]


def test_differences_are_those_of_the_records(runs: Path) -> None:
    ideal, with_clearance = of(runs, "ideal", "with_clearance")
    found = one(runs, "ideal", "with_clearance", "tip.x", after=0.05, until=0.15)
    inside = (ideal.time > 0.05 - 1e-9) & (ideal.time < 0.15 + 1e-9)
    apart = (with_clearance["tip.x"] - ideal["tip.x"])[inside]
    time = ideal.time[inside]
    first, second = (run.window("tip.x", 0.05, 0.15).mean for run in (ideal, with_clearance))
    assert found.mean.value == second - first  # from every step
    assert found.mean.value == pytest.approx(trapezoid(apart, time) / (time[-1] - time[0]), rel=1e-4)
    assert found.largest.value == np.abs(apart).max()
    assert found.measures.largest == apart[np.abs(apart).argmax()]
    assert found.measures.largest_time == time[np.abs(apart).argmax()]
    # pressed into its bore the journal takes the tip along by 0.98 to 1.27 mm per 0.5 mm (reference data)
    assert -2.6e-3 < found.mean.value < -1.9e-3


@pytest.mark.parametrize("accuracy", ["standard", pytest.param("reference", marks=pytest.mark.slow)])
def test_errors_cover_what_a_finer_run_finds(runs: Path, accuracy: str) -> None:
    ideal, with_clearance = of(runs, "ideal", "with_clearance")
    fine = simulate(with_clearance.scenario, accuracy=accuracy)
    names = ["tip.x", "tip.y", "pin.rear_base.force", "front_column.force"]
    found = compare_files(ideal, with_clearance, fine, channels=names)
    rough, right = (pair.channels for pair in found.pairs)
    for name in names:
        for number in ("mean", "largest"):
            mine, its = getattr(rough[name], number), getattr(right[name], number)
            assert 0.0 < mine.error < math.inf
            assert abs(mine.value - its.value) <= mine.error + its.error, (name, number)


def test_two_accuracies_are_not_told_different(runs: Path) -> None:
    (with_clearance,) = of(runs, "with_clearance")
    fine = simulate(with_clearance.scenario, accuracy=1e-4)
    found = compare_files(with_clearance, fine)
    assert found.pairs[0].same == 0
    for channel in found.pairs[0].channels.values():
        assert channel.largest.value > 0.0 or channel.name.endswith(".balance")
        assert not channel.beside_errors.different, channel.name


def test_a_run_less_itself_is_nothing(runs: Path) -> None:
    found = one(runs, "with_clearance", "with_clearance", "tip.x")
    assert (found.mean.value, found.largest.value) == (0.0, 0.0)
    # both have the same errors, so even a tolerance far below them is met
    same = one(runs, "with_clearance", "with_clearance", "pin.rear_base.force", tolerance="pin.*=1e-9N")
    assert same.largest.error > 1e-9
    assert same.verdict == "within"


def test_runs_of_the_same_bits_are_told(runs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    nudged, with_clearance = Result.load(runs / "with_clearance.h5"), of(runs, "with_clearance")[0]
    nudged["tip.x"][-1] = np.nextafter(nudged["tip.x"][-1], np.inf)
    first, *others = (
        of_run(run, Path(), "") for run in (with_clearance, *of(runs, "with_clearance", "ideal"), nudged)
    )
    assert [same_to_the_bit(first, other) for other in others] == [len(with_clearance.channels), 0, 0]
    loose_file = str(runs / "with_clearance.h5")
    assert main(["compare", loose_file, loose_file, "tip.x"]) == 0
    assert (
        f"the same to the bit: all records of {len(with_clearance.channels)} channels\n"
        in capsys.readouterr().out
    )
    assert main(["compare", str(runs / "ideal.h5"), loose_file, "tip.x"]) == 0
    assert "to the bit" not in capsys.readouterr().out


def test_common_records_of_different_periods_are_compared(runs: Path) -> None:
    found = one(runs, "plain", "rare", "tip.x")
    # both follow the same columns on the same steps; what is left is rounding
    assert found.largest.value < 1e-9
    assert found.common.interpolated == 0
    assert math.isnan(found.mean.error)


def test_records_between_are_interpolated_and_that_is_told(
    runs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = one(runs, "rare", "other", "tip.x")
    assert 0 < found.common.interpolated < found.common.time.size
    # the same motion: what is found apart is what straight lines miss, and is told to be no more
    assert 0.0 < found.largest.value <= float(found.common.interpolation_error.max())
    assert main(["compare", str(runs / "rare.h5"), str(runs / "other.h5"), "tip.x"]) == 0
    told = capsys.readouterr().out
    assert f"{found.common.interpolated} of {found.common.time.size} times lie between records" in told


def test_the_table_is_in_engineers_units(runs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", str(runs / "ideal.h5"), str(runs / "with_clearance.h5"), "--from", "0.1"]) == 0
    told = capsys.readouterr().out
    assert "with_clearance.h5 less ideal.h5, 0.1 to 0.2 s (± numerical errors of both runs)" in told
    row = next(line.split() for line in told.splitlines() if line.strip().startswith("tip.x"))
    assert row[1] == "mm"
    mean = 1e3 * one(runs, "ideal", "with_clearance", "tip.x", after=0.1).mean.value
    # printed to the digits of its error, some 1e-6 mm
    assert float(row[3]) == pytest.approx(mean, abs=1e-4)
    assert row[4] == "±"
    assert "at [s]" in told
    assert told.endswith("No tolerance was given: nothing is judged.\n")


def test_scripts_get_si_units_and_null_for_errors_that_are_not_known(
    runs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["compare", str(runs / "plain.h5"), str(runs / "with_clearance.h5"), "tip.*", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["verdict"], told["written"]) == ("told", [])
    channels = told["files"]["with_clearance.h5"]["channels"]
    assert list(channels) == ["tip.x", "tip.y"]
    tip = channels["tip.x"]
    assert tip["unit"] == "m"
    assert tip["errors_of"] == ["with_clearance.h5"]
    assert tip["mean"]["error"] > 0.0  # of the run that has one
    main(["compare", str(runs / "plain.h5"), str(runs / "rare.h5"), "tip.*", "--json"])
    tip = json.loads(capsys.readouterr().out)["files"]["rare.h5"]["channels"]["tip.x"]
    assert tip["mean"]["error"] is None
    assert tip["beside_errors"] == {"within": None, "times": None}


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["ideal.h5", "crank.h5"], "have no channel in common; ideal.h5 has"),
        (["ideal.h5", "crank.h5", "tip.x"], "tip.x: crank.h5 has no such channel"),
        (["ideal.h5", "with_clearance.h5", "tap.x"], "'tap.x': no such channel"),
        (["ideal.h5", "with_clearance.h5", "--from", "7"], "none lies between 7 and inf s"),
        (["ideal.h5", "no.h5"], "no.h5: no such file"),
        (["ideal.h5", "tip.x"], "is the only file; tip.x is no file that is there"),
        (["ideal.h5", "with_clearance.h5", "--tolerance", "tip.x=1"], "allowed: a share"),
        (["ideal.h5", "with_clearance.h5", "--tolerance", "tip.x=1kN"], "tolerance of tip.x"),
        (["ideal.h5", "with_clearance.h5", "--figure", "figure.bmp"], "ends in .png, .pdf, .svg"),
        (["ideal.h5", "with_clearance.h5", "--page", "page.pdf"], "ends in .html"),
        (["ideal.h5", "with_clearance.h5", "--map", "no.toml"], "no.toml: no such file"),
    ],
)
def test_what_cannot_be_compared_is_said_with_exit_code_2(
    arguments: list[str], said: str, runs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = [str(runs / word) if word.endswith(".h5") else word for word in arguments]
    with pytest.raises(SystemExit) as ended:
        main(["compare", *files])
    assert ended.value.code == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert said in told.err


def test_a_run_with_a_planted_fault_is_not_within(runs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    changed = Result.load(runs / "plain.h5")
    changed["pin.rear_base.force"][:] *= 1.001
    changed.save(runs / "changed.h5")
    words = ["compare", str(runs / "plain.h5"), str(runs / "changed.h5")]
    assert main([*words, "--tolerance", "tip.*=1um,pin.rear_base.force=5%"]) == 0
    with pytest.raises(SystemExit) as ended:
        main([*words, "pin.rear_base.force", "--tolerance", "pin.*=10N"])
    assert ended.value.code == 1
    assert "Not all channels are within their tolerances." in capsys.readouterr().out


def test_nothing_is_decided_by_numbers_that_are_not_known_well_enough(
    runs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (with_clearance,) = of(runs, "with_clearance")
    simulate(with_clearance.scenario, accuracy=1e-4).save(runs / "fine.h5")
    words = ["compare", str(runs / "with_clearance.h5"), str(runs / "fine.h5"), "pin.rear_base.force"]
    with pytest.raises(SystemExit) as ended:
        main([*words, "--tolerance", "pin.*=1e-9N"])  # far below the numerical errors
    assert ended.value.code == 1
    told = capsys.readouterr().out
    assert "is larger than what is allowed, 1e-06 mN: not decided" in told
    assert "cannot be told" in told
