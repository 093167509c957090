"""From records to named channels, the same names, units and signs as the redundant formulation's."""

from __future__ import annotations

import numpy as np

from support_exudyn.linkages.hydraulic_support import HydraulicSupport, Posture
from support_exudyn.plane import direction, minus
from support_exudyn.reduced import layout
from support_exudyn.reduced.posture import Vector
from support_exudyn.reduced.runge_kutta import Matrix
from user_forces.values import Vector2

CONTACT = {
    "normal_force": layout.NORMAL,
    "friction_force": layout.FRICTION,
    "depth": layout.DEPTH,
    "slip": layout.SLIP,
    "eccentricity_x": layout.OFFSET_X,
    "eccentricity_y": layout.OFFSET_Y,
}


def channels(machine: HydraulicSupport, start: Posture, rows: Matrix, loose: bool) -> dict[str, Vector]:
    """All channels of a run by name, shape (n,), SI."""
    state = rows[layout.STATE_ROW :]
    canopy = state[layout.CANOPY]
    zero = direction(machine.rear_base, start.rear_shield) - start.rear_link
    found = {
        "time": rows[layout.TIME],
        "rear_link.angle": state[layout.LINK] + zero,
        "rear_link.angular_velocity": state[layout.LINK_RATE],
        "rear_link.angular_acceleration": rows[layout.LINK_ACCELERATION],
        "canopy.angle": canopy,
        "canopy.angular_velocity": state[layout.CANOPY_RATE],
        "canopy.angular_acceleration": rows[layout.CANOPY_ACCELERATION],
    }
    hinge = rows[layout.HINGE_X], rows[layout.HINGE_Y]
    cosine, sine = np.cos(canopy), np.sin(canopy)

    def on_canopy(point: Vector2) -> tuple[Vector, Vector]:
        x, y = minus(point, machine.hinge)
        return hinge[0] + cosine * x - sine * y, hinge[1] + sine * x + cosine * y

    found["tip.x"], found["tip.y"] = on_canopy(machine.tip)
    lengths = machine.column_lengths(start)
    for name, foot, head, length, force in (
        ("front_column", machine.front_foot, machine.front_head, lengths[0], layout.FRONT_FORCE),
        ("rear_column", machine.rear_foot, machine.rear_head, lengths[1], layout.REAR_FORCE),
    ):
        x, y = on_canopy(head)
        found[f"{name}.angle"] = np.arctan2(y - foot[1], x - foot[0])
        found[f"{name}.length"] = length + rows[layout.EXTENSION]
        found[f"{name}.force"] = rows[force]
    return found | _pin(rows, loose)


def _pin(rows: Matrix, loose: bool) -> dict[str, Vector]:
    contact = rows[layout.CONTACT_ROW :]
    fx, fy = contact[layout.FORCE_X], contact[layout.FORCE_Y]
    found = {
        "pin.rear_base.force": np.hypot(fx, fy),
        "pin.rear_base.force_x": fx,
        "pin.rear_base.force_y": fy,
    }
    if loose:
        state = rows[layout.STATE_ROW :]
        found |= {f"pin.rear_base.{name}": contact[row] for name, row in CONTACT.items()}
        found["pin.rear_base.approach_speed"] = rows[layout.TOUCH_SPEED_ROW]
        found["energy.damping_loss"] = state[layout.DAMPING_LOSS]
        found["energy.friction_loss"] = state[layout.FRICTION_LOSS]
    return found
