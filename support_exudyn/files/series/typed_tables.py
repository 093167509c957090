"""Series of tables whose items have types: Parquet, Feather (Arrow), JSON; and of Excel's workbooks.

Parquet and Feather have units in titles or in the metadata of the fields. JSON is a list of rows, each an
object, or an object of columns. The sheets of a workbook are as people write tables, with lines above the
titles, units and stamps, and are read as text is.
"""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from datetime import datetime, time, timedelta
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from support_exudyn.files.series.columns import Column, Table, first_names, table_series
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.stamps import DAY, Stamps, is_stamp, read_stamps
from support_exudyn.files.series.table_layout import is_time_title
from support_exudyn.files.series.text_tables import text_table
from support_exudyn.files.series.units import read_unit, split_title
from user_forces.values.value import InputError, cleaned, short

if TYPE_CHECKING:
    import pandas as pd

KINDS = {b"PAR1": "Parquet file", b"ARRO": "Feather file", b"FEA1": "Feather file"}  # by the first bytes
UNIT = (b"unit", b"units")  # keys of a field's metadata
NUMBERS = ("floating", "integer", "mixed-integer-float", "decimal", "empty")  # kinds of columns by pandas
CLOCKS = ("timedelta", "timedelta64")
DATES = ("datetime", "datetime64", "date")
CHECKED = 400  # items by which words are stamps


def read_typed_table(path: Path, asked: Asked) -> SeriesFile:
    """The series of a Parquet, Feather or JSON file: its columns of numbers; others are named in a note.

    Raises InputError if it is damaged or has no times; OSError if it cannot be read.
    """
    data = path.read_bytes()
    kind = KINDS.get(data[:4], "JSON file")
    try:
        if kind == "JSON file":
            table = _of_frame(path, kind, _json_frame(data), {})
        else:
            table = _of_arrow(path, kind, data, asked)
    except InputError:
        raise
    except Exception as error:  # of many kinds, by pandas and Arrow
        phrase = cleaned(str(error)).partition("\n")[0][:200]
        raise InputError(
            f"{path}: is no whole {kind} ({phrase}); allowed: columns of numbers, and times"
        ) from None
    return table_series(table, asked)


def _of_arrow(path: Path, kind: str, data: bytes, asked: Asked) -> Table:
    """The table of a Parquet or Feather file; of Parquet the columns that are wanted or may be times."""
    from pyarrow import BufferReader, feather, parquet, types

    if kind == "Feather file":
        table = feather.read_table(BufferReader(data))
    else:
        file = parquet.ParquetFile(BufferReader(data))
        wanted = [
            one.name
            for one in file.schema_arrow
            if asked.wants(split_title(one.name)[0])
            or is_time_title(one.name)
            or not (types.is_floating(one.type) or types.is_integer(one.type))
        ]
        table = file.read(wanted, use_threads=False)
    units = {
        one.name: text.decode("utf-8", "replace")
        for one in table.schema
        for key, text in (one.metadata or {}).items()
        if key in UNIT
    }
    return _of_frame(path, kind, table.to_pandas(ignore_metadata=True), units)


def _json_frame(data: bytes) -> pd.DataFrame:
    """The table of rows, or of columns, in JSON; it may be the only item of an object."""
    import pandas as pd

    found = json.loads(data.decode("utf-8-sig"))
    if isinstance(found, dict) and len(found) == 1:
        (inside,) = found.values()
        found = inside if isinstance(inside, list) and isinstance(inside[0], dict) else found
    if isinstance(found, dict):
        found = {key: one for key, one in found.items() if isinstance(one, (list, dict))}
    return pd.DataFrame(found)


def _of_frame(path: Path, kind: str, frame: pd.DataFrame, units: Mapping[str, str]) -> Table:
    """The columns of numbers and times of a table of pandas; the titles of others. units: by titles."""
    columns, others, notes = [], [], []
    for title, values in frame.items():
        name, unit, note = split_title(str(title))
        if (given := read_unit(units.get(str(title), "?")))[0] is not None:
            name, (unit, note) = str(title) if unit is None else name, given
        column = _column(name, unit, values)
        if column is None:
            others.append(name)
            continue
        columns.append(column)
        notes += [note[:1].upper() + note[1:] + "."] if note else []
    return Table(path, kind, columns, others, notes)


def _column(name: str, unit: str | None, values: pd.Series) -> Column | None:
    """A column of numbers, of times or of words that are stamps; None if it is none."""
    import pandas as pd

    kind = pd.api.types.infer_dtype(values, skipna=True)
    if kind in NUMBERS:
        return Column(name, unit, values.astype("float64").to_numpy(dtype=np.float64))
    if kind in (*CLOCKS, *DATES):
        moments = pd.to_timedelta(values) if kind in CLOCKS else pd.to_datetime(values, utc=True)
        since = (moments - (pd.Timedelta(0) if kind in CLOCKS else moments.min())) / pd.Timedelta("1s")
        has_clock = kind not in (*CLOCKS, "date")
        stamps = Stamps(since.to_numpy(dtype=np.float64), kind in DATES, DAY if has_clock else 0.0)
    elif kind in ("string", "time"):
        texts = values.astype("str").mask(values.isna())
        if not all(map(is_stamp, texts[:CHECKED].dropna())):
            return None
        stamps = read_stamps(texts)
        if stamps.wrong is not None:
            return None
    else:
        return None
    return Column(name, None, stamps.seconds, stamps)


# --- workbooks ---


def read_workbook(path: Path, asked: Asked) -> SeriesFile:
    """The series of a sheet of a workbook (.xlsx, .xlsm), the first with a table if none is asked for.

    Raises InputError if openpyxl is not installed, if the file is damaged, or if no sheet has a table.
    """
    import pandas as pd

    data = io.BytesIO(path.read_bytes())
    try:
        sheets = pd.read_excel(data, sheet_name=None, header=None, dtype="object", engine="openpyxl")
    except ImportError:
        raise InputError(
            f"{path}: is a workbook of Excel, which openpyxl reads, and that is not installed; allowed: "
            "pip install 'support-exudyn[files]', or the sheet saved as CSV"
        ) from None
    except Exception as error:  # of many kinds, by the archive, its XML and openpyxl
        phrase = " ".join(cleaned(str(error)).split())[:200]
        raise InputError(f"{path}: is no workbook that can be read ({phrase}); allowed: .xlsx") from None
    if asked.sheet is not None and asked.sheet not in sheets:
        raise InputError(f"{path}: has no sheet {short(asked.sheet)}; allowed: {first_names(sheets)}")
    refused = ""
    for name in sheets if asked.sheet is None else [asked.sheet]:
        try:
            found = table_series(_of_sheet(path, sheets[name]), asked)
        except InputError as error:
            refused = refused or str(error)
            continue
        others = [one for one in sheets if one != name]
        note = f"Of {len(sheets)} sheets {name!r} is read; others are {first_names(others)}." if others else ""
        return SeriesFile(path, "workbook", found.series, (*filter(None, [note]), *found.notes))
    if len(sheets) == 1 or asked.sheet is not None:
        raise InputError(refused)
    raise InputError(
        f"{path}: no sheet has a table of numbers over time; allowed: one of {first_names(sheets)} with it"
    )


def _of_sheet(path: Path, sheet: pd.DataFrame) -> Table:
    """The table of a sheet. Raises InputError that names the row of what is no number."""
    filled = sheet.notna().any()
    sheet = sheet.loc[:, filled.idxmax() : filled[::-1].idxmax()] if filled.any() else sheet
    lines = ["\t".join(map(_cell, row)) for row in sheet.itertuples(index=False)]
    return text_table(path, [line if line.strip() else "" for line in lines], separators=("\t",), what="row")


def _cell(value: Any) -> str:
    """A cell as text, with one meaning."""
    if isinstance(value, timedelta):
        minutes, seconds = divmod(value.total_seconds(), 60.0)
        return f"{minutes // 60:.0f}:{minutes % 60:02.0f}:{seconds:09.6f}"
    if isinstance(value, (datetime, time)):
        return value.isoformat()
    if value is None or value != value:  # missing
        return ""
    return repr(value) if isinstance(value, (int, float)) else " ".join(str(value).replace('"', "").split())
