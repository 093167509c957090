"""Date-time stamps as programs write them, as seconds.

    2023-05-04 06:00:00.25   2023-05-04T06:00:00Z     2023/05/04 06:00+08:00   20230504T060000
    04.05.2023 06:00         05/04/2023 06:00:00 AM   4-May-2023 06:00         06:00:00,25   06:00:00:250

A stamp with the year first is year, month, day; with points day, month, year. With strokes or hyphens and the
year last, day and month are distinguished by what the whole column allows; where both remain, by AM and PM,
which the United States write, else by the shorter time that the file then covers, with a note.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

Numbers = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]
DAY, HOUR = 86400.0, 3600.0  # [s]
MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
DATE = (
    r"(?:(?P<y1>[0-9]{4})[-/.年](?P<m1>[0-9]{1,2})[-/.月](?P<d1>[0-9]{1,2})日?"
    r"|(?P<a>[0-9]{1,2})(?P<between>[-/.])(?P<b>[0-9]{1,2})[-/.](?P<y2>[0-9]{4}|[0-9]{2})"
    r"|(?P<d3>[0-9]{1,2})[-/. ]+(?P<m3>[A-Za-z]{3})[a-z]*[-/. ,]+(?P<y3>[0-9]{4}|[0-9]{2})"
    r"|(?P<m4>[A-Za-z]{3})[a-z]*\.? (?P<d4>[0-9]{1,2}),? (?P<y4>[0-9]{4}))"
)
CLOCK = (
    r"(?P<noon>上午|下午)? ?(?P<hour>[0-9]{1,3}):(?P<minute>[0-9]{1,2})"
    r"(?::(?P<second>[0-9]{1,2}(?:[.,:][0-9]+)?))?(?: ?(?P<half>[AaPp])\.?[Mm]\.?)?"
)
COMPACT = (
    r"(?P<y5>[0-9]{4})(?P<m5>[0-9]{2})(?P<d5>[0-9]{2})[T_ -]"
    r"(?P<h5>[0-9]{2})(?P<n5>[0-9]{2})(?P<s5>[0-9]{2}(?:[.,][0-9]+)?)"
)
MINUTES = r"(?P<n6>[0-9]{1,3}):(?P<s6>[0-9]{2}[.,][0-9]+)"  # as spreadsheets show what is below an hour
ZONE = r" ?(?P<zone>[Zz]|UTC|GMT|[+-][0-9]{2}:?[0-9]{2}|[+-][0-9]{2})?"
DATED = rf"{COMPACT}|{DATE}(?:(?:[T_]|,? +|-){CLOCK})?"
PATTERN = rf"^\s*(?:{DATED}|{MINUTES}|{CLOCK.replace('P<', 'P<only_')}){ZONE}\s*$"
STAMP = re.compile(PATTERN)


@lru_cache(maxsize=10_000)
def is_stamp(item: str) -> bool:
    """Whether an item is a date, a clock or both."""
    return STAMP.fullmatch(item) is not None


@dataclass(frozen=True)
class Stamps:
    """A column of stamps.

    seconds: from midnight of the first stamp's day (n,), of clocks from midnight; NaN where there is none.
    has_date: whether they have one. period: after which clocks begin again [s], 0 if they have none.
    note: what was assumed, or nothing.
    wrong: the first item that is no stamp or no such day, with its index; None if all are.
    """

    seconds: Numbers
    has_date: bool
    period: float
    note: str
    wrong: tuple[int, str] | None


def read_stamps(name: str, words: Any) -> Stamps:
    """The stamps of a column.

    Arguments:
        name: of the column, for notes.
        words: pyarrow's array of strings (n,), null where there is none.
    """
    parts = _Parts(words)
    clock, clocked, known = parts.clock()
    days, note = parts.days(name, clock)
    dated = parts.number("y1", "y2", "y3", "y4", "y5") >= 0.0
    minutes = parts.number("n6") >= 0.0
    known &= dated | minutes | np.isfinite(clocked)
    known &= ~dated | (np.isfinite(days) & ~(clocked >= 24.0))
    there = np.flatnonzero(dated & known)
    start = days[there[0]] if there.size else 0.0
    seconds = np.where(known, clock + DAY * np.where(dated, days - start, 0.0), np.nan)
    wrong = np.flatnonzero(~known & ~parts.missing)
    period = DAY if np.isfinite(clocked).any() else HOUR if minutes.any() else 0.0
    first = (int(wrong[0]), str(words[int(wrong[0])].as_py())) if wrong.size else None
    return Stamps(seconds, bool(dated.any()), period, note, first)


class _Parts:
    """The parts of stamps by the names of the pattern's groups."""

    def __init__(self, words: Any) -> None:
        import pyarrow as pa
        import pyarrow.compute as pc

        self._arrow, self._compute = pa, pc
        whole = words.combine_chunks() if isinstance(words, pa.ChunkedArray) else words
        self._found = pc.extract_regex(whole, PATTERN)
        self.missing: Flags = np.asarray(pc.is_null(whole))

    def texts(self, *keys: str) -> Any:
        """What stands in the first of some groups that has something."""
        return self._compute.binary_join_element_wise(*map(self._found.field, keys), "")

    def number(self, *keys: str) -> Numbers:
        """The number in some groups, NaN where there is none."""
        text = self._compute.replace_substring_regex(self.texts(*keys), "[,:]", ".")
        text = self._compute.if_else(self._compute.equal(text, ""), None, text)
        return np.asarray(text.cast(self._arrow.float64()).to_numpy(zero_copy_only=False), dtype=np.float64)

    def is_any(self, keys: tuple[str, ...], texts: tuple[str, ...]) -> Flags:
        """Where some groups have one of the texts."""
        found = self._compute.is_in(self.texts(*keys), self._arrow.array(texts))
        return np.asarray(found, dtype=np.bool_)

    def clock(self) -> tuple[Numbers, Numbers, Flags]:
        """Seconds of the clocks in coordinated time, 0 without a clock; the hours; and whether it is one."""
        hour, minute = self.number("hour", "only_hour", "h5"), self.number("minute", "only_minute", "n5", "n6")
        second = self.number("second", "only_second", "s5", "s6")
        known = ~((minute >= 60.0) | (second >= 61.0))
        after = self.is_any(("half", "only_half", "noon", "only_noon"), ("p", "P", "下午"))
        before = self.is_any(("half", "only_half"), ("a", "A"))
        hour = np.where(after & (hour < 12.0), hour + 12.0, np.where(before & (hour == 12.0), 0.0, hour))
        zones = self.texts("zone").dictionary_encode()
        shifts = np.array([_zone(str(one)) for one in zones.dictionary.to_pylist()] or [0.0])
        shift = shifts[np.asarray(self._compute.fill_null(zones.indices, 0))]
        return sum(map(np.nan_to_num, (HOUR * hour, 60.0 * minute, second))) - shift, hour, known

    def days(self, name: str, clock: Numbers) -> tuple[Numbers, str]:
        """Days since 1970, NaN of what is no date; and a note if days and months could be either."""
        year = self.number("y1", "y2", "y3", "y4", "y5")
        if not np.isfinite(year).any():
            return year, ""
        year = np.where(year < 100.0, year + np.where(year < 70.0, 2000.0, 1900.0), year)
        names = self._compute.index_in(
            self._compute.utf8_lower(self.texts("m3", "m4")), self._arrow.array(MONTHS)
        )
        month = np.asarray(names.cast(self._arrow.float64()).to_numpy(zero_copy_only=False)) + 1.0
        month, day = np.fmax(month, self.number("m1", "m5")), self.number("d1", "d3", "d4", "d5")
        first, second = self.number("a"), self.number("b")
        swapped = np.isfinite(first) & ~self.is_any(("between",), (".",))
        day_first = _days(year, np.fmax(month, second), np.fmax(day, first))
        if not swapped.any():
            return day_first, ""
        other = _days(year, np.where(swapped, first, second), np.where(swapped, second, first))
        month_first = np.where(swapped, other, day_first)
        american = bool(self.is_any(("half", "only_half"), ("a", "A", "p", "P")).any())
        return _order(name, (day_first, month_first), clock, np.isfinite(year), american)


def _zone(text: str) -> float:
    """How much the clocks of a zone such as +08:00 are ahead of coordinated time [s]."""
    if text[:1] not in ("+", "-"):
        return 0.0
    digits = text[1:].replace(":", "").ljust(4, "0")
    return float(f"{text[0]}1") * (HOUR * int(digits[:2]) + 60.0 * int(digits[2:]))


def _days(year: Numbers, month: Numbers, day: Numbers) -> Numbers:
    """Days since 1970 of dates (n,), NaN where there is no such day."""
    known = np.isfinite(year) & (month >= 1.0) & (month <= 12.0) & (day >= 1.0) & (day <= 31.0)
    whole = [np.where(known, one, 1970.0 if one is year else 1.0).astype(int) for one in (year, month, day)]
    months = 12 * (whole[0] - 1970) + whole[1] - 1
    dates = months.astype("M8[M]").astype("M8[D]") + (whole[2] - 1)
    known &= dates.astype("M8[M]").astype(int) == months
    return np.where(known, dates.astype(np.float64), np.nan)


def _order(
    name: str, orders: tuple[Numbers, Numbers], clock: Numbers, dated: Flags, american: bool
) -> tuple[Numbers, str]:
    """The days of stamps read with the day or with the month first, and a note if both are possible."""
    possible = [np.isfinite(one[dated]).all() for one in orders]
    if not all(possible):
        return orders[1 if possible[1] else 0], ""
    times = [(DAY * one + clock)[dated] for one in orders]
    falls = [int((np.diff(one) < 0.0).sum()) for one in times]
    spans = [float(np.ptp(one)) for one in times]
    if falls[0] == falls[1] and spans[0] == spans[1]:  # of one day: it makes no difference
        return orders[0], ""
    month_first = american if falls[0] == falls[1] else falls[1] < falls[0]
    month_first = month_first or (falls[0] == falls[1] and spans[1] < spans[0])
    phrase = "month before the day" if month_first else "day before the month"
    return orders[int(month_first)], f"Column {name!r}: dates are read with the {phrase}."
