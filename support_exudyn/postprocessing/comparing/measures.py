"""How far a curve is from a reference at common times, by the measures that engineers use.

Integrals over time are sums by the trapezoid rule, so times may be unequally spaced. An interval counts if both
curves are known at both of its ends. What has no value, such as a share of a range that is zero, is NaN, and a
sentence says why; there are no warnings.
"""

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
NOTHING = "at no time are both curves known"
TOO_FEW = "both curves are known at no two times next to each other"
CONSTANT = "the reference is constant"
ZERO, OTHER_ZERO = "the reference is zero throughout", "the other curve is zero throughout"


class CurvePeak(NamedTuple):
    """The value of a curve that is largest in magnitude, with its sign, and the first time [s] that has it."""

    value: float
    time: float


class CurveMeasures(NamedTuple):
    """Measures of another curve c against a reference r at common times; d = c - r; <f> = 1/T integral f dt.

    All are in the unit U of the curves if nothing else is said. A duration T is the sum of all intervals at
    whose ends both are known.

    largest: d where its magnitude is largest, with its sign. largest_time: the first time of that [s].
    rms: sqrt(<d^2>).
    largest_of_range, rms_of_range: magnitude of `largest`, and `rms`, over max r - min r.
    mean_reference, mean_other, mean_difference: <r>, <c>, <d>.
    spread_reference, spread_other, spread_difference: sqrt(<(f - <f>)^2>), f one of r, c, d: standard
        deviations over time.
    peak_reference, peak_other: see CurvePeak.
    r_squared: 1 - <d^2> / <(r - <r>)^2>: the coefficient of determination; 1 if c is r, below 0 if c is farther
        from r than the constant <r> is. It is not the square of a correlation, which would not see a factor.
    magnitude_error: M = sqrt(<c^2> / <r^2>) - 1, of Sprague and Geers: 0.1 if c is 10 % larger.
    phase_error: P = 1/pi arccos(<r c> / sqrt(<r^2> <c^2>)): 0 if c is a multiple of r, 1 if a negative one; a
        sine that lags by a share x of its half period has P = x.
    combined_error: C = sqrt(M^2 + P^2).
    times: at which both are known. left_out: at which one is not.
    not_told: why a measure is NaN, by its name.

    Sources: M. A. Sprague and T. L. Geers, "A spectral-element method for modelling cavitation in transient
    fluid-structure interaction", Int. J. Numer. Meth. Engng 60 (2004) 2467-2499; L. E. Schwer, "Validation
    metrics for response histories: perspectives and case studies", Eng. with Computers 23 (2007) 295-309.
    """

    largest: float
    largest_time: float
    rms: float
    largest_of_range: float
    rms_of_range: float
    mean_reference: float
    mean_other: float
    mean_difference: float
    spread_reference: float
    spread_other: float
    spread_difference: float
    peak_reference: CurvePeak
    peak_other: CurvePeak
    r_squared: float
    magnitude_error: float
    phase_error: float
    combined_error: float
    times: int
    left_out: int
    not_told: Mapping[str, str] = MappingProxyType({})


def curve_measures(time: Values, reference: Values, other: Values) -> CurveMeasures:
    """All measures of a curve against a reference.

    Arguments:
        time: [s], (n,), increasing.
        reference, other: of one unit, (n,); what is no finite number is not known there.

    Raises InputError if the lengths differ, or if the times do not increase.
    """
    time, reference, other = (np.asarray(one, dtype=np.float64) for one in (time, reference, other))
    _check(time, reference, other)
    known = np.isfinite(reference) & np.isfinite(other)
    whole = weights(time, known)[known]
    t, r, c = time[known], reference[known], other[known]
    if not t.size:
        return _nothing(time.size)
    bits = _bits(np.concatenate((r, c)))  # differences of numbers of 1e308 are none
    d = np.ldexp(c, -bits) - np.ldexp(r, -bits)
    worst = int(np.abs(d).argmax())
    extent = _scaled(float(np.ldexp(r, -bits).max() - np.ldexp(r, -bits).min()), bits)
    largest, rms = _scaled(float(d[worst]), bits), _scaled(root_mean_square(whole, d), bits)
    size, other_size = root_mean_square(whole, r), root_mean_square(whole, c)
    spread = deviation(whole, r)
    magnitude = _ratio(other_size, size) - 1.0
    phase = _phase(whole, r, c)
    found = CurveMeasures(
        largest=largest,
        largest_time=float(t[worst]),
        rms=rms,
        largest_of_range=_ratio(abs(largest), extent),
        rms_of_range=_ratio(rms, extent),
        mean_reference=mean(whole, r),
        mean_other=mean(whole, c),
        mean_difference=_scaled(mean(whole, d), bits),
        spread_reference=spread,
        spread_other=deviation(whole, c),
        spread_difference=_scaled(deviation(whole, d), bits),
        peak_reference=_peak(t, r),
        peak_other=_peak(t, c),
        r_squared=1.0 - _ratio(rms, spread) ** 2 if extent > 0.0 else math.nan,
        magnitude_error=magnitude,
        phase_error=phase,
        combined_error=math.hypot(magnitude, phase) if math.isfinite(phase) else math.nan,
        times=int(t.size),
        left_out=int(time.size - t.size),
    )
    return found._replace(not_told=_reasons(found, extent))


# --- integrals over time ---


def weights(time: Values, known: npt.NDArray[np.bool_]) -> Values:
    """By what each time counts in an integral [s], (n,): half of the intervals beside it that are known.

    time: [s], (n,), increasing. known: whether a curve is, (n,).
    """
    intervals = np.where(known[1:] & known[:-1], np.diff(time), 0.0)
    found = np.zeros(time.size)
    found[1:] += 0.5 * intervals
    found[:-1] += 0.5 * intervals
    return found


def mean(whole: Values, values: Values) -> float:
    """<f>, by weights [s] and values f, (n,) each; NaN if no interval counts."""
    duration = float(whole.sum())
    if not duration > 0.0:
        return math.nan
    bits = _bits(values)
    return _scaled(float(whole / duration @ np.ldexp(values, -bits)), bits)


def root_mean_square(whole: Values, values: Values) -> float:
    """sqrt(<f^2>), as `mean`; squares that would be too large or too small for a number do no harm."""
    bits = _bits(values)
    square = mean(whole, np.ldexp(values, -bits) ** 2)
    return _scaled(math.sqrt(square), bits)


def deviation(whole: Values, values: Values) -> float:
    """sqrt(<(f - <f>)^2>), as `mean`; 0 of equal values, without rounding."""
    duration = float(whole.sum())
    if not duration > 0.0:
        return math.nan
    counted = values[whole > 0.0]
    if counted.max() == counted.min():
        return 0.0
    bits = _bits(values)
    scaled = np.ldexp(values, -bits)
    return _scaled(root_mean_square(whole, scaled - mean(whole, scaled)), bits)


def _phase(whole: Values, reference: Values, other: Values) -> float:
    """P: the angle between two curves by its half, which small angles keep their digits by (Kahan)."""
    pair = []
    for values in (reference, other):
        bits = _bits(values)
        scaled = np.ldexp(values, -bits)
        size = root_mean_square(whole, scaled)
        if not size > 0.0:
            return math.nan
        pair.append(scaled / size)
    apart, together = (root_mean_square(whole, pair[0] + sign * pair[1]) for sign in (-1.0, 1.0))
    return 2.0 / math.pi * math.atan2(apart, together)


# --- what is not told ---


def _reasons(found: CurveMeasures, extent: float) -> Mapping[str, str]:
    """Why measures of a curve with at least one known time are NaN."""

    def reason(name: str) -> str:
        if math.isnan(found.rms) and name != "largest_of_range":
            return TOO_FEW
        if extent == 0.0 and name in ("largest_of_range", "rms_of_range", "r_squared"):
            return CONSTANT
        return ZERO if found.peak_reference.value == 0.0 else OTHER_ZERO

    numbers = {name: item for name, item in found._asdict().items() if isinstance(item, float)}
    return {name: reason(name) for name, number in numbers.items() if math.isnan(number)}


def _nothing(times: int) -> CurveMeasures:
    names = CurveMeasures._fields[: CurveMeasures._fields.index("times")]
    no_peak = CurvePeak(math.nan, math.nan)
    values: dict[str, Any] = {name: no_peak if name.startswith("peak") else math.nan for name in names}
    return CurveMeasures(**values, times=0, left_out=times, not_told=dict.fromkeys(names, NOTHING))


def _peak(time: Values, values: Values) -> CurvePeak:
    where = int(np.abs(values).argmax())
    return CurvePeak(float(values[where]), float(time[where]))


def _ratio(one: float, other: float) -> float:
    return one / other if other > 0.0 else math.nan


def _bits(values: Values) -> int:
    """By how many bits the largest value is larger than one, at most; a scale that changes no digit."""
    return math.frexp(float(np.abs(values).max(initial=0.0)))[1] + 1


def _scaled(value: float, bits: int) -> float:
    return float(np.ldexp(value, bits)) if math.isfinite(value) else value


def _check(time: Values, *curves: Values) -> None:
    lengths = [one.shape for one in (time, *curves)]
    if time.ndim != 1 or len(set(lengths)) != 1:
        raise InputError(f"times and curves are of shapes {lengths}; allowed: one value for each time")
    if not (np.isfinite(time).all() and (np.diff(time) > 0.0).all()):
        raise InputError("the times do not increase; allowed: finite times [s], each later than the one before")
