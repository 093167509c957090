"""Three comparisons from the command line alone: a file of ADAMS, Siconos's four-bar, two accuracies."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import CubicStep, Result, compare_files, machine, simple_scenario
from support_exudyn.__main__ import main
from support_exudyn.files.scenarios.scenario_file import save_scenario
from support_exudyn.postprocessing.comparing.compare_figure import BY_STATISTICS, compare_figure

DATA = Path(__file__).parents[1] / "files" / "series" / "data"
FOUR_BAR = Path(__file__).parents[2] / "studies" / "outside" / "compare_four_bar"
GRAVITY = 386.0885827  # of the file [inch/s^2]


def ended(words: Sequence[str]) -> int:
    """The exit code of a command line."""
    try:
        return main(words)
    except SystemExit as error:
        return int(error.code or 0)


@pytest.mark.parametrize(("unit", "length"), [("inch", 1.0), ("m", 0.0254)])
def test_an_adams_file_is_three_quarters_of_a_percent_off_free_fall_at_its_first_step(
    unit: str,
    length: float,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    time = 0.01 * np.arange(26)
    rows = (f"{t:.2f},{-0.5 * length * GRAVITY * t * t:.16g}" for t in time)
    Path("fall.csv").write_text("\n".join([f"time_s,height [{unit}]", *rows]) + "\n", encoding="utf-8")
    Path("compare.toml").write_text(
        '[files."free_fall.res".columns]\nheight = "PART_2_XFORM.Y"\n', encoding="utf-8"
    )
    words = ["compare", "fall.csv", str(DATA / "free_fall.res"), "--map", "compare.toml"]
    assert ended([*words, "--until", "0.015", "--tolerance", "height=1um"]) == 1
    told = capsys.readouterr().out
    # (0.0194492123535125 - 0.019304429135) inch; the first is the file's, the second g t^2 / 2
    assert "height: largest difference 3.677 µm at 0.01 s (0.75 % of the reference there)" in told
    assert ended([*words, "--json"]) == 0
    height = json.loads(capsys.readouterr().out)["files"]["free_fall.res"]["channels"]["height"]
    assert height["largest"]["value"] == pytest.approx(0.0254 * 0.0001447832185125, rel=1e-9)
    # of all later steps it is off by as much: a start that is not repeated
    assert height["measures"]["spread_difference"] < 0.2 * height["largest"]["value"]


@pytest.mark.parametrize("seconds", [0.3, pytest.param(1, marks=pytest.mark.slow)])
def test_the_four_bar_of_siconos_is_compared_through_its_table_alone(
    seconds: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (FOUR_BAR / "four_bar_run.toml").read_text(encoding="utf-8")
    assert "duration_s = 1\n" in text
    text = text.replace("duration_s = 1\n", f"duration_s = {seconds}\n").replace("../", f"{FOUR_BAR.parent}/")
    (tmp_path / "four_bar_run.toml").write_text(text, encoding="utf-8")
    run, table, mapping = tmp_path / "four_bar_run.h5", FOUR_BAR / "siconos.csv", FOUR_BAR / "compare.toml"
    assert (
        ended(
            [
                "--import",
                str(FOUR_BAR.parent / "computed_torque.py"),
                "run",
                str(tmp_path / "four_bar_run.toml"),
            ]
        )
        == 0
    )
    capsys.readouterr()
    assert ended(["compare", str(table), str(run), "--map", str(mapping), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["verdict"] == "within"
    channels = told["files"]["four_bar_run.h5"]["channels"]
    assert list(channels) == ["crank.angle", "coupler.angle", "rocker.angle", "crank.angular_velocity"]
    assert channels["crank.angle"]["measures"]["times"] == round(seconds / 0.05) + 1
    # far below the gap of 5 mm over the crank's 1 m: two programs with other laws of contact agree so well
    assert all(channels[name]["largest"]["value"] < 2e-4 for name in list(channels)[:3])
    result = Result.load(run)
    there = result["crank.angle"][round(0.1 / 0.01)]
    assert there == pytest.approx(1.985176417328212, abs=1e-4)  # the table's own row
    # a wrong sign in the mapping is caught
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(
        mapping.read_text(encoding="utf-8").replace(
            '"crank.angular_velocity" = "v0"', '"crank.angular_velocity" = { column = "v0", sign = -1 }'
        ),
        encoding="utf-8",
    )
    assert ended(["compare", str(table), str(run), "--map", str(wrong)]) == 1


@pytest.fixture(scope="module")
def five_pins(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Five loose pins that hit hard, at two accuracies."""
    folder = tmp_path_factory.mktemp("five_pins")
    pins = machine("reference").linkage().pins
    scenario = simple_scenario(
        "reference",
        pins={name: {"clearance_mm": 1.0, "restitution": 0.9} for name in pins},
        drive=CubicStep(stroke=0.002, start=0.0, end=0.16),
        duration_s=0.5,
        record_period_s=2e-4,
    )
    save_scenario(scenario, folder / "five_pins.toml")
    for accuracy in ("draft", "reference"):
        words = ["run", str(folder / "five_pins.toml"), "--accuracy", accuracy]
        assert main([*words, "--out", str(folder / f"{accuracy}.h5")]) == 0
    return folder


def test_two_accuracies_are_equal_up_to_their_horizon_and_in_statistics_after_it(
    five_pins: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    draft, fine = five_pins / "draft.h5", five_pins / "reference.h5"
    horizon = Result.load(draft).horizon
    assert 0.03 < horizon < 0.2  # they part well within the run
    assert ended(["compare", str(draft), str(fine), "pin.*.force", "tip.*"]) == 0
    told = " ".join(capsys.readouterr().out.split())
    found = re.search(r"point by point up to ([\d.]+) s, impact \d+ of pin\.\w+ \(.*?\); after it by", told)
    assert found is not None
    assert float(found[1]) <= horizon * (1.0 + 1e-5)
    assert re.search(r"after it \d+ statistics are equal within the intervals", told)
    assert told.count("within both errors") >= 7
    assert ended(["compare", str(draft), str(fine), "pin.*.force", "tip.*", "--json"]) == 0
    pair = json.loads(capsys.readouterr().out)["files"]["reference.h5"]
    for name, one in pair["channels"].items():
        assert one["beside_errors"]["within"], name
        assert {"mean", "rms", "spread", "quantile_95"} <= set(one["statistics"]), name
        assert all(what["equal"] is not False for what in one["statistics"].values()), name


def test_figure_and_page_of_runs_that_part(five_pins: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["compare", str(five_pins / "draft.h5"), str(five_pins / "reference.h5"), "tip.x"]
    assert ended([*words, "--page", str(five_pins / "a.html"), "--figure", str(five_pins / "a.png")]) == 0
    text = (five_pins / "a.html").read_text(encoding="utf-8")
    for part in ("Point by point up to", "Statistics after", "matched before parting"):
        assert part in text, part
    found = compare_files(five_pins / "draft.h5", five_pins / "reference.h5", channels=["tip.x"])
    drawing = compare_figure(found)
    assert BY_STATISTICS in {text.get_text() for text in drawing.axes[1].texts}
    drawn = drawing.axes[1].lines[0].get_xdata()
    assert float(np.max(drawn)) <= found.pairs[0].parting.time  # nothing is drawn that tells nothing


def test_a_changed_scene_is_told_apart_from_two_accuracies(
    five_pins: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    changed = Result.load(five_pins / "reference.h5")
    run: Result | None = changed
    while run is not None:  # at every accuracy, as a wrong program would
        for name in ("tip.x", "pin.rear_base.force"):
            run[name][:] *= 1.5 if name.endswith("force") else 1.001
        run = run.coarser
    changed.save(five_pins / "changed.h5")
    words = [
        "compare",
        str(five_pins / "draft.h5"),
        str(five_pins / "changed.h5"),
        "tip.*",
        "pin.rear_base.force",
    ]
    assert ended([*words, "--json"]) == 0
    channels = json.loads(capsys.readouterr().out)["files"]["changed.h5"]["channels"]
    assert channels["tip.x"]["beside_errors"]["times"] > 10.0
    assert channels["tip.y"]["beside_errors"]["within"]
    assert not math.isnan(channels["pin.rear_base.force"]["largest"]["error"])
    assert ended([*words, "--until", "0.03", "--tolerance", "tip.x=1mm"]) == 1


def test_a_computed_force_from_elsewhere_parts_where_the_run_does(
    five_pins: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The finer run as a table of another program: its impacts are found in its force."""
    fine = Result.load(five_pins / "reference.h5")
    name = "pin.rear_base.force"
    rows = (f"{t:.9g},{force:.12g}" for t, force in zip(fine.time, fine[name], strict=True))
    path = five_pins / "elsewhere.csv"
    path.write_text("\n".join([f"time_s,{name} [N]", *rows]) + "\n", encoding="utf-8")
    plain = Result.load(five_pins / "draft.h5")
    horizon = plain.horizon
    replace(plain, coarser=None).save(five_pins / "plain.h5")  # no errors: the impacts alone tell
    assert ended(["compare", str(five_pins / "plain.h5"), str(path), "--json"]) == 0
    pair = json.loads(capsys.readouterr().out)["files"]["elsewhere.csv"]
    assert 0.9 * horizon < pair["parting"]["time"] < 3.0 * horizon
    assert pair["impacts"]["rear_base"]["number_matched"] > 10
    assert "impacts_per_second" in pair["channels"][name]["statistics"]
    # what is measured is never exactly zero: nothing is found in it, and all is compared point by point
    noisy = fine[name] + 1.0 + np.sin(1e4 * fine.time)
    rows = (f"{t:.9g},{force:.12g}" for t, force in zip(fine.time, noisy, strict=True))
    path.write_text("\n".join([f"time_s,{name} [N]", *rows]) + "\n", encoding="utf-8")
    assert ended(["compare", str(five_pins / "plain.h5"), str(path), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["files"]["elsewhere.csv"]["parting"] is None
