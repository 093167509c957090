"""The right-hand side: state in, its rate out."""

from __future__ import annotations

from support_exudyn.reduced.compiled import compiled
from support_exudyn.reduced.contact import contact_force
from support_exudyn.reduced.dynamics import accelerations, balance, mobility
from support_exudyn.reduced.layout import (
    CANOPY,
    CANOPY_RATE,
    DAMPING,
    DAMPING_LOSS,
    FORCE_X,
    FORCE_Y,
    FRICTION,
    FRICTION_LOSS,
    JOURNAL_ON_LINK,
    LINK,
    LINK_RATE,
    MOBILITY_XX,
    MOBILITY_XY,
    MOBILITY_YY,
    MOMENT,
    SLIP,
)
from support_exudyn.reduced.posture import Vector, dead_centre, driven, posture, rates


@compiled
def evaluate(
    p: Vector, segment: Vector, memory: Vector, t: float, y: Vector, slope: Vector, contact: Vector
) -> None:
    """Write the rate of the state y at time t [s] into `slope` and the contact into `contact`."""
    drive = driven(segment, t)
    at = posture(p, y[CANOPY], y[LINK], drive.extension)
    rate = rates(p, at, y[CANOPY_RATE], y[LINK_RATE], drive.extension, drive.speed)
    contact_force(p, memory, at, rate, y[LINK_RATE], contact)
    law = balance(p, at, rate, y[CANOPY_RATE], y[LINK_RATE], drive, 1.0)
    slope[CANOPY], slope[LINK] = y[CANOPY_RATE], y[LINK_RATE]
    slope[CANOPY_RATE], slope[LINK_RATE] = accelerations(
        at, law, contact[FORCE_X], contact[FORCE_Y], contact[MOMENT]
    )
    slope[DAMPING_LOSS] = contact[DAMPING]
    slope[FRICTION_LOSS] = -contact[FRICTION] * contact[SLIP]


@compiled
def observe(p: Vector, segment: Vector, memory: Vector, t: float, y: Vector, contact: Vector) -> None:
    """The contact alone, without accelerations."""
    drive = driven(segment, t)
    at = posture(p, y[CANOPY], y[LINK], drive.extension)
    rate = rates(p, at, y[CANOPY_RATE], y[LINK_RATE], drive.extension, drive.speed)
    contact_force(p, memory, at, rate, y[LINK_RATE], contact)


@compiled
def approach(p: Vector, segment: Vector, t: float, y: Vector, near: Vector) -> None:
    """Write into `near` how near the state y is to a dead centre, see `dead_centre`."""
    drive = driven(segment, t)
    at = posture(p, y[CANOPY], y[LINK], drive.extension)
    rate = rates(p, at, y[CANOPY_RATE], y[LINK_RATE], drive.extension, drive.speed)
    dead_centre(at, rate, y[CANOPY_RATE], near)


@compiled
def freeze_mobility(p: Vector, segment: Vector, memory: Vector, t: float, y: Vector) -> None:
    """Remember how easily the journal moves against the bore now, in the bore's axes."""
    drive = driven(segment, t)
    at = posture(p, y[CANOPY], y[LINK], drive.extension)
    still = rates(p, at, 0.0, 0.0, drive.extension, 0.0)
    xx, xy, yy = mobility(at, balance(p, at, still, 0.0, 0.0, drive, 0.0))
    if p[JOURNAL_ON_LINK] == 0.0:
        c, s = at.cos_link, at.sin_link
        xx, xy, yy = (
            c * c * xx + 2.0 * c * s * xy + s * s * yy,
            (c * c - s * s) * xy + c * s * (yy - xx),
            s * s * xx - 2.0 * c * s * xy + c * c * yy,
        )
    memory[MOBILITY_XX], memory[MOBILITY_XY], memory[MOBILITY_YY] = xx, xy, yy
