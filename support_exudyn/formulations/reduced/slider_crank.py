"""The slider-crank with a loose slider pin in its two free coordinates: turn of the rod, way of the slider."""

from __future__ import annotations

import math

from support_exudyn.formulations.compiled import inlined
from support_exudyn.formulations.reduced.drive import Drive, Vector
from support_exudyn.formulations.reduced.free_motion import Balance, PinState
from support_exudyn.formulations.reduced.layout import (
    BORE_FIRST,
    CRANK_ANGLE,
    CRANK_INERTIA,
    CRANK_LENGTH,
    CRANK_MASS,
    FIRST,
    FIRST_RATE,
    FORCE_X,
    FORCE_Y,
    GRAVITY_X,
    GRAVITY_Y,
    ROD_ANGLE,
    ROD_INERTIA,
    ROD_LENGTH,
    ROD_MASS,
    SECOND,
    SECOND_RATE,
    SLIDER_MASS,
    SLIDER_X,
)


@inlined
def pin_state(p: Vector, drive: Drive, y: Vector) -> PinState:
    """The slider pin: the rod's end against the slider."""
    crank, rod = p[CRANK_ANGLE] + drive.extension, p[ROD_ANGLE] + y[FIRST]
    r, length = p[CRANK_LENGTH], p[ROD_LENGTH]
    ca, sa, cb, sb = math.cos(crank), math.sin(crank), math.cos(rod), math.sin(rod)
    speed, spin = r * drive.speed, y[FIRST_RATE]
    x, across = r * ca + length * cb - p[SLIDER_X] - y[SECOND], r * sa + length * sb
    vx, vy = -speed * sa - length * sb * spin - y[SECOND_RATE], speed * ca + length * cb * spin
    tx, ty = -length * sb, length * cb
    if p[BORE_FIRST] != 0.0:  # in the slider
        return PinState(x, across, vx, vy, 0.0, spin, 1.0, 0.0, tx, ty, -1.0, 0.0, 0.0, 0.0, 1.0, 0.0)
    return PinState(-x, -across, -vx, -vy, spin, 0.0, cb, sb, -tx, -ty, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0)


@inlined
def pin_and_law(p: Vector, drive: Drive, y: Vector, weight: float) -> tuple[PinState, Balance]:
    """The slider pin and the equations of motion; weight: 1, or 0 to leave gravity out."""
    crank, rod = p[CRANK_ANGLE] + drive.extension, p[ROD_ANGLE] + y[FIRST]
    r, half, mass = p[CRANK_LENGTH], 0.5 * p[ROD_LENGTH], p[ROD_MASS]
    square = drive.speed * drive.speed
    ax = r * (-drive.acceleration * math.sin(crank) - square * math.cos(crank))
    ay = r * (drive.acceleration * math.cos(crank) - square * math.sin(crank))
    gx, gy = weight * p[GRAVITY_X], weight * p[GRAVITY_Y]
    # centre of mass of the rod moves across it with its turn; the acceleration along it does no work
    turning = mass * half * ((gy - ay) * math.cos(rod) - (gx - ax) * math.sin(rod))
    inertia = p[ROD_INERTIA] + mass * half * half
    law = Balance(inertia, 0.0, p[SLIDER_MASS], turning, p[SLIDER_MASS] * gx)
    return pin_state(p, drive, y), law


@inlined
def power(p: Vector, drive: Drive, y: Vector, turning: float, contact: Vector) -> float:
    """Power of the drive [W]: the crank's moment times its speed. turning: the rod's acceleration [rad/s^2]."""
    crank, rod = p[CRANK_ANGLE] + drive.extension, p[ROD_ANGLE] + y[FIRST]
    r, half, mass = p[CRANK_LENGTH], 0.5 * p[ROD_LENGTH], p[ROD_MASS]
    ca, sa, cb, sb = math.cos(crank), math.sin(crank), math.cos(rod), math.sin(rod)
    square, spin = drive.speed * drive.speed, y[FIRST_RATE] * y[FIRST_RATE]
    ax = r * (-drive.acceleration * sa - square * ca) + half * (-turning * sb - spin * cb)
    ay = r * (drive.acceleration * ca - square * sa) + half * (turning * cb - spin * sb)
    sign = 1.0 if p[BORE_FIRST] != 0.0 else -1.0
    fx = mass * (ax - p[GRAVITY_X]) - sign * contact[FORCE_X]  # of the crank on the rod
    fy = mass * (ay - p[GRAVITY_Y]) - sign * contact[FORCE_Y]
    inertia = p[CRANK_INERTIA] + 0.25 * p[CRANK_MASS] * r * r
    weight = 0.5 * p[CRANK_MASS] * r * (ca * p[GRAVITY_Y] - sa * p[GRAVITY_X])
    moment = inertia * drive.acceleration - weight + r * (ca * fy - sa * fx)
    watts: float = moment * drive.speed  # also of arrays
    return watts
