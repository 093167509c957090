"""`compare` with runs: their errors, horizons and bits; a file of ADAMS; Siconos's four-bar."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import trapezoid

from support_exudyn import CubicStep, Result, compare_files, simulate
from support_exudyn.__main__ import main
from support_exudyn.postprocessing.comparing.compare_page import compare_figure
from support_exudyn.postprocessing.comparing.compared_channel import ComparedChannel
from tests.cases.run_cases import loose_slider_crank, loose_support, support
from tests.postprocessing.comparing.test_own_runs import five_pins

STROKE = CubicStep(stroke=0.025, start=0.0, end=0.2)
DATA = Path(__file__).parents[1] / "files" / "series" / "data"
FOUR_BAR = Path(__file__).parents[2] / "studies" / "outside" / "compare_four_bar"
GRAVITY = 386.0885827  # of the file of ADAMS [inch/s^2]
FORCE = "pin.rear_base.force"


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("runs")
    ideal = support(drive=STROKE, duration=0.2, start="settled")
    with_clearance = replace(loose_support(1.0, 0.25, duration=0.2), drive=STROKE, start="settled")
    simulate(ideal, accuracy="draft").save(folder / "ideal.h5")
    simulate(with_clearance, accuracy="draft").save(folder / "with_clearance.h5")
    simulate(with_clearance, accuracy=1e-4).save(folder / "fine.h5")
    simulate(ideal).save(folder / "plain.h5")
    simulate(replace(ideal, record_period=4e-3)).save(folder / "rare.h5")
    simulate(replace(ideal, record_period=3e-3)).save(folder / "other.h5")
    simulate(loose_slider_crank(0.05, formulation="compiled", record_period=5e-5)).save(folder / "crank.h5")
    changed = Result.load(folder / "plain.h5")
    changed[FORCE][:] *= 1.001
    changed.save(folder / "changed.h5")
    return folder


def one(runs: Path, first: str, second: str, channel: str, **more: Any) -> ComparedChannel:
    """A channel of two runs, compared."""
    files = (runs / f"{name}.h5" for name in (first, second))
    return compare_files(*files, channels=[channel], **more).pairs[0].channels[channel]


@pytest.mark.parametrize(
    ("files", "words", "code", "said"),
    [
        ("ideal with_clearance", "--after 0.1", 0, "0.1 to 0.2 s (± numerical errors of ideal.h5 and with"),
        ("plain changed", f"--tolerance tip.*=1um,{FORCE}=5%", 0, "All channels are within"),
        ("plain changed", f"{FORCE} --tolerance pin.*=10N", 1, "Not all channels are within their tolerances."),
        ("with_clearance fine", f"{FORCE} --tolerance pin.*=1e-9N", 1, "not decided"),
        ("ideal crank", "", 2, "no channel in common; ideal.h5 has"),
        ("ideal no", "", 2, "no.h5: no such file"),
        ("ideal", "tip.x", 2, "is the only file; tip.x is no file that is there"),
        ("ideal with_clearance", "--figure figure.bmp", 2, "ends in .png, .pdf, .svg"),
        ("ideal with_clearance", "--map no.toml", 2, "no.toml: no such file"),
    ],
)
def test_what_is_said_of_runs(
    files: str, words: str, code: int, said: str, runs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["compare", *(str(runs / f"{name}.h5") for name in files.split()), *words.split()]) == code
    told = capsys.readouterr()
    assert said in (told.err if code == 2 else told.out)
    assert bool(told.out) == (code != 2)


def test_differences_are_those_of_the_records(runs: Path) -> None:
    ideal, with_clearance = (Result.load(runs / f"{name}.h5") for name in ("ideal", "with_clearance"))
    found = one(runs, "ideal", "with_clearance", "tip.x", after=0.05, until=0.15)
    inside = (ideal.time > 0.05 - 1e-9) & (ideal.time < 0.15 + 1e-9)
    apart, time = (with_clearance["tip.x"] - ideal["tip.x"])[inside], ideal.time[inside]
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
    fine = simulate(Result.load(runs / "with_clearance.h5").scenario, accuracy=accuracy)
    names = ["tip.x", "tip.y", FORCE, "front_column.force"]
    found = compare_files(runs / "ideal.h5", runs / "with_clearance.h5", fine, channels=names)
    rough, right = (pair.channels for pair in found.pairs)
    for name in names:
        for number in ("mean", "largest"):
            mine, its = getattr(rough[name], number), getattr(right[name], number)
            assert 0.0 < mine.error < math.inf
            assert abs(mine.value - its.value) <= mine.error + its.error, (name, number)
    two_accuracies = compare_files(runs / "with_clearance.h5", runs / "fine.h5").pairs[0]
    assert not any(channel.over_errors > 10.0 for channel in two_accuracies.channels.values())


def test_the_same_run_other_records_and_a_bit(runs: Path) -> None:
    # both have the same errors, so even a tolerance far below them is met
    same = one(runs, "with_clearance", "with_clearance", FORCE, tolerance="pin.*=1e-9N")
    assert (same.mean.value, same.largest.value, same.verdict) == (0.0, 0.0, "agrees")
    assert same.largest.error > 1e-9
    # both follow the same columns on the same steps; the difference is rounding
    common = one(runs, "plain", "rare", "tip.x")
    assert common.largest.value < 1e-9
    assert not common.common.interpolation_error.any()
    assert math.isnan(common.mean.error)
    between = one(runs, "rare", "other", "tip.x")
    assert 0.0 < between.largest.value <= float(between.common.interpolation_error.max())


# --- results of others ---


def test_an_adams_file_is_three_quarters_of_a_percent_off_free_fall_at_its_first_step(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    time = 0.01 * np.arange(26)
    fall = np.column_stack([time, -0.5 * GRAVITY * time**2])
    np.savetxt("fall.csv", fall, delimiter=",", fmt="%.16g", header="time_s,height [inch]", comments="")
    Path("compare.toml").write_text('[files."free_fall.res".columns]\nheight = "PART_2_XFORM.Y"\n', "utf-8")
    words = ["compare", "fall.csv", str(DATA / "free_fall.res"), "--map", "compare.toml"]
    assert main([*words, "--until", "0.015", "--tolerance", "height=1um"]) == 1
    told = capsys.readouterr().out
    # (0.0194492123535125 - 0.019304429135) inch; the first is the file's, the second g t^2 / 2
    assert "differs by 3.677 µm" in told
    assert main([*words, "--json"]) == 0
    height = json.loads(capsys.readouterr().out)["files"]["free_fall.res"]["channels"]["height"]
    assert height["largest"]["value"] == pytest.approx(0.0254 * 0.0001447832185125, rel=1e-9)


@pytest.mark.parametrize("seconds", [0.3, pytest.param(1, marks=pytest.mark.slow)])
def test_the_four_bar_of_siconos_is_compared_through_its_table_alone(
    seconds: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (FOUR_BAR / "four_bar_run.toml").read_text(encoding="utf-8")
    assert "duration_s = 1\n" in text
    text = text.replace("duration_s = 1\n", f"duration_s = {seconds}\n").replace("../", f"{FOUR_BAR.parent}/")
    scene, run = tmp_path / "four_bar_run.toml", tmp_path / "four_bar_run.h5"
    scene.write_text(text, encoding="utf-8")
    assert main(["--import", str(FOUR_BAR.parent / "computed_torque.py"), "run", str(scene)]) == 0
    capsys.readouterr()
    mapping, files = FOUR_BAR / "compare.toml", [str(FOUR_BAR / "siconos.csv"), str(run)]
    assert main(["compare", *files, "--map", str(mapping), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["verdict"] == "differs within tolerance"
    channels = told["files"]["four_bar_run.h5"]["channels"]
    assert list(channels) == ["crank.angle", "coupler.angle", "rocker.angle", "crank.angular_velocity"]
    assert channels["crank.angle"]["measures"]["times"] == round(seconds / 0.05) + 1
    # far below the gap of 5 mm over the crank's 1 m: two programs with other laws of contact agree so well
    assert all(channels[name]["largest"]["value"] < 2e-4 for name in list(channels)[:3])
    there = Result.load(run)["crank.angle"][round(0.1 / 0.01)]
    assert there == pytest.approx(1.985176417328212, abs=1e-4)  # the table's own row


# --- runs with a horizon ---


def test_two_accuracies_are_equal_up_to_their_horizon_and_in_statistics_after_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Five loose pins that hit hard, at two accuracies."""
    for accuracy in ("draft", "reference"):
        simulate(five_pins(), accuracy=accuracy).save(tmp_path / f"{accuracy}.h5")
    draft, fine = tmp_path / "draft.h5", tmp_path / "reference.h5"
    horizon = Result.load(draft).horizon
    assert 0.03 < horizon < 0.2  # they part well within the run
    words = ["compare", str(draft), str(fine), "pin.*.force", "tip.*"]
    assert main([*words, "--page", str(tmp_path / "a.html"), "--figure", str(tmp_path / "a.png")]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    found = re.search(r"point by point up to ([\d.]+) s, the horizon of (draft|reference)\.h5", printed)
    assert found is not None
    assert float(found[1]) <= horizon * (1.0 + 1e-5)
    assert "rms after the horizon" in printed
    assert " differs" not in printed
    assert main([*words, "--json"]) == 0
    pair = json.loads(capsys.readouterr().out)["files"]["reference.h5"]
    for name, channel in pair["channels"].items():
        assert channel["over_errors"] <= 1.0, name
        assert set(channel["statistics"]) == {"mean", "rms"}, name
        assert all(what["equal"] is not False for what in channel["statistics"].values()), name
    compared = compare_files(draft, fine, channels=["tip.x"])
    difference = compare_figure(compared).axes[1]
    # after the horizon nothing is drawn, for it shows nothing
    assert float(np.max(difference.lines[0].get_xdata())) <= compared.pairs[0].horizon
