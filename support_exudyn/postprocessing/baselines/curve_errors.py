"""Errors of curves that are to hold for all of their records together."""

import math

import numpy as np

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.figures.channels import error_over_time
from support_exudyn.simulation.result import Result

# Estimates of errors hold for 98 % of numbers, and the worst was wrong by 3.1, see `simulation.estimate`. A run
# has thousands of records and hundreds of impacts, of which one that is wrong would be told: they get more.
OF_MANY = 3.5
# Share of the largest value of a unit, of the whole run, that an error is at least: what is nothing in truth,
# as the force of a pin that carries nothing, is left by rounding of what others are.
ROUNDING = 1e-12


def safe_errors(result: Result, name: str) -> Series:
    """Errors of a channel at every record, (n,), in its unit, infinite if they are not known.

    `OF_MANY` times the largest of all records up to the next one, and what rounding leaves: where the curves
    of two runs cross they agree by chance, and what is behind an impact is not more certain than that is.
    """
    around = error_over_time(result, name)
    if around is None:
        return np.full(result.time.size, math.inf)
    worst = np.maximum.accumulate(np.concatenate([around[1:], around[-1:]]))
    found: Series = OF_MANY * np.maximum(worst, around[0]) + ROUNDING * largest_of_unit(
        result, result.unit(name)
    )
    return found


def largest_of_unit(result: Result, unit: str) -> float:
    """The largest magnitude of all channels of a unit; 0 if nothing is known of them."""
    channels = (one.values for one in result.channels.values() if one.unit == unit)
    return max(
        (float(np.abs(values[np.isfinite(values)]).max(initial=0.0)) for values in channels), default=0.0
    )
