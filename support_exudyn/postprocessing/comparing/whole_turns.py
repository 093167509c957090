"""Angles that differ by full turns are equal: wrapped ones are unwrapped, and turns apart are left out."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

Values = npt.NDArray[np.float64]
ANGLE, TURN = "rad", 2.0 * math.pi
ROUNDING = 1e-6  # of a turn, by which a file's digits may leave the range of a wrapped angle


def unwrapped(angle: Values) -> Values:
    """A continuous angle [rad] from one that a file has wrapped into a single turn; others stay as they are.

    An angle was wrapped if all values lie within one turn and neighbours are more than half a turn apart.
    """
    known = np.isfinite(angle)
    values = angle[known]
    jumps = np.abs(np.diff(values)).max(initial=0.0) > 0.5 * TURN
    if not jumps or np.ptp(values) > (1.0 + ROUNDING) * TURN:
        return angle
    found = angle.copy()
    found[known] = np.unwrap(values)
    return found


def turns_apart(reference: Values, other: Values) -> float:
    """The full turns [rad] by which another angle begins apart from a reference; 0 without overlap."""
    known = np.flatnonzero(np.isfinite(reference) & np.isfinite(other))
    return TURN * round((other[known[0]] - reference[known[0]]) / TURN) if known.size else 0.0
