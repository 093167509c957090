"""What is written down of a run: records and the largest force."""

import math

from support_exudyn.formulations.compilation import compiled
from support_exudyn.formulations.compiled.closed_forms.equations import observe, within
from support_exudyn.formulations.compiled.closed_forms.layout import (
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
    Matrix,
    Vector,
    driven,
)
from support_exudyn.formulations.peak_force import (
    GOLDEN,
    NARROWINGS,
    NEAR_PEAK,
    NEAR_TOP,
    PEAK_SAMPLES,
)


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
def force_at(
    p: Vector,
    segment: Vector,
    memory: Vector,
    t: float,
    h: float,
    x: float,
    path: Matrix,
    y: Vector,
    there: Vector,
) -> float:
    """Magnitude of the contact force [N] at a fraction x of a step; y and there are overwritten."""
    within(path, x, y)
    observe(p, segment, memory, t + x * h, y, there)
    return size(there)


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
) -> tuple[float, float]:
    """The largest force [N] so far, a step in contact included, and its time [s] if it is in the step.

    Of a step with forces near the largest so far, first and last [N] at its ends: that at points between, and
    the highest between these, which may be a corner (where what limits the damping changes). y and there are
    overwritten.
    """
    if max(first, last) <= NEAR_PEAK * largest:
        return largest, t
    top, at = first, 0
    for n in range(1, PEAK_SAMPLES + 1):
        force = last
        if n < PEAK_SAMPLES:
            force = force_at(p, segment, memory, t, h, n / PEAK_SAMPLES, path, y, there)
        if force > top:
            top, at = force, n
    if top <= NEAR_TOP * largest:
        return largest, t
    best = at / PEAK_SAMPLES
    low, high = max(0.0, (at - 1) / PEAK_SAMPLES), min(1.0, (at + 1) / PEAK_SAMPLES)
    for _ in range(NARROWINGS):
        one, other = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        at_one = force_at(p, segment, memory, t, h, one, path, y, there)
        at_other = force_at(p, segment, memory, t, h, other, path, y, there)
        if at_one > top:
            top, best = at_one, one
        if at_other > top:
            top, best = at_other, other
        if at_one > at_other:
            high = other
        else:
            low = one
    return max(largest, top), t + best * h


@compiled
def size(contact: Vector) -> float:
    """Magnitude of the contact force [N]."""
    return math.hypot(contact[NORMAL], contact[FRICTION])
