"""Where points of bodies are over time, from the bodies' coordinates."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND, LinearActuator, Linkage
from support_exudyn.model.plane_geometry import minus
from user_forces.values.value import Vector2


@dataclass(frozen=True)
class PointMotion:
    """A point of a body: position (n, 2), angle and spin of the body (n,); SI.

    arm: from the body's centre of mass. centre_velocity: of that (n, 2).
    """

    position: Series
    angle: Series
    spin: Series
    arm: Series
    centre_velocity: Series

    @cached_property
    def velocity(self) -> Series:
        """Velocity of the point (n, 2) [m/s]."""
        velocity = self.centre_velocity.copy()
        velocity[:, 0] -= self.spin * self.arm[:, 1]
        velocity[:, 1] += self.spin * self.arm[:, 0]
        return velocity


@dataclass(frozen=True)
class BodyMotion:
    """All bodies of a linkage over time; the arrays are those of `Trajectory`, shape (n, 3 bodies)."""

    linkage: Linkage
    position: Series
    velocity: Series
    acceleration: Series
    _known: dict[str, tuple[Series, Series]] = field(default_factory=dict, repr=False, compare=False)

    def first(self, body: str) -> int:
        """Column of a body's x; y and turn follow."""
        return 3 * list(self.linkage.bodies).index(body)

    def arm(self, body: str, point: Vector2) -> Series:
        """Vector from a body's centre of mass to a point of the start posture, ground's axes (n, 2) [m]."""
        x, y = minus(point, self.linkage.bodies[body].centre)
        c, s = self._directions(body)
        arm = np.empty((len(self.position), 2))
        arm[:, 0], arm[:, 1] = c * x - s * y, s * x + c * y
        return arm

    def _directions(self, body: str) -> tuple[Series, Series]:
        """Cosine and sine of a body's turn; every point of it asks for them."""
        if body not in self._known:
            turn = self.position[:, self.first(body) + 2]
            self._known[body] = np.cos(turn), np.sin(turn)
        return self._known[body]

    def turn(self, body: str) -> Series:
        """A body's rotation since the start posture (n,) [rad]."""
        return np.zeros(len(self.position)) if body == GROUND else self.position[:, self.first(body) + 2]

    def place(self, body: str, point: Vector2) -> Series:
        """Path of a point of the start posture (n, 2) [m]; velocities may be missing."""
        if body == GROUND:
            return np.tile(point, (len(self.position), 1))
        i = self.first(body)
        place: Series = self.position[:, i : i + 2] + np.array(self.linkage.bodies[body].centre)
        return place + self.arm(body, point)

    def spin(self, body: str) -> Series:
        """A body's angular velocity (n,) [rad/s]."""
        return np.zeros(len(self.position)) if body == GROUND else self.velocity[:, self.first(body) + 2]

    def point(self, body: str, point: Vector2) -> PointMotion:
        """Motion of a point of the start posture."""
        rows = len(self.position)
        if body == GROUND:
            still, nowhere = np.zeros(rows), np.zeros((rows, 2))
            return PointMotion(np.tile(point, (rows, 1)), still, still, nowhere, nowhere)
        i = self.first(body)
        centre = np.array(self.linkage.bodies[body].centre)
        arm = self.arm(body, point)
        return PointMotion(
            self.position[:, i : i + 2] + centre + arm,
            self.linkage.bodies[body].angle + self.position[:, i + 2],
            self.velocity[:, i + 2],
            arm,
            self.velocity[:, i : i + 2],
        )

    def lengthening(self, actuator: LinearActuator) -> tuple[Series, Series]:
        """Length of an actuator (n,) [m] and its rate (n,) [m/s]."""
        foot, head = (
            self.point(actuator.foot, actuator.foot_point),
            self.point(actuator.head, actuator.head_point),
        )
        apart, relative = head.position - foot.position, head.velocity - foot.velocity
        length = np.hypot(*apart.T)
        return length, (apart * relative).sum(axis=1) / length
