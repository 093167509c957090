"""Curves with errors, and two of them at common times.

Common times are those of the coarser curve inside the overlap. The finer curve is interpolated there by
straight lines, and the error of that is estimated. At a time that both have, both values are taken as they are.
"""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.postprocessing.figures.selection import CLEARANCE
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
SAME = 1e-3  # share of the shortest time between two records by which equal times may differ, at most


class ComparedColumn(NamedTuple):
    """A curve at times [s] (n,), with values and errors (n,); a number has no times and a single value.

    unit: of all but the times; None: not known. An error that is NaN is not known.
    """

    unit: str | None
    time: Values
    values: Values
    errors: Values


class CommonCurves(NamedTuple):
    """Two curves at the same times.

    time: [s], (n,). reference, other: their values, (n,).
    interpolation_error: by how much interpolation may have changed their difference, (n,), >= 0, in the unit of
        the curves; 0 at times that both have.
    interpolated: number of times at which one of them was interpolated.
    """

    time: Values
    reference: Values
    other: Values
    interpolation_error: Values
    interpolated: int

    def part(self, chosen: npt.NDArray[np.bool_]) -> tuple[Values, Values, Values]:
        """Times, reference and other at the chosen times, (n,) as a mask."""
        return self.time[chosen], self.reference[chosen], self.other[chosen]


def on_common_times(
    reference_time: Values,
    reference: Values,
    other_time: Values,
    other: Values,
    after: float = -math.inf,
    until: float = math.inf,
) -> CommonCurves:
    """Two curves at the times of the coarser of them, between two times [s].

    The coarser curve has the fewer times there; of equally many the reference.

    Arguments:
        reference_time, other_time: [s], (n,) and (m,), increasing.
        reference, other: values of one unit, (n,) and (m,); NaN where a value is not known.
        after, until: [s].

    Raises InputError if no time of the coarser curve lies there.
    """
    both = bool(reference_time.size and other_time.size)
    start = max(reference_time[0], other_time[0], after) if both else math.inf
    end = min(reference_time[-1], other_time[-1], until) if both else -math.inf
    mine, its = (
        (time >= start - CLEARANCE) & (time <= end + CLEARANCE) for time in (reference_time, other_time)
    )
    if not (mine.any() or its.any()):
        between = "" if math.isinf(after) and math.isinf(until) else f" between {after:g} and {until:g} s"
        spans = [f"from {t[0]:g} to {t[-1]:g} s" if t.size else "(none)" for t in (reference_time, other_time)]
        raise InputError(
            f"times {spans[0]} and {spans[1]}: none lies{between} where both curves are; "
            "allowed: curves that overlap there"
        )
    if its.any() and (not mine.any() or its.sum() < mine.sum()):
        values, error, count = interpolated(reference_time, reference, other_time[its])
        return CommonCurves(other_time[its], values, other[its], error, count)
    values, error, count = interpolated(other_time, other, reference_time[mine])
    return CommonCurves(reference_time[mine], reference[mine], values, error, count)


def interpolated(time: Values, values: Values, at: Values) -> tuple[Values, Values, int]:
    """A curve at other times, by straight lines between its own.

    Between two times a and b the line differs from the curve f by (t - a) (b - t) f''/2 at most. As f''/2 the
    larger of the divided second differences at a and b is taken. Where the curve has a kink or a jump,
    these are of the size of the step itself, so the estimate is, too.

    Arguments:
        time: of the curve [s], (n,), increasing. values: (n,).
        at: times [s], (m,), inside those of the curve.

    Returns:
        The values (m,), by how much they may be wrong (m,), and how many are not a record's own. Values next to
        an unknown value are not known, and so are their errors.
    """
    if time.size < 2:
        return np.repeat(values, at.size), np.zeros(at.size), 0
    same = min(CLEARANCE, SAME * float(np.diff(time).min()))
    right = np.clip(np.searchsorted(time, at), 1, time.size - 1)
    left = right - 1
    nearest = np.where(at - time[left] <= time[right] - at, left, right)
    own = np.abs(time[nearest] - at) <= np.maximum(same, 4.0 * np.spacing(np.abs(at)))
    span = time[right] - time[left]
    share = np.clip((at - time[left]) / span, 0.0, 1.0)
    result = np.where(own, values[nearest], (1.0 - share) * values[left] + share * values[right])
    bent = np.zeros(time.size)
    if time.size > 2:
        inside = np.abs(np.diff(np.diff(values) / np.diff(time)) / (time[2:] - time[:-2]))
        bent = np.pad(inside, 1, mode="edge")
    error = share * (1.0 - share) * span**2 * np.fmax(bent[left], bent[right])
    error = np.where(np.isfinite(result), error, math.nan)
    return result, np.where(own, 0.0, error), int(np.count_nonzero(~own))


def errors_at(at: Values, column: ComparedColumn) -> Values:
    """Errors of a curve at other times [s], (m,): those of the next record, as errors grow with time."""
    return column.errors[np.minimum(np.searchsorted(column.time, at - CLEARANCE), column.time.size - 1)]


def summed(first: Values, second: Values) -> Values:
    """The errors of a difference, (n,): the sum of both sides; an unknown error, NaN, is left out."""
    return np.where(np.isnan(first), second, np.where(np.isnan(second), first, first + second))


def extent(values: Values) -> float:
    """The largest less the least value; 0 if none is known."""
    known = values[np.isfinite(values)]
    return float(np.ptp(known)) if known.size else 0.0
