"""Between the ends of steps: integrals over time of powers, and states for records inside a step."""

from collections.abc import Sequence
from typing import NamedTuple

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


def between(start: StepEnd, end: StepEnd, t: float) -> StepEnd:
    """The state at a time t [s] inside a step.

    Positions are the quintic that fits positions, velocities and accelerations at both ends; velocities and
    integrals the cubics that fit them and their rates; all else is a straight line.
    """
    h = end.time - start.time
    x = (t - start.time) / h
    return StepEnd(
        t,
        _quintic(x, h, start, end),
        _cubic(x, h, (start.velocity, start.acceleration), (end.velocity, end.acceleration)),
        _line(x, start.acceleration, end.acceleration),
        _line(x, start.memory, end.memory),
        _cubic(x, h, (start.totals, start.powers), (end.totals, end.powers)),
        _line(x, start.powers, end.powers),
    )


def _line(x: float, first: Series, second: Series) -> Series:
    """Between the values at x = 0 and x = 1."""
    return (1.0 - x) * first + x * second


def _cubic(x: float, h: float, first: tuple[Series, Series], second: tuple[Series, Series]) -> Series:
    """The cubic through values and rates at both ends of a step h [s], at the fraction x of it."""
    y = 1.0 - x
    values = y * y * (1.0 + 2.0 * x) * first[0] + x * x * (3.0 - 2.0 * x) * second[0]
    return values + h * x * y * (y * first[1] - x * second[1])


def _quintic(x: float, h: float, first: StepEnd, second: StepEnd) -> Series:
    """The quintic through positions, velocities and accelerations at both ends."""
    y = 1.0 - x
    positions = y**3 * (1.0 + 3.0 * x + 6.0 * x * x) * first.position
    positions += x**3 * (1.0 + 3.0 * y + 6.0 * y * y) * second.position
    velocities = y**3 * x * (1.0 + 3.0 * x) * first.velocity - x**3 * y * (1.0 + 3.0 * y) * second.velocity
    accelerations = y**3 * x * x * first.acceleration + x**3 * y * y * second.acceleration
    return positions + h * velocities + 0.5 * h * h * accelerations
