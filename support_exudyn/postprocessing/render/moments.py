"""At what times frames are taken, and which records they show."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.trajectory import Series
from user_forces.values.value import InputError

MOST_FRAMES = 20_000
SLOWEST, FASTEST = 1e-6, 1e3
MOST_A_SECOND = 240.0
LONGEST_STEP = 1e-3  # [s] to which the time of a single picture is printed at least


@dataclass(frozen=True)
class Moments:
    """Of frames.

    Frames need not be at records: each shows the record next to its time, for between records nobody knows
    whether a journal has touched. In slow motion one record may so be seen in several frames.

    Arguments:
        times: of the frames [s].
        records: that they show.
        time: of all records [s].
        step: between frames [s] of the run.
        rate: frames in a second of the movie.
        shown: what of the run is drawn over time, from and to [s].
    """

    times: Series
    records: npt.NDArray[np.intp]
    time: Series
    step: float
    rate: float
    shown: tuple[float, float]

    @property
    def pace(self) -> str:
        """What is said of the movie's speed; nothing at the run's."""
        speed = self.step * self.rate
        if self.times.size == 1 or abs(speed - 1.0) < 1e-9:
            return ""
        return f"{1.0 / speed:.4g} \u00d7 slower" if speed < 1.0 else f"{speed:.4g} \u00d7 faster"

    @property
    def decimals(self) -> int:
        """With how many the time is printed, so that it differs from frame to frame; 3 to 7."""
        return min(7, max(3, math.ceil(-math.log10(max(self.step, 1e-9)) - 1e-9)))

    def back(self, number: int, seconds: float) -> int:
        """The record that lies so many seconds of the movie before a frame, or that of the first frame."""
        past = max(self.times[number] - seconds * self.rate * self.step, self.times[0])
        return min(int(np.searchsorted(self.time, past)), int(self.records[number]))


def moments(time: Series, start: float | None, end: float | None, rate: float, speed: float) -> Moments:
    """Of the frames between two times of a run.

    Arguments:
        time: of the records [s].
        start, end: of the movie in the run's time [s]; None: of the run.
        rate: frames a second.
        speed: seconds of the run in a second of the movie; below 1 slow motion.

    Raises InputError if one of these is out of its range, or there would be too many frames.
    """
    check_between("frames_per_second", rate, 0.1, MOST_A_SECOND, "")
    check_between("speed", speed, SLOWEST, FASTEST, "")
    first, last = float(time[0]), float(time[-1])
    start = first if start is None else start
    end = last if end is None else end
    check_between("from", start, first, last, " s")
    check_between("until", end, first, last, " s")
    if end <= start and not time.size == 1:
        raise InputError(f"until = {end} s: allowed: later than the first frame, at {start} s")
    step = speed / rate
    number = math.floor((end - start) / step + 1e-9) + 1
    if number > MOST_FRAMES:
        raise InputError(
            f"{number} frames from {start} to {end} s at {rate:g} a second and speed {speed:g}; allowed: up to "
            f"{MOST_FRAMES}. Take a shorter time, a higher speed or fewer frames a second"
        )
    times = start + step * np.arange(number, dtype=np.float64)
    return Moments(times, nearest(time, times), time, step, rate, (start, end))


def moment(time: Series, at: float) -> Moments:
    """Of a single picture at a time [s]. Raises InputError if the run does not reach it."""
    check_between("time", at, float(time[0]), float(time[-1]), " s")
    times = np.array([at])
    step = min(LONGEST_STEP, float(np.median(np.diff(time)))) if time.size > 1 else LONGEST_STEP
    return Moments(times, nearest(time, times), time, step, 1.0, (float(time[0]), float(time[-1])))


def nearest(time: Series, asked: Series) -> npt.NDArray[np.intp]:
    """The records next to times."""
    after = np.clip(np.searchsorted(time, asked), 1, max(time.size - 1, 1))
    if time.size == 1:
        return np.zeros(asked.size, dtype=np.intp)
    return np.where(asked - time[after - 1] <= time[after] - asked, after - 1, after).astype(np.intp)


def check_between(name: str, number: float, low: float, high: float, unit: str) -> None:
    """Raise InputError unless a number is in its range."""
    if not low <= number <= high:
        raise InputError(f"{name} = {number:g}{unit}: allowed: {low:g} to {high:g}{unit}")
