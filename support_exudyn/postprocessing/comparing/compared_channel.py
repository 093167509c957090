"""A channel against its reference: both columns joined in time, then rows of measures, errors and verdicts."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
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
FAILED: tuple[Verdict, ...] = WORST_FIRST[:2]  # if there is a tolerance
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
        """A number."""
        return cls(unit, np.zeros(0), np.array([number.value]), np.array([number.error]))

    @classmethod
    def of_series(cls, series: NamedSeries) -> ComparedColumn:
        """A series, whose errors are not known."""
        return cls(series.unit, series.time, series.values, np.full(series.time.size, math.nan))

    def in_unit(self, unit: str, name: str) -> ComparedColumn:
        """The column in another unit; a number without a unit is in that unit. Wrapped angles are unwrapped.

        Raises InputError if the column's own unit is not known or of another kind.
        """
        values, errors = self.values, self.errors
        if self.unit != unit and not (self.unit is None and not self.time.size):
            zero, one = converted(NamedSeries(name, self.unit, np.zeros(2), np.array([0.0, 1.0])), unit)
            values, errors = zero + (one - zero) * values, abs(one - zero) * errors
        return ComparedColumn(unit, self.time, _unwrapped(values) if unit == ANGLE else values, errors)

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
    jumps = np.abs(np.diff(angle[known])).max(initial=0.0) > 0.5 * TURN
    if not jumps or np.ptp(angle[known]) > (1.0 + LEFT_OF_A_TURN) * TURN:
        return angle
    continuous = angle.copy()
    continuous[known] = np.unwrap(angle[known])
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
    statistics: from the horizon on, by their names; empty if there is none, or if nothing lies behind it.
    over_errors: largest multiple of the numerical error by which the curves differ; NaN if none is known.
    gaps: number of times at which the other curve is not known and the reference is.
    tolerance, allowed: the tolerance, and its amount; None and NaN without one.
    rows: those of the table: the mean, the largest difference, shares, statistics.
    """

    name: str
    unit: str
    common: CommonCurves
    errors: Values
    before: int
    measures: CurveMeasures
    statistics: Mapping[str, StatisticDifference]
    over_errors: float
    gaps: int
    tolerance: Tolerance | None
    allowed: float
    rows: tuple[ComparedRow, ...] = ()

    @property
    def mean(self) -> Estimate:
        """The mean of the difference."""
        return Estimate(self.rows[0].difference, self.rows[0].error, self.unit)

    @property
    def largest(self) -> Estimate:
        """Magnitude of the largest difference before the horizon with its error; NaN if nothing lies before."""
        return Estimate(abs(self.rows[1].difference), self.rows[1].error, self.unit)

    @property
    def verdict(self) -> Verdict:
        """The worst verdict of the rows."""
        return worst(row.verdict for row in self.rows)

    @property
    def faults(self) -> list[str]:
        """Why a channel is not within its tolerance, or not decided: a sentence a row, the worst first."""
        rows = self.rows if self.tolerance is not None else ()
        return [f"{self.name}: {row.reason}" for bad in FAILED for row in rows if row.verdict == bad]


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
    """Compare a column with its reference; angles modulo the full turns by which both begin apart.

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
        common = on_common_times(reference.time, reference.values, other.time, other.values, after, until)
        known = common.reference[np.isfinite(common.reference)]
        extent = float(np.ptp(known)) if known.size else 0.0
        apart = common.difference[np.isfinite(common.difference)]
        if unit == ANGLE and apart.size:
            common = common._replace(other=common.other - TURN * round(float(apart[0]) / TURN))
    else:
        common = CommonCurves(np.zeros(1), reference.values, other.values, np.zeros(1))
        extent = abs(float(reference.values[0]))
    both = np.array([column.errors_at(common.time) for column in (reference, other)])
    errors = np.where(np.isnan(both).all(axis=0), math.nan, np.nan_to_num(both, posinf=math.inf).sum(axis=0))
    errors = errors + common.interpolation_error
    early = common.time < horizon
    multiples = _multiples(common.difference, errors)[early]
    channel = ComparedChannel(
        name=name,
        unit=unit,
        common=common,
        errors=errors,
        before=int(early.sum()),
        measures=curve_measures(common.time[early], common.reference[early], common.other[early]),
        statistics=compared_statistics(common.reference[~early], common.other[~early], among),
        over_errors=float(multiples.max()) if multiples.max(initial=-1.0) >= 0.0 else math.nan,
        gaps=int(np.count_nonzero(np.isfinite(common.reference) & ~np.isfinite(common.other))),
        tolerance=tolerance,
        allowed=math.nan if tolerance is None else tolerance.in_si(name, unit, extent),
    )
    return replace(channel, rows=_rows(channel))


def _multiples(difference: Values, errors: Values) -> Values:
    """Differences over their errors, (n,); -1 where no error is known."""
    apart = np.abs(difference)
    ratios = np.divide(apart, errors, out=np.where(apart > 0.0, math.inf, 0.0), where=errors > 0.0)
    return np.where(np.isfinite(errors) & np.isfinite(apart), ratios, -1.0)


# --- rows and verdicts ---


def _rows(channel: ComparedChannel) -> tuple[ComparedRow, ...]:
    """The rows of a channel: a tolerance bounds the largest difference, after the horizon statistics.

    A percentage is not judged, nor is the mean. Without a tolerance the numerical errors decide.
    """
    name, unit, common = channel.name, channel.unit, channel.common
    whole = curve_measures(common.time, common.reference, common.other)
    error = curve_measures(common.time, np.zeros(channel.errors.size), channel.errors).mean_other
    error = math.inf if np.isinf(channel.errors).any() else error
    means = whole.mean_reference, whole.mean_other, whole.mean_difference
    measures = channel.measures
    rows = [
        ComparedRow(name, unit, "mean", math.nan, *means, error),
        _largest(channel),
        ComparedRow(name, PERCENT, "RMS/range", difference=100.0 * measures.rms_of_range),
        ComparedRow(name, PERCENT, "C", difference=100.0 * measures.combined_error),
    ]
    for statistic, each in channel.statistics.items():
        row = ComparedRow(name, unit, f"{statistic} after the horizon", math.nan, *each, channel.allowed)
        if channel.tolerance is not None:
            row = _judged(channel, row, bool(each.equal), row.error)
        elif each.equal is not None:
            row = row._replace(verdict="agrees" if each.equal else "differs")
        rows.append(row)
    return tuple(rows)


def _largest(channel: ComparedChannel) -> ComparedRow:
    """The row of the largest difference before the horizon, with its verdict.

    Where numerical errors decide, the reason of the verdict is that of the record with the largest multiple
    of its error. Curves that are the same to the bit have the same errors, whatever these are.
    """
    common, rule = channel.common, channel.tolerance
    shown = ComparedRow(channel.name, channel.unit, LARGEST, tolerance=channel.allowed)
    if channel.gaps:
        reason = f"not decided: no value at {channel.gaps} times at which the reference has a value"
        shown = shown._replace(verdict="not decided", reason=reason)
    if math.isnan(channel.measures.largest):
        if channel.gaps or channel.statistics:
            return shown
        return shown._replace(verdict="not decided", reason="not decided: there are no two common values")

    def at(place: int) -> ComparedRow:
        time = float(common.time[place]) if common.time.size > 1 else math.nan
        numbers = common.reference, common.other, common.difference, channel.errors
        mine, its, apart, error = (float(each[place]) for each in numbers)
        return shown._replace(time=time, reference=mine, other=its, difference=apart, error=error)

    place = int(np.searchsorted(common.time, channel.measures.largest_time))
    shown = at(place)
    if channel.gaps:
        return shown
    if np.array_equal(common.reference, common.other, equal_nan=True):
        return shown._replace(verdict="agrees", reason="is the same")
    if (rule is None or rule.is_errors) and channel.over_errors > 1.0:
        place = int(_multiples(common.difference, channel.errors)[: channel.before].argmax())
    row = at(place)
    error = float(common.interpolation_error[place]) if math.isnan(row.error) else row.error
    judged = _judged(channel, row, channel.over_errors <= 1.0, error)
    return shown._replace(verdict=judged.verdict, reason=judged.reason)


def _judged(channel: ComparedChannel, row: ComparedRow, explained: bool, error: float) -> ComparedRow:
    """A row with its verdict and the reason, by the tolerance, or by the numerical errors.

    Not decided is a difference that is not known, or whose error is not known, or is larger than what is
    allowed and could turn the answer.

    explained: whether the numerical errors explain the difference. error: of the difference, known or assumed.
    """
    rule, apart, allowed = channel.tolerance, abs(row.difference), row.tolerance
    known = f"the numerical error of {amount(error, row.unit, 2)}"
    verdict: Verdict = "differs"
    if rule is None or rule.is_errors:
        because = f"more than {known}"
        if explained:
            verdict = "agrees"
        elif math.isnan(channel.over_errors):
            verdict, because = "not decided" if rule else "differs", "and no numerical error is known"
        elif rule is None and channel.over_errors < CERTAIN:
            verdict, because = "not decided", f"{because}, but by less than {CERTAIN:g} times: not certain"
    else:
        bound = f"the tolerance of {amount(allowed, row.unit, 4)} ({rule.text})"
        because = f"more than {bound}"
        unsure = error > allowed and apart - error <= allowed
        if math.isnan(apart) or not math.isfinite(error) or unsure:
            known = known if math.isfinite(error) else "an unknown numerical error"
            verdict, because = "not decided", f"not decided by {bound} with {known}"
        elif apart <= allowed * (1.0 + ROUNDING):
            verdict, because = "agrees" if explained else "differs within tolerance", f"not {because}"
    because = f"within {known}" if verdict == "agrees" else because
    at = f" at {row.time:.6g} s" if math.isfinite(row.time) else ""
    what = "" if row.measure == LARGEST else f"the {row.measure} is "
    reason = (
        f"{what}{row.other:.9g} {row.unit}{at}, where the reference is {row.reference:.9g}, differs by "
        f"{amount(apart, row.unit, 4)}, {because}"
    )
    if rule is not None and rule.unit == PERCENT and not allowed:
        reason += "; the reference is constant: give an amount with its unit"
    return row._replace(verdict=verdict, reason=reason)
