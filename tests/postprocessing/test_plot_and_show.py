"""`plot` and `show` of runs: files, tables, exit codes, and what is refused."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet

from support_exudyn import Result, simulate
from support_exudyn.__main__ import main
from support_exudyn.commands.runs import files_and_channels, is_of_others
from support_exudyn.files import save_scenario
from support_exudyn.postprocessing.export.tables import to_hdf5
from tests import synthetic
from tests.cases.run_cases import loose_slider_crank, loose_support, support
from user_forces.values.value import Value


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of four short runs: a clearance pin with an accuracy, ideal pins, space, and a slider-crank."""
    folder = tmp_path_factory.mktemp("runs")
    fall = loose_support(1.5, 0.25, duration=0.2)
    simulate(fall, accuracy="draft").save(folder / "with_clearance.h5")
    simulate(support(duration=0.2)).save(folder / "ideal.h5")
    simulate(replace(fall, dimensions=3, duration=0.02)).save(folder / "space.h5")
    crank = loose_slider_crank(0.05, formulation="compiled", record_period=5e-5)
    simulate(crank).save(folder / "crank.h5")
    return folder


@pytest.fixture(autouse=True)
def _no_display(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)


def names(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def both(*stems: str) -> set[str]:
    return {f"{stem}.{kind}" for stem in stems for kind in ("png", "pdf")}


def test_without_a_wish_an_overview_is_drawn(runs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plot", str(runs / "with_clearance.h5")]) == 0
    out = runs / "with_clearance_figures"
    kinds = "overview", "orbit_rear_base", "spectrum_rear_base"
    expected = both(*(f"with_clearance_{kind}" for kind in kinds))
    assert names(out) == expected
    assert {Path(line).name for line in capsys.readouterr().out.splitlines()} == expected
    assert (out / "with_clearance_overview.png").read_bytes().startswith(b"\x89PNG")
    assert (out / "with_clearance_overview.pdf").read_bytes().startswith(b"%PDF")


def test_several_runs_are_drawn_one_upon_another(runs: Path, tmp_path: Path) -> None:
    words = [str(runs / "ideal.h5"), str(runs / "with_clearance.h5"), "tip.*", "--out", str(tmp_path)]
    assert main(["plot", "--until", "0.1", *words]) == 0
    # the option between the names
    assert main(["plot", *words[:2], "--difference", *words[2:]]) == 0
    # a file by its name is all that is written
    assert main(["plot", *words[:2], "tip.*", "--out", str(tmp_path / "both.png")]) == 0
    expected = both("ideal_and_with_clearance_tip_until_0.1_s", "with_clearance_less_ideal_tip") | {"both.png"}
    assert names(tmp_path) == expected


@pytest.mark.parametrize(
    ("run", "args", "message"),
    [
        ("with_clearance", ["pin.rear_base.forse"], "pin.rear_base.force"),
        ("with_clearance", ["--orbit", "--pin", "front_base"], "no clearance pin"),
        ("ideal", ["--orbit"], "no clearance pin"),
        ("with_clearance", ["tip.x", "--after", "7"], "0 records lie between"),
        ("nothing", [], "no such file"),
    ],
)
def test_what_cannot_be_drawn_is_said_in_a_sentence(
    runs: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], run: str, args: list[str], message: str
) -> None:
    assert main(["plot", str(runs / f"{run}.h5"), *args, "--out", str(tmp_path / "new")]) == 1
    said = capsys.readouterr().err
    assert said.startswith("error: ")
    assert message in said
    assert not (tmp_path / "new").exists()


# --- curves of others ---

TIME = np.linspace(0.0, 1.0, 21)


@pytest.fixture
def curves(tmp_path: Path) -> Path:
    made = synthetic.journal(loose_support(1.5), TIME, 0 * TIME, 0 * TIME, [], tip__x=(np.sin(TIME), "m"))
    to_hdf5(made, tmp_path / "exported.h5")
    columns = {"time_ms": 1e3 * TIME, "tip.x_mm": 1e3 * np.sin(TIME)}
    parquet.write_table(pa.table(columns), tmp_path / "measured.parquet")
    (tmp_path / "measured.csv").write_text("time_s;tip.x_mm\n0;1,5\n0,5;2\n", encoding="utf-8")
    return made.save(tmp_path / "run.h5")


def test_curves_of_any_readable_file_are_drawn_upon_those_of_a_run(curves: Path, tmp_path: Path) -> None:
    (tmp_path / "broken.h5").write_bytes(b"nothing")
    (tmp_path / "run.toml").write_text("a = 1\n", encoding="utf-8")
    names = ["run.h5", "broken.h5", "run.toml", "exported.h5", "measured.parquet", "measured.csv", "none.csv"]
    files, channels = files_and_channels([str(tmp_path / name) for name in [*names, "none.h5"]] + ["tip.*"])
    assert channels == ["tip.*"]
    assert [path.name for path in files if is_of_others(path)] == names[3:]
    others = [str(tmp_path / name) for name in ("measured.parquet", "measured.csv")]
    assert main(["plot", str(curves), *others, "--out", str(tmp_path / "figures")]) == 0
    (drawn,) = (tmp_path / "figures").glob("*.png")
    assert drawn.name == "run_and_measured.parquet_and_measured.csv_overview.png"


# --- run and show ---


def test_run_prints_five_lines_and_all_on_request(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = save_scenario(loose_support(1.5, 0.25, duration=0.2), tmp_path / "fall.toml")
    assert main(["run", str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    result = Result.load(tmp_path / "fall.h5")
    force, impacts = result.window("pin.rear_base.force"), result.onsets["rear_base"]
    peak = result.largest_force["rear_base"]
    assert len(lines) == 5
    for line, what, value in zip(lines, ("mean", "peak", "fluct"), (force.mean, peak, force.std), strict=False):
        assert line.startswith(f"pin.rear_base: {what}")
        assert float(line.split()[-2]) == pytest.approx(value / 1e3, rel=1e-4)
    assert lines[3] == f"pin.rear_base: impacts: {len(impacts)}"
    assert lines[4].endswith(f"--all, or support-exudyn show {tmp_path / 'fall.h5'}")
    assert main(["run", str(path), "--all"]) == 0
    assert "what came out" in capsys.readouterr().out


def shown(path: Path, capsys: pytest.CaptureFixture[str], *args: str) -> str:
    assert main(["show", str(path), *args]) == 0
    return capsys.readouterr().out


def test_show_has_what_was_run_how_and_what_came_out(runs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    said = shown(runs / "with_clearance.h5", capsys)
    result = Result.load(runs / "with_clearance.h5")
    for words in (
        "HydraulicSupport",
        "1.5 mm clearance",
        "restitution 0.9",
        "coefficient 0.25",
        "0.01 asked for",
    ):
        assert words in said
    first = result.onsets["rear_base"][0]
    assert f"{1e3 * first.time:.6g} ms" in said
    assert f"1 of {len(result.onsets['rear_base'])}" in said
    force = result.numbers()["pin.rear_base.force.mean"]
    (row,) = [line.split() for line in said.splitlines() if line.strip().startswith("pin.rear_base.force.mean")]
    # both to two digits of the error
    assert float(row[1]) == pytest.approx(force.value / 1e3, abs=force.error / 1e3)
    assert row[2] == "±"
    assert float(row[3]) == pytest.approx(force.error / 1e3, rel=0.05)
    assert row[4] == "kN"


def test_all_impacts_are_shown_when_asked_for(runs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    result = Result.load(runs / "with_clearance.h5")
    count = len(result.onsets["rear_base"])
    assert count > 3
    said = shown(runs / "with_clearance.h5", capsys, "--impacts")
    assert said.count(f" of {count} ") == count
    assert "what was run" not in said
    forces = [line.split()[-2:] for line in said.splitlines() if line.rstrip().endswith("kN")]
    largest = max(float(value) for value, _ in forces)
    assert largest == pytest.approx(1e-3 * result["pin.rear_base.force"].max(), rel=1e-3)
    assert main(["show", str(runs / "ideal.h5"), "--impacts"]) == 1
    assert "has no clearance joint" in capsys.readouterr().err


def test_show_for_scripts_has_what_the_tables_have(runs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", str(runs / "with_clearance.h5"), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    result = Result.load(runs / "with_clearance.h5")
    assert Value.from_data(told["scenario"]) == result.scenario
    numbers = {name: tuple(number.values()) for name, number in told["numbers"].items()}
    assert {name: numbers[name] for name in result.numbers()} == dict(result.numbers())
    assert told["channels"]["tip.x"]["max"] == result.window("tip.x").greatest[0]
    assert set(told["channels"]) == set(result.channels) - {"time"}
    assert [one["time_s"] for one in told["impacts"]["rear_base"]] == [
        o.time for o in result.onsets["rear_base"]
    ]
