"""Statistics of two curves, with confidence intervals of their difference.

Once two curves with impacts have parted they are not compared point by point, but as two pieces of steady
processes: are their means, spreads and so on alike, but for what chance makes of pieces of such a length?

Each statistic is computed of many resampled series, see `bootstrap`; the standard deviation of what comes out
is its standard error e. With m blocks in a series its interval is

    value -+ t(m - 1) e sqrt(m / (m - 1))

by Student's t, for m blocks tell a spread no better than m numbers do. Of a difference both series are
resampled by the same blocks, so that a course that both follow, such as a stroke, drops out. Blocks are
`LONGER` times as long as is best for the mean square error of e (Politis and White): those make e too small,
and intervals would miss the truth too often.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy import stats

from support_exudyn.postprocessing.comparing.bootstrap import block_length, resampled
from support_exudyn.postprocessing.comparing.common_times import on_common_times
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
    """A statistic of two curves.

    name: "mean", "rms", "spread" (standard deviation), "quantile_95" (which 95 % of the values are below) or
        "impacts_per_second".
    first, second, difference: of each curve, and second less first, with their intervals; a curve that is worth
        too few pieces by itself has none.
    confidence: of each interval alone, such as 0.95.
    blocks: how many independent pieces the difference of the curves is worth.
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
    """Statistics of two curves, by their names.

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
    both = on_common_times(first_time, first, second_time, second)
    there = np.isfinite(both.reference) & np.isfinite(both.other)
    pieces = [(first_time, first), (second_time, second)]
    pieces += [(both.time[there], one[there]) for one in (both.reference, both.other)]
    alone_first, alone_second, *paired = (even_samples(*piece) for piece in pieces)
    signed: list[list[tuple[float, EvenSamples]]] = [
        [(1.0, alone_first)],
        [(1.0, alone_second)],
        [(-1.0, paired[0]), (1.0, paired[1])],
    ]
    known = [
        _known([(sign, one.values) for sign, one in curves], _influences, STATISTICS, [seed, n])
        for n, curves in enumerate(signed)
    ]
    if first_impacts is not None and second_impacts is not None:
        impacts = [[first_impacts], [second_impacts], [first_impacts, second_impacts]]
        for n, (curves, times) in enumerate(zip(signed, impacts, strict=True)):
            counts = [(sign, _rates(one, at)) for (sign, one), at in zip(curves, times, strict=True)]
            rate = {IMPACTS: lambda rates: float(rates.mean())}
            known[n] |= _known(counts, lambda rates: rates[None], rate, [seed, len(signed) + n])
    first_known, second_known, both_known = known
    return {
        name: _difference(name, first_known[name], second_known[name], both_known[name], alone)
        for name in first_known
    }


class _Known(NamedTuple):
    """A statistic of a curve, its standard error, of how many blocks it is known, and the largest value."""

    value: float
    error: float
    blocks: float
    largest: float


def _influences(values: Values) -> Values:
    """By how much a small change of each sample changes each of the statistics (4, n)."""
    below = np.where(values <= np.quantile(values, QUANTILE), 1.0, 0.0)
    return np.array((values, values**2, (values - values.mean()) ** 2, below))


def _known(
    curves: Sequence[tuple[float, Values]],
    influences: Callable[[Values], Values],
    statistics: Mapping[str, Callable[[Values], float]],
    seed: Sequence[int],
) -> dict[str, _Known]:
    """Statistics of a curve, or of two with the signs by which they count, both resampled by the same blocks.

    influences: of the samples on the statistics. The slowest of a curve gives the length of all blocks; of two
        each statistic has its own, for a difference that is constant does not tell that of squares.
    """
    count, random = curves[0][1].size, np.random.default_rng(seed)
    lengths = [*map(block_length, np.sum([sign * influences(values) for sign, values in curves], axis=0))]
    largest = max(float(np.abs(values).max()) for _, values in curves)
    found = {}
    for (name, statistic), own in zip(statistics.items(), lengths, strict=True):
        length = LONGER * (own if len(curves) > 1 else max(lengths))
        draws = [np.arange(count), *(resampled(count, length, random) for _ in range(RESAMPLES))]
        value, *drawn = (math.fsum(sign * statistic(values[at]) for sign, values in curves) for at in draws)
        found[name] = _Known(value, float(np.std(drawn, ddof=1)), count / length, largest)
    return found


def _rates(curve: EvenSamples, impacts: Sequence[float]) -> Values:
    """Impacts per second between neighbouring samples of a curve [1/s]."""
    edges = curve.start + curve.spacing * (np.arange(curve.values.size + 1) - 0.5)
    return np.histogram(np.asarray(impacts, dtype=float), edges)[0] / curve.spacing


def _difference(
    name: str, first: _Known, second: _Known, both: _Known, confidence: float
) -> StatisticDifference:
    """The statistic of both curves, and its difference by what is known of them together."""
    value, why = second.value - first.value, ""
    if both.blocks < FEWEST_BLOCKS:
        why = (
            f"the curves are worth {both.blocks:.1f} independent pieces; allowed: {FEWEST_BLOCKS:g} and more, "
            "so a longer duration"
        )
    rounding = EXACT * max(first.largest, second.largest)
    return StatisticDifference(
        name,
        _interval(first.value, first, confidence),
        _interval(second.value, second, confidence),
        _interval(value, both, confidence, rounding),
        confidence,
        both.blocks,
        why,
    )


def _interval(value: float, known: _Known, confidence: float, least: float = 0.0) -> Interval:
    """The confidence interval of a value; NaN if too few blocks tell it."""
    if known.blocks < FEWEST_BLOCKS:
        return Interval(value, math.nan, math.nan)
    freedom = known.blocks - 1.0
    error = known.error * math.sqrt(known.blocks / freedom)
    half = float(stats.t.ppf(0.5 + 0.5 * confidence, freedom)) * error + least
    return Interval(value, value - half, value + half)
