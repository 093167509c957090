"""Records that two runs have in common, and whether all are the same."""

import numpy as np
import numpy.typing as npt

from support_exudyn.postprocessing.figures.selection import CLEARANCE, inside
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError


def same_to_the_bit(first: Result, second: Result) -> int:
    """The number of channels of two runs, if all are in both and all their records the same bits; else 0."""
    names = list(first.channels)
    if set(names) != set(second.channels):
        return 0
    pairs = [(first.time, second.time), *((first[name], second[name]) for name in names)]
    same = all(one.dtype == other.dtype and one.tobytes() == other.tobytes() for one, other in pairs)
    return len(names) if same else 0


Rows = tuple[npt.NDArray[np.intp], npt.NDArray[np.intp]]  # of the same times in both runs


def common_records(first: Result, second: Result, after: float, until: float) -> Rows:
    """The records of two runs that are of the same times, between two times [s].

    Raises InputError if there are none.
    """
    for run in (first, second):
        inside(run, after, until, fewest=1)  # says which times there are
    ticks = [np.round(run.time / CLEARANCE).astype(np.int64) for run in (first, second)]
    _, mine, its = np.intersect1d(ticks[0], ticks[1], assume_unique=True, return_indices=True)
    within = inside(first, after, until, fewest=1)[mine]
    if not within.any():
        raise InputError(
            f"record_period = {first.scenario.recorded_every:g} and {second.scenario.recorded_every:g} s: the "
            "runs have no record at the same time there; allowed: periods with a common multiple"
        )
    return mine[within], its[within]
