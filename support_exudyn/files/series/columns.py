"""Series from columns of numbers: times in seconds that increase, and notes on how they came so."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

from support_exudyn.files.series.named_series import Asked, NamedSeries, SeriesFile
from support_exudyn.files.series.stamps import DAY, Stamps
from support_exudyn.files.series.units import is_called_time, is_time, read_unit, scaled, unit_checked
from user_forces.values.value import InputError, cleaned, short

Numbers = npt.NDArray[np.float64]
MANY = 5  # names that are shown
SERIAL_DAYS, MATLAB_DAYS = (20_000.0, 80_000.0), (700_000.0, 800_000.0)  # years 1954 to 2119, 1916 to 2190
EPOCH = (9e8, 4e9)  # [s] since 1970: years 1998 to 2096
EPOCHS = {"s": 1.0, "ms": 1e3, "us": 1e6, "ns": 1e9}  # ticks in a second
DATED = ("date", "datum", "fecha", "日期", "时间", "timestamp", "time stamp")  # in names of serial days


@dataclass(frozen=True)
class Column:
    """A column of a table: its name, unit (None: the table gives none) and values (n,); or stamps of times."""

    name: str
    unit: str | None
    values: Numbers
    stamps: Stamps | None = None


Group = tuple[Column, Sequence[Column]]  # times, and what is over them


@dataclass(frozen=True)
class Table:
    """Columns as they stand in a file, whose times have not been determined.

    path, kind: of the file. columns: of numbers and stamps. others: names of columns of words.
    notes: on how it was read. intervals: between rows [s] that the file's header gives, by its lines.
    place: where a row stands, as "line 7".
    """

    path: Path
    kind: str
    columns: Sequence[Column]
    others: Sequence[str] = ()
    notes: Sequence[str] = ()
    intervals: Mapping[str, float] = field(default_factory=dict)
    place: Callable[[int], str] = lambda row: f"row {row + 1}"


def first_names(names: Iterable[str]) -> str:
    """The first of some names, quoted."""
    return ", ".join(map(short, [*names][:MANY]))


# --- which columns are times ---


def named_times(names: Sequence[tuple[str, str | None]]) -> list[int]:
    """Which of names, each with its unit (None: it has none), are called as times are.

    `time` in any letters goes before `t`, and that before `T`, which a temperature is called, too.
    """
    small = [name.casefold() for name, _ in names]
    named = [n for n, name in enumerate(small) if name == "time"]
    named = named or [n for n, name in enumerate(small[:1]) if name.endswith(".time")]
    brief = [n for n, (_, unit) in enumerate(names) if small[n] == "t" and (unit is None or is_time(unit))]
    return named or [n for n in brief if names[n][0] == "t"] or brief


def table_series(table: Table, asked: Asked) -> SeriesFile:
    """The series of a table over its times.

    Times are columns of that name; else date-time stamps; else the only column in a unit of time; else days or
    seconds of a calendar; else the rate that is asked for or that the header gives. Of several columns of times
    each is of the columns to its right, up to the next.

    Raises InputError if there are no times or they can be read in two ways.
    """
    numbers = [one for one in table.columns if one.stamps is None]
    units = [asked.unit(one.name, one.unit) for one in numbers]
    named = named_times([(one.name, unit) for one, unit in zip(numbers, units, strict=True)])
    in_time = [n for n, unit in enumerate(units) if unit is not None and is_time(unit)]
    is_known = bool(named) and units[named[0]] is not None
    is_known = is_known or (len(in_time) == 1 and is_called_time(numbers[in_time[0]].name))
    rated = None if is_known else _of_rate(table, numbers, asked.rate)
    stamped = None if is_known else _of_stamps(table) or (None if in_time else _of_calendar(numbers, units))
    repeats = np.diff(stamped[0].values) == 0.0 if stamped else np.zeros(0, dtype=bool)
    if stamped and repeats.sum() * 2 > repeats.size:
        if rated is None:
            raise InputError(
                f"{table.path}: {table.place(int(np.argmax(repeats)) + 1)}, column {short(stamped[0].name)}: "
                "at least every other row repeats the time before it; allowed: stamps with fractions of a "
                "second, or a rate, such as --rate 10 [Hz]"
            )
        stamped = None
    note, made = "", stamped or rated
    if named and (is_known or made is None):
        groups = _groups(numbers, named)
        note = f"{len(named)} columns of times; each is of the columns to its right, up to the next."
        note = note if len(named) > 1 else ""
    elif len(in_time) == 1 and stamped is None:
        groups = _groups(numbers, in_time)
        note = f"Column {numbers[in_time[0]].name!r} is taken for the times: it alone is in a unit of time."
    elif made:
        times, note = made
        groups = [(times, [one for one in numbers if one.name != times.name])]
    elif len(numbers) > 1 and numbers[0].name == "column_1":
        groups = _groups(numbers, [0])
    else:
        others = f", its words {first_names(table.others)}" if table.others else ""
        raise InputError(
            f"{table.path}: has no times; allowed: a column time_s, time_ms or 'time [s]' of numbers, stamps "
            "such as 2023-05-04 06:00, or a rate in the header or by --rate 1000 [Hz]; its numbers are "
            f"{first_names(one.name for one in numbers)}{others}"
        )
    notes, used = [*table.notes, note], groups[0][0]
    if left := [
        *table.others,
        *(one.name for one in table.columns if one.stamps and one.name not in used.name),
    ]:
        notes.append(f"Columns that are no numbers are left out: {first_names(left)}.")
    if asked.rate and used is not (rated and rated[0]):
        notes.append(f"The rate of {asked.rate:g} Hz is not used: column {used.name!r} has the times.")
    return series_file(table.path, table.kind, groups, asked, notes, table.place)


def _groups(columns: Sequence[Column], times: Sequence[int]) -> list[Group]:
    """Columns of times, each with those to its right up to the next; the first also with those before it."""
    starts, ends = [0, *times[1:]], [*times[1:], len(columns)]
    return [
        (columns[time], [columns[n] for n in range(start, end) if n != time])
        for time, start, end in zip(times, starts, ends, strict=True)
    ]


def _of_stamps(table: Table) -> tuple[Column, str] | None:
    """Times [s] from the first of a table's stamps, and a note; None if it has none that change.

    A column of dates with clocks goes before a pair, a date and a clock, and that before clocks alone, which
    may run over midnight, and dates alone.
    """
    found = [(one.name, one.stamps) for one in table.columns if one.stamps is not None]
    whole = [one for one in found if one[1].has_date and one[1].period]
    dates = [one for one in found if one[1].has_date and not one[1].period]
    clocks = [one for one in found if not one[1].has_date]
    used = whole[:1] or [*dates[:1], *clocks[:1]]
    for name, stamps in used:
        if stamps.wrong is not None:
            row, item, allowed = stamps.wrong
            raise InputError(
                f"{table.path}: {table.place(row)}, column {short(name)}: {short(item)}; allowed: {allowed}"
            )
    name, note = " ".join(one for one, _ in used), ""
    seconds: Numbers = np.sum([stamps.seconds for _, stamps in used], axis=0)
    there = np.flatnonzero(np.isfinite(seconds))
    if not used or not there.size or (not whole and not clocks and np.ptp(seconds[there]) == 0.0):
        return None
    if not whole and not dates:
        period = clocks[0][1].period
        turns = np.cumsum(np.diff(seconds[there], prepend=seconds[there[:1]]) < -0.5 * period)
        seconds[there] += period * turns
        note = f" Column {name!r} runs over midnight." if period == DAY and turns[-1:].any() else ""
    return Column(name, "s", _from_first(seconds)), f"Times are counted from the first stamp of {name!r}.{note}"


def _from_first(seconds: Numbers) -> Numbers:
    there = np.flatnonzero(np.isfinite(seconds))
    return seconds - seconds[there[0]] if there.size else seconds


def _of_calendar(columns: Sequence[Column], units: Sequence[str | None]) -> tuple[Column, str] | None:
    """Times [s] from the first of a column without unit that has days or seconds of a calendar, and a note."""
    for column, unit in zip(columns, units, strict=True):
        there = column.values[np.isfinite(column.values)]
        is_dated = any(word in column.name.casefold() for word in DATED)
        if unit is not None or not there.size or not (is_dated or is_called_time(column.name)):
            continue
        low, high = float(there.min()), float(there.max())
        kinds = {f"{name} since 1970": (EPOCH[0] * n, EPOCH[1] * n, n) for name, n in EPOCHS.items()}
        if is_dated:
            kinds["days of a spreadsheet's calendar"] = (*SERIAL_DAYS, 1.0 / DAY)
            kinds["days of MATLAB's calendar"] = (*MATLAB_DAYS, 1.0 / DAY)
        for phrase, (begin, end, ticks) in kinds.items():
            if begin <= low and high <= end:
                seconds = np.round(_from_first(column.values) / ticks, 9 if ticks >= 1.0 else 6)
                note = f"Column {column.name!r} is read as {phrase}, from the first."
                return Column(column.name, "s", seconds), note
    return None


def _of_rate(table: Table, columns: Sequence[Column], rate: float | None) -> tuple[Column, str] | None:
    """Times [s] at a rate [Hz] that was asked for, or that the header gives, and a note; None: there is none.

    Raises InputError if the header gives two.
    """
    given = sorted(table.intervals.items(), key=lambda one: one[1])
    if not columns or not (rate or given):
        return None
    name, rows = "time at the rate", np.arange(columns[0].values.size, dtype=np.float64)
    if rate:
        return Column(name, "s", rows / rate), f"Times are of the rate {rate:.9g} Hz, from 0 s."
    (line, interval), (other, longest) = given[0], given[-1]
    if longest > 1.001 * interval:
        raise InputError(
            f"{table.path}: has no times, and its header gives two rates, {short(line)} and {short(other)}; "
            "allowed: one, or --rate [Hz]"
        )
    note = f"Times are of the header's rate, {1.0 / interval:.9g} Hz ({line:.60}), from 0 s."
    return Column(name, "s", rows * interval), note


# --- series of columns over times ---


def series_file(
    path: Path,
    kind: str,
    groups: Iterable[Group],
    asked: Asked,
    notes: Iterable[str] = (),
    place: Callable[[int], str] = Table.place,
) -> SeriesFile:
    """Series from columns over their times.

    Rows without a time are left out. Infinite values count as not known. Rows are sorted by time; of rows of
    one time the last of the file stays. A second column of a name is called NAME#2. A note reports each.

    Arguments:
        path, kind, notes: of the file.
        groups: a column of times each, with the columns that have a value at each of them.
        asked: units of columns without one, and the names that are wanted.
        place: where a row stands, for notes.

    Raises InputError if there are no times, or if they have no unit of time.
    """
    series: dict[str, NamedSeries] = {}
    known: dict[str, int] = {}
    remarks, changes = [*notes], list[str]()
    for times, columns in groups:
        time, order, phrases = _increasing(path, times, asked, place)
        changes += phrases
        for column in columns:
            name = column.name
            known[name] = known.get(name, 0) + 1
            if known[name] > 1:
                remarks.append(f"Several columns are called {name!r}; the later ones are {name}#2 and so on.")
                name = f"{name}#{known[name]}"
            if not asked.wants(name):
                continue
            values = column.values[order]
            if endless := int(np.isinf(values).sum()):
                values = np.where(np.isinf(values), np.nan, values)
                remarks.append(f"{name}: infinite values count as not known: {endless}.")
            series[name] = NamedSeries(name, _unit(path, column, asked), time, values)
    changes = list(dict.fromkeys(changes))
    remarks = list(dict.fromkeys(cleaned(one).strip() for one in (*remarks, *changes) if one))
    if not series:
        phrase = f"has no series {first_names(asked.names)}; allowed: its own names"
        if not asked.names:
            phrase = "has times and nothing else; allowed: at least one column of numbers besides times"
        raise InputError(" ".join((f"{path}: {phrase}.", *remarks))[:-1])
    return SeriesFile(path, kind, series, tuple(remarks), tuple(changes))


def _unit(path: Path, column: Column, asked: Asked) -> str | None:
    unit = asked.unit(column.name, column.unit)
    if unit is None or unit == column.unit:
        return unit
    return read_unit(unit)[0] or unit_checked(unit, f"units, {column.name} of {path}")


def _increasing(
    path: Path, column: Column, asked: Asked, place: Callable[[int], str]
) -> tuple[Numbers, npt.NDArray[np.intp] | slice, list[str]]:
    """Times [s] that increase, the rows that they are of, and notes on it."""
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
        raise InputError(f"{where}: {place(int(np.argmax(np.isinf(time))))} is infinite; allowed: numbers")
    order = np.flatnonzero(np.isfinite(time))
    if not order.size:
        raise InputError(f"{where}: has no numbers; allowed: one or more")
    remarks = []
    if missing := time.size - order.size:
        first = place(int(np.argmax(np.isnan(time))))
        remarks.append(f"Rows without a time are left out: {missing}, the first is {first}.")
    falls = np.diff(time[order]) < 0.0
    if falls.any():
        first = place(int(order[np.argmax(falls) + 1]))
        remarks.append(f"The times of column {column.name!r} go back at {first}; rows are sorted by time.")
        order = order[np.argsort(time[order], kind="stable")]
    last = np.append(np.diff(time[order]) > 0.0, True)
    if repeated := int((~last).sum()):
        first = place(int(order[np.argmin(last)]))
        remarks.append(
            f"Times are repeated; of rows of one time the last stays, {repeated} are left out, the first is "
            f"{first}."
        )
    rows = order[last] if remarks else slice(None)  # of all rows nothing is copied
    return time[rows], rows, remarks
