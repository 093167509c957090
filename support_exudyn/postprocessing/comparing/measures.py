"""Measures of the distance between a curve and a reference at common times.

Integrals over time are sums by the trapezoid rule, so times may be unequally spaced. An interval counts if
both curves are known at both of its ends. A measure without a value, such as a share of no range, is NaN.
"""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]


class CurveMeasures(NamedTuple):
    """Measures of another curve c against a reference r at common times; d = c - r; <f> = 1/T integral f dt.

    All are in the unit U of the curves if nothing else is stated. A duration T is the sum of all intervals at
    whose ends both are known.

    largest: d where its magnitude is largest, with its sign. largest_time: the first time of that [s].
    rms: sqrt(<d^2>).
    rms_of_range: `rms` over max r - min r.
    mean_reference, mean_other, mean_difference: <r>, <c>, <d>.
    r_squared: 1 - <d^2> / <(r - <r>)^2>: the coefficient of determination; 1 if c is r, below 0 if c is farther
        from r than the constant <r> is. It is not the square of a correlation, which would not see a factor.
    magnitude_error: M = sqrt(<c^2> / <r^2>) - 1, of Sprague and Geers: 0.1 if c is 10 % larger.
    phase_error: P = 1/pi arccos(<r c> / sqrt(<r^2> <c^2>)): 0 if c is a multiple of r, 1 if a negative one; a
        sine that lags by a share x of its half period has P = x.
    combined_error: C = sqrt(M^2 + P^2).
    times: number of times at which both are known.

    Sources: M. A. Sprague and T. L. Geers, "A spectral-element method for modelling cavitation in transient
    fluid-structure interaction", Int. J. Numer. Meth. Engng 60 (2004) 2467-2499; L. E. Schwer, "Validation
    metrics for response histories: perspectives and case studies", Eng. with Computers 23 (2007) 295-309.
    """

    largest: float = math.nan
    largest_time: float = math.nan
    rms: float = math.nan
    rms_of_range: float = math.nan
    mean_reference: float = math.nan
    mean_other: float = math.nan
    mean_difference: float = math.nan
    r_squared: float = math.nan
    magnitude_error: float = math.nan
    phase_error: float = math.nan
    combined_error: float = math.nan
    times: int = 0


def curve_measures(time: Values, reference: Values, other: Values) -> CurveMeasures:
    """All measures of a curve against a reference.

    Arguments:
        time: [s], (n,), increasing.
        reference, other: of one unit, (n,); a value that is no finite number is not known.

    Raises InputError if the lengths differ, or if the times do not increase.
    """
    _check(time, reference, other)
    known = np.isfinite(reference) & np.isfinite(other)
    t, r, c = (np.asarray(curve, dtype=np.float64)[known] for curve in (time, reference, other))
    if not t.size:
        return CurveMeasures()
    d, weights = c - r, _weights(np.asarray(time, dtype=np.float64), known)[known]

    def mean(values: Values) -> float:
        return _ratio(float(weights @ values), float(weights.sum()))

    def rms(values: Values) -> float:
        return math.sqrt(mean(values**2))

    worst, extent, size = int(np.abs(d).argmax()), float(np.ptp(r)), rms(r)
    spread = rms(r - mean(r)) if extent > 0.0 else 0.0
    magnitude, phase = _ratio(rms(c), size) - 1.0, math.nan
    if size > 0.0 and rms(c) > 0.0:  # the angle between both by its half, whose small values keep their digits
        phase = 2.0 / math.pi * math.atan2(rms(r / size - c / rms(c)), rms(r / size + c / rms(c)))
    return CurveMeasures(
        largest=float(d[worst]),
        largest_time=float(t[worst]),
        rms=rms(d),
        rms_of_range=_ratio(rms(d), extent),
        mean_reference=mean(r),
        mean_other=mean(c),
        mean_difference=mean(d),
        r_squared=1.0 - _ratio(rms(d), spread) ** 2,
        magnitude_error=magnitude,
        phase_error=phase,
        combined_error=math.hypot(magnitude, phase) if math.isfinite(phase) else math.nan,
        times=int(t.size),
    )


def _weights(time: Values, known: npt.NDArray[np.bool_]) -> Values:
    """Weights of the times in an integral [s], (n,): half of the neighbouring intervals with known ends."""
    intervals = np.where(known[1:] & known[:-1], np.diff(time), 0.0)
    return np.asarray(0.5 * (np.append(intervals, 0.0) + np.append(0.0, intervals)))


def _ratio(part: float, whole: float) -> float:
    return part / whole if whole > 0.0 else math.nan


def _check(time: Values, *curves: Values) -> None:
    lengths = [np.shape(curve) for curve in (time, *curves)]
    if len(lengths[0]) != 1 or len(set(lengths)) != 1:
        raise InputError(f"times and curves are of shapes {lengths}; allowed: one value for each time")
    if not (np.isfinite(time).all() and (np.diff(time) > 0.0).all()):
        raise InputError("the times do not increase; allowed: finite times [s], each later than the one before")
