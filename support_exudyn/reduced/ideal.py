"""The run of a support with ideal pins: the posture follows from the columns alone."""

from __future__ import annotations

import math

from support_exudyn.reduced.compiled import compiled, entry
from support_exudyn.reduced.integrate import (
    CLOSE,
    EVALUATIONS,
    FINISHED,
    JUMPS,
    STEPS,
    STOPPED_AT,
    STUCK,
)
from support_exudyn.reduced.layout import (
    BEGIN,
    CANOPY,
    CANOPY_RATE,
    END,
    JUMP,
    LINK,
    LINK_RATE,
)
from support_exudyn.reduced.posture import Drive, Vector, driven, posture, rates
from support_exudyn.reduced.records import held_still, jump, record_ideal
from support_exudyn.reduced.runge_kutta import Matrix

ITERATIONS = 30
CLOSED = 1e-14  # [m], some ten times the rounding of the posture
LARGEST_STROKE = 0.01  # [m] of the columns from one posture to the next, so that Newton's method stays near


@compiled
def close_pin(p: Vector, extension: float, y: Vector, report: Vector) -> bool:
    """Turn canopy and rear link of the state y until the pin closes; whether it did."""
    least = math.inf
    for _ in range(ITERATIONS):
        at = posture(p, y[CANOPY], y[LINK], extension)
        report[EVALUATIONS] += 1
        miss = math.hypot(at.offset_x, at.offset_y)
        if miss <= CLOSED or (miss < 1e-12 and miss >= least):
            return True
        if not miss < 1.0:
            return False
        least = miss
        canopy, link = held_still(at, at.offset_x, at.offset_y)
        y[CANOPY] += canopy
        y[LINK] += link
    return False


@compiled
def follow(p: Vector, drive: Drive, before: float, y: Vector, report: Vector) -> bool:
    """Bring the state y from an extension `before` [m] to where the drive is; whether the linkage closes."""
    parts = math.ceil(abs(drive.extension - before) / LARGEST_STROKE) + 1
    for n in range(1, parts + 1):
        if not close_pin(p, before + (drive.extension - before) * n / parts, y, report):
            return False
    at = posture(p, y[CANOPY], y[LINK], drive.extension)
    moved = rates(p, at, 0.0, 0.0, drive.extension, drive.speed)
    y[CANOPY_RATE], y[LINK_RATE] = held_still(at, moved.end_x, moved.end_y)
    return True


@entry
def run_ideal(
    p: Vector, segments: Matrix, times: Vector, y: Vector, rows: Matrix, jumps: Matrix, report: Vector
) -> int:
    """Fill the records; FINISHED, or STUCK where the linkage does not close. Arguments as of `integrate`."""
    record_ideal(p, segments[0], 0.0, y, rows, 0)
    record, extension = 1, 0.0
    for n in range(segments.shape[0]):
        segment = segments[n]
        if segment[JUMP] != 0.0:
            jump(p, segment, y, True, jumps, int(report[JUMPS]))
            report[JUMPS] += 1
        t, stop = segment[BEGIN], segment[END]
        while t < stop:
            t = stop
            due = record < times.size and times[record] <= stop + CLOSE
            if due:
                t = times[record]
            drive = driven(segment, t)
            report[STOPPED_AT] = t
            report[STEPS] += 1
            if not follow(p, drive, extension, y, report):
                return STUCK
            extension = drive.extension
            if due:
                record_ideal(p, segment, t, y, rows, record)
                record += 1
    return FINISHED
