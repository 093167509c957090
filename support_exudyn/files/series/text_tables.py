"""Series from tables of text: CSV, and items that tabs, semicolons or blanks separate.

What separates items, whether decimals have a comma and where titles stand is found in the file, see
`table_layout`. pyarrow parses the numbers.
"""

from __future__ import annotations

import codecs
import io
import re
from array import array
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

import numpy as np

from support_exudyn.files.free_memory import available
from support_exudyn.files.series.columns import Column, Numbers, places_of_times, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.table_layout import (
    BLANKS,
    COMMENT,
    LETTERS,
    LINES,
    MISSING,
    TableLayout,
    layout,
)
from support_exudyn.files.whole_file import contents
from user_forces.values.value import InputError, short

BLOCK = 2**24  # bytes that are parsed at a time, more than a line has
COMMENTS = re.compile(rb"(?m)^[ \t]*(#|%|!|//)[^\n]*\n?")


def read_text_table(path: Path, asked: Asked) -> SeriesFile:
    """The series of a table: every column but those of times.

    A column is of times if it is called time or t, or if it is the first of columns without titles. Of several
    columns of times each is of the columns to its right, up to the next.

    Raises InputError for what is no table, or can be read in two ways, with line and column; OSError if it
    cannot be read.
    """
    data, notes = text_of(path)
    asked.progress(0.2)
    head = list(islice(lines_of(data[: 4 * LETTERS]), LINES))
    how = layout(path, head)
    values = numbers_of(path, data, how)
    asked.progress(0.9)
    columns = [
        Column(name, unit, one)
        for n, ((name, unit), one) in enumerate(zip(how.titles, values, strict=True))
        if n not in how.words
        and not (name.startswith("column_") and np.isnan(one).all())  # after a last separator
    ]
    groups, said = _over_times(path, columns, how, asked)
    found = series_file(path, "table of text", groups, asked, (*notes, *how.notes, *said))
    asked.progress(1.0)
    return found


def numbers_of(path: Path, data: bytes, how: TableLayout) -> list[Numbers]:
    """The columns of numbers of a text that is written so.

    Raises InputError that names line and column of what is no number.
    """
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


def _by_arrow(body: bytes, how: TableLayout) -> list[Numbers] | None:
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
                column_types={one: pa.string() if int(one) in how.words else pa.float64() for one in names},
                include_columns=[one for one in names if int(one) not in how.words],
                null_values=[*MISSING],
                decimal_point=how.decimal,
            ),
        )
    except (pa.ArrowException, ValueError):
        return None
    nothing = np.full(table.num_rows, np.nan)
    return [
        nothing if n in how.words else np.asarray(table.column(str(n)).to_numpy(), dtype=np.float64)
        for n in range(how.width)
    ]


def _by_line(path: Path, data: bytes, how: TableLayout) -> list[Numbers]:
    """The columns line by line, which finds what is wrong, and numbers that pyarrow does not take, 1D+3."""
    numbers = array("d")
    for number, line in enumerate(lines_of(data), 1):
        if number <= how.first or not line.strip() or COMMENT.match(line):
            continue
        found = how.items(line)
        if len(found) != how.width:
            raise InputError(f"{path}: line {number}: has {len(found)} items; allowed: {how.width}, as before")
        known = [np.nan if n in how.words else how.number(one) for n, one in enumerate(found)]
        row = [one for one in known if one is not None]
        if len(row) < how.width:
            place = known.index(None)
            point = "12,5" if how.decimal == "," else "12.5"
            raise InputError(
                f"{path}: line {number}, column {short(how.titles[place][0])}: {short(found[place])}; "
                f"allowed: a number such as {point}, or nothing"
            )
        numbers.extend(row)
    return list(np.frombuffer(numbers, dtype=np.float64).reshape(-1, how.width).T)


def _over_times(
    path: Path, columns: list[Column], how: TableLayout, asked: Asked
) -> tuple[list[tuple[Column, list[Column]]], list[str]]:
    """Columns of times, each with the columns that are over it."""
    times, told = places_of_times(columns, asked)
    if not times and columns and columns[0].name == "column_1":
        times = [0]
    if not times:
        known = ", ".join(short(one.name) for one in columns[:6])
        others = ", ".join(short(how.titles[n][0]) for n in sorted(how.words)[:6])
        raise InputError(
            f"{path}: has no times; allowed: a column time_s, time_ms or 'time [s]' of numbers; its numbers "
            f"are {known}" + (f", its words {others}" if how.words else "")
        )
    if len(times) == 1:
        (place,) = times
        return [(columns[place], columns[:place] + columns[place + 1 :])], told
    if times[0] != 0:
        raise InputError(
            f"{path}: column {short(columns[0].name)}: stands before the first of {len(times)} columns of "
            "times; allowed: after that of its own"
        )
    ends = [*times[1:], len(columns)]
    groups = [(columns[start], columns[start + 1 : end]) for start, end in zip(times, ends, strict=True)]
    return groups, [f"{len(times)} columns of times; each is of the columns to its right, up to the next."]


# --- text of files that others have written ---

SHARE = 12  # of the memory that is free, one part is for the file; the worst, "1;1;1", takes ten times itself
UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
ALLOWED = "text in UTF-8, UTF-16 or Windows-1252"


def text_of(path: Path) -> tuple[bytes, list[str]]:
    """The text of a file in UTF-8, its lines ended by line feeds, and notes on it.

    Raises InputError for what is no text, or more than fits into memory; OSError if it cannot be read.
    """
    data, notes = contents(path, available() // SHARE), []
    if data.startswith(UTF_16):
        data = _decoded(path, data, "utf-16").encode()
    data = data.removeprefix(codecs.BOM_UTF8)
    if b"\0" in data:
        raise InputError(f"{path}: byte {data.index(0)} is 0, which no text has; allowed: {ALLOWED}")
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
        raise InputError(f"{path}: byte {error.start} is no text; allowed: {ALLOWED}") from None


def lines_of(data: bytes) -> Iterator[str]:
    """The lines of a text in UTF-8."""
    return (line.decode(errors="replace").rstrip("\n") for line in io.BytesIO(data))
