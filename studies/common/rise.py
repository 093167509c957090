"""What is measured of a rise: posture, force and shaking, in the same words for every study.

Means, spreads and extremes of channels are taken from every step of a run; of what is computed from several
channels, such as a departure from another run, they are integrals by the trapezoidal rule through the records.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
import numpy.typing as npt

from support_exudyn import Result

Series = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

Measure = Callable[[Result], float]
OfColumn = Callable[[Result, str], Series]  # an angle of a column [rad]

DEGREES = 180.0 / np.pi
TREND_WINDOW = 0.1  # [s]: slower is the trend, faster is fluctuation; the paper's contact shakes at 20 Hz
WINDOW_SHARE = 0.05  # of the motion: the window of a shorter one than the paper's
THIRDS = {"early": (0.05, 0.3), "middle": (0.375, 0.625), "late": (0.7, 0.95)}  # of the rise, less edges


@dataclass(frozen=True)
class Versus:
    """A measure of a run and of that of the ideal pin.

    missed: by how much it may be off because its times lie inside intervals of the statistics.
    """

    get: Callable[[Result, Result], float]
    missed: Callable[[Result, Result], float] = lambda run, ideal: 0.0


@dataclass(frozen=True)
class WholeNumber:
    """A measure of a run that is a whole number."""

    get: Callable[[Result], int]


@dataclass(frozen=True)
class Crest:
    """An extreme of a channel between two times, from every step.

    begin, end: [s]. extreme: "largest", of the magnitude, or "max" or "min", with its sign. scale: to the unit
    of the number.
    """

    channel: str
    scale: float = 1.0
    begin: float = 3.0
    end: float = 5.0
    extreme: Literal["largest", "max", "min"] = "largest"

    def __call__(self, run: Result) -> float:
        """The extreme, in the unit of the number."""
        window = run.window(self.channel, self.begin, self.end)
        taken = {"largest": window.largest, "max": window.greatest, "min": window.least}
        return self.scale * taken[self.extreme][0]

    def missed(self, run: Result) -> float:
        """By how much the extreme may be off because its times lie inside intervals of the statistics."""
        window = run.window(self.channel, self.begin, self.end)
        return self.scale * max(window.least_doubt, window.greatest_doubt)


def onset(pin: str, n: int, what: Literal["time", "speed"], scale: float = 1.0) -> Callable[[Result], float]:
    """The measure of an impact of a pin, the n-th from 0 on: its time [s] or its speed [m/s], scaled."""
    return lambda run: scale * float(getattr(run.onsets[pin][n], what))


def between(run: Result, begin: float, end: float) -> Mask:
    """Mask of the records between two times [s]."""
    return (run.time >= begin - 1e-9) & (run.time <= end + 1e-9)


def mean(time: Series, values: Series) -> float:
    """Mean over time: the integral from the first record to the last, divided by the time between them."""
    return float(np.diff(time) @ (values[1:] + values[:-1]) / (2.0 * (time[-1] - time[0])))


def trend(run: Result, values: Series, window: float = TREND_WINDOW) -> Series:
    """Moving mean over a window [s], centred, by the trapezoidal rule through the records, shape (n,).

    Beyond the first and the last record the values stay what they are there.
    """
    half = 0.5 * window / float(run.time[1] - run.time[0])  # of the window, in records
    beyond = int(half) + 1
    padded = np.pad(values, beyond, mode="edge")
    integral = np.concatenate([[0.0], np.cumsum(0.5 * (padded[1:] + padded[:-1]))])
    places, at = np.arange(padded.size), np.arange(values.size) + beyond
    before, after = (np.interp(at + side, places, integral) for side in (-half, half))
    return np.asarray((after - before) / (2.0 * half))


def rearward_angle(run: Result, column: str) -> Series:
    """Angle of a column as in Fig. 12 of the paper [rad]: between the column and the rearward horizontal.

    The only reading of its words that fits itself: tilting to the rear makes it smaller for both columns,
    brings a column that leans forward nearer to the vertical and takes one that leans to the rear away from it.
    """
    return np.pi - run[f"{column}.angle"]


def lean(run: Result, column: str) -> Series:
    """How far a column is from the vertical [rad], >= 0."""
    return np.abs(run[f"{column}.angle"] - 0.5 * np.pi)


@dataclass(frozen=True)
class Watched:
    """What is looked at in a machine's motion: a pin, the body that it guides, and when it moves.

    start, end: of the motion [s].
    """

    pin: str
    body: str
    start: float
    end: float

    @property
    def window(self) -> float:
        """The time [s] over which the trend is a moving mean; so much is left out at both ends."""
        return min(TREND_WINDOW, WINDOW_SHARE * (self.end - self.start))

    @property
    def force(self) -> str:
        """The channel of the pin's force."""
        return f"pin.{self.pin}.force"

    @property
    def speed(self) -> str:
        """The channel of the body's angular velocity."""
        return f"{self.body}.angular_velocity"

    @property
    def acceleration(self) -> str:
        """The channel of the body's angular acceleration."""
        return f"{self.body}.angular_acceleration"

    @cached_property
    def stages(self) -> dict[str, tuple[float, float]]:
        """Thirds of the motion, less edges [s]."""
        length = self.end - self.start
        return {name: (self.start + a * length, self.start + b * length) for name, (a, b) in THIRDS.items()}

    def in_rise(self, run: Result) -> Mask:
        """Mask of the records of the motion."""
        return between(run, self.start, self.end)

    def peak(self, channel: str, scale: float = 1.0) -> Crest:
        """The measure of the largest magnitude of a channel in the motion."""
        return Crest(channel, scale, self.start, self.end)

    def mean(self, run: Result, quantity: str | Series) -> float:
        """Mean over the motion's time of a channel, or of a quantity given at all records, in its unit."""
        if isinstance(quantity, str):
            return run.window(quantity, self.start, self.end).mean
        inside = self.in_rise(run)
        return mean(run.time[inside], quantity[inside])

    def rms_fluctuation(
        self, run: Result, values: Series, begin: float | None = None, end: float | None = None
    ) -> float:
        """Fluctuation: root mean square of a quantity less its trend, between two times, in its unit.

        Within a window of the ends of the rise, left out by default, the trend leans on what is inside.
        """
        begin = self.start + self.window if begin is None else begin
        inside = between(run, begin, self.end - self.window if end is None else end)
        fast = (values - self._trend(run, values))[inside]
        return float(np.sqrt(mean(run.time[inside], fast**2)))

    def likeness(self, run: Result, other: Result, channel: str) -> float:
        """Correlation of the trends of two runs over the rise: 1 if they have the same course."""
        begin, end = self.start + self.window, self.end - self.window
        mine = self._trend(run, run[channel])[between(run, begin, end)]
        its = self._trend(other, other[channel])[between(other, begin, end)]
        return float(np.corrcoef(mine, its)[0, 1])

    def _trend(self, run: Result, values: Series) -> Series:
        """Trend of what happens in the rise: what was before it does not enter."""
        rise = self.in_rise(run)
        result = np.zeros_like(values)
        result[rise] = trend(run, values[rise], self.window)
        return result

    def departure(self, run: Result, ideal: Result, channel: str) -> Series:
        """A channel less that of the ideal pin, record by record over the rise."""
        less: Series = run[channel][self.in_rise(run)] - ideal[channel][self.in_rise(ideal)]
        return less

    # --- measures, for tables of them; scale: to the unit of the number ---

    def mean_of(self, channel: str, scale: float = 1.0) -> Measure:
        """The measure of a channel's mean over the motion."""
        return lambda run: scale * self.mean(run, channel)

    def spread_of(self, channel: str, scale: float = 1.0) -> Measure:
        """The measure of a channel's standard deviation over the motion."""
        return lambda run: scale * run.window(channel, self.start, self.end).std

    def stage_mean_of(self, channel: str, stage: str, scale: float = 1.0) -> Measure:
        """The measure of a channel's mean magnitude over a stage of the motion."""

        def get(run: Result) -> float:
            inside = between(run, *self.stages[stage])
            return scale * mean(run.time[inside], np.abs(run[channel][inside]))

        return get

    def fluctuation_of(self, channel: str, scale: float = 1.0, *times: float) -> Measure:
        """The measure of a channel's fluctuation; times: from when to when [s], see `rms_fluctuation`."""
        return lambda run: scale * self.rms_fluctuation(run, run[channel], *times)

    def extent_of(self, channel: str, scale: float = 1.0) -> Measure:
        """The measure of the distance of a channel's largest from its smallest record in the motion."""
        return lambda run: scale * float(np.ptp(run[channel][self.in_rise(run)]))

    def shift_of(self, channel: str, scale: float = 1.0, power: float = 1.0) -> Versus:
        """The measure of a channel's mean distance from that of the ideal pin; power 2: root mean square."""

        def get(run: Result, ideal: Result) -> float:
            values = self.departure(run, ideal, channel) ** power
            return float(scale * mean(run.time[self.in_rise(run)], values) ** (1.0 / power))

        return Versus(get)


PAPER = Watched("rear_base", "rear_link", 3.0, 5.0)  # the paper's pin and rise
FORCE, SPEED, ACCELERATION = PAPER.force, PAPER.speed, PAPER.acceleration
START, END, STAGES = PAPER.start, PAPER.end, PAPER.stages
