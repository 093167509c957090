"""Inclinometers sense gravity less the acceleration of their place, and cannot distinguish the two.

    f = R^T (g - a)               specific force, in the body's own axes: x along the line by which the machine
                                  measures it, y across in the plane, z to the right
    tilt = atan2(-f_x, -f_y)      the angle of the body from +x while it is at rest
    v_P = v + omega x r           velocity of the place P, from the recorded motion of its body
    a_P(t) = (v_P(t + h) - v_P(t - h)) / 2 h

with h between records: the mean acceleration over two of them, exactly, also where impacts lie between. Of a
wave of w rad/s it is smaller than at the instant by the share (w h)^2 / 6. At both ends of the run a parabola
through three records gives it.
"""

from typing import ClassVar, Literal

import numpy as np

from support_exudyn.mechanics.body_motion import cross, rotation
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND, Linkage
from support_exudyn.model.spatial_linkage import SpatialLinkage
from support_exudyn.postprocessing.instruments.instrument import Instrument
from support_exudyn.simulation.result import Result
from user_forces.values.names import meant
from user_forces.values.units import Radians
from user_forces.values.value import InputError, NonNegative, value

WHY = "an inclinometer needs it"
LEAST = 1e-9  # determinant below which roll, yaw and angle do not determine a rotation


@value
class Inclinometer(Instrument):
    """A device that takes the direction of the specific force for that of gravity, so that it errs in motion.

    The filter acts on the specific force, axis by axis. At rest the reading is the angle of the body from the
    horizontal [rad], positive counterclockwise; with gravity along -y that is the channel BODY.angle.

    Arguments:
        body: name of the body on which it sits; "ground" is the base of a machine.
        at: where: a traced point, pin or actuator whose point on this body it is; None: its centre of mass.
        direction: "forward", by default: in the plane; "sideways": how far the body's right side is down.
        rate, low_pass, noise [rad], resolution [rad]: see `Instrument`.
    """

    UNIT: ClassVar[str] = "rad"

    body: str
    at: str | None = None
    direction: Literal["forward", "sideways"] = "forward"
    noise: Radians[NonNegative] = 0.0
    resolution: Radians[NonNegative] = 0.0

    def signals(self, result: Result) -> Series:
        """The specific force at the place (n, 3) [m/s^2], in the body's own axes."""
        return specific_force(result, self.body, self.at)

    def reading(self, signals: Series) -> Series:
        """The tilt (n,) [rad] that the device assigns to the body."""
        x, y, z = signals.T
        if self.direction == "sideways":
            return np.asarray(np.arctan2(z, np.hypot(x, y)))
        return np.asarray(np.unwrap(np.arctan2(0.0 - x, -y)))  # of 0, not of -0


def specific_force(result: Result, body: str, at: str | None = None) -> Series:
    """Gravity less the acceleration of a place, in the axes of its body (n, 3) [m/s^2].

    Arguments:
        result: a run in the plane or in space.
        body: name of the body, or "ground".
        at: the place: a traced point, pin or actuator whose point on this body it is; None: centre of mass.

    Raises InputError if the machine has no such body or place, or if the run has not recorded its motion.
    """
    scenario = result.scenario
    linkage: Linkage | SpatialLinkage = scenario.space if scenario.dimensions == 3 else scenario.linkage
    gravity = np.array([*scenario.gravity, 0.0])
    if body != GROUND and body not in linkage.bodies:
        raise InputError(
            f"body = {body!r}: the machine has no such body; {meant(body, [GROUND, *linkage.bodies])}"
        )
    point = _place_on(linkage, body, at)
    if body == GROUND:
        return np.tile(gravity, (result.time.size, 1))
    start = linkage.bodies[body]
    turn = _recorded_turn(result, body, start.angle)
    arm = turn @ (point - _in_space(start.centre))
    velocity = _recorded(result, body, "velocity_x", "velocity_y", "velocity_z")
    velocity += cross(
        _recorded(result, body, "angular_velocity_x", "angular_velocity_y", "angular_velocity"), arm
    )
    acceleration = np.gradient(velocity, float(result.time[1] - result.time[0]), axis=0, edge_order=2)
    axes = turn @ _about_z(np.array(start.angle))
    return np.asarray(np.einsum("nji,nj->ni", axes, gravity - acceleration))


def _place_on(linkage: Linkage | SpatialLinkage, body: str, at: str | None) -> Series:
    """A place on a body in the start posture (3,) [m]; None: the centre of mass, of the ground the origin.

    Raises InputError if nothing of this name is on the body.
    """
    if at is None:
        return np.zeros(3) if body == GROUND else _in_space(linkage.bodies[body].centre)
    joints = linkage.bearings if isinstance(linkage, SpatialLinkage) else linkage.pins
    ends = [(name, one.body, one.point) for name, one in linkage.points.items()]
    ends += [(name, one.first, one.first_point) for name, one in joints.items()]
    ends += [(name, one.second, one.second_point) for name, one in joints.items()]
    ends += [(name, one.foot, one.foot_point) for name, one in linkage.actuators.items()]
    ends += [(name, one.head, one.head_point) for name, one in linkage.actuators.items()]
    places = {name: point for name, on, point in reversed(ends) if on == body}
    if at not in places:
        raise InputError(f"at = {at!r}: no such place on {body}; {meant(at, places)}")
    return _in_space(places[at])


def _in_space(point: tuple[float, ...]) -> Series:
    return np.array([*point, 0.0][:3])


def _recorded(result: Result, body: str, *names: str) -> Series:
    """Recorded components of a vector of a body (n, 3); in the plane those out of it are zero."""
    plane = ("velocity_x", "velocity_y", "angular_velocity")
    known = [name if result.scenario.dimensions == 3 or name in plane else "" for name in names]
    zero = np.zeros(result.time.size)
    return np.stack([result.recorded(f"{body}.{name}", WHY) if name else zero for name in known], axis=-1)


# --- how a body has turned since the start ---


def _about_z(angle: Series) -> Series:
    """Rotation matrices (..., 3, 3) by angles about z (...) [rad]."""
    zero = np.zeros_like(angle)
    return rotation(np.stack([np.cos(0.5 * angle), zero, zero, np.sin(0.5 * angle)], axis=-1))


def _recorded_turn(result: Result, body: str, start: float) -> Series:
    """Rotation matrices of a body since its start angle [rad], (n, 3, 3), in the plane or in space.

    Raises InputError if the run has not recorded its angles, or if in space they do not determine the rotation.
    """
    angle = result.recorded(f"{body}.angle", WHY) - start
    if result.scenario.dimensions == 2:
        return _about_z(angle)
    turn = turn_of(result.recorded(f"{body}.roll", WHY), result.recorded(f"{body}.yaw", WHY), angle)
    if turn is None:
        raise InputError(
            f"{body}: it cannot be told from roll, yaw and angle how it has turned; allowed: bodies that turn "
            "less to the side"
        )
    return turn


def turn_of(roll: Series, yaw: Series, angle: Series) -> Series | None:
    """Rotation matrices A (n, 3, 3) by three recorded angles (n,) [rad]; None if these do not determine them.

        angle = atan2(A_10, A_00),   roll = atan2(A_21, A_11),   yaw = atan2(A_02, A_22)

    So the columns are multiples of (cos angle, sin angle, p), (q, cos roll, sin roll), (sin yaw, s, cos yaw).
    That they are perpendicular to each other are three linear equations for p, q and s.
    """
    (cr, sr), (cy, sy), (ca, sa) = ((np.cos(one), np.sin(one)) for one in (roll, yaw, angle))
    zero = np.zeros_like(angle)
    rows = ((sr, ca, zero), (zero, sy, cr), (cy, zero, sa))
    matrix = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
    if np.abs(np.linalg.det(matrix)).min() < LEAST:
        return None
    right = np.stack([-sa * cr, -sr * cy, -ca * sy], axis=-1)
    p, q, s = np.linalg.solve(matrix, right[..., None])[..., 0].T
    columns = np.stack([np.stack(row, axis=-1) for row in ((ca, q, sy), (sa, cr, s), (p, sr, cy))], axis=-2)
    return np.asarray(columns / np.linalg.norm(columns, axis=-2, keepdims=True))
