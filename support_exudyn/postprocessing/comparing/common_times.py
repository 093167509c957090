"""Two curves at different times are laid on each other.

The times are those of the coarser curve inside the overlap; the finer one is interpolated there by straight
lines, and what that may add is estimated. At a time that both have, both values are taken as they are.
"""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.postprocessing.figures.selection import CLEARANCE
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
SAME = 1e-3  # share of the shortest time between two records by which equal times may differ, at most


class CommonCurves(NamedTuple):
    """Two curves at the same times.

    time: [s], (n,). reference, other: their values, (n,).
    interpolation_error: by how much interpolation may have changed their difference, (n,), >= 0, in the unit of
        the curves; 0 at times that both have.
    interpolated: at how many of the times one was interpolated.
    """

    time: Values
    reference: Values
    other: Values
    interpolation_error: Values
    interpolated: int


def on_common_times(
    reference_time: Values,
    reference: Values,
    other_time: Values,
    other: Values,
    after: float = -math.inf,
    until: float = math.inf,
) -> CommonCurves:
    """Two curves at the times of the coarser one of them, between two times [s].

    The coarser one has the fewer times there; of equally many the reference.

    Arguments:
        reference_time, other_time: [s], (n,) and (m,), increasing.
        reference, other: values of one unit, (n,) and (m,); NaN where one is not known.
        after, until: [s].

    Raises InputError if no time of the coarser one lies there.
    """
    both = bool(reference_time.size and other_time.size)
    start = max(reference_time[0], other_time[0], after) if both else math.inf
    end = min(reference_time[-1], other_time[-1], until) if both else -math.inf
    mine, its = (
        (time >= start - CLEARANCE) & (time <= end + CLEARANCE) for time in (reference_time, other_time)
    )
    if not (mine.any() or its.any()):
        between = "" if math.isinf(after) and math.isinf(until) else f" between {after:g} and {until:g} s"
        raise InputError(
            f"times {_said(reference_time)} and {_said(other_time)}: none lies{between} where both curves are; "
            "allowed: curves that overlap there"
        )
    if its.any() and (not mine.any() or its.sum() < mine.sum()):
        at, values = other_time[its], other[its]
        found, error, count = interpolated(reference_time, reference, at)
        return CommonCurves(at, found, values, error, count)
    at, values = reference_time[mine], reference[mine]
    found, error, count = interpolated(other_time, other, at)
    return CommonCurves(at, values, found, error, count)


def interpolated(time: Values, values: Values, at: Values) -> tuple[Values, Values, int]:
    """A curve at other times, by straight lines between its own.

    Between two times a and b the line differs from the curve f by (t - a) (b - t) f''/2 at most. As f''/2 the
    larger one of both divided second differences at a and b is taken. Where the curve has a kink or a jump,
    these are of the size of the step itself, so the estimate is, too.

    Arguments:
        time: of the curve [s], (n,), increasing. values: (n,).
        at: times [s], (m,), inside those of the curve.

    Returns:
        The values (m,), by how much they may be wrong (m,), and how many are not a record's own. Values next to
        one that is not known are not known, and so are their errors.
    """
    same = min(CLEARANCE, SAME * float(np.diff(time).min(initial=math.inf)))
    right = np.clip(np.searchsorted(time, at), 1, max(time.size - 1, 1)) if time.size > 1 else None
    if right is None:
        return np.repeat(values, at.size), np.zeros(at.size), 0
    left = right - 1
    nearest = np.where(at - time[left] <= time[right] - at, left, right)
    own = np.abs(time[nearest] - at) <= np.maximum(same, 4.0 * np.spacing(np.abs(at)))
    span = time[right] - time[left]
    share = np.clip((at - time[left]) / span, 0.0, 1.0)
    found = np.where(own, values[nearest], (1.0 - share) * values[left] + share * values[right])
    bent = _bent(time, values)
    error = share * (1.0 - share) * span**2 * np.fmax(bent[left], bent[right])
    error = np.where(np.isfinite(found), error, math.nan)
    return found, np.where(own, 0.0, error), int(np.count_nonzero(~own))


def _bent(time: Values, values: Values) -> Values:
    """Magnitudes of half the second derivative, (n,), by divided differences; at ends as beside them."""
    if time.size < 3:
        return np.zeros(time.size)
    slopes = np.diff(values) / np.diff(time)
    inside = np.abs(np.diff(slopes) / (time[2:] - time[:-2]))
    found: Values = np.concatenate((inside[:1], inside, inside[-1:]))
    return found


def _said(time: Values) -> str:
    return f"from {time[0]:g} to {time[-1]:g} s" if time.size else "(none)"
