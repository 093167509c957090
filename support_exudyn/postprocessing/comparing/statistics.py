"""Means of two curves after the horizon, with the confidence interval of their difference.

Beyond the horizon of a run, two curves are compared as pieces of steady processes: do their means and root mean
squares differ by more than chance explains for pieces of such a length? Both curves are cut into the same
`BLOCKS` blocks, so that a course that both follow, such as a stroke, drops out. Student's t gives the interval
of the mean of the blocks' differences (batch means). Neighbouring samples may be correlated as long as blocks
are longer than the correlation lasts.

Source: C. Alexopoulos, A. F. Seila, "Output data analysis", in J. Banks (ed.), Handbook of Simulation (1998).
"""

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy import stats

Values = npt.NDArray[np.float64]
BLOCKS = 10
FEWEST = 5  # samples of a block
CONFIDENCE = 0.95  # of all intervals of two files together
EXACT = 1e-12  # of the largest value: rounding of a difference of curves that do not vary

STATISTICS: Mapping[str, Callable[[Values], float]] = {
    "mean": lambda values: float(values.mean()),
    "rms": lambda values: float(np.sqrt(np.mean(values**2))),
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
    """The mean and the root mean square of two curves, by name.

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
    blocks = [np.array_split(values, BLOCKS) for values in (first, second)]
    quantile = float(stats.t.ppf(0.5 + 0.5 * CONFIDENCE ** (1.0 / among), BLOCKS - 1))
    rounding = EXACT * float(np.abs((first, second)).max())
    result = {}
    for name, statistic in STATISTICS.items():
        values, half = (statistic(first), statistic(second)), math.nan
        if first.size >= FEWEST * BLOCKS:
            apart = [statistic(its) - statistic(mine) for mine, its in zip(*blocks, strict=True)]
            half = quantile * float(stats.sem(apart)) + rounding
        result[name] = StatisticDifference(*values, values[1] - values[0], half)
    return result
