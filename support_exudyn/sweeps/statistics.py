"""What the numbers of many runs come to: percentiles with their confidence, and which input matters most."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

LEVELS = (0.05, 0.5, 0.95)
CONFIDENCE = 0.95
FEWEST = 5  # runs that a rank correlation with an interval needs


class Percentile(NamedTuple):
    """A percentile of runs: the share of them that is below the value, and its confidence interval.

    low, high: within which the percentile of all runs that might have been drawn lies, NaN where so few runs do
    not bound it.
    """

    share: float
    value: float
    low: float
    high: float


def percentiles(
    values: Sequence[float], shares: Sequence[float] = LEVELS, confidence: float = CONFIDENCE
) -> list[Percentile]:
    """Percentiles of a number over runs, with confidence intervals between two of the runs (order statistics).

    The intervals suppose no distribution of the numbers, and runs that were drawn independently; those of a
    Latin hypercube are drawn more evenly, which makes percentiles rather more certain than is said.

    Arguments:
        values: of the runs, at least one, without NaN.
        shares: which percentiles, 0 to 1.
        confidence: how often the interval has the percentile in it, 0 to 1.
    """
    from scipy.stats import quantile_test  # takes a second

    found = []
    for share in shares:
        interval: Any = quantile_test(values, p=share).confidence_interval(confidence)
        value = float(np.quantile(values, share))
        found.append(Percentile(share, value, float(interval.low), float(interval.high)))
    return found


class Rank(NamedTuple):
    """How far a number follows an input: Spearman's rank correlation, -1 to 1, and its confidence interval."""

    name: str
    correlation: float
    low: float
    high: float

    @property
    def is_certain(self) -> bool:
        """Whether the interval leaves no doubt of the sign."""
        return self.low > 0.0 or self.high < 0.0


def ranking(
    inputs: Mapping[str, Sequence[Any]], values: Sequence[float], confidence: float = CONFIDENCE
) -> list[Rank]:
    """Inputs by how far a number follows them, the strongest first.

    The interval is that of Fisher's transformation with the variance of Bonett and Wright (2000). An input that
    is no number in all runs, or the same in all, has no rank and is left out.

    Arguments:
        inputs: of the runs (n,), by name.
        values: the number of the runs (n,), without NaN.
        confidence: how often the interval has the correlation of all runs in it, 0 to 1.
    """
    from scipy.stats import norm, spearmanr

    found = []
    spread = len(set(values)) > 1
    for name, given in inputs.items():
        numeric = all(isinstance(one, (int, float)) and not isinstance(one, bool) for one in given)
        if not numeric or len(set(given)) < 2 or len(values) < FEWEST or not spread:
            continue
        correlation = float(spearmanr(given, values).statistic)
        wide = float(norm.ppf(0.5 + 0.5 * confidence))
        wide *= math.sqrt((1.0 + 0.5 * correlation**2) / (len(values) - 3))
        middle = math.atanh(min(max(correlation, -1.0 + 1e-12), 1.0 - 1e-12))
        found.append(Rank(name, correlation, math.tanh(middle - wide), math.tanh(middle + wide)))
    return sorted(found, key=lambda one: -abs(one.correlation))
