"""Series of tables whose items have types: Parquet, Feather (Arrow), JSON; and of Excel's workbooks.

Parquet and Feather have units in titles or in the metadata of the fields. JSON is a list of rows, each an
object, or an object of columns. The sheets of a workbook are as people write tables, with lines above the
titles, units and stamps, and are read as text is.
"""

from __future__ import annotations

import io
import json
from datetime import datetime, time, timedelta
from pathlib import Path
from typing import Any

import numpy as np

from support_exudyn.files.free_memory import available
from support_exudyn.files.series.columns import Column, Table, first_names, is_named_time, table_series
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.stamps import DAY, Stamps, is_stamp, read_stamps
from support_exudyn.files.series.text_tables import text_table
from support_exudyn.files.series.units import is_called_time, is_time, read_unit, split_title
from support_exudyn.files.whole_file import contents
from user_forces.values.value import InputError, cleaned, short

PARQUET, FEATHER, OLD_FEATHER = b"PAR1", b"ARROW1", b"FEA1"
UNIT = (b"unit", b"units")  # keys of a field's metadata
MOST = 100_000  # columns
DAMAGES = (
    OSError,
    ValueError,
    LookupError,
    TypeError,
    MemoryError,
    OverflowError,
    AttributeError,
    RecursionError,
)


def is_parquet(head: bytes) -> bool:
    """Whether a file begins as Parquet does."""
    return head.startswith(PARQUET)


def is_feather(head: bytes) -> bool:
    """Whether a file begins as Feather does, which is a file of Arrow."""
    return head.startswith((FEATHER, OLD_FEATHER))


def is_json(head: bytes) -> bool:
    """Whether a file begins as a list of objects or an object of JSON does."""
    text = head.removeprefix(b"\xef\xbb\xbf").lstrip()
    return text[:1] == b"{" or (text[:1] == b"[" and text[1:].lstrip()[:1] in (b"{", b"["))


def read_parquet(path: Path, asked: Asked) -> SeriesFile:
    """The series of a Parquet file: its columns of numbers and its times; others are named in a note.

    Raises InputError if it is damaged, has no times or more than fits into memory; OSError if it cannot be
    read.
    """
    from pyarrow import BufferReader, parquet

    def read(data: bytes) -> Table:
        file = parquet.ParquetFile(BufferReader(data))
        rows, count = file.metadata.num_rows, file.metadata.num_columns
        if count > MOST or rows < 0 or 24 * rows * (len(asked.names) or count) > available():
            raise InputError(f"{path}: has {rows} rows of {count} columns; allowed: as many as fit into memory")
        wanted = [one for one in file.schema_arrow if _is_wanted(one, asked)]
        table = file.read([one.name for one in wanted], use_threads=False)
        return _of_arrow(path, "Parquet file", table.select([one.name for one in wanted]))

    return _series(path, "Parquet file", read, asked)


def read_feather(path: Path, asked: Asked) -> SeriesFile:
    """The series of a Feather file. Raises as `read_parquet` does."""
    from pyarrow import BufferReader, feather

    kind = "Feather file"
    return _series(
        path, kind, lambda data: _of_arrow(path, kind, feather.read_table(BufferReader(data))), asked
    )


def read_json(path: Path, asked: Asked) -> SeriesFile:
    """The series of rows or columns in JSON. Raises as `read_parquet` does."""
    import pyarrow as pa

    def read(data: bytes) -> Table:
        found = json.loads(data.decode("utf-8-sig"))
        if (
            isinstance(found, dict)
            and len(found) == 1
            and isinstance(inside := next(iter(found.values())), list)
        ):
            found = inside if inside and isinstance(inside[0], dict) else found
        if isinstance(found, list):
            table = pa.Table.from_pylist(found)
        else:
            lists = {key: list(one.values()) if isinstance(one, dict) else one for key, one in found.items()}
            table = pa.table({key: one for key, one in lists.items() if isinstance(one, list)})
        return _of_arrow(path, "JSON file", table)

    return _series(path, "JSON file", read, asked)


def _series(path: Path, kind: str, read: Any, asked: Asked) -> SeriesFile:
    """The series of a file's bytes as a function reads them; what is damaged is refused in a sentence."""
    import pyarrow as pa

    data = contents(path, available() // 4)
    try:
        table = read(data)
    except InputError:
        raise
    except (pa.ArrowException, *DAMAGES) as error:
        phrase = cleaned(str(error)).partition("\n")[0][:200]
        raise InputError(
            f"{path}: is no whole {kind} ({phrase}); allowed: columns of numbers, and times"
        ) from None
    return table_series(table, asked)


def _is_wanted(field: Any, asked: Asked) -> bool:
    """Whether a column is wanted, or may be the times."""
    name, unit, _ = split_title(field.name)
    may_be_time = is_named_time(name) or is_called_time(name) or (unit is not None and is_time(unit))
    return asked.wants(name) or asked.wants(field.name) or may_be_time or not _is_number(field.type)


def _is_number(kind: Any) -> bool:
    import pyarrow as pa

    return bool(pa.types.is_floating(kind) or pa.types.is_integer(kind) or pa.types.is_decimal(kind))


def _of_arrow(path: Path, kind: str, table: Any) -> Table:
    """The columns of numbers and times of a table of Arrow; the titles of others."""
    import pyarrow as pa

    columns, others, notes = [], [], []
    for field, values in zip(table.schema, table.columns, strict=True):
        name, unit, note = split_title(field.name)
        metadata = field.metadata or {}
        phrase = next((metadata[key].decode("utf-8", "replace") for key in UNIT if key in metadata), "")
        if phrase and (known := read_unit(phrase)[0]) is not None:
            name, unit, note = field.name if unit is None else name, known, read_unit(phrase)[1]
        if _is_number(field.type) or pa.types.is_null(field.type):
            numbers = values.cast(pa.float64(), safe=False)
            columns.append(Column(name, unit, np.asarray(numbers.to_numpy(), dtype=np.float64)))
        elif (stamps := _stamps(name, field.type, values)) is not None:
            columns.append(Column(name, None, stamps.seconds, stamps))
        else:
            others.append(name)
            continue
        notes += [note[:1].upper() + note[1:] + "."] if note else []
    return Table(path, kind, columns, others, notes)


def _stamps(name: str, kind: Any, values: Any) -> Stamps | None:
    """The stamps of a column of times or of words that are stamps; None if they are none."""
    import pyarrow as pa

    if pa.types.is_string(kind) or pa.types.is_large_string(kind):
        texts = values.cast(pa.string()).combine_chunks()
        words = texts[:LOOKED_AT].drop_null().to_pylist()
        stamps = read_stamps(name, texts) if words and all(map(is_stamp, words)) else None
        return stamps if stamps is not None and stamps.wrong is None else None
    if pa.types.is_duration(kind) or pa.types.is_time(kind):
        ticks = values.cast(pa.int64() if kind != pa.time32("s") and kind != pa.time32("ms") else pa.int32())
        per_second = {"s": 1e0, "ms": 1e3, "us": 1e6, "ns": 1e9}[kind.unit]
        seconds = np.asarray(ticks.to_numpy(), dtype=np.float64) / per_second
        return Stamps(seconds, False, DAY if pa.types.is_time(kind) else 1e99, "", None)
    if not (pa.types.is_timestamp(kind) or pa.types.is_date(kind)):
        return None
    moments = values.cast(pa.timestamp("ns")).to_numpy().astype("M8[ns]")
    there = moments[~np.isnat(moments)]
    since = (moments - (there[0] if there.size else 0)) / np.timedelta64(1, "s")
    return Stamps(since, True, DAY if pa.types.is_timestamp(kind) else 0.0, "", None)


LOOKED_AT = 400  # items by which words are stamps


# --- workbooks ---


def is_workbook(head: bytes) -> bool:
    """Whether a file may be a workbook: an archive whose first files are of Office's."""
    return head.startswith(b"PK\x03\x04") and any(
        one in head for one in (b"[Content_Types]", b"xl/", b"docProps/")
    )


def read_workbook(path: Path, asked: Asked) -> SeriesFile:
    """The series of a sheet of a workbook (.xlsx, .xlsm), the first with a table if none is asked for.

    Raises InputError if openpyxl is not installed, if the file is damaged, or if no sheet has a table.
    """
    try:
        import openpyxl
    except ImportError:
        raise InputError(
            f"{path}: is a workbook of Excel, which openpyxl reads, and that is not installed; allowed: "
            "pip install 'support-exudyn[files]', or the sheet saved as CSV"
        ) from None
    try:
        book = openpyxl.load_workbook(
            io.BytesIO(contents(path, available() // 12)), read_only=True, data_only=True
        )
        sheets = {one.title: one for one in book.worksheets}
    except Exception as error:  # of many kinds, by the archive, its XML and openpyxl
        phrase = " ".join(cleaned(str(error)).split())[:200]
        raise InputError(f"{path}: is no workbook that can be read ({phrase}); allowed: .xlsx") from None
    if asked.sheet is not None and asked.sheet not in sheets:
        raise InputError(f"{path}: has no sheet {short(asked.sheet)}; allowed: {first_names(sheets)}")
    refused: list[InputError] = []
    for name in sheets if asked.sheet is None else [asked.sheet]:
        try:
            found = table_series(_of_sheet(path, sheets[name]), asked)
        except InputError as error:
            refused.append(error)
            continue
        others = [one for one in sheets if one != name]
        note = f"Of {len(sheets)} sheets {name!r} is read; others are {first_names(others)}." if others else ""
        return SeriesFile(path, "workbook", found.series, (*filter(None, [note]), *found.notes))
    phrase = (
        str(refused[0]).removeprefix(f"{path}: ")
        if len(refused) == 1
        else "no sheet has a table of numbers over time"
    )
    raise InputError(
        f"{path}: {phrase}"
        + ("" if "allowed" in phrase else f"; allowed: one of {first_names(sheets)} with it")
    )


def _of_sheet(path: Path, sheet: Any) -> Table:
    """The table of a sheet. Raises InputError that names the row of what is no number."""
    try:
        lines = ["\t".join(map(_cell, row)) for row in sheet.iter_rows(values_only=True)]
    except Exception as error:  # of many kinds, by the archive and its XML
        phrase = " ".join(cleaned(str(error)).split())[:200]
        raise InputError(
            f"{path}: sheet {sheet.title!r} cannot be read ({phrase}); allowed: a whole one"
        ) from None
    width = max((len(line.rstrip("\t").split("\t")) for line in lines), default=1)
    empty = min((len(line) - len(line.lstrip("\t")) for line in lines if line.strip("\t")), default=0)
    lines = ["\t".join(line.split("\t")[empty:width]) if line.strip("\t") else "" for line in lines]
    return text_table(path, "\n".join(lines).encode(), separators=("\t",), what="row")


def _cell(value: Any) -> str:
    """A cell as text, with one meaning."""
    if value is None or isinstance(value, bool):
        return "" if value is None else str(value)
    if isinstance(value, timedelta):
        minutes, seconds = divmod(value.total_seconds(), 60.0)
        return f"{int(minutes // 60)}:{int(minutes % 60):02d}:{seconds:09.6f}"
    if isinstance(value, (datetime, time)):
        return value.isoformat(*[" "] * isinstance(value, datetime))
    if isinstance(value, (int, float)):
        return repr(value)
    return " ".join(str(value).replace('"', "").split())
