"""`plot` and `show` of runs: files, tables, exit codes, and what is refused."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from support_exudyn import Result, simulate
from support_exudyn.__main__ import main
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
    kinds = "overview", "orbit_rear_base", "poincare_rear_base", "spectrum_rear_base"
    expected = both(*(f"with_clearance_{kind}" for kind in kinds))
    assert names(out) == expected
    assert {Path(line).name for line in capsys.readouterr().out.splitlines()} == expected
    assert (out / "with_clearance_overview.png").read_bytes().startswith(b"\x89PNG")
    assert (out / "with_clearance_overview.pdf").read_bytes().startswith(b"%PDF")


def test_what_a_run_has_none_of_is_left_out_of_the_overview_in_a_sentence(
    runs: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["plot", str(runs / "space.h5"), "--out", str(tmp_path)]) == 0
    assert names(tmp_path) == both("space_overview", "space_orbit_rear_base")
    said = capsys.readouterr().err
    assert "space_poincare_rear_base: left out" in said
    assert "space_spectrum_rear_base: left out" in said


def test_where_pins_shake_is_drawn_and_told(
    runs: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run = str(runs / "crank.h5")
    assert main(["plot", run, "--stability", "--pin", "slider_pin", "--out", str(tmp_path)]) == 0
    assert names(tmp_path) == both("crank_stability")
    capsys.readouterr()
    assert main(["show", run, "--json"]) == 0
    (told,) = json.loads(capsys.readouterr().out)["pin_stability"]
    assert told["pin"] == "slider_pin"
    assert told["stable"] is (told["growth_rate_per_s"] < 1e-4 * 2.0 * math.pi * told["frequency_Hz"])
    assert "do loaded pins shake as they slide?" in shown(Path(run), capsys)
    assert main(["plot", run, "--stability", "--orbit", "--out", str(tmp_path)]) == 1
    assert "--stability: is drawn by itself" in capsys.readouterr().err


def test_one_kind_of_one_pin_is_drawn(runs: Path, tmp_path: Path) -> None:
    args = ["plot", str(runs / "crank.h5"), "--spectrum", "--after", "0.01", "--pin", "main"]
    assert main([*args, "--out", str(tmp_path)]) == 0
    assert names(tmp_path) == both("crank_spectrum_main_after_0.01_s")


def test_channels_are_drawn_by_pattern(runs: Path, tmp_path: Path) -> None:
    assert main(["plot", str(runs / "with_clearance.h5"), "pin.*.force", "tip.?", "--out", str(tmp_path)]) == 0
    assert names(tmp_path) == both("with_clearance_pin.force_tip")


def test_several_runs_are_drawn_one_upon_another(runs: Path, tmp_path: Path) -> None:
    words = [str(runs / "ideal.h5"), str(runs / "with_clearance.h5"), "tip.*", "--out", str(tmp_path)]
    assert main(["plot", "--until", "0.1", *words]) == 0
    # the option between the names
    assert main(["plot", *words[:2], "--difference", *words[2:]]) == 0
    expected = both("ideal_and_with_clearance_tip_until_0.1_s", "with_clearance_less_ideal_tip")
    assert names(tmp_path) == expected


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["ideal.h5", "--difference"], "needs a second run"),
        (["ideal.h5", "with_clearance.h5", "--orbit"], "are of one run, and 2 are given"),
        (["ideal.h5", "crank.h5", "--difference", "tip.x"], "in common"),
        (["ideal.h5", "ideal.h5", "tip.x"], "is given twice"),
    ],
)
def test_what_several_runs_cannot_show_is_said(
    runs: Path, capsys: pytest.CaptureFixture[str], words: list[str], message: str
) -> None:
    assert main(["plot", *(str(runs / word) if word.endswith(".h5") else word for word in words)]) == 1
    assert message in capsys.readouterr().err


@pytest.mark.parametrize(
    ("run", "args", "message"),
    [
        ("with_clearance", ["pin.rear_base.forse"], "pin.rear_base.force"),
        ("with_clearance", ["--orbit", "--pin", "front_base"], "no clearance pin"),
        ("ideal", ["--orbit"], "no clearance pin"),
        ("with_clearance", ["tip.x", "--from", "7"], "0 records lie between"),
        ("with_clearance", ["--section", "tip.x", "tip.y"], "periods of the drive"),
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


@pytest.mark.parametrize(
    "args", [["--from", "nan"], ["--until", "x"], ["--phase", "2"], ["--section", "tip.x"]]
)
def test_wrong_words_are_refused(runs: Path, capsys: pytest.CaptureFixture[str], args: list[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["plot", str(runs / "with_clearance.h5"), *args])
    assert stop.value.code == 2
    assert "usage: " in capsys.readouterr().err


# --- show ---


def shown(path: Path, capsys: pytest.CaptureFixture[str], *args: str) -> str:
    assert main(["show", str(path), *args]) == 0
    return capsys.readouterr().out


def test_show_tells_what_was_run_how_and_what_came_out(runs: Path, capsys: pytest.CaptureFixture[str]) -> None:
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
    # the value to the digits that its error leaves, which is shown to two
    assert float(row[1]) == pytest.approx(force.value / 1e3, abs=force.error / 1e3)
    assert float(row[2]) == pytest.approx(force.error / 1e3, rel=0.05)
    assert row[3] == "kN"


@pytest.mark.parametrize("run", ["with_clearance", "ideal", "space", "crank"])
def test_all_channels_are_shown_with_their_whole_names(
    runs: Path, capsys: pytest.CaptureFixture[str], run: str
) -> None:
    said = shown(runs / f"{run}.h5", capsys, "--all")
    first = {line.split()[0] for line in said.splitlines() if line.strip()}
    assert set(Result.load(runs / f"{run}.h5").channels) - {"time"} <= first
    assert "…" not in said
    assert "\x1b" not in said  # plain where it is not a terminal
    assert max(map(len, said.splitlines())) <= 150


def test_some_channels_are_shown_by_pattern(runs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    said = shown(runs / "crank.h5", capsys, "slider.*x", "pin.slider_pin.depth")
    rows = [line.split() for line in said.splitlines() if line.startswith((" slider.", " pin."))]
    assert [row[0] for row in rows] == ["slider.velocity_x", "slider.x", "pin.slider_pin.depth"]
    x = Result.load(runs / "crank.h5").window("slider.x")
    # six digits are shown
    assert [float(cell) for cell in rows[1][2:5]] == pytest.approx(
        [1e3 * x.least[0], 1e3 * x.mean, 1e3 * x.greatest[0]], rel=1e-5
    )


def test_show_ends_quietly_when_nobody_reads_on(runs: Path) -> None:
    command = [sys.executable, "-m", "support_exudyn", "show", str(runs / "space.h5"), "--all"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None
        process.stdout.close()
        assert process.stderr is not None
        assert process.stderr.read() == b""
        assert process.wait() == 0


@pytest.mark.parametrize("words", [[], ["tip.*"], ["--all"]])
def test_the_narrowest_terminals_cut_no_number(
    runs: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, words: list[str]
) -> None:
    wide = shown(runs / "with_clearance.h5", capsys, *words)
    monkeypatch.setattr("support_exudyn.commands.tables.PIPED", 30)
    narrow = shown(runs / "with_clearance.h5", capsys, *words)

    def rows(said: str) -> list[list[str]]:
        found = [line.split() for line in said.splitlines()]
        return [row[:5] for row in found if row and row[0].startswith(("tip.", "pin.", "energy."))]

    assert rows(narrow) == rows(wide)


def test_numbers_are_shown_by_the_names_that_they_are_printed_with(
    runs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said = shown(runs / "with_clearance.h5", capsys, "*largest_force*")
    largest = Result.load(runs / "with_clearance.h5").largest_force["rear_base"]
    (row,) = [line.split() for line in said.splitlines() if "rear_base.largest_force," in line]
    assert float(row[3]) == pytest.approx(1e-3 * largest, rel=1e-2)
    assert "energy" not in said
    both = shown(runs / "with_clearance.h5", capsys, "pin.rear_base.force.largest", "tip.x")
    assert "pin.rear_base.force.largest" in both
    assert "\n tip.x " in both
    assert main(["show", str(runs / "with_clearance.h5"), "*largest_torce*"]) == 1
    assert "no such channel or number" in capsys.readouterr().err
    assert main(["show", str(runs / "with_clearance.h5"), "*largest_force*", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["channels"] == {}
    assert "pin.rear_base.largest_force" in told["numbers"]


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


def test_plot_and_export_name_their_files_for_scripts(
    runs: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["plot", str(runs / "ideal.h5"), "tip.x", "--out", str(tmp_path), "--json"]) == 0
    figures = json.loads(capsys.readouterr().out)["figures"]
    assert {Path(path) for path in figures["ideal_tip.x"]} == set(tmp_path.iterdir())
    assert main(["export", str(runs / "ideal.h5"), "--to", "csv", "--out", str(tmp_path), "--json"]) == 0
    written = json.loads(capsys.readouterr().out)
    assert written == {"written": {"csv": [str(tmp_path / "ideal.csv")]}, "left_out": {}}
