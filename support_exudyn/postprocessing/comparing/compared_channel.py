"""A channel of a file against the same of the reference: differences, errors, statistics and a verdict."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.postprocessing.comparing.common_times import CommonCurves, on_common_times
from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from support_exudyn.postprocessing.comparing.mapping import Tolerance
from support_exudyn.postprocessing.comparing.measures import CurveMeasures, curve_measures
from support_exudyn.postprocessing.comparing.statistics import StatisticDifference, compared_statistics
from support_exudyn.postprocessing.comparing.with_errors import errors_at
from support_exudyn.simulation.estimate import Estimate
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
ToleranceVerdict = Literal["within", "not within", "not decided", "told"]
WORST_FIRST: tuple[ToleranceVerdict, ...] = ("not within", "not decided", "within", "told")
ROUNDING = 1e-9  # share of what is allowed: 1.1 - 1.0 is 0.1, in whatever digits
LARGEST = "largest difference"
GAPS = "values that are missing"


class JudgedDifference(NamedTuple):
    """A difference against what is allowed.

    what: of which number, such as "largest difference". value: magnitude of the difference. error: by how much
    it may be wrong, 0 if nothing is known. allowed: magnitude; NaN: no tolerance is given. All in SI.
    """

    what: str
    value: float
    error: float
    allowed: float

    @property
    def verdict(self) -> ToleranceVerdict:
        """Whether it is allowed, see `verdict_ranks`."""
        return WORST_FIRST[int(verdict_ranks(self.value, self.error, self.allowed))]

    @property
    def ratio(self) -> float:
        """The difference over what is allowed; infinite if nothing is allowed, NaN if one is not known."""
        if self.allowed > 0.0 or math.isnan(self.allowed):
            return self.value / self.allowed
        return math.inf if self.value > 0.0 else 0.0


def beside_errors(difference: float, error: float) -> JudgedDifference:
    """A difference against the error that it may have, the sum of those of both sides; "told" if not known."""
    is_known = math.isfinite(difference) and math.isfinite(error)
    return JudgedDifference(LARGEST, abs(difference), 0.0, error if is_known else math.nan)


def verdict_ranks(
    value: float | Values, error: float | Values, allowed: float | Values
) -> npt.NDArray[np.intp]:
    """Verdicts on differences as places in `WORST_FIRST`, in the shape of the arguments.

    Within, or not; not decided if the error is larger than what is allowed and could turn the answer, or if it
    has no end. A difference that is no number is not decided: it could not be computed. Without a tolerance,
    NaN, it is told.

    Arguments:
        value: magnitudes of differences. error: by how much they may be wrong. allowed: magnitudes.
    """
    value, error, allowed = (np.asarray(item) for item in (value, error, allowed))
    unsure = (error > allowed) & (value - error <= allowed)
    return np.select(
        [np.isnan(allowed), np.isnan(value) | np.isinf(error) | unsure, value <= allowed * (1.0 + ROUNDING)],
        [WORST_FIRST.index("told"), WORST_FIRST.index("not decided"), WORST_FIRST.index("within")],
        WORST_FIRST.index("not within"),
    )


def worst(verdicts: Iterable[ToleranceVerdict]) -> ToleranceVerdict:
    """The verdict on all: the worst of those on each."""
    given = set(verdicts)
    return next((verdict for verdict in WORST_FIRST if verdict in given), "told")


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


@dataclass(frozen=True)
class ComparedChannel:
    """A channel of a file against that of the reference; all in SI.

    name, unit: of the channel. common: both curves at common times.
    errors: numerical errors of the difference at these times, (n,), of the files `with_errors`; NaN if of none.
    before: number of the times that lie before the horizon. measures: of these.
    reference, other, mean: means over the whole window, and that of the difference. largest: magnitude of the
    largest difference before the horizon, with its numerical error; NaN if nothing lies before.
    statistics: from the horizon on, by their names; empty if there is none, or if nothing lies behind it.
    tolerance, allowed: the tolerance, and its amount; None and NaN without a tolerance.
    """

    name: str
    unit: str
    common: CommonCurves
    errors: Values
    with_errors: tuple[str, ...]
    before: int
    measures: CurveMeasures
    reference: Estimate
    other: Estimate
    mean: Estimate
    largest: Estimate
    statistics: Mapping[str, StatisticDifference]
    tolerance: Tolerance | None
    allowed: float

    @property
    def beside_errors(self) -> JudgedDifference:
        """The largest difference against the numerical errors that are known."""
        return beside_errors(self.largest.value, self.largest.error)

    @property
    def where(self) -> int:
        """Index of the time of the largest difference."""
        return int(np.searchsorted(self.common.time, self.measures.largest_time))

    @property
    def largest_of_reference(self) -> float:
        """The largest difference over the reference at its time; NaN if that is zero."""
        if math.isnan(self.measures.largest):
            return math.nan
        there = abs(float(self.common.reference[self.where]))
        return self.largest.value / there if there > 0.0 else math.nan

    @property
    def gaps(self) -> int:
        """Number of times at which the other curve is not known and the reference is."""
        return int(np.count_nonzero(np.isfinite(self.common.reference) & ~np.isfinite(self.common.other)))

    @property
    def judged(self) -> tuple[JudgedDifference, ...]:
        """The differences that are judged: the largest before the horizon, and statistics after it.

        Curves that are the same to the bit have the same errors, whatever these are. Values of the reference
        that the other curve lacks cannot be judged. Of files without runs the error of interpolation counts.
        """
        if np.array_equal(self.common.reference, self.common.other, equal_nan=True):
            return (JudgedDifference(LARGEST, 0.0, 0.0, self.allowed),)
        if self.gaps:
            return (JudgedDifference(GAPS, math.nan, 0.0, self.allowed),)
        judged = []
        if self.before:
            error = self.largest.error
            if math.isnan(error) and math.isfinite(self.measures.largest):
                error = float(self.common.interpolation_error[self.where])
            error = error if math.isfinite(error) else math.inf
            judged.append(JudgedDifference(LARGEST, abs(self.largest.value), error, self.allowed))
        for name, statistic in self.statistics.items():
            known = statistic.tellable if math.isfinite(statistic.tellable) else math.inf
            judged.append(JudgedDifference(name, abs(statistic.difference), known, self.allowed))
        return tuple(judged)

    @property
    def verdict(self) -> ToleranceVerdict:
        """Whether the channel is within its tolerance; "not decided" if there is nothing to judge by."""
        if self.tolerance is None:
            return "told"
        return worst(judged.verdict for judged in self.judged) if self.judged else "not decided"


def compared_channel(
    reference: ComparedFile,
    other: ComparedFile,
    channel: str,
    unit: str,
    window: ComparedWindow,
    tolerance: Tolerance | None = None,
) -> ComparedChannel:
    """Compare a channel.

    Arguments:
        reference, other: the files.
        channel, unit: its name, and the unit in SI in which it is compared.
        window: what is compared.
        tolerance: by how much it may differ; None: there is no verdict.

    Raises InputError if units are not known or of two kinds, or if the curves do not overlap.
    """
    laid = _Laid(reference, other, channel, unit, window)
    common = laid.common(reference, other)
    errors, before = laid.errors(common), common.time < window.horizon
    measures = curve_measures(*common.part(before))
    means = _means(laid, common)
    _, mine, its = common.part(~before)
    return ComparedChannel(
        name=channel,
        unit=unit,
        common=common,
        errors=errors,
        with_errors=tuple(file.name for file in (reference, other) if file.has_errors),
        before=int(before.sum()),
        measures=measures,
        reference=means[0],
        other=means[1],
        mean=means[2],
        largest=_largest(laid, common, errors, measures),
        statistics=compared_statistics(mine, its, window.among),
        tolerance=tolerance,
        allowed=math.nan if tolerance is None else tolerance.in_si(channel, unit, extent(common.reference)),
    )


def common_curves(
    reference: ComparedFile, other: ComparedFile, channel: str, unit: str, after: float, until: float
) -> CommonCurves:
    """A channel of two files in a unit at common times between two times [s].

    Raises InputError if the curves do not overlap there, or if a unit is not known or does not fit.
    """
    try:
        curves = reference.curve(channel, unit), other.curve(channel, unit)
        return on_common_times(*curves[0], *curves[1], after, until)
    except InputError as error:
        raise InputError(f"{channel} of {reference.name} and {other.name}: {error}") from None


def extent(values: Values) -> float:
    """The largest less the least value; 0 if none is known."""
    known = values[np.isfinite(values)]
    return float(np.ptp(known)) if known.size else 0.0


class _Laid(NamedTuple):
    """A channel of two files in a unit, and the window in which it is compared."""

    reference: ComparedFile
    other: ComparedFile
    channel: str
    unit: str
    window: ComparedWindow

    def common(self, reference: ComparedFile, other: ComparedFile) -> CommonCurves:
        """Both curves at common times, see `common_curves`."""
        return common_curves(reference, other, self.channel, self.unit, self.window.after, self.window.until)

    def estimate(self, measure: Callable[[CommonCurves], float]) -> Estimate:
        """A number of both curves with its numerical error: the sum of those that the runs are known to have.

        The error is NaN if neither run has a known error.
        """
        first, second, errors = self.reference, self.other, []
        if first.run is not None and first.has_errors:
            errors.append(first.run.estimate(lambda run: measure(self.common(first.of(run), second))).error)
        if second.run is not None and second.has_errors:
            errors.append(second.run.estimate(lambda run: measure(self.common(first, second.of(run)))).error)
        return Estimate(measure(self.common(first, second)), sum(errors) if errors else math.nan, self.unit)

    def errors(self, common: CommonCurves) -> Values:
        """Numerical errors of the difference at the common times, (n,): the sum of those known; NaN of none.

        The error of interpolation of the curves is part of it.
        """
        sides = [file for file in (self.reference, self.other) if file.has_errors]
        total = common.interpolation_error if sides else np.full(common.time.size, math.nan)
        for file in sides:
            total = total + errors_at(common.time, file.time(self.channel), file.errors(self.channel))
        return total


def _means(laid: _Laid, common: CommonCurves) -> tuple[Estimate, Estimate, Estimate]:
    """Means over time of the reference, of the other curve and of the difference, with their numerical errors.

    Of two runs from all of their steps; else of both by straight lines between the common times.
    """
    ends = float(common.time[0]), float(common.time[-1])
    first, second = (file.mean(laid.channel, laid.unit, *ends) for file in (laid.reference, laid.other))
    if first is not None and second is not None:
        known = [mean.error for mean in (first, second) if not math.isnan(mean.error)]
        error = sum(known) if known else math.nan
        return first, second, Estimate(second.value - first.value, error, laid.unit)

    def mean(name: str) -> Estimate:
        return laid.estimate(lambda common: float(getattr(curve_measures(*common[:3]), name)))

    return mean("mean_reference"), mean("mean_other"), mean("mean_difference")


def _largest(laid: _Laid, common: CommonCurves, errors: Values, measures: CurveMeasures) -> Estimate:
    """The magnitude of the largest difference before the horizon, and its error.

    Of the error of this number and that of the difference at its time the larger counts: where two curves
    cross as steps become shorter, either alone can be too small.
    """

    def magnitude(common: CommonCurves) -> float:
        before = common.time < laid.window.horizon
        differences = np.abs(common.other[before] - common.reference[before])
        return float(np.nanmax(differences)) if np.isfinite(differences).any() else math.nan

    if math.isnan(measures.largest):
        return Estimate(math.nan, math.nan, laid.unit)
    largest = laid.estimate(magnitude)
    where = int(np.searchsorted(common.time, measures.largest_time))
    return largest._replace(error=max(largest.error, float(errors[where])))
