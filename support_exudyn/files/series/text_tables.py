"""Series from tables of text: CSV, and items that tabs, semicolons or blanks separate.

What separates items, whether decimals have a comma and where titles stand is found in the file, see
`table_layout`. pyarrow parses the numbers.
"""

from __future__ import annotations

import codecs
import io
import re
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

import numpy as np

from support_exudyn.files.free_memory import available
from support_exudyn.files.series.asked import Asked
from support_exudyn.files.series.columns import Column, Numbers, is_named_time, series_file
from support_exudyn.files.series.named_series import SeriesFile
from support_exudyn.files.series.table_layout import BLANKS, COMMENT, LETTERS, LINES, MISSING, Layout, layout
from support_exudyn.files.whole_file import contents
from user_forces.values.value import InputError, short

SHARE = 8  # of the memory that is free, one part is for the file: text, columns and what is between them
BLOCK = 2**24  # bytes that are parsed at a time, more than a line has
COMMENTS = re.compile(rb"(?m)^[ \t]*(#|%|!|//)[^\n]*\n?")
UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


def read_text_table(path: Path, asked: Asked) -> SeriesFile:
    """The series of a table: every column but those of times.

    A column is of times if it is called time or t, or if it is the first of columns without titles. Of several
    columns of times each is of the columns to its right, up to the next.

    Raises InputError for what is no table, or can be read in two ways, with line and column; OSError if it
    cannot be read.
    """
    data, notes = _text(path)
    asked.progress(0.2)
    head = list(islice(_lines(data[: 4 * LETTERS]), LINES))
    how = layout(path, head)
    values = _numbers(path, data, how)
    asked.progress(0.9)
    columns = [
        Column(name, unit, one)
        for (name, unit), one in zip(how.titles, values, strict=True)
        if not (name.startswith("column_") and np.isnan(one).all())  # after a last separator
    ]
    groups, said = _over_times(path, columns)
    found = series_file(path, "table of text", groups, asked, (*notes, *how.notes, *said))
    asked.progress(1.0)
    return found


def _text(path: Path) -> tuple[bytes, list[str]]:
    """The text of a file in UTF-8, lines ended by line feeds, and what is told of it."""
    data, notes = contents(path, available() // SHARE), []
    if data.startswith(UTF_16):
        data = _decoded(path, data, "utf-16").encode()
    data = data.removeprefix(codecs.BOM_UTF8)
    if b"\0" in data:
        raise InputError(f"{path}: has a byte 0; allowed: tables of text in UTF-8, UTF-16, Windows-1252")
    try:
        data.decode()
    except UnicodeDecodeError:
        data = _decoded(path, data, "cp1252").encode()
        notes.append("The text is not in UTF-8; it was read as Windows-1252.")
    if b"\r" in data:
        data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    return data, notes


def _decoded(path: Path, data: bytes, encoding: str) -> str:
    try:
        return data.decode(encoding)
    except UnicodeDecodeError as error:
        raise InputError(
            f"{path}: byte {error.start} is no text; allowed: tables in UTF-8, UTF-16 or Windows-1252"
        ) from None


def _lines(data: bytes) -> Iterator[str]:
    return (line.decode(errors="replace").rstrip("\n") for line in io.BytesIO(data))


def _numbers(path: Path, data: bytes, how: Layout) -> list[Numbers]:
    """The columns of numbers."""
    start = 0
    for _ in range(how.first):
        start = data.index(b"\n", start) + 1
    body = data[start:]
    if COMMENTS.search(body):
        body = COMMENTS.sub(b"", body)
    if how.separator == BLANKS:
        body = re.sub(rb"[ \t]+", b"\t", re.sub(rb"(?m)^[ \t]+|[ \t]+$", b"", body))
    found = _by_arrow(body, how)
    return _by_line(path, data, how) if found is None else found


def _by_arrow(body: bytes, how: Layout) -> list[Numbers] | None:
    """The columns as pyarrow parses them; None if it does not take an item."""
    import pyarrow as pa
    from pyarrow import csv

    names = [str(n) for n in range(how.width)]
    try:
        table = csv.read_csv(
            pa.BufferReader(body),
            csv.ReadOptions(use_threads=False, block_size=BLOCK, column_names=names),
            csv.ParseOptions(delimiter="\t" if how.separator == BLANKS else how.separator),
            csv.ConvertOptions(
                column_types=dict.fromkeys(names, pa.float64()),
                null_values=[*MISSING],
                decimal_point=how.decimal,
            ),
        )
    except (pa.ArrowException, ValueError):
        return None
    return [np.asarray(table.column(n).to_numpy(), dtype=np.float64) for n in range(how.width)]


def _by_line(path: Path, data: bytes, how: Layout) -> list[Numbers]:
    """The columns line by line, which finds what is wrong, and numbers that pyarrow does not take, 1D+3."""
    rows = []
    for number, line in enumerate(_lines(data), 1):
        if number <= how.first or not line.strip() or COMMENT.match(line):
            continue
        found = how.items(line)
        if len(found) != how.width:
            raise InputError(f"{path}: line {number}: has {len(found)} items; allowed: {how.width}, as before")
        row = [how.number(one) for one in found]
        if None in row:
            place = row.index(None)
            point = "12,5" if how.decimal == "," else "12.5"
            raise InputError(
                f"{path}: line {number}, column {short(how.titles[place][0])}: {short(found[place])}; "
                f"allowed: a number such as {point}, or nothing"
            )
        rows.append(row)
    return list(np.array(rows, dtype=np.float64).reshape(-1, how.width).T)


def _over_times(path: Path, columns: list[Column]) -> tuple[list[tuple[Column, list[Column]]], list[str]]:
    """Columns of times, each with the columns that are over it."""
    times = [n for n, one in enumerate(columns) if one.name.casefold() in ("time", "t")]
    if not times and columns and (is_named_time(columns[0].name) or columns[0].name == "column_1"):
        times = [0]
    if not times:
        known = ", ".join(short(one.name) for one in columns[:6])
        raise InputError(
            f"{path}: has no times; allowed: a column time_s, time_ms or 'time [s]'; it has {known}"
        )
    if len(times) == 1:
        (place,) = times
        return [(columns[place], columns[:place] + columns[place + 1 :])], []
    if times[0] != 0:
        raise InputError(
            f"{path}: column {short(columns[0].name)}: stands before the first of {len(times)} columns of "
            "times; allowed: after that of its own"
        )
    ends = [*times[1:], len(columns)]
    groups = [(columns[start], columns[start + 1 : end]) for start, end in zip(times, ends, strict=True)]
    return groups, [f"{len(times)} columns of times; each is of the columns to its right, up to the next."]
