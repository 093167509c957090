"""By how much a curve lags behind another, by cross-correlation. It is told; nothing is shifted unasked."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy import ndimage, optimize, signal
from scipy.interpolate import CubicSpline

from support_exudyn.postprocessing.comparing.bootstrap import long_run_variance
from support_exudyn.postprocessing.comparing.correlation import lagged_correlations
from support_exudyn.postprocessing.comparing.even_times import EvenSamples, even_samples
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
LEAST_OVERLAP = 0.5  # of the shorter curve
ALIKE = 0.5  # correlation from which on curves are taken to be alike
APART = 0.05  # of correlation: by how much another shift is worse, and what lies between both
FEWEST = 8  # samples of the overlap
FINEST = 1e-9  # of a spacing, to which the best shift is found
ROUGH = 0.1
WINDOW, MOST_SMOOTHED = 4.0, 0.1  # half width of a window in widths; of the overlap, at most


class TimeShift(NamedTuple):
    """The time by which another curve lags behind a reference, and how sure it is.

    shift: [s]; the other curve at t + shift is like the reference at t. Its times less the shift lay it on the
        reference.
    error: standard error of the shift [s], see `time_shift`.
    correlation: of both curves at this shift, -1 to 1.
    next_best: the largest correlation at another shift that is a peak of its own; NaN if there is none.
    at_limit: whether the best shift is the largest that was looked at, so that a better one may lie beyond.
    """

    shift: float
    error: float
    correlation: float
    next_best: float
    at_limit: bool

    @property
    def is_sure(self) -> bool:
        """Whether the curves are alike at this shift, and clearly less so at any other that is a peak.

        The correlation is at least `ALIKE`, and the next best one less by at least `APART`. Of curves that
        repeat themselves no shift is sure.
        """
        alone = not self.next_best > self.correlation - APART
        return not self.at_limit and self.correlation >= ALIKE and alone


def time_shift(
    reference_time: Values, reference: Values, other_time: Values, other: Values, most: float = math.inf
) -> TimeShift:
    """The shift at which two curves correlate best (Pearson), whatever the factor and offset between them.

    Both are sampled at the shorter spacing. All lags are looked at by which both overlap for half of the
    shorter one. Between two lags the best shift is found on a cubic spline through the other curve. Noise of
    both is smoothed away: both are averaged by windows of Gauss of the same width, none, 1, 2, 4, ... samples;
    the first one counts at which slopes are more of the curves than of noise: g |sum r c''| < `ROUGH` sum q^2.

    The standard error is that of least squares: r = f(t) - g c(t + s) - h is what is left of the reference f,
    and q = g c'(t + s) less its regression on 1 and c, how much it changes with the shift s. Of n samples

        error = sqrt(n L) / sum q^2,  L = long-run variance of r (before smoothing) times q (smoothed again)

    so what is left may be correlated in time. It is infinite if no width counts.

    Arguments:
        reference_time, other_time: [s], (n,) and (m,), increasing. reference, other: values; their units may
            differ, for only the shape counts. NaN where not known.
        most: largest shift that is looked at, either way [s].

    Raises InputError if a curve is constant or has too few values, or if no shift is small enough.
    """
    pairs = ((reference_time, reference), (other_time, other))
    finest = min(even_samples(time, one).spacing for time, one in pairs)
    mine = even_samples(reference_time, reference, finest)
    its = even_samples(other_time, other, finest)
    for name, one in (("reference", mine), ("other curve", its)):
        if one.values.size < FEWEST or one.values.max() == one.values.min():
            raise InputError(
                f"the {name} has {one.values.size} values from {one.values.min():g} to {one.values.max():g}; "
                f"allowed for a shift in time: at least {FEWEST} that are not all equal"
            )
    lags, found = _correlations(mine, its, most)
    best = int(np.nanargmax(found))
    heights = np.where(np.isfinite(found), found, -1.0)
    peaks, _ = signal.find_peaks(heights, prominence=APART)
    others = heights[peaks[peaks != best]]
    lag, height, error = _refined(mine, its, int(lags[best]))
    return TimeShift(
        shift=its.start - mine.start + lag * finest,
        error=error * finest,
        correlation=height,
        next_best=float(others.max()) if others.size else math.nan,
        at_limit=best in (0, lags.size - 1),
    )


def _correlations(mine: EvenSamples, its: EvenSamples, most: float) -> tuple[npt.NDArray[np.int64], Values]:
    """Lags in samples, and correlations at them."""
    least = max(FEWEST, math.ceil(LEAST_OVERLAP * min(mine.values.size, its.values.size)))
    lags = np.arange(least - mine.values.size, its.values.size - least + 1, dtype=np.int64)
    shifts = its.start - mine.start + lags * mine.spacing
    lags = lags[np.abs(shifts) <= most + 0.5 * mine.spacing]
    found = lagged_correlations(mine.values, its.values, lags) if lags.size else np.empty(0)
    if not np.isfinite(found).any():
        raise InputError(
            f"most = {most:g} s: at no shift so small do both curves overlap for half of the shorter one and "
            f"vary there; allowed: from {np.abs(shifts).min():g} s on"
        )
    return lags, found


def _refined(mine: EvenSamples, its: EvenSamples, lag: int) -> tuple[float, float, float]:
    """The best lag around a whole one, the correlation there, and the lag's standard error, in samples."""
    width, overlap = 0.0, min(mine.values.size, its.values.size - lag) - max(0, -lag)
    while True:
        best, error = _of_width(mine.values, its.values, lag, width)
        width = 2.0 * width or 1.0
        if math.isfinite(error) or WINDOW * width > MOST_SMOOTHED * overlap:
            return best, _correlation(mine.values, its.values, best), error


def _of_width(first: Values, second: Values, lag: int, width: float) -> tuple[float, float]:
    """The best lag and its standard error, if both curves are smoothed over a width, in samples."""
    one, other = _smoothed(first, width), _smoothed(second, width)
    # where windows reach over no end, and the spline as far as shifts are tried
    rim = math.ceil(WINDOW * width)
    reach = max(1.0, width)
    start, end = (
        max(rim, rim - lag) + math.ceil(reach),
        min(one.size, other.size - lag) - rim - math.ceil(reach),
    )
    at, fixed = np.arange(start, end), one[start:end]
    spline = CubicSpline(np.arange(other.size), other)

    def distance(by: float) -> float:
        return float(((_standard(fixed) - _standard(spline(at + by))) ** 2).sum())  # 2 (1 - correlation)

    bounds = (lag - reach, lag + reach)
    by = float(optimize.minimize_scalar(distance, bounds=bounds, method="bounded", options={"xatol": FINEST}).x)
    basis = np.column_stack((np.ones(at.size), spline(at + by)))
    gain = np.linalg.lstsq(basis, fixed)[0]
    turned = gain[1] * spline(at + by, 1)
    turned -= basis @ np.linalg.lstsq(basis, turned)[0]
    strength = float((turned**2).sum())
    rough = abs(gain[1] * float((fixed - basis @ gain) @ spline(at + by, 2)))
    if rough > ROUGH * strength or not strength > 0.0:
        return by, math.inf
    moved = np.column_stack((np.ones(at.size), CubicSpline(np.arange(second.size), second)(at + by)))
    left = first[start:end] - moved @ gain
    score = _smoothed(turned, width) * left
    return by, math.sqrt(at.size * long_run_variance(score)) / strength


def _smoothed(values: Values, width: float) -> Values:
    found: Values = ndimage.gaussian_filter1d(values, width, truncate=WINDOW) if width else values
    return found


def _correlation(first: Values, second: Values, lag: float) -> float:
    """Of two curves, the second one interpolated by its cubic spline."""
    at = np.arange(max(0, math.ceil(-lag)), min(first.size, math.floor(second.size - 1 - lag) + 1))
    moved = CubicSpline(np.arange(second.size), second)(at + lag)
    return 1.0 - 0.5 * float(((_standard(first[at]) - _standard(moved)) ** 2).sum())


def _standard(values: Values) -> Values:
    """About the mean, of length 1; zero if all are equal."""
    centred = values - values.mean()
    length = float(np.linalg.norm(centred))
    found: Values = centred / length if length > 0.0 else centred
    return found
