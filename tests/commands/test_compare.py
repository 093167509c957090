"""`compare` with tables of others: files and words in, exit code, words, figure, page and JUnit out."""

from __future__ import annotations

import csv
import json
import math
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import compare_files
from support_exudyn.__main__ import main
from support_exudyn.postprocessing.comparing.compare_page import MOST, compare_figure
from support_exudyn.postprocessing.comparing.tables import notes
from user_forces import InputError

TIME = np.arange(0.0, 1.0, 0.005)
ROWS = "0,0,10,7\n0.1,1,10,7\n0.2,2,10,7\n0.3,3,10,7\n"
MAPPED = """
[files."seen.csv".columns]
"tip.x" = { column = "Tip X", sign = -1 }
"tip.force" = "Force"
[files."seen.csv".units]
t = "s"
"Tip X" = "m"
Force = "kN"
[tolerances]
"*" = "0 %"
"""
TEXTS = {
    "marked.csv": f"time_s,tip.x_mm,pin.force_kN,Marker\n{ROWS}",
    "same.csv": f"time_s,tip.x_mm,pin.force_kN,Marker\n{ROWS}",
    "kind.csv": f"time_s,tip.x_mm,pin.force_mm,Marker_m\n{ROWS}",
    "newton.csv": f"time_s,tip.x_mm,pin.force_N,Marker_m\n{ROWS}",
    "less.csv": f"time_s,tip.x_mm,a_N,b_N\n{ROWS}",
    "empty.csv": "time_s,tip.x_mm\n0,0\n0.1,\n0.2,2\n0.3,3\n",
    "short.csv": "time_s,tip.x_mm\n0,0\n0.1,1\n",
    "share.csv": "time_s,a [-],F[1]_N,load [g]\n0,0.02,5,1000\n1,0.01,5,3000\n",
    "percent.csv": "time_s,a [%],F[1]_N,load [kg]\n0,2.5,6,1.5\n1,1,5,3\n",
    "units.toml": '[files."seen.csv".units]\nt = "s"\n',
    "compare.toml": MAPPED,
}


def table(path: Path, head: str, *columns: np.ndarray) -> None:
    np.savetxt(path, np.column_stack(columns), delimiter=",", fmt="%.12g", header=head, comments="")


def bump(time: np.ndarray) -> np.ndarray:
    """One clear event."""
    return np.exp(-(((time - 0.4) / 0.05) ** 2))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A reference; the same 1 % larger; the same 15 ms later under other names; and small texts."""
    monkeypatch.chdir(tmp_path)
    late, slow = TIME - 0.015, np.sin(6.0 * TIME)
    table(tmp_path / "reference.csv", "time_s,tip.x_mm,tip.force_kN", TIME, 100.0 * slow, 5.0 * bump(TIME))
    table(tmp_path / "larger.csv", "time_s,tip.x_m,tip.force_N", TIME, 0.101 * slow, 5050.0 * bump(TIME))
    table(tmp_path / "seen.csv", "t,Tip X,Force", TIME, -0.1 * np.sin(6.0 * late), 5.0 * bump(late))
    table(tmp_path / "ring.csv", "time_s,a_m", TIME, np.sin(80.0 * TIME))
    table(tmp_path / "later.csv", "time_s,a_m", TIME, np.sin(80.0 * (TIME - 0.005)))
    table(tmp_path / "wide.csv", "time_s," + ",".join(f"c{n}_m" for n in range(MOST + 1)), *[TIME] * (MOST + 2))
    for name, text in TEXTS.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    return tmp_path


def ended(words: str) -> int:
    """The exit code of `compare` with words, of which quotes hold spaces together."""
    return main(["compare", *(word.strip("'") for word in re.findall(r"'[^']*'|\S+", words))])


NO_VALUE = "tip.x: {} has no value at 1 of 4 times"


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        ("reference.csv larger.csv", 0, "No tolerance was given"),
        ("reference.csv larger.csv --tolerance *=2%", 0, "All channels are within their tolerances."),
        ("reference.csv larger.csv --tolerance tip.x=0.5mm,*=2%", 1, "tip.x: "),
        (
            "reference.csv larger.csv --tolerance tip.force=0.01kN",
            1,
            "differs by 50 N, more than the tolerance of 10 N (0.01kN)",
        ),
        # tolerances of the command line go before those of the file
        ("reference.csv seen.csv --map compare.toml --shift --tolerance *=0.5%", 0, "lags behind"),
        ("reference.csv seen.csv --map compare.toml --shift", 1, "by 15 ms in"),
        # gaps are reported and not judged; of the reference they are left out
        ("marked.csv empty.csv --tolerance tip.x=1mm", 1, NO_VALUE.format("empty.csv")),
        ("empty.csv marked.csv --tolerance tip.x=1mm", 0, NO_VALUE.format("empty.csv")),
        ("marked.csv empty.csv --tolerance tip.x=1mm --after 0.15", 0, ""),
        ("marked.csv short.csv", 0, "compared are 0 to 0.1 s of 0 to 0.3 s of marked.csv, for"),
        # all that is allowed is within, whatever its digits; F[1] is itself, and no pattern
        ("share.csv percent.csv --tolerance a=0.5percent", 0, ""),
        ("share.csv percent.csv --tolerance F[1]=0.9N", 1, "F[1]: "),
        ("marked.csv newton.csv --tolerance pin.*=2%", 1, "the reference is constant"),
        # refused: nothing is compared, or written
        ("reference.csv seen.csv --map units.toml", 2, '[files."seen.csv".columns] "tip.x" = '),
        ("ring.csv later.csv --shift", 2, "no shift in time is sure"),
        ("reference.csv larger.csv compare.toml", 2, "allowed: --map compare.toml"),
        ("wide.csv wide.csv --figure a.png", 2, f"{MOST + 1} channels: allowed in a figure: {MOST}"),
        ("marked.csv same.csv Marker", 2, "Marker: is in no unit in marked.csv"),
        ("marked.csv kind.csv pin.force", 2, "pin.force: is in kN in marked.csv, and in mm in kind.csv"),
        ("marked.csv same.csv less.csv --tolerance pin.force=1%", 2, "pin.force: less.csv has no such channel"),
        ("marked.csv same.csv --tolerance pin.*=1%,tup.*=1mm", 2, "'tup.*': no such channel is compared"),
    ],
)
def test_what_is_compared_and_what_is_refused(
    words: str, code: int, said: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert ended(words) == code
    printed = capsys.readouterr()
    assert said in (printed.err if code == 2 else printed.out)
    assert bool(printed.out) == (code != 2)
    assert not (folder / "a.png").exists()


def test_several_files_as_json_and_as_junit(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table(folder / 'a&<"b\x1b>.csv', "time_s,tip.x_mm", TIME, 99.0 * np.sin(6.0 * TIME))
    files = "reference.csv reference.csv larger.csv 'a&<\"b\x1b>.csv'"
    assert ended(f"{files} --tolerance tip.x=2%,*=0.1% --json --junit x.xml --csv x.csv") == 1
    told = json.loads(capsys.readouterr().out)
    assert (told["verdict"], told["written"]) == ("differs", ["x.csv", "x.xml"])
    verdicts = {name: one["verdict"] for name, one in told["files"].items()}
    assert list(verdicts.items())[:2] == [
        ("reference.csv (2)", "agrees"),
        ("larger.csv", "differs"),
    ]
    force = told["files"]["larger.csv"]["channels"]["tip.force"]
    assert force["largest"]["value"] == pytest.approx(50.0)
    assert force["measures"]["magnitude_error"] == pytest.approx(0.01)
    assert force["allowed"] == pytest.approx(5.0, rel=1e-3)
    with (folder / "x.csv").open(newline="", encoding="utf-8") as text:
        lines = [line for line in csv.DictReader(text) if line["file"] == "larger.csv"]
    (line,) = (line for line in lines if (line["channel"], line["measure"]) == ("tip.force", "largest"))
    cells = [float(line[name]) for name in ("time", "reference", "other", "difference", "tolerance")]
    assert cells == pytest.approx([0.4, 5000.0, 5050.0, 50.0, 5.0], rel=1e-3)
    assert (line["unit"], line["error"], line["verdict"]) == ("N", "", "differs")
    root = ElementTree.parse(folder / "x.xml").getroot()
    assert (root.tag, root.get("tests"), root.get("failures")) == ("testsuites", "6", "1")
    assert [suite.get("failures") for suite in root.iter("testsuite")] == ["0", "1", "0"]
    assert [failure.text for failure in root.iter("failure") if "differs by 50 N" in str(failure.text)]


def test_what_has_no_unit_or_another_kind_is_left_out(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert ended("marked.csv same.csv kind.csv --json --junit x.xml") == 0
    files = json.loads(capsys.readouterr().out)["files"]
    assert [list(one["channels"]) for one in files.values()] == [["tip.x", "pin.force"], ["tip.x"]]
    assert 'compare.toml, [files."marked.csv".units] "Marker" = "mm"' in files["same.csv"]["left_out"]["Marker"]
    assert any(note.startswith("left out: pin.force, Marker; ") for note in files["kind.csv"]["notes"])
    skipped = ElementTree.parse(folder / "x.xml").getroot().findall("testsuite/testcase[skipped]")
    assert [case.get("name") for case in skipped] == ["Marker", "pin.force", "Marker"]
    found = compare_files("marked.csv", "same.csv", "less.csv", tolerance="*=1%")
    assert found.verdict == "agrees"
    assert "left out: pin.force, Marker; less.csv has no such channel" in list(notes(found.pairs[1]))


def test_figure_and_page(folder: Path) -> None:
    found = compare_files("reference.csv", "larger.csv", tolerance="tip.x=2%,tip.force=0.5%")
    curves, apart, _, force = compare_figure(found).axes
    assert [line.get_label() for line in curves.lines] == ["reference.csv", "larger.csv"]
    np.testing.assert_allclose(curves.lines[1].get_ydata(), 101.0 * np.sin(6.0 * TIME), atol=1e-9)
    np.testing.assert_allclose(apart.lines[0].get_ydata(), np.sin(6.0 * TIME), atol=1e-9)  # mm
    bounds = [float(line.get_ydata()[0]) for line in apart.lines if line.get_linestyle() == "--"]
    extent = 100.0 * np.ptp(np.sin(6.0 * TIME))
    np.testing.assert_allclose(sorted(bounds), [-0.02 * extent, 0.02 * extent])
    assert "largest 50 N at 0.4 s, differs (0.5%)" in force.get_title(loc="left")
    assert ended("wide.csv wide.csv c1 --figure a.pdf") == 0
    assert (folder / "a.pdf").read_bytes().startswith(b"%PDF")
    assert ended("reference.csv larger.csv --tolerance tip.x=2%,*=0.1% --page a.html") == 1
    text = (folder / "a.html").read_text(encoding="utf-8")
    assert not re.search(r"<(?:script|img|link)[^>]*(?:src|href)=\"(?!data:)", text)  # nothing from elsewhere


def test_python_has_the_curves_and_the_verdict(folder: Path) -> None:
    found = compare_files("reference.csv", "larger.csv", tolerance="tip.x=1mm", channels=["tip.x"])
    channel = found.pairs[0].channels["tip.x"]
    assert (found.verdict, channel.verdict) == ("differs within tolerance", "differs within tolerance")
    np.testing.assert_allclose(channel.common.other, 0.101 * np.sin(6.0 * TIME), atol=1e-12)
    assert math.isnan(channel.largest.error)
    load = compare_files("share.csv", "percent.csv").pairs[0].channels["load"]
    assert (load.unit, load.largest.value) == ("kg", pytest.approx(0.5))  # grams are no acceleration
    with pytest.raises(InputError, match="1 file: allowed: 2 or more"):
        compare_files("reference.csv")
