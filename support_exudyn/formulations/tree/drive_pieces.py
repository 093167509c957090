"""The drives in pieces, on each of which all are cubics of time, so that every stage of a step knows them."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from support_exudyn.formulations.contract import Failure, SimulationError
from support_exudyn.formulations.tree.branches import Matrix
from support_exudyn.model.drives.drive import Drive
from user_forces.lawful import UNLAWFUL

LOOKED_AT = (0.13, 0.45, 0.55, 0.87)  # fractions of a piece at which the cubic is compared with the drive
SHORTEST = 1e-6  # [s]
ROUNDING = 1e-14  # [m]; a cubic of half a metre cannot be told from the drive within less
# coefficients of the cubic through the values at 0, 1/3, 2/3 and 1; the drive's speed may jump at the ends
THROUGH = np.array(
    [[1.0, 0.0, 0.0, 0.0], [-5.5, 9.0, -4.5, 1.0], [9.0, -22.5, 18.0, -4.5], [-4.5, 13.5, -13.5, 4.5]]
)


class Piece(NamedTuple):
    """A cubic of each of c drives.

    begin, end: [s]. cubic: see `loads`, shape (c, 5).
    """

    begin: float
    end: float
    cubic: Matrix


def pieces(drives: Sequence[Drive], duration: float, allowed: float) -> list[Piece]:
    """Drives from 0 to the end of a run [s], within an allowed error of extension [m] (and rounding)."""
    inner = sorted({t for drive in drives for t in drive.breaks if 0.0 < t < duration})
    found: list[Piece] = []
    for begin, end in zip([0.0, *inner], [*inner, duration], strict=True):
        found += _between(drives, begin, end, max(allowed, ROUNDING))
    return found


def _between(drives: Sequence[Drive], begin: float, end: float, allowed: float) -> list[Piece]:
    """Pieces between two breaks: one if all drives are cubics there, else halved until they nearly are."""
    length = end - begin
    cubics = [_cubic(drive, begin, length) for drive in drives]
    if length < SHORTEST or all(
        abs(extension(cubic, begin + x * length) - drive.extension(begin + x * length)) <= allowed
        for cubic, drive in zip(cubics, drives, strict=True)
        for x in LOOKED_AT
    ):
        return [Piece(begin, end, np.array(cubics).reshape(-1, 5))]
    middle = begin + 0.5 * length
    return _between(drives, begin, middle, allowed) + _between(drives, middle, end, allowed)


def _cubic(drive: Drive, begin: float, length: float) -> Matrix:
    """The cubic through a drive from a time on [s], shape (5,)."""
    values = np.array([drive.extension(begin + x * length) for x in (0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0)])
    if not np.isfinite(values).all():
        said = f"{type(drive).__name__} has an extension of {values[~np.isfinite(values)][0]:g}"
        raise SimulationError(Failure(said, UNLAWFUL, begin))
    return np.array([begin, *(THROUGH @ values / length ** np.arange(4))])


def extension(cubic: Matrix, t: float | Matrix) -> Matrix:
    """Extension [m] at t [s] by a cubic (5,), or by one for every time (..., 5)."""
    s = t - cubic[..., 0]
    return np.asarray(cubic[..., 1] + s * (cubic[..., 2] + s * (cubic[..., 3] + s * cubic[..., 4])))


def speed(cubic: Matrix, t: float | Matrix) -> Matrix:
    """The rate of the extension [m/s], see `extension`."""
    s = t - cubic[..., 0]
    return np.asarray(cubic[..., 2] + s * (2.0 * cubic[..., 3] + s * 3.0 * cubic[..., 4]))
