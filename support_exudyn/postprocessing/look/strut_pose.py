"""Where the cylinder and the rod of a strut are at a record, and how fast points of them move."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.look.poses import Poses
from support_exudyn.postprocessing.look.solid import Strut

ACROSS = np.array([0.0, 0.0, 1.0])
UP = np.array([0.0, 1.0, 0.0])
ALONG_Z = 0.99  # cosine, above which a direction has no use for z as its neighbour


@dataclass(frozen=True)
class StrutPose:
    """A strut at a record, ground's axes.

    Arguments:
        foot, head: where its ends are, shape (3,) [m].
        foot_velocity, head_velocity: of these, shape (3,) [m/s].
        axes: in columns, shape (3, 3): x from foot to head, z as near to the ground's z as can be (to y if it
            stands along z). A strut does not turn about itself against them.
        turning: their rate, shape (3, 3) [1/s].
    """

    foot: Series
    head: Series
    foot_velocity: Series
    head_velocity: Series
    axes: Series
    turning: Series

    def cylinder(self, points: Series) -> tuple[Series, Series]:
        """Positions [m] and velocities [m/s] of points (m, 3) of `Strut.cylinder`."""
        return self.foot + points @ self.axes.T, self.foot_velocity + points @ self.turning.T

    def rod(self, points: Series) -> tuple[Series, Series]:
        """Positions [m] and velocities [m/s] of points (m, 3) of `Strut.rod`."""
        return self.head + points @ self.axes.T, self.head_velocity + points @ self.turning.T


def strut_pose(strut: Strut, poses: Poses, record: int) -> StrutPose:
    """A strut of a run at a record."""
    foot, foot_velocity = _end(poses, strut.foot, np.array([strut.foot_point]), record)
    head, head_velocity = _end(poses, strut.head, np.array([strut.head_point]), record)
    axes, turning = axes_along(head - foot, head_velocity - foot_velocity)
    return StrutPose(foot, head, foot_velocity, head_velocity, axes, turning)


def _end(poses: Poses, body: str, point: Series, record: int) -> tuple[Series, Series]:
    pose = poses.of(body)
    return pose.points(point, record)[0], pose.velocities(point, record)[0]


def strut_axes(way: Series) -> Series:
    """Axes of a strut in columns, shape (3, 3), as in `StrutPose`; way: from foot to head, shape (3,) [m]."""
    return axes_along(way, np.zeros(3))[0]


def axes_along(way: Series, rate: Series) -> tuple[Series, Series]:
    """Axes of a strut in columns, and their rate.

    Arguments:
        way: from foot to head, shape (3,), not zero [m].
        rate: of it [m/s].
    """
    length = np.linalg.norm(way)
    x = way / length
    neighbour = UP if abs(x @ ACROSS) > ALONG_Z else ACROSS
    across = np.cross(neighbour, x)
    y = across / np.linalg.norm(across)
    x_rate = _across(rate, x) / length
    y_rate = _across(np.cross(neighbour, x_rate), y) / np.linalg.norm(across)
    z_rate = np.cross(x_rate, y) + np.cross(x, y_rate)
    return np.column_stack([x, y, np.cross(x, y)]), np.column_stack([x_rate, y_rate, z_rate])


def _across(vector: Series, unit: Series) -> Series:
    """The part of a vector at right angles to a unit vector."""
    part: Series = vector - (vector @ unit) * unit
    return part
