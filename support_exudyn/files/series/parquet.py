"""Series of Parquet files: columns of numbers, units in their titles or in the metadata of the fields."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from support_exudyn.files.free_memory import available
from support_exudyn.files.series.columns import Column, is_named_time, places_of_times, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.units import as_pint_writes, is_time, is_unit, split_title
from support_exudyn.files.whole_file import contents
from user_forces.values.value import InputError, cleaned, short

MAGIC = b"PAR1"
UNIT = (b"unit", b"units")  # keys of a field's metadata
MOST = 100_000  # columns
DAMAGES = (OSError, ValueError, LookupError, TypeError, MemoryError, OverflowError)


def is_parquet(head: bytes) -> bool:
    """Whether a file begins as Parquet does."""
    return head.startswith(MAGIC)


def read_parquet(path: Path, asked: Asked) -> SeriesFile:
    """The series of a Parquet file: its columns of numbers; others are told.

    Raises InputError if it is damaged, has no times or more than fits into memory; OSError if it cannot be
    read.
    """
    import pyarrow as pa
    from pyarrow import parquet

    data = contents(path, available() // 4)
    try:
        file = parquet.ParquetFile(pa.BufferReader(data))
        rows, count = file.metadata.num_rows, file.metadata.num_columns
        if count > MOST or rows < 0 or 24 * rows * (len(asked.names) or count) > available():
            raise InputError(f"{path}: has {rows} rows of {count} columns; allowed: as many as fit into memory")
        columns, others = _columns(file, asked)
    except InputError:
        raise
    except (pa.ArrowException, *DAMAGES) as error:
        said = cleaned(str(error)).partition("\n")[0][:200]
        raise InputError(f"{path}: is no whole Parquet file ({said}); allowed: columns of numbers") from None
    times, told = places_of_times(columns, asked)
    if len(times) != 1:
        known = ", ".join(short(one.name) for one in columns[:6])
        raise InputError(
            f"{path}: has {len(times)} columns of times; allowed: one, time_s or 'time [s]'; it has {known}"
        )
    notes = [f"Columns that are no numbers are left out: {', '.join(others[:6])}."] if others else []
    (place,) = times
    values = columns[:place] + columns[place + 1 :]
    return series_file(path, "Parquet file", [(columns[place], values)], asked, [*notes, *told])


def _columns(file: Any, asked: Asked) -> tuple[list[Column], list[str]]:
    """The columns of numbers that are wanted, with those of times, and the titles of what is no number."""
    import pyarrow as pa

    found, others = [], []
    for field in file.schema_arrow:
        kind = field.type
        if not (pa.types.is_floating(kind) or pa.types.is_integer(kind)):
            others.append(short(field.name))
            continue
        name, unit, _ = split_title(field.name)
        metadata = field.metadata or {}
        said = next((metadata[key].decode("utf-8", "replace") for key in UNIT if key in metadata), "")
        if said and is_unit(said):
            name, unit = field.name if unit is None else name, as_pint_writes(said)
        if not (asked.wants(name) or is_named_time(name) or (unit is not None and is_time(unit))):
            continue
        values = file.read([field.name], use_threads=False).column(0).cast(pa.float64(), safe=False)
        found.append(Column(name, unit, np.asarray(values.to_numpy(), dtype=np.float64)))
    return found, others
