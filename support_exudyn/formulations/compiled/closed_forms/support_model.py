"""The hydraulic support in closed form: its parameters, and its bodies at the records."""

from collections.abc import Mapping

import numpy as np

from support_exudyn.formulations.compilation import on_arrays
from support_exudyn.formulations.compiled.closed_forms import layout
from support_exudyn.formulations.compiled.closed_forms.contact import closing_force
from support_exudyn.formulations.compiled.closed_forms.layout import DriveValues, Matrix, Vector
from support_exudyn.formulations.compiled.closed_forms.machine_model import Bodies, moved, placed
from support_exudyn.formulations.compiled.closed_forms.support import (
    arms,
    balance,
    closed,
    column_forces,
    motion,
    rear_pin,
    unforced,
)
from support_exudyn.formulations.compiled.closed_forms.support_posture import posture, rates
from support_exudyn.machines.four_column_support import BODIES, HydraulicSupport, Posture
from support_exudyn.model.drives.drive import CubicStep, Held, Reciprocating, Steady, UniformSpeed
from support_exudyn.model.drives.table_drive import TableDrive
from support_exudyn.model.linkage import Linkage, Part, lumped
from support_exudyn.model.plane_geometry import distance, minus, parts_of, side
from user_forces.values.value import Vector2

PIN = "rear_base"
DRIVES = (Held, Steady, CubicStep, UniformSpeed, Reciprocating, TableDrive)
# the same formulas for all records at once
_posture, _rates, _arms = on_arrays(posture), on_arrays(rates), on_arrays(arms)
_motion, _unforced, _column_forces = on_arrays(motion), on_arrays(unforced), on_arrays(column_forces)
_balance, _rear_pin = on_arrays(balance), on_arrays(rear_pin)
_closed, _closing_force = on_arrays(closed), on_arrays(closing_force)


def start(machine: HydraulicSupport) -> tuple[float, float]:
    """The free coordinates at the start [rad]."""
    posture = machine.start()
    return posture.canopy, posture.rear_link


def shifted(before: Linkage, after: Linkage) -> tuple[float, float]:
    """By how much canopy and rear link have turned between two postures of the linkage [rad]."""
    canopy, rear_link = (
        after.bodies[name].angle - before.bodies[name].angle for name in ("canopy", "rear_link")
    )
    return canopy, rear_link


def reaches(machine: HydraulicSupport) -> tuple[float, float]:
    """By how much the journal moves with the free coordinates [m/rad]."""
    lever = distance(machine.start().rear_shield, machine.rear_base)
    return lever, lever


def fall(machine: HydraulicSupport, speed: float) -> float:
    """Acceleration of the journal without its contact besides gravity's [m/s^2]; the drive is slow: none."""
    del machine, speed
    return 0.0


def parameters(machine: HydraulicSupport) -> dict[str, float]:
    """Parameters by name."""
    return {"MACHINE": layout.SUPPORT, **_geometry(machine, machine.start()), **_masses(machine)}


def _pair(name: str, vector: Vector2) -> dict[str, float]:
    return {f"{name}_X": vector[0], f"{name}_Y": vector[1]}


def _geometry(m: HydraulicSupport, start: Posture) -> Mapping[str, float]:
    front, rear = m.column_lengths(start)
    # centres of the circles about which the hinge turns on the columns
    about_front = minus(m.front_foot, minus(start.front_head, start.hinge))
    about_rear = minus(m.rear_foot, minus(start.rear_head, start.hinge))
    along, across = parts_of(minus(m.rear_shield, m.hinge), minus(m.front_shield, m.hinge))
    return {
        **_pair("FRONT_HEAD", minus(m.front_head, m.hinge)),
        **_pair("REAR_HEAD", minus(m.rear_head, m.hinge)),
        **_pair("FRONT_FOOT", m.front_foot),
        **_pair("REAR_FOOT", m.rear_foot),
        **_pair("FRONT_BASE", m.front_base),
        **_pair("REAR_BASE", m.rear_base),
        **_pair("PIN", minus(m.rear_base, m.rear_shield)),
        "FRONT_LENGTH": front,
        "REAR_LENGTH": rear,
        "SHIELD_LENGTH": distance(m.hinge, m.front_shield),
        "LINK_LENGTH": distance(m.front_base, m.front_shield),
        "HINGE_SIDE": side(about_front, about_rear, start.hinge),
        "SHIELD_SIDE": side(start.hinge, m.front_base, start.front_shield),
        "SHIELD_PIN_ALONG": along,
        "SHIELD_PIN_ACROSS": across,
    }


def _masses(m: HydraulicSupport) -> Mapping[str, float]:
    lumps: dict[str, Part] = {name: lumped(m.parts[name]) for name in BODIES}
    found: dict[str, float] = {}
    for name, body in (
        ("CANOPY", "canopy"),
        ("SHIELD", "shield"),
        ("FRONT_LINK", "front_link"),
        ("REAR_LINK", "rear_link"),
    ):
        found |= {f"{name}_MASS": lumps[body].mass, f"{name}_INERTIA": lumps[body].inertia}
    shield = parts_of(minus(lumps["shield"].centre, m.hinge), minus(m.front_shield, m.hinge))
    link = parts_of(minus(lumps["front_link"].centre, m.front_base), minus(m.front_shield, m.front_base))
    return {
        **found,
        **_pair("CANOPY", minus(lumps["canopy"].centre, m.hinge)),
        **_pair("REAR_LINK", minus(lumps["rear_link"].centre, m.rear_shield)),
        "SHIELD_ALONG": shield[0],
        "SHIELD_ACROSS": shield[1],
        "LINK_ALONG": link[0],
        "LINK_ACROSS": link[1],
    }


def bodies(
    machine: HydraulicSupport, linkage: Linkage, p: list[float], rows: Matrix, accelerations: Matrix | None
) -> Bodies:
    """Bodies and columns at the records.

    Arguments:
        p: parameters.
        rows: of the records, see `layout`.
        accelerations: of the free coordinates (2, n), and the force of the bore on the journal (2, n) below
            them; None if the pin is ideal.
    """
    canopy, link, canopy_rate, link_rate = rows[layout.STATE_ROW : layout.STATE_ROW + 4]
    drive = DriveValues(*rows[layout.EXTENSION : layout.ACCELERATION + 1])
    at = _posture(p, canopy, link, drive.extension)
    rate = _rates(p, at, canopy_rate, link_rate, drive.extension, drive.speed)
    free = _unforced(p, at, rate, canopy_rate, drive)
    if accelerations is None:
        pin = _rear_pin(p, at, rate, link_rate)
        law = _balance(p, at, rate, canopy_rate, link_rate, drive, 1.0)
        canopy_turning, link_turning = _closed(pin, at, free, link_rate)
        on_link = _closing_force(pin, law, canopy_turning, link_turning)
    else:
        canopy_turning, link_turning, fx, fy = accelerations
        sign = 1.0 if p[layout.BORE_FIRST] else -1.0
        on_link = sign * fx, sign * fy
    turning = canopy_turning, link_turning
    front, rear = _column_forces(p, at, rate, canopy_rate, link_rate, *turning, drive, 1.0, *on_link)
    whole = _motion(
        at, rate, free.hinge_x + at.along_x * canopy_turning, free.hinge_y + at.along_y * canopy_turning
    )
    arm = _arms(p, at)
    begin = machine.start()
    hinge = at.hinge_x, at.hinge_y, rate.hinge_x, rate.hinge_y, whole.hinge_x, whole.hinge_y
    rear_shield = (  # C, on the shield beam
        at.hinge_x + at.cx,
        at.hinge_y + at.cy,
        rate.hinge_x - rate.shield * at.cy,
        rate.hinge_y + rate.shield * at.cx,
        whole.pin_x,
        whole.pin_y,
    )
    still = np.zeros_like(canopy)
    front_base = (*(still + x for x in machine.front_base), still, still, still, still)
    along_shield = _turn(minus(begin.front_shield, begin.hinge), at.sx, at.sy)
    along_link = _turn(minus(begin.front_shield, machine.front_base), at.fx, at.fy)
    places = {
        "rear_link": moved(
            rear_shield, (arm.rear_x, arm.rear_y), link - begin.rear_link, link_rate, link_turning
        ),
        "front_link": moved(front_base, (arm.front_x, arm.front_y), along_link, rate.link, whole.link),
        "shield": moved(hinge, (arm.shield_x, arm.shield_y), along_shield, rate.shield, whole.shield),
        "canopy": moved(
            hinge, (arm.canopy_x, arm.canopy_y), canopy - begin.canopy, canopy_rate, canopy_turning
        ),
    }
    columns = {"front_column": front, "rear_column": rear}
    ideal = on_link if accelerations is None else None
    return placed(linkage, [places[name] for name in BODIES], columns, ideal)


def _turn(before: Vector2, x: Vector, y: Vector) -> Vector:
    """Turn [rad] of a line that pointed along `before` and points along x, y."""
    return np.arctan2(before[0] * y - before[1] * x, before[0] * x + before[1] * y)
