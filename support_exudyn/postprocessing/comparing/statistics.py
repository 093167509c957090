"""Statistics of two curves, with confidence intervals of their difference by a jackknife over blocks.

Beyond the horizon of a run, two curves are compared as pieces of steady processes: do their means, spreads and
so on differ by more than chance explains for pieces of such a length?

Both curves are cut into the same `BLOCKS` blocks, so that a course that both follow, such as a stroke, drops
out. Let D be the difference of a statistic, and D_k the same difference without block k of m. Its interval is

    D -+ t(m - 1) e,   e^2 = (m - 1) / m * sum (D_k - <D_k>)^2

by Student's t. Neighbouring samples may be correlated as long as blocks are longer than the correlation lasts.

Source: H. R. Kuensch, "The jackknife and the bootstrap for general stationary observations", Ann. Stat. 17
(1989) 1217-1241.
"""

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy import stats

Values = npt.NDArray[np.float64]
Statistic = Callable[[Values], float]
QUANTILE = 0.95
BLOCKS = 10
FEWEST = 5  # samples of a block
CONFIDENCE = 0.95  # of all intervals of two files together
EXACT = 1e-12  # of the largest value: rounding of a difference of curves that do not vary

STATISTICS: Mapping[str, Statistic] = {
    "mean": lambda values: float(values.mean()),
    "rms": lambda values: float(np.sqrt(np.mean(values**2))),
    "spread": lambda values: float(values.std()),
    "quantile_95": lambda values: float(np.quantile(values, QUANTILE)),
}


class StatisticDifference(NamedTuple):
    """A statistic of two curves.

    first, second, difference: of each curve, and second less first.
    tellable: half of the confidence interval of the difference, which is the smallest difference that would
        have shown; NaN if the curves are too short.
    """

    first: float
    second: float
    difference: float
    tellable: float

    @property
    def equal(self) -> bool | None:
        """Whether the interval of the difference contains 0; None if there is no interval."""
        return None if math.isnan(self.tellable) else abs(self.difference) <= self.tellable


def compared_statistics(first: Values, second: Values, among: int = 1) -> dict[str, StatisticDifference]:
    """The statistics "mean", "rms", "spread" (standard deviation) and "quantile_95" of two curves, by name.

    Arguments:
        first, second: values of one unit at the same, evenly spaced times, (n,); NaN where one is not known.
        among: number of differences that are reported together. Of twenty intervals of 95 % one misses the
            truth on average, so each has the confidence 0.95^(1/among) (Sidak).

    Returns:
        The differences; none if fewer than two values are known of both.
    """
    known = np.isfinite(first) & np.isfinite(second)
    first, second = first[known], second[known]
    if first.size < 2:
        return {}
    quantile = float(stats.t.ppf(0.5 + 0.5 * CONFIDENCE ** (1.0 / among), BLOCKS - 1))
    rounding = EXACT * float(np.abs((first, second)).max())
    result = {}
    for name, statistic in STATISTICS.items():
        values, half = (statistic(first), statistic(second)), math.nan
        if first.size >= FEWEST * BLOCKS:
            half = quantile * _standard_error(statistic, first, second) + rounding
        result[name] = StatisticDifference(*values, values[1] - values[0], half)
    return result


def _standard_error(statistic: Statistic, first: Values, second: Values) -> float:
    """The standard error of the difference of a statistic, from the differences without a block each."""
    blocks = np.array_split(np.arange(first.size), BLOCKS)
    rests = [(np.delete(first, block), np.delete(second, block)) for block in blocks]
    differences = [statistic(its) - statistic(mine) for mine, its in rests]
    return math.sqrt(BLOCKS - 1) * float(np.std(differences))
