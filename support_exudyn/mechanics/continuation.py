"""A linkage moved by its driven parts, step by step, so that it stays on one branch."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from support_exudyn.mechanics.closing import CURVED, FARTHEST_STEP, LARGEST_TURN, Conditions
from support_exudyn.mechanics.kinetics import REPEATED, Matrix
from support_exudyn.mechanics.postures import ROUNDINGS
from support_exudyn.model.linkage import Linkage

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
    before: Mapping[str, float],
    after: Mapping[str, float],
    along: Matrix | None = None,
) -> tuple[Matrix, float]:
    """The posture to which driven parts move a linkage, and the share of the way that it comes.

    The way is straight in the travels of all driven parts. A step goes along the tangent and is short enough
    that what is left for Newton's method is little of it; at a fold, where the linkage locks, steps vanish.

    Arguments:
        conditions: of `conditions_of`.
        start: coordinates counted by `Conditions.arms` (n,) [m] in which the travels are those before.
        before, after: travels of actuators and cranks from the start posture on [m], [rad]; else 0.
        along: the movement that is expected (n,) [m]. It tells which way to go on where all bars lie in line.

    Returns coordinates (n,), those at the end of the way or where the linkage locks or opens, and the share, 1
    if all of the way is gone.
    """
    moved, share, step = start, 0.0, 1.0
    ahead = conditions.short(start, after) - conditions.short(start, before)
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
            goal = {name: (1.0 - at) * before.get(name, 0.0) + at * travel for name, travel in after.items()}
            found = _corrected(
                conditions, moved + step * direction, goal, CURVED * step * np.abs(direction).max()
            )
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
    conditions: Conditions, near: Matrix, travels: Mapping[str, float], most: float
) -> Matrix | None:
    """The posture for travels near another one, by Newton's method; None if it lies farther than `most` [m]."""
    # coordinates of a crank that has turned for long are rounded more
    enough = max(conditions.enough, ROUNDINGS * math.ulp(float(np.abs(near).max())))
    moved, most = near, max(most, 10.0 * enough)
    for _ in range(ROUNDS):
        short = conditions.short(moved, travels)
        if np.abs(short).max(initial=0.0) < enough:
            return moved
        moved = moved + np.linalg.lstsq(conditions.rows(moved), short, rcond=REPEATED)[0]
        if not np.abs(moved - near).max() <= most:
            return None
    return None
