"""What differs between two runs, record by record, with its error."""

import math
from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.postprocessing.figures.selection import CLEARANCE, inside
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

Series = npt.NDArray[np.float64]
Statistic = Callable[[Series], float]


class Difference(NamedTuple):
    """A channel of a second run less that of a first.

    first, second: their means. mean: of the difference. largest: the difference that is largest in size, with
    its sign. time: when that is [s].
    """

    first: Estimate
    second: Estimate
    mean: Estimate
    largest: Estimate
    time: float


def compared(
    first: Result, second: Result, names: Iterable[str], after: float = 0.0, until: float = math.inf
) -> dict[str, Difference]:
    """Channels of two runs, at the times between two [s] at which both have records.

    The error of a difference is the sum of what its runs contribute, each by its own coarser runs; NaN if one
    of them was made without an accuracy.

    Raises InputError if a run lacks a channel, units differ, or no record is common.
    """
    rows = common_records(first, second, after, until)
    return {name: _difference(first, second, name, rows) for name in names}


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
            f"record_period = {first.scenario.record_period:g} and {second.scenario.record_period:g} s: the "
            "runs have no record at the same time there; allowed: periods with a common multiple"
        )
    return mine[within], its[within]


def _difference(first: Result, second: Result, name: str, rows: Rows) -> Difference:
    for word, run in (("first", first), ("second", second)):
        if name not in run.channels:
            raise InputError(f"{name}: the {word} run has no such channel; allowed: those that both have")
    unit = first.unit(name)
    if second.unit(name) != unit:
        raise InputError(f"{name}: is in {unit} and in {second.unit(name)}; allowed: one unit")
    mine, its = rows

    def apart(one: Result, other: Result) -> Series:
        return np.asarray(other[name][its] - one[name][mine])

    def of_both(statistic: Statistic) -> Estimate:
        value = statistic(apart(first, second))
        error = _error(first, lambda run: statistic(apart(run, second)))
        return Estimate(value, error + _error(second, lambda run: statistic(apart(first, run))), unit)

    def mean(run: Result, records: npt.NDArray[np.intp]) -> Estimate:
        def measure(one: Result) -> float:
            return float(one[name][records].mean())

        return Estimate(measure(run), _error(run, measure), unit)

    where = int(np.abs(apart(first, second)).argmax())
    return Difference(
        mean(first, mine),
        mean(second, its),
        of_both(lambda values: float(values.mean())),
        of_both(lambda values: float(values[np.abs(values).argmax()])),
        float(first.time[mine[where]]),
    )


def _error(run: Result, measure: Callable[[Result], float]) -> float:
    return math.nan if run.coarser is None else run.estimate(measure).error
