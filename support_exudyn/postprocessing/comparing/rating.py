"""The objective rating of ISO/TS 18571: how well a curve follows a reference, from 0 to 1.

It is made for crash tests and rates four things: whether the curve lies in a corridor about the reference, its
shift in time, its magnitude when warped in time onto the reference, and its slope.

The text of the standard is not free. The formulas are those of the package objective-rating-metrics 1.3 of
TU Graz (MIT licence), and the numbers agree with its; they go back to S. Barbat, Y. Fu, Z. Zhan, R.-J. Yang and
C. Gehre, "Objective rating metric for dynamic systems", 23rd ESV conference, 2013. The package itself is not
used: it needs nine others, of which the one that warps in time has had no release since 2022 and compiles for
twenty seconds.
"""

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.postprocessing.comparing.correlation import lagged_correlations
from support_exudyn.postprocessing.comparing.even_times import even_samples

Values = npt.NDArray[np.float64]
SPACING = 1e-4  # [s]: the standard's sampling, 10 kHz
MOST = 20_000  # samples: warping takes two seconds, and four times that for twice as many
FEWEST = 10
INNER, OUTER, CORRIDOR_POWER = 0.05, 0.5, 2.0  # half widths of the corridors, of the largest magnitude
LARGEST_SHIFT = 0.2  # of the duration
WARPING = 0.1  # of the duration, by which times may be warped
LARGEST_MAGNITUDE_ERROR, LARGEST_SLOPE_ERROR = 0.5, 2.0  # from which on a score is 0
AVERAGED = 9  # samples that a slope is averaged over
WEIGHTS = (0.4, 0.2, 0.2, 0.2)  # of corridor, phase, magnitude, slope


class IsoRating(NamedTuple):
    """Scores from 0 (not alike) to 1 (alike).

    overall: 0.4 corridor + 0.2 phase + 0.2 magnitude + 0.2 slope. Of the standard: above 0.94 excellent, above
        0.8 good, above 0.58 fair, else poor.
    corridor: mean of 1 where |d| is within 5 % of max |r|, 0 beyond 50 %, the square of the linear way between.
    phase: 1 less the share of the best shift (largest correlation) in the largest one, 20 % of the duration.
    magnitude: 1 - e/0.5, at least 0; e = |c - r|_1 / |r|_1 after that shift and after warping in time.
    slope: 1 - e/2, at least 0; e as before, of slopes averaged over 9 samples, after that shift.
    not_told: why scores are NaN, by their names.
    """

    overall: float
    corridor: float
    phase: float
    magnitude: float
    slope: float
    not_told: Mapping[str, str] = MappingProxyType({})


def iso_rating(time: Values, reference: Values, other: Values) -> IsoRating:
    """The rating of a curve against a reference, both sampled at the 10 kHz of the standard by straight lines.

    Arguments:
        time: [s], (n,), increasing. reference, other: of one unit, (n,); NaN where not known.
    """
    known = np.isfinite(reference) & np.isfinite(other)
    duration = float(np.ptp(time[known])) if known.any() else 0.0
    if not FEWEST <= duration / SPACING <= MOST:
        return _not_told(
            f"it is of curves of {FEWEST * SPACING:g} to {MOST * SPACING:g} s; they have {duration:g}"
        )
    r, c = (even_samples(time[known], one[known], SPACING).values for one in (reference, other))
    if r.max() == r.min() or c.max() == c.min():
        return _not_told("a curve is constant")
    corridor = _corridor(r, c)
    lag = _best_lag(r, c)
    phase = 1.0 - abs(lag) / (LARGEST_SHIFT * r.size)
    shifted_r, shifted_c = r[max(0, -lag) : r.size - max(0, lag)], c[max(0, lag) : c.size - max(0, -lag)]
    warped_c, warped_r = warped(shifted_c, shifted_r, math.ceil(WARPING * shifted_c.size) - 1)
    magnitude = _score(_relative(warped_r, warped_c), LARGEST_MAGNITUDE_ERROR)
    slope = _score(_relative(_slopes(shifted_r), _slopes(shifted_c)), LARGEST_SLOPE_ERROR)
    scores = (corridor, phase, magnitude, slope)
    return IsoRating(float(np.dot(WEIGHTS, scores)), *scores)


def warped(first: Values, second: Values, window: int) -> tuple[Values, Values]:
    """Two curves of equal length, warped in time onto each other (dynamic time warping).

    Of all paths of pairs (i, j) from the first to the last, of steps (1, 0), (0, 1) or (1, 1) and
    |i - j| <= window, that of the least sum of (first[i] - second[j])^2. It is computed from line to line
    i + j = k.

    Returns:
        Both curves along the path, (m,) each.
    """
    count = first.size
    steps = np.zeros((2 * count - 1, window + 2), dtype=np.int8)  # of each line's cells, where they came from
    starts = np.zeros(2 * count - 1, dtype=np.int64)  # the first i of each line
    padded = count + 2
    before, last = np.full(padded, np.inf), np.full(padded, np.inf)  # [i + 1]: of lines k - 2 and k - 1
    for k in range(2 * count - 1):
        low = max(0, k - count + 1, (k - window + 1) // 2)
        high = min(count - 1, k, (k + window) // 2)
        i = np.arange(low, high + 1)
        ways = np.array([last[i], last[i + 1], before[i]])  # from (i - 1, j), (i, j - 1), (i - 1, j - 1)
        steps[k, : i.size], starts[k] = ways.argmin(axis=0), low
        line = np.full(padded, np.inf)
        line[i + 1] = (first[i] - second[k - i]) ** 2 + (ways.min(axis=0) if k else 0.0)
        before, last = last, line
    path = [(count - 1, count - 1)]
    while path[-1] != (0, 0):
        one, other = path[-1]
        step = int(steps[one + other, one - starts[one + other]])
        path.append((one - (step != 1), other - (step != 0)))
    at = np.array(path[::-1])
    return first[at[:, 0]], second[at[:, 1]]


def _corridor(r: Values, c: Values) -> float:
    size = float(np.abs(r).max())
    way = (OUTER * size - np.abs(c - r)) / ((OUTER - INNER) * size)
    return float((np.clip(way, 0.0, 1.0) ** CORRIDOR_POWER).mean())


def _best_lag(r: Values, c: Values) -> int:
    """The lag of the largest correlation, in samples; of equal ones the smallest, then the positive one."""
    most = int(LARGEST_SHIFT * r.size)
    lags = np.array([0, *(sign * lag for lag in range(1, most + 1) for sign in (1, -1))], dtype=np.int64)
    return int(lags[np.nanargmax(lagged_correlations(r, c, lags))])


def _slopes(values: Values) -> Values:
    """Central differences per sample, averaged over 9 samples, at the ends over 1, 3, 5 and 7."""
    slopes = np.gradient(values)
    found: Values = np.empty(slopes.size)
    half = AVERAGED // 2
    found[half:-half] = np.convolve(slopes, np.full(AVERAGED, 1.0 / AVERAGED), "valid")
    for n in range(half):
        found[n], found[-1 - n] = slopes[: 2 * n + 1].mean(), slopes[slopes.size - 2 * n - 1 :].mean()
    return found


def _relative(r: Values, c: Values) -> float:
    return float(np.abs(c - r).sum() / np.abs(r).sum())


def _score(error: float, largest: float) -> float:
    return max(0.0, 1.0 - error / largest)


def _not_told(reason: str) -> IsoRating:
    names = IsoRating._fields[:5]
    none = math.nan
    return IsoRating(none, none, none, none, none, MappingProxyType(dict.fromkeys(names, reason)))
