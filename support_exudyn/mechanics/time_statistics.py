"""Statistics of channels over time: kept by intervals of a run, combined over the window that is asked for.

Of every interval the mean, the variance about it, the values at both ends, and both extremes with their times
are known, each from all steps of the solver. Intervals of a window combine without loss:

    mean = sum(T_k m_k) / T,    variance = sum(T_k (v_k + (m_k - mean)^2)) / T

A window that ends inside an interval takes a part of it. The channel is then the parabola that has the values
at both ends and the mean of the interval; what its variance lacks of the true one bounds the error.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Series = npt.NDArray[np.float64]

COLUMNS = ("mean", "variance", "first", "last", "least", "least_time", "greatest", "greatest_time")
MEAN, VARIANCE, FIRST, LAST, LEAST, LEAST_TIME, GREATEST, GREATEST_TIME = range(len(COLUMNS))
SAME = 1e-9  # [s] and share of a time: edges are sums of periods
GAUSS, GAUSS_WEIGHTS = np.array([0.5 - math.sqrt(0.15), 0.5, 0.5 + math.sqrt(0.15)]), np.array([5, 8, 5]) / 18.0


class TimeWindow(NamedTuple):
    """What a channel does between two times: rows of `COLUMNS`, one an interval, of these durations [s].

    mean_doubt, square_doubt, least_doubt, greatest_doubt: by how much the mean, the mean square about it and
    the extremes may be off because the window ends inside intervals.
    """

    durations: Series
    rows: Series
    mean_doubt: float = 0.0
    square_doubt: float = 0.0
    least_doubt: float = 0.0
    greatest_doubt: float = 0.0

    @property
    def mean(self) -> float:
        """Mean over time."""
        return float(self.durations @ self.rows[:, MEAN] / self.durations.sum())

    @property
    def std(self) -> float:
        """Standard deviation over time."""
        squares = self.rows[:, VARIANCE] + (self.rows[:, MEAN] - self.mean) ** 2
        return math.sqrt(float(self.durations @ squares / self.durations.sum()))

    @property
    def rms(self) -> float:
        """Root of the mean square over time."""
        return math.hypot(self.mean, self.std)

    @property
    def least(self) -> tuple[float, float]:
        """The least value, and its time [s]."""
        n = int(self.rows[:, LEAST].argmin())
        return float(self.rows[n, LEAST]), float(self.rows[n, LEAST_TIME])

    @property
    def greatest(self) -> tuple[float, float]:
        """The greatest value, and its time [s]."""
        n = int(self.rows[:, GREATEST].argmax())
        return float(self.rows[n, GREATEST]), float(self.rows[n, GREATEST_TIME])

    @property
    def largest(self) -> tuple[float, float]:
        """The largest magnitude, and its time [s]."""
        least, greatest = self.least, self.greatest
        return (-least[0], least[1]) if -least[0] > greatest[0] else greatest

    @property
    def first(self) -> float:
        """The value at the beginning."""
        return float(self.rows[0, FIRST])

    @property
    def last(self) -> float:
        """The value at the end."""
        return float(self.rows[-1, LAST])

    @property
    def std_doubt(self) -> float:
        """By how much the standard deviation may be off because the window ends inside intervals."""
        square = self.std**2
        return max(
            math.sqrt(square + self.square_doubt) - self.std,
            self.std - math.sqrt(max(0.0, square - self.square_doubt)),
        )


@dataclass(frozen=True)
class TimeStatistics:
    """Statistics of all recorded channels of a run.

    Arguments:
        edges: of the intervals (n + 1,) [s].
        channels: by name, shape (n, 8), see `COLUMNS`; means, ends and extremes in the unit of the channel.
    """

    edges: Series
    channels: Mapping[str, Series]
    _windows: dict[tuple[str, float, float], TimeWindow] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def lasts(self, after: float, until: float) -> bool:
        """Whether the run lasts at any time between two [s]; not if one of these is no number."""
        near = SAME * max(1.0, float(self.edges[-1]))
        return after <= min(until, float(self.edges[-1])) + near and until >= self.edges[0] - near

    def window(self, name: str, after: float, until: float) -> TimeWindow:
        """What a channel does between two times [s], as far as the run lasts, which it must, see `lasts`."""
        key = name, after, until
        if key not in self._windows:
            self._windows[key] = self._window(name, after, until)
        return self._windows[key]

    def _window(self, name: str, after: float, until: float) -> TimeWindow:
        edges, rows = self.edges, self.channels[name]
        begin, end = _edge(edges, max(after, edges[0])), _edge(edges, min(until, edges[-1]))
        first = min(int(np.searchsorted(edges, begin, "right")) - 1, len(rows) - 1)
        last = max(int(np.searchsorted(edges, end, "left")) - 1, first)
        chosen, durations = rows[first : last + 1].copy(), np.diff(edges[first : last + 2])
        parts = []
        for n in {0, last - first}:
            low, high = max(begin, edges[first + n]), min(end, edges[first + n + 1])
            if high - low < durations[n]:
                parts.append(_part(chosen[n], float(edges[first + n]), float(durations[n]), low, high))
                chosen[n], durations[n] = parts[-1].row, parts[-1].duration
        found, duration = TimeWindow(durations, chosen), float(durations.sum())
        mean = sum(part.duration * part.mean_doubt for part in parts) / duration
        apart = float(np.abs(chosen[:, MEAN] - found.mean).max())
        return found._replace(
            mean_doubt=mean,
            square_doubt=sum(part.duration * part.square_doubt for part in parts) / duration
            + 2.0 * apart * mean,
            least_doubt=max([0.0, *(found.least[0] - part.least for part in parts)]),
            greatest_doubt=max([0.0, *(part.greatest - found.greatest[0] for part in parts)]),
        )


class _Part(NamedTuple):
    """A part of an interval: its row and duration [s], what bounds its errors, and the interval's extremes."""

    row: Series
    duration: float
    mean_doubt: float
    square_doubt: float
    least: float
    greatest: float


def _part(row: Series, start: float, whole: float, low: float, high: float) -> _Part:
    """The part from `low` to `high` [s] of an interval that begins at `start` [s] and lasts `whole` [s]."""
    ends, bend = row[[FIRST, LAST]], row[MEAN] - 0.5 * (row[FIRST] + row[LAST])

    def parabola(x: Series) -> Series:
        found: Series = ends[0] * (1.0 - x) + ends[1] * x + 6.0 * bend * x * (1.0 - x)
        return found

    def moments(values: Series) -> tuple[float, float]:
        mean = float(GAUSS_WEIGHTS @ values)
        return mean, float(GAUSS_WEIGHTS @ (values - mean) ** 2)

    x = np.array([(low - start) / whole, (high - start) / whole])
    share = float(x[1] - x[0])
    values = parabola(np.concatenate([x[:1], x[0] + share * GAUSS, x[1:]]))
    mean, variance = moments(values[1:-1])
    unknown = row[VARIANCE] - moments(parabola(GAUSS))[1]  # what the parabola does not show
    found = np.array([mean, variance + max(0.0, unknown), *values[[0, -1]], *row[LEAST:]])
    places = np.concatenate([[low], low + (high - low) * GAUSS, [high]])
    for column, at in ((LEAST, int(values.argmin())), (GREATEST, int(values.argmax()))):
        if not (low < row[column + 1] or low == start) or row[column + 1] > high:
            found[column], found[column + 1] = values[at], places[at]
    # a deviation that integrates to zero over the whole: Schwarz's inequality
    doubt = math.sqrt(abs(unknown) * (1.0 - share) / share) if share > 0.0 else math.sqrt(abs(unknown))
    square = abs(unknown) / (share or 1.0)
    return _Part(found, high - low or 1.0, doubt, square, float(row[LEAST]), float(row[GREATEST]))


def statistics_of_records(time: Series, channels: Mapping[str, Series]) -> TimeStatistics:
    """What records say of channels, which are taken as straight lines between them: trapezoid weights.

    For runs of which nothing else is known. time: of the records (n,) [s]. channels: by name (n,).
    """
    found = {}
    for name, values in channels.items():
        first, last = values[:-1], values[1:]
        down, begins, ends = last < first, time[:-1], time[1:]
        columns = [0.5 * (first + last), (last - first) ** 2 / 12.0, first, last]
        columns += [np.minimum(first, last), np.where(down, ends, begins)]
        columns += [np.maximum(first, last), np.where(down | (first == last), begins, ends)]
        found[name] = np.column_stack(columns)
    return TimeStatistics(time, found)


def _edge(edges: Series, t: float) -> float:
    """A time [s], or the edge that it is but for rounding."""
    near = edges[int(np.abs(edges - t).argmin())]
    return float(near) if abs(near - t) <= SAME * max(1.0, abs(t)) else float(t)
