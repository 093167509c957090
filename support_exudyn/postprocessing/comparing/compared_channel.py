"""A column against its reference at common times: differences, errors, statistics and a verdict."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.files.series.named_series import NamedSeries
from support_exudyn.files.series.units import converted
from support_exudyn.postprocessing.comparing.measures import (
    CommonCurves,
    CurveMeasures,
    StatisticDifference,
    compared_statistics,
    curve_measures,
    on_common_times,
)
from support_exudyn.postprocessing.comparing.tolerance import (
    JudgedDifference,
    Tolerance,
    ToleranceVerdict,
    worst,
)
from support_exudyn.postprocessing.figures.selection import CLEARANCE
from support_exudyn.simulation.estimate import Estimate
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
LARGEST = "largest difference"
GAPS = "values that are missing"
ANGLE, TURN = "rad", 2.0 * math.pi
ROUNDING = 1e-6  # of a turn, by which a file's digits may leave the range of a wrapped angle


class ComparedColumn(NamedTuple):
    """A curve at times [s] (n,), with values and errors (n,); a number has no times and a single value.

    unit: of all but the times; None: not known. An error that is NaN is not known.
    """

    unit: str | None
    time: Values
    values: Values
    errors: Values

    @classmethod
    def of_number(cls, number: Estimate, unit: str | None) -> ComparedColumn:
        """A number as a column of a single value."""
        return cls(unit, np.zeros(0), np.array([number.value]), np.array([number.error]))

    @classmethod
    def of_series(cls, series: NamedSeries) -> ComparedColumn:
        """A series, whose errors are not known."""
        return cls(series.unit, series.time, series.values, np.full(series.time.size, math.nan))

    def in_unit(self, unit: str, name: str) -> ComparedColumn:
        """The column in another unit; a number without a unit is in that unit. Wrapped angles are unwrapped.

        Raises InputError if the column's own unit is not known or of another kind.
        """
        column = self
        if self.unit != unit and not (self.unit is None and not self.time.size):
            zero, one = converted(NamedSeries(name, self.unit, np.zeros(2), np.array([0.0, 1.0])), unit)
            scale = one - zero
            column = self._replace(values=zero + scale * self.values, errors=abs(scale) * self.errors)
        values = unwrapped(column.values) if unit == ANGLE else column.values
        return column._replace(unit=unit, values=values)


def unwrapped(angle: Values) -> Values:
    """A continuous angle [rad] from one that was wrapped into a single turn; others stay as they are.

    An angle was wrapped if all values lie within a turn and neighbours are more than half a turn apart.
    """
    known = np.isfinite(angle)
    values = angle[known]
    jumps = np.abs(np.diff(values)).max(initial=0.0) > 0.5 * TURN
    if not jumps or np.ptp(values) > (1.0 + ROUNDING) * TURN:
        return angle
    continuous = angle.copy()
    continuous[known] = np.unwrap(values)
    return continuous


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
        """The difference at the record with the largest multiple of its error; no tolerance without errors."""
        where = self._farthest
        if where is None:
            return JudgedDifference(LARGEST, math.nan, 0.0, math.nan)
        apart = abs(float(self.common.difference[where]))
        return JudgedDifference(LARGEST, apart, 0.0, float(self.errors[where]))

    @property
    def record(self) -> int:
        """Index of the record that decides: the farthest beyond its error, or the largest difference."""
        by_errors = self.tolerance is not None and self.tolerance.is_errors
        return self._farthest if by_errors and self._farthest is not None else self._largest_at

    @cached_property
    def _farthest(self) -> int | None:
        """Index of the record with the largest multiple of its error; None: no error is known."""
        apart, errors = np.abs(self.common.difference[: self.before]), self.errors[: self.before]
        known = np.isfinite(errors) & np.isfinite(apart)
        ratios = np.divide(apart, errors, out=np.where(apart > 0.0, math.inf, 0.0), where=errors > 0.0)
        return int(np.where(known, ratios, -1.0).argmax()) if known.any() else None

    @property
    def _largest_at(self) -> int:
        return int(np.searchsorted(self.common.time, self.measures.largest_time))

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
            found.append((LARGEST, value, error))
        found += [(name, abs(one.difference), one.half) for name, one in self.statistics.items()]
        return tuple(
            JudgedDifference(name, value, error if math.isfinite(error) else math.inf, self.allowed)
            for name, value, error in found
        )

    @property
    def verdict(self) -> ToleranceVerdict:
        """Whether the channel is within its tolerance; "not decided" if there is nothing to judge by."""
        if self.tolerance is None:
            return "no tolerance"
        return worst(judged.verdict for judged in self.judged) if self.judged else "not decided"


def compared(
    name: str,
    reference: ComparedColumn,
    other: ComparedColumn,
    tolerance: Tolerance | None = None,
    window: ComparedWindow = EVERYTHING,
    unit: str | None = None,
) -> ComparedChannel:
    """Compare a column with its reference.

    Angles are compared modulo the full turns by which both begin apart.

    Arguments:
        name: of the channel.
        reference, other: curves, or numbers; the unit of a number may be None, which is then that of the other.
        tolerance: by how much they may differ; None: there is no verdict.
        window: what is compared of curves.
        unit: of the comparison; None: that of the other column.

    Raises InputError if a curve stands against a number, if the curves do not overlap, or if units do not fit.
    """
    if bool(other.time.size) != bool(reference.time.size):
        raise InputError(f"{name}: is a curve beside a number; allowed: curves with curves")
    if unit is None:
        unit = other.unit if other.unit is not None else reference.unit or ""
    reference, other = reference.in_unit(unit, name), other.in_unit(unit, name)
    if other.time.size:
        curves = reference.time, reference.values, other.time, other.values
        common = on_common_times(*curves, window.after, window.until)
        errors = _summed(_errors_at(common.time, reference), _errors_at(common.time, other))
        size = float(np.ptp(common.reference[np.isfinite(common.reference)])) if _known(common) else 0.0
    else:
        common = CommonCurves(np.zeros(1), reference.values, other.values, np.zeros(1), 0)
        errors = _summed(reference.errors, other.errors)
        size = abs(float(reference.values[0]))
    if unit == ANGLE and other.time.size:
        common = common._replace(other=common.other - _turns_apart(common))
    errors = errors + common.interpolation_error
    before = common.time < window.horizon
    return ComparedChannel(
        name,
        unit,
        common,
        errors,
        int(before.sum()),
        curve_measures(common.time[before], common.reference[before], common.other[before]),
        _means(common, errors, unit),
        compared_statistics(common.reference[~before], common.other[~before], window.among),
        tolerance,
        math.nan if tolerance is None else tolerance.in_si(name, unit, size),
    )


def _errors_at(at: Values, column: ComparedColumn) -> Values:
    """Errors of a curve at other times [s], (m,): those of the next record, as errors grow with time."""
    return column.errors[np.minimum(np.searchsorted(column.time, at - CLEARANCE), column.time.size - 1)]


def _summed(first: Values, second: Values) -> Values:
    """The errors of a difference, (n,): the sum of both sides; an unknown error, NaN, is left out."""
    return np.where(np.isnan(first), second, np.where(np.isnan(second), first, first + second))


def _known(common: CommonCurves) -> bool:
    return bool(np.isfinite(common.reference).any())


def _turns_apart(common: CommonCurves) -> float:
    """The full turns [rad] by which an angle begins apart from its reference; 0 without overlap."""
    known = common.difference[np.isfinite(common.difference)]
    return TURN * round(float(known[0]) / TURN) if known.size else 0.0


def _means(common: CommonCurves, errors: Values, unit: str) -> tuple[Estimate, Estimate, Estimate]:
    """Means over time by straight lines between the common times, with the mean of the errors."""
    measures = curve_measures(common.time, common.reference, common.other)
    error = curve_measures(common.time, np.zeros(errors.size), errors).mean_other
    error = math.inf if np.isinf(errors).any() else error
    means = measures.mean_reference, measures.mean_other, measures.mean_difference
    first, second, apart = (Estimate(mean, error, unit) for mean in means)
    return first, second, apart
