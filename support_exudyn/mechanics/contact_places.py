"""Where a linkage may make contact and part: journals in bores, corners in slots, falling blocks.

What integrates, records and judges contacts goes by these places, and does not ask of which kind they are. What
a contact did at the records follows from the motion of its bodies and what it remembers.

A contact law that needs a mass has that of the start posture. The inverse effective mass W (2, 2) of a journal
against its bore has all other clearance joints open and all actuators rigid. It depends on the direction. A
pin's mass is 2 / trace(W), the harmonic mean over all directions; a guide's mass is the harmonic mean of that
along the normals of its corners.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, TypeVar

import numpy as np

from support_exudyn.mechanics.body_motion import Motion
from support_exudyn.mechanics.constraints import Shift, matrix
from support_exudyn.mechanics.kinetics import Kinetics, Matrix
from support_exudyn.mechanics.trajectory import ContactSeries, Series
from support_exudyn.model.guides import ClearanceGuide, Guide
from support_exudyn.model.linkage import GROUND, Linkage
from support_exudyn.model.loads.falling_block import FallingBlock
from support_exudyn.model.pins import ClearancePin
from support_exudyn.model.plane_geometry import plus, rotated
from support_exudyn.model.to_space import at
from user_forces.contact import SHALLOWEST, Contact
from user_forces.contact_state import PinMemory
from user_forces.normal.law import NormalLaw
from user_forces.values.value import Vector2

AnyJoint = TypeVar("AnyJoint", ClearancePin, ClearanceGuide)
PLANE = np.eye(2)
PLAY = 1e-3  # [m] of a falling block, as of a pin


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


def series(contact: Contact, moving: RelativeMotion, memories: Series | Sequence[PinMemory]) -> ContactSeries:
    """The contact at every record from the journal's motion in its bore.

    memories: what the contact remembers at each record, PinMemory's fields (n, 6).
    """
    remembered = np.asarray(memories, dtype=np.float64)
    memory = dict(zip(PinMemory._fields, remembered.T, strict=True))
    closed = memory["in_contact"] > 0.5
    # the memory was taken at the same instant: no time has passed since
    now = memory["impact_velocity"], memory["deflection"], memory["slip"], np.zeros(closed.size)
    rows = np.column_stack([*moving, closed, *now])
    force: Any = contact.forces(rows)  # arrays in place of numbers
    return ContactSeries(
        contact=contact,
        force_x=force.force_x,
        force_y=force.force_y,
        normal_force=force.normal_force,
        friction_force=force.friction_force,
        depth=force.depth,
        slip=force.slip,
        impact_velocity=np.where(closed, memory["impact_velocity"], 0.0),
        eccentricity_x=moving.x,
        eccentricity_y=moving.y,
        deflection=force.deflection if contact.friction.has_state else None,
    )


def journal_arm(contact: Contact, depth: Series) -> Series:
    """Distance of the contact point from the journal's centre [m]."""
    return np.array([contact.bearing.contact_arms(d)[1] for d in depth.tolist()])


def contact_rate(motion: Motion, place: Any, axes: Matrix = PLANE) -> Matrix:
    """The matrix of the eccentricity's rate, or of slip and depth in a slot (2, freedoms).

    Arguments:
        motion: of one instant.
        place: a `ContactPlace`, or a section of a bearing in space, which has the same contact, bodies, points.
        axes: along what, two directions of the start posture that turn with the bore, in columns.
    """
    ends = place.bore, place.bore_point, place.journal, place.journal_point
    directions = [tuple(axis[: motion.SHIFTS].tolist()) for axis in axes.T[:2]]
    carrier = place.bore  # of the walls of a slot, whose turning moves them at the corner
    if not place.contact.bearing.is_slot:
        carrier = GROUND
        directions = [tuple(motion.carried(place.bore, axis)[0].tolist()) for axis in directions]
    rows = [Shift("", "", "across_1", *ends, axis, carrier) for axis in directions]
    return np.asarray(matrix(motion, rows)[0])


@dataclass(frozen=True)
class ContactPlace:
    """A place at which two bodies may make contact: a journal in its bore, or a point between walls.

    Arguments:
        of: what of the scenario the place belongs to, such as "pins.rear_base".
        stem: what its channels begin with, such as "pin.rear_base".
        contact: geometry and laws.
        bore, journal: names of the body that encloses, and of that which is enclosed.
        bore_point, journal_point: their centres in the start posture [m]; of a slot a point of its middle line,
            and the corner.
        play: by how much the journal can go either way [m].
        direction: of a slot in the start posture [rad]; of a bore 0.
        arm: of corners at two ends of a block, from its middle [m]; else 0.
        on_block: whether the bore is the face of a falling block, which does not turn.
    """

    of: str
    stem: str
    contact: Contact
    bore: str
    journal: str
    bore_point: Vector2
    journal_point: Vector2
    play: float
    direction: float = 0.0
    arm: float = 0.0
    on_block: bool = False

    @property
    def in_slot(self) -> bool:
        """Whether only what is across counts."""
        return self.contact.bearing.is_slot

    def axes(self, linkage: Linkage) -> float:
        """Angle [rad] of the bore's axes in the start posture: those of its body, or along a slot."""
        if self.in_slot:
            return self.direction
        return 0.0 if self.bore == GROUND else linkage.bodies[self.bore].angle

    def series(self, motion: Motion, memories: Series | Sequence[PinMemory]) -> ContactSeries:
        """The contact at every record in the ground's axes, with the memory that it has there."""
        bore, journal = motion.point(self.bore, self.bore_point), motion.point(self.journal, self.journal_point)
        apart, rate = journal.position - bore.position, journal.velocity - bore.velocity
        if not self.in_slot:
            (x, y), (vx, vy) = apart.T, rate.T
            return series(self.contact, RelativeMotion(x, y, vx, vy, bore.spin, journal.spin), memories)
        c, s = math.cos(self.direction), math.sin(self.direction)
        axes = (c, s, 0.0)[: motion.SHIFTS], (-s, c, 0.0)[: motion.SHIFTS]
        along, across = (motion.carried(self.bore, axis) for axis in axes)
        x, y = _dot(apart, along), _dot(apart, across)
        # in space only blocks have such a contact, which do not turn
        spins = [one.spin if motion.SHIFTS == 2 else one.spin[:, 2] for one in (bore, journal)]
        rise = _dot(rate, across) - spins[0] * x
        moving = RelativeMotion(np.zeros_like(x), y, _dot(rate, along), rise, *spins)
        found = series(self.contact, moving, memories)
        force = found.force_x[:, None] * along + found.force_y[:, None] * across
        return replace(
            found,
            force_x=force[:, 0],
            force_y=force[:, 1],
            eccentricity_x=y * across[:, 0],
            eccentricity_y=y * across[:, 1],
        )

    def in_space(self, lateral: float) -> ContactPlace:
        """Return the same contact place at a lateral distance [m] from the middle plane."""
        ends: dict[str, Any] = {end: at(getattr(self, end), lateral) for end in ("bore_point", "journal_point")}
        return replace(self, **ends)

    def push(self, motion: Motion, contact: ContactSeries) -> tuple[Series, Series]:
        """Force of the bore on the journal [N], and the contact point at which it acts [m], (n, d) each."""
        x, y = contact.eccentricity_x, contact.eccentricity_y
        away = np.maximum(np.sqrt(x * x + y * y), SHALLOWEST)  # there is no force in the middle
        arm = journal_arm(self.contact, contact.depth) / away
        point = motion.place(self.journal, self.journal_point)
        vectors = np.zeros((2, point.shape[1], motion.count))
        vectors[:, :2] = (contact.force_x, contact.force_y), (arm * x, arm * y)
        return vectors[0].T, point + vectors[1].T

    def depth(self, channels: Mapping[str, Any]) -> Series | None:
        """The depth (n,) [m] among the channels of a run, which is a gap that is negative; None without."""
        gap = channels.get(f"{self.stem}.gap")
        found = channels.get(f"{self.stem}.depth")
        return -gap.values if gap is not None else None if found is None else found.values

    def loads(self, reactions: Mapping[str, Series]) -> Series:
        """Force on the contact (2,) [N] from what ideal joints carry in its place, by pin or guide; else 0.

        Two corners carry both the force and the moment of a guide.
        """
        if self.of not in reactions:  # a block, in whose place no joint stands
            return np.zeros(2)
        if not self.in_slot:
            return reactions[self.of]
        force, moment = (*reactions[self.of], 0.0)[:2]
        share = 0.5 * (abs(force) + abs(moment) / self.arm) if self.arm else abs(force)
        return np.asarray(share * np.array([-math.sin(self.direction), math.cos(self.direction)]))


def contact_places(
    linkage: Linkage, pins: Mapping[str, ClearancePin], guides: Mapping[str, Guide]
) -> dict[str, ContactPlace]:
    """All places by name: of pins, then of guides, as "guide.upper_left"."""
    found: dict[str, ContactPlace] = {}
    for name, pin in pins.items():
        sides = linkage.pins[name].sides
        (bore, bore_point), (journal, point) = sides if pin.bore == "first" else sides[::-1]
        found[name] = ContactPlace(
            of=f"pins.{name}",
            stem=f"pin.{name}",
            contact=pin.contact,
            bore=bore,
            journal=journal,
            bore_point=bore_point,
            journal_point=point,
            play=pin.contact.bearing.clearance,
        )
    for name, guide in guides.items():
        slide = linkage.slides[name]
        for part, (corner, middle, contact) in guide.contacts().items():
            found[f"{name}.{part}"] = ContactPlace(
                of=f"guides.{name}",
                stem=f"guide.{name}.{part}",
                contact=contact,
                bore=slide.against,
                journal=slide.body,
                bore_point=plus(slide.point, rotated((0.0, middle), slide.direction)),
                journal_point=plus(slide.point, rotated(corner, slide.direction)),
                play=contact.bearing.clearance - abs(corner[1]),
                direction=slide.direction,
                arm=abs(corner[0]),
            )
    return found


def block_places(blocks: Mapping[str, FallingBlock], gravity: Vector2) -> dict[str, ContactPlace]:
    """The faces of blocks, which a point of the machine may meet, by the blocks' names, under gravity [m/s^2].

    The block is the bore, a slot with one wall. It has no play; that by which steps and errors go is the depth
    of its first blow, or PLAY if that is less.
    """
    return {
        name: ContactPlace(
            of=f"loads.{name}",
            stem=name,
            contact=block.contact,
            bore=name,
            journal=block.body,
            bore_point=block.reference,
            journal_point=block.point,
            play=min(block.first_depth(gravity) or PLAY, PLAY),
            direction=block.slope,
            on_block=True,
        )
        for name, block in blocks.items()
    }


def _dot(one: Series, other: Series) -> Series:
    found: Series = np.einsum("ni,ni->n", one, other)
    return found


# --- masses of contact laws that need one ---


def lacks_mass(law: NormalLaw) -> bool:
    """Whether a law has a field `mass` without a number."""
    return getattr(law, "mass", 0.0) is None


def with_mass(joint: AnyJoint, name: str, linkage: Linkage, free: Kinetics) -> AnyJoint:
    """A pin or guide with a mass in its law.

    The harmonic mean of the effective masses at its places of contact in the start posture. linkage: in that
    posture. free: with all clearance joints open.
    """
    law: Any
    if isinstance(joint, ClearancePin):
        law, places = joint.contact.normal, contact_places(linkage, {name: joint}, {})
    else:
        law, places = joint.normal, contact_places(linkage, {}, {name: joint})
    still, inverses = np.zeros(3 * len(free.linkage.bodies)), []
    for place in places.values():
        inverse = free.inverse_mass(still, contact_rate(free.motion(still), place))
        along = place.axes(free.linkage)
        normal = np.array([-np.sin(along), np.cos(along)])
        inverses.append(normal @ inverse @ normal if place.in_slot else 0.5 * np.trace(inverse))
    law = replace(law, mass=1.0 / float(np.mean(inverses)))
    if isinstance(joint, ClearancePin):
        return replace(joint, contact=replace(joint.contact, normal=law))
    return replace(joint, normal=law)
