"""A column against its reference at common times: differences, errors, statistics and a verdict."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from support_exudyn.files.series.named_series import NamedSeries
from support_exudyn.files.series.units import converted
from support_exudyn.postprocessing.comparing.common_times import (
    CommonCurves,
    ComparedColumn,
    errors_at,
    extent,
    on_common_times,
    summed,
)
from support_exudyn.postprocessing.comparing.measures import CurveMeasures, curve_measures
from support_exudyn.postprocessing.comparing.statistics import StatisticDifference, compared_statistics
from support_exudyn.postprocessing.comparing.tolerance import (
    JudgedDifference,
    Tolerance,
    ToleranceVerdict,
    worst,
)
from support_exudyn.simulation.estimate import Estimate
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
LARGEST = "largest difference"
GAPS = "values that are missing"
ANGLE, TURN = "rad", 2.0 * math.pi


@dataclass(frozen=True)
class ComparedWindow:
    """The part of two files that is compared.

    after, until: times [s]. horizon: from when on curves are compared by their statistics [s]; infinite: never.
    among: how many statistics are reported together.
    """

    after: float = -math.inf
    until: float = math.inf
    horizon: float = math.inf
    among: int = 1


EVERYTHING = ComparedWindow()


@dataclass(frozen=True)
class ComparedChannel:
    """A curve or number against its reference.

    name, unit: of it. common: both curves at common times; a number is a curve at a single time, 0.
    errors: numerical errors of the difference at these times, with that of interpolation, (n,); NaN: not known.
    before: number of the times that lie before the horizon. measures: of these.
    means: over the whole window, of the reference, of the other curve and of the difference.
    statistics: from the horizon on, by their names; empty if there is none, or if nothing lies behind it.
    tolerance, allowed: the tolerance, and its amount; None and NaN without one.
    """

    name: str
    unit: str
    common: CommonCurves
    errors: Values
    before: int
    measures: CurveMeasures
    means: tuple[Estimate, Estimate, Estimate]
    statistics: Mapping[str, StatisticDifference]
    tolerance: Tolerance | None
    allowed: float

    @property
    def mean(self) -> Estimate:
        """The mean of the difference."""
        return self.means[2]

    @property
    def largest(self) -> Estimate:
        """Magnitude of the largest difference before the horizon with its error; NaN if nothing lies before."""
        if math.isnan(self.measures.largest):
            return Estimate(math.nan, math.nan, self.unit)
        return Estimate(abs(self.measures.largest), float(self.errors[self._largest_at]), self.unit)

    @property
    def beside_errors(self) -> JudgedDifference:
        """The difference at the record with the largest multiple of its error; "told" without errors."""
        where = self._farthest
        if where is None:
            return JudgedDifference(LARGEST, math.nan, 0.0, math.nan)
        return JudgedDifference(LARGEST, float(self._apart[where]), 0.0, float(self.errors[where]))

    @property
    def record(self) -> int:
        """Index of the record that decides: the farthest beyond its error, or the largest difference."""
        by_errors = self.tolerance is not None and self.tolerance.is_errors
        return self._farthest if by_errors and self._farthest is not None else self._largest_at

    @cached_property
    def _farthest(self) -> int | None:
        """Index of the record with the largest multiple of its error; None: no error is known."""
        apart, errors = self._apart[: self.before], self.errors[: self.before]
        known = np.isfinite(errors) & np.isfinite(apart)
        ratios = np.divide(apart, errors, out=np.where(apart > 0.0, math.inf, 0.0), where=errors > 0.0)
        return int(np.where(known, ratios, -1.0).argmax()) if known.any() else None

    @property
    def _largest_at(self) -> int:
        return int(np.searchsorted(self.common.time, self.measures.largest_time))

    @property
    def _apart(self) -> Values:
        return np.abs(self.common.other - self.common.reference)

    @property
    def gaps(self) -> int:
        """Number of times at which the other curve is not known and the reference is."""
        return int(np.count_nonzero(np.isfinite(self.common.reference) & ~np.isfinite(self.common.other)))

    @property
    def judged(self) -> tuple[JudgedDifference, ...]:
        """The differences that are judged: the largest before the horizon, and statistics after it.

        Curves that are the same to the bit have the same errors, whatever these are. Values of the reference
        that the other curve lacks cannot be judged. Without numerical errors that of interpolation counts.
        """
        if self.gaps:
            return (JudgedDifference(GAPS, math.nan, 0.0, 0.0),)
        if np.array_equal(self.common.reference, self.common.other, equal_nan=True):
            return (JudgedDifference(LARGEST, 0.0, 0.0, 0.0),)
        if self.tolerance is not None and self.tolerance.is_errors:
            judged = self.beside_errors
            known = not math.isnan(judged.allowed)
            return (judged if known else JudgedDifference(LARGEST, self.largest.value, math.inf, 0.0),)
        found = []
        if self.before:
            value, error, _ = self.largest
            if math.isnan(error) and math.isfinite(value):
                error = float(self.common.interpolation_error[self._largest_at])
            found.append(JudgedDifference(LARGEST, value, _or_infinite(error), self.allowed))
        for name, statistic in self.statistics.items():
            half = _or_infinite(statistic.half)
            found.append(JudgedDifference(name, abs(statistic.difference), half, self.allowed))
        return tuple(found)

    @property
    def verdict(self) -> ToleranceVerdict:
        """Whether the channel is within its tolerance; "not decided" if there is nothing to judge by."""
        if self.tolerance is None:
            return "told"
        return worst(judged.verdict for judged in self.judged) if self.judged else "not decided"


def _or_infinite(error: float) -> float:
    return error if math.isfinite(error) else math.inf


def compared(
    name: str,
    reference: ComparedColumn,
    other: ComparedColumn,
    tolerance: Tolerance | None = None,
    window: ComparedWindow = EVERYTHING,
) -> ComparedChannel:
    """Compare a column with its reference, in the unit of the other one.

    Angles are compared modulo the full turns by which both begin apart.

    Arguments:
        name: of the channel.
        reference, other: curves, or numbers; the unit of a number may be None, which is then that of the other.
        tolerance: by how much they may differ; None: there is no verdict.
        window: what is compared of curves.

    Raises InputError if a curve stands against a number, if the curves do not overlap, or if units do not fit.
    """
    if bool(other.time.size) != bool(reference.time.size):
        raise InputError(f"{name}: is a curve beside a number; allowed: curves with curves")
    unit = other.unit if other.unit is not None else reference.unit or ""
    reference = _in_unit(name, reference, unit)
    if other.time.size:
        curves = reference.time, reference.values, other.time, other.values
        common = on_common_times(*curves, window.after, window.until)
        errors = summed(errors_at(common.time, reference), errors_at(common.time, other))
    else:
        common = CommonCurves(np.zeros(1), reference.values, other.values, np.zeros(1), 0)
        errors = summed(reference.errors, other.errors)
    if unit == ANGLE and other.time.size:
        common = common._replace(other=common.other - _turns_apart(common))
    errors = errors + common.interpolation_error
    before = common.time < window.horizon
    _, mine, its = common.part(~before)
    size = extent(common.reference) if other.time.size else abs(float(reference.values[0]))
    return ComparedChannel(
        name,
        unit,
        common,
        errors,
        int(before.sum()),
        curve_measures(*common.part(before)),
        _means(common, errors, unit),
        compared_statistics(mine, its, window.among),
        tolerance,
        math.nan if tolerance is None else tolerance.in_si(name, unit, size),
    )


def _in_unit(name: str, column: ComparedColumn, unit: str) -> ComparedColumn:
    """A column in another unit; a number without a unit is in that unit."""
    if column.unit == unit or (column.unit is None and not column.time.size):
        return column
    zero, one = converted(NamedSeries(name, column.unit, np.zeros(2), np.array([0.0, 1.0])), unit)
    scale = one - zero
    return ComparedColumn(unit, column.time, zero + scale * column.values, abs(scale) * column.errors)


def _turns_apart(common: CommonCurves) -> float:
    """The full turns [rad] by which an angle begins apart from its reference; 0 without overlap."""
    apart = common.other - common.reference
    known = apart[np.isfinite(apart)]
    return TURN * round(float(known[0]) / TURN) if known.size else 0.0


def _means(common: CommonCurves, errors: Values, unit: str) -> tuple[Estimate, Estimate, Estimate]:
    """Means over time by straight lines between the common times, with the mean of the errors."""
    measures = curve_measures(common.time, common.reference, common.other)
    error = curve_measures(common.time, np.zeros(errors.size), errors).mean_other
    error = math.inf if np.isinf(errors).any() else error
    means = measures.mean_reference, measures.mean_other, measures.mean_difference
    first, second, apart = (Estimate(mean, error, unit) for mean in means)
    return first, second, apart
