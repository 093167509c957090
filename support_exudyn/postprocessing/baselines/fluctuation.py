"""How far means and spreads of a run are off by chance: its impacts beyond the horizon are not determined."""

import math

import numpy as np
from scipy import stats

from support_exudyn.simulation.result import Result

BATCHES = 10  # of a part of a run
FEWEST = 5  # records of each: fewer tell nothing
SURE = 0.999  # of two-sided intervals: a baseline has many numbers, and should say nothing of most


def fluctuation(result: Result, name: str, horizon: float) -> float:
    """By how much a mean or spread over the run may be off by chance, in its unit; infinite: not known.

    The part beyond the horizon is cut into batches. The means of these scatter, and so does the mean of all, by
    the standard error s / sqrt(BATCHES), times Student's quantile (batch means, Law and Kelton, Simulation
    Modeling and Analysis). A spread is the root of a mean, of squares, and scatters by that of the mean over
    twice the spread. Both count as much as the part is of the run.

    Arguments:
        result: the run.
        name: of a number, a channel's with `.mean` or `.std`.
        horizon: time [s] from which on the run is not determined.
    """
    channel, _, statistic = name.rpartition(".")
    beyond = result.time >= horizon
    values = result[channel][beyond]
    if values.size < BATCHES * FEWEST:
        return math.inf if beyond.any() else 0.0
    share = values.size / result.time.size
    if statistic == "mean":
        return share * _of_mean(values)
    whole = result[channel]
    spread = float(whole.std())
    return share * _of_mean((values - whole.mean()) ** 2) / (2.0 * spread) if spread > 0.0 else 0.0


def _of_mean(values: np.ndarray) -> float:
    means = np.array([batch.mean() for batch in np.array_split(values, BATCHES)])
    quantile = float(stats.t.ppf(0.5 + SURE / 2.0, BATCHES - 1))
    return quantile * float(means.std(ddof=1)) / math.sqrt(BATCHES)
