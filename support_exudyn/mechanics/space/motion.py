"""Where bodies and points are in space, from the engine's coordinates: one state, or many at once.

The engine's seven coordinates of a body are the displacement of its centre and the change of its Euler
parameters from 1, 0, 0, 0. Arrays have the instants first, then the bodies in the order of the linkage.

    A = rotation since the start,   omega = 2 G p'

with G the 3 x 4 matrix of the Euler parameters p, in the ground's axes.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.spatial_linkage import SpatialLinkage
from user_forces.values.value import Vector3

COORDINATES = 7  # of a body
UNTURNED = np.array([1.0, 0.0, 0.0, 0.0])


def cross(a: Series, b: Series) -> Series:
    """Vector product of (..., 3) and (..., 3); six times as fast as numpy's for few."""
    x, y, z = a[..., 0], a[..., 1], a[..., 2]
    u, v, w = b[..., 0], b[..., 1], b[..., 2]
    found = np.empty(np.broadcast_shapes(a.shape, b.shape))
    found[..., 0], found[..., 1], found[..., 2] = y * w - z * v, z * u - x * w, x * v - y * u
    return found


def rotation(p: Series) -> Series:
    """Rotation matrices (..., 3, 3) of Euler parameters (..., 4)."""
    a, b, c, d = np.moveaxis(p, -1, 0)
    rows = [
        [a * a + b * b - c * c - d * d, 2.0 * (b * c - a * d), 2.0 * (b * d + a * c)],
        [2.0 * (b * c + a * d), a * a - b * b + c * c - d * d, 2.0 * (c * d - a * b)],
        [2.0 * (b * d - a * c), 2.0 * (c * d + a * b), a * a - b * b - c * c + d * d],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def turning_matrix(p: Series) -> Series:
    """G (..., 3, 4): angular velocity in the ground's axes is 2 G p'."""
    a, b, c, d = np.moveaxis(p, -1, 0)
    return np.moveaxis(np.array([[-b, a, -d, c], [-c, d, a, -b], [-d, -c, b, a]]), (0, 1), (-2, -1))


def parameter_rates(p: Series, spin: Series) -> Series:
    """Rates (..., 4) of Euler parameters that belong to an angular velocity (..., 3): G^T omega / 2."""
    rates: Series = 0.5 * np.einsum("...ij,...i->...j", turning_matrix(p), spin)
    return rates


class SpatialPointMotion(NamedTuple):
    """A point of a body over time, (n, 3) each: position, velocity, arm from the body's centre; SI."""

    position: Series
    velocity: Series
    arm: Series


@dataclass(frozen=True)
class SpatialMotion:
    """All bodies of a linkage.

    displacement, velocity: of the centres (n, b, 3). turn: rotation since the start (n, b, 3, 3). spin:
    (n, b, 3), ground's axes.
    """

    linkage: SpatialLinkage
    displacement: Series
    turn: Series
    velocity: Series
    spin: Series

    @property
    def count(self) -> int:
        """Number of instants."""
        return len(self.displacement)

    def index(self, body: str) -> int:
        """Place of a body."""
        return list(self.linkage.bodies).index(body)

    def carried(self, body: str, vector: Vector3 | Series) -> Series:
        """A vector of the start posture that turns with a body, (n, 3)."""
        if body == GROUND:
            return np.tile(np.asarray(vector, dtype=np.float64), (self.count, 1))
        return np.asarray(self.turn[:, self.index(body)] @ np.asarray(vector))

    def spin_of(self, body: str) -> Series:
        """Angular velocity of a body, (n, 3) [rad/s]."""
        return np.zeros((self.count, 3)) if body == GROUND else self.spin[:, self.index(body)]

    def point(self, body: str, point: Vector3) -> SpatialPointMotion:
        """Motion of a point of the start posture."""
        if body == GROUND:
            still = np.zeros((self.count, 3))
            return SpatialPointMotion(self.carried(GROUND, point), still, still)
        n = self.index(body)
        centre = np.array(self.linkage.bodies[body].centre)
        arm = self.carried(body, np.array(point) - centre)
        return SpatialPointMotion(
            centre + self.displacement[:, n] + arm, self.velocity[:, n] + cross(self.spin[:, n], arm), arm
        )


def motion_of(linkage: SpatialLinkage, position: Series, velocity: Series) -> SpatialMotion:
    """The motion from coordinates of shape (n, 7 bodies) or (7 bodies,), in the order of the linkage."""
    shape = (-1, len(linkage.bodies), COORDINATES)
    q, v = np.reshape(position, shape), np.reshape(velocity, shape)
    p = q[..., 3:] + UNTURNED
    matrix = turning_matrix(p)
    return SpatialMotion(
        linkage,
        q[..., :3],
        rotation(p),
        v[..., :3],
        2.0 * np.einsum("nbij,nbj->nbi", matrix, v[..., 3:]),
    )
