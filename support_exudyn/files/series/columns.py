"""Series from columns of numbers: times in seconds that increase, and what is told of how they came so."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from support_exudyn.files.series.named_series import Asked, NamedSeries, SeriesFile
from support_exudyn.files.series.units import as_pint_writes, is_time, scaled, unit_checked
from user_forces.values.value import InputError, cleaned, short

Numbers = npt.NDArray[np.float64]
MANY = 5  # names that are told


@dataclass(frozen=True)
class Column:
    """A column of a table: its name, unit (None: the table gives none) and values (n,)."""

    name: str
    unit: str | None
    values: Numbers


def is_named_time(name: str) -> bool:
    """Whether a name is one of times, such as time, T or .MODEL_1.Last_Run.TIME."""
    return name.casefold() in ("time", "t") or name.casefold().rpartition(".")[2] == "time"


def named_times(names: Sequence[tuple[str, str | None]]) -> list[int]:
    """Which of names, each with its unit (None: it has none), are called as times are.

    `time` in any letters goes before `t`, and that before `T`, which a temperature is called, too.
    """
    named = [n for n, (name, _) in enumerate(names) if name.casefold() == "time"]
    brief = [
        n for n, (name, unit) in enumerate(names) if name.casefold() == "t" and (unit is None or is_time(unit))
    ]
    return named or [n for n in brief if names[n][0] == "t"] or brief


def places_of_times(columns: Sequence[Column], asked: Asked) -> tuple[list[int], list[str]]:
    """Which columns are times, and what is told of it.

    Those that are named so; else the first if its name ends so; else the only one that is in a unit of time.
    """
    if named := named_times([(one.name, one.unit) for one in columns]):
        return named, []
    if columns and is_named_time(columns[0].name):
        return [0], []
    units = [asked.unit(one.name, one.unit) for one in columns]
    found = [n for n, unit in enumerate(units) if unit is not None and is_time(unit)]
    if len(found) != 1:
        return [], []
    return found, [f"Column {columns[found[0]].name!r} is taken for the times: it alone is in a unit of time."]


def series_file(
    path: Path,
    kind: str,
    groups: Iterable[tuple[Column, Iterable[Column]]],
    asked: Asked,
    notes: Iterable[str] = (),
) -> SeriesFile:
    """Series from columns over their times.

    Rows without a time are left out. Infinite values count as not known. Rows are sorted by time; of rows of
    one time the last of the file stays. All that is told in a note.

    Arguments:
        path, kind, notes: of the file.
        groups: a column of times each, with the columns that have a value at each of them.
        asked: units of columns without one, and the names that are wanted.

    Raises InputError if there are no times, if they have no unit of time, or if two columns have one name.
    """
    series: dict[str, NamedSeries] = {}
    told = [*notes]
    for times, columns in groups:
        time, order, said = _increasing(path, times, asked)
        told += [one for one in said if one not in told]
        for column in columns:
            if not asked.wants(column.name):
                continue
            if column.name in series:
                raise InputError(
                    f"{path}: column {short(column.name)}: stands twice; allowed: a title for each column"
                )
            values = column.values if order is None else column.values[order]
            if endless := int(np.isinf(values).sum()):
                values = np.where(np.isinf(values), np.nan, values)
                told.append(f"{column.name}: infinite values count as not known: {endless}.")
            series[column.name] = NamedSeries(column.name, _unit(path, column, asked), time, values)
    if not series:
        raise InputError(" ".join(cleaned(one) for one in (f"{path}: {_nothing(asked)}.", *told))[:-1])
    return SeriesFile(path, kind, series, tuple(cleaned(one) for one in told))


def _nothing(asked: Asked) -> str:
    if asked.names:
        return f"has no series {', '.join(map(short, asked.names[:MANY]))}; allowed: its own names"
    return "has times and nothing else; allowed: a column of numbers beside them"


def _unit(path: Path, column: Column, asked: Asked) -> str | None:
    unit = asked.unit(column.name, column.unit)
    if unit is None or unit == column.unit:
        return unit
    return as_pint_writes(unit_checked(unit, f"units, {column.name} of {path}"))


def _increasing(
    path: Path, column: Column, asked: Asked
) -> tuple[Numbers, npt.NDArray[np.intp] | None, list[str]]:
    """Times [s] that increase, the rows that they are of (None: all as they are), and what is told of it."""
    unit = _unit(path, column, asked)
    where = f"{path}: times, column {short(column.name)}"
    if unit is None:
        raise InputError(
            f"{where}: have no unit; allowed: one in the title, such as time_s or 'time [ms]', or in "
            f'compare.toml, [files."{path.name}".units] "{column.name}" = "s"'
        )
    if not is_time(unit):
        raise InputError(f"{where}: are in {short(unit)}; allowed: a unit of time, such as s, ms, min")
    time = scaled(column.values, unit, "s", where)
    if np.isinf(time).any():
        raise InputError(f"{where}: row {int(np.argmax(np.isinf(time))) + 1} is infinite; allowed: numbers")
    there = np.isfinite(time)
    if not there.any():
        raise InputError(f"{where}: has no numbers; allowed: one or more")
    if there.all() and (np.diff(time) > 0.0).all():
        return time, None, []
    told = []
    if missing := int((~there).sum()):
        told.append(f"Rows without a time are left out: {missing}.")
    order = np.flatnonzero(there)
    if (np.diff(time[order]) < 0.0).any():
        told.append(f"The times of column {column.name!r} go back; rows are sorted by time.")
        order = order[np.argsort(time[order], kind="stable")]
    last = np.append(np.diff(time[order]) > 0.0, True)
    if repeated := int((~last).sum()):
        told.append(f"Times are repeated; of rows of one time the last stays, {repeated} are left out.")
    order = order[last]
    return time[order], order, told
