"""A channel of a file against the same of the reference: differences, errors, statistics and a verdict."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.postprocessing.comparing.common_times import CommonCurves, on_common_times
from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from support_exudyn.postprocessing.comparing.mapping import Tolerance
from support_exudyn.postprocessing.comparing.measures import CurveMeasures, curve_measures
from support_exudyn.postprocessing.comparing.statistics import StatisticDifference, compared_statistics
from support_exudyn.postprocessing.comparing.with_errors import BesideErrors
from support_exudyn.simulation.estimate import Estimate
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
ToleranceVerdict = Literal["within", "not within", "not decided", "told"]
WORST_FIRST: tuple[ToleranceVerdict, ...] = ("not within", "not decided", "within", "told")
ROUNDING = 1e-9  # share of what is allowed: 1.1 - 1.0 is 0.1, in whatever digits
JUDGED = ("mean", "rms", "spread", "quantile_95")  # statistics that are in the unit of the channel
LARGEST = "largest difference"
GAPS = "values that are missing"
MISSED = 2.0  # times the distance from every second record: the error of straight lines between all records
FEWEST = 2  # times that make a curve
CONFIDENCE = 0.95  # of all intervals of the statistics of two files together


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
        """Within, or not; not decided if the error is larger than what is allowed and could turn the answer.

        A difference that is no number is not decided: it could not be computed. Without a tolerance it is told.
        """
        if math.isnan(self.allowed):
            return "told"
        if math.isnan(self.value) or math.isinf(self.error):
            return "not decided"
        if self.error > self.allowed and self.value - self.error <= self.allowed:
            return "not decided"
        return "within" if self.value <= self.allowed * (1.0 + ROUNDING) else "not within"


def worst(verdicts: Iterable[ToleranceVerdict]) -> ToleranceVerdict:
    """The verdict on all: the worst of those on each."""
    given = set(verdicts)
    return next((verdict for verdict in WORST_FIRST if verdict in given), "told")


@dataclass(frozen=True)
class ComparedWindow:
    """The part of two files that is compared.

    after, until: times [s]. parting: from when on curves are compared by their statistics [s]; infinite: never.
    among: how many statistics are reported together.
    """

    after: float = -math.inf
    until: float = math.inf
    parting: float = math.inf
    among: int = 1


@dataclass(frozen=True)
class ComparedChannel:
    """A channel of a file against that of the reference; all in SI.

    name, unit, meaning: of the channel. common: both curves at common times.
    errors: numerical errors of the difference at these times, (n,), of the files `with_errors`; NaN if of none.
    before: number of the times that lie before the parting. measures: of these.
    reference, other, mean: means over the whole window, and that of the difference. largest: magnitude of the
    largest difference before the parting, with its numerical error; NaN if nothing lies before.
    statistics: after the parting, by their names; empty if the curves do not part, or if nothing lies after.
    tolerance, allowed: the tolerance, and its amount; None and NaN without a tolerance.
    not_told: why the statistics could not be computed; empty if they were.
    """

    name: str
    unit: str
    meaning: str
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
    not_told: str

    @property
    def beside_errors(self) -> BesideErrors:
        """The largest difference with the numerical errors that are known."""
        return BesideErrors(self.largest.value, self.largest.error)

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
        """The differences that are judged: the largest before the parting, and statistics after it.

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
        for name in JUDGED:
            if (statistic := self.statistics.get(name)) is not None:
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
    impacts: tuple[Sequence[float], Sequence[float]] | None = None,
) -> ComparedChannel:
    """Compare a channel.

    Arguments:
        reference, other: the files.
        channel, unit: its name, and the unit in SI in which it is compared.
        window: what is compared.
        tolerance: by how much it may differ; None: there is no verdict.
        impacts: times of the impacts of its contact in both [s], if it is of a contact.

    Raises InputError if units are not known or of two kinds, or if the curves do not overlap.
    """
    laid = _Laid(reference, other, channel, unit, window)
    common = laid.common(reference, other)
    errors, before = laid.errors(common), common.time < window.parting
    measures = curve_measures(*common.part(before))
    means = _means(laid, common)
    statistics, not_told = _statistics(laid, impacts)
    return ComparedChannel(
        name=channel,
        unit=unit,
        meaning=reference.meaning(channel) or other.meaning(channel),
        common=common,
        errors=errors,
        with_errors=tuple(file.name for file in (reference, other) if file.has_errors),
        before=int(before.sum()),
        measures=measures,
        reference=means[0],
        other=means[1],
        mean=means[2],
        largest=_largest(laid, common, errors, measures),
        statistics=statistics,
        tolerance=tolerance,
        allowed=math.nan if tolerance is None else tolerance.in_si(channel, unit, extent(common.reference)),
        not_told=not_told,
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

        Between the records of a run the errors are joined by straight lines, and are infinite next to infinite
        errors. The error of interpolation of the curves is part of it.
        """
        sides = [file for file in (self.reference, self.other) if file.has_errors]
        total = common.interpolation_error if sides else np.full(common.time.size, math.nan)
        for file in sides:
            time, errors = file.time(self.channel), file.errors(self.channel)
            endless = np.isinf(errors)
            finite = np.interp(common.time, time, np.where(endless, 0.0, errors))
            total = total + np.where(np.interp(common.time, time, endless) > 0.0, math.inf, finite)
        return total


def _means(laid: _Laid, common: CommonCurves) -> tuple[Estimate, Estimate, Estimate]:
    """Means over time of the reference, of the other curve and of the difference, with their errors.

    Of two runs from all of their steps; else of both by straight lines between the common times. The error of
    these lines is added: twice the distance from the mean by every second record, for that falls as h after a
    jump, such as that of a force as a drive starts, and as h^2 else.
    """
    ends = float(common.time[0]), float(common.time[-1])
    first, second = (file.mean(laid.channel, laid.unit, *ends) for file in (laid.reference, laid.other))
    if first is not None and second is not None:
        known = [mean.error for mean in (first, second) if not math.isnan(mean.error)]
        error = sum(known) if known else math.nan
        return first, second, Estimate(second.value - first.value, error, laid.unit)
    rows = np.zeros(common.time.size, dtype=bool)
    rows[::2] = rows[-1] = True
    thinned = curve_measures(*common.part(rows))

    def mean(name: str) -> Estimate:
        estimate = laid.estimate(lambda common: float(getattr(curve_measures(*common[:3]), name)))
        return estimate._replace(error=estimate.error + MISSED * abs(estimate.value - getattr(thinned, name)))

    return mean("mean_reference"), mean("mean_other"), mean("mean_difference")


def _largest(laid: _Laid, common: CommonCurves, errors: Values, measures: CurveMeasures) -> Estimate:
    """The magnitude of the largest difference before the parting, and its error.

    Of the error of this number and that of the difference at its time the larger counts: where two curves
    cross as steps become shorter, either alone can be too small.
    """

    def magnitude(common: CommonCurves) -> float:
        before = common.time < laid.window.parting
        differences = np.abs(common.other[before] - common.reference[before])
        return float(np.nanmax(differences)) if np.isfinite(differences).any() else math.nan

    if math.isnan(measures.largest):
        return Estimate(math.nan, math.nan, laid.unit)
    largest = laid.estimate(magnitude)
    where = int(np.searchsorted(common.time, measures.largest_time))
    return largest._replace(error=max(largest.error, float(errors[where])))


def _statistics(
    laid: _Laid, impacts: tuple[Sequence[float], Sequence[float]] | None
) -> tuple[Mapping[str, StatisticDifference], str]:
    """Statistics of both curves after the parting, at the times of each; and why there are none, in words."""
    window, curves = laid.window, list[Values]()
    files = laid.reference, laid.other
    times = [file.time(laid.channel) for file in files]
    start = max(window.parting, window.after, *(float(time[0]) for time in times))
    end = min(window.until, *(float(time[-1]) for time in times))
    for file, time in zip(files, times, strict=True):
        values = file.values(laid.channel, laid.unit)
        chosen = (time >= start) & (time <= end) & np.isfinite(values)
        curves += [time[chosen], values[chosen]]
    if not math.isfinite(window.parting) or min(curves[0].size, curves[2].size) < FEWEST:
        return {}, ""
    if impacts is not None:
        first, second = ([time for time in own if start <= time <= end] for own in impacts)
        impacts = first, second
    try:
        return compared_statistics(*curves, impacts=impacts, confidence=CONFIDENCE, among=window.among), ""
    except InputError as error:
        return {}, f"statistics: {error}"
