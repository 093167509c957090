"""What a linkage has to meet to be closed, and how far it is from that."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from support_exudyn.mechanics.kinetics import REPEATED, Kinetics, Matrix, joints_of, kinetics_of
from support_exudyn.mechanics.postures import CLOSED, ROUNDINGS, missing
from support_exudyn.model.linkage import GROUND, Linkage
from user_forces.values.value import Vector2

JOINTS = ("pins", "actuators", "cranks", "slides", "gears")  # fields of a linkage that hold its parts together
PRECISE, EVALUATIONS = 1e-10, 60  # of a search for the least gaps
NEARLY = 1e-3  # of the drawing's size: gaps from which on Newton's method closes what can be closed
LESS = 0.8  # of what was open before: if a step leaves more, rounding is reached
LEAST_ARM = 0.1  # of the drawing's size: by this the turn of a small body is counted
ASIDE = 1e-3  # of the machine's size: how far it is moved to see whether a freedom lasts
ROUNDS = 8  # of Newton's method there


@dataclass(frozen=True)
class Conditions:
    """What a linkage has to meet: its joints, and the angles and lengths that are asked for.

    Arguments:
        linkage: the drawing; its cranks and actuators are those whose angle or length is asked for.
        travels: by actuator and crank, how far it has to move from where it is drawn [m], [rad].
        origins: by guide, where its line passes on the body that carries it [m], as drawn.
        together: whether the two points of pins coincide; else they stay as far apart as drawn.
    """

    linkage: Linkage
    travels: Mapping[str, float]
    origins: Mapping[str, Vector2]
    together: bool = True

    @cached_property
    def kinetics(self) -> Kinetics:
        """Matrices of what holds it together."""
        return kinetics_of(self.linkage)

    @property
    def size(self) -> float:
        """The larger of length and height of the drawing [m]."""
        return self.kinetics.size

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
    def shift(self) -> Matrix:
        """By how much the line of each guide misses its point in the drawing, beside zeros (m,) [m]."""
        shift = np.zeros(len(self.kinetics.owners()))
        seen = set()
        for row, (kind, name) in enumerate(self.kinetics.owners()):
            if kind == "slides" and name in self.origins and name not in seen:
                seen.add(name)
                slide = self.linkage.slides[name]
                x, y = np.subtract(slide.point, self.origins[name])
                shift[row] = math.cos(slide.direction) * y - math.sin(slide.direction) * x
        return shift

    @cached_property
    def counts(self) -> Matrix:
        """See `Kinetics.counts`."""
        return self.kinetics.counts

    @cached_property
    def enough(self) -> float:
        """How far open counts as closed [m]: some roundings, less for what is smaller than a metre."""
        return max(CLOSED * min(1.0, self.size), ROUNDINGS * math.ulp(self.linkage.farthest))

    def short(self, moved: Matrix, travels: Mapping[str, float] | None = None) -> Matrix:
        """What each condition is short of (m,) [m], angles by the size of the drawing.

        Arguments:
            moved: coordinates counted by `arms` (n,) [m].
            travels: in place of those of these conditions.
        """
        offsets = dict.fromkeys(self.linkage.pins, (0.0, 0.0)) if self.together else {}
        found = missing(self.kinetics, moved / self.arms, offsets, self.travels if travels is None else travels)
        return self.counts * (found - self.shift)

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
        return replace(self, linkage=replace(self.linkage, **kept))

    @property
    def names(self) -> list[tuple[str, str]]:
        """All driven parts and joints, each by its field of the linkage and its name."""
        kinds = ("cranks", "actuators", "gears", "slides", "pins")
        return [(kind, name) for kind in kinds for name in getattr(self.linkage, kind)]

    @property
    def driven(self) -> list[tuple[str, str]]:
        """Those whose angle or length is asked for."""
        return [(kind, name) for kind, name in self.names if kind in ("cranks", "actuators")]


def nearest(conditions: Conditions, start: Matrix) -> Matrix:
    """Coordinates (n,) in which the least is open, in the sum of squares, near a start."""
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
    """Coordinates (n,) a little beside the start, on the ways in which a linkage can still move.

    Arguments:
        conditions: that hold.
        rates: of each way, of all coordinates counted by `arms` (n,), the largest about 1.
    """
    moved = np.zeros(3 * len(conditions.linkage.bodies))
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
    left, values, right = np.linalg.svd(conditions.rows(np.zeros(3 * len(conditions.linkage.bodies))))
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
