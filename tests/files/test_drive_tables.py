"""Displacements over time from CSV: read with one rounding, refused by file, line and column."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn.files import read_drives
from support_exudyn.files.scenarios.drive_table import one_drive
from tests import strategies as some
from user_forces import InputError

GOOD = "time_s,front_column_mm,rear_column_mm\n0,0,0\n1,100,90.1\n\n2.5, 250 ,240\n"


def drives(folder: Path, text: str | bytes) -> object:
    path = folder / "a.csv"
    path.write_bytes(text.encode("utf-8", "surrogatepass") if isinstance(text, str) else text)
    return read_drives(path)


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
    with pytest.raises(InputError, match=r"column = 'rear_colum': no such column; did you mean rear_column"):
        one_drive(path, "rear_colum", "smooth")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "a.csv: is empty"),
        ("time_s,front\n0,0\n1,1\n", "a.csv: line 1: column 2 = 'front': has no unit at its end"),
        ("time,front_mm\n0,0\n1,1\n", "a.csv: line 1: column 1 = 'time': has no unit at its end"),
        ("front_mm,rear_mm\n0,0\n1,1\n", "a.csv: line 1: 'front_mm,rear_mm': allowed: one time_s or time_ms"),
        ("time_s,a_mm\n0,0\n", "a.csv: has 1 points; allowed: two at least"),
        ("time_s,a_mm\n0,0\n1,1,1\n", "a.csv: line 3: has 3 items; allowed: 2"),
        ("time_s,a_mm\n0,0\n\n1,x\n", "a.csv: line 4, column a_mm: 'x': allowed: a number"),
        ("time_s,a_mm\n0,0\n1,nan\n", "a.csv: line 3, column a_mm: 'nan': allowed: a number"),
        ("time_s,a_mm\n0,0\n1,1e99\n", "a.csv: line 3, column a_mm: '1e99': allowed: up to 1e+30"),
        ("time_s,a_mm\n0,0\n1,\n", "a.csv: line 3, column a_mm: '': allowed: a number"),
        ("time_s,a_mm\n0,0\n2,1\n1,1\n", "a.csv: line 4, column time_s: 1: allowed: > 2, the time before"),
        ("time_s,a_mm\n-1,0\n2,1\n", "a.csv: line 2, column time_s: -1: allowed: >= 0"),
        ("time_s,a_mm\n0,1\n2,1\n", "a.csv: line 2, column a_mm: 1: allowed: 0, for extension counts"),
        ("time_s,a_mm\n0,0\n1,1\n1,2\n", "a.csv: line 4, column time_s: 1: allowed: > 1, the time before"),
        ("time_s;a_mm\n0;0\n1;1\n", "a.csv: line 1: 'time_s;a_mm': allowed: one time_s or time_ms, and"),
        ("time_s,a_mm\n0,0\n0,5,1,5\n", "a.csv: line 3: has 4 items; allowed: 2, as the first line (decimals"),
        (b"time_s,a_mm\n0,\xff\n", "a.csv: byte 14 is not UTF-8"),
    ],
)
def test_what_is_wrong_is_said_with_file_line_and_column(tmp_path: Path, text: str | bytes, said: str) -> None:
    with pytest.raises(InputError) as caught:
        drives(tmp_path, text)
    assert str(caught.value).removeprefix(f"{tmp_path}/").startswith(said)


@given(text=some.mangled(st.just(GOOD)) | st.text(max_size=40))
@some.tried("drive tables")
def test_any_text_is_a_table_or_refused(tmp_path_factory: pytest.TempPathFactory, text: str) -> None:
    folder = tmp_path_factory.getbasetemp()
    try:
        drives(folder, text)
    except InputError as error:
        if "a.csv" not in str(error):
            raise
