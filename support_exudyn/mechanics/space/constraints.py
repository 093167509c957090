"""Constraints of a spatial linkage as rows of a matrix, and which of them say something of their own.

A row gives the rate of one constraint from the velocities of all bodies, v and omega of each. Machines in space
are held more often than they need: the second of two parallel links, or a fourth actuator under a rigid canopy,
says nothing new. Such rows are left out of the model, by which no motion changes. How the load is shared among
what holds the same is beyond rigid bodies; see `reactions`.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Literal, NamedTuple

import numpy as np

from support_exudyn.mechanics.space.motion import SpatialMotion, SpatialPointMotion, cross
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.spatial_linkage import Bearing, SpatialLinkage
from user_forces.values.value import Vector3

SAME = 1e-6  # share of a row that must be new, else it repeats others
FindPoint = Callable[[str, Vector3], SpatialPointMotion]
Kind = Literal["actuator", "across_1", "across_2", "along", "tilt_1", "tilt_2", "turn"]
SHIFTS: tuple[Kind, ...] = ("across_1", "across_2", "along")
TURNS: tuple[Kind, ...] = ("tilt_1", "tilt_2", "turn")  # what holds turns about directions, not shifts


@dataclass(frozen=True)
class Constraint:
    """One constraint: of which bearing or actuator, and what it holds."""

    name: str
    kind: Kind


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


def all_rows(linkage: SpatialLinkage, with_clearance: Sequence[str], rigid: Sequence[str]) -> list[Constraint]:
    """What is held, if these planar pins are with clearance and these actuators rigid; the actuators last."""
    rows: list[Constraint] = []
    bearings = linkage.bearings.items()
    for name, bearing in bearings:
        if bearing.pin not in with_clearance:
            rows += [Constraint(name, "across_1"), Constraint(name, "across_2")]
    rows += [Constraint(name, "along") for name, bearing in bearings if "along" in bearing.holds]
    for name, bearing in bearings:
        if "tilt" in bearing.holds and bearing.pin not in with_clearance:
            rows += [Constraint(name, "tilt_1"), Constraint(name, "tilt_2")]
    rows += [Constraint(name, "turn") for name, bearing in bearings if "turn" in bearing.holds]
    return rows + [Constraint(name, "actuator") for name in rigid]


def matrix(motion: SpatialMotion, rows: Sequence[Constraint]) -> Series:
    """The rows at every instant, shape (n, rows, 6 bodies)."""
    found = np.zeros((motion.count, len(rows), 6 * len(motion.linkage.bodies)))
    point = cache(motion.point)  # the rows of a bearing ask for the same
    for place, row in enumerate(rows):
        if row.kind == "actuator":
            _actuator_row(motion, point, row.name, found[:, place])
        else:
            _bearing_row(motion, point, row, found[:, place])
    return found


def _actuator_row(motion: SpatialMotion, point: FindPoint, name: str, row: Series) -> None:
    actuator = motion.linkage.actuators[name]
    foot = point(actuator.foot, actuator.foot_point)
    head = point(actuator.head, actuator.head_point)
    along = head.position - foot.position
    along /= np.linalg.norm(along, axis=1)[:, None]
    _add_point(motion, actuator.head, head.arm, along, row)
    _add_point(motion, actuator.foot, foot.arm, -along, row)


def _bearing_row(motion: SpatialMotion, point: FindPoint, row: Constraint, found: Series) -> None:
    bearing = motion.linkage.bearings[row.name]
    direction = direction_of(motion, bearing, row.kind)
    if row.kind in TURNS:
        _add_turn(motion, bearing.second, direction, found)
        _add_turn(motion, bearing.first, -direction, found)
        return
    first = point(bearing.first, bearing.first_point)
    second = point(bearing.second, bearing.second_point)
    _add_point(motion, bearing.second, second.arm, direction, found)
    _add_point(motion, bearing.first, first.arm, -direction, found)
    # the direction turns with the first body
    _add_turn(motion, bearing.first, cross(direction, second.position - first.position), found)


def direction_of(motion: SpatialMotion, bearing: Bearing, kind: Kind) -> Series:
    """The direction in which, or about which, a bearing holds, (n, 3)."""
    column = {"across_1": 0, "across_2": 1, "along": 2, "tilt_1": 0, "tilt_2": 1, "turn": 2}[kind]
    return motion.carried(bearing.first, frame_of(bearing.first_axis)[:, column])


def _add_point(motion: SpatialMotion, body: str, arm: Series, direction: Series, row: Series) -> None:
    """Add the rate of a point of a body in a direction."""
    if body != GROUND:
        i = 6 * motion.index(body)
        row[:, i : i + 3] += direction
        row[:, i + 3 : i + 6] += cross(arm, direction)


def _add_turn(motion: SpatialMotion, body: str, direction: Series, row: Series) -> None:
    """Add the angular velocity of a body about a direction."""
    if body != GROUND:
        i = 6 * motion.index(body)
        row[:, i + 3 : i + 6] += direction


def independent(rows: Sequence[Constraint], values: Series) -> list[Constraint]:
    """Rows that say something that those before them do not; values: (rows, 6 bodies) at the start.

    Rotations count as shifts at 1 m.
    """
    basis: list[Series] = []
    kept = []
    for row, value in zip(rows, values, strict=True):
        rest = value / np.linalg.norm(value)
        for _ in range(2):  # twice is enough for orthogonality to rounding
            for known in basis:
                rest = rest - (known @ rest) * known
        length = float(np.linalg.norm(rest))
        if length > SAME:
            basis.append(rest / length)
            kept.append(row)
    return kept


class BearingEnd(NamedTuple):
    """Bore or journal of a bearing: its body, its middle and its axis, start posture."""

    body: str
    point: Vector3
    axis: Vector3

    def centre(self, place: float) -> Vector3:
        """Centre of a section [m]."""
        x, y, z = np.array(self.point) + place * np.array(self.axis)
        return float(x), float(y), float(z)
