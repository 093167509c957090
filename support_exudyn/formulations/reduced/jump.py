"""What a jump of the columns' speed does to a support."""

from __future__ import annotations

from support_exudyn.formulations.compiled import compiled
from support_exudyn.formulations.reduced.drive import Drive, Matrix, Vector, driven
from support_exudyn.formulations.reduced.free_motion import PinState, closing_force, closing_rates, solved
from support_exudyn.formulations.reduced.layout import (
    BEGIN,
    FIRST,
    FIRST_RATE,
    FRONT_IMPULSE,
    JUMP,
    JUMP_ENERGY,
    JUMP_TIME,
    REAR_IMPULSE,
    SECOND,
    SECOND_RATE,
    WORK,
)
from support_exudyn.formulations.reduced.support import rear_pin
from support_exudyn.formulations.reduced.support_dynamics import (
    Motion,
    balance,
    column_forces,
    kinetic_energy,
    unforced,
)
from support_exudyn.formulations.reduced.support_posture import Posture, Rates, posture, rates


@compiled
def closed(pin: PinState, at: Posture, free: Motion, link_rate: float) -> tuple[float, float]:
    """q'' [rad/s^2] with which the rear link's end stays in the base's pin; `free`: see `unforced`."""
    square = link_rate * link_rate
    return closing_rates(pin, free.pin_x - square * at.bx, free.pin_y - square * at.by)


@compiled
def jump(p: Vector, segment: Vector, y: Vector, ideal: bool, jumps: Matrix, n: int) -> None:
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
    push = Drive(after.extension, 0.0, segment[JUMP])
    law = balance(p, at, still, 0.0, 0.0, push, 0.0)
    px = py = 0.0
    if ideal:
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
