"""What a linkage has to meet to be closed, how far a posture is from that, and the way to where it is met.

One Newton method and one continuation serve all: drawings that are assembled, drives that are followed, and
journals out of the middle of their bores.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np

from support_exudyn.mechanics.kinetics import REPEATED, Kinetics, Matrix, joints_of, kinetics_of
from support_exudyn.model.linkage import GROUND, Linkage
from user_forces.values.value import Vector2

JOINTS = ("cranks", "actuators", "gears", "slides", "pins")  # fields of a linkage that hold its parts together
DRIVEN = ("cranks", "actuators")
CLOSED = 1e-13  # [m]
ROUNDINGS = 8.0  # of the coordinates
LEAST_ARM = 0.1  # of the drawing's size: by this the turn of a small body is counted
ROUNDS = 8  # of Newton's method after a step of the continuation

FARTHEST_STEP = 0.05  # of the linkage's size
LARGEST_TURN = 0.2  # [rad] in a step
CURVED = 0.25  # of a step: by how much the posture may lie beside the tangent
FINEST = 2.0**-34  # of the way between two postures: a step so short is none
SINGULAR = 1e-5  # of the largest singular value: below, the direction is taken from the way that led there
AGAINST = 1e-3  # of what is driven: what a movement may leave of it

PRECISE, EVALUATIONS = 1e-10, 60  # of a search for the least gaps
NEARLY = 1e-3  # of the drawing's size: gaps from which on Newton's method closes what can be closed
LESS = 0.8  # of what was open before: if a step leaves more, rounding is reached
ASIDE = 1e-3  # of the machine's size: how far it is moved to see whether a freedom lasts
NONE: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True)
class Conditions:
    """What a linkage has to meet: its joints, and the angles, lengths and offsets that are given.

    Postures are coordinates of all bodies from the drawing on, counted by `arms` (n,) [m].

    Arguments:
        linkage: the drawing; its cranks and actuators are those whose angle or length is given.
        travels: by actuator and crank, how far it has to move from where it is drawn [m], [rad]; else 0.
        origins: by guide, where its line passes on the body that carries it [m], as drawn.
        offsets: by pin, centre of its second body's point minus that of the first [m]; else as drawn.
    """

    linkage: Linkage
    travels: Mapping[str, float] = field(default_factory=dict)
    origins: Mapping[str, Vector2] = field(default_factory=dict)
    offsets: Mapping[str, Vector2] = field(default_factory=dict)

    @cached_property
    def kinetics(self) -> Kinetics:
        """Matrices of what holds the linkage together."""
        return kinetics_of(self.linkage)

    @property
    def size(self) -> float:
        """The larger of length and height of the drawing [m]."""
        return self.kinetics.size

    @cached_property
    def still(self) -> Matrix:
        """The posture of the drawing (n,)."""
        return np.zeros(3 * len(self.linkage.bodies))

    @cached_property
    def arms(self) -> Matrix:
        """By which movements are counted (n,): 1 for distances, for a turn a body's largest arm [m]."""
        least = LEAST_ARM * self.size
        arms = dict.fromkeys(self.linkage.bodies, least)
        for name, place in joints_of(self.linkage):
            if name != GROUND:
                arms[name] = max(arms[name], math.dist(place, self.linkage.bodies[name].centre))
        return np.array([count for arm in arms.values() for count in (1.0, 1.0, arm)])

    @cached_property
    def counts(self) -> Matrix:
        """See `Kinetics.counts`."""
        return self.kinetics.counts

    @cached_property
    def enough(self) -> float:
        """How far open counts as closed [m]: some roundings, less for what is smaller than a metre."""
        return max(CLOSED * min(1.0, self.size), ROUNDINGS * math.ulp(self.linkage.farthest))

    @cached_property
    def _first_rows(self) -> dict[tuple[str, str], int]:
        """The first row of every joint and driven part, by the field of the linkage and its name."""
        return {owner: row for row, owner in reversed([*enumerate(self.kinetics.owners())])}

    @cached_property
    def _drawn(self) -> Matrix:
        """What constraints hold where all joints are closed and driven parts are as drawn (m,) [m], [rad]."""
        values = self.kinetics.values(self.still)
        for name, origin in self.origins.items():
            slide = self.linkage.slides[name]
            x, y = np.subtract(slide.point, origin)
            values[self._first_rows["slides", name]] = (
                math.sin(slide.direction) * x - math.cos(slide.direction) * y
            )
        return values

    def targets(self, travels: Mapping[str, float], offsets: Mapping[str, Vector2]) -> Matrix:
        """What constraints hold where all is met (m,) [m], [rad], with these travels and offsets."""
        found = self._drawn.copy()
        for part, name in self.driven:
            found[self._first_rows[part, name]] += travels.get(name, 0.0)
        for name, offset in offsets.items():
            row = self._first_rows["pins", name]
            found[row : row + 2] = offset
        return found

    @cached_property
    def _own_targets(self) -> Matrix:
        return self.targets(self.travels, self.offsets)

    def short(self, moved: Matrix, targets: Matrix | None = None) -> Matrix:
        """What each condition is short of (m,) [m], angles by the size of the drawing.

        targets: of `targets`; by default with the own travels and offsets.
        """
        targets = self._own_targets if targets is None else targets
        return np.asarray(self.counts * (targets - self.kinetics.values(moved / self.arms)))

    def rows(self, moved: Matrix) -> Matrix:
        """Rates of the conditions (m, n), of coordinates counted by `arms`."""
        rows: Matrix = self.counts[:, None] * self.kinetics.rows(moved / self.arms) / self.arms
        return rows

    def closed(self, moved: Matrix) -> bool:
        """Whether all conditions are met."""
        return bool(np.abs(self.short(moved)).max(initial=0.0) < self.enough)

    def of(self, names: Collection[tuple[str, str]]) -> Conditions:
        """Those of some joints and driven parts alone, each by its field of the linkage and its name."""
        kept = {
            kind: {name: one for name, one in getattr(self.linkage, kind).items() if (kind, name) in names}
            for kind in JOINTS
        }
        return replace(
            self,
            linkage=replace(self.linkage, **kept),
            origins={name: one for name, one in self.origins.items() if name in kept["slides"]},
            offsets={name: one for name, one in self.offsets.items() if name in kept["pins"]},
        )

    @cached_property
    def repeated(self) -> tuple[int, bool]:
        """See `repeated_count`."""
        return _repeated(self)

    @property
    def names(self) -> list[tuple[str, str]]:
        """All driven parts and joints, each by its field of the linkage and its name."""
        return [(kind, name) for kind in JOINTS for name in getattr(self.linkage, kind)]

    @property
    def driven(self) -> list[tuple[str, str]]:
        """Those whose angle or length is given."""
        return [(kind, name) for kind, name in self.names if kind in DRIVEN]


def newton(
    conditions: Conditions,
    near: Matrix,
    targets: Matrix,
    farthest: float,
    *,
    rounds: int = ROUNDS,
    light: Matrix | float = 1.0,
) -> Matrix | None:
    """The posture next to another that meets targets, by Newton's method; None if it does not get there.

    Arguments:
        near: posture from which it starts.
        targets: of `Conditions.targets` (m,).
        farthest: how far from the start the posture may lie [m].
        rounds: how many steps at most.
        light: of all steps that close the same, that is taken whose quotient by this is the least.
    """
    # coordinates of a crank that has turned for long are rounded more
    enough = max(conditions.enough, ROUNDINGS * math.ulp(float(np.abs(near).max())))
    moved, farthest = near, max(farthest, 10.0 * enough)
    for _ in range(rounds):
        short = conditions.short(moved, targets)
        if np.abs(short).max(initial=0.0) < enough:
            return moved
        moved = moved + light * np.linalg.lstsq(conditions.rows(moved) * light, short, rcond=REPEATED)[0]
        if not np.abs(moved - near).max() <= farthest:
            return None
    return None


def moved_on(
    conditions: Conditions,
    start: Matrix,
    travels: Mapping[str, float] | None = None,
    along: Matrix | None = None,
) -> tuple[Matrix, float]:
    """The posture to which a linkage moves as what is open of its conditions closes, and the share that does.

    On the way all that is open closes in proportion: gaps of a drawing, or the rest of the travels of driven
    parts. A step goes along the tangent and is short enough that what is left for Newton's method is little of
    it; at a fold, where the linkage locks, steps vanish.

    Arguments:
        conditions: that are met at the end of the way.
        start: posture from which it goes (n,) [m].
        travels: at the end of the way; by default those of the conditions.
        along: the movement that is expected (n,) [m]. It tells which way to go on where all bars lie in line.

    Returns coordinates (n,), those at the end of the way or where the linkage locks or opens, and the share, 1
    if all is closed.
    """
    targets = conditions.targets(conditions.travels if travels is None else travels, conditions.offsets)
    moved, share, step = start, 0.0, 1.0
    ahead = conditions.short(start, targets)
    if np.abs(ahead).max(initial=0.0) < conditions.enough:
        return start, 1.0
    turns = np.arange(start.size) % 3 == 2
    while share < 1.0:
        direction = tangent(conditions, moved, ahead, along)
        if direction is None:
            return moved, share
        far = np.abs(direction).max() / (FARTHEST_STEP * conditions.size)
        far = max(far, np.abs(direction / conditions.arms)[turns].max() / LARGEST_TURN)
        step = min(2.0 * step, 1.0 - share, 1.0 / max(far, 1.0))
        while True:
            at = share + step if step < 1.0 - share else 1.0
            near, most = moved + step * direction, CURVED * step * np.abs(direction).max()
            found = newton(conditions, near, targets - (1.0 - at) * ahead / conditions.counts, most)
            if found is not None:
                break
            step /= 2.0
            if step < FINEST:
                return moved, share
        moved, share, along = found, at, direction
    return moved, share


def tangent(conditions: Conditions, moved: Matrix, ahead: Matrix, along: Matrix | None = None) -> Matrix | None:
    """The movement (n,) [m] that changes conditions by so much (m,), to first order; None if there is none.

    Of several the least; where a posture leaves a direction open, that part of the movement is as `along` (n,).
    """
    left, values, right = np.linalg.svd(conditions.rows(moved), full_matrices=False)
    # next to a fold the little that is left of a direction is what moves the linkage, unlike in a change point
    needed = np.abs(left.T @ ahead) > AGAINST * np.linalg.norm(ahead)
    clear = values > np.where(needed, REPEATED, SINGULAR) * values.max(initial=0.0)
    shares = left.T[clear] @ ahead
    if np.linalg.norm(ahead - left.T[clear].T @ shares) > AGAINST * np.linalg.norm(ahead):
        return None
    found: Matrix = right[clear].T @ (shares / values[clear])
    if along is not None and not clear.all():
        found = found + right[~clear].T @ (right[~clear] @ along)
    return found


def nearest(conditions: Conditions, start: Matrix) -> Matrix:
    """The posture (n,) in which the least is open, in the sum of squares, near a start."""
    from scipy.optimize import least_squares  # slow to import

    if not conditions.names:
        return start

    def open_by(moved: Matrix) -> Matrix:
        return -conditions.short(moved)

    found = least_squares(
        open_by, start, conditions.rows, x_scale=conditions.size, ftol=PRECISE, xtol=PRECISE, gtol=PRECISE,
        max_nfev=EVALUATIONS,
    ).x  # fmt: skip
    best, before = found, math.inf
    short = conditions.short(found)
    while np.abs(short).max() < min(NEARLY * conditions.size, LESS * before):  # to rounding
        best, before = found, float(np.abs(short).max())
        found = found + np.linalg.lstsq(conditions.rows(found), short, rcond=REPEATED)[0]
        short = conditions.short(found)
    return best


def beside(conditions: Conditions, rates: Sequence[Matrix]) -> Matrix:
    """A posture (n,) a little beside the drawing, on the ways in which a linkage can still move.

    Arguments:
        conditions: that hold in the drawing.
        rates: of each way, of all coordinates counted by `arms` (n,), the largest about 1.
    """
    moved = conditions.still
    for one, share in zip(rates, np.linspace(1.0, 2.0, len(rates)), strict=True):
        moved = moved + ASIDE * share * conditions.size * one
    for _ in range(ROUNDS):
        short = conditions.short(moved)
        moved = moved + np.linalg.lstsq(conditions.rows(moved), short, rcond=REPEATED)[0]
    return moved


def repeated_count(conditions: Conditions) -> tuple[int, bool]:
    """How many conditions follow from the others, and whether more of them do so in the start posture alone.

    The start posture is then a dead centre or a change point.
    """
    return conditions.repeated


def _repeated(conditions: Conditions) -> tuple[int, bool]:
    left, values, right = np.linalg.svd(conditions.rows(conditions.still))
    rank = _rank(values)
    repeats = len(left) - rank
    if repeats == 0:
        return 0, False
    ways = [way / np.abs(way).max() for way in right[rank:]]
    there = np.linalg.svd(conditions.rows(beside(conditions, ways)), compute_uv=False)
    lasting = len(left) - _rank(there)
    return lasting, lasting < repeats


def _rank(values: np.ndarray) -> int:
    """How many singular values (k,) are none of rounding."""
    return int(np.count_nonzero(values > REPEATED * values.max(initial=0.0)))
