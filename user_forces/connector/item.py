"""The engine's side of a clearance joint: two markers and a connector between them.

Without friction it is a spring-damper between both points, whose force acts along the line of centres.

With friction it is the rigid-body connector, and if both bodies move the intrinsic one, whose force acts midway
between both marker points. It conserves angular momentum only while both marker frames are parallel: turned by
an angle a against each other, the arm of the force is longer by (a/2)/sin(a/2). The journal's marker frame is
therefore turned along, so that a stays small.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import exudyn
import numpy as np
import numpy.typing as npt
from exudyn.itemInterface import (
    MarkerBodyRigid,
    ObjectConnectorRigidBodySpringDamper,
    ObjectConnectorSpringDamper,
    VObjectConnectorRigidBodySpringDamper,
    VObjectConnectorSpringDamper,
)

from user_forces.connector.attachment import Attachment, attachment
from user_forces.connector.user_function import ConnectorForce, LineForce
from user_forces.contact import Contact

# Largest turn between the marker frames before they are lined up again [rad]: the displacement is then
# right within 4e-10 of itself, and the rest is corrected.
FRAME_TURN = 1e-4
OUTPUT = exudyn.OutputVariableType
CURRENT, INITIAL = exudyn.ConfigurationType.Current, exudyn.ConfigurationType.Initial
Frame = list[list[float]]
Array = npt.NDArray[np.float64]


class Mount(NamedTuple):
    """Where a bore or a journal is in the engine.

    item: its body. frame: on the body, in the body's axes (4 x 4): its centre, and its axis as z.
    """

    item: Any
    frame: Frame
    on_ground: bool


class Relative(NamedTuple):
    """How the journal's marker moves against the bore's, as the engine hands it to the user function.

    displacement, velocity: in the connector's axes [m], [m/s]. turn, turning: of the marker frames against each
    other about the axis [rad], [rad/s]. bore_spin: of the bore about the axis [rad/s].
    """

    displacement: list[float]
    velocity: list[float]
    turn: float
    turning: float
    bore_spin: float


class JointItem:
    """Markers and connector of a clearance joint, of a corner in a slot, or of a point at a face.

    Arguments:
        mbs: the engine's system.
        contact: bearing and laws, from which follows where the force acts.
        bore, journal: where they are.
        turn: of the journal's frame relative to the bore's about the axis [rad].
        is_round: whether only the distance across the axis counts, see `attachment`.
        options: of the connector, such as a post-Newton step for the stock solver.
    """

    def __init__(
        self,
        mbs: Any,
        contact: Contact,
        bore: Mount,
        journal: Mount,
        turn: float,
        is_round: bool = False,
        **options: Any,
    ) -> None:
        self.mbs, self.contact = mbs, contact
        self.clearance = contact.bearing.clearance
        self.at = attachment(contact, bore.on_ground, journal.on_ground, is_round)
        self._bore, self._journal = np.array(bore.frame), np.array(journal.frame)
        self._shift = 0.0
        self._frame_turn = -turn if self.at is Attachment.MIDDLE else 0.0  # of the journal's frame [rad]
        self.bore_marker = mbs.AddMarker(MarkerBodyRigid(bodyNumber=bore.item, localHT=bore.frame))
        self.journal_marker = mbs.AddMarker(MarkerBodyRigid(bodyNumber=journal.item, localHT=self._frame()))
        # a spring-damper between two points has no post-Newton step
        self.on_line = self.at is Attachment.CENTRES and not options
        self.object = mbs.AddObject(self._connector([self.bore_marker, self.journal_marker], options))

    def _connector(self, markers: list[Any], options: dict[str, Any]) -> Any:
        if self.on_line:  # what it is stretched by is the depth
            hidden = VObjectConnectorSpringDamper(show=False)
            return ObjectConnectorSpringDamper(
                markerNumbers=markers, referenceLength=self.clearance, visualization=hidden
            )
        return ObjectConnectorRigidBodySpringDamper(
            markerNumbers=markers,
            useIntrinsicFormulation=self.at is Attachment.MIDDLE,
            visualization=VObjectConnectorRigidBodySpringDamper(show=False),
            **options,
        )

    def own_force(self) -> ConnectorForce:
        """The user function of the contact that belongs to the connector, which acts from now on."""
        kind = LineForce if self.on_line else ConnectorForce
        function = kind(self.contact, self.at, self.bore_spin)
        self.set_force(function)
        return function

    def set_force(self, function: Callable[..., Any]) -> None:
        """Let a user function give force and moment, or the force along the line of centres."""
        name = "springForceUserFunction" if self.on_line else "springForceTorqueUserFunction"
        self.mbs.SetObjectParameter(self.object, name, function)

    def bore_spin(self, state: Any = CURRENT) -> float:
        """Angular velocity of the bore about its axis [rad/s]."""
        return float(self.mbs.GetMarkerOutput(self.bore_marker, OUTPUT.AngularVelocityLocal, state)[2])

    def relative(self, state: Any = CURRENT) -> Relative:
        """How the journal moves against the bore in a state of the engine."""
        bore, journal = (
            [np.asarray(self.mbs.GetMarkerOutput(marker, kind, state)) for kind in KINDS]
            for marker in (self.bore_marker, self.journal_marker)
        )
        axes, other = bore[2].reshape(3, 3), journal[2].reshape(3, 3)
        rotation = rotation_vector(axes.T @ other)
        if self.at is Attachment.MIDDLE:
            axes = axes @ rotation_matrix(0.5 * rotation)
        d, v, spin = (axes.T @ (journal[k] - bore[k]) for k in (0, 1, 3))
        turn, half = float(rotation[2]), 0.5 * float(rotation[2])
        if self.at is Attachment.MIDDLE and half:
            d *= half / math.sin(half)
        return Relative(d.tolist(), v.tolist(), turn, float(spin[2]), self.bore_spin(state))

    def line_up(self, turn: float) -> bool:
        """Line up the marker frames if the journal's will have turned by so much [rad]; whether it was done."""
        if self.at is not Attachment.MIDDLE or abs(turn) <= FRAME_TURN:
            return False
        self._frame_turn = math.remainder(self._frame_turn - turn, 2.0 * math.pi)
        self.mbs.SetMarkerParameter(self.journal_marker, "localHT", self._frame())
        return True

    def slide(self, bore: float, journal: float) -> None:
        """Let the force act away from both centres, by so much along bore and journal [m]."""
        slid = self._bore.copy()
        slid[:3, 3] += bore * slid[:3, 2]
        self.mbs.SetMarkerParameter(self.bore_marker, "localHT", slid.tolist())
        if journal != self._shift:
            self._shift = journal
            self.mbs.SetMarkerParameter(self.journal_marker, "localHT", self._frame())

    def _frame(self) -> Frame:
        turned = self._journal @ np.array(frame((0.0, 0.0), self._frame_turn))
        turned[:3, 3] += self._shift * turned[:3, 2]
        rows: Frame = turned.tolist()
        return rows


KINDS = (OUTPUT.Position, OUTPUT.Velocity, OUTPUT.RotationMatrix, OUTPUT.AngularVelocity)


def frame(centre: tuple[float, float], turn: float = 0.0) -> Frame:
    """A frame in the plane, turned by an angle [rad], as the engine wants it (4 x 4)."""
    c, s = math.cos(turn), math.sin(turn)
    x, y = centre
    return [[c, -s, 0.0, x], [s, c, 0.0, y], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]


def rotation_vector(matrix: Array) -> Array:
    """The rotation vector [rad] (3) of a rotation matrix by less than half a turn."""
    twice = np.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]])
    sine, cosine = 0.5 * float(np.linalg.norm(twice)), 0.5 * float(np.trace(matrix) - 1.0)
    return 0.5 * twice * (math.atan2(sine, cosine) / sine if sine else 1.0)


def rotation_matrix(vector: Array) -> Array:
    """The rotation matrix of a rotation vector [rad] (3), by Rodrigues' formula."""
    angle = float(np.linalg.norm(vector))
    if not angle:
        return np.eye(3)
    x, y, z = vector / angle
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross)
