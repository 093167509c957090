"""The hydraulic support with a rear-link clearance pin in its free coordinates: turns of canopy and rear link.

Equations of motion by virtual power, and what follows from them. For every body: mass times acceleration minus
weight, times the velocity that a free coordinate gives its centre of mass, plus the same for its turning. Both
sums equal the power of the contact force.
"""

from typing import NamedTuple

from support_exudyn.formulations.compilation import compiled, inlined
from support_exudyn.formulations.compiled.closed_forms import support_posture
from support_exudyn.formulations.compiled.closed_forms.contact import (
    Balance,
    PinState,
    closing_force,
    closing_rates,
    solved,
)
from support_exudyn.formulations.compiled.closed_forms.layout import (
    BEGIN,
    BORE_FIRST,
    CANOPY_INERTIA,
    CANOPY_MASS,
    CANOPY_X,
    CANOPY_Y,
    CLEARANCE,
    FIRST,
    FIRST_RATE,
    FORCE_X,
    FORCE_Y,
    FRONT_IMPULSE,
    FRONT_LENGTH,
    FRONT_LINK_INERTIA,
    FRONT_LINK_MASS,
    GRAVITY_X,
    GRAVITY_Y,
    JUMP,
    JUMP_ENERGY,
    JUMP_TIME,
    LINK_ACROSS,
    LINK_ALONG,
    REAR_IMPULSE,
    REAR_LENGTH,
    REAR_LINK_INERTIA,
    REAR_LINK_MASS,
    REAR_LINK_X,
    REAR_LINK_Y,
    SECOND,
    SECOND_RATE,
    SHIELD_ACROSS,
    SHIELD_ALONG,
    SHIELD_INERTIA,
    SHIELD_MASS,
    WORK,
    DriveValues,
    Matrix,
    Vector,
    driven,
)
from support_exudyn.formulations.compiled.closed_forms.support_posture import (
    Rates,
    SupportMotion,
    posture,
    rates,
)


class Arms(NamedTuple):
    """Centres of mass [m]: canopy and shield beam from I, front link from A, rear link from C."""

    canopy_x: float
    canopy_y: float
    shield_x: float
    shield_y: float
    front_x: float
    front_y: float
    rear_x: float
    rear_y: float


class Motion(NamedTuple):
    """Accelerations of hinge and C [m/s^2] and of shield beam and front link [rad/s^2]."""

    hinge_x: float
    hinge_y: float
    shield: float
    link: float
    pin_x: float
    pin_y: float


@inlined
def arms(p: Vector, at: SupportMotion) -> Arms:
    """Where the centres of mass are."""
    along, across = p[SHIELD_ALONG], p[SHIELD_ACROSS]
    front_along, front_across = p[LINK_ALONG], p[LINK_ACROSS]
    return Arms(
        at.cos_canopy * p[CANOPY_X] - at.sin_canopy * p[CANOPY_Y],
        at.sin_canopy * p[CANOPY_X] + at.cos_canopy * p[CANOPY_Y],
        along * at.sx - across * at.sy,
        along * at.sy + across * at.sx,
        front_along * at.fx - front_across * at.fy,
        front_along * at.fy + front_across * at.fx,
        at.cos_link * p[REAR_LINK_X] - at.sin_link * p[REAR_LINK_Y],
        at.sin_link * p[REAR_LINK_X] + at.cos_link * p[REAR_LINK_Y],
    )


@inlined
def motion(at: SupportMotion, rate: Rates, hinge_x: float, hinge_y: float) -> Motion:
    """Accelerations that belong to one of the hinge [m/s^2] at these velocities."""
    ss, ff = rate.shield * rate.shield, rate.link * rate.link
    px = hinge_x - ss * at.sx + ff * at.fx
    py = hinge_y - ss * at.sy + ff * at.fy
    shield = -(px * at.fx + py * at.fy) / at.bars
    front = -(px * at.sx + py * at.sy) / at.bars
    cx = hinge_x - shield * at.cy - ss * at.cx
    cy = hinge_y + shield * at.cx - ss * at.cy
    return Motion(hinge_x, hinge_y, shield, front, cx, cy)


@inlined
def unforced(p: Vector, at: SupportMotion, rate: Rates, canopy_rate: float, drive: DriveValues) -> Motion:
    """Accelerations while the rates of canopy and rear link do not change."""
    square = canopy_rate * canopy_rate
    vfx, vfy = rate.hinge_x - canopy_rate * at.ey, rate.hinge_y + canopy_rate * at.ex
    vrx, vry = rate.hinge_x - canopy_rate * at.gy, rate.hinge_y + canopy_rate * at.gx
    speed, acceleration = drive.speed * drive.speed, drive.acceleration
    a = (p[FRONT_LENGTH] + drive.extension) * acceleration + speed - (vfx * vfx + vfy * vfy)
    b = (p[REAR_LENGTH] + drive.extension) * acceleration + speed - (vrx * vrx + vry * vry)
    a += square * (at.front_x * at.ex + at.front_y * at.ey)
    b += square * (at.rear_x * at.gx + at.rear_y * at.gy)
    hx = (a * at.rear_y - b * at.front_y) / at.columns
    hy = (b * at.front_x - a * at.rear_x) / at.columns
    return motion(at, rate, hx, hy)


@inlined
def balance(
    p: Vector,
    at: SupportMotion,
    rate: Rates,
    canopy_rate: float,
    link_rate: float,
    drive: DriveValues,
    weight: float,
) -> Balance:
    """M and Q without the contact force. weight: 1, or 0 to leave gravity out."""
    arm = arms(p, at)
    free = unforced(p, at, rate, canopy_rate, drive)
    gx, gy = weight * p[GRAVITY_X], weight * p[GRAVITY_Y]
    cc, ss, ff, ll = canopy_rate**2, rate.shield**2, rate.link**2, link_rate**2
    # canopy
    mass = p[CANOPY_MASS]
    vx, vy = at.along_x - arm.canopy_y, at.along_y + arm.canopy_x
    m11 = mass * (vx * vx + vy * vy) + p[CANOPY_INERTIA]
    q1 = mass * ((gx - free.hinge_x + cc * arm.canopy_x) * vx + (gy - free.hinge_y + cc * arm.canopy_y) * vy)
    # shield beam
    mass = p[SHIELD_MASS]
    vx, vy = at.along_x - at.shield * arm.shield_y, at.along_y + at.shield * arm.shield_x
    ax = free.hinge_x - free.shield * arm.shield_y - ss * arm.shield_x
    ay = free.hinge_y + free.shield * arm.shield_x - ss * arm.shield_y
    m11 += mass * (vx * vx + vy * vy) + p[SHIELD_INERTIA] * at.shield * at.shield
    q1 += mass * ((gx - ax) * vx + (gy - ay) * vy) - p[SHIELD_INERTIA] * free.shield * at.shield
    # front link
    mass = p[FRONT_LINK_MASS]
    vx, vy = -at.link * arm.front_y, at.link * arm.front_x
    ax = -free.link * arm.front_y - ff * arm.front_x
    ay = free.link * arm.front_x - ff * arm.front_y
    m11 += mass * (vx * vx + vy * vy) + p[FRONT_LINK_INERTIA] * at.link * at.link
    q1 += mass * ((gx - ax) * vx + (gy - ay) * vy) - p[FRONT_LINK_INERTIA] * free.link * at.link
    # rear link
    mass = p[REAR_LINK_MASS]
    fx = mass * (gx - free.pin_x + ll * arm.rear_x)
    fy = mass * (gy - free.pin_y + ll * arm.rear_y)
    m11 += mass * (at.pin_x * at.pin_x + at.pin_y * at.pin_y)
    q1 += fx * at.pin_x + fy * at.pin_y
    m12 = mass * (at.pin_y * arm.rear_x - at.pin_x * arm.rear_y)
    m22 = mass * (arm.rear_x * arm.rear_x + arm.rear_y * arm.rear_y) + p[REAR_LINK_INERTIA]
    q2 = fy * arm.rear_x - fx * arm.rear_y
    return Balance(m11, m12, m22, q1, q2)


@inlined
def column_forces(
    p: Vector,
    at: SupportMotion,
    rate: Rates,
    canopy_rate: float,
    link_rate: float,
    canopy: float,
    link: float,
    drive: DriveValues,
    weight: float,
    fx: float,
    fy: float,
) -> tuple[float, float]:
    """Forces [N] of front and rear column, positive if they push their ends apart.

    From the power for a shift of the hinge at a canopy and rear link that do not turn. canopy, link: angular
    accelerations [rad/s^2]; fx, fy: force on the rear link's end [N].
    """
    arm = arms(p, at)
    free = unforced(p, at, rate, canopy_rate, drive)
    whole = motion(at, rate, free.hinge_x + at.along_x * canopy, free.hinge_y + at.along_y * canopy)
    gx, gy = weight * p[GRAVITY_X], weight * p[GRAVITY_Y]
    cc, ss, ff, ll = canopy_rate**2, rate.shield**2, rate.link**2, link_rate**2
    mass = p[CANOPY_MASS]
    canopy_x = mass * (whole.hinge_x - canopy * arm.canopy_y - cc * arm.canopy_x - gx)
    canopy_y = mass * (whole.hinge_y + canopy * arm.canopy_x - cc * arm.canopy_y - gy)
    mass = p[SHIELD_MASS]
    shield_x = mass * (whole.hinge_x - whole.shield * arm.shield_y - ss * arm.shield_x - gx)
    shield_y = mass * (whole.hinge_y + whole.shield * arm.shield_x - ss * arm.shield_y - gy)
    mass = p[FRONT_LINK_MASS]
    front_x = mass * (-whole.link * arm.front_y - ff * arm.front_x - gx)
    front_y = mass * (whole.link * arm.front_x - ff * arm.front_y - gy)
    mass = p[REAR_LINK_MASS]
    rear_x = mass * (whole.pin_x - link * arm.rear_y - ll * arm.rear_x - gx) - fx
    rear_y = mass * (whole.pin_y + link * arm.rear_x - ll * arm.rear_y - gy) - fy
    turn_shield = arm.shield_x * shield_y - arm.shield_y * shield_x + at.cx * rear_y - at.cy * rear_x
    turn_shield += p[SHIELD_INERTIA] * whole.shield
    turn_front = arm.front_x * front_y - arm.front_y * front_x + p[FRONT_LINK_INERTIA] * whole.link
    wx = canopy_x + shield_x + rear_x - (at.fx * turn_shield + at.sx * turn_front) / at.bars
    wy = canopy_y + shield_y + rear_y - (at.fy * turn_shield + at.sy * turn_front) / at.bars
    # front (front_x, front_y) + rear (rear_x, rear_y) = w, in forces per length
    front = (wx * at.rear_y - wy * at.rear_x) / at.columns
    rear = (wy * at.front_x - wx * at.front_y) / at.columns
    return front * (p[FRONT_LENGTH] + drive.extension), rear * (p[REAR_LENGTH] + drive.extension)


@inlined
def kinetic_energy(p: Vector, at: SupportMotion, rate: Rates, canopy_rate: float, link_rate: float) -> float:
    """Kinetic energy of all bodies [J]."""
    arm = arms(p, at)
    vx, vy = rate.hinge_x - canopy_rate * arm.canopy_y, rate.hinge_y + canopy_rate * arm.canopy_x
    twice = p[CANOPY_MASS] * (vx * vx + vy * vy) + p[CANOPY_INERTIA] * canopy_rate**2
    vx, vy = rate.hinge_x - rate.shield * arm.shield_y, rate.hinge_y + rate.shield * arm.shield_x
    twice += p[SHIELD_MASS] * (vx * vx + vy * vy) + p[SHIELD_INERTIA] * rate.shield**2
    vx, vy = -rate.link * arm.front_y, rate.link * arm.front_x
    twice += p[FRONT_LINK_MASS] * (vx * vx + vy * vy) + p[FRONT_LINK_INERTIA] * rate.link**2
    # the rear link hangs on C, whose velocity is that of its end less the turning
    vx = rate.end_x + link_rate * (at.by - arm.rear_y)
    vy = rate.end_y - link_rate * (at.bx - arm.rear_x)
    twice += p[REAR_LINK_MASS] * (vx * vx + vy * vy) + p[REAR_LINK_INERTIA] * link_rate**2
    return float(0.5 * twice)


posture_dead_centre = support_posture.dead_centre


@inlined
def rear_pin(p: Vector, at: SupportMotion, rate: Rates, link_rate: float) -> PinState:
    """The rear link's end against the base."""
    if p[BORE_FIRST] != 0.0:  # in the base
        return PinState(
            at.offset_x,
            at.offset_y,
            rate.end_x,
            rate.end_y,
            0.0,
            link_rate,
            1.0,
            0.0,
            at.pin_x,
            at.pin_y,
            -at.by,
            at.bx,
            0.0,
            0.0,
            0.0,
            1.0,
        )
    return PinState(
        -at.offset_x,
        -at.offset_y,
        -rate.end_x,
        -rate.end_y,
        link_rate,
        0.0,
        at.cos_link,
        at.sin_link,
        -at.pin_x,
        -at.pin_y,
        at.by,
        -at.bx,
        0.0,
        1.0,
        0.0,
        0.0,
    )


@inlined
def posture_and_rates(p: Vector, drive: DriveValues, y: Vector) -> tuple[SupportMotion, Rates]:
    """Where everything is in the state y, and how it moves."""
    at = posture(p, y[FIRST], y[SECOND], drive.extension)
    return at, rates(p, at, y[FIRST_RATE], y[SECOND_RATE], drive.extension, drive.speed)


@inlined
def pin_state(p: Vector, drive: DriveValues, y: Vector) -> PinState:
    """The rear link's pin in the state y."""
    at, rate = posture_and_rates(p, drive, y)
    return rear_pin(p, at, rate, y[SECOND_RATE])


@inlined
def pin_and_law(
    p: Vector, drive: DriveValues, y: Vector, at: SupportMotion, rate: Rates, weight: float
) -> tuple[PinState, Balance]:
    """The rear link's pin and the equations of motion; weight: 1, or 0 to leave gravity out."""
    law = balance(p, at, rate, y[FIRST_RATE], y[SECOND_RATE], drive, weight)
    return rear_pin(p, at, rate, y[SECOND_RATE]), law


@inlined
def power(
    p: Vector,
    drive: DriveValues,
    y: Vector,
    at: SupportMotion,
    rate: Rates,
    canopy: float,
    link: float,
    contact: Vector,
) -> float:
    """Power of the columns [W] at these accelerations [rad/s^2]."""
    sign = 1.0 if p[BORE_FIRST] != 0.0 else -1.0
    fx, fy = sign * contact[FORCE_X], sign * contact[FORCE_Y]
    front, rear = column_forces(p, at, rate, y[FIRST_RATE], y[SECOND_RATE], canopy, link, drive, 1.0, fx, fy)
    watts: float = (front + rear) * drive.speed  # also of arrays
    return watts


@inlined
def dead_centre(p: Vector, drive: DriveValues, y: Vector, near: Vector) -> None:
    """Write into `near` how near the state y is to a dead centre."""
    at, rate = posture_and_rates(p, drive, y)
    posture_dead_centre(at, rate, y[FIRST_RATE], near)


@compiled
def closed(pin: PinState, at: SupportMotion, free: Motion, link_rate: float) -> tuple[float, float]:
    """q'' [rad/s^2] with which the rear link's end stays in the base's pin; `free`: see `unforced`."""
    square = link_rate * link_rate
    return closing_rates(pin, free.pin_x - square * at.bx, free.pin_y - square * at.by)


@compiled
def jump(p: Vector, segment: Vector, y: Vector, jumps: Matrix, n: int) -> None:
    """Give the state y the rates that belong to the drive's jump of speed at the start of a segment.

    The equations of motion without velocities, weight and contact force, impulses in place of forces: a loose
    pin transmits none. Writes what it was into row n of `jumps`. With an ideal pin the bore is in the base.
    """
    t = segment[BEGIN]
    after = driven(segment, t)
    at = posture(p, y[FIRST], y[SECOND], after.extension)
    before = rates(p, at, y[FIRST_RATE], y[SECOND_RATE], after.extension, after.speed - segment[JUMP])
    energy = kinetic_energy(p, at, before, y[FIRST_RATE], y[SECOND_RATE])
    still = Rates(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    push = DriveValues(after.extension, 0.0, segment[JUMP])
    law = balance(p, at, still, 0.0, 0.0, push, 0.0)
    px = py = 0.0
    if p[CLEARANCE] == 0.0:  # the pin is ideal
        pin = rear_pin(p, at, still, 0.0)
        canopy, link = closed(pin, at, unforced(p, at, still, 0.0, push), 0.0)
        px, py = closing_force(pin, law, canopy, link)
    else:
        canopy, link = solved(law, law.q1, law.q2)
    front, rear = column_forces(p, at, still, 0.0, 0.0, canopy, link, push, 0.0, px, py)
    y[FIRST_RATE] += canopy
    y[SECOND_RATE] += link
    rate = rates(p, at, y[FIRST_RATE], y[SECOND_RATE], after.extension, after.speed)
    gained = kinetic_energy(p, at, rate, y[FIRST_RATE], y[SECOND_RATE]) - energy
    jumps[n, JUMP_TIME], jumps[n, FRONT_IMPULSE], jumps[n, REAR_IMPULSE] = t, front, rear
    jumps[n, JUMP_ENERGY] = gained
    y[WORK] += gained
