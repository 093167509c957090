"""Series of LabVIEW's measurement files (`.lvm`), as National Instruments' specification says.

A header of tags ends with `***End_of_Header***`; so does the header of each segment, which has `X0` and
`Delta_X` of each channel, their units, and when the segment began. Below it stand the titles, of which the last
is `Comment`, and the rows. `X_Columns` says whether there is a column of times (One), one before each channel
(Multi), or none (No): then times are X0 + n Delta_X. `Samples` is wrong in files that were written piece by
piece, and is not used.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from support_exudyn.files.series.columns import Column, Numbers, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.stamps import is_stamp, read_stamps
from support_exudyn.files.series.table_layout import TableLayout
from support_exudyn.files.series.text_tables import columns_of, text_of
from support_exudyn.files.series.units import is_called_time, read_unit, split_title
from user_forces.values.value import InputError, short

FIRST = re.compile(rb"(\xef\xbb\xbf)?\s*LabVIEW Measurement\b", re.IGNORECASE)
END = "***End_of_Header***"
SPECIAL = re.compile(r"(?ms)^\*\*\*Start_Special\*\*\*.*?^\*\*\*End_Special\*\*\*[^\n]*")
Tags = Mapping[str, Sequence[str]]


def is_labview(head: bytes) -> bool:
    """Whether a file begins as LabVIEW's measurement files do."""
    return FIRST.match(head) is not None


def read_labview(path: Path, asked: Asked) -> SeriesFile:
    """The series of a LabVIEW measurement file, channels by their names.

    Segments follow each other by their dates and times; where these are missing, or times begin again, the rest
    follows after one interval, with a note. Raises InputError if it is damaged, with the line; OSError if it
    cannot be read.
    """
    data, notes = text_of(path)
    text = SPECIAL.sub(lambda found: "\n" * found.group().count("\n"), data.decode())
    lines = text.split("\n")
    ends = [n for n, line in enumerate(lines) if line.startswith(END)]
    if not ends:
        raise InputError(f"{path}: has no line {END}; allowed: the whole of a LabVIEW measurement file")
    separator = "," if re.search(r"(?m)^Separator[\t,]\s*Comma", text) else "\t"
    tags = _tags(lines[: ends[0]], separator)
    heads = ends[1:] or ends  # of the segments
    times: dict[str, list[Numbers]] = {}
    values: dict[str, list[Numbers]] = {}
    units: dict[str, str | None] = {}
    first: float | None = None
    for head, after in zip(heads, [*heads[1:], len(lines)], strict=True):
        own = {
            **tags,
            **_tags(lines[ends[ends.index(head) - 1] + 1 : head] if head != ends[0] else [], separator),
        }
        stop = next((n for n in range(head, after) if lines[n].split(separator)[0] == "Channels"), after)
        moment = _moment(own)
        first = moment if first is None else first
        for name, unit, time, numbers in _channels(path, lines, (head + 1, stop), own, separator):
            later = (
                (moment or 0.0) - (first or 0.0) if own.get("Time_Pref", ["Relative"])[0] == "Relative" else 0.0
            )
            times.setdefault(name, []).append(time + later)
            values.setdefault(name, []).append(numbers)
            units[name] = unit
    if len(heads) > 1:
        notes.append(f"The file has {len(heads)} segments, which follow each other.")
    axis = "s" if is_called_time(own.get("X_Dimension", ["Time"])[0]) else None
    groups = []
    for name, pieces in times.items():
        time, begins = _continued(np.concatenate(pieces))
        if begins:
            notes.append(
                f"Times of {name} begin again {begins} times; each time they go on after one interval."
            )
        groups.append(
            (Column("X_Value", axis, time), [Column(name, units[name], np.concatenate(values[name]))])
        )
    if not groups:
        raise InputError(f"{path}: has no rows; allowed: titles and one row or more below {END}")
    return series_file(path, "LabVIEW measurement file", groups, asked, notes)


def _tags(lines: Sequence[str], separator: str) -> dict[str, list[str]]:
    """The tags of a header, each with what stands behind it."""
    split = [[item.strip() for item in line.split(separator)] for line in lines]
    return {items[0]: items[1:] for items in split if len(items) > 1 and items[0]}


def _tag(tags: Tags, key: str, n: int, default: str) -> str:
    """What stands behind a tag for a channel."""
    found = tags.get(key, ())
    return found[n] if n < len(found) and found[n] else default


def _moment(tags: Tags) -> float | None:
    """When a segment began, in seconds since 1970; None if its header does not say."""
    import pyarrow as pa

    text = f"{_tag(tags, 'Date', 0, '')} {_tag(tags, 'Time', 0, '')}"
    if not is_stamp(text):
        return None
    seconds = read_stamps("", pa.array(["1970/01/01 00:00", text])).seconds
    return float(seconds[1]) if np.isfinite(seconds[1]) else None


def _channels(
    path: Path, lines: Sequence[str], place: tuple[int, int], tags: Tags, separator: str
) -> Iterator[tuple[str, str | None, Numbers, Numbers]]:
    """Name, unit, times [s] and values (n,) of the channels of a segment between two lines."""
    start, stop = place
    start = next((n for n in range(start, stop) if lines[n].strip()), stop)
    titles = [one.strip() for one in lines[start].split(separator)] if start < stop else []
    titles = titles[:-1] if titles and titles[-1].casefold() == "comment" else titles
    rows = [
        separator.join((line.split(separator) + [""] * len(titles))[: len(titles)])
        for line in lines[start + 1 : stop]
    ]
    rows = [row if row.strip() else "" for row in rows]
    if not any(rows):
        return
    if (point := _tag(tags, "Decimal_Separator", 0, ".")) not in (".", ","):
        raise InputError(f"{path}: Decimal_Separator {short(point)}; allowed: a point or a comma")
    named = [split_title(one) for one in titles]
    how = TableLayout(separator, point, start + 1, tuple(one[:2] for one in named), ("number",) * len(titles))
    columns = columns_of(path, ("\n" * (start + 1) + "\n".join(rows)).encode(), how)
    kind = _tag(tags, "X_Columns", 0, "One").casefold()
    for n, place_of in enumerate(range(1, len(columns), 2 if kind == "multi" else 1)):
        column = columns[place_of]
        try:
            x0, step = (
                float(_tag(tags, key, n, usual).replace(point, "."))
                for key, usual in (("X0", "0"), ("Delta_X", "1"))
            )
        except ValueError:
            raise InputError(
                f"{path}: line {start}: X0 or Delta_X of {short(column.name)} above it is no number; allowed: "
                f"numbers such as 0{point}01"
            ) from None
        time = columns[place_of - 1 if kind == "multi" else 0].values
        if kind == "no" or np.isnan(time).all():
            time = x0 + step * np.arange(column.values.size, dtype=np.float64)
        label = _tag(tags, "Y_Unit_Label", n, "")
        known = np.isfinite(time)
        yield column.name, read_unit(label)[0] if label else column.unit, time[known], column.values[known]


def _continued(times: Numbers) -> tuple[Numbers, int]:
    """Times that go on after one interval wherever they begin again, and how often they do."""
    steps = np.diff(times)
    if (steps > 0.0).all():
        return times, 0
    usual = float(np.median(steps[steps > 0.0])) if (steps > 0.0).any() else 1.0
    again = steps <= 0.0
    later = np.cumsum(np.where(again, usual, steps), dtype=np.float64)
    found: Numbers = np.concatenate([times[:1], times[:1] + later])
    return found, int(again.sum())
