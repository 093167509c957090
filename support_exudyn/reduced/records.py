"""What is written down of a run: records and the largest force."""

from __future__ import annotations

import math

from support_exudyn.compiled import compiled
from support_exudyn.reduced.drive import Matrix, Vector, driven
from support_exudyn.reduced.equations import observe
from support_exudyn.reduced.layout import (
    ACCELERATION,
    EXTENSION,
    FRICTION,
    MEMORY,
    MEMORY_ROW,
    NORMAL,
    SPEED,
    STATE_ROW,
    STATES,
    TIME,
)
from support_exudyn.reduced.runge_kutta import within

PEAK_SAMPLES = 8
NEAR_PEAK = 0.8  # share of the largest force so far from which a step is looked at more closely


@compiled
def record(segment: Vector, memory: Vector, t: float, y: Vector, rows: Matrix, n: int) -> None:
    """Write a record of state and memory at t [s] into column n."""
    rows[TIME, n] = t
    for i in range(STATES):
        rows[STATE_ROW + i, n] = y[i]
    for i in range(MEMORY):
        rows[MEMORY_ROW + i, n] = memory[i]
    drive = driven(segment, t)
    rows[EXTENSION, n], rows[SPEED, n], rows[ACCELERATION, n] = drive


@compiled
def peak(
    p: Vector,
    segment: Vector,
    memory: Vector,
    t: float,
    h: float,
    path: Matrix,
    largest: float,
    first: float,
    last: float,
    y: Vector,
    there: Vector,
) -> float:
    """The largest force [N] so far, a step in contact included whose ends have the forces first and last [N].

    Of a step with forces near the largest so far: that at points between, and the top of the parabola through
    three of them, wherever it lies between these. y and there are overwritten.
    """
    if max(first, last) <= NEAR_PEAK * largest:
        return largest
    a, b = first, first
    for n in range(1, PEAK_SAMPLES + 1):
        c = last
        if n < PEAK_SAMPLES:
            x = n / PEAK_SAMPLES
            within(path, x, y)
            observe(p, segment, memory, t + x * h, y, there)
            c = size(there)
        largest = max(largest, c)
        bend = 2.0 * b - a - c
        if n > 1 and bend > 0.0 and abs(c - a) <= 2.0 * bend:  # the top is not beyond its neighbours
            largest = max(largest, b + 0.125 * (c - a) * (c - a) / bend)
        a, b = b, c
    return largest


@compiled
def size(contact: Vector) -> float:
    """Magnitude of the contact force [N]."""
    return math.hypot(contact[NORMAL], contact[FRICTION])
