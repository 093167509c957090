"""On which side of zero the gaps of legs are at the start of a run, see `records`."""

import math

from support_exudyn.scene.compilation import compiled, entry
from support_exudyn.scene.hydraulics.records import HIGH_2, LOW, RELIEF, YIELD, Matrix, Records

MET_PRESSURE, MET_LENGTH = 0.01, 1e-13  # [Pa], [m] from zero at which a gap is met
ABSENT = math.nan  # a gap that a leg does not have


@compiled
def met(k: int) -> float:
    """How near to zero a gap is met."""
    return MET_LENGTH if k >= LOW and k <= HIGH_2 else MET_PRESSURE


@entry
def begin_sides(legs: Records, gaps: Matrix, sides: Matrix) -> None:
    """Write the side of zero on which each gap is, 0 for those that a leg does not have.

    A gap that is met just at the start is on the side on which nothing happens yet: valves closed, chambers
    filled, stops free. So what happens from there on is told. A valve with hysteresis is as it remembers.

    Arguments:
        legs: records. gaps: of all legs as they are evaluated at the start, shape (legs, GAPS).
        sides: of the same shape, is filled: 1, -1 or 0.
    """
    for n in range(gaps.shape[0]):
        for k in range(gaps.shape[1]):
            gap = gaps[n, k]
            side = 1.0 if gap > 0.0 else -1.0
            if math.isnan(gap):
                side = 0.0
            elif k == YIELD and legs[n].jumps != 0:
                side = 1.0 if legs[n].open != 0.0 else -1.0
            elif k == RELIEF and legs[n].rod_jumps != 0:
                side = 1.0 if legs[n].rod_open != 0.0 else -1.0
            elif abs(gap) <= met(k):
                side = 1.0 if k < YIELD else -1.0
            sides[n, k] = side
