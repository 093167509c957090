"""The right-hand side: state in, its rate out."""

from __future__ import annotations

from support_exudyn.formulations.compiled import compiled, inlined
from support_exudyn.formulations.reduced import slider_crank, support
from support_exudyn.formulations.reduced.contact import contact_force
from support_exudyn.formulations.reduced.drive import Drive, Vector, driven
from support_exudyn.formulations.reduced.free_motion import (
    Balance,
    PinState,
    accelerations,
    closing_rates,
    mobility,
)
from support_exudyn.formulations.reduced.layout import (
    DAMPING,
    DAMPING_LOSS,
    FIRST,
    FIRST_RATE,
    FRICTION,
    FRICTION_LOSS,
    MACHINE,
    MOBILITY_XX,
    MOBILITY_XY,
    MOBILITY_YY,
    SECOND,
    SECOND_RATE,
    SINE,
    SLIDER_CRANK,
    SLIP,
    SWIFTNESS,
    WORK,
)

# one machine a module; compiled functions know each other by plain names
slider_crank_pin, slider_crank_law = slider_crank.pin_state, slider_crank.pin_and_law
slider_crank_power = slider_crank.power
support_pin, support_law, support_power = support.pin_state, support.pin_and_law, support.power
support_dead_centre, support_posture = support.dead_centre, support.posture_and_rates


@compiled
def pin_at(p: Vector, drive: Drive, y: Vector) -> PinState:
    """The loose pin in the state y."""
    if p[MACHINE] == SLIDER_CRANK:
        return slider_crank_pin(p, drive, y)
    return support_pin(p, drive, y)


@compiled
def law_at(p: Vector, drive: Drive, y: Vector, weight: float) -> tuple[PinState, Balance]:
    """The loose pin and the equations of motion; weight: 1, or 0 to leave gravity out."""
    if p[MACHINE] == SLIDER_CRANK:
        return slider_crank_law(p, drive, y, weight)
    at, rate = support_posture(p, drive, y)
    return support_law(p, drive, y, at, rate, weight)


@compiled
def power_at(p: Vector, drive: Drive, y: Vector, first: float, second: float, contact: Vector) -> float:
    """Power of the drive [W] at these accelerations of the free coordinates."""
    if p[MACHINE] == SLIDER_CRANK:
        return slider_crank_power(p, drive, y, first, contact)
    at, rate = support_posture(p, drive, y)
    return support_power(p, drive, y, at, rate, first, second, contact)


@inlined
def evaluate(
    p: Vector, segment: Vector, memory: Vector, t: float, y: Vector, slope: Vector, contact: Vector
) -> None:
    """Write the rate of the state y at time t [s] into `slope` and the contact into `contact`."""
    drive = driven(segment, t)
    if p[MACHINE] == SLIDER_CRANK:
        first, second, power = slider_crank_moves(p, drive, memory, y, contact)
    else:
        first, second, power = support_moves(p, drive, memory, y, contact)
    slope[FIRST], slope[SECOND] = y[FIRST_RATE], y[SECOND_RATE]
    slope[FIRST_RATE], slope[SECOND_RATE] = first, second
    slope[DAMPING_LOSS] = contact[DAMPING]
    slope[FRICTION_LOSS] = -contact[FRICTION] * contact[SLIP]
    slope[WORK] = power


@inlined
def slider_crank_moves(
    p: Vector, drive: Drive, memory: Vector, y: Vector, contact: Vector
) -> tuple[float, float, float]:
    """Accelerations of the free coordinates and power of the drive [W]; `contact` is written."""
    pin, law = slider_crank_law(p, drive, y, 1.0)
    contact_force(p, memory, pin, contact)
    first, second = accelerations(pin, law, contact)
    power = slider_crank_power(p, drive, y, first, contact) if drive.speed != 0.0 else 0.0
    return first, second, power


@inlined
def support_moves(
    p: Vector, drive: Drive, memory: Vector, y: Vector, contact: Vector
) -> tuple[float, float, float]:
    """Accelerations of the free coordinates and power of the drive [W]; `contact` is written."""
    at, rate = support_posture(p, drive, y)
    pin, law = support_law(p, drive, y, at, rate, 1.0)
    contact_force(p, memory, pin, contact)
    first, second = accelerations(pin, law, contact)
    power = support_power(p, drive, y, at, rate, first, second, contact) if drive.speed != 0.0 else 0.0
    return first, second, power


@compiled
def observe(p: Vector, segment: Vector, memory: Vector, t: float, y: Vector, contact: Vector) -> None:
    """The contact alone, without accelerations."""
    contact_force(p, memory, pin_at(p, driven(segment, t), y), contact)


@compiled
def approach(p: Vector, segment: Vector, t: float, y: Vector, near: Vector) -> None:
    """Write into `near` how near the state y is to a dead centre, see `support_posture.dead_centre`."""
    near[SINE], near[SWIFTNESS] = 1.0, 0.0  # a slider-crank has none: its rod is longer than its crank
    if p[MACHINE] != SLIDER_CRANK:
        support_dead_centre(p, driven(segment, t), y, near)


@compiled
def freeze_mobility(p: Vector, segment: Vector, memory: Vector, t: float, y: Vector) -> None:
    """Remember how easily the journal moves against the bore now, in the bore's axes."""
    pin, law = law_at(p, driven(segment, t), y, 0.0)
    memory[MOBILITY_XX], memory[MOBILITY_XY], memory[MOBILITY_YY] = mobility(pin, law)


@compiled
def move_with_the_drive(p: Vector, segment: Vector, t: float, y: Vector) -> None:
    """Give the state y the rates with which the journal does not move against the bore."""
    drive = driven(segment, t)
    y[FIRST_RATE] = y[SECOND_RATE] = 0.0
    pin = pin_at(p, drive, y)
    y[FIRST_RATE], y[SECOND_RATE] = closing_rates(pin, pin.vx, pin.vy)
