"""A linkage moved step by step, by its driven parts or from a drawing, so that it stays on one branch."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from support_exudyn.mechanics.closing import Conditions
from support_exudyn.mechanics.kinetics import REPEATED, Matrix
from support_exudyn.mechanics.postures import ROUNDINGS
from support_exudyn.model.linkage import Linkage

FARTHEST_STEP = 0.05  # of the linkage's size
LARGEST_TURN = 0.2  # [rad] in a step
CURVED = 0.25  # of a step: by how much the posture may lie beside the tangent
ROUNDS = 8  # of Newton's method after a step
FINEST = 2.0**-34  # of the way between two postures: a step so short is none
SINGULAR = 1e-5  # of the largest singular value: below, the direction is taken from the way that led there
AGAINST = 1e-3  # of what is driven: what a movement may leave of it


def conditions_of(linkage: Linkage) -> Conditions:
    """What a linkage meets as its driven parts move it: its pins stay as they are at the start."""
    return Conditions(linkage, {}, {}, together=False)


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
        start: coordinates counted by `Conditions.arms` (n,) [m].
        travels: see `Conditions.short`.
        along: the movement that is expected (n,) [m]. It tells which way to go on where all bars lie in line.

    Returns coordinates (n,), those at the end of the way or where the linkage locks or opens, and the share, 1
    if all is closed.
    """
    moved, share, step = start, 0.0, 1.0
    ahead = conditions.short(start, travels)
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
            found = _corrected(conditions, near, travels, (1.0 - at) * ahead, most)
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


def _corrected(
    conditions: Conditions, near: Matrix, travels: Mapping[str, float] | None, ahead: Matrix, most: float
) -> Matrix | None:
    """The posture next to another in which conditions are open by so much, `ahead` (m,), by Newton's method.

    None if it lies farther than `most` [m].
    """
    # coordinates of a crank that has turned for long are rounded more
    enough = max(conditions.enough, ROUNDINGS * math.ulp(float(np.abs(near).max())))
    moved, most = near, max(most, 10.0 * enough)
    for _ in range(ROUNDS):
        short = conditions.short(moved, travels) - ahead
        if np.abs(short).max(initial=0.0) < enough:
            return moved
        moved = moved + np.linalg.lstsq(conditions.rows(moved), short, rcond=REPEATED)[0]
        if not np.abs(moved - near).max() <= most:
            return None
    return None
