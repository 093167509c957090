"""How a body has turned since the start, from the channels of its orientation.

In space these are three angles of the rotation matrix A:

    angle = atan2(A_10, A_00),   roll = atan2(A_21, A_11),   yaw = atan2(A_02, A_22)

Newton's method finds the matrix that has them.
"""

import numpy as np

from support_exudyn.mechanics.space.motion import rotation
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

ANGLES = ((2, 1, 1), (0, 2, 2), (1, 0, 0))  # roll, yaw, angle: row over row, in this column
MOST_CORRECTIONS = 30
PRECISE = 1e-13  # [rad]


def about_z(angle: Series) -> Series:
    """Rotation matrices (..., 3, 3) by angles about z (...) [rad]."""
    zero = np.zeros_like(angle)
    return rotation(np.stack([np.cos(0.5 * angle), zero, zero, np.sin(0.5 * angle)], axis=-1))


def recorded_turn(result: Result, body: str) -> Series:
    """Rotation matrices of a body since the start (n, 3, 3), in the plane or in space.

    Raises InputError if the run has not recorded its angles, or if in space it has turned so far to the side
    that they do not tell it.
    """
    scenario, why = result.scenario, "an inclinometer needs it"
    space = scenario.dimensions == 3
    start = (scenario.space if space else scenario.linkage).bodies[body].angle
    angle = result.recorded(f"{body}.angle", why) - start
    if not space:
        return about_z(angle)
    wanted = np.stack([*(result.recorded(f"{body}.{one}", why) for one in ("roll", "yaw")), angle], axis=-1)
    found = turn_of(wanted)
    if found is None:
        raise InputError(
            f"{body}: it cannot be told from roll, yaw and angle how it has turned; allowed: bodies that turn "
            "less to the side"
        )
    return found


def turn_of(wanted: Series) -> Series | None:
    """Rotation matrices (n, 3, 3) that have these angles: roll, yaw, angle (n, 3) [rad]; None: not found."""
    turn = about_z(wanted[:, 2])
    for _ in range(MOST_CORRECTIONS):
        missing = np.remainder(wanted - _angles(turn) + np.pi, 2.0 * np.pi) - np.pi
        if np.abs(missing).max() < PRECISE:
            return turn
        try:
            by = np.linalg.solve(_rates(turn), missing[..., None])[..., 0]
        except np.linalg.LinAlgError:
            return None
        turn = _rotated(np.asarray(by, dtype=np.float64)) @ turn
    return turn if np.abs(missing).max() < 1e3 * PRECISE else None


def _angles(turn: Series) -> Series:
    return np.stack([np.arctan2(turn[:, i, k], turn[:, j, k]) for i, j, k in ANGLES], axis=-1)


def _rates(turn: Series) -> Series:
    """Derivatives of the angles by small turns about the ground's axes (n, 3, 3)."""
    found = np.empty_like(turn)
    for n, (i, j, k) in enumerate(ANGLES):
        column = turn[:, :, k]
        # by a small turn w the column changes by w x column: rows i and j of that, for w along each axis
        change = np.cross(np.eye(3)[None, :, :], column[:, None, :])
        size = column[:, i] ** 2 + column[:, j] ** 2
        found[:, n] = (column[:, j, None] * change[..., i] - column[:, i, None] * change[..., j]) / size[
            :, None
        ]
    return found


def _rotated(by: Series) -> Series:
    """Rotation matrices (n, 3, 3) of rotation vectors (n, 3) [rad]."""
    size = np.linalg.norm(by, axis=-1, keepdims=True)
    return rotation(np.concatenate([np.cos(0.5 * size), 0.5 * by * np.sinc(0.5 * size / np.pi)], axis=-1))
