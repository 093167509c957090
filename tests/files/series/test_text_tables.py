"""Tables of text: what separates, what is a decimal, what is told, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn.files.series.named_series import SeriesFile
from support_exudyn.files.series.read import read_series
from user_forces import InputError


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One for all examples."""
    return tmp_path_factory.mktemp("tables")


def read(folder: Path, text: str | bytes, **asked: object) -> SeriesFile:
    path = folder / "a.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_series(path, **asked)  # type: ignore[arg-type]


def values(found: SeriesFile) -> dict[str, tuple[str | None, list[float], list[float]]]:
    return {name: (one.unit, one.time.tolist(), one.values.tolist()) for name, one in found.series.items()}


TWO = {"x": ("mm", [0.0, 0.5], [1.5, -2.0])}


@pytest.mark.parametrize(
    "text",
    [
        "time_s,x_mm\n0,1.5\n0.5,-2\n",
        "time_ms;x [mm]\n0;1,5\n500;-2\n",
        "time_ms\tx (mm)\n0\t1,5\n500\t-2,0\n",
        "Time [s]   x [mm]\n  0.0   1.5\n  0.5  -2.0\n",
        '"time_s","x_mm"\r\n"0","1.5"\r\n"0.5","-2"\r\n',
        "\ufefftime_s,x_mm\n\n0, 1.5\n# a remark\n0.5 ,-2e0\n",
        "time;x\ns;mm\n0;1.5\n0.5;-2\n",
        "time;x\n[s];[mm]\n0;1,5\n0,5;-2\n",
        "# t [s] x [mm]\n0 1.5\n0.5 -2\n",
        "time_s;x_mm;\n0;1.5;\n0.5;-2;\n",
        "time_s;x_mm\n0;1.5;\n0.5;-2;\n",
        "time_s,x_mm\n0,1.5D0\n0.5,-2\n",
        "time_s,x_mm\n0.5,-2\n0,1.5\n",
        "time_s,x_mm\n0,7\n0,1.5\n0.5,-2\n",
        "time_s,x_mm\n,7\n0,1.5\n0.5,-2\n",
        "Logger 7\nSite;north\ntime_s;x_mm\n0;1,5\n0,5;-2\n",
    ],
)
def test_the_same_table_is_read_however_it_is_written(folder: Path, text: str) -> None:
    assert values(read(folder, text)) == TWO


@pytest.mark.parametrize(
    ("text", "note"),
    [
        ("time_s,x_mm\n0.5,-2\n0,1.5\n", "go back; rows are sorted"),
        ("time_s,x_mm\n0,7\n0,1.5\n0.5,-2\n", "of rows of one time the last stays, 1 are left out"),
        ("time_s,x_mm\n,7\n0,1.5\n0.5,-2\n", "Rows without a time are left out: 1"),
        ("Logger 7\nSite;north\ntime_s;x_mm\n0;1,5\n0,5;-2\n", "2 lines above the titles are passed over"),
        ("time_s;x_mm;v_m_s\n0;1.5;1\n0.5;-2;1\n", "'v_m_s': its unit can be read in two ways"),
    ],
)
def test_what_a_reader_has_to_know_is_told(folder: Path, text: str, note: str) -> None:
    assert any(note in one for one in read(folder, text).notes)


def test_several_columns_of_times_are_of_what_stands_to_their_right(folder: Path) -> None:
    found = read(folder, "time_s,x_mm,time_s,y_kN\n0,1,0,3\n1,2,0.5,4\n,,1,5\n")
    assert values(found) == {"x": ("mm", [0.0, 1.0], [1.0, 2.0]), "y": ("kN", [0.0, 0.5, 1.0], [3.0, 4.0, 5.0])}
    assert any("2 columns of times" in one for one in found.notes)


def test_the_only_column_in_a_unit_of_time_is_the_times(folder: Path) -> None:
    found = read(folder, "Zeit [s];Weg [mm];Kraft\n0,0;1,5;7\n0,5;-2,0;7\n")
    assert values(found)["Weg"] == TWO["x"]
    assert found.notes == ("Column 'Zeit' is taken for the times: it alone is in a unit of time.",)
    with pytest.raises(InputError, match="has no times"):
        read(folder, "Beginn [s];Ende [s]\n0,0;1,5\n0,5;2,0\n")


def test_a_unit_is_asked_for_and_given_by_a_pattern(folder: Path) -> None:
    text = "0 1\n1 2\n"
    with pytest.raises(InputError, match=r"'column_1': have no unit; allowed: .*time_s"):
        read(folder, text)
    found = read(folder, text, units={"column_1": "ms", "column_*": "kN"})
    assert values(found) == {"column_2": ("kN", [0.0, 1e-3], [1.0, 2.0])}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time_s,x_mm\n0,5,1,2\n1,5,1,2\n", "line 1: has 2 titles, .* above rows of 4 items"),
        ("time_s;x\n1;1,234\n2;5,678\n", "'1,234' may be 1234 or 1.234; allowed: decimals with a point, or"),
        ("time_s,x\n0,1\n1,abc\n", "line 3, column 'x': 'abc'; allowed: a number such as 12.5"),
        ("time_s;x\n0;1,5\n1;1.5\n", "line 2, column 'x': '1,5'; allowed: a number such as 12.5"),
        ("time_s,x\n0,1\n1\n", "line 3: has 1 items; allowed: 2"),
        ('time_s,x\n0,1\n1,"1,234"\n', "line 3, column 'x': '1,234'"),
        ("time,x\n0,1\n1,2\n", "column 'time': have no unit; allowed: one in the title, such as time_s"),
        ("time_kN,x\n0,1\n1,2\n", "are in 'kN'; allowed: a unit of time"),
        ("a,b\n0,1\n1,2\n", "has no times; allowed: a column time_s"),
        ("time_s,x,x\n0,1,2\n1,2,3\n", "column 'x': stands twice"),
        ("time_s,x\ninf,1\n1,2\n", "row 1 is infinite"),
        ("hello, world\n", "is no table of numbers"),
        (b"time_s,x\n0,1\n\0,2\n", "byte 13 is 0, which no text has|of no kind that can be read"),
        (b"", "is empty; allowed: "),
    ],
)
def test_what_is_wrong_or_has_two_meanings_is_refused(folder: Path, text: str | bytes, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read(folder, text)


numbers = st.floats(-1e6, 1e6, allow_subnormal=False)


@given(
    rows=st.lists(st.tuples(numbers, numbers), min_size=1, max_size=8, unique_by=lambda row: row[0]),
    separator=st.sampled_from([",", ";", "\t", "  "]),
    comma=st.booleans(),
)
def test_numbers_are_read_as_the_same_bits(
    folder: Path, rows: list[tuple[float, float]], separator: str, comma: bool
) -> None:
    rows = [*rows, (2e6, 0.5)]  # by which a comma is told
    lines = [separator.join(map(repr, row)) for row in rows]
    if comma and separator != ",":
        lines = [line.replace(".", ",") for line in lines]
    found = read(folder, "\n".join([separator.join(["time_s", "x_mm"]), *lines]) + "\n").series["x"]
    expected = sorted(rows)
    assert found.time.tolist() == [row[0] for row in expected]
    assert found.values.tolist() == [row[1] for row in expected]
