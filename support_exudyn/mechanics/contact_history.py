"""A clearance pin at all records, from the motion of its bodies and what it remembers."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion, PointMotion, pairs
from support_exudyn.mechanics.trajectory import ContactSeries, Series
from support_exudyn.model.linkage import PinPlace
from support_exudyn.model.pins import ClearancePin
from user_forces.contact import SHALLOWEST, Contact
from user_forces.contact_state import PinMemory
from user_forces.values.value import Vector2


@dataclass(frozen=True)
class PinForce:
    """A known force in a pin: of the first body on the second (n, 2) [N], and where it acts (n, 2) [m]."""

    force: Series
    point: Series


def ends(motion: BodyMotion, place: PinPlace, pin: ClearancePin) -> tuple[PointMotion, PointMotion]:
    """Motions of the bore's and of the journal's centre."""
    first = motion.point(place.first, place.first_point)
    second = motion.point(place.second, place.second_point)
    return (first, second) if pin.bore == "first" else (second, first)


def journal_end(place: PinPlace, pin: ClearancePin) -> tuple[str, Vector2]:
    """The body of the journal, and the journal's centre in the start posture [m]."""
    second = place.second, place.second_point
    return second if pin.bore == "first" else (place.first, place.first_point)


class RelativeMotion(NamedTuple):
    """A journal in its bore over time, shape (n,) each, SI, ground's axes.

    x, y, vx, vy: journal's centre minus bore's, and its rate. bore_spin, journal_spin: of their bodies.
    """

    x: Series
    y: Series
    vx: Series
    vy: Series
    bore_spin: Series
    journal_spin: Series


def contact_series(
    motion: BodyMotion, place: PinPlace, pin: ClearancePin, memories: Series | Sequence[PinMemory]
) -> ContactSeries:
    """The contact at every record, with the memory that the pin has there: PinMemory's fields, shape (n, 6)."""
    bore, journal = ends(motion, place, pin)
    x, y = (journal.position - bore.position).T
    vx, vy = (journal.velocity - bore.velocity).T
    return series(pin.contact, RelativeMotion(x, y, vx, vy, bore.spin, journal.spin), memories)


def series(contact: Contact, moving: RelativeMotion, memories: Series | Sequence[PinMemory]) -> ContactSeries:
    """The contact at every record from the journal's motion in its bore, see `contact_series`."""
    remembered = np.asarray(memories, dtype=np.float64)
    memory = dict(zip(PinMemory._fields, remembered.T, strict=True))
    closed = memory["in_contact"] > 0.5
    # the memory was taken at the same instant: no time has passed since
    now = memory["impact_velocity"], memory["deflection"], memory["slip"], np.zeros(closed.size)
    rows = np.column_stack([*moving, closed, *now])
    result, stored = contact.forces(rows)
    force: Any = result  # arrays in place of numbers
    return ContactSeries(
        force_x=force.force_x,
        force_y=force.force_y,
        normal_force=force.normal_force,
        friction_force=force.friction_force,
        depth=force.depth,
        slip=force.slip,
        impact_velocity=np.where(closed, memory["impact_velocity"], 0.0),
        eccentricity_x=moving.x,
        eccentricity_y=moving.y,
        stored=stored,
        deflection=force.deflection if contact.friction.has_state else None,
    )


def acting(motion: BodyMotion, place: PinPlace, pin: ClearancePin, contact: ContactSeries) -> PinForce:
    """A clearance pin's force of the first body on the second, and where it acts: the contact point."""
    journal = motion.place(*journal_end(place, pin))
    force = pairs(contact.force_x, contact.force_y)
    x, y = contact.eccentricity_x, contact.eccentricity_y
    away = np.maximum(np.sqrt(x * x + y * y), SHALLOWEST)  # there is no force in the middle
    arm = journal_arm(pin.contact, contact.depth) / away
    return PinForce(force if pin.bore == "first" else -force, journal + pairs(arm * x, arm * y))


def journal_arm(contact: Contact, depth: Series) -> Series:
    """Distance of the contact point from the journal's centre [m]."""
    return np.array([contact.bearing.contact_arms(d)[1] for d in depth.tolist()])
