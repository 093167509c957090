"""States inside a step, for records that a long step passes over."""

from __future__ import annotations

from typing import NamedTuple

from support_exudyn.mechanics.trajectory import Series


class StepEnd(NamedTuple):
    """State of a run at an end of a step.

    time: [s]. position, velocity, acceleration (coordinates,). memory (loose pins, fields of PinMemory).
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
