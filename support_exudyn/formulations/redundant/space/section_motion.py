"""How sections of a journal move in those of their bore, from the engine's coordinates of both bodies.

Coordinates may be expressions: `bearing_source` writes the same geometry out as source.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from support_exudyn.formulations.redundant.clearance.connector_force import Attachment
from support_exudyn.formulations.redundant.clearance.pin_motion import Motion, in_plane
from support_exudyn.mechanics.space.constraints import BearingEnd, frame_of
from user_forces.expressions.scalar import sqrt
from user_forces.values.value import Vector3

Vector = tuple[float, float, float]
Axes = tuple[Vector, Vector, Vector]


class BodyState(NamedTuple):
    """A body at an instant, from the engine's coordinates.

    rows: of its rotation less one, which are small where it has turned little. shift: of its centre from the
    start [m]. Only so is what has moved little known to more than the rounding of places: stiff contacts show
    that as steps of their force, on which Newton's method ends nowhere.
    """

    rows: tuple[Vector, Vector, Vector]
    shift: Vector
    velocity: Vector
    spin: Vector

    @staticmethod
    def of(q: list[float], v: list[float]) -> BodyState:
        """The state that follows from the body's coordinates and rates (7)."""
        a, b, c, d = 1.0 + q[3], q[4], q[5], q[6]
        more = q[3] * (2.0 + q[3])  # a a - 1
        ta, tb, tc, td = v[3:7]
        rows = (
            (more + b * b - c * c - d * d, 2.0 * (b * c - a * d), 2.0 * (b * d + a * c)),
            (2.0 * (b * c + a * d), more - b * b + c * c - d * d, 2.0 * (c * d - a * b)),
            (2.0 * (b * d - a * c), 2.0 * (c * d + a * b), more - b * b - c * c + d * d),
        )
        spin = (
            2.0 * (-b * ta + a * tb - d * tc + c * td),
            2.0 * (-c * ta + d * tb + a * tc - b * td),
            2.0 * (-d * ta - c * tb + b * tc + a * td),
        )
        return BodyState(rows, (q[0], q[1], q[2]), (v[0], v[1], v[2]), spin)

    def turned(self, vector: Vector3) -> Vector:
        """A vector of the body's axes, in the ground's."""
        (x, y, z), (dx, dy, dz) = vector, self._moved(vector)
        return dx + x, dy + y, dz + z

    def _moved(self, vector: Vector3) -> Vector:
        """By how much its turn has changed a vector of the body's axes."""
        x, y, z = vector
        (a, b, c), (d, e, f), (g, h, i) = self.rows
        return a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z

    def point(self, arm: Vector3) -> tuple[Vector, Vector]:
        """Displacement from the start and velocity of a point, its arm in the body's axes."""
        dx, dy, dz = self._moved(arm)
        ax, ay, az = self.turned(arm)
        (x, y, z), (vx, vy, vz), (wx, wy, wz) = self.shift, self.velocity, self.spin
        return (x + dx, y + dy, z + dz), (
            vx + wy * az - wz * ay,
            vy + wz * ax - wx * az,
            vz + wx * ay - wy * ax,
        )


GROUND_STATE = BodyState(((0.0,) * 3,) * 3, (0.0,) * 3, (0.0,) * 3, (0.0,) * 3)


class SectionEnd(NamedTuple):
    """Centre of a section on a body.

    first: the body's first coordinate in the vector of all; None: the ground. centre: of the body at the start
    [m]. arm: of the section from there [m]. across, along: axes of the bearing, in those of the body.
    """

    first: int | None
    centre: Vector3
    arm: Vector3
    across: tuple[Vector3, Vector3]
    along: Vector3

    def beside(self, shift: float) -> Vector:
        """The section's arm if it is so far beside its place along the axis [m]."""
        (x, y, z), (ax, ay, az) = self.arm, self.along
        return x + shift * ax, y + shift * ay, z + shift * az

    def state(self, position: list[float], velocity: list[float]) -> BodyState:
        """The state of its body."""
        if self.first is None:
            return GROUND_STATE
        which = slice(self.first, self.first + 7)
        return BodyState.of(position[which], velocity[which])


@dataclass
class SectionMover:
    """The motion of a section's journal in its bore, in the axes in which its force is given.

    data: the engine's. at: what the force acts on; see `section_motion`. shifts: of the sections of bore and
    journal from their places along both [m].
    """

    data: Any
    bore: SectionEnd
    journal: SectionEnd
    at: Attachment
    shifts: tuple[float, float] = (0.0, 0.0)

    def now(self) -> tuple[Motion, Motion]:
        """The present motions of bore and journal, the bore's centre and axes being those of the plane."""
        return self.when(*self.coordinates())

    def coordinates(self) -> tuple[list[float], list[float]]:
        """The engine's, and their rates, as they are now."""
        return self.data.GetODE2Coordinates().tolist(), self.data.GetODE2Coordinates_t().tolist()

    def when(self, position: list[float], velocity: list[float]) -> tuple[Motion, Motion]:
        """The motions of bore and journal at these coordinates and rates."""
        bore, journal = self.bore.state(position, velocity), self.journal.state(position, velocity)
        apart, rates = self.apart(bore, journal)
        along = bore.turned(self.bore.along)
        axes = self.axes(bore, journal)
        local, moving = [dot(a, apart) for a in axes], [dot(a, rates) for a in axes]
        x, y, vx, vy = in_plane(local, moving) if self.at is Attachment.LINE else (*local[:2], *moving[:2])
        own = journal.turned(self.journal.across[0])
        turn = math.atan2(dot(own, axes[1]), dot(own, axes[0]))
        spin = dot(bore.spin, along)
        turning = dot(journal.spin, axes[2]) - dot(bore.spin, axes[2])
        return (0.0, 0.0, 0.0, 0.0, 0.0, spin), (x, y, vx, vy, turn, spin + turning)

    def apart(self, bore: BodyState, journal: BodyState) -> tuple[Vector, Vector]:
        """The vector from the bore's section to the journal's, and its rate, ground's axes."""
        at_bore, at_journal = self.bore.beside(self.shifts[0]), self.journal.beside(self.shifts[1])
        (bx, by, bz), (bvx, bvy, bvz) = bore.point(at_bore)
        (jx, jy, jz), (jvx, jvy, jvz) = journal.point(at_journal)
        # at the start
        x, y, z = (
            (cj + j) - (cb + b)
            for cj, j, cb, b in zip(self.journal.centre, at_journal, self.bore.centre, at_bore, strict=True)
        )
        return (jx - bx + x, jy - by + y, jz - bz + z), (jvx - bvx, jvy - bvy, jvz - bvz)

    def axes(self, bore: BodyState, journal: BodyState) -> Axes:
        """The axes in which the force of a section is given, in the ground's."""
        axes = bore.turned(self.bore.across[0]), bore.turned(self.bore.across[1]), bore.turned(self.bore.along)
        if self.at is Attachment.MIDDLE:
            return half_way(axes, journal.turned(self.journal.along))
        return axes

    def beside(self, position: list[float], velocity: list[float]) -> tuple[float, float]:
        """How far the sections are apart along the axis in their own places [m], and the rate."""
        bore, journal = self.bore.state(position, velocity), self.journal.state(position, velocity)
        apart, rates = self.apart(bore, journal)
        along = self.axes(bore, journal)[2]
        return self.shifts[0] - self.shifts[1] + dot(along, apart), dot(along, rates)

    def meet(self, apart: float) -> None:
        """Shift the sections so that they meet that are so far apart in their own places [m].

        Those of the bore, or half and half where the force acts in the middle: in either case what the force
        goes by, the displacement across its axis, is not changed by it.
        """
        self.shifts = (0.5 * apart, -0.5 * apart) if self.at is Attachment.MIDDLE else (apart, 0.0)


def dot(a: Vector, b: Vector) -> float:
    """Inner product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def half_way(axes: Axes, along: Vector) -> Axes:
    """Axes tilted half of the way that turns their third into another vector; see `sections.half_way`."""
    first, second, own = axes
    x, y, z = own[0] + along[0], own[1] + along[1], own[2] + along[2]
    size = sqrt(x * x + y * y + z * z)
    middle = x / size, y / size, z / size
    both = own[0] + middle[0], own[1] + middle[1], own[2] + middle[2]

    def turned(vector: Vector) -> Vector:
        share = dot(middle, vector) / (1.0 + dot(own, middle))
        return vector[0] - share * both[0], vector[1] - share * both[1], vector[2] - share * both[2]

    return turned(first), turned(second), middle


def marker_frame(end: BearingEnd, place: float, centre: Vector3) -> list[list[float]]:
    """Frame of a section on its body, in the body's axes (4 x 4), its z along the bearing."""
    frame = np.eye(4)
    frame[:3, :3] = frame_of(end.axis)
    frame[:3, 3] = np.array(end.centre(place)) - np.array(centre)
    found: list[list[float]] = frame.tolist()
    return found
