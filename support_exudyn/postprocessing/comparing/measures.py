"""Two curves: joined in time, measures of their distance, statistics after the horizon, the lag of one of them.

Integrals over time are sums by the trapezoid rule, so times may be unequally spaced. An interval counts if both
curves are known at both of its ends. A measure without a value, such as a share of no range, is NaN.
`measures.md` has all formulas and sources.
"""

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy import optimize, signal, stats
from scipy.interpolate import CubicSpline

from support_exudyn.postprocessing.figures.selection import CLEARANCE, nearest
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
SAME = 1e-3  # share of the shortest time between two records by which equal times may differ, at most
BLOCKS = 10
FEWEST = 5  # samples of a block
CONFIDENCE = 0.95  # of all intervals of two files together
EXACT = 1e-12  # of the largest value: rounding of a difference of curves that do not vary


class CommonCurves(NamedTuple):
    """Two curves at the same times.

    time: [s], (n,). reference, other: their values, (n,). interpolation_error: by how much interpolation may
    have changed their difference, (n,), >= 0, in the unit of the curves; 0 at times that both have.
    """

    time: Values
    reference: Values
    other: Values
    interpolation_error: Values

    @property
    def difference(self) -> Values:
        """The other curve less the reference, (n,)."""
        return self.other - self.reference


def on_common_times(
    reference_time: Values,
    reference: Values,
    other_time: Values,
    other: Values,
    after: float = -math.inf,
    until: float = math.inf,
) -> CommonCurves:
    """Two curves at the times of the coarser of them inside the overlap, between two times [s].

    The coarser curve has the fewer times there; of equally many the reference. The finer curve is interpolated
    by straight lines, and the error of that is estimated. At a time that both have, both values are taken.

    Arguments:
        reference_time, other_time: [s], (n,) and (m,), increasing.
        reference, other: values of one unit, (n,) and (m,); NaN where a value is not known.
        after, until: [s].

    Raises InputError if no time of the coarser curve lies there.
    """
    times = reference_time, other_time
    start = max([after, *(time[0] if time.size else math.inf for time in times)])
    end = min([until, *(time[-1] if time.size else -math.inf for time in times)])
    mine, its = ((time >= start - CLEARANCE) & (time <= end + CLEARANCE) for time in times)
    if not (mine.any() or its.any()):
        spans = [f"from {time[0]:g} to {time[-1]:g} s" if time.size else "(none)" for time in times]
        raise InputError(
            f"times {spans[0]} and {spans[1]}: none lies where both curves are, between {after:g} and "
            f"{until:g} s; allowed: curves that overlap there"
        )
    if its.any() and (not mine.any() or its.sum() < mine.sum()):
        values, error = interpolated(reference_time, reference, other_time[its])
        return CommonCurves(other_time[its], values, other[its], error)
    values, error = interpolated(other_time, other, reference_time[mine])
    return CommonCurves(reference_time[mine], reference[mine], values, error)


def interpolated(time: Values, values: Values, at: Values) -> tuple[Values, Values]:
    """A curve at other times [s] `at` (m,), inside its own, by straight lines: values and their errors (m,).

    Between two times a and b the line differs from the curve f by (t - a) (b - t) f''/2 at most. As f''/2 the
    larger of the divided second differences at a and b is taken, which have the size of a kink or a jump. The
    error is 0 at a record of the curve. Next to an unknown value neither value nor error is known.
    """
    if time.size < 2:
        return np.repeat(values, at.size), np.zeros(at.size)
    same = min(CLEARANCE, SAME * float(np.diff(time).min()))
    right = np.clip(np.searchsorted(time, at), 1, time.size - 1)
    left, record = right - 1, nearest(time, at)
    own = np.abs(time[record] - at) <= np.maximum(same, 4.0 * np.spacing(np.abs(at)))
    result = np.where(own, values[record], np.interp(at, time, values))
    bent = np.zeros(time.size)
    if time.size > 2:
        inside = np.abs(np.diff(np.diff(values) / np.diff(time)) / (time[2:] - time[:-2]))
        bent = np.pad(inside, 1, mode="edge")
    error = np.maximum((at - time[left]) * (time[right] - at), 0.0) * np.fmax(bent[left], bent[right])
    return result, np.where(own, 0.0, np.where(np.isfinite(result), error, math.nan))


# --- measures ---


class CurveMeasures(NamedTuple):
    """Measures of another curve c against a reference r at common times; d = c - r; <f> = 1/T integral f dt.

    largest: d where its magnitude is largest, with its sign. largest_time: the first time of that [s].
    rms: sqrt(<d^2>). rms_of_range: the same over max r - min r.
    mean_reference, mean_other, mean_difference: <r>, <c>, <d>.
    r_squared: 1 - <d^2> / <(r - <r>)^2>, the coefficient of determination.
    magnitude_error, phase_error, combined_error: M, P and C of Sprague and Geers, see `measures.md`.
    times: number of times at which both are known.
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
    shapes = [np.shape(curve) for curve in (time, reference, other)]
    if len(shapes[0]) != 1 or len(set(shapes)) != 1:
        raise InputError(f"times and curves are of shapes {shapes}; allowed: one value for each time")
    if not (np.isfinite(time).all() and (np.diff(time) > 0.0).all()):
        raise InputError("the times do not increase; allowed: finite times [s], each later than the one before")
    known = np.isfinite(reference) & np.isfinite(other)
    t, r, c = (np.asarray(curve, dtype=np.float64)[known] for curve in (time, reference, other))
    if not t.size:
        return CurveMeasures()
    intervals = np.where(known[1:] & known[:-1], np.diff(time), 0.0)
    weights = 0.5 * (np.append(intervals, 0.0) + np.append(0.0, intervals))[known]

    def mean(values: Values) -> float:
        return _ratio(float(weights @ values), float(weights.sum()))

    def rms(values: Values) -> float:
        return math.sqrt(mean(values**2))

    d = c - r
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


def _ratio(part: float, whole: float) -> float:
    return part / whole if whole > 0.0 else math.nan


# --- statistics ---

STATISTICS: Mapping[str, Callable[[Values], Values]] = {  # of the rows of (2, n)
    "mean": lambda values: np.asarray(values.mean(axis=1)),
    "rms": lambda values: np.asarray(np.sqrt(np.mean(values**2, axis=1))),
}


class StatisticDifference(NamedTuple):
    """A statistic of two curves: of each, second less first, and half of the confidence interval of that.

    half: the smallest difference that would have shown; NaN if the curves are too short.
    """

    first: float
    second: float
    difference: float
    half: float

    @property
    def equal(self) -> bool | None:
        """Whether the interval of the difference contains 0; None if there is no interval."""
        return None if math.isnan(self.half) else abs(self.difference) <= self.half


def compared_statistics(first: Values, second: Values, among: int = 1) -> dict[str, StatisticDifference]:
    """The mean and the root mean square of two curves, by name; none if fewer than two values are known.

    Both are cut into the same `BLOCKS` blocks, so that a course that both follow, such as a stroke, drops out.
    Student's t gives the interval of the mean of the blocks' differences (batch means: Alexopoulos and Seila
    1998). Neighbouring samples may be correlated as long as blocks are longer than the correlation lasts.

    Arguments:
        first, second: values of one unit at the same, evenly spaced times, (n,); NaN where one is not known.
        among: number of differences that are reported together. Of twenty intervals of 95 % one misses the
            truth on average, so each has the confidence 0.95^(1/among) (Sidak).
    """
    known = np.isfinite(first) & np.isfinite(second)
    both = np.stack([first[known], second[known]])
    if both.shape[1] < 2:
        return {}
    quantile = float(stats.t.ppf(0.5 + 0.5 * CONFIDENCE ** (1.0 / among), BLOCKS - 1))
    result = {}
    for name, statistic in STATISTICS.items():
        mine, its = map(float, statistic(both))
        half = math.nan
        if both.shape[1] >= FEWEST * BLOCKS:
            blocks = np.stack([statistic(block) for block in np.array_split(both, BLOCKS, axis=1)])
            half = quantile * float(stats.sem(np.diff(blocks)[:, 0])) + EXACT * float(np.abs(both).max())
        result[name] = StatisticDifference(mine, its, its - mine, half)
    return result


# --- the lag; it is reported, and nothing is shifted unasked ---

LEAST_OVERLAP = 0.5  # of the shorter curve
ALIKE = 0.5  # correlation from which on curves are taken to be alike
APART = 0.05  # of correlation: by how much another shift is worse, and the valley between both
FEWEST_JOINT = 8  # samples of the overlap
MOST_SAMPLES = 2**22
FLAT = 1e-12  # share of the largest variance of a piece, below which a piece is taken to be constant


class TimeShift(NamedTuple):
    """The time by which another curve lags behind a reference, and how sure it is.

    shift: [s]; the other curve at t + shift is like the reference at t.
    correlation: of both curves at this shift, -1 to 1.
    next_best: the largest correlation at another shift that is a peak of its own; NaN if there is none.
    channel: by which it was determined; empty if the curves have no name.
    """

    shift: float
    correlation: float
    next_best: float
    channel: str = ""

    @property
    def is_sure(self) -> bool:
        """Whether the correlation is at least `ALIKE`, and that of any other peak smaller by at least `APART`.

        Of curves that repeat themselves no shift is sure.
        """
        return self.correlation >= ALIKE and not self.next_best > self.correlation - APART


def time_shift(reference_time: Values, reference: Values, other_time: Values, other: Values) -> TimeShift:
    """The shift at which two curves correlate best (Pearson), whatever the factor and offset between them.

    Both are sampled at the shorter spacing. All lags are tried by which both overlap for half of the shorter
    curve. Between two lags the best shift is located on a cubic spline through the other curve.

    Arguments:
        reference_time, other_time: [s], (n,) and (m,), increasing. reference, other: values; their units may
            differ, for only the shape counts. NaN where a value is not known.

    Raises InputError if a curve is constant or has too few values, or is so at all shifts that are tried.
    """
    curves = ((reference_time, reference), (other_time, other))
    known = [(time[np.isfinite(values)], values[np.isfinite(values)]) for time, values in curves]
    if any(time.size < FEWEST_JOINT or np.ptp(values) == 0.0 for time, values in known):
        sizes = " and ".join(str(time.size) for time, _ in known)
        raise InputError(
            f"the curves have {sizes} known values; allowed for a shift in time: at least {FEWEST_JOINT} that "
            "are not all equal"
        )
    spacing = min(float(np.median(np.diff(time))) for time, _ in known)
    if max(np.ptp(time) for time, _ in known) > MOST_SAMPLES * spacing:
        raise InputError(
            f"more than {MOST_SAMPLES} samples of {spacing:g} s would be needed; allowed: a shorter piece"
        )
    counts = [int(np.ptp(time) / spacing * (1.0 + 1e-6) + 1e-6) + 1 for time, _ in known]
    mine, its = (
        np.interp(time[0] + spacing * np.arange(count), time, values)
        for count, (time, values) in zip(counts, known, strict=True)
    )
    lags, heights = _correlations(mine, its)
    best = int(heights.argmax())
    peaks, _ = signal.find_peaks(heights, prominence=APART)
    spline = CubicSpline(np.arange(its.size), its)

    def opposite(lag: float) -> float:
        at = np.arange(max(0, math.ceil(-lag)), min(mine.size, math.floor(its.size - 1 - lag) + 1))
        return 1.0 - float(np.corrcoef(mine[at], spline(at + lag))[0, 1])

    bounds = lags[best] - 1.0, lags[best] + 1.0
    between = optimize.minimize_scalar(opposite, bounds=bounds, method="bounded", options={"xatol": 1e-9})
    return TimeShift(
        shift=float(known[1][0][0] - known[0][0][0] + between.x * spacing),
        correlation=1.0 - float(between.fun),
        next_best=max(heights[peaks[peaks != best]].tolist(), default=math.nan),
    )


def _correlations(mine: Values, its: Values) -> tuple[npt.NDArray[np.intp], Values]:
    """The lags that are tried, in samples, and Pearson's correlation over the overlap at each of them.

    The correlation is -1 where a curve is constant in the overlap. Sums over the overlap at every lag are
    themselves cross-correlations, of the curves, their squares and ones.
    """
    least = max(FEWEST_JOINT, math.ceil(LEAST_OVERLAP * min(mine.size, its.size)))
    lags = signal.correlation_lags(its.size, mine.size)
    tried = (lags >= least - mine.size) & (lags <= its.size - least)

    def sums(own: Values, others: Values) -> Values:
        return np.asarray(signal.correlate(others, own, method="fft")[tried])

    first, second, ones, others = mine - mine.mean(), its - its.mean(), np.ones(mine.size), np.ones(its.size)
    count = np.round(sums(ones, others))
    mean, other_mean = sums(first, others) / count, sums(ones, second) / count
    variances = sums(first**2, others) / count - mean**2, sums(ones, second**2) / count - other_mean**2
    known = np.all([each > FLAT * each.max() for each in variances], axis=0)
    if not known.any():
        raise InputError("the curves do not vary together at any shift; allowed: curves that vary for longer")
    size = np.sqrt(np.where(known, variances[0] * variances[1], 1.0))
    product = sums(first, second) / count - mean * other_mean
    return lags[tried], np.where(known, np.clip(product / size, -1.0, 1.0), -1.0)
