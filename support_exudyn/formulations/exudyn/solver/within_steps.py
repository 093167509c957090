"""Between the ends of steps: integrals over time of powers, and states for records inside a step."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from support_exudyn.mechanics.trajectory import Series


class RunningIntegrals:
    """Integrals over time of several quantities.

    Over each step a quantity is taken as the parabola through its last three values, so the error is of
    third order; just after `restart` as a straight line. Steps may differ.

    Arguments:
        number: of quantities.
    """

    def __init__(self, number: int) -> None:
        self.totals = [0.0] * number
        self._last: tuple[float, Sequence[float]] | None = None  # time and values
        self._jump: float | None = None  # time after which the quantities are other than before
        self._before: tuple[float, Sequence[float]] | None = None

    def restart(self) -> None:
        """The quantities have a kink here: do not use what was before the last values."""
        self._before = None

    def jump(self, t: float) -> None:
        """The quantities jump at t [s], the end of the last step."""
        self._before = self._last = None
        self._jump = t

    def add(self, t: float, values: Sequence[float]) -> None:
        """The quantities' values at the end of a step, t [s]."""
        if self._jump is not None:  # all that is known of the first step after a jump is its end
            for n, value in enumerate(values):
                self.totals[n] += (t - self._jump) * value
            self._jump = None
        elif self._last is not None:
            t1, last = self._last
            h2 = t - t1
            if self._before is not None and (h1 := t1 - self._before[0]) > 0.25 * h2:
                w2 = h2 * (2.0 * h2 + 3.0 * h1) / (6.0 * (h1 + h2))
                w1 = h2 * (h2 + 3.0 * h1) / (6.0 * h1)
                w0 = h2 * h2 * h2 / (6.0 * h1 * (h1 + h2))
                for n, before in enumerate(self._before[1]):
                    self.totals[n] += w2 * values[n] + w1 * last[n] - w0 * before
            else:
                for n, value in enumerate(values):
                    self.totals[n] += 0.5 * h2 * (last[n] + value)
        self._before, self._last = self._last, (t, values)


class StepEnd(NamedTuple):
    """State of a run at an end of a step.

    time: [s]. position, velocity, acceleration (coordinates,). memory (clearance pins, fields of PinMemory).
    totals (3,): integrals over time [J]. powers (3,): their rates [W].
    """

    time: float
    position: Series
    velocity: Series
    acceleration: Series
    memory: Series
    totals: Series
    powers: Series


def between(start: StepEnd, end: StepEnd, t: float) -> tuple[Series, Series, Series, Series]:
    """Position, velocity, memory and totals at a time t [s] inside a step.

    Positions are the quintic that fits positions, velocities and accelerations at both ends; velocities and
    totals the cubics that fit them and their rates; memory is a straight line.
    """
    h = end.time - start.time
    x = (t - start.time) / h
    first, second = (one[1:4] for one in (start, end))
    return (
        hermite(x, h, first, second),
        hermite(x, h, first[1:], second[1:]),
        hermite(x, h, (start.memory,), (end.memory,)),
        hermite(x, h, (start.totals, start.powers), (end.totals, end.powers)),
    )


def hermite(x: float, h: float, first: Sequence[Series], second: Sequence[Series]) -> Series:
    """The polynomial through values and as many derivatives at both ends of a step h [s], at its fraction x."""
    count, total = len(first), np.zeros_like(first[0])
    for u, ends, step in ((x, first, h), (1.0 - x, second, -h)):
        for k, derivative in enumerate(ends):
            series = sum(math.comb(count - 1 + i, i) * u**i for i in range(count - k))
            total += (1.0 - u) ** count * series * (step * u) ** k / math.factorial(k) * derivative
    return total
