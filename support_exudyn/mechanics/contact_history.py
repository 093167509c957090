"""A clearance pin at all records, from the motion of its bodies and what it remembers."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion, PointMotion, pairs
from support_exudyn.mechanics.contact_state import PinMemory
from support_exudyn.mechanics.joint_forces import PinForce
from support_exudyn.mechanics.trajectory import ContactSeries, Series
from support_exudyn.model.linkage import PinPlace
from support_exudyn.model.pins import ClearancePin
from user_forces.contact import SHALLOWEST, Contact, ContactForce, SlipHistory
from user_forces.expressions.arrays import as_number, values_of
from user_forces.values.value import Vector2


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
    force = _force(contact, moving, memory)
    count = moving.x.size
    depth = values_of(force.depth, count)
    pressed = closed & (depth > 0.0)

    def where_pressed(values: float) -> Series:
        return np.where(pressed, values_of(values, count), 0.0)

    stored = of_depth(contact.normal.elastic_energy, np.maximum(depth, SHALLOWEST))
    return ContactSeries(
        force_x=where_pressed(force.force_x),
        force_y=where_pressed(force.force_y),
        normal_force=where_pressed(force.normal_force),
        friction_force=where_pressed(force.friction_force),
        depth=depth,
        slip=values_of(force.slip, count),
        impact_velocity=np.where(closed, memory["impact_velocity"], 0.0),
        eccentricity_x=moving.x,
        eccentricity_y=moving.y,
        stored=np.where(depth > 0.0, stored, 0.0),
        deflection=where_pressed(force.deflection) if contact.friction.has_state else None,
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
    return values_of(contact.bearing.contact_arms(as_number(depth))[1], depth.size)


def _force(contact: Contact, moving: RelativeMotion, memory: dict[str, Series]) -> ContactForce:
    """The contact's force as if the surfaces been in contact at every record."""
    try:
        return _at_once(contact, moving, memory)
    except TypeError:  # a law that branches takes numbers only
        return _one_by_one(contact, moving, memory)


def of_depth(function: Callable[[float], float], depth: Series) -> Series:
    """What a law says of every depth, its force [N] or energy [J]; or any function written as laws are."""
    try:
        return values_of(function(as_number(depth)), depth.size)
    except TypeError:  # it branches
        return np.array([function(d) for d in depth.tolist()])


def _one_by_one(contact: Contact, moving: RelativeMotion, memory: dict[str, Series]) -> ContactForce:
    """The contact's force, record by record."""
    remembered = np.column_stack([memory[n] for n in ("impact_velocity", "deflection", "slip")]).tolist()
    found = []
    for (velocity, deflection, slip), (x, y, vx, vy, bore_spin, journal_spin) in zip(
        remembered, np.column_stack(moving).tolist(), strict=True
    ):
        now = SlipHistory(deflection, slip, 0.0)
        found.append(contact.force(x, y, vx, vy, bore_spin, journal_spin, velocity, now))
    return ContactForce(*(as_number(np.array(values)) for values in zip(*found, strict=True)))  # type: ignore[arg-type]


def _at_once(contact: Contact, moving: RelativeMotion, memory: dict[str, Series]) -> ContactForce:
    """The contact's force, for all records at once."""
    # the memory has been taken at the same instant: no time has passed since
    now = SlipHistory(as_number(memory["deflection"]), as_number(memory["slip"]), 0.0)
    x, y, vx, vy, bore_spin, journal_spin = map(as_number, moving)
    velocity = as_number(memory["impact_velocity"])
    with np.errstate(divide="ignore", invalid="ignore"):  # where the surfaces are apart
        return contact.force(x, y, vx, vy, bore_spin, journal_spin, velocity, now)
