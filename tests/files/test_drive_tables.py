"""Displacements over time from tables: read with one rounding, refused by file and column."""

from __future__ import annotations

from pathlib import Path

import pytest

from support_exudyn.files import read_drives
from support_exudyn.files.scenarios.drive_table import one_drive
from user_forces import InputError

GOOD = "time_s,front_column_mm,rear_column_mm\n0,0,0\n1,100,90.1\n\n2.5, 250 ,240\n"


def test_every_column_is_a_drive(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(GOOD)
    found = read_drives(tmp_path / "a.csv", "linear")
    assert list(found) == ["front_column", "rear_column"]
    assert found["rear_column"].times == (0.0, 1.0, 2.5)
    assert found["rear_column"].extensions == (0.0, 0.0901, 0.24)
    assert found["front_column"].between == "linear"


def test_units_and_order_of_columns_are_free(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("crank_deg,time_ms\n0,0\n90,10\n", encoding="utf-8-sig")
    found = read_drives(tmp_path / "a.csv")["crank"]
    assert found.times == (0.0, 0.01)
    assert found.extensions == (0.0, 1.5707963267948966)


def test_one_of_several_has_to_be_chosen(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(GOOD)
    assert one_drive(path, "rear_column", "smooth") == read_drives(path)["rear_column"]
    with pytest.raises(InputError, match=r"a.csv: has 2 columns; say which by column; allowed: front_column, "):
        one_drive(path, None, "smooth")
    with pytest.raises(InputError, match=r"column = 'rear_colum': no such column; did you mean 'rear_column'"):
        one_drive(path, "rear_colum", "smooth")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "a.csv: is empty"),
        ("time_s,front\n0,0\n1,1\n", "a.csv: column front: is in no unit; allowed: titles that end by _mm"),
        ("time,front_mm\n0,0\n1,1\n", "a.csv: times, column 'time': have no unit"),
        ("front_mm,rear_mm\n0,0\n1,1\n", "a.csv: has no times; allowed: a column time_s, time_ms"),
        ("time_s,a_mm\n0,0\n", "a.csv: column a: times = (0.0,): allowed: at least 2 items"),
        ("time_s,a_mm\n0,0\n1,1,1\n", "a.csv: line 3: has 3 items; allowed: 2"),
        ("time_s,a_mm\n0,0\n\n1,x\n", "a.csv: line 4, column 'a': 'x'; allowed: a number"),
        ("time_s,a_mm\n0,0\n1,nan\n", "a.csv: column a: has no number at 1 s"),
        ("time_s,a_mm\n0,0\n1,\n", "a.csv: column a: has no number at 1 s"),
        ("time_s,a_mm\n0,0\n2,1\n1,1\n", "a.csv: The times of column 'time' go back"),
        ("time_s,a_mm\n-1,0\n2,1\n", "a.csv: column a: times.0 = -1.0: allowed: >= 0"),
        ("time_s,a_mm\n0,1\n2,1\n", "a.csv: column a: begins with 1 mm; allowed: 0, for extension counts"),
        ("time_s,a_mm\n0,0\n1,1\n1,2\n", "a.csv: Times are repeated"),
    ],
)
def test_what_is_wrong_is_said_with_file_and_column(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(InputError) as caught:
        read_drives(tmp_path / "a.csv")
    assert str(caught.value).removeprefix(f"{tmp_path}/").startswith(said)
