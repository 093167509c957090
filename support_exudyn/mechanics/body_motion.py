"""Motion of all bodies of a linkage and of their points, in the plane and in space: at one instant, or at many.

A point of a body moves with the body's centre c and its rotation A since the start, r = c + A s, and with
the velocity c' + omega x A s. What follows from that is written once, in `Motion`. Its two kinds know the
coordinates of a body:

- plane: displacement of the centre, and turn,
- space, the engine's: displacement of the centre, and the change of the Euler parameters p from 1, 0, 0, 0,
  with omega = 2 G p' and the 3 x 4 matrix G of p.

Arrays have the instants first, then the bodies in the order of the linkage.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND, ROUNDING, LinearActuator, Linkage, Slide
from support_exudyn.model.plane_geometry import minus, rotated
from support_exudyn.model.spatial_linkage import SpatialActuator, SpatialLinkage

COORDINATES = 7  # of a body in space
UNTURNED = np.array([1.0, 0.0, 0.0, 0.0])
AnyMotion = TypeVar("AnyMotion", bound="Motion")


class PointMotion(NamedTuple):
    """A point of a body at n instants, d = 2 or 3.

    position [m], velocity [m/s], arm from the body's centre of mass [m]: (n, d), ground's axes. spin: angular
    velocity of the body [rad/s], (n,) in the plane and (n, 3) in space.
    """

    position: Series
    velocity: Series
    arm: Series
    spin: Series


@dataclass(frozen=True)
class Motion(ABC):
    """All bodies of a linkage at n instants.

    linkage: the mechanism. position, velocity: coordinates of all bodies from those of the start posture, and
    their rates, (n, coordinates). Where velocities have not been kept, they have no columns.
    """

    linkage: Any
    position: Series
    velocity: Series

    SHIFTS: ClassVar[int]  # directions in which a body shifts: the first of its velocities
    FREEDOMS: ClassVar[int]  # velocities of a body: of its centre, then its spin

    @property
    def count(self) -> int:
        """Number of instants."""
        return len(self.position)

    @cached_property
    def _indices(self) -> dict[str, int]:
        return {name: n for n, name in enumerate(self.linkage.bodies)}

    def first(self, body: str) -> int:
        """Column of the first velocity of a body among those of all bodies."""
        return self.FREEDOMS * self._indices[body]

    @property
    @abstractmethod
    def velocities(self) -> Series:
        """Velocities of the centres [m/s] and spins [rad/s] of all bodies (n, freedoms)."""

    @abstractmethod
    def centre(self, body: str) -> tuple[Series, Series]:
        """Displacement of a body's centre of mass since the start [m], and its velocity [m/s], (n, d) each."""

    @property
    @abstractmethod
    def centres(self) -> Series:
        """Centres of mass of all bodies, and the ground's origin as the last, (n, b + 1, d) [m]."""

    @abstractmethod
    def turned(self, bodies: npt.NDArray[np.int_], vectors: Series) -> Series:
        """Vectors of the start posture (..., d) that turn with bodies of these numbers (...), (n, ..., d).

        The ground's number is that after the last body.
        """

    def carried(self, body: str, vector: Any) -> Series:
        """A vector of the start posture that turns with a body or rests with the ground, (n, d)."""
        number = np.array([len(self._indices) if body == GROUND else self._indices[body]])
        return self.turned(number, np.array([vector], dtype=np.float64))[:, 0]

    @abstractmethod
    def spin(self, body: str) -> Series:
        """A body's angular velocity [rad/s], (n,) in the plane and (n, 3) in space."""

    @abstractmethod
    def swept(self, spin: Series, arm: Series) -> Series:
        """Velocity spin x arm (n, d) that a spin gives to the end of an arm (n, d)."""

    @abstractmethod
    def moment(self, arm: Series, force: Series) -> Series:
        """Moment arm x force, (..., 1) in the plane and (..., 3) in space, of (..., d) each."""

    def arm(self, body: str, point: Any) -> Series:
        """The vector from a body's centre of mass to a point (n, d) [m]; 0 on the ground."""
        centre = point if body == GROUND else self.linkage.bodies[body].centre
        return self.carried(body, np.subtract(point, centre))

    def place(self, body: str, point: Any) -> Series:
        """Path of a point of the start posture (n, d) [m]."""
        if body == GROUND:
            return self.carried(GROUND, point)
        start = np.asarray(self.linkage.bodies[body].centre)
        return np.asarray(self.centre(body)[0] + start + self.arm(body, point))

    def point(self, body: str, point: Any) -> PointMotion:
        """Motion of a point of the start posture."""
        spin = self.spin(body)
        if body == GROUND:
            position = self.place(body, point)
            still = np.zeros_like(position)
            return PointMotion(position, still, still, spin)
        (shift, rate), arm = self.centre(body), self.arm(body, point)
        start = np.asarray(self.linkage.bodies[body].centre)
        return PointMotion(shift + start + arm, rate + self.swept(spin, arm), arm, spin)

    def span(self, actuator: LinearActuator | SpatialActuator) -> Series:
        """The vector from foot to head of an actuator (n, d) [m]."""
        return self.place(actuator.head, actuator.head_point) - self.place(actuator.foot, actuator.foot_point)

    def lengthening(self, actuator: LinearActuator | SpatialActuator) -> tuple[Series, Series]:
        """Length of an actuator (n,) [m] and its rate (n,) [m/s]."""
        foot = self.point(actuator.foot, actuator.foot_point)
        head = self.point(actuator.head, actuator.head_point)
        apart, relative = head.position - foot.position, head.velocity - foot.velocity
        length = np.hypot(*apart.T) if self.SHIFTS == 2 else np.linalg.norm(apart, axis=1)
        return length, (apart * relative).sum(axis=1) / length

    def later(self: AnyMotion, time: Series) -> AnyMotion:
        """All bodies after times (n,) [s], or before where these are negative, at the rates that they have."""
        return replace(self, position=self.position + time[:, None] * self.velocity)


def pairs(x: Series, y: Series) -> Series:
    """Vectors (n, 2) of their columns, each of which is contiguous: working by columns is ten times faster."""
    found = np.empty((2, len(x)))
    found[0], found[1] = x, y
    return found.T


@dataclass(frozen=True)
class BodyMotion(Motion):
    """All bodies of a linkage of the plane; position, velocity: (n, 3 bodies), x, y and turn of each."""

    linkage: Linkage
    SHIFTS, FREEDOMS = 2, 3

    @property
    def velocities(self) -> Series:
        """See `Motion`."""
        return self.velocity

    def centre(self, body: str) -> tuple[Series, Series]:
        """See `Motion`."""
        i = self.first(body)
        return self.position[:, i : i + 2], self.velocity[:, i : i + 2]

    def turn(self, body: str) -> Series:
        """A body's rotation since the start posture (n,) [rad]."""
        return np.zeros(len(self.position)) if body == GROUND else self.position[:, self.first(body) + 2]

    def spin(self, body: str) -> Series:
        """See `Motion`."""
        return np.zeros(len(self.position)) if body == GROUND else self.velocity[:, self.first(body) + 2]

    @cached_property
    def centres(self) -> Series:
        """See `Motion`."""
        found = np.zeros((self.count, len(self.linkage.bodies) + 1, 2))
        found[:, :-1] = self.position.reshape(self.count, -1, 3)[..., :2]
        found[:, :-1] += [body.centre for body in self.linkage.bodies.values()]
        return found

    @cached_property
    def _turns(self) -> dict[int, Series]:
        """Cosine and sine (2, n) of the turns of bodies by their numbers, as far as they are needed."""
        still = np.zeros((2, self.count))
        still[0] = 1.0
        return {len(self.linkage.bodies): still}

    def turned(self, bodies: npt.NDArray[np.int_], vectors: Series) -> Series:
        """See `Motion`."""
        numbers = bodies.ravel().tolist()
        for n in set(numbers) - self._turns.keys():
            turn = self.position[:, 3 * n + 2]
            self._turns[n] = np.array([np.cos(turn), np.sin(turn)])
        found = np.empty((2, *bodies.shape, self.count))  # working by columns is ten times faster
        columns = found.reshape(2, len(numbers), self.count)
        for k, (n, (x, y)) in enumerate(zip(numbers, vectors.reshape(-1, 2).tolist(), strict=True)):
            c, s = self._turns[n]
            columns[0, k], columns[1, k] = c * x - s * y, s * x + c * y
        return found.transpose(found.ndim - 1, *range(1, found.ndim - 1), 0)

    def swept(self, spin: Series, arm: Series) -> Series:
        """See `Motion`."""
        return pairs(-spin * arm[:, 1], spin * arm[:, 0])

    def moment(self, arm: Series, force: Series) -> Series:
        """See `Motion`."""
        return (arm[..., 0] * force[..., 1] - arm[..., 1] * force[..., 0])[..., None]

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


@dataclass(frozen=True)
class SpatialMotion(Motion):
    """All bodies of a linkage in space; position, velocity: (n, 7 bodies), in the order of the linkage."""

    linkage: SpatialLinkage
    SHIFTS, FREEDOMS = 3, 6

    @staticmethod
    def at_start(linkage: SpatialLinkage) -> "SpatialMotion":
        """All bodies at rest in the start posture, at one instant."""
        still = np.zeros((1, COORDINATES * len(linkage.bodies)))
        return SpatialMotion(linkage, still, still)

    def _by_body(self, coordinates: Series) -> Series:
        return coordinates.reshape(-1, len(self.linkage.bodies), COORDINATES)

    @property
    def displacement(self) -> Series:
        """Displacements of the centres of all bodies since the start (n, b, 3) [m]."""
        return self._by_body(self.position)[..., :3]

    @property
    def centre_velocity(self) -> Series:
        """Velocities of the centres of all bodies (n, b, 3) [m/s]."""
        return self._by_body(self.velocity)[..., :3]

    @cached_property
    def rotations(self) -> Series:
        """Rotations of all bodies since the start (n, b, 3, 3)."""
        return rotation(self._by_body(self.position)[..., 3:] + UNTURNED)

    @cached_property
    def spins(self) -> Series:
        """Angular velocities of all bodies (n, b, 3) [rad/s], ground's axes."""
        matrix = turning_matrix(self._by_body(self.position)[..., 3:] + UNTURNED)
        return np.asarray(2.0 * np.einsum("nbij,nbj->nbi", matrix, self._by_body(self.velocity)[..., 3:]))

    @property
    def velocities(self) -> Series:
        """See `Motion`."""
        return np.concatenate([self.centre_velocity, self.spins], axis=-1).reshape(self.count, -1)

    def centre(self, body: str) -> tuple[Series, Series]:
        """See `Motion`."""
        n = self._indices[body]
        return self.displacement[:, n], self.centre_velocity[:, n]

    def turn(self, body: str, axis: int = 2) -> Series:
        """Angle by which a body has turned in the view along an axis of the ground (n,) [rad]."""
        turn, column = self.rotations[:, self._indices[body]], (axis + 1) % 3
        return np.asarray(np.unwrap(np.arctan2(turn[:, (axis + 2) % 3, column], turn[:, column, column])))

    def spin(self, body: str) -> Series:
        """See `Motion`."""
        return np.zeros((self.count, 3)) if body == GROUND else self.spins[:, self._indices[body]]

    @cached_property
    def centres(self) -> Series:
        """See `Motion`."""
        found = np.zeros((self.count, len(self.linkage.bodies) + 1, 3))
        found[:, :-1] = self.displacement + [body.centre for body in self.linkage.bodies.values()]
        return found

    @cached_property
    def _turns(self) -> Series:
        """Rotations of all bodies, and of the ground as the last, (n, b + 1, 3, 3)."""
        ground = np.broadcast_to(np.eye(3), (self.count, 1, 3, 3))
        return np.concatenate([self.rotations, ground], axis=1)

    def turned(self, bodies: npt.NDArray[np.int_], vectors: Series) -> Series:
        """See `Motion`."""
        return np.asarray((self._turns[:, bodies] @ vectors[..., None])[..., 0])

    def swept(self, spin: Series, arm: Series) -> Series:
        """See `Motion`."""
        return cross(spin, arm)

    def moment(self, arm: Series, force: Series) -> Series:
        """See `Motion`."""
        return cross(arm, force)


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
