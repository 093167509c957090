"""`compare` with what cannot be compared: columns without units, values and times that one file lacks."""

from __future__ import annotations

import json
import math
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import compare_files
from support_exudyn.__main__ import main
from support_exudyn.postprocessing.comparing.notes import notes
from user_forces import InputError

ROWS = "0,0,10,7\n0.1,1,10,7\n0.2,2,10,7\n0.3,3,10,7\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A reference with a column without a unit; the same; the same with a column of another kind."""
    monkeypatch.chdir(tmp_path)
    write("reference.csv", f"time_s,tip.x_mm,pin.force_kN,Marker\n{ROWS}")
    write("seen.csv", f"time_s,tip.x_mm,pin.force_kN,Marker\n{ROWS}")
    write("kind.csv", f"time_s,tip.x_mm,pin.force_mm,Marker_m\n{ROWS}")
    return tmp_path


def write(name: str, text: str) -> None:
    Path(name).write_text(text, encoding="utf-8")


def ended(*words: str) -> int:
    """The exit code of a command line."""
    try:
        return main(["compare", *words])
    except SystemExit as error:
        return int(error.code or 0)


def test_what_has_no_unit_or_another_kind_is_left_out_and_told(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert ended("reference.csv", "seen.csv", "kind.csv", "--json", "--junit", "x.xml") == 0
    files = json.loads(capsys.readouterr().out)["files"]
    assert list(files["seen.csv"]["channels"]) == ["tip.x", "pin.force"]
    assert list(files["kind.csv"]["channels"]) == ["tip.x"]
    assert 'compare.toml, [units] "Marker" = "mm"' in files["seen.csv"]["not_alike"]["Marker"]
    why = "pin.force: is in kN in reference.csv, and in mm in kind.csv"
    assert files["kind.csv"]["not_alike"]["pin.force"].startswith(why)
    assert any(note.startswith("left out: pin.force, Marker; ") for note in files["kind.csv"]["notes"])
    suites = ElementTree.parse(folder / "x.xml").getroot()
    assert (suites.get("tests"), suites.get("skipped"), suites.get("failures")) == ("6", "3", "0")
    skipped = suites.findall("testsuite/testcase[skipped]")
    assert [case.get("name") for case in skipped] == ["Marker", "pin.force", "Marker"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["seen.csv", "Marker"], "Marker: has a unit in neither"),
        (["seen.csv", "Mar*"], "Marker: has a unit in neither"),
        (["seen.csv", "--tolerance", "Marker=1%"], "Marker: has a unit in neither"),
        (["kind.csv", "pin.force"], "pin.force: is in kN in reference.csv, and in mm in kind.csv"),
        (["seen.csv", "kind.csv", "--tolerance", "pin.force=1%"], "pin.force: is in kN in reference.csv"),
        (["kind.csv", "--tolerance", "pin.*=1%"], "'pin.*': no such channel is compared"),
    ],
)
def test_what_is_asked_for_is_not_left_out(
    words: list[str], said: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert ended("reference.csv", *words) == 2
    assert said in capsys.readouterr().err


def test_a_channel_with_a_tolerance_of_its_name_is_in_all_files(folder: Path) -> None:
    write("less.csv", f"time_s,tip.x_mm,a_N,b_N\n{ROWS}")
    with pytest.raises(InputError, match=r"pin\.force: has a tolerance, 1%, and is not in all files"):
        compare_files("reference.csv", "seen.csv", "less.csv", tolerance="pin.force=1%")
    found = compare_files("reference.csv", "seen.csv", "less.csv", tolerance="*=1%")
    assert found.verdict == "within"
    assert found.pairs[1].common.lacking == ("pin.force", "Marker")
    assert "less.csv has no pin.force, Marker" in list(notes(found.pairs[1]))


def test_nothing_that_can_be_compared_is_refused(folder: Path) -> None:
    write("x.csv", "time_s,a,b_m\n0,1,1\n1,2,2\n")
    write("y.csv", "time_s,a,b_N\n0,1,1\n1,2,2\n")
    with pytest.raises(InputError, match=r"a: has a unit in neither.*\nb: is in m in x\.csv"):
        compare_files("x.csv", "y.csv")


def test_a_mass_in_grams_is_no_acceleration(folder: Path) -> None:
    write("x.csv", "time_s,a_m,load [g]\n0,1,1000\n1,2,3000\n")
    write("y.csv", "time_s,a_m,load [kg]\n0,1,1.5\n1,2,3\n")
    channel = compare_files("x.csv", "y.csv").pairs[0].channels["load"]
    assert channel.unit == "kg"
    np.testing.assert_allclose(channel.common.other - channel.common.reference, [0.5, 0.0])


@pytest.mark.parametrize("missing", ["", "NaN", "inf"])
def test_values_that_the_other_file_lacks_are_told_and_not_judged(
    missing: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write("gap.csv", f"time_s,tip.x_mm\n0,0\n0.1,{missing}\n0.2,2\n0.3,3\n")
    assert ended("reference.csv", "gap.csv", "--tolerance", "tip.x=1mm") == 1
    told = capsys.readouterr().out
    assert "tip.x: gap.csv has no value at 1 of 4 times" in told
    assert "tip.x: has no value at 1 of 4 times at which the reference is known: not decided" in told
    assert ended("gap.csv", "reference.csv", "--tolerance", "tip.x=1mm") == 0  # what is known is all there
    assert "tip.x: gap.csv has no value at 1 of 4 times" in capsys.readouterr().out
    assert ended("reference.csv", "gap.csv", "--tolerance", "tip.x=1mm", "--after", "0.15") == 0


def test_times_that_the_other_file_lacks_are_told(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write("short.csv", "time_s,tip.x_mm\n0,0\n0.1,1\n")
    said = "compared are 0 to 0.1 s of 0 to 0.3 s of reference.csv (tip.x), for short.csv has no more"
    assert ended("reference.csv", "short.csv") == 0
    assert said in capsys.readouterr().out
    for words in (["short.csv", "reference.csv"], ["reference.csv", "short.csv", "--until", "0.1"]):
        assert ended(*words) == 0
        assert "compared are" not in capsys.readouterr().out


def test_a_difference_that_is_all_that_is_allowed_is_within_whatever_its_digits(folder: Path) -> None:
    write("x.csv", "time_s,a [-],F[1]_N\n0,0.02,5\n1,0.01,5\n")
    write("y.csv", "time_s,a [%],F[1]_N\n0,2.5,6\n1,1,5\n")
    found = compare_files("x.csv", "y.csv", tolerance="a=0.5percent,F[1]=0.9N").pairs[0].channels
    assert (found["a"].verdict, found["F[1]"].verdict) == ("within", "not within")


def test_a_share_of_no_range_is_told_so(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write("more.csv", f"time_s,tip.x_mm,pin.force_N,Marker_m\n{ROWS}")
    assert ended("reference.csv", "more.csv", "--tolerance", "pin.*=2%") == 1
    assert "allowed is 0 N, for the reference is constant (give an amount" in capsys.readouterr().out


def test_means_that_balance_are_zero_in_the_table(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = "".join(f"{n / 100},{math.sin(2 * math.pi * n / 100):.17g}\n" for n in range(101))
    write("wave.csv", f"time_s,a_m\n{rows}")
    assert ended("wave.csv", "wave.csv") == 0
    assert "e-1" not in capsys.readouterr().out
