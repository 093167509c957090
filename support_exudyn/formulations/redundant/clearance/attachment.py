"""Where the engine's connector lets the force of a pin with clearance act, and what it is then told.

Without friction the force acts along the line of centres: forces at both centres, no moment. If the law does
not ask for the mass that moves either, which depends on the direction, depth and rate are all it needs. With
friction force and moment act at the moving body's centre if the other body is the ground, and in the middle
between both centres if both move, so that they act at one point on both bodies.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from enum import Enum
from typing import NamedTuple

from user_forces.compilation.flat import asks_for_mass
from user_forces.contact import ContactForce, JournalContact, SlipHistory
from user_forces.expressions.scalar import hypot
from user_forces.friction.frictionless import Frictionless
from user_forces.normal.law import Touch


class Attachment(Enum):
    """What the force of a pin acts on."""

    LINE = "both centres, without a moment; all that is known is their distance and its rate"
    CENTRAL = "both centres, without a moment"
    JOURNAL = "the journal's centre; the bore is on the ground"
    BORE = "the bore's centre; the journal is on the ground"
    SPACE = "both centres, without a moment; bodies move in space"
    MIDDLE = "both bodies, in the middle between the centres"


def attachment(
    contact: JournalContact, bore_on_ground: bool, journal_on_ground: bool, in_space: bool = False
) -> Attachment:
    """What the force of a contact acts on."""
    if isinstance(contact.friction, Frictionless):
        if not asks_for_mass(contact):
            return Attachment.LINE
        return Attachment.SPACE if in_space else Attachment.CENTRAL
    if bore_on_ground:
        return Attachment.JOURNAL
    return Attachment.BORE if journal_on_ground else Attachment.MIDDLE


class Relative(NamedTuple):
    """Motion of a journal in its bore as the connector knows it; numbers or expressions.

    x, y, vx, vy: journal's centre minus bore's and its rate [m], [m/s]. turning: of the journal against the
    bore, bore_spin: of the bore [rad/s]; the latter is used only if both bodies move, both only with friction.
    """

    x: float
    y: float
    vx: float
    vy: float
    turning: float = 0.0
    bore_spin: float = 0.0

    def spins(self, at: Attachment) -> tuple[float, float]:
        """Angular velocities of bore and journal [rad/s]."""
        if at is Attachment.BORE:
            return -self.turning, 0.0
        if at is Attachment.MIDDLE:
            return self.bore_spin, self.bore_spin + self.turning
        return 0.0, self.turning


def in_plane(displacement: Sequence[float], velocity: Sequence[float]) -> tuple[float, float, float, float]:
    """Displacement and velocity in space as ones across the bore's axis, with the same distance and rate.

    Sections of a tilted journal lie a little beside those of the bore, by less than the square of the tilt
    times the length; their distance is that of their centres.
    """
    x, y, z = displacement
    vx, vy, vz = velocity
    across = math.hypot(x, y)
    if across == 0.0:
        return x, y, vx, vy
    distance = math.hypot(across, z)
    rate = (x * vx + y * vy + z * vz) / distance - (x * vx + y * vy) / across
    stretch = distance / across
    return stretch * x, stretch * y, vx + rate * x / across, vy + rate * y / across


def rough_force(
    contact: JournalContact, at: Attachment, motion: Relative, touch: Touch, history: SlipHistory
) -> tuple[ContactForce, float]:
    """The force, and the arm [m] of its friction about the point at which the connector lets it act."""
    found = contact.force(*motion[:4], *motion.spins(at), touch, history)
    eccentricity = hypot(motion.x, motion.y)
    share = {Attachment.JOURNAL: 0.0, Attachment.MIDDLE: 0.5, Attachment.BORE: 1.0}[at]
    return found, found.journal_arm + share * eccentricity
