"""The hydraulic support with a loose rear-link pin in its free coordinates: turns of canopy and rear link."""

from __future__ import annotations

from support_exudyn.formulations.compiled import inlined
from support_exudyn.formulations.reduced import support_posture
from support_exudyn.formulations.reduced.drive import Drive, Vector
from support_exudyn.formulations.reduced.free_motion import Balance, PinState
from support_exudyn.formulations.reduced.layout import (
    BORE_FIRST,
    FIRST,
    FIRST_RATE,
    FORCE_X,
    FORCE_Y,
    SECOND,
    SECOND_RATE,
)
from support_exudyn.formulations.reduced.support_dynamics import balance, column_forces
from support_exudyn.formulations.reduced.support_posture import Posture, Rates, posture, rates

posture_dead_centre = support_posture.dead_centre


@inlined
def rear_pin(p: Vector, at: Posture, rate: Rates, link_rate: float) -> PinState:
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
def posture_and_rates(p: Vector, drive: Drive, y: Vector) -> tuple[Posture, Rates]:
    """Where everything is in the state y, and how it moves."""
    at = posture(p, y[FIRST], y[SECOND], drive.extension)
    return at, rates(p, at, y[FIRST_RATE], y[SECOND_RATE], drive.extension, drive.speed)


@inlined
def pin_state(p: Vector, drive: Drive, y: Vector) -> PinState:
    """The rear link's pin in the state y."""
    at, rate = posture_and_rates(p, drive, y)
    return rear_pin(p, at, rate, y[SECOND_RATE])


@inlined
def pin_and_law(
    p: Vector, drive: Drive, y: Vector, at: Posture, rate: Rates, weight: float
) -> tuple[PinState, Balance]:
    """The rear link's pin and the equations of motion; weight: 1, or 0 to leave gravity out."""
    law = balance(p, at, rate, y[FIRST_RATE], y[SECOND_RATE], drive, weight)
    return rear_pin(p, at, rate, y[SECOND_RATE]), law


@inlined
def power(
    p: Vector,
    drive: Drive,
    y: Vector,
    at: Posture,
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
def dead_centre(p: Vector, drive: Drive, y: Vector, near: Vector) -> None:
    """Write into `near` how near the state y is to a dead centre."""
    at, rate = posture_and_rates(p, drive, y)
    posture_dead_centre(at, rate, y[FIRST_RATE], near)
