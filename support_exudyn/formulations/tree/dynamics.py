"""Equations of motion of a tree at many instants at once: M q'' = Q.

Every coordinate j turns all links that it carries about its joint. With c_b the centre of mass of link b, p_j
the joint and x turned by 90 degrees written as x', link b moves with (c_b - p_j)' by coordinate j, so that

    M_jk = sum of m_b (c_b - p_j)' . (c_b - p_k)' + J_b,   Q_j = sum of m_b (c_b - p_j)' . (g - b_b) + moments

over the links that both, or j, carry; b_b is the acceleration of the centre of mass without any q''.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from support_exudyn.formulations.tree.branches import Matrix, Tree
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.model.linkage import PinPlace
from user_forces.values.value import Vector2


@dataclass(frozen=True)
class PointForce:
    """A force of a body on another one at many instants: bodies' names, force (m, 2) [N], where (m, 2) [m]."""

    of: str
    on: str
    force: Matrix
    point: Matrix


@dataclass(frozen=True)
class TreePosture:
    """A tree of n links at m instants: coordinates and rates (m, n).

    Vectors have the shape (m, n, 2): axes of the ground.
    """

    tree: Tree
    position: Matrix
    velocity: Matrix

    @cached_property
    def turn(self) -> Matrix:
        """The turn of every link from the start on [rad], shape (m, n)."""
        return self._summed(self.position)

    @cached_property
    def spin(self) -> Matrix:
        """Angular velocity of every link [rad/s], shape (m, n)."""
        return self._summed(self.velocity)

    @cached_property
    def joint(self) -> Matrix:
        """Where the joints are [m]."""
        found = np.empty((*self.position.shape, 2))
        for n, arm in enumerate(self._joint_arms):
            carrier = self.tree.links[n].carrier
            found[:, n] = arm if carrier < 0 else found[:, carrier] + arm
        return found

    @cached_property
    def centre(self) -> Matrix:
        """Where the centres of mass are [m]."""
        return self.joint + self._centre_arms

    @cached_property
    def reach(self) -> Matrix:
        """(c_b - p_j)', zero where j does not carry b, shape (m, n, n, 2): instant, link b, coordinate j."""
        return self.tree.carried[:, :, None] * _turned(self.centre[:, :, None] - self.joint[:, None])

    @cached_property
    def centre_velocity(self) -> Matrix:
        """The velocities of the centres of mass [m/s]."""
        joint = np.zeros((*self.position.shape, 2))
        spin = self.spin[:, :, None]
        for n, arm in enumerate(self._joint_arms):
            carrier = self.tree.links[n].carrier
            if carrier >= 0:
                joint[:, n] = joint[:, carrier] + spin[:, carrier] * _turned(arm)
        return np.asarray(joint + spin * _turned(self._centre_arms))

    @cached_property
    def bias(self) -> Matrix:
        """Acceleration of the centres of mass without any q'' [m/s^2]."""
        joint = np.zeros((*self.position.shape, 2))
        square = (self.spin**2)[:, :, None]
        for n, arm in enumerate(self._joint_arms):
            carrier = self.tree.links[n].carrier
            if carrier >= 0:
                joint[:, n] = joint[:, carrier] - square[:, carrier] * arm
        return joint - square * self._centre_arms

    def _summed(self, coordinates: Matrix) -> Matrix:
        """Coordinates, or their rates, of every link and of those that carry it, shape (m, n)."""
        found = np.array(coordinates)
        for n, link in enumerate(self.tree.links):
            if link.carrier >= 0:
                found[:, n] += found[:, link.carrier]
        return found

    @cached_property
    def _joint_arms(self) -> list[Matrix]:
        """Of every joint from the carrier's, (m, 2); from the origin for one in the ground."""
        arms = []
        for link in self.tree.links:
            arm = np.array(self.tree.arm(link.carrier, link.joint))
            turn = self.turn[:, link.carrier] if link.carrier >= 0 else np.zeros(len(self.position))
            arms.append(_rotated(arm, turn))
        return arms

    @cached_property
    def _centre_arms(self) -> Matrix:
        arms = [self.tree.arm(n, link.body.centre) for n, link in enumerate(self.tree.links)]
        return np.stack([_rotated(np.array(arm), self.turn[:, n]) for n, arm in enumerate(arms)], axis=1)

    def motion(self, acceleration: Matrix | None = None) -> BodyMotion:
        """Motion of the bodies in the order of the linkage, from q'' [rad/s^2], shape (m, n), if known."""
        order = self.tree.order
        start = np.array([link.body.centre for link in self.tree.links])
        unknown = np.zeros_like(self.position) if acceleration is None else acceleration
        linear = np.zeros_like(self.centre) if acceleration is None else self.acceleration(acceleration)

        def rows(vector: Matrix, turning: Matrix) -> Matrix:
            both = np.concatenate([vector, turning[:, :, None]], axis=2)[:, order]
            return both.reshape(len(both), -1)

        return BodyMotion(
            self.tree.linkage,
            rows(self.centre - start, self.turn),
            rows(self.centre_velocity, self.spin),
            rows(linear, self._summed(unknown)),
        )

    def acceleration(self, acceleration: Matrix) -> Matrix:
        """The accelerations of the centres of mass [m/s^2], from q'' [rad/s^2], shape (m, n)."""
        return np.asarray(np.einsum("mbjx,mj->mbx", self.reach, acceleration) + self.bias)


def mass_matrix(posture: TreePosture) -> Matrix:
    """M [kg m^2], shape (m, n, n)."""
    links = posture.tree.links
    mass, inertia = (
        np.array(values) for values in zip(*((b.body.mass, b.body.inertia) for b in links), strict=True)
    )
    carried = posture.tree.carried
    moving = np.einsum("b,mbjx,mbkx->mjk", mass, posture.reach, posture.reach, optimize=True)
    return np.asarray(moving + carried.T @ (inertia[:, None] * carried))


def accelerations(posture: TreePosture, gravity: Vector2, forces: list[PointForce]) -> Matrix:
    """q'' [rad/s^2], shape (m, n)."""
    moment = mass_moment(posture, gravity)
    for item in forces:
        moment += moments(posture, item.on, item.point, item.force)
        moment -= moments(posture, item.of, item.point, item.force)
    return np.asarray(np.linalg.solve(mass_matrix(posture), moment[:, :, None])[:, :, 0])


def mass_moment(posture: TreePosture, gravity: Vector2) -> Matrix:
    """Generalised forces [N m] of weight and of inertia without any q'', shape (m, n)."""
    mass = np.array([link.body.mass for link in posture.tree.links])
    fall = mass[:, None] * (np.array(gravity) - posture.bias)
    return np.asarray(np.einsum("mbjx,mbx->mj", posture.reach, fall))


def moments(posture: TreePosture, body: str, point: Matrix, force: Matrix) -> Matrix:
    """Generalised forces [N m] of a force on a body, shape (m, n)."""
    number = posture.tree.number(body)
    if number < 0:
        return np.zeros_like(posture.position)
    arm = point[:, None] - posture.joint
    about = arm[:, :, 0] * force[:, None, 1] - arm[:, :, 1] * force[:, None, 0]
    return np.asarray(posture.tree.carried[number] * about)


def pin_inverse_mass(
    posture: TreePosture, place: PinPlace, pressed: Sequence[tuple[PinPlace, Matrix]] = ()
) -> Matrix:
    """How a clearance pin's eccentricity answers an impulse at the first instant, (2, 2) [1/kg], ground's axes.

    pressed: places of other pins and their normals (2,). Each adds a row and a column, (2 + m, 2 + m), see
    `pressed.inverse effective masses`.
    """
    rows = [_eccentricity_rate(posture, place)]
    rows += [along[None] @ _eccentricity_rate(posture, other) for other, along in pressed]
    rate = np.concatenate(rows)
    return np.asarray(rate @ np.linalg.solve(mass_matrix(posture)[0], rate.T))


def _eccentricity_rate(posture: TreePosture, place: PinPlace) -> Matrix:
    """What turns the coordinates' rates into that of a pin's eccentricity at the first instant, (2, n)."""
    motion = posture.motion()
    rate = np.zeros((2, posture.position.shape[1]))
    for sign, body, centre in ((1.0, place.second, place.second_point), (-1.0, place.first, place.first_point)):
        point = motion.point(body, centre).position
        for axis, unit in enumerate(np.eye(2)):
            rate[axis] += sign * moments(posture, body, point, unit[None])[0]
    return rate


def _rotated(vector: Matrix, angle: Matrix) -> Matrix:
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]], axis=-1)


def _turned(vector: Matrix) -> Matrix:
    return np.stack([-vector[..., 1], vector[..., 0]], axis=-1)
