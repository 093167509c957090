"""Where bodies, struts and pins are at the records of a run, of every formulation, in plane and space."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND, Linkage
from support_exudyn.model.pins import ClearancePin
from support_exudyn.model.spatial_linkage import SpatialLinkage
from support_exudyn.model.to_space import at
from support_exudyn.postprocessing.look.shapes import Shape
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, Vector2, Vector3

WHY = "without it nobody knows where the body is"
LEAST = 1e-9  # determinant below which roll, yaw and angle do not determine a rotation
ONLY_IN_SPACE = ("z", "velocity_z", "angular_velocity_x", "angular_velocity_y")


class Frame(NamedTuple):
    """Axes at a record: origin (3,) [m], axes in columns (3, 3), and the rates of both [m/s], [1/s]."""

    origin: Series
    axes: Series
    velocity: Series
    turning: Series

    def points(self, own: Series) -> Series:
        """The places of points (m, 3) of these axes [m]."""
        places: Series = self.origin + own @ self.axes.T
        return places

    def velocities(self, own: Series) -> Series:
        """The velocities of these points (m, 3) [m/s]."""
        moving: Series = self.velocity + own @ self.turning.T
        return moving


class Pose:
    """A body of a run at its records, ground's axes; a channel is read when it is needed.

    start: the centre of mass in the start posture (3,) [m].

    Arguments:
        result: the run.
        body: name of the body, or "ground".
    """

    def __init__(self, result: Result, body: str) -> None:
        self._result, self._body = result, body
        scenario = result.scenario
        self._in_space = scenario.dimensions == 3
        bodies = (scenario.space if self._in_space else scenario.linkage).bodies
        self._known = None if body == GROUND else bodies[body]
        self.start: Series = np.array([*(self._known.centre if self._known else ()), 0.0, 0.0, 0.0][:3])

    def _columns(self, *names: str) -> Series:
        """Channels side by side (n, 3); those out of the plane are zero for a run in the plane."""
        zero = np.zeros(self._result.time.size)
        is_zero = [self._known is None or (name in ONLY_IN_SPACE and not self._in_space) for name in names]
        return np.column_stack([
            zero if still else self._result.recorded(f"{self._body}.{name}", WHY)
            for name, still in zip(names, is_zero, strict=True)
        ])  # fmt: skip

    @cached_property
    def place(self) -> Series:
        """The centre of mass at the records (n, 3) [m]."""
        return self._columns("x", "y", "z")

    @cached_property
    def turn(self) -> Series:
        """Rotation since the start posture (n, 3, 3). Raises InputError if the angles do not determine it."""
        if self._known is None:
            return np.broadcast_to(np.eye(3), (self._result.time.size, 3, 3))
        angle = self._columns("angle")[:, 0] - self._known.angle
        if self._in_space:
            return turned(angle, *self._columns("roll", "yaw").T)
        return np.asarray(Rotation.from_euler("z", angle[:, None]).as_matrix())

    @cached_property
    def velocity(self) -> Series:
        """Velocity of the centre of mass [m/s], shape (n, 3)."""
        return self._columns("velocity_x", "velocity_y", "velocity_z")

    @cached_property
    def spin(self) -> Series:
        """Angular velocity (n, 3) [rad/s]."""
        return self._columns("angular_velocity_x", "angular_velocity_y", "angular_velocity")

    def frame(self, record: int) -> Frame:
        """The axes at a record in which the body's points have the coordinates of the start posture."""
        turn = self.turn[record]
        turning = np.cross(self.spin[record], turn.T).T
        origin, velocity = self.place[record] - turn @ self.start, self.velocity[record] - turning @ self.start
        return Frame(origin, turn, velocity, turning)

    def path(self, point: Vector3) -> Series:
        """The places of a point of the start posture at all records (n, 3) [m]."""
        path: Series = self.place + self.turn @ (np.array(point) - self.start)
        return path


class Poses:
    """All bodies of a run.

    Raises InputError if the run has not recorded a channel, when the pose needs it.
    """

    def __init__(self, result: Result) -> None:
        self.of = lru_cache(maxsize=None)(lambda body: Pose(result, body))

    def frame(self, shape: Shape, record: int) -> Frame:
        """The axes of a shape's mesh at a record: those of its body, or of its strut at one end."""
        if shape.strut is None:
            return self.of(shape.body).frame(record)
        bodies = [(self.of(body).frame(record), np.array(point)) for body, point in shape.strut.ends]
        places = [frame.points(point) for frame, point in bodies]
        rates = [frame.velocities(point) for frame, point in bodies]
        way, rate = places[1] - places[0], rates[1] - rates[0]
        axes, spin = axes_along(way), np.cross(way, rate) / (way @ way)  # no strut turns about itself
        return Frame(places[shape.end], axes, rates[shape.end], np.cross(spin, axes.T).T)


def turned(angle: Series, roll: Series, yaw: Series) -> Series:
    """Rotation matrices A (n, 3, 3) with the angles (n,) [rad] that the channels of space have.

        angle = atan2(A_10, A_00),   roll = atan2(A_21, A_11),   yaw = atan2(A_02, A_22)

    So the columns are multiples of (cos angle, sin angle, p), (q, cos roll, sin roll), (sin yaw, s, cos yaw).
    That they are perpendicular to each other are three linear equations for p, q and s.

    Raises InputError if the angles do not determine the rotation: the body has turned far to the side.
    """
    (cr, sr), (cy, sy), (ca, sa) = ((np.cos(one), np.sin(one)) for one in (roll, yaw, angle))
    zero = np.zeros_like(angle)
    matrix = np.moveaxis(np.array([(sr, ca, zero), (zero, sy, cr), (cy, zero, sa)]), -1, 0)
    if np.abs(np.linalg.det(matrix)).min() < LEAST:
        raise InputError(
            "roll, yaw and angle do not determine how a body has turned; allowed: bodies that turn less to the "
            "side"
        )
    right = np.stack([-sa * cr, -sr * cy, -ca * sy], axis=-1)
    p, q, s = np.linalg.solve(matrix, right[..., None])[..., 0].T
    columns = np.moveaxis(np.array([(ca, q, sy), (sa, cr, s), (p, sr, cy)]), -1, 0)
    return np.asarray(columns / np.linalg.norm(columns, axis=-2, keepdims=True))


# --- struts ---

ACROSS, UP = np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0])
ALONG_Z = 0.99  # cosine, above which a direction has no use for z as its neighbour


def axes_along(way: Series) -> Series:
    """Axes of a strut in columns (3, 3).

    x runs from foot to head, z is as near to the ground's z as can be (to y if the strut stands along z).

    way: from foot to head, shape (3,), not zero [m].
    """
    x = way / np.linalg.norm(way)
    across = np.cross(UP if abs(x @ ACROSS) > ALONG_Z else ACROSS, x)
    y = across / np.linalg.norm(across)
    return np.column_stack([x, y, np.cross(x, y)])


# --- ends of joints, and pins ---


def named_ends(linkage: Linkage | SpatialLinkage) -> list[tuple[str, str, tuple[float, ...]]]:
    """Ends of pins and actuators, and traced points: name, body, and point of it in the start posture [m]."""
    joints = linkage.bearings if isinstance(linkage, SpatialLinkage) else linkage.pins
    ends: list[tuple[str, str, tuple[float, ...]]] = []
    for name, pin in joints.items():
        ends += [(name, pin.first, pin.first_point), (name, pin.second, pin.second_point)]
    for name, actuator in linkage.actuators.items():
        ends += [(name, actuator.foot, actuator.foot_point), (name, actuator.head, actuator.head_point)]
    return [*ends, *((name, traced.body, traced.point) for name, traced in linkage.points.items())]


def joined_points(linkage: Linkage) -> dict[str, list[Vector2]]:
    """Points of pins, actuators and traced points by body, and of the ground, start posture [m]."""
    points: dict[str, list[Vector2]] = {name: [] for name in (GROUND, *linkage.bodies)}
    for _, body, (x, y) in named_ends(linkage):
        points[body].append((x, y))
    return points


class PinEnd(NamedTuple):
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
    first: PinEnd
    second: PinEnd
    with_clearance: ClearancePin | None

    @property
    def bore_is_second(self) -> bool:
        """The second body carries the bore; of an ideal pin the first one counts as doing so."""
        return self.with_clearance is not None and self.with_clearance.bore == "second"

    @property
    def bore(self) -> PinEnd:
        """The body that carries the bore, and its centre."""
        return self.second if self.bore_is_second else self.first

    @property
    def journal(self) -> PinEnd:
        """The body that carries the journal, and its centre."""
        return self.first if self.bore_is_second else self.second


def placed_pins(scenario: Scenario) -> list[PlacedPin]:
    """All pins of a scenario, in the order of its machine; guides are none."""
    if scenario.dimensions == 2:
        return list(planar_pins(scenario).values())
    loose, bearings = scenario.clearance_pins, scenario.space.bearings.items()
    return [
        PlacedPin(name, PinEnd(b.first, b.first_point), PinEnd(b.second, b.second_point), loose.get(b.pin))
        for name, b in bearings
        if not b.is_guide
    ]


def planar_pins(scenario: Scenario) -> dict[str, PlacedPin]:
    """The pins of the plane, by name, also of a scenario in space."""
    pins = {}
    for name, pin in scenario.linkage.pins.items():
        first, second = (at(point, 0.0) for point in (pin.first_point, pin.second_point))
        loose = scenario.clearance_pins.get(name)
        pins[name] = PlacedPin(name, PinEnd(pin.first, first), PinEnd(pin.second, second), loose)
    return pins
