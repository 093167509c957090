"""Statistics of two series with confidence intervals by the stationary block bootstrap."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Values = npt.NDArray[np.float64]


class Interval(NamedTuple):
    """A number and the ends of its confidence interval."""

    value: float
    low: float
    high: float


class StatisticDifference(NamedTuple):
    """A statistic of two independent series.

    name: "mean", "rms", "spread", "quantile_95", "impacts_per_second".
    first, second, difference: second less first; with their intervals.
    tellable: the smallest difference that would have been told: half the width of the interval.
    confidence: of each of the intervals, such as 0.95.
    not_told: why there are no intervals; "" if there are.
    """

    name: str
    first: Interval
    second: Interval
    difference: Interval
    tellable: float
    confidence: float
    not_told: str = ""

    @property
    def equal(self) -> bool | None:
        """Whether the interval of the difference contains 0; None if there is no interval."""
        if self.not_told:
            return None
        return self.difference.low <= 0.0 <= self.difference.high


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

    first_impacts, second_impacts: times of impacts [s], for their number per second.
    among: how many statistics are told together; each interval is widened (Sidak) so that all of them hold with
        the confidence.
    """
    raise NotImplementedError
