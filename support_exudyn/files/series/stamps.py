"""Date-time stamps as programs write them, as seconds.

    2023-05-04 06:00:00.25   2023-05-04T06:00:00Z     2023/05/04 06:00+08:00   20230504T060000
    04.05.2023 06:00         05/04/2023 06:00:00 AM   4-May-2023 06:00         06:00:00,25   06:00:00:250

A stamp with the year first is year, month, day; with points day, month, year. With strokes or hyphens and the
year last, the whole column determines which of the first two numbers is the day: the other order has no such
day, or goes back. Where both remain, AM and PM show that the month is first. Other stamps are refused.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    import pandas as pd

Numbers = npt.NDArray[np.float64]
DAY, HOUR = 86400.0, 3600.0  # [s]
MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
DATE = (
    r"[0-9]{4}[-/.年][0-9]{1,2}[-/.月][0-9]{1,2}日?|[0-9]{1,2}([-/.])[0-9]{1,2}\1(?:[0-9]{2}){1,2}"
    r"|[0-9]{1,2}[-. ]+[A-Za-z]{3,9}[-. ,]+[0-9]{4}|[A-Za-z]{3,9}\.? [0-9]{1,2},? [0-9]{4}"
)
CLOCK = (
    r"(?:[上下]午)? ?[0-9]{1,3}:[0-9]{1,2}(?::[0-9]{1,2}(?:[.,:][0-9]+)?|[.,][0-9]+)?(?: ?[AaPp]\.?[Mm]\.?)?"
)
ZONE = r"(?: ?(?:Z|UTC|GMT|[+-][0-9]{2}(?::?[0-9]{2})?))?"
STAMP = re.compile(
    rf"(?:{DATE})(?:[T_, -]+{CLOCK}{ZONE})?|{CLOCK}{ZONE}|[0-9]{{8}}[T_ -][0-9]{{6}}(?:[.,][0-9]+)?"
)


def _iso(found: re.Match[str]) -> str:
    """A date with the name of its month as pandas reads it."""
    day, name, year = found["d"], found["m"], found["y"]
    small = name[:3].casefold()
    return f"{year}-{MONTHS.index(small) + 1:02d}-{int(day):02d}" if small in MONTHS else name


REWRITTEN: tuple[tuple[str, Any], ...] = (  # to what pandas reads
    (r"[年月]", "-"),
    (r"日| ?(?:UTC|GMT)$", ""),
    (r"(:[0-9]{1,2}:[0-9]{1,2})[,:]", r"\1."),
    (r"^([0-9]{1,3}:[0-9]{2})[.,]", r"0:\1."),  # minutes and seconds, as spreadsheets show them
    (r"^([0-9]{1,3}:[0-9]{1,2})$", r"\1:00"),
    (r"[_, -]+(?=[0-9]{1,3}:|[0-9]{6}$)", " "),
    (r"^([0-9]{1,2}[-/.][0-9]{1,2}[-/.])([0-9]{2})(?![0-9])", r"\g<1>20\2"),
    (r"^([0-9]{1,2})\.([0-9]{1,2})\.([0-9]{4})", r"\3-\2-\1"),
    (r"^(?P<d>[0-9]{1,2})[-. ]+(?P<m>[A-Za-z]+)[-. ,]+(?P<y>[0-9]{4})", _iso),
    (r"^(?P<m>[A-Za-z]+)\.? (?P<d>[0-9]{1,2}),? (?P<y>[0-9]{4})", _iso),
)
SWAPPED = r"^([0-9]{1,2})[-/]([0-9]{1,2})[-/]([0-9]{4})"
HALF = r"(上午|下午|[AaPp])\.?(?:[Mm]\.?)?"
AS_BEFORE = "a date and time as before, or nothing"
YEAR_FIRST = "dates with the year first, such as 2023-05-04: day and month of these may be either"


@lru_cache(maxsize=10_000)
def is_stamp(item: str) -> bool:
    """Whether an item is a date, a clock or both."""
    return STAMP.fullmatch(item) is not None


@dataclass(frozen=True)
class Stamps:
    """A column of stamps.

    seconds: from midnight of the first stamp's day (n,), of clocks from midnight; NaN where there is none.
    has_date: whether they have one. period: after which clocks begin again [s], 0 if they have none.
    wrong: the index of the first item that cannot be read, the item, and what is allowed; None if all can.
    """

    seconds: Numbers
    has_date: bool
    period: float
    wrong: tuple[int, str, str] | None = None


def read_stamps(column: pd.Series) -> Stamps:
    """The stamps of a column of texts (n,), missing where there is none."""
    missing = column.isna().to_numpy()
    text = column.astype("str").str.strip()
    half = text.str.extract(
        f"{HALF}$" if text.str.endswith(("M", "m", "."), na=False).any() else "(上午|下午)"
    )[0]
    half = half.str.lower().str.replace("上午", "a").str.replace("下午", "p")
    plain = text.str.replace(rf" ?{HALF}$|[上下]午 ?", "", regex=True)
    minutes = bool(plain.str.match(r"[0-9]{1,3}:[0-9]{2}[.,]", na=False).any())
    shapes = plain[~missing].str.replace("[0-9]", "1", regex=True).unique()  # few, by which a pattern is tried
    for pattern, new in REWRITTEN:
        if any(re.search(pattern, one) for one in shapes):
            plain = plain.str.replace(pattern, new, regex=True)
            shapes = [re.sub(pattern, new, one) for one in shapes]
    has_date = not bool(plain[~missing].str.match(r"[0-9]{1,3}:").all())
    period = HOUR if minutes else DAY if bool(plain.str.contains(":|[0-9]{8}[T ]", na=False).any()) else 0.0
    read = _moments if has_date else _clocks
    orders = (r"\3-\2-\1", r"\3-\1-\2") if bool(plain.str.match(SWAPPED, na=False).any()) else ("",)
    found = [read(plain.str.replace(SWAPPED, order, regex=True), half.to_numpy()) for order in orders]
    whole = [one for one in found if np.isfinite(one[~missing]).all()]
    rising = [one for one in whole if (np.diff(one[~missing]) >= 0.0).all()]
    fitting = rising or whole or found
    seconds = fitting[-1 if half.notna().any() else 0]
    wrong = np.flatnonzero(np.isnan(seconds) & ~missing)
    if wrong.size:
        return Stamps(seconds, has_date, period, (int(wrong[0]), str(text.iloc[wrong[0]]), AS_BEFORE))
    if len(fitting) > 1 and half.isna().all() and np.ptp(fitting[0][~missing]) != np.ptp(fitting[1][~missing]):
        row = int(np.flatnonzero(~missing)[0])
        return Stamps(seconds, has_date, period, (row, str(text.iloc[row]), YEAR_FIRST))
    return Stamps(seconds, has_date, period)


def _moments(text: pd.Series, half: npt.NDArray[np.object_]) -> Numbers:
    """Seconds from midnight of the first day of dates, perhaps with clocks; NaN of what is none."""
    import pandas as pd

    moments = pd.to_datetime(text, format="ISO8601", errors="coerce", utc=True)
    there = moments.dropna()
    start = there.iloc[0].normalize() if there.size else pd.Timestamp(0, tz="UTC")
    seconds: Numbers = ((moments - start) / pd.Timedelta("1s")).to_numpy(dtype=np.float64)
    return seconds + _afternoon(moments.dt.hour.to_numpy(), half)


def _clocks(text: pd.Series, half: npt.NDArray[np.object_]) -> Numbers:
    """Seconds from midnight of clocks; NaN of what is none."""
    import pandas as pd

    since = pd.to_timedelta(text, errors="coerce") / pd.Timedelta("1s")
    seconds: Numbers = since.to_numpy(dtype=np.float64)
    return seconds + _afternoon(seconds // HOUR, half)


def _afternoon(hours: Numbers, half: npt.NDArray[np.object_]) -> Numbers:
    """What AM and PM add to clocks of twelve hours [s]."""
    later = (half == "p") & (hours < 12.0)
    added: Numbers = 12.0 * HOUR * (later.astype(np.float64) - ((half == "a") & (hours == 12.0)))
    return added
