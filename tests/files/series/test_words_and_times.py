"""Tables with dates and remarks among the numbers, and which of their columns are times."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy import io

from support_exudyn.files.series.named_series import SeriesFile
from support_exudyn.files.series.read import read_series
from user_forces import InputError

GERMAN = (
    "Datum;Zeit [s];Weg [mm];Status\r\n12.03.2024;0,0;1,5;OK\r\n12.03.2024;0,1;1,7;no\r\n12.03.2024;0,2;;\r\n"
)


def read(folder: Path, text: str, **asked: object) -> SeriesFile:
    path = folder / "a.csv"
    path.write_text(text, encoding="utf-8", newline="")
    return read_series(path, **asked)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("text", "others"),
    [
        (GERMAN, "'Datum', 'Status'"),
        ('time_s,Weg_mm,"Note"\n0,1.5,"ok"\n0.1,1.7,"a, b"\n0.2,,\n', "'Note'"),
        (
            "Messung\n\nstamp\ttime\tWeg\n\t[s]\t[mm]\n10:00:00\t0,0\t1,5\n10:00:01\t0,1\t1,7\n:\t2E-1\t\n",
            "'stamp'",
        ),
        ("time_s,Weg_mm,Note\n1D-1,1.7D0,x\n0,1.5,x\n0.2,NaN,y\n", "'Note'"),  # which no library reads
    ],
)
def test_columns_of_words_are_left_out_and_told(tmp_path: Path, text: str, others: str) -> None:
    found = read(tmp_path, text)
    assert list(found.series) == ["Weg"]
    np.testing.assert_array_equal(found.series["Weg"].time, [0.0, 0.1, 0.2])
    np.testing.assert_array_equal(found.series["Weg"].values, [1.5, 1.7, np.nan])
    assert found.series["Weg"].unit == "mm"
    assert f"Columns that are no numbers are left out: {others}." in found.notes


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("time_s,x_m,n\n0,1,a\n1,2,a\n2,y,a\n", "line 4, column 'x': 'y'; allowed: a number such as 12.5"),
        ("time_s,x_m,n\n0,1,a\n1,2,a\n2,y\n", "line 4: has 2 items; allowed: 3"),
        ("Time,x [mm]\n10:00:00,1\n10:00:01,2\n", r"has no times; .* are 'x', its words 'Time'"),
        ("Zeit\tKraft\n[s]\t[kN]\n0,0\t1.234,5\n0,1\t1.235,5\n", "no numbers are left out: 'Kraft'"),
        ('time_s,x_mm\n0,"1,000"\n1,"2,000"\n', "times and nothing else; .* no numbers are left out: 'x'"),
        ("It is late, says she,\nand goes, as ever,\n", "is no table of numbers"),
    ],
)
def test_what_is_wrong_among_words_is_refused(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        read(tmp_path, text)


def test_a_temperature_is_no_time(tmp_path: Path) -> None:
    found = read(tmp_path, "time_s,T [degC],T,x_m\n0,20,1,5\n1,21,2,6\n".replace("T,x", "t,x"))
    assert list(found.series) == ["T", "t", "x"]
    assert found.series["T"].values.tolist() == [20.0, 21.0]
    assert list(read(tmp_path, "T,t_s\n20,0\n21,1\n").series) == ["T"]
    assert list(read(tmp_path, "T_s,x\n0,20\n1,21\n").series) == ["x"]
    io.savemat(tmp_path / "a.mat", {"t_s": np.arange(3.0), "T": np.full(3, 20.0)})
    assert list(read_series(tmp_path / "a.mat").series) == ["T"]


def test_times_of_another_name_are_those_to_which_a_unit_of_time_is_given(tmp_path: Path) -> None:
    text = "Zeit,Weg_mm\n0,5\n100,6\n"
    with pytest.raises(InputError, match=r"has no times; .* its numbers are 'Zeit', 'Weg'"):
        read(tmp_path, text)
    found = read(tmp_path, text, units={"Zeit": "ms"})
    assert found.series["Weg"].time.tolist() == [0.0, 0.1]
