"""The engine's side of a pin with clearance: markers and connector.

Without friction it is the engine's spring-damper between two points: a force along the line of centres
conserves momentum and angular momentum wherever on that line it acts. With friction it is the rigid-body
connector, and if both bodies move, that in its intrinsic form, which applies force and moment in the middle
between both marker points, so that they act at one point on both bodies. That is exact only while both marker
frames are parallel: with frames turned by an angle a against each other the engine's displacement is longer
than the distance of the points by (a/2)/sin(a/2), and as much angular momentum is lost. The journal's marker
frame is therefore turned along, so that a stays small.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from exudyn.itemInterface import (
    MarkerBodyRigid,
    ObjectConnectorRigidBodySpringDamper,
    ObjectConnectorSpringDamper,
)

from support_exudyn.formulations.redundant.clearance.connector_force import (
    Attachment,
    Relative,
    attachment,
    displacement_scale,
    in_slot,
    slot_directions,
)
from user_forces.contact import Contact
from user_forces.values.value import Vector2

# Largest turn between the marker frames before they are lined up again [rad]: the displacement is then
# right within 4e-10 of itself, and the rest is corrected.
FRAME_TURN = 1e-4
HANGS_BY = 0.01  # [m] that the spring by which a block hangs would give under the weight of all bodies
LEAST = 1.0  # [N], stands for that weight where there is none


Frame = list[list[float]]


class Mount(NamedTuple):
    """Where a bore or a journal is in the engine.

    item: its body. frame: on the body, in the body's axes (4 x 4): its centre, and its axis as z.
    """

    item: Any
    frame: Frame
    on_ground: bool


class PinConnector:
    """Markers and connector of one clearance pin in the engine.

    Arguments:
        mbs: the engine's system.
        contact: bearing and laws, from which follows what the force acts on.
        bore, journal: where they are.
        turn: of the journal's frame relative to the bore's about the axis [rad].
    """

    def __init__(
        self,
        mbs: Any,
        contact: Contact,
        bore: Mount,
        journal: Mount,
        turn: float,
    ) -> None:
        self.mbs, self.contact = mbs, contact
        self.clearance = contact.bearing.clearance
        self.bore_on_ground = bore.on_ground
        self.at = at = attachment(contact, bore.on_ground, journal.on_ground)
        self._bore, self._journal = np.array(bore.frame), np.array(journal.frame)
        self._journal_shift = 0.0
        self.frame_turn = -turn if at is Attachment.MIDDLE else 0.0  # of the journal's frame on its body [rad]
        self.bore_marker = mbs.AddMarker(MarkerBodyRigid(bodyNumber=bore.item, localHT=bore.frame))
        self.journal_marker = mbs.AddMarker(MarkerBodyRigid(bodyNumber=journal.item, localHT=self._frame()))
        self.object = mbs.AddObject(self._connector([self.bore_marker, self.journal_marker]))

    def _connector(self, markers: list[Any]) -> Any:
        if self.at is Attachment.LINE:  # what it is stretched by is the depth
            return ObjectConnectorSpringDamper(markerNumbers=markers, referenceLength=self.clearance)
        return ObjectConnectorRigidBodySpringDamper(
            markerNumbers=markers, useIntrinsicFormulation=self.at is Attachment.MIDDLE
        )

    def set_force(self, function: Any) -> None:
        """Let this user function, Python's or symbolic, give force and moment."""
        self.mbs.SetObjectParameter(self.object, user_function(self.at)[1], function)

    def settle(self, load: float, share: Callable[[], float]) -> None:
        """Let the contact's elastic part act instead, and a spring that pulls a free journal to the middle.

        load: that is to be held [N]. share: see `ClearanceJoint.settling`.
        """

        def stiffness(eccentricity: float) -> float:
            pressed = self._pressed(eccentricity, load, share() * self.clearance)
            return share() * load / self.clearance + (pressed / eccentricity if pressed else 0.0)

        self._set_spring(stiffness)

    def _pressed(self, eccentricity: float, load: float, deepest: float) -> float:
        """Elastic force of the contact [N] while a static equilibrium is looked for.

        eccentricity: [m]. load: [N], by which it may be pressed so deep [m].
        """
        depth = self.contact.bearing.depth(eccentricity)
        return self.contact.normal.force_in_search(depth, load, deepest) if depth > 0.0 else 0.0

    def _set_spring(self, stiffness: Callable[[float], float]) -> None:
        """Let a spring between both centres act instead, its stiffness [N/m] given by their distance [m]."""
        if self.at is Attachment.LINE:

            def tension(mbs: Any, t: float, item: int, depth: float, *others: Any) -> float:
                eccentricity = depth + self.clearance
                return stiffness(eccentricity) * eccentricity

            self.set_force(tension)
            return

        def force(mbs: Any, t: float, item: int, displacement: list[float], *others: Any) -> list[float]:
            # the rigid-body connector hands over the rotation next
            scale = displacement_scale(others[0][2]) if self.at is Attachment.MIDDLE else 1.0
            x, y = scale * displacement[0], scale * displacement[1]
            hold = stiffness(math.hypot(x, y))
            return [hold * x, hold * y, 0.0, 0.0, 0.0, 0.0]

        self.set_force(force)

    def line_up(self, turn: float) -> bool:
        """Line up the marker frames if the journal's will have turned by so much [rad]; whether it was done."""
        if abs(turn) <= FRAME_TURN:
            return False
        self.frame_turn = math.remainder(self.frame_turn - turn, 2.0 * math.pi)
        self.mbs.SetMarkerParameter(self.journal_marker, "localHT", self._frame())
        return True

    def slide(self, bore: float, journal: float) -> None:
        """Let the force act beside both centres, by so much along bore and journal [m]."""
        slid = self._bore.copy()
        slid[:3, 3] += bore * slid[:3, 2]
        self.mbs.SetMarkerParameter(self.bore_marker, "localHT", slid.tolist())
        if journal != self._journal_shift:
            self._journal_shift = journal
            self.mbs.SetMarkerParameter(self.journal_marker, "localHT", self._frame())

    def _frame(self) -> Frame:
        turned = self._journal @ frame((0.0, 0.0), self.frame_turn)
        turned[:3, 3] += self._journal_shift * turned[:3, 2]
        found: list[list[float]] = turned.tolist()
        return found


class SlotConnector(PinConnector):
    """Markers and connector of one corner between walls in the engine.

    Arguments as of `PinConnector`, and: rest: distance of the corner from the middle line [m] with which the
    block is in the middle of its play.
    """

    def __init__(
        self, mbs: Any, contact: Contact, bore: Mount, journal: Mount, turn: float, rest: float
    ) -> None:
        super().__init__(mbs, contact, bore, journal, turn)
        self._rest = rest

    def settle(self, load: float, share: Callable[[], float]) -> None:
        """Let a spring pull the block across the slot to the middle of its play, see `PinConnector.settle`."""
        play = self.clearance - abs(self._rest)

        def force(
            mbs: Any, t: float, item: int, displacement: list[float], rotation: list[float], *others: Any
        ) -> list[float]:
            half = 0.5 * rotation[2]
            scale = displacement_scale(rotation[2]) if self.at is Attachment.MIDDLE else 1.0
            apart = Relative(scale * displacement[0], scale * displacement[1], 0.0, 0.0)
            along, (_, y, *_) = in_slot(self.at, apart, half)
            pull = share() * load / play * (y - self._rest)
            pull += math.copysign(self._pressed(abs(y), load, share() * play), y)
            fx, fy, moment = slot_directions(self.at, along, 1.0, 0.0, half)[0]
            return [pull * fx, pull * fy, 0.0, 0.0, 0.0, pull * moment]

        self.set_force(force)


class FaceConnector(PinConnector):
    """Markers and connector of a point at the face of a falling block in the engine.

    Arguments as of `PinConnector`, and: start_depth: how far the point is behind the face at the start [m].
    """

    def __init__(
        self, mbs: Any, contact: Contact, bore: Mount, journal: Mount, turn: float, start_depth: float
    ) -> None:
        super().__init__(mbs, contact, bore, journal, turn)
        self._rest = self.clearance + start_depth

    def settle(self, load: float, share: Callable[[], float]) -> None:
        """The block, whose weight does not act meanwhile, hangs over its point by a spring, as at the start."""
        del share
        stiffness = max(load, LEAST) / HANGS_BY

        def force(
            mbs: Any, t: float, item: int, displacement: list[float], rotation: list[float], *others: Any
        ) -> list[float]:
            half = 0.5 * rotation[2]
            scale = displacement_scale(rotation[2]) if self.at is Attachment.MIDDLE else 1.0
            apart = Relative(scale * displacement[0], scale * displacement[1], 0.0, 0.0)
            along, (_, y, *_) = in_slot(self.at, apart, half)
            fx, fy, moment = slot_directions(self.at, along, 1.0, 0.0, half)[0]
            pull = stiffness * (y - self._rest)
            return [pull * fx, pull * fy, 0.0, 0.0, 0.0, pull * moment]

        self.set_force(force)


def frame(centre: Vector2, turn: float = 0.0) -> Frame:
    """A frame in the plane, turned by an angle [rad], as the engine wants it (4 x 4)."""
    c, s = math.cos(turn), math.sin(turn)
    x, y = centre
    return [[c, -s, 0.0, x], [s, c, 0.0, y], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]


def user_function(at: Attachment) -> tuple[str, str]:
    """The engine's names of the connector and of its force's user function."""
    if at is Attachment.LINE:
        return "ObjectConnectorSpringDamper", "springForceUserFunction"
    return "ObjectConnectorRigidBodySpringDamper", "springForceTorqueUserFunction"
