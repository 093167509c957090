"""A compare.toml with proposals: columns that are called alike, of one kind, and whose curves run alike.

Nothing of it is used unconfirmed: the file says `confirmed = false`, and is refused until somebody has changed
that.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from difflib import SequenceMatcher
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy.optimize import linear_sum_assignment

from support_exudyn.files.series.units import scaled
from support_exudyn.postprocessing.comparing.channel_units import channel_unit
from support_exudyn.postprocessing.comparing.common_times import on_common_times
from support_exudyn.postprocessing.comparing.compare_file import CompareFile, MappedColumn, MappedFile
from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from support_exudyn.postprocessing.comparing.found_shift import found_shift
from support_exudyn.postprocessing.comparing.shift import time_shift
from support_exudyn.postprocessing.comparing.si_units import of_a_kind
from user_forces.values.value import InputError, cleaned

LEAST = 0.5  # likeness of what is proposed
BY_NAME = 0.4  # share of the likeness that names have; the rest is that of the curves
LESS = 0.9  # of what a correlation counts where values are not known, and the other sign beside the same
CLOSE = 0.9  # values that agree by this are no chance
FEWEST = 3  # common times that tell anything
WORDS = re.compile(r"[a-z]+|\d+")
UNKNOWN = "?"  # a unit that has to be given


class Likeness(NamedTuple):
    """How alike a channel of the reference and a column of another file are.

    names: 0 to 1. curves: correlation at common times, -1 to 1; NaN if there is none. values: concordance of
    Lin, 2 cov / (var + var + (difference of means)^2), -1 to 1, which only equal values have as 1; NaN if a
    unit is not known.
    """

    channel: str
    column: str
    names: float
    curves: float
    values: float

    @property
    def whole(self) -> float:
        """0 to 1; of curves without correlation the names alone count, less."""
        if math.isnan(self.curves):
            return 0.9 * self.names
        known = not math.isnan(self.values)
        told = 0.5 * (abs(self.curves) + abs(self.values)) if known else LESS * abs(self.curves)
        turned = LESS if self.curves < 0.0 else 1.0
        return turned * (BY_NAME * self.names + (1.0 - BY_NAME) * told)

    def __str__(self) -> str:
        """In words."""
        words = [f"names {100.0 * self.names:.0f} % alike"]
        words += [] if math.isnan(self.curves) else [f"curves correlate by {self.curves:.3f}"]
        words += [] if math.isnan(self.values) else [f"values agree by {self.values:.3f}"]
        return ", ".join(words)


def proposal(files: Sequence[ComparedFile], said: CompareFile, find_shift: bool = False) -> str:
    """The text of a compare.toml for files, the first of which is the reference.

    said: what is mapped already, which stays out of it. find_shift: find by how much every file lags behind the
    reference by the columns that have the likest names, and propose the shift with columns that fit then.

    Raises InputError if a shift is to be found and no column is sure of it.
    """
    reference, *others = files
    lines = [
        f"# What of {', '.join(one.name for one in others)} may be what of {reference.name}. Look at every "
        "line,",
        "# take out or mend what is wrong, then set confirmed = true, and give it as --map.",
        "# A line behind # is a guess by the curve alone.",
        "",
        "confirmed = false",
    ]
    for other in others:
        lines += ["", *_of(reference, _shifted(reference, other) if find_shift else other)]
    lines += [
        "",
        "# [tolerances]",
        f'# {_quoted(reference.channels[0])} = "2 %" # of the reference\'s range, or an amount such as "0.1 '
        'mm"',
    ]
    return "\n".join(lines) + "\n"


def _shifted(reference: ComparedFile, other: ComparedFile) -> ComparedFile:
    """The file with the shift in time that lays its columns on the channels that have the likest names."""
    columns = [name for name in other.series if name not in reference.channels]
    channels = [name for name in reference.channels if name not in other.channels]
    pairs = {one: max(columns, key=partial(_names, one)) for one in channels if columns}
    named = replace(other, mapped=MappedFile(columns={k: MappedColumn(column=v) for k, v in pairs.items()}))
    alike = {}
    for one in named.channels:
        with suppress(InputError):  # of no unit, or of two kinds: no curve to find a shift by
            alike[one] = channel_unit(reference, named, one) if one in reference.channels else ""
    shift = found_shift(reference, named, {one: unit for one, unit in alike.items() if unit})
    return other.shifted(-shift.found.shift)


def _of(reference: ComparedFile, other: ComparedFile) -> list[str]:
    """The lines on a file."""
    found, nexts = proposed(reference, other)
    name = f"files.{_quoted(other.path.name)}"
    lines = [f"[{name}]", f"shift_s = {other.mapped.shift!r} # added to its times", ""]
    lines = lines if other.mapped.shift else []
    lines += [
        f"[{name}.columns]" if found else f"# {other.name}: no column is like a channel of {reference.name}"
    ]
    for one in found:
        column = _quoted(one.column)
        doubtful, late = _is_doubtful(one), ""
        in_step = any(each.curves > LEAST for each in found)  # a shift is of the whole file
        if one.curves < 0.0 and not in_step and (shift := _in_step(reference, other, one)) is not None:
            late = f"; a shift in time by {shift:.4g} s fits as well as sign = -1 (--shift finds one)"
        elif one.curves < 0.0:
            column = f"{{ column = {column}, sign = -1 }}"
        lines.append(f"{'# ' * doubtful}{_quoted(one.channel)} = {column} # {one}{nexts[one.column]}{late}")
    units = [one.column for one in found if other.unit(one.column) is None and not _is_doubtful(one)]
    if units or other.mapped.units:
        lines += ["", f"[files.{_quoted(other.path.name)}.units]"]
        lines += [f"{_quoted(name)} = {_quoted(unit)}" for name, unit in other.mapped.units.items()]
        lines += [f'{_quoted(column)} = "{UNKNOWN}" # the file names none' for column in units]
    return lines


def _in_step(reference: ComparedFile, other: ComparedFile, one: Likeness) -> float | None:
    """The shift [s] by which a column with the other sign is as like a channel without; None if none is."""
    first, second = reference.series[reference.column(one.channel).column], other.series[one.column]
    try:
        found = time_shift(first.time, first.values, second.time + other.mapped.shift, second.values)
    except InputError:
        return None
    return -found.shift if found.correlation >= LESS * abs(one.curves) else None


def _is_doubtful(one: Likeness) -> bool:
    """Whether little more than the shape of a curve speaks for it: steady rises are all alike."""
    return one.names < LEAST and not abs(one.values) > CLOSE


def _quoted(text: str) -> str:
    """A text as TOML writes it, also as a key: what JSON writes is TOML."""
    return json.dumps(cleaned(text), ensure_ascii=False)


def proposed(reference: ComparedFile, other: ComparedFile) -> tuple[list[Likeness], dict[str, str]]:
    """The columns that are like channels, each once, so that all likenesses together are largest.

    Returns them, and of each column what it is like next, in words; empty if that is far less.
    """
    channels = [name for name in reference.channels if name not in other.channels]
    columns = [name for name in other.series if name not in reference.channels]
    if not channels or not columns:
        return [], {}
    table = [[_likeness(reference, other, channel, column) for column in columns] for channel in channels]
    rows, places = linear_sum_assignment([[-one.whole for one in row] for row in table])
    chosen = [table[row][place] for row, place in zip(rows, places, strict=True)]
    nexts = {}
    for one in chosen:
        rest = [row[columns.index(one.column)] for row in table if row[0].channel != one.channel]
        best = max(rest, key=lambda item: item.whole, default=None)
        near = best is not None and best.whole > LESS * one.whole
        nexts[one.column] = f"; as like: {best.channel}" if best is not None and near else ""
    return [one for one in chosen if one.whole >= LEAST], nexts


def _likeness(reference: ComparedFile, other: ComparedFile, channel: str, column: str) -> Likeness:
    mine, its = reference.unit(channel), other.unit(column)
    known = mine is not None and its is not None
    if known and not of_a_kind(str(mine), str(its)):
        return Likeness(channel, column, 0.0, 0.0, 0.0)
    scale = float(scaled(np.ones(1), str(its), str(mine), column)[0]) if known else math.nan
    return Likeness(
        channel, column, _names(channel, column), *_curves(reference, other, channel, column, scale)
    )


def _names(one: str, other: str) -> float:
    """How alike two names are: as texts, or by their words in any order."""
    first, second = (WORDS.findall(name.lower()) for name in (one, other))
    text = SequenceMatcher(None, "".join(first), "".join(second)).ratio()
    shared = len(set(first) & set(second)) / max(len(set(first) | set(second)), 1)
    return max(text, shared)


def _curves(
    reference: ComparedFile, other: ComparedFile, channel: str, column: str, scale: float
) -> tuple[float, float]:
    """Correlation and concordance of two curves at common times; NaN if one is constant, or if they do not
    overlap.

    scale: by which the column is in the unit of the channel; NaN if that is not known.
    """
    first, second = reference.series[reference.column(channel).column], other.series[column]
    try:
        its = second.time + other.mapped.shift
        both = on_common_times(first.time, first.values, its, second.values)
    except InputError:
        return math.nan, math.nan
    known = np.isfinite(both.reference) & np.isfinite(both.other)
    if known.sum() < FEWEST:
        return math.nan, math.nan
    one, two = both.reference[known], both.other[known]
    sizes = float(one.std() * two.std())
    if not (sizes > 0.0 and math.isfinite(sizes)):
        return math.nan, math.nan
    together = float(((one - one.mean()) * (two - two.mean())).mean())
    apart = one.var() + scale**2 * two.var() + (one.mean() - scale * two.mean()) ** 2
    return together / sizes, 2.0 * scale * together / float(apart)
