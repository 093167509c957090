"""Tables of text as people have them: text -> names, units, times, values and notes, or a refusal."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn.files.series.named_series import SeriesFile
from support_exudyn.files.series.read import read_series
from user_forces import InputError

NAN = math.nan
COMPRESSED = (b"BZh9", b"\xfd7zXZ", b"7z\xbc\xaf", b"Rar!", b"\x28\xb5\x2f\xfd")  # how such files begin
Read = dict[str, tuple[str | None, list[float], list[float]]]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("tables")


def read(folder: Path, text: str | bytes, **asked: Any) -> SeriesFile:
    path = folder / "a.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_series(path, **asked)


def check(found: SeriesFile, expected: Read) -> None:
    """Names, units, times and values are as expected."""
    assert list(found.series) == list(expected)
    for name, (unit, time, values) in expected.items():
        one = found.series[name]
        assert one.unit == unit
        np.testing.assert_allclose(one.time, time, rtol=1e-12, atol=1e-9)
        np.testing.assert_array_equal(one.values, values)


@pytest.mark.parametrize(
    "text",
    [
        "time_s,x_mm\n0,1.5\n0.5,-2\n",
        "time_ms;x [mm]\n0;1,5\n500;-2\n",
        "Time [s]   x [mm]\n  0.0   1.5\n  0.5  -2.0\n",
        '"time_s","x_mm"\r\n"0","1.5"\r\n"0.5","-2"\r\n',
        "\ufefftime_s,x_mm\n\n0, 1.5D0\n# a remark\n0.5 ,-2e0\n",
        "time;x\n[s];[mm]\n0;1,5\n0,5;-2\n",
        "% time x\n% [s] [mm]\n0 1.5\n0.5 -2\n",
        "; logger 5\ntime_s,x_mm\n; begins\n0,1.5\n0.5,-2\n",
        "time_s;x_mm\n0;1.5;\n0.5;-2;\n",
        'Zeit in s,x/mm\n"0,0","1,5"\n"0,5","-2,0"\n',
        '"Time\n(s)","x\n(mm)"\n0,1.5\n0.5,-2\n',
        "Time (Second)|x, mm\n0|1.5\n0.5|-2\n",
        "Kanal;CH1\ntime;x\ns;mm\nDaten:\n0;1,5\n0,5;-2\n",
        "time_s,x_mm\n0,1.5\n0.5,-2\n".encode("utf-16"),
        "时间(s),x\uff08mm\uff09\n0,1.5\n0.5,-2\n".encode("gbk"),
        "2,2\ntime_s,x_mm\n0,1.5\n0.5,-2\n",
        "TIME [S]\tx_MM\n0\t1.5\n0.5\t-2\n\nEnd of data\nMax\t1.5\n",
        "Run time (s)  x (mm)\n0.0  1.5\n0.5  -2\n",
    ],
)
def test_the_same_table_is_read_however_it_is_written(folder: Path, text: str | bytes) -> None:
    check(read(folder, text), {"x": ("mm", [0.0, 0.5], [1.5, -2.0])})


@pytest.mark.parametrize(
    ("text", "times"),
    [
        ("Time;F_kN\n2023-05-04 06:00:00.25;1\n2023-05-04 06:00:01,5;2\n", [0.0, 1.25]),
        ("Timestamp,F_kN\n2023-05-04T06:00:00Z,1\n2023-05-04T08:00:01.000+02:00,2\n", [0.0, 1.0]),
        ("DateTime,F_kN\n2023/05/04 06:00,1\n2023/05/05 06:00,2\n", [0.0, 86400.0]),
        ("Zeit;F_kN\n04.05.2023 06:00;1\n03.06.2023 06:00;2\n", [0.0, 30 * 86400.0]),  # day first
        ("Zeit;F_kN\n28.02.24 23:59:59;1\n01.03.24 00:00:00;2\n", [0.0, 86401.0]),  # a leap year
        ("Time,F_kN\n05/04/2023 11:59:59 AM,1\n05/04/2023 12:00:00 PM,2\n", [0.0, 1.0]),
        ("Time,F_kN\n05/31/2023 11:59:59 PM,1\n06/01/2023 12:00:00 AM,2\n", [0.0, 1.0]),  # month first
        ("Time,F_kN\n31/05/2023 23:59:59,1\n01/06/2023 00:00:00,2\n", [0.0, 1.0]),
        ("Time,F_kN\n4-May-2023 6:00:00,1\n04 May 2023 06:00:00.125,2\n", [0.0, 0.125]),
        ("Time,F_kN\n20230504T060000,1\n20230504T060001.5,2\n", [0.0, 1.5]),
        ("时间,F_kN\n2023年5月4日 06:00:00,1\n2023年5月4日 06:00:02,2\n", [0.0, 2.0]),
        ("Time,F_kN\n23:59:59.5,1\n00:00:01.5,2\n", [0.0, 2.0]),  # over midnight
        ("Time;F_kN\n06:00:00:250;1\n06:00:00:750;2\n", [0.0, 0.5]),
        ("Time,F_kN\n59:59.0,1\n00:00.5,2\n", [0.0, 1.5]),  # a spreadsheet's mm:ss.0, over the hour
        ("Date Time F_kN\n2023-05-04 23:59:59 1\n2023-05-05 00:00:01 2\n", [0.0, 2.0]),
        ("Date,F_kN\n2023-05-04,1\n2023-05-06,2\n", [0.0, 2 * 86400.0]),
        ("Date,F_kN\n45050.25,1\n45050.75,2\n", [0.0, 43200.0]),
        ("time,F_kN\n1683180000250,1\n1683180000500,2\n", [0.0, 0.25]),
        ("Sampling rate: 1000 Hz\nF_kN\n1\n2\n", [0.0, 1e-3]),
        ("Sample interval,0.001\nF_kN,x_mm\n1,\n2,\n", [0.0, 1e-3]),
        ("fs [Hz] 500\nF_kN\n1\n2\n", [0.0, 2e-3]),
        ("# Sample Rate (kHz): 2,0\nF in kN\n1,0\n2,0\n", [0.0, 5e-4]),
        ("Scan rate;250 S/s\nF_kN;x_mm\n1;\n2;\n", [0.0, 4e-3]),
        ("采样频率: 100Hz\nF_kN\n1\n2\n", [0.0, 1e-2]),
        ("Time step (ms): 5\nF_kN\n1\n2\n", [0.0, 5e-3]),
    ],
)
def test_times_are_seconds_from_the_first_stamp_or_of_the_rate(
    folder: Path, text: str, times: list[float]
) -> None:
    found = read(folder, text, names=["F"])
    check(found, {"F": ("kN", times, [1.0, 2.0])})
    assert any("from the first" in note or "from 0 s" in note for note in found.notes)


def test_a_rate_is_used_where_a_file_has_no_times_that_change(folder: Path) -> None:
    text, coarse = "F_kN\n1\n2\n", "Time,F_kN\n06:00:00,1\n06:00:00,2\n"
    for table in (text, coarse):
        check(read(folder, table, rate=100.0), {"F": ("kN", [0.0, 0.01], [1.0, 2.0])})
    assert any("is not used" in note for note in read(folder, "time_s,x\n0,1\n3,2\n", rate=10.0).notes)
    for table, rate, message in (
        (coarse, None, r"line 3, column 'Time': at least every other row repeats .* --rate 10"),
        (text, -1.0, r"a.csv: rate = -1.0: allowed: > 0"),
        (f"dt = 5 s\nfs = 10 Hz\n{text}", None, r"its header gives two rates, 'fs = 10 Hz' and 'dt = 5 s'"),
    ):
        with pytest.raises(InputError, match=message):
            read(folder, table, rate=rate)


@pytest.mark.parametrize(
    ("cells", "value"),
    [
        (["", "--", "1.#QNAN", "n/a", "#N/A", "-inf"], NAN),
        (["+1500", "1500.", "1.5e3", '"1,500.0"', '" 1500 "', "1.5D3"], 1500.0),
        *(([number], 1234.5) for number in ("1.234,5", "1 234,5", "1\u00a0234,5", "1'234,5", "1234,5")),
    ],
)
def test_cells_are_numbers_or_nothing(folder: Path, cells: list[str], value: float) -> None:
    separator, decimal = (";", ",") if value == 1234.5 else (",", ".")
    rows = "".join(f"{n}{decimal}5{separator}{cell}\n" for n, cell in enumerate(["0", *cells]))
    values = read(folder, f"time_s{separator}x\n{rows}").series["x"].values[1:]
    np.testing.assert_array_equal(values, [value] * len(cells))


@pytest.mark.parametrize(
    ("text", "names", "times", "note"),
    [
        ("time_s,x_mm\n0.5,-2\n0,1.5\n", "x", [0, 0.5], "go back at line 3; rows are sorted"),
        ("time_s,x\n0,7\n# x\n0,1.5\n0.5,-2\n", "x", [0, 0.5], "1 are left out, the first is line 2"),
        ("time_s,x\n,7\n0,1\n0.5,2\n", "x", [0, 0.5], "without a time are left out: 1, the first is line 2"),
        ("Logger 7\nSite;north\ntime_s;x\n0;1\n1;2\n", "x", [0, 1], "2 lines above the rows passed over"),
        ("time_s,x\n0,1\n1,2\nEnd\n", "x", [0, 1], "1 line below the rows passed over"),
        ("time_s;v_m_s\n0;1.5\n1;-2\n", "v_m_s", [0, 1], "'v_m_s': its unit can be read in two ways"),
        ("time_s,x,x\n0,1,2\n1,2,3\n", "x x#2", [0, 1], "Several columns are called 'x'; the later"),
        ("time_s,x,\n0,1,2\n1,2,3\n", "x column_3", [0, 1], "Columns without a title are called 'column_3'"),
        ("time,a,b\ns,m,m\n1,2,3\n0,5,6\n1,7,8\n2,7,8\n", "a b", [0, 1, 2], "Line 3 numbers the columns"),
        ("time_s,F [KN]\n0,1\n1,2\n", "F", [0, 1], "Column 'F': unit 'KN' is read as kN"),
        ("time_s,p [mpa]\n0,1\n1,2\n", "p", [0, 1], "'mpa' may be mPa or MPa; it counts as none"),
        ("time_s,F (Ton)\n0,1\n1,2\n", "F", [0, 1], "'Ton' is read as the tonne of 1000 kg, and its weight"),
        ("Zeit (s);Weg (µm)\n0;1\n1;2\n".encode("cp1252"), "Weg", [0, 1], "was read as Windows-1252"),
        ("时间(s),压力(MPa)\n0,1\n1,2\n".encode("gbk"), "压力", [0, 1], "was read as GBK"),
        ("Time,x\n23:59:59,1\n00:00:01,2\n", "x", [0, 2], "runs over midnight"),
        ("time_s,x\n0,inf\n1,2\n", "x", [0, 1], "x: infinite values count as not known: 1"),
        ("Lauf [s];Weg;F\n0,0;1,5;7\n0,5;-2,0;7\n", "Weg F", [0, 0.5], "'Lauf' is taken for the times"),
        ("time_s,x,time_s,y\n0,1,0,3\n1,2,1,4\n", "x y", [0, 1], "2 columns of times"),
        ('time_s,x,"Note"\n0,1.5,"ok"\n0.1,,"a, b"\n', "x", [0, 0.1], "no numbers are left out: 'Note'"),
        (
            "Datum;Zeit [s];x;Status\r\n12.03.2024;0,0;1,5;OK\r\n12.3.24;0,1;1,7;no\r\n12.3.24;0,2;;\r\n",
            "x", [0, 0.1, 0.2], "no numbers are left out: 'Status', 'Datum'",
        ),
        ("ID,T [degC],t_s\n1,20,0\n2,21,1\n", "ID T", [0, 1], ""),
    ],
)  # fmt: skip
def test_what_was_assumed_is_noted(
    folder: Path, text: str | bytes, names: str, times: list[float], note: str
) -> None:
    found = read(folder, text)
    assert list(found.series) == names.split()
    assert found.series[names.split()[0]].time == pytest.approx(times)
    assert not note or any(note in one for one in found.notes)


def test_a_unit_is_given_by_a_pattern(folder: Path) -> None:
    asked = {"column_1": "ms", "column_*": "KN"}
    check(read(folder, "0 1\n1 2\n", units=asked), {"column_2": ("kN", [0, 1e-3], [1, 2])})
    check(read(folder, "Zeit,Weg_mm\n0,5\n100,6\n", units={"Zeit": "ms"}), {"Weg": ("mm", [0, 0.1], [5, 6])})


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time_s,x_mm\n0,5,1,2\n1,5,1,2\n", "line 1: has 2 titles, .* above rows of 4 items"),
        ("time_s;x\n1;1,234\n2;5,678\n", "'1,234' may be 1234 or 1.234; allowed: decimals with a point, or"),
        ("time_s,x\n0,1\n1,abc\n2,3\n", "line 3, column 'x': 'abc'; allowed: a number such as 12.5"),
        ("time_s,x_m,n\n0,1,a\n1,2,a\n2,y\n", "line 4: has 2 items; allowed: 3"),
        ("time_s;x\n0;1,5\n1;1.5\n", "line 2, column 'x': '1,5'; allowed: a number such as 12.5"),
        ("Time,x\n2023-05-04 06:00,1\n2023-05-32 06:00,1\n", "line 3, column 'Time': .*; allowed: a date"),
        ("Date,x\n02/01/2023 06:00,1\n03/01/2023 06:00,2\n", "line 2, .*allowed: dates with the year first"),
        ("time,x\n0,1\n1,2\n", "column 'time': have no unit; allowed: one in the title, such as time_s"),
        ("time_kN,x\n0,1\n1,2\n", "are in 'kN'; allowed: a unit of time"),
        ("time_s,x\n0,1\n1,2\n\ntime_s,x\n2,3\n", "line 5, column 'time': 'time_s'; allowed: a number"),
        ("a,b\n0,1\n1,2\n", "has no times; allowed: a column time_s.*its numbers are 'a', 'b'"),
        ("Beginn [s];Ende [s]\n0,0;1,5\n0,5;2,0\n", "has no times"),
        ("time_s,x\ninf,1\n1,2\n", "line 2 is infinite"),
        ("It is late, says she,\nand goes, as ever,\n", "is no table of numbers"),
        (b"", "is empty; allowed: "),
        ("<!DOCTYPE html><html><table>", "is a page of HTML, .*allowed: the table saved"),
        (
            b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(99),
            r"is an old workbook of Excel \(.xls\), .*allowed: the",
        ),
        (b"TDSm" + bytes(99), "is a TDMS file of LabVIEW"),
        (b"\x1f\x8b\x08" + bytes(99), r"is a compressed file \(gzip\), .*unpacked"),
        *((head + bytes(99), "is a compressed file, .*unpacked") for head in COMPRESSED),
        (b"%PDF-1.4\n1 0 obj\nxref\n0 2\n", "is a PDF document, .*allowed: the table as CSV"),
        (b"\x93NUMPY\x01\0" + bytes(99), "is of no kind that can be read; allowed: run of this program, "),
        (b"SQLite format 3\0" + bytes(99), "is of no kind that can be read; allowed: run of this program, "),
        (b"MDF     4.10\0" + bytes(99), "is of no kind that can be read; allowed: run of this program, "),
        (b"PK\x03\x04" + bytes(99), r"is an archive \(zip\), .*unpacked"),
    ],
)
def test_what_is_wrong_or_has_two_meanings_is_refused(folder: Path, text: str | bytes, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read(folder, text)


def test_a_file_that_does_not_fit_into_memory_is_refused(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*given: object, **named: object) -> None:
        raise MemoryError

    monkeypatch.setattr(Path, "read_bytes", full)
    with pytest.raises(InputError, match=r"csv: has .* MB, too much for the free memory; allowed: fewer rows"):
        read(folder, "time_s,x\n0,1\n1,2\n")


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
    assert [*zip(found.time.tolist(), found.values.tolist(), strict=True)] == sorted(rows)
