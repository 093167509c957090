"""Which times the solver lands on."""

from __future__ import annotations

import math
from collections.abc import Iterable

CLOSE = 1e-9  # times closer than this share of a step are the same


class StepPlan:
    """A grid of times: records and breaks are hit exactly, steps between them are equal.

    Arguments:
        duration: end time [s].
        record_period: time between records [s]; the end is a record too.
        step: largest step [s].
        breaks: further times to land on [s].
    """

    def __init__(self, duration: float, record_period: float, step: float, breaks: Iterable[float]) -> None:
        self.duration = duration
        self.record_period = record_period
        self.step = step
        self.breaks = sorted(t for t in set(breaks) if 0.0 <= t < duration)
        # not below the rounding of times, else a long run of tiny steps would not advance
        self._tolerance = max(CLOSE * min(step, record_period), 4.0 * math.ulp(duration))
        self._after_breaks = [(b, self.next_time(b) - self._tolerance) for b in self.breaks]

    def next_time(self, t: float, largest: float = math.inf) -> float:
        """The next grid time after t [s]; on a finer grid if steps may not be larger than so [s]."""
        if t >= self.duration - self._tolerance:
            return self.duration
        before, after = self._stops_around(t)
        parts = max(1, math.ceil((after - before) / min(self.step, largest) - CLOSE))
        size = (after - before) / parts
        done = math.floor((t - before + self._tolerance) / size)
        return after if done + 1 >= parts else before + (done + 1) * size

    def follows_break(self, t: float) -> bool:
        """Whether t [s] lies in the first grid step after a break, its end excluded."""
        return any(b - self._tolerance <= t < end for b, end in self._after_breaks)

    def is_record(self, t: float) -> bool:
        """Whether time t [s] is one of the records."""
        if abs(t - self.duration) <= self._tolerance:
            return True
        n = round(t / self.record_period)
        return abs(t - n * self.record_period) <= self._tolerance

    def break_at(self, t: float) -> float | None:
        """The break that time t [s] is, if it is one."""
        for b in self.breaks:
            if abs(t - b) <= self._tolerance:
                return b
        return None

    def _stops_around(self, t: float) -> tuple[float, float]:
        """The last stop (record or break) not after t, and the first after it [s]."""
        n = math.floor((t + self._tolerance) / self.record_period)
        before, after = n * self.record_period, min((n + 1) * self.record_period, self.duration)
        for b in self.breaks:
            if before < b <= t + self._tolerance:
                before = b
            elif t + self._tolerance < b < after:
                after = b
        if self.duration - after <= self._tolerance:
            after = self.duration
        return before, after
