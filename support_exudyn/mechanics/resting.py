"""Where a linkage comes to rest that constraints leave free to move, such as one that springs hold."""

from collections.abc import Callable

import numpy as np

from support_exudyn.mechanics.kinetics import Kinetics, Matrix
from support_exudyn.mechanics.postures import posture

ROUNDS = 80
NEAR = 1e-5  # [m], [rad] over which it is looked how forces change
LONGEST = 0.2  # [m], [rad] of a step
CLOSE = 1e-12  # [m], [rad] of the last
WEAK = 1e-9  # share of the largest stiffness below which nothing restores
HELD = 1e-9  # share of the largest singular value of constraints below which a direction is free


def resting(closed: Kinetics, forces: Callable[[Matrix], Matrix], start: Matrix) -> Matrix | None:
    """Coordinates of all bodies (n,) at which forces balance, and to which they pull back.

    Newton's method over the directions that constraints leave free, with the forces' stiffness and that of the
    constraints, which turn: both by differences. Against a stiffness that pushes away it goes along the force.

    Arguments:
        closed: a linkage with all pins closed and all actuators rigid.
        forces: of coordinates (n,) on all coordinates (n,).
        start: coordinates from which they are looked for (n,).

    Returns None if nothing is free, or no place of rest is found.
    """
    position = start
    for _ in range(ROUNDS):
        free = _free(closed, position)
        if not free.size:
            return None
        stiffness = np.array([_slope(closed, forces, position, free, k) for k in range(free.shape[1])])
        if not np.isfinite(stiffness).all():
            return None
        sizes, directions = np.linalg.eigh(-0.5 * (stiffness + stiffness.T))
        largest = float(np.abs(sizes).max())
        if largest == 0.0 or np.abs(sizes).min() < WEAK * largest:
            return None
        pull = directions.T @ (free.T @ forces(position))
        step = directions @ (pull / np.abs(sizes))
        length = float(np.abs(step).max())
        if length < CLOSE:
            return position if sizes.min() > 0.0 else None
        there = posture(closed, position + free @ step * min(1.0, LONGEST / length), {}, {})
        if there is None:
            return None
        position = there
    return None


def _free(closed: Kinetics, position: Matrix) -> Matrix:
    """Directions that constraints leave free, as columns (n, f)."""
    rows = closed.rows(position)
    if not rows.size:
        return np.eye(position.size)
    _, values, directions = np.linalg.svd(rows)
    held = int((values > HELD * values.max()).sum())
    return np.asarray(directions[held:].T)


def _slope(
    closed: Kinetics, forces: Callable[[Matrix], Matrix], position: Matrix, free: Matrix, k: int
) -> Matrix:
    """How the forces along all free directions change along one of them (f,); not a number where it ends."""
    pulls = []
    for way in (NEAR, -NEAR):
        there = posture(closed, position + way * free[:, k], {}, {})
        if there is None:
            return np.full(free.shape[1], np.nan)
        onwards = _free(closed, there)
        pulls.append((onwards @ (onwards.T @ free)).T @ forces(there))
    return (pulls[0] - pulls[1]) / (2.0 * NEAR)
