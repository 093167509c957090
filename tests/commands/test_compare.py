"""`compare` from the command line with tables of others: what is printed and written, proposals, shifts."""

from __future__ import annotations

import json
import math
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from support_exudyn import compare_files
from support_exudyn.__main__ import main
from support_exudyn.postprocessing.comparing.compare_figure import MOST, compare_figure
from user_forces import InputError

TIME = np.arange(0.0, 1.0, 0.005)


def table(path: Path, head: str, *columns: np.ndarray) -> Path:
    lines = [head, *(",".join(f"{number:.12g}" for number in row) for row in zip(*columns, strict=True))]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def bump(time: np.ndarray) -> np.ndarray:
    """One clear event."""
    return np.exp(-(((time - 0.4) / 0.05) ** 2))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A reference; the same 1 % larger; the same 30 ms later under other names."""
    monkeypatch.chdir(tmp_path)
    slow = np.sin(6.0 * TIME)
    table(tmp_path / "reference.csv", "time_s,tip.x_mm,tip.force_kN", TIME, 100.0 * slow, 5.0 * bump(TIME))
    table(tmp_path / "larger.csv", "time_s,tip.x_m,tip.force_N", TIME, 0.101 * slow, 5050.0 * bump(TIME))
    late = TIME - 0.015
    table(tmp_path / "seen.csv", "t,Tip X,Force", TIME, -0.1 * np.sin(6.0 * late), 5.0 * bump(late))
    return tmp_path


def ended(words: list[str]) -> int:
    """The exit code of a command line."""
    try:
        return main(words)
    except SystemExit as error:
        return int(error.code or 0)


def test_the_table_tells_what_differs(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert ended(["compare", "reference.csv", "larger.csv"]) == 0
    told = capsys.readouterr().out
    row = next(line.split() for line in told.splitlines() if line.strip().startswith("tip.force"))
    # a factor of 1.01: the largest difference is that at the peak; M and C are 1 %
    assert (row[1], row[4], row[5]) == ("N", "50", "0.4")
    assert row[8:10] == ["1", "%"]
    assert "numerical errors not known" in told


@pytest.mark.parametrize(
    ("tolerance", "code", "said"),
    [
        ("*=2%", 0, "All channels are within their tolerances."),
        ("tip.x=0.5mm,*=2%", 1, "tip.x: largest difference 1 mm at"),
        ("tip.force=0.01kN", 1, "tip.force: largest difference 50 N at 0.4 s (1 % of the reference there)"),
        ("tip.x=0.101cm", 0, "All channels"),
    ],
)
def test_the_exit_code_says_whether_it_is_within(
    tolerance: str, code: int, said: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert ended(["compare", "reference.csv", "larger.csv", "--tolerance", tolerance]) == code
    assert said in capsys.readouterr().out


def test_several_files_are_compared_with_the_first(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["compare", "reference.csv", "reference.csv", "larger.csv", "--tolerance", "*=0.1%", "--json"]
    assert ended(words) == 1
    told = json.loads(capsys.readouterr().out)
    assert told["verdict"] == "not within"
    assert {name: one["verdict"] for name, one in told["files"].items()} == {
        "reference.csv (2)": "within",
        "larger.csv": "not within",
    }
    force = told["files"]["larger.csv"]["channels"]["tip.force"]
    assert force["largest"]["value"] == pytest.approx(50.0)
    assert force["largest"]["of_reference_there"] == pytest.approx(0.01)
    assert force["measures"]["magnitude_error"] == pytest.approx(0.01)
    assert force["allowed"] == pytest.approx(5.0, rel=1e-3)


def test_junit_is_well_formed_and_tells_numbers(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    hostile = table(folder / 'a&<"b\x1b>.csv', "time_s,tip.x_mm", TIME, 99.0 * np.sin(6.0 * TIME))
    words = ["compare", "reference.csv", "larger.csv", str(hostile), "--tolerance", "tip.x=2%,*=0.1%"]
    assert ended([*words, "--junit", "compare.xml"]) == 1
    assert capsys.readouterr().out.endswith("compare.xml\n")
    root = ElementTree.parse(folder / "compare.xml").getroot()
    assert (root.tag, root.get("tests"), root.get("failures")) == ("testsuites", "3", "1")
    assert [one.get("name") for one in root.iter("testcase")] == ["tip.x", "tip.force", "tip.x"]
    failure = root.find(".//failure")
    assert failure is not None
    assert failure.text == failure.get("message")
    assert "largest difference 50 N at 0.4 s (1 % of the reference there); allowed is 5 N" in str(failure.text)
    assert [suite.get("failures") for suite in root.iter("testsuite")] == ["1", "0"]


def test_a_figure_shows_curves_differences_and_what_is_allowed(folder: Path) -> None:
    found = compare_files(
        "reference.csv", "larger.csv", tolerance="tip.x=2%,tip.force=0.5%", channels=["tip.*"]
    )
    drawing = compare_figure(found)
    assert isinstance(drawing, Figure)
    curves, apart, _, force = drawing.axes
    assert [line.get_label() for line in curves.lines] == ["reference.csv", "larger.csv"]
    np.testing.assert_allclose(curves.lines[1].get_ydata(), 101.0 * np.sin(6.0 * TIME), atol=1e-9)
    np.testing.assert_allclose(apart.lines[0].get_ydata(), np.sin(6.0 * TIME), atol=1e-9)  # mm
    bounds = [float(line.get_ydata()[0]) for line in apart.lines if line.get_linestyle() == "--"]
    extent = 100.0 * np.ptp(np.sin(6.0 * TIME))
    np.testing.assert_allclose(sorted(bounds), [-0.02 * extent, 0.02 * extent])
    assert "largest 50 N at 0.4 s, NOT within 0.5%" in force.get_title(loc="left")


def test_figures_are_written_as_their_endings_say_of_few_channels(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    head = "time_s," + ",".join(f"c{n}_m" for n in range(MOST + 1))
    table(folder / "wide.csv", head, *[TIME] * (MOST + 2))
    assert ended(["compare", "wide.csv", "wide.csv", "--figure", "a.png"]) == 2
    assert f"{MOST + 1} channels: allowed in a figure: {MOST}" in capsys.readouterr().err
    assert not (folder / "a.png").exists()
    for name, begins in (("a.png", b"\x89PNG"), ("a.pdf", b"%PDF"), ("a.svg", b"<?xml")):
        assert ended(["compare", "wide.csv", "wide.csv", "c1", "--figure", name]) == 0
        assert (folder / name).read_bytes().startswith(begins)


def test_the_page_has_the_verdict_the_tables_and_the_measures(folder: Path) -> None:
    words = [
        "compare",
        "reference.csv",
        "larger.csv",
        "--tolerance",
        "tip.x=2%,*=0.1%",
        "--page",
        "compare.html",
    ]
    assert ended(words) == 1
    text = (folder / "compare.html").read_text(encoding="utf-8")
    assert "Not all channels are within their tolerances." in text
    for part in ("NOT", "Sprague-Geers M", "tip.force: largest difference 50", "difference ["):
        assert part in text, part
    assert not re.search(r"<(?:script|img|link)[^>]*(?:src|href)=\"(?!data:)", text)  # nothing from elsewhere


def test_a_mapping_is_asked_for_and_a_shift_is_determined(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "units.toml").write_text('[units]\nt = "s"\n', encoding="utf-8")
    assert ended(["compare", "reference.csv", "seen.csv", "--map", "units.toml"]) == 2
    told = capsys.readouterr().err
    assert "reference.csv has tip.x, tip.force; seen.csv has Tip X, Force" in told
    assert '[files."seen.csv".columns] "tip.x" = ' in told

    (folder / "compare.toml").write_text(
        '[files."seen.csv".columns]\n"tip.x" = { column = "Tip X", sign = -1 }\n"tip.force" = "Force"\n'
        '[units]\nt = "s"\n"Tip X" = "m"\nForce = "kN"\n[tolerances]\n"*" = "0 %"\n',
        encoding="utf-8",
    )
    words = ["compare", "reference.csv", "seen.csv", "--map", "compare.toml", "--shift", "--after", "0.05"]
    assert ended([*words, "--until", "0.95", "--tolerance", "*=0.5%"]) == 0  # goes before the file's
    told = capsys.readouterr().out
    assert re.search(r"seen\.csv lags behind reference\.csv by (15|14\.99\d*|15\.00\d*) ms ± .* found by", told)
    assert ended(words) == 1


def test_a_shift_that_is_not_sure_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table(folder / "wave.csv", "time_s,a_m", TIME, np.sin(80.0 * TIME))
    table(folder / "later.csv", "time_s,a_m", TIME, np.sin(80.0 * (TIME - 0.005)))
    assert ended(["compare", "wave.csv", "later.csv", "--shift"]) == 2
    told = capsys.readouterr().err
    assert "no shift in time is sure" in told
    assert 'shift_s of [files."later.csv"] in compare.toml' in told


def test_a_comparison_file_among_the_files_is_pointed_out(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "compare.toml").write_text("", encoding="utf-8")
    assert ended(["compare", "reference.csv", "larger.csv", "compare.toml"]) == 2
    assert "allowed: --map compare.toml" in capsys.readouterr().err


def test_curves_that_do_not_overlap_are_refused(folder: Path) -> None:
    table(folder / "later.csv", "time_s,tip.x_mm", TIME + 10.0, TIME)
    with pytest.raises(InputError, match=r"tip\.x of reference\.csv and later\.csv: .*curves that overlap"):
        compare_files("reference.csv", "later.csv")


def test_python_has_the_curves_and_the_verdict(folder: Path) -> None:
    found = compare_files("reference.csv", "larger.csv", tolerance="tip.x=1mm", channels=["tip.x"])
    channel = found.pairs[0].channels["tip.x"]
    assert (found.verdict, channel.verdict) == ("within", "within")
    np.testing.assert_allclose(channel.common.other, 0.101 * np.sin(6.0 * TIME), atol=1e-12)
    assert math.isnan(channel.largest.error)
    with pytest.raises(InputError, match="1 file: allowed: 2 or more"):
        compare_files("reference.csv")
