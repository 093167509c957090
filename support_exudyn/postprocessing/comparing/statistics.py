"""Statistics of two curves, with confidence intervals of their difference by the stationary block bootstrap.

After curves with impacts have parted, they are compared as two pieces of steady processes: do their means,
spreads and so on differ by more than chance explains for pieces of such a length?

Each statistic is computed of many resampled series; the standard deviation of the results is its standard
error e. With m blocks in a series its interval is

    value -+ t(m - 1) e sqrt(m / (m - 1))

by Student's t, for m blocks tell a spread no better than m numbers do. Both series are resampled by the same
blocks, so that a course that both follow, such as a stroke, drops out. Blocks are `LONGER` times as long as is
best for the mean square error of e: those make e too small, and intervals would miss the truth too often.

Sources: D. N. Politis and J. P. Romano, "The stationary bootstrap", J. Am. Stat. Assoc. 89 (1994) 1303-1313;
D. N. Politis and H. White, "Automatic block-length selection for the dependent bootstrap", Econometric Reviews
23 (2004) 53-70; A. Patton, D. N. Politis and H. White, correction to it, Econometric Reviews 28 (2009) 372-375.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy import fft, stats

from support_exudyn.postprocessing.comparing.common_times import EvenSamples, even_samples, on_common_times

Values = npt.NDArray[np.float64]
Statistic = Callable[[Values], float]
QUANTILE = 0.95
LONGER = 3.0
RESAMPLES = 400  # so that a standard error is known to 4 %
FEWEST_BLOCKS = 5.0
IMPACTS = "impacts_per_second"
EXACT = 1e-12  # of the largest value: rounding of a difference of curves that do not vary
ROUNDING = 1e-14  # of the largest value, that a mean of equal values may differ by
BAND = 2.0  # correlations below BAND sqrt(log10(n) / n) are taken to be none

STATISTICS: Mapping[str, Statistic] = {
    "mean": lambda values: float(values.mean()),
    "rms": lambda values: float(np.sqrt(np.mean(values**2))),
    "spread": lambda values: float(values.std()),
    "quantile_95": lambda values: float(np.quantile(values, QUANTILE)),
}


class StatisticDifference(NamedTuple):
    """A statistic of two curves.

    name: "mean", "rms", "spread" (standard deviation), "quantile_95" (95 % of the values are below it) or
        "impacts_per_second".
    first, second, difference: of each curve, and second less first.
    low, high: confidence interval of the difference; NaN if the curves are too short for an interval.
    blocks: number of independent pieces that the difference of the curves is worth.
    not_told: why there is no interval, in words; "" if there is one.
    """

    name: str
    first: float
    second: float
    difference: float
    low: float
    high: float
    blocks: float
    not_told: str = ""

    @property
    def equal(self) -> bool | None:
        """Whether the interval of the difference contains 0; None if there is no interval."""
        return None if self.not_told else self.low <= 0.0 <= self.high

    @property
    def tellable(self) -> float:
        """The smallest difference that would have shown: half the interval's width; NaN without an interval."""
        return 0.5 * (self.high - self.low)


def compared_statistics(
    first_time: Values,
    first: Values,
    second_time: Values,
    second: Values,
    *,
    impacts: tuple[Sequence[float], Sequence[float]] | None = None,
    confidence: float = 0.95,
    among: int = 1,
    seed: int = 0,
) -> dict[str, StatisticDifference]:
    """Statistics of two curves, by their names.

    Arguments:
        first_time, second_time: [s], (n,) and (m,), increasing. first, second: values of one unit; NaN where
            a value is not known.
        impacts: times of the impacts of both [s], for their number per second; None: not computed.
        confidence: that all of `among` intervals contain the truth, between 0 and 1.
        among: number of differences that are reported together. Of twenty intervals of 95 % one misses the
            truth on average, so each has the confidence confidence^(1/among) (Sidak).
        seed: of the resampling; the same seed gives the same numbers.

    Raises InputError if a curve has fewer than two values.
    """
    alone = confidence ** (1.0 / among)
    both = on_common_times(first_time, first, second_time, second)
    time, reference, other = both.part(np.isfinite(both.reference) & np.isfinite(both.other))
    single = even_samples(first_time, first), even_samples(second_time, second)
    paired = even_samples(time, reference), even_samples(time, other)
    result = _differences(
        [curve.values for curve in single],
        [curve.values for curve in paired],
        STATISTICS,
        _influences,
        np.random.default_rng([seed, 2]),
        alone,
    )
    if impacts is not None:
        alone_rates, paired_rates = (
            [_rates(curve, times) for curve, times in zip(curves, impacts, strict=True)]
            for curves in (single, paired)
        )
        result |= _differences(
            alone_rates,
            paired_rates,
            {IMPACTS: STATISTICS["mean"]},
            lambda values: values[None],
            np.random.default_rng([seed, 5]),
            alone,
        )
    return result


def _differences(
    single: Sequence[Values],
    paired: Sequence[Values],
    statistics: Mapping[str, Statistic],
    influences: Callable[[Values], Values],
    random: np.random.Generator,
    confidence: float,
) -> dict[str, StatisticDifference]:
    """Differences of statistics, each with its interval.

    Arguments:
        single: samples of both curves by themselves. paired: of both at common times, (n,) each.
        influences: by how much a small change of each sample changes each of the statistics; their difference
            gives the length of the blocks, for a difference that is constant does not tell that of squares.
        confidence: of each interval alone.
    """
    first, second = paired
    count, largest = first.size, max(float(np.abs(curve).max()) for curve in single)
    result = {}
    for (name, statistic), influence in zip(
        statistics.items(), influences(second) - influences(first), strict=True
    ):
        values = statistic(single[0]), statistic(single[1])
        length = LONGER * block_length(influence)
        draws = [resampled(count, length, random) for _ in range(RESAMPLES)]
        blocks, difference = count / length, values[1] - values[0]
        error = float(np.std([statistic(second[at]) - statistic(first[at]) for at in draws], ddof=1))
        half, why = math.nan, ""
        if blocks < FEWEST_BLOCKS:
            why = (
                f"the curves are worth {blocks:.1f} independent pieces; allowed: {FEWEST_BLOCKS:g} and more, "
                "so a longer duration"
            )
        else:
            quantile = float(stats.t.ppf(0.5 + 0.5 * confidence, blocks - 1.0))
            half = quantile * error * math.sqrt(blocks / (blocks - 1.0)) + EXACT * largest
        ends = difference - half, difference + half
        result[name] = StatisticDifference(name, *values, difference, *ends, blocks, why)
    return result


def _influences(values: Values) -> Values:
    """By how much a small change of each sample changes each of `STATISTICS`, (4, n), but for factors."""
    below = np.where(values <= np.quantile(values, QUANTILE), 1.0, 0.0)
    return np.array((values, values**2, (values - values.mean()) ** 2, below))


def _rates(curve: EvenSamples, impacts: Sequence[float]) -> Values:
    """Impacts per second between neighbouring samples of a curve [1/s], (n,)."""
    edges = curve.start + curve.spacing * (np.arange(curve.values.size + 1) - 0.5)
    return np.histogram(np.asarray(impacts, dtype=float), edges)[0] / curve.spacing


def block_length(values: Values) -> float:
    """The mean length of blocks, in samples, that is best for the mean of a series (Politis and White).

        b = (2 G^2 / D)^(1/3) n^(1/3),  G = sum h(k/M) |k| R(k),  D = 2 (sum h(k/M) R(k))^2

    with autocovariances R(k), both sums from -M to M, and the flat-top window h(x) = 1 up to 1/2, then
    2 (1 - |x|). M is twice the lag after which K = max(5, log10 n) correlations in a row are within
    2 sqrt(log10(n)/n). The length is at least 1 and at most min(3 sqrt n, n/3).

    values: (n,), of a stationary series at equal spacings.
    """
    weighted = _weighted_covariances(values)
    if not weighted[0] > 0.0:
        return 1.0
    longest = math.ceil(min(3.0 * math.sqrt(values.size), values.size / 3.0))
    slope, variance = 2.0 * float(np.arange(weighted.size) @ weighted), _both_sides(weighted)
    if variance == 0.0:
        return float(longest)
    length = abs(slope / variance) ** (2.0 / 3.0) * values.size ** (1.0 / 3.0)
    return float(min(max(length, 1.0), longest))


def long_run_variance(values: Values) -> float:
    """n times the variance of a series' mean: the sum of autocovariances, by the window of `block_length`.

    The variance itself, where that sum is not positive. values: (n,).
    """
    weighted = _weighted_covariances(values)
    total = _both_sides(weighted)
    return total if total > 0.0 else float(weighted[0])


def resampled(count: int, length: float, random: np.random.Generator) -> npt.NDArray[np.intp]:
    """Indexes of the samples of a new series (n,): blocks that begin anywhere and go on, around the end.

    Arguments:
        count: of samples, n. length: mean of the blocks' lengths, at least 1, geometrically distributed.
    """
    begins = random.random(count) * length < 1.0
    begins[0] = True
    at = np.flatnonzero(begins)
    starts = random.integers(count, size=at.size)
    indexes = np.repeat(starts - at, np.diff(at, append=count)) + np.arange(count)
    return np.asarray(indexes % count, dtype=np.intp)


def _weighted_covariances(values: Values) -> Values:
    """h(k/M) R(k) for k = 0 ... M, see `block_length`; a single 0 of a constant series."""
    count = values.size
    row = max(5, int(math.log10(count)))
    most = min(math.ceil(math.sqrt(count)) + row, count - 1)
    size = fft.next_fast_len(count + most + 1, real=True)
    power = np.abs(fft.rfft(values - values.mean(), size)) ** 2
    covariances: Values = fft.irfft(power, size)[: most + 1] / count
    if not covariances[0] > (ROUNDING * float(np.abs(values).max())) ** 2:
        return np.zeros(1)
    none = np.abs(covariances[1:]) < BAND * math.sqrt(math.log10(count) / count) * covariances[0]
    in_a_row = np.convolve(none, np.ones(row), "valid") == row  # [m]: those of lags m + 1 to m + row
    last = min(2 * max(int(in_a_row.argmax()), 1) if in_a_row.any() else most, most)
    window = np.minimum(1.0, 2.0 * (1.0 - np.arange(last + 1) / last))
    return covariances[: last + 1] * window


def _both_sides(weighted: Values) -> float:
    """The sum from -M to M of terms that are given from 0 to M."""
    return float(weighted[0] + 2.0 * weighted[1:].sum())
