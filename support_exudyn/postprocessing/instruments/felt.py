"""What a place on a body feels, gravity less acceleration, from the records of a run.

    v_P = v + omega x r          velocity of the place P, from the recorded motion of its body
    a_P(t) = (v_P(t + h) - v_P(t - h)) / 2 h

with h between records: the mean acceleration over two of them, exactly, also where impacts lie between. Of a
wave of w rad/s it is smaller than at the instant by the share (w h)^2 / 6. At both ends of the run a parabola
through three records gives it.
"""

import numpy as np

from support_exudyn.mechanics.space.motion import cross
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND, Linkage
from support_exudyn.model.spatial_linkage import SpatialLinkage
from support_exudyn.postprocessing.instruments.orientation import about_z, recorded_turn
from support_exudyn.simulation.result import Result
from user_forces.values.names import meant
from user_forces.values.value import InputError

WHY = "an inclinometer needs it"


def felt(result: Result, body: str, at: str | None = None) -> Series:
    """Gravity less the acceleration of a place, in the axes of its body (n, 3) [m/s^2].

    The body's x axis is the line by which the machine measures it.

    Arguments:
        result: a run in the plane or in space.
        body: name of the body, or "ground".
        at: the place: a traced point, pin or actuator whose point on this body it is; None: centre of mass.

    Raises InputError if the machine has no such body or place, or if the run has not recorded its motion.
    """
    scenario = result.scenario
    space = scenario.dimensions == 3
    linkage: Linkage | SpatialLinkage = scenario.space if space else scenario.linkage
    gravity = np.array([*scenario.gravity, 0.0])
    if body != GROUND and body not in linkage.bodies:
        raise InputError(
            f"body = {body!r}: the machine has no such body; {meant(body, [GROUND, *linkage.bodies])}"
        )
    point = place_on(linkage, body, at)
    if body == GROUND:
        return np.tile(gravity, (result.time.size, 1))
    turn = recorded_turn(result, body)
    velocity = _velocity(result, body, turn @ (point - _in_space(linkage.bodies[body].centre)))
    period = float(result.time[1] - result.time[0])
    acceleration = np.gradient(velocity, period, axis=0, edge_order=2)
    axes = turn @ about_z(np.array(linkage.bodies[body].angle))
    return np.asarray(np.einsum("nji,nj->ni", axes, gravity - acceleration))


def place_on(linkage: Linkage | SpatialLinkage, body: str, at: str | None) -> Series:
    """A place on a body in the start posture (3,) [m]; None: the centre of mass, of the ground the origin.

    Raises InputError if nothing of this name is on the body.
    """
    if at is None:
        return np.zeros(3) if body == GROUND else _in_space(linkage.bodies[body].centre)
    joints = linkage.bearings if isinstance(linkage, SpatialLinkage) else linkage.pins
    found = {name: point.point for name, point in linkage.points.items() if point.body == body}
    for name, joint in joints.items():
        for one, point in ((joint.first, joint.first_point), (joint.second, joint.second_point)):
            if one == body:
                found.setdefault(name, point)
    for name, actuator in linkage.actuators.items():
        for one, point in ((actuator.foot, actuator.foot_point), (actuator.head, actuator.head_point)):
            if one == body:
                found.setdefault(name, point)
    if at not in found:
        raise InputError(f"at = {at!r}: no such place on {body}; {meant(at, found)}")
    return _in_space(found[at])


def _in_space(point: tuple[float, ...]) -> Series:
    return np.array([*point, 0.0][:3])


def _velocity(result: Result, body: str, arm: Series) -> Series:
    """Velocity of the place at the end of an arm from the centre of mass (n, 3) [m/s]."""

    def recorded(*names: str) -> Series:
        found = np.zeros((result.time.size, 3))
        for n, name in enumerate(names):
            if name:
                found[:, n] = result.recorded(f"{body}.{name}", WHY)
        return found

    if result.scenario.dimensions == 2:
        return recorded("velocity_x", "velocity_y") + cross(recorded("", "", "angular_velocity"), arm)
    spin = recorded("angular_velocity_x", "angular_velocity_y", "angular_velocity")
    return recorded("velocity_x", "velocity_y", "velocity_z") + cross(spin, arm)
