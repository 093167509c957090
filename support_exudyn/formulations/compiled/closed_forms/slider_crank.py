"""The slider-crank with a clearance slider pin in its free coordinates: turn of the rod, way of the slider."""

import math

import numpy as np

from support_exudyn.formulations.compilation import inlined
from support_exudyn.formulations.compiled.closed_forms import layout
from support_exudyn.formulations.compiled.closed_forms.contact import Balance, PinState
from support_exudyn.formulations.compiled.closed_forms.layout import (
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
    DriveValues,
    Matrix,
    Vector,
)
from support_exudyn.formulations.compiled.closed_forms.machine_model import Bodies, BodyPlace, moved, placed
from support_exudyn.machines.slider_crank import SliderCrank
from support_exudyn.model.drives.drive import CubicStep, Held, Reciprocating, Steady
from support_exudyn.model.linkage import Linkage


@inlined
def pin_state(p: Vector, drive: DriveValues, y: Vector) -> PinState:
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
def pin_and_law(p: Vector, drive: DriveValues, y: Vector, weight: float) -> tuple[PinState, Balance]:
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
def power(p: Vector, drive: DriveValues, y: Vector, turning: float, contact: Vector) -> float:
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


PIN = "slider_pin"
DRIVES = (Held, Steady, CubicStep, Reciprocating)  # a jump of the crank's speed is not covered


def start(machine: SliderCrank) -> tuple[float, float]:
    """The free coordinates at the start: turn of the rod [rad], way of the slider [m]."""
    del machine
    return 0.0, 0.0


def shifted(before: Linkage, after: Linkage) -> tuple[float, float]:
    """Turn of the rod [rad] and way of the slider [m] between two postures of the linkage."""
    turn = after.bodies["rod"].angle - before.bodies["rod"].angle
    return turn, after.bodies["slider"].centre[0] - before.bodies["slider"].centre[0]


def reaches(machine: SliderCrank) -> tuple[float, float]:
    """By how much the journal moves with the free coordinates: [m/rad], 1."""
    return machine.rod_length, 1.0


def fall(machine: SliderCrank, speed: float) -> float:
    """Acceleration of the journal without its contact besides gravity's [m/s^2] at a crank speed [rad/s]."""
    return machine.crank_length * speed**2


def parameters(machine: SliderCrank) -> dict[str, float]:
    """Parameters by name."""
    rod = machine.linkage().bodies["rod"]
    return {
        "MACHINE": layout.SLIDER_CRANK,
        "CRANK_LENGTH": machine.crank_length,
        "ROD_LENGTH": machine.rod_length,
        "CRANK_MASS": machine.crank_mass,
        "CRANK_INERTIA": machine.crank_inertia,
        "ROD_MASS": machine.rod_mass,
        "ROD_INERTIA": machine.rod_inertia,
        "SLIDER_MASS": machine.slider_mass,
        "CRANK_ANGLE": machine.start_angle,
        "ROD_ANGLE": rod.angle,
        "SLIDER_X": machine.slider_position(machine.start_angle),
    }


def bodies(
    machine: SliderCrank, linkage: Linkage, p: list[float], rows: Matrix, accelerations: Matrix | None
) -> Bodies:
    """Bodies at the records; arguments as of `support_model.bodies`."""
    assert accelerations is not None  # with an ideal pin nothing is free, and `check` refuses it
    rod_turn, way, rod_spin, slide_speed = rows[layout.STATE_ROW : layout.STATE_ROW + 4]
    turn, speed, speeding = rows[layout.EXTENSION : layout.ACCELERATION + 1]
    rod_turning, slide_speeding = accelerations[:2]
    still = np.zeros_like(turn)
    crank, rod = machine.start_angle + turn, p[layout.ROD_ANGLE] + rod_turn
    half = 0.5 * machine.crank_length
    centre = half * np.cos(crank), half * np.sin(crank)
    at_crank = moved((still, still, still, still, still, still), centre, turn, speed, speeding)
    # the crank's tip is as far again
    tip = (*(2.0 * getattr(at_crank, name) for name in ("x", "y", "vx", "vy", "ax", "ay")),)
    half = 0.5 * machine.rod_length
    at_rod = moved(tip, (half * np.cos(rod), half * np.sin(rod)), rod_turn, rod_spin, rod_turning)
    x = p[layout.SLIDER_X] + way
    at_slider = BodyPlace(x, still, still, slide_speed, still, still, slide_speeding, still, still)
    return placed(linkage, [at_crank, at_rod, at_slider], {})
