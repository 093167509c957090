"""Statistics of two curves, with confidence intervals of their difference.

Once two curves with impacts have parted they are not compared point by point, but as two pieces of steady
processes: are their means, spreads and so on alike, but for what chance makes of pieces of such a length?

Each statistic is computed of many resampled series, see `bootstrap`; the standard deviation of what comes out
is its standard error e. With m blocks in a series its interval is

    value -+ t(m - 1) e sqrt(m / (m - 1))

by Student's t, for m blocks tell a spread no better than m numbers do. Of a difference, e^2 and the degrees of
freedom are put together as Welch does. Blocks are `LONGER` times as long as is best for the mean square error
of e (Politis and White): those make e too small, and intervals would miss the truth too often.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy import stats

from support_exudyn.postprocessing.comparing.bootstrap import block_length, resampled
from support_exudyn.postprocessing.comparing.even_times import EvenSamples, even_samples
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
QUANTILE = 0.95
LONGER = 3.0
RESAMPLES = 400  # so that a standard error is known to 4 %
FEWEST_BLOCKS = 5.0
IMPACTS = "impacts_per_second"
EXACT = 1e-12  # of the largest value: what rounding may leave of a difference of curves that do not vary

STATISTICS: Mapping[str, Callable[[Values], float]] = {
    "mean": lambda values: float(values.mean()),
    "rms": lambda values: float(np.sqrt(np.mean(values**2))),
    "spread": lambda values: float(values.std()),
    "quantile_95": lambda values: float(np.quantile(values, QUANTILE)),
}


class Interval(NamedTuple):
    """A number and the ends of its confidence interval; NaN if there is none."""

    value: float
    low: float
    high: float


class StatisticDifference(NamedTuple):
    """A statistic of two independent curves.

    name: "mean", "rms", "spread" (standard deviation), "quantile_95" (which 95 % of the values are below) or
        "impacts_per_second".
    first, second, difference: of each curve, and second less first, with their intervals.
    confidence: of each interval alone, such as 0.95.
    blocks: how many independent pieces the shorter curve is worth.
    not_told: why there are no intervals, in words; "" if there are.
    """

    name: str
    first: Interval
    second: Interval
    difference: Interval
    confidence: float
    blocks: float
    not_told: str = ""

    @property
    def equal(self) -> bool | None:
        """Whether the interval of the difference contains 0; None if there is no interval."""
        return None if self.not_told else self.difference.low <= 0.0 <= self.difference.high

    @property
    def tellable(self) -> float:
        """The smallest difference that would have been told: half the interval's width; NaN without one."""
        return 0.5 * (self.difference.high - self.difference.low)


def compared_statistics(
    first_time: Values,
    first: Values,
    second_time: Values,
    second: Values,
    *,
    first_impacts: Sequence[float] | None = None,
    second_impacts: Sequence[float] | None = None,
    confidence: float = 0.95,
    among: int = 1,
    seed: int = 0,
) -> dict[str, StatisticDifference]:
    """Statistics of two curves that are independent of each other, by their names.

    Arguments:
        first_time, second_time: [s], (n,) and (m,), increasing. first, second: values of one unit; NaN where
            not known.
        first_impacts, second_impacts: times of impacts [s], for their number per second; None: not asked for.
        confidence: that all intervals of the difference contain the truth, if `among` of them are told.
        among: how many differences are told together. Of twenty intervals of 95 % one misses the truth on
            average, so each has the confidence confidence^(1/among) (Sidak).
        seed: of the resampling; the same one gives the same numbers.

    Raises InputError for a confidence that is not between 0 and 1, or if a curve has fewer than two values.
    """
    if not 0.0 < confidence < 1.0 or among < 1:
        raise InputError(
            f"confidence = {confidence}, among = {among}: allowed: a confidence between 0 and 1, among >= 1"
        )
    alone = confidence ** (1.0 / among)
    curves = (even_samples(first_time, first), even_samples(second_time, second))
    known = [_of_curve(one, np.random.default_rng([seed, n])) for n, one in enumerate(curves)]
    if first_impacts is not None and second_impacts is not None:
        pairs = zip(curves, (first_impacts, second_impacts), strict=True)
        for n, (one, impacts) in enumerate(pairs):
            known[n][IMPACTS] = _of_impacts(one, impacts, np.random.default_rng([seed, 2 + n]))
    return {name: _difference(name, known[0][name], known[1][name], alone) for name in known[0]}


class _Known(NamedTuple):
    """A statistic of a curve, its standard error, of how many blocks it is known, and the largest value."""

    value: float
    error: float
    blocks: float
    largest: float


def _of_curve(curve: EvenSamples, random: np.random.Generator) -> dict[str, _Known]:
    values = curve.values
    centred = values - values.mean()
    # what a small change of each sample does to the statistics; the slowest of these tells the length of blocks
    influences = (values, values**2, centred**2, np.where(values <= np.quantile(values, QUANTILE), 1.0, 0.0))
    length = LONGER * max(block_length(one) for one in influences)
    found = np.empty((RESAMPLES, len(STATISTICS)))
    for n in range(RESAMPLES):
        drawn = values[resampled(values.size, length, random)]
        found[n] = [statistic(drawn) for statistic in STATISTICS.values()]
    errors = found.std(axis=0, ddof=1)
    return {
        name: _Known(statistic(values), float(error), values.size / length, float(np.abs(values).max()))
        for (name, statistic), error in zip(STATISTICS.items(), errors, strict=True)
    }


def _of_impacts(curve: EvenSamples, impacts: Sequence[float], random: np.random.Generator) -> _Known:
    """Impacts per second during a curve."""
    count = curve.values.size
    duration = count * curve.spacing
    edges = curve.start + curve.spacing * (np.arange(count + 1) - 0.5)
    counts = np.histogram(np.asarray(impacts, dtype=float), edges)[0].astype(float)
    length = LONGER * block_length(counts)
    found = [counts[resampled(count, length, random)].sum() / duration for _ in range(RESAMPLES)]
    rate = float(counts.sum()) / duration
    return _Known(rate, float(np.std(found, ddof=1)), count / length, rate)


def _difference(name: str, first: _Known, second: _Known, confidence: float) -> StatisticDifference:
    value = second.value - first.value
    blocks = min(first.blocks, second.blocks)
    if blocks < FEWEST_BLOCKS:
        one, other, apart = (Interval(item, math.nan, math.nan) for item in (first.value, second.value, value))
        why = (
            f"the curves are worth {blocks:.1f} independent pieces; allowed: {FEWEST_BLOCKS:g} and more, so a "
            "longer duration"
        )
        return StatisticDifference(name, one, other, apart, confidence, blocks, why)
    squares = [_square(one) for one in (first, second)]
    freedoms = [one.blocks - 1.0 for one in (first, second)]
    both = sum(squares)
    shares = sum(square**2 / freedom for square, freedom in zip(squares, freedoms, strict=True))
    rounding = EXACT * max(first.largest, second.largest)
    return StatisticDifference(
        name,
        _interval(first.value, squares[0], freedoms[0], confidence),
        _interval(second.value, squares[1], freedoms[1], confidence),
        _interval(value, both, both**2 / shares if shares > 0.0 else min(freedoms), confidence, rounding),
        confidence,
        blocks,
    )


def _square(one: _Known) -> float:
    return one.error**2 * one.blocks / (one.blocks - 1.0)


def _interval(value: float, square: float, freedom: float, confidence: float, least: float = 0.0) -> Interval:
    half = float(stats.t.ppf(0.5 + 0.5 * confidence, freedom)) * math.sqrt(square) + least
    return Interval(value, value - half, value + half)
