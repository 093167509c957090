"""The run of a support with ideal pins: the posture follows from the columns alone."""

import math

from support_exudyn.formulations.compilation import compiled, entry
from support_exudyn.formulations.compiled.closed_forms.contact import closing_force, closing_rates
from support_exudyn.formulations.compiled.closed_forms.integrate import (
    EVALUATIONS,
    FINISHED,
    JUMPS,
    RECORDS,
    STEPS,
    STOPPED_AT,
    STUCK,
)
from support_exudyn.formulations.compiled.closed_forms.layout import (
    BEGIN,
    END,
    FIRST,
    FIRST_RATE,
    JUMP,
    SECOND,
    SECOND_RATE,
    WORK,
    DriveValues,
    Matrix,
    Vector,
    driven,
)
from support_exudyn.formulations.compiled.closed_forms.records import record
from support_exudyn.formulations.compiled.closed_forms.support import (
    balance,
    closed,
    column_forces,
    jump,
    pin_state,
    rear_pin,
    unforced,
)
from support_exudyn.formulations.compiled.closed_forms.support_posture import posture, rates
from support_exudyn.formulations.compiled.step_control import CLOSE

ITERATIONS = 30
CLOSED = 1e-14  # [m], some ten times the rounding of the posture
LARGEST_STROKE = 0.01  # [m] of the columns from one posture to the next, so that Newton's method stays near


@compiled
def close_pin(p: Vector, extension: float, y: Vector, report: Vector) -> bool:
    """Turn canopy and rear link of the state y until the pin closes; whether it did."""
    least = math.inf
    for _ in range(ITERATIONS):
        pin = pin_state(p, DriveValues(extension, 0.0, 0.0), y)
        report[EVALUATIONS] += 1
        miss = math.hypot(pin.x, pin.y)
        if miss <= CLOSED or (miss < 1e-12 and miss >= least):
            return True
        if not miss < 1.0:
            return False
        least = miss
        canopy, link = closing_rates(pin, pin.x, pin.y)
        y[FIRST] += canopy
        y[SECOND] += link
    return False


@compiled
def follow(p: Vector, drive: DriveValues, before: float, y: Vector, report: Vector) -> bool:
    """Bring the state y from an extension `before` [m] to where the drive is; whether the linkage closes."""
    parts = math.ceil(abs(drive.extension - before) / LARGEST_STROKE) + 1
    for n in range(1, parts + 1):
        if not close_pin(p, before + (drive.extension - before) * n / parts, y, report):
            return False
    y[FIRST_RATE] = y[SECOND_RATE] = 0.0
    pin = pin_state(p, drive, y)
    y[FIRST_RATE], y[SECOND_RATE] = closing_rates(pin, pin.vx, pin.vy)
    return True


@compiled
def power(p: Vector, drive: DriveValues, y: Vector) -> float:
    """Power of the columns [W] in the state y, which belongs to the drive."""
    at = posture(p, y[FIRST], y[SECOND], drive.extension)
    rate = rates(p, at, y[FIRST_RATE], y[SECOND_RATE], drive.extension, drive.speed)
    pin = rear_pin(p, at, rate, y[SECOND_RATE])
    law = balance(p, at, rate, y[FIRST_RATE], y[SECOND_RATE], drive, 1.0)
    canopy, link = closed(pin, at, unforced(p, at, rate, y[FIRST_RATE], drive), y[SECOND_RATE])
    fx, fy = closing_force(pin, law, canopy, link)
    front, rear = column_forces(p, at, rate, y[FIRST_RATE], y[SECOND_RATE], canopy, link, drive, 1.0, fx, fy)
    return drive.speed * (front + rear)


@entry
def run_ideal(
    p: Vector,
    segments: Matrix,
    times: Vector,
    y: Vector,
    memory: Vector,
    rows: Matrix,
    jumps: Matrix,
    report: Vector,
) -> int:
    """Fill the records; FINISHED, or STUCK where the linkage does not close. Arguments as of `integrate`.

    The work of the drive is integrated by Simpson's rule from record to record.
    """
    # a drive that moves from the start on without a jump has been moving for long
    if segments[0, JUMP] == 0.0 and not follow(p, driven(segments[0], 0.0), 0.0, y, report):
        return STUCK
    recorded, extension = int(report[RECORDS]), 0.0
    record(segments[0], memory, 0.0, y, rows, recorded)
    recorded += 1
    for n in range(segments.shape[0]):
        segment = segments[n]
        if segment[JUMP] != 0.0:
            jump(p, segment, y, jumps, int(report[JUMPS]))
            report[JUMPS] += 1
        t, stop = segment[BEGIN], segment[END]
        drive = driven(segment, t)
        if not follow(p, drive, extension, y, report):
            return STUCK
        first, extension = power(p, drive, y), drive.extension
        while t < stop:
            begin, t = t, stop
            due = recorded < times.size and times[recorded] <= stop + CLOSE
            if due:
                t = times[recorded]
            report[STOPPED_AT] = t
            report[STEPS] += 1
            middle, drive = driven(segment, 0.5 * (begin + t)), driven(segment, t)
            if not follow(p, middle, extension, y, report):
                return STUCK
            between = power(p, middle, y)
            if not follow(p, drive, middle.extension, y, report):
                return STUCK
            last, extension = power(p, drive, y), drive.extension
            y[WORK] += (t - begin) * (first + 4.0 * between + last) / 6.0
            first = last
            if due:
                record(segment, memory, t, y, rows, recorded)
                recorded += 1
    return FINISHED
