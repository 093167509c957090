"""Series from tables of text: CSV, and items that tabs, semicolons or blanks separate.

What separates items, whether decimals have a comma and where titles stand is determined from the file, see
`table_layout`. pyarrow parses the numbers.
"""

from __future__ import annotations

import codecs
import io
import re
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from support_exudyn.files.free_memory import available
from support_exudyn.files.series.columns import Column, Numbers, Table, table_series
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.stamps import read_stamps
from support_exudyn.files.series.table_layout import LETTERS, LINES, TableLayout, layout
from support_exudyn.files.series.table_titles import (
    BLANKS,
    INFINITE,
    MISSING,
    NOTHING,
    NUMBERS,
    SEPARATORS,
    SIGNS,
    kind_of,
)
from support_exudyn.files.whole_file import contents
from user_forces.values.value import InputError, short

BLOCK = 2**24  # bytes that are parsed at a time, more than a line has
NULLS = sorted({one for word in MISSING for one in (word, word.upper(), word.capitalize(), "NaN", "N/a")})
HEAD = 60  # lines that may have titles
FOOT = 60  # lines that may stand below the rows


def read_text_table(path: Path, asked: Asked) -> SeriesFile:
    """The series of a table: every column of numbers but those of times, see `table_series`.

    Raises InputError for what is no table, or can be read in two ways, with line and column; OSError if it
    cannot be read.
    """
    data, notes = text_of(path)
    asked.progress(0.2)
    found = table_series(text_table(path, data, notes), asked)
    asked.progress(1.0)
    return found


def text_table(
    path: Path,
    data: bytes,
    notes: Sequence[str] = (),
    separators: Sequence[str] = SEPARATORS,
    what: str = "line",
) -> Table:
    """The columns of a text in UTF-8; its lines are called by the word `what`. Raises as `read_text_table`."""
    data = _with_whole_titles(data)
    how = layout(path, list(islice(lines_of(data[: 4 * LETTERS]), LINES)), separators)
    end, passed = _foot(data, how)
    place = partial(_place, data, how, what)
    below = [f"{passed} {'line' if passed == 1 else 'lines'} below the rows passed over."] if passed else []
    columns = [
        one
        for one in columns_of(path, data[:end], how, what)
        if one.stamps is not None or not (one.name.startswith("column_") and np.isnan(one.values).all())
    ]
    others = [name for (name, _), kind in zip(how.titles, how.kinds, strict=True) if kind == "word"]
    return Table(path, "table of text", columns, others, [*notes, *how.notes, *below], how.intervals, place)


def _with_whole_titles(data: bytes) -> bytes:
    """The text with titles in quotes, of several lines each, on a line; empty lines keep the numbering."""
    lines = data[:LETTERS].split(b"\n")[:HEAD]
    if not any(one.count(b'"') % 2 for one in lines):
        return data
    whole: list[bytes] = []
    n = 0
    while n < len(lines):
        end = n + 1
        while end < len(lines) and b"".join(lines[n:end]).count(b'"') % 2:
            end += 1
        closed = b"".join(lines[n:end]).count(b'"') % 2 == 0
        end = end if closed else n + 1
        whole += [b" ".join(lines[n:end]), *[b""] * (end - n - 1)]
        n = end
    rest = data[sum(map(len, lines)) + len(lines) - 1 :]
    return b"\n".join(whole) + rest


def columns_of(path: Path, data: bytes, how: TableLayout, what: str = "line") -> list[Column]:
    """The columns of numbers and stamps of a text that is written so; its lines are called by the word `what`.

    Raises InputError that names line and column of what is no number.
    """
    start = 0
    for _ in range(how.first):
        start = data.index(b"\n", start) + 1
    body: bytes | memoryview = memoryview(data)[start:]  # no copy
    signs = [b"#", b"%", b"!", b"//", *([] if how.separator == ";" else [b";"])]
    if any(data.find(sign, start) >= 0 for sign in signs):  # sooner than the pattern
        body = re.sub(rb"(?m)^" + how.comment.encode() + rb"[^\n]*\n?", b"", bytes(body))
    if how.separator == BLANKS:
        body = bytes(body)
        body = re.sub(rb"[ \t]+", b"\t", re.sub(rb"(?m)^[ \t]+|[ \t]+$", b"", body))
    table = _parsed(body, how, as_numbers=True)
    table = table if table is not None else _parsed(body, how, as_numbers=False)
    if table is None:
        raise _uneven(path, data, how)
    found = []
    for n, ((name, unit), kind) in enumerate(zip(how.titles, how.kinds, strict=True)):
        if kind == "word":
            continue
        values, stamps = table.column(str(n)), None
        if kind == "stamp":
            stamps = read_stamps(name, _texts(values))
            numbers = stamps.seconds
        elif str(values.type) == "double":
            numbers = np.asarray(values.to_numpy(), dtype=np.float64)
        else:
            texts = _texts(values)
            numbers, wrong = _numbers(texts, how.decimal)
            if wrong is not None:
                raise InputError(
                    f"{path}: {_place(data, how, what, wrong)}, column {short(name)}: "
                    f"{short(texts[wrong].as_py())}; allowed: a number such as 12{how.decimal}5, or nothing"
                )
        found.append(Column(name, unit, numbers, stamps))
    return found


def _parsed(body: bytes | memoryview, how: TableLayout, as_numbers: bool) -> Any:
    """The table as pyarrow parses it, numbers as such or all as strings; None if it does not take an item."""
    import pyarrow as pa
    from pyarrow import csv

    names = {str(n): kind for n, kind in enumerate(how.kinds)}
    try:
        return csv.read_csv(
            pa.BufferReader(body),
            csv.ReadOptions(use_threads=False, block_size=BLOCK, column_names=[*names]),
            csv.ParseOptions(
                delimiter="\t" if how.separator == BLANKS else how.separator,
                invalid_row_handler=lambda row: "skip" if not (row.text or "").strip() else "error",
            ),
            csv.ConvertOptions(
                column_types={
                    one: pa.float64() if kind == "number" and as_numbers else pa.string()
                    for one, kind in names.items()
                },
                include_columns=[one for one, kind in names.items() if kind != "word"],
                null_values=NULLS,
                strings_can_be_null=True,
                decimal_point=how.decimal,
            ),
        )
    except (pa.ArrowException, ValueError):
        return None


def _texts(values: Any) -> Any:
    """Strings without blanks around them, null where there is nothing."""
    import pyarrow as pa
    import pyarrow.compute as pc

    text = pc.utf8_trim_whitespace(values.combine_chunks())
    missing = pc.or_(
        pc.is_in(pc.utf8_lower(text), pa.array(sorted(MISSING))),
        pc.match_substring_regex(text, f"(?i)^{NOTHING}$"),
    )
    return pc.if_else(missing, None, text)


def _numbers(text: Any, decimal: str) -> tuple[Numbers, int | None]:
    """The numbers of strings (n,), NaN where there is nothing; and the index of the first that is none."""
    import pyarrow as pa
    import pyarrow.compute as pc

    known = pc.fill_null(pc.match_substring_regex(text, f"^({NUMBERS[decimal]}|{INFINITE})$"), True)
    wrong = int(np.argmin(known)) if not pc.all(known).as_py() else None
    plain = pc.replace_substring_regex(
        pc.if_else(known, text, None), f"[{',' if decimal == '.' else '.'}{SIGNS}]", ""
    )
    plain = pc.replace_substring_regex(pc.utf8_lower(plain), "^[+]", "")
    for old, new in ((",", "."), ("d", "e"), ("∞", "inf")):
        plain = pc.replace_substring(plain, old, new)
    return np.asarray(plain.cast(pa.float64()).to_numpy(zero_copy_only=False), dtype=np.float64), wrong


def _rows(data: bytes, how: TableLayout) -> Iterator[tuple[int, str]]:
    """The numbers, from 1 on, of the lines that are rows, and the lines."""
    comment = re.compile(how.comment)
    for number, line in enumerate(lines_of(data), 1):
        if number > how.first and line.strip() and not comment.match(line):
            yield number, line


def _place(data: bytes, how: TableLayout, what: str, row: int) -> str:
    """Where a row stands in the file."""
    return f"{what} {next(islice(_rows(data, how), row, None), (0, ''))[0]}"


def _uneven(path: Path, data: bytes, how: TableLayout) -> InputError:
    """What is wrong with rows that pyarrow does not take."""
    width = len(how.kinds)
    for number, line in _rows(data, how):
        if (count := len(how.items(line))) != width:
            return InputError(f"{path}: line {number}: has {count} items; allowed: {width}, as before")
    return InputError(f"{path}: has rows that cannot be parsed; allowed: rows of {width} items")


def _foot(data: bytes, how: TableLayout) -> tuple[int, int]:
    """Where the rows end [bytes], and how many lines below are none: a word stands where rows have a number."""
    lead = next(n for n, kind in enumerate(how.kinds) if kind != "word")
    tail = data[-LETTERS:]
    end = kept = len(data) - len(tail) + len(tail.rstrip())
    passed = 0
    for raw in reversed(tail.rstrip().split(b"\n")[-FOOT:]):
        line = raw.decode(errors="replace")
        if line.strip() and not re.match(how.comment, line):
            found = how.items(line)
            item = found[lead] if len(found) > lead else found[0]
            if kind_of(item, how.decimal) != "word" or not any(map(str.isalpha, item)):
                break
            passed, kept = passed + 1, end - len(raw)
        end -= len(raw) + 1
    return (kept, passed) if passed and kept > 0 else (len(data), 0)


# --- text of files that others have written ---


def is_text(head: bytes) -> bool:
    """Whether the first bytes of a file may be text."""
    return bool(head.strip()) and (b"\0" not in head or bool(_utf_16(head)))


SHARE = 12  # of the memory that is free, one part is for the file; the worst, "1;1;1", takes ten times itself
UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
CHINESE = re.compile(rb"(?:[\xa1-\xf7][\xa1-\xfe])+")
COMMON = re.compile(rb"[\xa1-\xa9\xb0-\xd7][\xa1-\xfe]")  # signs and the usual 3755 characters of GB 2312
ALLOWED = "text in UTF-8, UTF-16, GBK or Windows-1252"


def text_of(path: Path) -> tuple[bytes, list[str]]:
    """The text of a file in UTF-8, its lines ended by line feeds, and notes on it.

    Raises InputError for what is no text, or more than fits into memory; OSError if it cannot be read.
    """
    data, notes = contents(path, available() // SHARE), []
    wide = _utf_16(data)
    if wide:
        data = _decoded(path, data, wide).encode()
    data = data.removeprefix(codecs.BOM_UTF8)
    if b"\0" in data:
        raise InputError(f"{path}: byte {data.index(0)} is 0, which no text has; allowed: {ALLOWED}")
    try:
        data.decode()
    except UnicodeDecodeError:
        encoding, name = ("gb18030", "GBK") if _is_chinese(data) else ("cp1252", "Windows-1252")
        data = _decoded(path, data, encoding).encode()
        notes.append(f"The text is not in UTF-8; it was read as {name}.")
    if b"\r" in data:
        data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    return data, notes


def _utf_16(data: bytes) -> str:
    """The encoding of a text of two bytes a letter, by its first bytes; else nothing."""
    if data.startswith(UTF_16):
        return "utf-16"
    zeros = data[:200][0::2].count(0), data[:200][1::2].count(0)
    if max(zeros) * 4 < len(data[:200]) or min(zeros):
        return ""
    return "utf-16-be" if zeros[0] else "utf-16-le"


def _is_chinese(data: bytes) -> bool:
    """Whether all letters that are no ASCII are pairs of bytes, as in GBK, and most are usual characters."""
    rest = CHINESE.sub(b"", data)
    pairs = b"".join(CHINESE.findall(data))
    return rest.isascii() and len(COMMON.findall(pairs)) * 2 > 0.7 * len(pairs)


def _decoded(path: Path, data: bytes, encoding: str) -> str:
    try:
        return data.decode(encoding)
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: byte {error.start} is no text; allowed: {ALLOWED}") from None


def lines_of(data: bytes) -> Iterator[str]:
    """The lines of a text in UTF-8."""
    return (line.decode(errors="replace").rstrip("\n") for line in io.BytesIO(data))
