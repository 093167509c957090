"""Where points of bodies are over time, from the bodies' coordinates."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND, ROUNDING, LinearActuator, Linkage, Slide
from support_exudyn.model.plane_geometry import minus, rotated
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
        return pairs(
            self.centre_velocity[:, 0] - self.spin * self.arm[:, 1],
            self.centre_velocity[:, 1] + self.spin * self.arm[:, 0],
        )


class BodySeries(NamedTuple):
    """Centre of mass [m], and cosine and sine of the turn of a body, (n,) each and contiguous."""

    x: Series
    y: Series
    cos: Series
    sin: Series


def pairs(x: Series, y: Series) -> Series:
    """Vectors (n, 2) of their columns, each of which is contiguous: working by columns is ten times faster."""
    found = np.empty((2, len(x)))
    found[0], found[1] = x, y
    return found.T


@dataclass(frozen=True)
class BodyMotion:
    """All bodies of a linkage over time; the arrays are those of `Trajectory`, shape (n, 3 bodies)."""

    linkage: Linkage
    position: Series
    velocity: Series
    acceleration: Series
    _known: dict[str, BodySeries] = field(default_factory=dict, repr=False, compare=False)

    @cached_property
    def _first(self) -> dict[str, int]:
        return {name: 3 * n for n, name in enumerate(self.linkage.bodies)}

    def first(self, body: str) -> int:
        """Column of a body's x; y and turn follow."""
        return self._first[body]

    def arm(self, body: str, point: Vector2) -> Series:
        """Vector from a body's centre of mass to a point of the start posture, ground's axes (n, 2) [m]."""
        x, y = minus(point, self.linkage.bodies[body].centre)
        at = self.body(body)
        return pairs(at.cos * x - at.sin * y, at.sin * x + at.cos * y)

    def body(self, name: str) -> BodySeries:
        """Where a body is; every point of it asks for that."""
        if name not in self._known:
            i, centre = self.first(name), self.linkage.bodies[name].centre
            turn = self.position[:, i + 2]
            x, y = self.position[:, i] + centre[0], self.position[:, i + 1] + centre[1]
            self._known[name] = BodySeries(x, y, np.cos(turn), np.sin(turn))
        return self._known[name]

    def turn(self, body: str) -> Series:
        """A body's rotation since the start posture (n,) [rad]."""
        return np.zeros(len(self.position)) if body == GROUND else self.position[:, self.first(body) + 2]

    def place(self, body: str, point: Vector2) -> Series:
        """Path of a point of the start posture (n, 2) [m]; velocities may be missing."""
        return pairs(*self.coordinates(body, point))

    def coordinates(self, body: str, point: Vector2) -> tuple[Series, Series]:
        """Coordinates of a point of the start posture over time [m], (n,) each."""
        if body == GROUND:
            still = np.zeros(len(self.position))
            return still + point[0], still + point[1]
        x, y = minus(point, self.linkage.bodies[body].centre)
        at = self.body(body)
        return at.x + (at.cos * x - at.sin * y), at.y + (at.sin * x + at.cos * y)

    def spin(self, body: str) -> Series:
        """A body's angular velocity (n,) [rad/s]."""
        return np.zeros(len(self.position)) if body == GROUND else self.velocity[:, self.first(body) + 2]

    def point(self, body: str, point: Vector2) -> PointMotion:
        """Motion of a point of the start posture."""
        rows = len(self.position)
        if body == GROUND:
            still, nowhere = np.zeros(rows), np.zeros((2, rows)).T
            return PointMotion(self.place(body, point), still, still, nowhere, nowhere)
        i = self.first(body)
        at, arm = self.body(body), self.arm(body, point)
        return PointMotion(
            pairs(at.x + arm[:, 0], at.y + arm[:, 1]),
            self.linkage.bodies[body].angle + self.position[:, i + 2],
            self.velocity[:, i + 2],
            arm,
            self.velocity[:, i : i + 2],
        )

    def sliding(self, slide: Slide) -> tuple[Series, Series]:
        """Direction of a guide (n, 2), and speed of its point along the guide (n,) [m/s]."""
        angle = slide.direction + self.turn(slide.against)
        along = pairs(np.cos(angle), np.sin(angle))
        guided, carrier = self.point(slide.body, slide.point), self.point(slide.against, slide.point)
        return along, (along * (guided.velocity - carrier.velocity)).sum(axis=1)

    def along(self, slide: Slide) -> Series:
        """Distance of a guided point along its line from where it starts (n,) [m]."""
        x, y = (self.place(slide.body, slide.point) - self.place(slide.against, slide.point)).T
        angle = slide.direction + self.turn(slide.against)
        return np.asarray(np.cos(angle) * x + np.sin(angle) * y)

    def past_ends(self, slide: Slide) -> Series:
        """Distance of a guided point beyond the nearer end of its line (n,) [m]; 0 between the ends."""
        along = self.along(slide)
        if slide.ends is None:
            return np.zeros_like(along)
        low, high = sorted(rotated(minus(end, slide.point), -slide.direction)[0] for end in slide.ends)
        beyond = np.maximum(along - high, low - along)
        return np.where(beyond > ROUNDING * slide.length, beyond, 0.0)

    def lengthening(self, actuator: LinearActuator) -> tuple[Series, Series]:
        """Length of an actuator (n,) [m] and its rate (n,) [m/s]."""
        foot, head = (
            self.point(actuator.foot, actuator.foot_point),
            self.point(actuator.head, actuator.head_point),
        )
        apart, relative = head.position - foot.position, head.velocity - foot.velocity
        length = np.hypot(*apart.T)
        return length, (apart * relative).sum(axis=1) / length
