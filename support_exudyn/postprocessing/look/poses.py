"""Where bodies, struts and pins are at the records of a run, of every formulation, in plane and space."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND, Body
from support_exudyn.model.pins import ClearancePin
from support_exudyn.model.spatial_linkage import SpatialBody
from support_exudyn.model.to_space import at
from support_exudyn.postprocessing.look.solid import DrawnActuator
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, Vector3

WHY = "without it nobody knows where the body is"
LEAST = 1e-9  # determinant below which roll, yaw and angle do not determine a rotation
ONLY_IN_SPACE = ("z", "velocity_z", "angular_velocity_x", "angular_velocity_y")


@dataclass(frozen=True)
class Pose:
    """A body at the records of a run, ground's axes.

    Arguments:
        start: its centre of mass in the start posture [m].
        place: of the same at the records, shape (n, 3) [m].
        turn: its rotation since the start posture, shape (n, 3, 3).
        velocity: of the centre of mass, shape (n, 3) [m/s].
        spin: its angular velocity, shape (n, 3) [rad/s].
    """

    start: Vector3
    place: Series
    turn: Series
    velocity: Series
    spin: Series

    def points(self, points: Series, record: int) -> Series:
        """The places of points of the start posture (m, 3) at a record [m]."""
        arms = (points - np.array(self.start)) @ self.turn[record].T
        moved: Series = self.place[record] + arms
        return moved

    def velocities(self, points: Series, record: int) -> Series:
        """The velocities of these points (m, 3) at a record [m/s]."""
        arms = (points - np.array(self.start)) @ self.turn[record].T
        moving: Series = self.velocity[record] + np.cross(self.spin[record], arms)
        return moving

    def path(self, point: Vector3) -> Series:
        """The places of a point of the start posture at all records, shape (n, 3) [m]."""
        arm = np.array(point) - np.array(self.start)
        path: Series = self.place + self.turn @ arm
        return path


class Poses:
    """All bodies of a run.

    Raises InputError if the run has not recorded a channel that this needs, when it is asked for the body.
    """

    def __init__(self, result: Result) -> None:
        self._result = result
        self._of = lru_cache(maxsize=None)(self._read)

    @property
    def time(self) -> Series:
        """The times of the records, shape (n,) [s]."""
        return self._result.time

    def of(self, body: str) -> Pose:
        """The pose of a body by its name, or of "ground"."""
        return self._of(body)

    def _read(self, body: str) -> Pose:
        scenario, rows = self._result.scenario, self.time.size
        if body == GROUND:
            nowhere = np.zeros((rows, 3))
            unturned = np.broadcast_to(np.eye(3), (rows, 3, 3))
            return Pose((0.0, 0.0, 0.0), nowhere, unturned, nowhere, nowhere)
        in_space = scenario.dimensions == 3
        known: Body | SpatialBody = (scenario.space if in_space else scenario.linkage).bodies[body]

        def channel(name: str) -> Series:
            if name in ONLY_IN_SPACE and not in_space:
                return np.zeros(rows)
            return self._result.recorded(f"{body}.{name}", WHY)

        def columns(*names: str) -> Series:
            return np.column_stack([channel(name) for name in names])

        angle = channel("angle") - known.angle
        x, y, *z = known.centre
        return Pose(
            (x, y, z[0] if z else 0.0),
            columns("x", "y", "z"),
            turned(angle, channel("roll"), channel("yaw")) if in_space else _about_z(angle),
            columns("velocity_x", "velocity_y", "velocity_z"),
            columns("angular_velocity_x", "angular_velocity_y", "angular_velocity"),
        )


def _about_z(angle: Series) -> Series:
    """Rotations about z, shape (n, 3, 3)."""
    turn = np.zeros((angle.size, 3, 3))
    turn[:, 0, 0] = turn[:, 1, 1] = np.cos(angle)
    turn[:, 1, 0] = np.sin(angle)
    turn[:, 0, 1] = -turn[:, 1, 0]
    turn[:, 2, 2] = 1.0
    return turn


def turned(angle: Series, roll: Series, yaw: Series) -> Series:
    """Rotation matrices A (n, 3, 3) with the angles (n,) [rad] that the channels of space have.

        angle = atan2(A_10, A_00),   roll = atan2(A_21, A_11),   yaw = atan2(A_02, A_22)

    So the columns are multiples of (cos angle, sin angle, p), (q, cos roll, sin roll), (sin yaw, s, cos yaw).
    That they are perpendicular to each other are three linear equations for p, q and s.

    Raises InputError if the angles do not determine the rotation: the body has turned far to the side.
    """
    (cr, sr), (cy, sy), (ca, sa) = ((np.cos(one), np.sin(one)) for one in (roll, yaw, angle))
    zero = np.zeros_like(angle)
    rows = ((sr, ca, zero), (zero, sy, cr), (cy, zero, sa))
    matrix = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
    if np.abs(np.linalg.det(matrix)).min() < LEAST:
        raise InputError(
            "roll, yaw and angle do not determine how a body has turned; allowed: bodies that turn less to the "
            "side"
        )
    right = np.stack([-sa * cr, -sr * cy, -ca * sy], axis=-1)
    p, q, s = np.linalg.solve(matrix, right[..., None])[..., 0].T
    columns = np.stack([np.stack(row, axis=-1) for row in ((ca, q, sy), (sa, cr, s), (p, sr, cy))], axis=-2)
    return np.asarray(columns / np.linalg.norm(columns, axis=-2, keepdims=True))


# --- struts ---

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
        """Positions [m] and velocities [m/s] of points (m, 3) of `DrawnActuator.cylinder`."""
        return self.foot + points @ self.axes.T, self.foot_velocity + points @ self.turning.T

    def rod(self, points: Series) -> tuple[Series, Series]:
        """Positions [m] and velocities [m/s] of points (m, 3) of `DrawnActuator.rod`."""
        return self.head + points @ self.axes.T, self.head_velocity + points @ self.turning.T


def strut_pose(strut: DrawnActuator, poses: Poses, record: int) -> StrutPose:
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


# --- pins ---


@dataclass(frozen=True)
class DrawnEnd:
    """A body, or "ground", and the point of it at which the pin is, start posture [m]."""

    body: str
    point: Vector3


@dataclass(frozen=True)
class PlacedPin:
    """A pin, in space a bearing; in the plane it stands for those of a pair and lies between them (z = 0).

    Arguments:
        name: as the channels know it.
        first, second: its two ends.
        with_clearance: the scenario's pin if it has clearance, else None.
    """

    name: str
    first: DrawnEnd
    second: DrawnEnd
    with_clearance: ClearancePin | None

    @property
    def bore_is_second(self) -> bool:
        """The second body carries the bore; of an ideal pin the first one counts as doing so."""
        return self.with_clearance is not None and self.with_clearance.bore == "second"

    @property
    def bore(self) -> DrawnEnd:
        """The body that carries the bore, and its centre."""
        return self.second if self.bore_is_second else self.first

    @property
    def journal(self) -> DrawnEnd:
        """The body that carries the journal, and its centre."""
        return self.first if self.bore_is_second else self.second


def placed_pins(scenario: Scenario) -> list[PlacedPin]:
    """All pins of a scenario, in the order of its machine; guides are none."""
    if scenario.dimensions == 2:
        return list(planar_pins(scenario).values())
    with_clearance = scenario.clearance_pins
    return [
        PlacedPin(
            name,
            DrawnEnd(b.first, b.first_point),
            DrawnEnd(b.second, b.second_point),
            with_clearance.get(b.pin),
        )
        for name, b in scenario.space.bearings.items()
        if not b.is_guide
    ]


def planar_pins(scenario: Scenario) -> dict[str, PlacedPin]:
    """The pins of the plane, by name, also of a scenario in space."""
    with_clearance = scenario.clearance_pins
    return {
        name: PlacedPin(
            name,
            DrawnEnd(p.first, at(p.first_point, 0.0)),
            DrawnEnd(p.second, at(p.second_point, 0.0)),
            with_clearance.get(name),
        )
        for name, p in scenario.linkage.pins.items()
    }
