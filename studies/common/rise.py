"""What is measured of a rise: posture, force and shaking, in the same words for every study.

A run is anything that hands out channels by name (`support_exudyn.Result` and others). The rise lasts from 3 to
5 s; records lie every millisecond.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
import numpy.typing as npt

from studies.common import paper_machine
from support_exudyn import Result
from support_exudyn.mechanics.extremes import largest, missed

Series = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

DEGREES = 180.0 / np.pi
FORCE = f"pin.{paper_machine.CLEARANCE_PIN}.force"
SPEED = "rear_link.angular_velocity"
ACCELERATION = "rear_link.angular_acceleration"
START, END = 3.0, 5.0  # of the rise [s]
TREND_WINDOW = (
    0.1  # [s]: what is slower is the trend, what is faster is fluctuation; the contact shakes at 20 Hz
)
EDGE = TREND_WINDOW  # left out at both ends of the rise, where no window fits [s]
STAGES = {"early": (3.1, 3.6), "middle": (3.75, 4.25), "late": (4.4, 4.9)}  # thirds of the rise, less edges [s]


class MeasuredRun(Protocol):
    """What a measure needs of a run."""

    @property
    def time(self) -> Series:
        """Times of the records [s], shape (n,)."""
        ...

    def __getitem__(self, name: str) -> Series:
        """Values of a channel in SI, shape (n,)."""
        ...


Measure = Callable[[MeasuredRun], float]


TAKEN: dict[str, Callable[[Series], float]] = {
    "largest": largest,
    "max": lambda values: float(values.max()),
    "min": lambda values: float(values.min()),
}


@dataclass(frozen=True)
class Peak:
    """An extreme of a channel at the records between two times; what lies between these is part of its error.

    extreme: "largest", of the magnitude, or "max" or "min", with its sign. scale: to the unit of the number.
    """

    channel: str
    scale: float = 1.0
    begin: float = START
    end: float = END
    extreme: Literal["largest", "max", "min"] = "largest"

    def __call__(self, run: MeasuredRun) -> float:
        """The extreme, in the unit of the number."""
        return self.scale * TAKEN[self.extreme](run[self.channel][between(run, self.begin, self.end)])

    def missed(self, run: Result) -> float:
        """The amount by which a peak may be exceeded between records."""
        inside = between(run, self.begin, self.end)
        values, time = run[self.channel][inside], run.time[inside]
        return self.scale * missed(self.extreme, values, time, run.scenario.breaks)


def onset(pin: str, n: int, what: Literal["time", "speed"], scale: float = 1.0) -> Callable[[Result], float]:
    """The measure of an impact of a pin, the n-th from 0 on: its time [s] or its speed [m/s], scaled."""
    return lambda run: scale * float(getattr(run.onsets[pin][n], what))


def between(run: MeasuredRun, begin: float, end: float) -> Mask:
    """Mask of the records between two times [s]."""
    return (run.time >= begin - 1e-9) & (run.time <= end + 1e-9)


def in_rise(run: MeasuredRun) -> Mask:
    """Mask of the records of the rise."""
    return between(run, START, END)


def trend(run: MeasuredRun, values: Series) -> Series:
    """Moving mean over TREND_WINDOW, centred, shape (n,)."""
    period = float(run.time[1] - run.time[0])
    from scipy.ndimage import uniform_filter1d  # takes a while to import

    return uniform_filter1d(values, 2 * round(0.5 * TREND_WINDOW / period) + 1, mode="nearest")


def rms_fluctuation(
    run: MeasuredRun, values: Series, begin: float = START + EDGE, end: float = END - EDGE
) -> float:
    """Fluctuation: root mean square of a quantity less its trend, between two times, in its unit.

    Within EDGE of the ends of the rise the trend leans on what is inside it.
    """
    inside = between(run, begin, end)
    fast = (values - _trend_of_rise(run, values))[inside]
    return float(np.sqrt(np.mean(fast**2)))


def likeness(run: MeasuredRun, other: MeasuredRun, channel: str) -> float:
    """Correlation of the trends of two runs over the rise: 1 if they have the same course."""
    mine = _trend_of_rise(run, run[channel])[between(run, START + EDGE, END - EDGE)]
    its = _trend_of_rise(other, other[channel])[between(other, START + EDGE, END - EDGE)]
    return float(np.corrcoef(mine, its)[0, 1])


def _trend_of_rise(run: MeasuredRun, values: Series) -> Series:
    """Trend of what happens in the rise: what was before it does not enter."""
    rise = in_rise(run)
    result = np.zeros_like(values)
    result[rise] = trend(run, values[rise])
    return result


def stage_mean(run: MeasuredRun, channel: str, stage: str) -> float:
    """Mean magnitude of a channel over a stage of the rise, in its unit."""
    return float(np.abs(run[channel][between(run, *STAGES[stage])]).mean())


def departure(run: MeasuredRun, ideal: MeasuredRun, channel: str) -> Series:
    """A channel less that of the ideal pin, record by record over the rise."""
    return run[channel][in_rise(run)] - ideal[channel][in_rise(ideal)]


def rearward_angle(run: MeasuredRun, column: str) -> Series:
    """Angle of a column as in Fig. 12 of the paper [rad]: between the column and the rearward horizontal.

    The only reading of its words that fits itself: tilting to the rear makes it smaller for both columns,
    brings a column that leans forward nearer to the vertical and takes one that leans to the rear away from it.
    """
    return np.pi - run[f"{column}.angle"]


def lean(run: MeasuredRun, column: str) -> Series:
    """How far a column is from the vertical [rad], >= 0."""
    return np.abs(run[f"{column}.angle"] - 0.5 * np.pi)
