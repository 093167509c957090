"""Where the force of a contact acts, and its kernel in the axes of the engine's connector.

The engine hands over the motion of the journal's marker against the bore's in the bore's axes. The force acts

- without friction on both centres, along the line of centres: no moment (unless the journal may move along the
  axis of its bore, where only the distance across counts);
- with friction on the centre of the body that moves, if the other is the ground;
- in the middle between both centres, if both move, so that both feel the force at the same point of space.
  That is Exudyn's intrinsic formulation, whose axes lie in the middle between both marker frames. Its
  displacement is longer than the distance of the points by (a/2)/sin(a/2), a the angle between these frames.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import Enum
from functools import cache
from typing import Any

import numpy as np

from user_forces.contact import Contact
from user_forces.friction.laws import Frictionless
from user_forces.kernel import compiled_or_plain


class Attachment(Enum):
    """Where the force of a clearance joint acts, by the share of the way from there to the journal's centre."""

    CENTRES = "both centres, along the line of centres"
    JOURNAL = "the journal's centre; the bore is on the ground"
    BORE = "the bore's centre; the journal is on the ground"
    MIDDLE = "both bodies, in the middle between the centres"


SHARE = {Attachment.CENTRES: 0.0, Attachment.JOURNAL: 0.0, Attachment.MIDDLE: 0.5, Attachment.BORE: 1.0}


@cache
def compiled_kernel(force: Callable[..., Any], at: Attachment, is_slot: bool) -> Callable[..., Any]:
    """The connector's kernel as machine code, or in Python if numba cannot compile the laws."""
    plain = connector_kernel(force, at, is_slot)
    return compiled_or_plain(plain, (*9 * (0.0,), False, *4 * (0.0,), np.zeros(1)))


def connector_kernel(force: Callable[..., Any], at: Attachment, is_slot: bool) -> Callable[..., Any]:
    """A contact's force kernel in the connector's axes: arguments of `ConnectorForce.kernel`.

    It gives force (3) and moment of the connector [N], [N m], then `ContactForce`, then x and y [m].

    Arguments:
        force: see `force_kernel_of`.
        at: where it acts. is_slot: whether only what is across the slot counts.
    """
    share, middle, bore = SHARE[at], at is Attachment.MIDDLE, at is Attachment.BORE
    on_centres = at is Attachment.CENTRES

    def connector(
        x: float, y: float, z: float, vx: float, vy: float, vz: float, turn: float, turning: float,
        bore_spin: float, closed: bool, speed: float, deflection: float, slip: float, step: float,
        constants: Any,
    ) -> Any:  # fmt: skip
        memory = closed, speed, deflection, slip, step, constants
        if on_centres:
            distance = math.sqrt(x * x + y * y + z * z)
            if distance == 0.0:
                return 0.0, 0.0, 0.0, 0.0, *force(0.0, 0.0, vx, vy, 0.0, 0.0, *memory), x, y
            rate = (x * vx + y * vy + z * vz) / distance
            result = force(distance, 0.0, rate, 0.0, 0.0, 0.0, *memory)
            pull = result[3] / distance
            return pull * x, pull * y, pull * z, 0.0, *result, x, y
        c, s, along = 1.0, 0.0, 0.0
        if middle:
            square = 0.25 * turn * turn  # sin(a/2)/(a/2) by its series
            scale = 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0))
            x, y = scale * x, scale * y
        if bore:
            bore_spin = -turning
        if is_slot:
            if middle:  # the connector's axes are half of the turn from those of the slot
                c, s = math.cos(0.5 * turn), math.sin(0.5 * turn)
                x, y, vx, vy = c * x - s * y, s * x + c * y, c * vx - s * vy, s * vx + c * vy
            along, x, vy = x, 0.0, vy - bore_spin * x  # the walls turn, and so move across at the corner
        result = force(x, y, vx, vy, bore_spin, bore_spin + turning, *memory)
        fx, fy, friction = result[5], result[6], result[4]
        arm = result[7] + share * math.sqrt(x * x + y * y)
        moment = -share * along * fy - arm * friction
        return -c * fx - s * fy, s * fx - c * fy, 0.0, moment, *result, x, y

    return connector


@cache
def compiled_line_kernel(force: Callable[..., Any]) -> Callable[..., Any]:
    """A force kernel without friction for a connector that knows depth and rate alone, as machine code.

    It gives what `connector_kernel` gives, the force along the line of centres first.
    """

    def line(depth: float, rate: float, closed: bool, speed: float, constants: Any) -> Any:
        distance = constants[1] + depth
        result = force(distance, 0.0, rate, 0.0, 0.0, 0.0, closed, speed, 0.0, 0.0, 0.0, constants)
        return result[3], 0.0, 0.0, 0.0, *result, distance, 0.0

    return compiled_or_plain(line, (0.0, 0.0, False, 0.0, np.zeros(1)))


def attachment(
    contact: Contact, bore_on_ground: bool, journal_on_ground: bool, is_round: bool = False
) -> Attachment:
    """Where the force of a contact acts.

    is_round: whether only what is across the bore's axis counts, as in a model in space that leaves the journal
    free along the axis.
    """
    if isinstance(contact.friction, Frictionless) and not contact.bearing.is_slot and not is_round:
        return Attachment.CENTRES
    if bore_on_ground:
        return Attachment.JOURNAL
    return Attachment.BORE if journal_on_ground else Attachment.MIDDLE
