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
from scipy.spatial.transform import Rotation

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND, Linkage
from support_exudyn.model.spatial_linkage import SpatialLinkage
from support_exudyn.postprocessing.instruments.instrument import Instrument
from support_exudyn.postprocessing.look.poses import Poses
from support_exudyn.simulation.result import Result
from user_forces.values.names import meant
from user_forces.values.units import Radians
from user_forces.values.value import InputError, NonNegative, value


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
    place = _place_on(linkage, body, at)
    if body == GROUND:
        return np.tile(gravity, (result.time.size, 1))
    pose = Poses(result).of(body)
    turn = pose.turn
    arm = np.zeros(3) if place is None else np.array([*place, 0.0][:3]) - pose.start
    velocity = pose.velocity + np.cross(pose.spin, turn @ arm)
    acceleration = np.gradient(velocity, float(result.time[1] - result.time[0]), axis=0, edge_order=2)
    axes = turn @ Rotation.from_euler("z", linkage.bodies[body].angle).as_matrix()
    return np.asarray(np.einsum("nji,nj->ni", axes, gravity - acceleration))


def _place_on(linkage: Linkage | SpatialLinkage, body: str, at: str | None) -> tuple[float, ...] | None:
    """A place on a body in the start posture [m]; None: the centre of mass.

    Raises InputError if nothing of this name is on the body.
    """
    if at is None:
        return None
    joints = linkage.bearings if isinstance(linkage, SpatialLinkage) else linkage.pins
    ends = [(name, one.body, one.point) for name, one in linkage.points.items()]
    ends += [(name, one.first, one.first_point) for name, one in joints.items()]
    ends += [(name, one.second, one.second_point) for name, one in joints.items()]
    ends += [(name, one.foot, one.foot_point) for name, one in linkage.actuators.items()]
    ends += [(name, one.head, one.head_point) for name, one in linkage.actuators.items()]
    places: dict[str, tuple[float, ...]] = {name: point for name, on, point in reversed(ends) if on == body}
    if at not in places:
        raise InputError(f"at = {at!r}: no such place on {body}; {meant(at, places)}")
    return places[at]
