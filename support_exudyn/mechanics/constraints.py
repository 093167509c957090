"""What joints hold, as rows of a matrix: rates of what is held from the velocities of all bodies.

In the plane and in space there are three kinds of rows only:

- `Distance` of two points: a rigid actuator,
- `Shift` of a point of the second body from one of the first, along a direction: pins, bearings and guides,
- `Turn` of bodies about a direction, each by its share: guides, bearings, cranks and gears.

Machines are often held more than they need: the second of two parallel links, or a fourth actuator under a
rigid canopy, repeats other rows. `independent` leaves such rows out, by which no motion changes. How loads are
shared among rows that repeat each other is beyond rigid bodies; see `reactions`.
"""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Literal

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion, Motion, cross
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND, LinearActuator, Linkage, PinPlace
from support_exudyn.model.plane_geometry import rotated
from support_exudyn.model.spatial_linkage import Bearing, SpatialActuator, SpatialLinkage
from user_forces.values.value import Vector3

SAME = 1e-6  # share of a row that must be new, else it repeats others
SHIFT = 1e-5  # [m], [rad] by which bodies move on, at most, to compute how rows turn with them
STILL = 1e-6  # [m/s], [rad/s] below which they move on by less: what is left then is far below rounding
NO_LENGTH = np.finfo(np.float64).tiny  # [m], so that nothing is divided by zero
Kind = Literal["actuator", "across_1", "across_2", "along", "tilt_1", "tilt_2", "turn"]
SHIFTS: tuple[Kind, ...] = ("across_1", "across_2", "along")
TURNS: tuple[Kind, ...] = ("tilt_1", "tilt_2", "turn")  # what holds turns about directions, not shifts


@dataclass(frozen=True)
class Constraint:
    """One constraint.

    part: field of the linkage that has its joint, such as "pins". name: of the joint. kind: what it holds.
    """

    part: str
    name: str
    kind: Kind


@dataclass(frozen=True)
class Distance(Constraint):
    """The distance of a point of the second body from one of the first."""

    first: str
    first_point: Any
    second: str
    second_point: Any


@dataclass(frozen=True)
class Shift(Distance):
    """A point of the second body from one of the first along a direction, which turns with the carrier."""

    direction: tuple[float, ...]
    carrier: str


@dataclass(frozen=True)
class Turn(Constraint):
    """The sum of the turns of bodies, each times its share, about a direction that turns with the carrier.

    In the plane it has no direction, and no carrier is needed.
    """

    shares: tuple[tuple[str, float], ...]
    direction: tuple[float, ...] = ()
    carrier: str = GROUND


class ConstraintRows:
    """Constraints of a linkage as arrays: all of them are evaluated at once, at all instants of a motion.

    Bodies go by their numbers in the linkage; the ground is the last.

    Arguments:
        linkage: in its start posture.
        held: what is held.
    """

    def __init__(self, linkage: Linkage | SpatialLinkage, held: Sequence[Constraint]) -> None:
        number = {name: n for n, name in enumerate((*linkage.bodies, GROUND))}
        axes = 3 if isinstance(linkage, SpatialLinkage) else 2
        self._count = len(held)
        lines = [one for one in held if isinstance(one, Distance)]
        turns = [one for one in held if isinstance(one, Turn)]
        self._lines = np.array([n for n, one in enumerate(held) if isinstance(one, Distance)], dtype=int)
        self._turns = np.array([n for n, one in enumerate(held) if isinstance(one, Turn)], dtype=int)
        # lines from a point of the first body to one of the second
        starts = np.array([*(body.centre for body in linkage.bodies.values()), (0.0,) * axes])
        self._ends = np.array([[number[one.first], number[one.second]] for one in lines], dtype=int)
        self._ends = self._ends.reshape(-1, 2).T
        places = np.array([[one.first_point, one.second_point] for one in lines]).reshape(-1, 2, axes)
        self._arms = np.swapaxes(places, 0, 1) - starts[self._ends]
        shifts = [one if isinstance(one, Shift) else None for one in lines]
        self._distances = np.array([one is None for one in shifts], dtype=bool)
        self._along = np.array([one.direction if one else (0.0,) * axes for one in shifts]).reshape(-1, axes)
        self._carriers = np.array([number[one.carrier if one else GROUND] for one in shifts], dtype=int)
        # sums of turns
        self._shares = np.zeros((len(turns), len(number)))
        for row, one in enumerate(turns):
            for body, share in one.shares:
                self._shares[row, number[body]] += share
        self._about = np.array([one.direction for one in turns]) if axes == 3 else None
        self._turned_by = np.array([number[one.carrier] for one in turns], dtype=int)

    def _between(self, motion: Motion) -> tuple[Series, Series, Series]:
        """Arms of both points (n, 2, k, d) [m], the way between them (n, k, d) [m], and the direction of it."""
        arms = motion.turned(self._ends, self._arms)
        places = motion.centres[:, self._ends] + arms
        apart = places[:, 1] - places[:, 0]
        along = motion.turned(self._carriers, self._along)
        span = apart[:, self._distances]
        lengths = np.linalg.norm(span, axis=-1, keepdims=True)
        along[:, self._distances] = span / np.maximum(lengths, NO_LENGTH)
        return arms, apart, along

    def matrix(self, motion: Motion) -> Series:
        """C: the rows of all that is held at every instant, (n, rows, freedoms)."""
        bodies, shifts = len(motion.linkage.bodies), motion.SHIFTS
        # instants are the last axis while rows are added up: several times faster for many
        found = np.zeros((self._count, bodies + 1, motion.FREEDOMS, motion.count))

        def add(rows: Series, owners: Series, columns: slice, parts: Series) -> None:
            found[rows, owners, columns] += np.moveaxis(parts, 0, -1)

        if self._lines.size:
            arms, apart, along = self._between(motion)
            for end, sign in ((1, 1.0), (0, -1.0)):
                add(self._lines, self._ends[end], slice(shifts), sign * along)
                add(
                    self._lines, self._ends[end], slice(shifts, None), sign * motion.moment(arms[:, end], along)
                )
            add(self._lines, self._carriers, slice(shifts, None), motion.moment(along, apart))
        if self._turns.size:
            plane = np.ones((1, len(self._turns), 1))  # in it all turn about the same
            about = plane if self._about is None else motion.turned(self._turned_by, self._about)
            found[self._turns, :, shifts:] += self._shares[..., None, None] * np.moveaxis(about, 0, -1)[:, None]
        width = bodies * motion.FREEDOMS
        by_instant = np.moveaxis(found[:, :bodies].reshape(self._count, width, motion.count), -1, 0)
        return np.ascontiguousarray(by_instant)

    def values(self, motion: BodyMotion) -> Series:
        """What is held at every instant of a motion in the plane, (n, rows): lengths [m] and turns [rad]."""
        found = np.zeros((motion.count, self._count))
        if self._lines.size:
            _, apart, along = self._between(motion)
            found[:, self._lines] = np.einsum("nki,nki->nk", along, apart)
        if self._turns.size:
            found[:, self._turns] = motion.position[:, 2::3] @ self._shares[:, :-1].T
        return found


def matrix(motion: Motion, held: Sequence[Constraint]) -> Series:
    """C: the rows of all that is held at every instant, (n, rows, freedoms)."""
    return ConstraintRows(motion.linkage, held).matrix(motion)


def turning(motion: Motion, held: Sequence[Constraint]) -> Series:
    """C' v at every instant, (n, rows): by how much the rows change as the bodies move on."""
    velocities = motion.velocities
    time = SHIFT / np.maximum(np.abs(velocities).max(axis=1, initial=0.0), STILL)
    rows = ConstraintRows(motion.linkage, held)
    changed = rows.matrix(motion.later(time)) - rows.matrix(motion.later(-time))
    found: Series = np.einsum("nrk,nk->nr", changed, velocities) / (2.0 * time)[:, None]
    return found


def independent(rows: Series) -> list[int]:
    """Indices of rows (m, k) that say something that those before them do not.

    Rotations count as shifts at 1 m.
    """
    basis: list[Series] = []
    kept = []
    for n, row in enumerate(rows):
        rest = row / np.linalg.norm(row)
        for _ in range(2):  # twice is enough for orthogonality to rounding
            for known in basis:
                rest = rest - (known @ rest) * known
        length = float(np.linalg.norm(rest))
        if length > SAME:
            basis.append(rest / length)
            kept.append(n)
    return kept


def joints_held(held: Sequence[Constraint]) -> dict[tuple[str, str], slice]:
    """The rows of every joint, by the field of the linkage and its name; they stand together in the plane."""
    owners = [(constraint.part, constraint.name) for constraint in held]
    return {owner: slice(owners.index(owner), owners.index(owner) + owners.count(owner)) for owner in owners}


def _actuator(name: str, one: LinearActuator | SpatialActuator) -> Constraint:
    """A rigid actuator."""
    return Distance("actuators", name, "actuator", one.foot, one.foot_point, one.head, one.head_point)


# --- in the plane ---


def constraints_of(
    linkage: Linkage, ideal: Iterable[str] | None = None, rigid: Iterable[str] | None = None
) -> list[Constraint]:
    """What is held in the plane: rows of pins (two each), rigid actuators, cranks, guides (one or two), gears.

    ideal, rigid: names of the pins that are closed, and of the actuators that are rigid; all by default.
    """
    pins, actuators = linkage.pins if ideal is None else ideal, linkage.actuators if rigid is None else rigid
    found: list[Constraint] = [row for name in pins for row in pin(name, linkage.pins[name])]
    found += [_actuator(name, linkage.actuators[name]) for name in actuators]
    found += [Turn("cranks", name, "turn", ((one.body, 1.0),)) for name, one in linkage.cranks.items()]
    for name, slide in linkage.slides.items():
        ends = slide.against, slide.point, slide.body, slide.point
        across = rotated((0.0, 1.0), slide.direction)
        found.append(Shift("slides", name, "across_1", *ends, direction=across, carrier=slide.against))
        if not slide.turns:
            found.append(Turn("slides", name, "turn", ((slide.body, 1.0), (slide.against, -1.0))))
    for name, gear in linkage.gears.items():
        carrier = gear.carrier or GROUND
        shares = (gear.second, 1.0), (gear.first, -gear.ratio), (carrier, gear.ratio - 1.0)
        found.append(Turn("gears", name, "turn", shares))
    return found


def pin(name: str, place: PinPlace) -> list[Constraint]:
    """A pin of the plane: its centre on the second body against that on the first, forward and up."""
    ends = place.first, place.first_point, place.second, place.second_point
    ways: tuple[tuple[Kind, tuple[float, float]], ...] = (("across_1", (1.0, 0.0)), ("across_2", (0.0, 1.0)))
    return [Shift("pins", name, kind, *ends, direction=way, carrier=GROUND) for kind, way in ways]


# --- in space ---


@lru_cache
def frame_of(axis: Vector3) -> Series:
    """Axes (3, 3), in columns: two across an axis, and the axis; those of the ground if it is z."""
    along = np.asarray(axis, dtype=np.float64)
    helper = np.array([1.0, 0.0, 0.0] if abs(along[0]) < 0.9 else [0.0, 1.0, 0.0])
    first = helper - (helper @ along) * along
    first /= np.linalg.norm(first)
    frame: Series = np.column_stack([first, cross(along, first), along])
    frame.setflags(write=False)  # every bearing with this axis has it
    return frame


def bearing_row(name: str, bearing: Bearing, kind: Kind) -> Constraint:
    """A row of a bearing; its direction turns with the first body."""
    axis = {"across_1": 0, "across_2": 1, "along": 2, "tilt_1": 0, "tilt_2": 1, "turn": 2}[kind]
    direction = tuple(frame_of(bearing.first_axis)[:, axis].tolist())
    if kind in TURNS:
        bodies = (bearing.second, 1.0), (bearing.first, -1.0)
        return Turn("bearings", name, kind, bodies, direction, bearing.first)
    ends = bearing.first, bearing.first_point, bearing.second, bearing.second_point
    return Shift("bearings", name, kind, *ends, direction=direction, carrier=bearing.first)


def constraints_in_space(
    linkage: SpatialLinkage, with_clearance: Collection[str] = (), rigid: Iterable[str] = ()
) -> list[Constraint]:
    """What is held in space, if these planar pins have clearance and these actuators are rigid."""
    bearings = linkage.bearings.items()
    closed = [(name, one) for name, one in bearings if one.pin not in with_clearance]
    rows = [bearing_row(name, one, kind) for name, one in closed for kind in SHIFTS[:2]]
    rows += [bearing_row(name, one, "along") for name, one in bearings if "along" in one.holds]
    rows += [bearing_row(name, one, kind) for name, one in closed if "tilt" in one.holds for kind in TURNS[:2]]
    rows += [bearing_row(name, one, "turn") for name, one in bearings if "turn" in one.holds]
    return rows + [_actuator(name, linkage.actuators[name]) for name in rigid]
