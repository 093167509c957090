"""The force of a clearance pin's connector: where it acts, what it is told, and its formulas for both backends.

Without friction the force acts along the line of centres: forces at both centres, no moment. Depth and rate are
all it needs. With friction force and moment act at the moving body's centre if the other body is the ground,
and in the middle between both centres if both move, so that they act at one point on both bodies.

A corner in a slot is a journal that slides freely along: what is along the slot does not push. Its force is
that of the rigid-body connector, friction or not, with the moment of what is along.

Formulas take numbers or expressions: `python_force` writes them out as source, `symbolic_force` as the engine's
expressions. At the ends of steps and at the records `Contact.force` tells all parts of the same force.
"""

from enum import Enum
from functools import partial
from types import SimpleNamespace
from typing import Any, NamedTuple, cast

from user_forces.contact import Contact, ContactForce, SlipHistory
from user_forces.expressions.scalar import cos, maximum, sin
from user_forces.friction.laws import Frictionless


class Attachment(Enum):
    """What the force of a pin acts on."""

    LINE = "both centres, without a moment; all that is known is their distance and its rate"
    JOURNAL = "the journal's centre; the bore is on the ground"
    BORE = "the bore's centre; the journal is on the ground"
    MIDDLE = "both bodies, in the middle between the centres"


# of the way from the point at which the force acts to the journal's centre, in that from the bore's centre
SHARE = {Attachment.JOURNAL: 0.0, Attachment.MIDDLE: 0.5, Attachment.BORE: 1.0}


def attachment(contact: Contact, bore_on_ground: bool, journal_on_ground: bool) -> Attachment:
    """What the force of a contact acts on."""
    # what is across the walls of a slot is not what is along the line of centres
    if isinstance(contact.friction, Frictionless) and not contact.bearing.is_slot:
        return Attachment.LINE
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


def line_force(contact: Contact, depth: float, rate: float, speed: float) -> float:
    """The push [N] that depends on depth [m] and rate [m/s] alone, in an impact with a speed [m/s]."""
    return maximum(contact.normal(depth, rate, speed), 0.0)


def rough_force(
    contact: Contact,
    at: Attachment,
    motion: Relative,
    speed: float,
    history: SlipHistory,
) -> tuple[ContactForce, float]:
    """The force, and the arm [m] of its friction about the point at which the connector lets it act.

    Arguments:
        contact: bearing and laws. at: what the force acts on.
        motion: of the journal in its bore. speed: of the impact [m/s].
        history: of friction laws with a state, the step whose end this is.
    """
    found = contact.force(*motion[:4], *motion.spins(at), speed, history)
    eccentricity = contact.bearing.outwards(motion.x, motion.y)[0]
    return found, found.journal_arm + SHARE[at] * eccentricity


def in_slot(at: Attachment, motion: Relative, half_turn: float) -> tuple[float, Relative]:
    """How far a corner is along its slot [m], and what counts of its motion, in the axes of the slot.

    Arguments:
        at: what the force acts on.
        motion: in the axes of the connector.
        half_turn: of these against the slot [rad], which is small; 0 unless both bodies move.
    """
    x, y, vx, vy, turning, bore_spin = motion
    if at is Attachment.MIDDLE:
        c, s = cos(half_turn), sin(half_turn)
        x, y, vx, vy = c * x - s * y, s * x + c * y, c * vx - s * vy, s * vx + c * vy
    if at is not Attachment.JOURNAL:  # the walls turn, and so move across where the corner is
        vy = vy - motion.spins(at)[0] * x
    return x, Relative(0.0, y, vx, vy, turning, bore_spin)


def slot_directions(
    at: Attachment, along: float, side: float, arm: float, half_turn: float
) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """Force x and y and moment of the connector for 1 N of normal force, and of friction.

    Arguments:
        at, half_turn: as of `in_slot`.
        along: of the corner along the slot [m]. side: 1 at the upper wall, -1 at the lower.
        arm: of friction, see `rough_force` [m].
    """
    c, s = (cos(half_turn), sin(half_turn)) if at is Attachment.MIDDLE else (1.0, 0.0)
    moment = SHARE[at] * along * side
    return (s * side, c * side, moment), (c * side, -s * side, -arm)


def displacement_scale(turn: float) -> float:
    """Distance of the marker points over the engine's displacement, see `connector`.

    sin(a/2)/(a/2) of the turn a [rad] by its series: right to rounding as long as frames are lined up. Takes a
    number or an expression.
    """
    square = 0.25 * turn * turn
    return 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0))


def straightened(contact: Contact, offset: Any, slope: Any) -> Contact:
    """The contact with a line in place of its law of friction; offset and slope may be expressions."""

    def line(slip: Any, normal_force: Any, deflection: float = 0.0) -> Any:
        return normal_force * (slip * slope + offset)

    return with_friction(contact, line)


def with_friction(contact: Contact, friction: Any) -> Contact:
    """The contact with a function of slip, normal force and deflection, without a state, as law of friction."""
    friction.has_state = False
    found: Any = SimpleNamespace(bearing=contact.bearing, normal=contact.normal, friction=friction)
    found.force = partial(Contact.force, found)
    return cast(Contact, found)
