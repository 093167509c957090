"""Which times the solver lands on."""

import math
from bisect import bisect_left, bisect_right
from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

Series = npt.NDArray[np.float64]

CLOSE = 1e-9  # times closer than this share of a step are the same
# The shortest time that is worth a step of its own. Constraints hold positions, which are rounded;
# accelerations are their differences over the step's square, so that in a step h rounding r leaves r/h^2 of
# them. Who does not solve there but moves on by the rates that the last step has ended with, misses by how much
# accelerations change: a h/T of those that count, a, with T the shortest time scale. Both are alike for
#     h^3 = r T / a
# and below that a step makes worse what it is made for. The steps that are allowed follow the scene's shortest
# time scale, contacts and all, and stand for T; a is of the order of the weight's. No more than a share of
# those steps, for a scene may have steps that are as short themselves.
ACCELERATION = 10.0  # [m/s^2]
SHARE_OF_STEP = 0.1


def shortest_step(rounding: float, largest: float) -> float:
    """Time [s] below which a rest is not worth a step, where steps may be so long [s]; see above.

    rounding: of positions [m].
    """
    return min(SHARE_OF_STEP * largest, float(np.cbrt(rounding * largest / ACCELERATION)))


class StepPlan:
    """A grid of times: records and breaks are hit exactly, steps between them are equal.

    Arguments:
        duration: end time [s].
        record_period: time between records [s]; the end is a record too.
        step: largest step [s].
        breaks: further times to land on [s].
        rounding: of positions [m], see `shortest_step`.
    """

    def __init__(
        self,
        duration: float,
        record_period: float,
        step: float,
        breaks: Iterable[float],
        rounding: float = 0.0,
    ) -> None:
        self.duration = duration
        self.rounding = rounding
        self.record_period = record_period
        self.step = step
        self._rounding = 4.0 * math.ulp(duration)  # of times and their differences [s]
        # not below that, else a long run of tiny steps would not advance
        self._tolerance = max(CLOSE * min(step, record_period), self._rounding)
        # one that differs from the end by rounding only is the end
        self.breaks = sorted(t for t in set(breaks) if 0.0 <= t < duration - self._tolerance)
        self._around = (math.inf, math.inf)  # the stops last asked for [s]
        self._after_breaks = [self._settled(b) - self._tolerance for b in self.breaks]

    def next_time(self, t: float, largest: float = math.inf) -> float:
        """The next grid time after t [s]; on a finer grid if steps may not be larger than so [s]."""
        return self._grid_time(t, min(self.step, largest))

    def _settled(self, t: float) -> float:
        """End [s] of the first grid step after a break at t [s]; of a later one if a stop lies close behind."""
        end = self.next_time(t)
        while end < min(t + 0.5 * self.step, self.duration - self._tolerance):
            end = self.next_time(end)
        return end

    def far_time(self, t: float, size: float) -> float:
        """The last record that a step of this size [s] from t [s] reaches, not beyond a break.

        The next time of a grid of such steps if it reaches none.
        """
        passed = self._breaks_until(t)
        stop = self.breaks[passed] if passed < len(self.breaks) else self.duration
        reached = math.floor((t + size + self._tolerance) / self.record_period) * self.record_period
        if reached <= t + self._tolerance:
            return self._grid_time(t, size)
        return reached if reached < stop - self._tolerance else stop

    def records_between(self, start: float, end: float) -> list[float]:
        """The records after one time and before another [s], both excluded."""
        first = math.floor((start + self._tolerance) / self.record_period) + 1
        last = math.ceil((end - self._tolerance) / self.record_period)
        return [n * self.record_period for n in range(first, last)]

    def _grid_time(self, t: float, largest: float) -> float:
        if t >= self.duration - self._tolerance:
            return self.duration
        before, after = self._stops_around(t)
        parts, size = self._parts(before, after, largest)
        done = math.floor((t - before + self._tolerance) / size)
        following = after if done + 1 >= parts else before + (done + 1) * size
        if following == after or following - t >= shortest_step(self.rounding, size):
            return following
        beyond = after if done + 2 >= parts else before + (done + 2) * size
        return 0.5 * (t + beyond)  # an event lay just before a time of the grid: two steps, and none too long

    def rest(self, t: float, largest: float = math.inf) -> float | None:
        """The stop just after t [s] that is not worth a step of its own; None if there is none.

        largest: step that is allowed there [s].
        """
        if t >= self.duration - self._tolerance:
            return None
        after, allowed = self._stops_around(t)[1], min(self.step, largest)
        if after - t >= SHARE_OF_STEP * allowed:  # nearly always, and every step asks
            return None
        return after if after - t < shortest_step(self.rounding, allowed) else None

    def _parts(self, before: float, after: float, largest: float) -> tuple[int, float]:
        """Number and size [s] of the equal steps between two stops [s]."""
        parts = max(1, math.ceil((after - before - self._rounding) / largest - CLOSE))
        return parts, (after - before) / parts

    def follows_break(self, t: float) -> bool:
        """Whether t [s] lies in the first grid step after a break, its end excluded; see `_settled`."""
        passed = self._breaks_until(t)
        return passed > 0 and t < self._after_breaks[passed - 1]

    def _breaks_until(self, t: float) -> int:
        """How many breaks are not after t [s]. There may be thousands, and every step asks."""
        return bisect_right(self.breaks, t + self._tolerance)

    def passes_record(self, start: float, end: float) -> bool:
        """Whether a step from one time to another [s] reaches beyond the first record or break after it."""
        return end > self._stops_around(start)[1] + self._tolerance

    def record_at(self, t: float) -> float | None:
        """The record that t [s] is but for rounding, if it is one: a multiple of the period, or the end [s]."""
        if abs(t - self.duration) <= self._tolerance:
            return self.duration
        record = round(t / self.record_period) * self.record_period
        return record if abs(t - record) <= self._tolerance else None

    def breaks_at(self, t: float) -> list[float]:
        """The breaks that time t [s] is: several may differ by rounding."""
        first = bisect_left(self.breaks, t - 2.0 * self._tolerance)
        near = self.breaks[first : self._breaks_until(t) + 1]
        return [b for b in near if abs(t - b) <= self._tolerance]

    def _stops_around(self, t: float) -> tuple[float, float]:
        """The last stop (record or break) not after t, and the first after it [s]."""
        before, after = self._around
        if not before <= t < after - 2.0 * self._tolerance:
            self._around = self._find_stops(t)
        return self._around

    def _find_stops(self, t: float) -> tuple[float, float]:
        n = math.floor((t + self._tolerance) / self.record_period)
        before, after = n * self.record_period, min((n + 1) * self.record_period, self.duration)
        passed = self._breaks_until(t)
        if passed:
            before = max(before, self.breaks[passed - 1])
        if passed < len(self.breaks):
            after = min(after, self.breaks[passed])
        if self.duration - after <= self._tolerance:
            after = self.duration
        return before, after


def record_times(duration: float, period: float) -> Series:
    """Times of the records [s]: multiples of the period from 0 on, and the end."""
    count = math.floor(duration / period + 1e-9)
    times: Series = np.arange(count + 1, dtype=np.float64) * period
    if duration - times[-1] > 1e-9 * period:
        return np.append(times, duration)
    times[-1] = duration
    return times
