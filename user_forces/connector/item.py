"""The engine's side of a clearance joint: two markers, a connector between them, and its user function.

The engine hands over the motion of the journal's marker against the bore's in the bore's axes, and takes force
and moment in the same axes. The force acts

- without friction on both centres, along the line of centres: no moment (unless the journal may move along the
  axis of its bore, where only the distance across counts);
- with friction on the centre of the body that moves, if the other is the ground;
- in the middle between both centres, if both move, so that both feel the force at the same point of space.

The last is Exudyn's intrinsic formulation, whose axes lie in the middle between both marker frames. Its
displacement is longer than the distance of the points by (a/2)/sin(a/2), a the angle between these frames, and
so is the arm of the force. The journal's marker frame is turned along, so that a stays small.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import Enum
from functools import cache
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

from user_forces.contact import Contact
from user_forces.friction.laws import Frictionless
from user_forces.kernel import compiled_or_plain

# Largest turn between the marker frames before they are lined up again [rad]: the displacement is then
# right within 4e-10 of itself, and the rest is corrected.
FRAME_TURN = 1e-4
OUTPUT = exudyn.OutputVariableType
CURRENT, INITIAL = exudyn.ConfigurationType.Current, exudyn.ConfigurationType.Initial
KINDS = (OUTPUT.Position, OUTPUT.Velocity, OUTPUT.RotationMatrix, OUTPUT.AngularVelocity)
Frame = list[list[float]]
Array = npt.NDArray[np.float64]


class Attachment(Enum):
    """Where the force of a clearance joint acts; share: of the way from there to the journal's centre."""

    CENTRES = "both centres, along the line of centres"
    JOURNAL = "the journal's centre; the bore is on the ground"
    BORE = "the bore's centre; the journal is on the ground"
    MIDDLE = "both bodies, in the middle between the centres"


SHARE = {Attachment.CENTRES: 0.0, Attachment.JOURNAL: 0.0, Attachment.MIDDLE: 0.5, Attachment.BORE: 1.0}


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


# --- the force in the connector's axes ---


def connector_kernel(force: Callable[..., Any], at: Attachment, is_slot: bool) -> Callable[..., Any]:
    """A contact's force kernel in the connector's axes, see `JointItem.kernel` for its arguments.

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
def compiled_kernel(force: Callable[..., Any], at: Attachment, is_slot: bool) -> Callable[..., Any]:
    """`connector_kernel` as machine code, or in Python if numba cannot compile the laws."""
    plain = connector_kernel(force, at, is_slot)
    return compiled_or_plain(plain, (*9 * (0.0,), False, *4 * (0.0,), np.zeros(1)))


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


# --- markers and connector ---


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
        is_round: whether only the distance across the axis counts, see `attachment`.
        options: of the connector, such as a post-Newton step for the stock solver.

    The force depends on the motion and on these: closed, speed: whether the surfaces are in contact, and the
    velocity of their impact [m/s]. deflection [m], slip [m/s], step [s]: of a friction law with a state at the
    start of the step, and its length. last: what the kernel gave last. turn: between the marker frames then
    [rad], [rad/s]. along: of the journal's marker along the axis [m], [m/s]. calls: of the user function.
    """

    def __init__(
        self, mbs: Any, contact: Contact, bore: Mount, journal: Mount, is_round: bool = False, **options: Any
    ) -> None:
        self.mbs, self.contact = mbs, contact
        self.at = attachment(contact, bore.on_ground, journal.on_ground, is_round)
        self._bore, self._journal = np.array(bore.frame), np.array(journal.frame)
        self._shift = self._frame_turn = 0.0  # of the journal's frame along and about the axis [m], [rad]
        self.bore_marker = mbs.AddMarker(MarkerBodyRigid(bodyNumber=bore.item, localHT=bore.frame))
        self.journal_marker = mbs.AddMarker(MarkerBodyRigid(bodyNumber=journal.item, localHT=journal.frame))
        markers = [self.bore_marker, self.journal_marker]
        # Without friction a spring-damper between both points costs the engine less than two frames; its
        # stretch is the depth. It has no post-Newton step.
        self.on_line = self.at is Attachment.CENTRES and not options
        connector: Any
        if self.on_line:
            connector = ObjectConnectorSpringDamper(
                markerNumbers=markers,
                referenceLength=contact.bearing.clearance,
                visualization=VObjectConnectorSpringDamper(show=False),
            )
            kernel = compiled_line_kernel(contact.force_kernel)
        else:
            connector = ObjectConnectorRigidBodySpringDamper(
                markerNumbers=markers,
                useIntrinsicFormulation=self.at is Attachment.MIDDLE,
                visualization=VObjectConnectorRigidBodySpringDamper(show=False),
                **options,
            )
            kernel = compiled_kernel(contact.force_kernel, self.at, contact.bearing.is_slot)
        self.object = mbs.AddObject(connector)
        self.kernel, self.constants = kernel, np.array(contact.constants)
        self._own = self.kernel, self.constants
        self.closed, self.speed, self.deflection, self.slip, self.step = False, 0.0, 0.0, 0.0, 0.0
        self.last: tuple[float, ...] = ()
        self.turn = self.along = 0.0, 0.0
        self.calls = 0
        self.set_force(self.stretched if self.on_line else self.moved)

    def set_force(self, function: Callable[..., Any]) -> None:
        """Let a user function give force and moment, or the force along the line of centres."""
        name = "springForceUserFunction" if self.on_line else "springForceTorqueUserFunction"
        self.mbs.SetObjectParameter(self.object, name, function)

    def use(self, kernel: Callable[..., Any] | None = None, constants: Any = None) -> None:
        """Let another kernel act with its constants, or that of the contact again."""
        self.kernel, self.constants = self._own if kernel is None else (kernel, constants)

    def moved(
        self,
        mbs: Any,
        t: float,
        item: int,
        displacement: list[float],
        rotation: list[float],
        velocity: list[float],
        angular_velocity: list[float],
        *settings: Any,
    ) -> list[float]:
        """The user function: force [N] and moment [N m] that pull the markers together."""
        x, y, z = displacement
        vx, vy, vz = velocity
        self.calls += 1
        self.turn, self.along = (rotation[2], angular_velocity[2]), (z, vz)
        spin = self.bore_spin() if self.at is Attachment.MIDDLE else 0.0  # else it is not used
        self.last = force = self.kernel(
            x, y, z, vx, vy, vz, rotation[2], angular_velocity[2], spin,
            self.closed, self.speed, self.deflection, self.slip, self.step, self.constants,
        )  # fmt: skip
        if math.isnan(force[7]):
            self.contact.normal.check(force[4])
        return [force[0], force[1], force[2], 0.0, 0.0, force[3]]

    def stretched(self, mbs: Any, t: float, item: int, depth: float, rate: float, *settings: Any) -> Any:
        """The user function of a spring-damper: force [N] that pulls the markers together."""
        self.calls += 1
        self.last = force = self.kernel(depth, rate, self.closed, self.speed, self.constants)
        if math.isnan(force[0]):
            self.contact.normal.check(depth)
        return force[0]

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
        self._place_journal()
        return True

    def slide(self, bore: float, journal: float) -> None:
        """Let the force act away from both centres, by so much along bore and journal [m]."""
        slid = self._bore.copy()
        slid[:3, 3] += bore * slid[:3, 2]
        self.mbs.SetMarkerParameter(self.bore_marker, "localHT", slid.tolist())
        if journal != self._shift:
            self._shift = journal
            self._place_journal()

    def _place_journal(self) -> None:
        turned = self._journal @ np.array(frame((0.0, 0.0), self._frame_turn))
        turned[:3, 3] += self._shift * turned[:3, 2]
        self.mbs.SetMarkerParameter(self.journal_marker, "localHT", turned.tolist())


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
