"""Series from tables of text: CSV, and items that tabs, semicolons or blanks separate.

What separates items, whether decimals have a comma and where titles stand is determined from the file, see
`table_layout`. pandas parses the numbers.
"""

from __future__ import annotations

import codecs
import io
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from support_exudyn.files.series.columns import Column, Numbers, Table, table_series
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.stamps import read_stamps
from support_exudyn.files.series.table_layout import (
    BLANKS,
    MISSING,
    NUMBERS,
    SEPARATORS,
    SIGNS,
    TableLayout,
    items,
    kind_of,
    layout,
)
from user_forces.values.value import InputError, short

if TYPE_CHECKING:
    import pandas as pd

NULLS = sorted({one for word in MISSING for one in (word, word.upper(), word.capitalize(), "NaN", "N/a")})
HEAD = 60  # lines that may have titles
FOOT = 60  # lines that may stand below the rows
UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
CHINESE = re.compile(rb"(?:[\xa1-\xf7][\xa1-\xfe])+")
COMMON = re.compile(rb"[\xa1-\xa9\xb0-\xd7][\xa1-\xfe]")  # signs and the usual 3755 characters of GB 2312
ALLOWED = "text in UTF-8, UTF-16, GBK or Windows-1252"


def read_text_table(path: Path, asked: Asked) -> SeriesFile:
    """The series of a table: every column of numbers but those of times, see `table_series`.

    Raises InputError for what is no table, or can be read in two ways, with line and column; OSError if it
    cannot be read.
    """
    lines, notes = lines_of(path)
    asked.progress(0.2)
    found = table_series(text_table(path, lines, notes), asked)
    asked.progress(1.0)
    return found


def text_table(
    path: Path,
    lines: list[str],
    notes: Sequence[str] = (),
    separators: Sequence[str] = SEPARATORS,
    what: str = "line",
) -> Table:
    """The columns of a text; its lines are called by the word `what`. Raises as `read_text_table`."""
    _join_titles(lines)
    how = layout(path, lines, separators)
    end = _end(lines, how)
    passed = sum(bool(line.strip()) and not how.comment.match(line) for line in lines[end:])
    below = [f"{passed} {'line' if passed == 1 else 'lines'} below the rows passed over."] if passed else []
    columns, place = columns_of(path, lines[:end], how, what)
    columns = [
        one
        for one in columns
        if one.stamps is not None or not (one.name.startswith("column_") and np.isnan(one.values).all())
    ]
    others = [name for (name, _), kind in zip(how.titles, how.kinds, strict=True) if kind == "word"]
    return Table(path, "table of text", columns, others, [*notes, *how.notes, *below], how.intervals, place)


def _join_titles(lines: list[str]) -> None:
    """Join titles in quotes that stand on several lines each; empty lines keep the numbering."""
    odd = [n for n, line in enumerate(lines[:HEAD]) if line.count('"') % 2]
    for start, end in zip(odd[::2], odd[1::2], strict=False):
        lines[start : end + 1] = [" ".join(lines[start : end + 1]), *[""] * (end - start)]


def _end(lines: Sequence[str], how: TableLayout) -> int:
    """The index of the line after the rows: in the lines below, a word stands where rows have a number."""
    lead = next(n for n, kind in enumerate(how.kinds) if kind != "word")
    end = len(lines)
    for n in range(len(lines) - 1, max(how.first, len(lines) - FOOT), -1):
        if lines[n].strip() and not how.comment.match(lines[n]):
            found = items(lines[n], how.separator)
            item = found[lead] if len(found) > lead else found[0]
            if kind_of(item, how.decimal) != "word" or not any(map(str.isalpha, item)):
                break
            end = n
    return end


# --- rows ---


def columns_of(
    path: Path, lines: Sequence[str], how: TableLayout, what: str = "line"
) -> tuple[list[Column], Callable[[int], str]]:
    """The columns of numbers and stamps of lines that are written so, and where each row stands.

    Raises InputError that names the line, by the word `what`, and the column of what is no number.
    """
    is_comment = how.comment.match
    below = enumerate(lines[how.first :], how.first + 1)
    rows = [(n, line) for n, line in below if line.strip() and not is_comment(line)]
    width = len(how.kinds)
    for n, line in rows:
        plain = how.separator != BLANKS and '"' not in line
        count = line.count(how.separator) + 1 if plain else len(items(line, how.separator))
        if count != width and width > 1:
            raise InputError(f"{path}: {what} {n}: has {count} items; allowed: {width}, as before")

    def place(row: int) -> str:
        return f"{what} {rows[row][0]}"

    try:
        frame = _parsed([line for _, line in rows], how)
    except ValueError:  # of pandas
        frame = None
    if frame is None or len(frame) != len(rows):
        raise InputError(f"{path}: has quotes that are not closed; allowed: rows of a line each")
    found = []
    for n, ((name, unit), kind) in enumerate(zip(how.titles, how.kinds, strict=True)):
        if kind == "stamp":
            stamps = read_stamps(_texts(frame[n]))
            found.append(Column(name, unit, stamps.seconds, stamps))
        elif kind == "number":
            numbers, wrong = _numbers(frame[n], how.decimal)
            if wrong is not None:
                raise InputError(
                    f"{path}: {place(wrong)}, column {short(name)}: {short(str(frame[n][wrong]).strip())}; "
                    f"allowed: a number such as 12{how.decimal}5, or nothing"
                )
            found.append(Column(name, unit, numbers))
    return found, place


def _parsed(rows: Sequence[str], how: TableLayout) -> pd.DataFrame:
    """Rows as pandas parses them: columns of numbers, or of texts where an item is none; none of words."""
    import pandas as pd

    exact: dict[str, Any] = {"float_precision": "round_trip"} if pd.__version__ < "3" else {}
    used = [n for n, kind in enumerate(how.kinds) if kind != "word"]
    return pd.read_csv(
        io.StringIO("\n".join(rows)),
        sep=r"\s+" if how.separator == BLANKS else how.separator,
        decimal=how.decimal,
        header=None,
        names=[*range(len(how.kinds))],
        index_col=False,
        usecols=used,
        dtype={n: "str" for n in used if how.kinds[n] == "stamp"},
        na_values=NULLS,
        keep_default_na=False,
        skipinitialspace=True,
        low_memory=False,
        **exact,
    )


def _texts(column: pd.Series) -> pd.Series:
    """Texts without blanks around them, missing where there is nothing."""
    text = column.astype("str").str.strip()
    return text.mask(column.isna() | text.str.lower().isin(MISSING))


def _numbers(column: pd.Series, decimal: str) -> tuple[Numbers, int | None]:
    """The numbers of a column (n,), NaN where there is nothing; and the index of the first that is none."""
    if column.dtype.kind in "iuf":
        return column.to_numpy(dtype=np.float64), None
    text = _texts(column)
    known = text.str.fullmatch(NUMBERS[decimal], na=True)
    if not known.all():
        return np.empty(0), int(np.argmin(known))
    plain = text.str.replace(f"[{',' if decimal == '.' else '.'}{SIGNS}]", "", regex=True).str.lower()
    plain = plain.str.replace(",", ".", regex=False).str.replace("d", "e", regex=False)
    return plain.astype("object").to_numpy(dtype=np.float64, na_value=np.nan), None


# --- text of files that others have written ---


def lines_of(path: Path) -> tuple[list[str], list[str]]:
    """The lines of a text, and notes on it.

    Raises InputError for what is no text; OSError if it cannot be read.
    """
    data, notes = path.read_bytes(), []
    encoding = "utf-16" if data.startswith(UTF_16) else "utf-8-sig"
    if encoding != "utf-16" and b"\0" in data:
        raise InputError(f"{path}: byte {data.index(0)} is 0, which no text has; allowed: {ALLOWED}")
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError:
        encoding, name = ("gb18030", "GBK") if _is_chinese(data) else ("cp1252", "Windows-1252")
        try:
            text = data.decode(encoding)
        except UnicodeDecodeError as error:
            raise InputError(f"{path}: byte {error.start} is no text; allowed: {ALLOWED}") from None
        notes.append(f"The text is not in UTF-8; it was read as {name}.")
    return re.split(r"\r\n|\r", text) if "\n" not in text else text.replace("\r\n", "\n").split("\n"), notes


def _is_chinese(data: bytes) -> bool:
    """Whether all letters that are no ASCII are pairs of bytes, as in GBK, and most are usual characters."""
    rest = CHINESE.sub(b"", data)
    pairs = b"".join(CHINESE.findall(data))
    return rest.isascii() and len(COMMON.findall(pairs)) * 2 > 0.7 * len(pairs)
