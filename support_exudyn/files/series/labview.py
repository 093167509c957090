"""Series of LabVIEW's measurement files (`.lvm`), as National Instruments' specification says.

A header of tags ends with `***End_of_Header***`; so does the header of each segment, which has `X0` and
`Delta_X` of each channel, their units, and when the segment began. Below it stand the titles, of which the last
is `Comment`, and the rows. `X_Columns` says whether there is a column of times (One), one before each channel
(Multi), or none (No): then times are X0 + n Delta_X. `Samples` is wrong in files that were written piece by
piece, and is not used.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np

from support_exudyn.files.series.columns import Column, Numbers, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.stamps import is_stamp, read_stamps
from support_exudyn.files.series.table_layout import TableLayout
from support_exudyn.files.series.text_tables import columns_of, lines_of
from support_exudyn.files.series.units import is_called_time, read_unit, split_title
from user_forces.values.value import InputError, short

END = "***End_of_Header***"
SPECIAL = re.compile(r"(?ms)^\*\*\*Start_Special\*\*\*.*?^\*\*\*End_Special\*\*\*[^\n]*")


class _Tags:
    """The tags of a header, each with what stands behind it, over those of a header before."""

    def __init__(self, lines: Sequence[str], separator: str, before: _Tags | None = None) -> None:
        split = [[item.strip() for item in line.split(separator)] for line in lines]
        own = {items[0]: items[1:] for items in split if len(items) > 1 and items[0]}
        self.items: dict[str, list[str]] = {**(before.items if before else {}), **own}

    def get(self, key: str, default: str, n: int = 0) -> str:
        """What stands behind a tag for a channel."""
        found = self.items.get(key, [])
        return found[n] if n < len(found) and found[n] else default

    def moment(self) -> float:
        """When a segment began, in seconds since 1970; NaN if its header does not say."""
        import pandas as pd

        text = f"{self.get('Date', '')} {self.get('Time', '')}"
        return read_stamps(pd.Series(["1970/01/01 00:00", text])).seconds[1] if is_stamp(text) else np.nan


def read_labview(path: Path, asked: Asked) -> SeriesFile:
    """The series of a LabVIEW measurement file, channels by their names.

    Segments follow each other by their dates and times; where these are missing, or times begin again, the rest
    follows after one interval, with a note. Raises InputError if it is damaged, with the line; OSError if it
    cannot be read.
    """
    lines, notes = lines_of(path)
    text = SPECIAL.sub(lambda found: "\n" * found.group().count("\n"), "\n".join(lines))
    lines = text.split("\n")
    ends = [n for n, line in enumerate(lines) if line.startswith(END)]
    if not ends:
        raise InputError(f"{path}: has no line {END}; allowed: the whole of a LabVIEW measurement file")
    separator = "," if re.search(r"(?m)^Separator[\t,]\s*Comma", text) else "\t"
    tags = [_Tags(lines[: ends[0]], separator)]
    tags += [_Tags(lines[a + 1 : b], separator, tags[0]) for a, b in pairwise(ends)]
    own, heads = (tags[1:], ends[1:]) if len(ends) > 1 else (tags, ends)
    found: dict[str, list[tuple[str | None, Numbers, Numbers]]] = {}
    for tag, start, after in zip(own, heads, [*heads[1:], len(lines)], strict=True):
        stop = next((n for n in range(start, after) if lines[n].split(separator)[0] == "Channels"), after)
        relative = tag.get("Time_Pref", "Relative") == "Relative"
        later = float(np.nan_to_num(tag.moment() - own[0].moment())) if relative else 0.0
        for name, unit, time, values in _channels(path, lines[:stop], start + 1, tag, separator):
            found.setdefault(name, []).append((unit, time + later, values))
    if not found:
        raise InputError(f"{path}: has no rows; allowed: titles and one row or more below {END}")
    if len(heads) > 1:
        notes.append(f"The file has {len(heads)} segments, which follow each other.")
    axis = "s" if is_called_time(own[-1].get("X_Dimension", "Time")) else None
    groups = []
    for name, pieces in found.items():
        time, begins = _continued(np.concatenate([one for _, one, _ in pieces]))
        values = np.concatenate([one for *_, one in pieces])
        if begins:
            notes.append(
                f"Times of {name} begin again {begins} times; each time they go on after one interval."
            )
        groups.append((Column("X_Value", axis, time), [Column(name, pieces[-1][0], values)]))
    return series_file(path, "LabVIEW measurement file", groups, asked, notes)


def _channels(
    path: Path, lines: Sequence[str], start: int, tags: _Tags, separator: str
) -> Iterator[tuple[str, str | None, Numbers, Numbers]]:
    """Name, unit, times [s] and values (n,) of the channels of a segment, whose titles begin at a line."""
    start = next((n for n in range(start, len(lines)) if lines[n].strip()), len(lines) - 1)
    titles = [one.strip() for one in lines[start].split(separator)]
    titles = titles[:-1] if titles[-1].casefold() == "comment" else titles
    split = [(line.split(separator) + [""] * len(titles))[: len(titles)] for line in lines[start + 1 :]]
    rows = [separator.join(one) if any(map(str.strip, one)) else "" for one in split]
    if not any(rows):
        return
    if (point := tags.get("Decimal_Separator", ".")) not in (".", ","):
        raise InputError(f"{path}: Decimal_Separator {short(point)}; allowed: a point or a comma")
    names = tuple(split_title(one)[:2] for one in titles)
    how = TableLayout(separator, point, start + 1, names, ("number",) * len(titles))
    columns, _ = columns_of(path, [*lines[: start + 1], *rows], how)
    kind = tags.get("X_Columns", "One").casefold()
    for n, place in enumerate(range(1, len(columns), 2 if kind == "multi" else 1)):
        column = columns[place]
        try:
            x0, step = (float(tags.get(*tag, n).replace(point, ".")) for tag in (("X0", "0"), ("Delta_X", "1")))
        except ValueError:
            raise InputError(
                f"{path}: line {start}: X0 or Delta_X of {short(column.name)} above it is no number; allowed: "
                f"numbers such as 0{point}01"
            ) from None
        time = columns[place - 1 if kind == "multi" else 0].values
        if kind == "no" or np.isnan(time).all():
            time = x0 + step * np.arange(column.values.size, dtype=np.float64)
        label, known = tags.get("Y_Unit_Label", "", n), np.isfinite(time)
        yield column.name, read_unit(label)[0] if label else column.unit, time[known], column.values[known]


def _continued(times: Numbers) -> tuple[Numbers, int]:
    """Times that go on after one interval wherever they begin again, and how often they do."""
    steps = np.diff(times)
    again = steps <= 0.0
    if not again.any():
        return times, 0
    usual = float(np.median(steps[~again])) if not again.all() else 1.0
    return np.cumsum(np.append(times[:1], np.where(again, usual, steps))), int(again.sum())
