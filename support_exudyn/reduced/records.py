"""What is written down of a run: records, jumps of the drive's speed, the largest force."""

from __future__ import annotations

import math

from support_exudyn.reduced.compiled import compiled
from support_exudyn.reduced.contact import contact_force
from support_exudyn.reduced.dynamics import (
    Motion,
    accelerations,
    balance,
    closing_force,
    column_forces,
    kinetic_energy,
    unforced,
)
from support_exudyn.reduced.equations import observe
from support_exudyn.reduced.layout import (
    BEGIN,
    CANOPY,
    CANOPY_ACCELERATION,
    CANOPY_RATE,
    CONTACT,
    CONTACT_ROW,
    EXTENSION,
    FORCE_X,
    FORCE_Y,
    FRICTION,
    FRONT_FORCE,
    FRONT_IMPULSE,
    HINGE_X,
    HINGE_Y,
    JUMP,
    JUMP_ENERGY,
    JUMP_TIME,
    LINK,
    LINK_ACCELERATION,
    LINK_RATE,
    MOMENT,
    NORMAL,
    REAR_FORCE,
    REAR_IMPULSE,
    STATE_ROW,
    STATES,
    TIME,
    TOUCH_SPEED,
    TOUCH_SPEED_ROW,
)
from support_exudyn.reduced.posture import Drive, Posture, Rates, Vector, driven, posture, rates
from support_exudyn.reduced.runge_kutta import Matrix, within

PEAK_SAMPLES = 8
NEAR_PEAK = 0.8  # share of the largest force so far from which a step is looked at more closely


@compiled
def write(rows: Matrix, n: int, t: float, y: Vector, at: Posture, extension: float) -> None:
    """Write time [s], state and place of the hinge into column n of the records."""
    rows[TIME, n] = t
    for i in range(STATES):
        rows[STATE_ROW + i, n] = y[i]
    rows[HINGE_X, n], rows[HINGE_Y, n] = at.hinge_x, at.hinge_y
    rows[EXTENSION, n] = extension


@compiled
def record_loose(
    p: Vector, segment: Vector, memory: Vector, t: float, y: Vector, contact: Vector, rows: Matrix, n: int
) -> None:
    """Write a record of a support with a loose pin; `contact` is overwritten."""
    drive = driven(segment, t)
    at = posture(p, y[CANOPY], y[LINK], drive.extension)
    rate = rates(p, at, y[CANOPY_RATE], y[LINK_RATE], drive.extension, drive.speed)
    contact_force(p, memory, at, rate, y[LINK_RATE], contact)
    law = balance(p, at, rate, y[CANOPY_RATE], y[LINK_RATE], drive, 1.0)
    canopy, link = accelerations(at, law, contact[FORCE_X], contact[FORCE_Y], contact[MOMENT])
    front, rear = column_forces(
        p,
        at,
        rate,
        y[CANOPY_RATE],
        y[LINK_RATE],
        canopy,
        link,
        drive,
        1.0,
        contact[FORCE_X],
        contact[FORCE_Y],
    )
    write(rows, n, t, y, at, drive.extension)
    rows[CANOPY_ACCELERATION, n], rows[LINK_ACCELERATION, n] = canopy, link
    for i in range(CONTACT):
        rows[CONTACT_ROW + i, n] = contact[i]
    rows[TOUCH_SPEED_ROW, n] = memory[TOUCH_SPEED]
    rows[FRONT_FORCE, n], rows[REAR_FORCE, n] = front, rear


@compiled
def held_still(at: Posture, x: float, y: float) -> tuple[float, float]:
    """Rates of canopy and rear link that take a velocity or acceleration x, y from the link's end."""
    det = at.pin_x * at.bx + at.pin_y * at.by
    return -(x * at.bx + y * at.by) / det, (at.pin_y * x - at.pin_x * y) / det


@compiled
def closed(at: Posture, free: Motion, link_rate: float) -> tuple[float, float]:
    """q'' [rad/s^2] with which the rear link's end stays where it is; `free`: see `unforced`."""
    square = link_rate * link_rate
    return held_still(at, free.pin_x - square * at.bx, free.pin_y - square * at.by)


@compiled
def record_ideal(p: Vector, segment: Vector, t: float, y: Vector, rows: Matrix, n: int) -> None:
    """Write a record of a support with ideal pins, whose state y belongs to the drive."""
    drive = driven(segment, t)
    at = posture(p, y[CANOPY], y[LINK], drive.extension)
    rate = rates(p, at, y[CANOPY_RATE], y[LINK_RATE], drive.extension, drive.speed)
    law = balance(p, at, rate, y[CANOPY_RATE], y[LINK_RATE], drive, 1.0)
    canopy, link = closed(at, unforced(p, at, rate, y[CANOPY_RATE], drive), y[LINK_RATE])
    fx, fy = closing_force(at, law, canopy, link)
    front, rear = column_forces(p, at, rate, y[CANOPY_RATE], y[LINK_RATE], canopy, link, drive, 1.0, fx, fy)
    write(rows, n, t, y, at, drive.extension)
    rows[CANOPY_ACCELERATION, n], rows[LINK_ACCELERATION, n] = canopy, link
    rows[CONTACT_ROW + FORCE_X, n], rows[CONTACT_ROW + FORCE_Y, n] = fx, fy
    rows[FRONT_FORCE, n], rows[REAR_FORCE, n] = front, rear


@compiled
def jump(p: Vector, segment: Vector, y: Vector, ideal: bool, jumps: Matrix, n: int) -> None:
    """Give the state y the rates that belong to the drive's jump of speed at the start of a segment.

    The equations of motion without velocities, weight and contact force, impulses in place of forces: a loose
    pin transmits none. Writes what it was into row n of `jumps`.
    """
    t = segment[BEGIN]
    after = driven(segment, t)
    at = posture(p, y[CANOPY], y[LINK], after.extension)
    before = rates(p, at, y[CANOPY_RATE], y[LINK_RATE], after.extension, after.speed - segment[JUMP])
    energy = kinetic_energy(p, at, before, y[CANOPY_RATE], y[LINK_RATE])
    still = Rates(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    push = Drive(after.extension, 0.0, segment[JUMP])
    law = balance(p, at, still, 0.0, 0.0, push, 0.0)
    px = py = 0.0
    if ideal:
        canopy, link = closed(at, unforced(p, at, still, 0.0, push), 0.0)
        px, py = closing_force(at, law, canopy, link)
    else:
        canopy, link = accelerations(at, law, 0.0, 0.0, 0.0)
    front, rear = column_forces(p, at, still, 0.0, 0.0, canopy, link, push, 0.0, px, py)
    y[CANOPY_RATE] += canopy
    y[LINK_RATE] += link
    rate = rates(p, at, y[CANOPY_RATE], y[LINK_RATE], after.extension, after.speed)
    gained = kinetic_energy(p, at, rate, y[CANOPY_RATE], y[LINK_RATE]) - energy
    jumps[n, JUMP_TIME], jumps[n, FRONT_IMPULSE], jumps[n, REAR_IMPULSE] = t, front, rear
    jumps[n, JUMP_ENERGY] = gained


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
    the highest of them and both its neighbours. y and there are overwritten.
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
        if n > 1 and b >= a and b >= c and bend > 0.0:
            largest = max(largest, b + 0.125 * (c - a) * (c - a) / bend)
        a, b = b, c
    return largest


@compiled
def size(contact: Vector) -> float:
    """Magnitude of the contact force [N]."""
    return math.hypot(contact[NORMAL], contact[FRICTION])
