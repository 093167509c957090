"""A channel against its reference: both columns joined in time, then rows of measures, errors and verdicts."""

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
from support_exudyn.postprocessing.figures.units import amount
from support_exudyn.simulation.estimate import Estimate
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
Verdict = Literal["differs", "not decided", "not comparable", "differs within tolerance", "agrees"]
WORST_FIRST: tuple[Verdict, ...] = (
    "differs", "not decided", "differs within tolerance", "agrees", "not comparable",
)  # fmt: skip
FAILED: tuple[Verdict, ...] = ("differs", "not decided")  # if there is a tolerance
LARGEST = "largest"  # the measure that is judged
ANGLE, TURN = "rad", 2.0 * math.pi
LEFT_OF_A_TURN = 1e-6  # share by which a file's digits may leave the range of a wrapped angle
ROUNDING = 1e-9  # share of what is allowed: 1.1 - 1.0 is 0.1, in whatever digits
CERTAIN = 10.0  # times the numerical errors from which on a difference is certain: errors are estimates


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


class ComparedRow(NamedTuple):
    """A line of a comparison: a measure of a channel, in SI; NaN where a number is not known.

    measure: its name. time: of it [s], NaN of a measure of the whole curve. reference, other: of both sides.
    error: of the difference. tolerance: what is allowed. verdict: None of a measure that is not judged.
    reason: of the verdict, a sentence.
    """

    channel: str
    unit: str
    measure: str
    time: float = math.nan
    reference: float = math.nan
    other: float = math.nan
    difference: float = math.nan
    error: float = math.nan
    tolerance: float = math.nan
    verdict: Verdict | None = None
    reason: str = ""


def worst(verdicts: Iterable[Verdict | None]) -> Verdict:
    """The verdict on all: the worst of those on each; "not comparable" if there is none."""
    each = set(verdicts)
    return next((verdict for verdict in WORST_FIRST if verdict in each), "not comparable")


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
    def _largest_at(self) -> int:
        return int(np.searchsorted(self.common.time, self.measures.largest_time))

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
    def gaps(self) -> int:
        """Number of times at which the other curve is not known and the reference is."""
        return int(np.count_nonzero(np.isfinite(self.common.reference) & ~np.isfinite(self.common.other)))

    @cached_property
    def rows(self) -> tuple[ComparedRow, ...]:
        """The rows of the channel: a tolerance bounds the largest difference, after the horizon statistics.

        A percentage is not judged, nor is the mean. Without a tolerance the numerical errors decide.
        """
        measures, (reference, other, mean) = self.measures, self.means
        rows = [
            ComparedRow(
                self.name, self.unit, "mean", math.nan, reference.value, other.value, mean.value, mean.error
            ),
            self._largest_row(),
            ComparedRow(self.name, PERCENT, "RMS/range", difference=100.0 * measures.rms_of_range),
            ComparedRow(self.name, PERCENT, "C", difference=100.0 * measures.combined_error),
        ]
        for name, each in self.statistics.items():
            plain = ComparedRow(
                self.name, self.unit, f"{name} after the horizon", math.nan, *each, self.allowed
            )
            if self.tolerance is not None:
                rows.append(self._judged(plain, bool(each.equal)))
            elif each.equal is not None:
                rows.append(plain._replace(verdict="agrees" if each.equal else "differs"))
        return tuple(rows)

    def _largest_row(self) -> ComparedRow:
        """The largest difference before the horizon, with its verdict.

        Where numerical errors decide, the reason of the verdict is that of the record with the largest multiple
        of its error. Curves that are the same to the bit have the same errors, whatever these are.
        """
        row, common = ComparedRow(self.name, self.unit, LARGEST, tolerance=self.allowed), self.common
        unknown = math.isnan(self.measures.largest)
        if self.gaps:
            reason = f"not decided: no value at {self.gaps} times at which the reference has a value"
            row = row._replace(verdict="not decided", reason=reason)
        elif unknown and not self.statistics:
            row = row._replace(verdict="not decided", reason="not decided: there are no two common values")
        if unknown:
            return row
        row = self._at(row, self._largest_at)
        if row.verdict:
            return row
        if np.array_equal(common.reference, common.other, equal_nan=True):
            return row._replace(verdict="agrees", reason="is the same")
        decides = self._largest_at
        if (self.tolerance is None or self.tolerance.is_errors) and self.over_errors > 1.0:
            decides = int(self._multiples.argmax())
        judged = self._judged(
            self._at(row, decides), self.over_errors <= 1.0, float(common.interpolation_error[decides])
        )
        return row._replace(verdict=judged.verdict, reason=judged.reason)

    def _at(self, row: ComparedRow, place: int) -> ComparedRow:
        """A row with the values at a place among the common times."""
        common = self.common
        return row._replace(
            time=float(common.time[place]) if common.time.size > 1 else math.nan,
            reference=float(common.reference[place]),
            other=float(common.other[place]),
            difference=float(common.difference[place]),
            error=float(self.errors[place]),
        )

    def _judged(self, row: ComparedRow, agrees: bool, interpolation: float = math.nan) -> ComparedRow:
        """A row with its verdict and the reason, by the tolerance, or by the numerical errors.

        Not decided is a difference that is not known, or whose error is not known, or is larger than what is
        allowed and could turn the answer.

        agrees: whether the numerical errors explain the difference. interpolation: the error where that of the
        row is not known.
        """
        times, rule, apart = self.over_errors, self.tolerance, abs(row.difference)
        error = interpolation if math.isnan(row.error) else row.error
        known = f"the numerical error of {amount(error, row.unit, 2)}"
        verdict: Verdict = "differs"
        if rule is None or rule.is_errors:
            because = f"more than {known}"
            if math.isnan(times):
                verdict, because = "not decided" if rule else "differs", "and no numerical error is known"
            elif rule is None and times < CERTAIN:
                verdict, because = (
                    "not decided",
                    f"{because}, but less than {CERTAIN:g} times, so not certainly",
                )
        else:
            bound = f"the tolerance of {amount(row.tolerance, row.unit, 4)} ({rule.text})"
            because = f"more than {bound}"
            unsure = error > row.tolerance and apart - error <= row.tolerance
            if math.isnan(apart) or not math.isfinite(error) or unsure:
                known = known if math.isfinite(error) else "an unknown numerical error"
                verdict, because = "not decided", f"not decided by {bound} with {known}"
            elif apart <= row.tolerance * (1.0 + ROUNDING):
                verdict, because = "differs within tolerance", f"not {because}"
        if agrees and (rule is None or rule.is_errors or verdict == "differs within tolerance"):
            verdict, because = "agrees", f"within {known}"
        at = f" at {row.time:.6g} s" if math.isfinite(row.time) else ""
        what = "" if row.measure == LARGEST else f"the {row.measure} is "
        reason = (
            f"{what}{row.other:.9g} {row.unit}{at}, where the reference is {row.reference:.9g}, differs by "
            f"{amount(apart, row.unit, 4)}, {because}"
        )
        if rule is not None and rule.unit == PERCENT and not row.tolerance:
            reason += "; the reference is constant: give an amount with its unit"
        return row._replace(verdict=verdict, reason=reason)

    @property
    def verdict(self) -> Verdict:
        """The worst verdict of the rows."""
        return worst(row.verdict for row in self.rows)

    @property
    def faults(self) -> list[str]:
        """Why a channel is not within its tolerance, or not decided: a sentence a row, the worst first."""
        bad = [row for row in self.rows if row.verdict in FAILED] if self.tolerance is not None else []
        bad.sort(key=lambda row: FAILED.index(row.verdict or "differs"))
        return [f"{self.name}: {row.reason}" for row in bad]


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
        tolerance: by how much they may differ; None: the numerical errors decide.
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
        apart = common.difference[np.isfinite(common.difference)]
        if unit == ANGLE and apart.size:
            common = common._replace(other=common.other - TURN * round(float(apart[0]) / TURN))
    else:
        common = CommonCurves(np.zeros(1), reference.values, other.values, np.zeros(1))
        extent = abs(float(reference.values[0]))
    mine, its = reference.errors_at(common.time), other.errors_at(common.time)
    unknown = np.isnan(mine) & np.isnan(its)
    errors = np.where(
        unknown, math.nan, np.nan_to_num(mine, posinf=math.inf) + np.nan_to_num(its, posinf=math.inf)
    )
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


def _means(common: CommonCurves, errors: Values, unit: str) -> tuple[Estimate, Estimate, Estimate]:
    """Means over time by straight lines between the common times, with the mean of the errors."""
    measures = curve_measures(common.time, common.reference, common.other)
    error = curve_measures(common.time, np.zeros(errors.size), errors).mean_other
    error = math.inf if np.isinf(errors).any() else error
    means = measures.mean_reference, measures.mean_other, measures.mean_difference
    first, second, apart = (Estimate(mean, error, unit) for mean in means)
    return first, second, apart
