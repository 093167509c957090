"""A channel against its reference: both columns joined in time, with measures, errors and a verdict."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.files.series.named_series import NamedSeries
from support_exudyn.files.series.units import converted
from support_exudyn.postprocessing.comparing.mapping import PERCENT, Tolerance
from support_exudyn.postprocessing.comparing.measures import (
    CommonCurves,
    CurveMeasures,
    StatisticDifference,
    compared_statistics,
    curve_measures,
    on_common_times,
)
from support_exudyn.postprocessing.figures.selection import CLEARANCE
from support_exudyn.postprocessing.figures.units import said
from support_exudyn.simulation.estimate import Estimate
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
Verdict = Literal["within", "not within", "not decided", "no tolerance"]
WORST_FIRST: tuple[Verdict, ...] = ("not within", "not decided", "within", "no tolerance")
ANGLE, TURN = "rad", 2.0 * math.pi
LEFT_OF_A_TURN = 1e-6  # share by which a file's digits may leave the range of a wrapped angle
ROUNDING = 1e-9  # share of what is allowed: 1.1 - 1.0 is 0.1, in whatever digits


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
        return column._replace(unit=unit, values=_unwrapped(column.values) if unit == ANGLE else column.values)

    def errors_at(self, at: Values) -> Values:
        """Errors at other times [s], (m,): those of the next record, as errors grow with time."""
        if not self.time.size:
            return self.errors
        return self.errors[np.minimum(np.searchsorted(self.time, at - CLEARANCE), self.time.size - 1)]


def _unwrapped(angle: Values) -> Values:
    """A continuous angle [rad] from one that was wrapped into a single turn; others stay as they are.

    An angle was wrapped if all values lie within a turn and neighbours are more than half a turn apart.
    """
    known = np.isfinite(angle)
    values = angle[known]
    jumps = np.abs(np.diff(values)).max(initial=0.0) > 0.5 * TURN
    if not jumps or np.ptp(values) > (1.0 + LEFT_OF_A_TURN) * TURN:
        return angle
    continuous = angle.copy()
    continuous[known] = np.unwrap(values)
    return continuous


def decide(value: float, error: float, allowed: float) -> Verdict:
    """Whether the magnitude of a difference is within what is allowed.

    It is not decided if the error of the difference is larger than what is allowed and could turn the answer,
    or if a difference or its error is not known: NaN, or infinite.
    """
    unsure = error > allowed and value - error <= allowed
    if math.isnan(value) or not math.isfinite(error) or unsure:
        return "not decided"
    return "within" if value <= allowed * (1.0 + ROUNDING) else "not within"


def worst(verdicts: Iterable[Verdict]) -> Verdict:
    """The verdict on all: the worst of those on each."""
    each = set(verdicts)
    return next((verdict for verdict in WORST_FIRST if verdict in each), "no tolerance")


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

    @cached_property
    def _multiples(self) -> Values:
        """The difference over its error at each time before the horizon, (n,); -1 where no error is known."""
        apart, errors = np.abs(self.common.difference[: self.before]), self.errors[: self.before]
        ratios = np.divide(apart, errors, out=np.where(apart > 0.0, math.inf, 0.0), where=errors > 0.0)
        return np.where(np.isfinite(errors) & np.isfinite(apart), ratios, -1.0)

    @property
    def over_errors(self) -> float:
        """The largest multiple of the numerical error by which the curves differ; NaN if no error is known."""
        largest = float(self._multiples.max(initial=-1.0))
        return largest if largest >= 0.0 else math.nan

    @property
    def _largest_at(self) -> int:
        return int(np.searchsorted(self.common.time, self.measures.largest_time))

    @property
    def gaps(self) -> int:
        """Number of times at which the other curve is not known and the reference is."""
        return int(np.count_nonzero(np.isfinite(self.common.reference) & ~np.isfinite(self.common.other)))

    @cached_property
    def judged(self) -> tuple[tuple[Verdict, str], ...]:
        """The verdict on each number that a tolerance bounds, with a sentence; empty without a tolerance.

        They are the largest difference before the horizon, and statistics after it. With the errors as
        tolerance it is the record with the largest multiple of its error. Curves that are the same to the bit
        have the same errors, whatever these are. Without numerical errors that of interpolation counts.
        """
        value, error, _ = self.largest
        if self.tolerance is None:
            return ()
        if self.gaps:
            text = f"not decided: no value at {self.gaps} times at which the reference has a value"
            return (("not decided", text),)
        if np.array_equal(self.common.reference, self.common.other, equal_nan=True):
            return (("within", ""),)
        judged = []
        if math.isfinite(value):
            at, allowed = self._largest_at, self.allowed
            if not self.tolerance.is_errors:
                error = float(self.common.interpolation_error[at]) if math.isnan(error) else error
            elif math.isnan(self.over_errors):
                error, allowed = math.nan, 0.0
            else:
                at = int(self._multiples.argmax())
                value, error, allowed = abs(float(self.common.difference[at])), 0.0, float(self.errors[at])
            when = f" at {self.common.time[at]:.6g} s" if self.common.time.size > 1 else ""
            now, was = self.common.other[at], self.common.reference[at]
            what = f"{now:.9g} {self.unit}{when}, where the reference is {was:.9g},"
            judged.append(self._judge(what, value, error, allowed))
        for name, each in self.statistics.items():
            what = f"the {name} after the horizon"
            judged.append(self._judge(what, abs(each.difference), each.half, self.allowed))
        return tuple(judged)

    def _judge(self, what: str, value: float, error: float, allowed: float) -> tuple[Verdict, str]:
        """The verdict on a difference, and a sentence on it."""
        verdict = decide(value, error, allowed)
        rule = "" if self.tolerance is None else self.tolerance.text
        text = f"{what} differs by {said(value, self.unit, 4)}; allowed: {said(allowed, self.unit, 4)} ({rule})"
        if verdict == "not decided":
            known = said(error, self.unit, 2) if math.isfinite(error) else "not known"
            text += f"; not decided, its error is {known}: a finer accuracy may decide"
        if not allowed and rule.endswith(PERCENT):
            text += "; the reference is constant: give an amount with its unit"
        return verdict, text

    @property
    def verdict(self) -> Verdict:
        """Whether the channel is within its tolerance; "not decided" if there is nothing to judge by."""
        if self.tolerance is None:
            return "no tolerance"
        return worst(verdict for verdict, _ in self.judged) if self.judged else "not decided"

    @property
    def faults(self) -> list[str]:
        """Why a channel is not within its tolerance, or not decided: a sentence a number, the worst first."""
        if self.tolerance is not None and not self.judged:
            return [f"{self.name}: not decided: there are no two common values"]
        bad = [each for each in self.judged if each[0] != "within"]
        return [f"{self.name}: {text}" for _, text in sorted(bad, key=lambda each: WORST_FIRST.index(each[0]))]


def compared(
    name: str,
    reference: ComparedColumn,
    other: ComparedColumn,
    tolerance: Tolerance | None = None,
    *,
    unit: str | None = None,
    after: float = -math.inf,
    until: float = math.inf,
    horizon: float = math.inf,
    among: int = 1,
) -> ComparedChannel:
    """Compare a column with its reference.

    Angles are compared modulo the full turns by which both begin apart.

    Arguments:
        name: of the channel.
        reference, other: curves, or numbers; the unit of a number may be None, which is then that of the other.
        tolerance: by how much they may differ; None: there is no verdict.
        unit: of the comparison; None: that of the other column.
        after, until: the part of curves that is compared [s].
        horizon: from when on curves are compared by their statistics [s]; infinite: never.
        among: how many statistics are reported together.

    Raises InputError if a curve stands against a number, if the curves do not overlap, or if units do not fit.
    """
    if bool(other.time.size) != bool(reference.time.size):
        raise InputError(f"{name}: a curve cannot be compared with a number; allowed: curves with curves")
    if unit is None:
        unit = other.unit if other.unit is not None else reference.unit or ""
    reference, other = reference.in_unit(unit, name), other.in_unit(unit, name)
    if other.time.size:
        curves = reference.time, reference.values, other.time, other.values
        common = on_common_times(*curves, after, until)
        known = common.reference[np.isfinite(common.reference)]
        extent = float(np.ptp(known)) if known.size else 0.0
    else:
        common = CommonCurves(np.zeros(1), reference.values, other.values, np.zeros(1))
        extent = abs(float(reference.values[0]))
    if unit == ANGLE and other.time.size:
        common = common._replace(other=common.other - _turns_apart(common))
    errors = _summed(reference.errors_at(common.time), other.errors_at(common.time))
    errors = errors + common.interpolation_error
    before = common.time < horizon
    return ComparedChannel(
        name,
        unit,
        common,
        errors,
        int(before.sum()),
        curve_measures(common.time[before], common.reference[before], common.other[before]),
        _means(common, errors, unit),
        compared_statistics(common.reference[~before], common.other[~before], among),
        tolerance,
        math.nan if tolerance is None else tolerance.in_si(name, unit, extent),
    )


def _summed(first: Values, second: Values) -> Values:
    """The errors of a difference, (n,): the sum of both sides; an unknown error, NaN, is left out."""
    return np.where(np.isnan(first), second, np.where(np.isnan(second), first, first + second))


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
