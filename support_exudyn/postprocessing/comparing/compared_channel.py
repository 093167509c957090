"""A channel of a file beside the same of the reference: differences, errors, statistics, bands, a verdict."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from support_exudyn.postprocessing.comparing.bands import BandRms, band_rms
from support_exudyn.postprocessing.comparing.common_times import CommonCurves
from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from support_exudyn.postprocessing.comparing.laid_curves import LaidCurves
from support_exudyn.postprocessing.comparing.measures import CurveMeasures, curve_measures
from support_exudyn.postprocessing.comparing.rating import IsoRating, iso_rating
from support_exudyn.postprocessing.comparing.statistics import StatisticDifference, compared_statistics
from support_exudyn.postprocessing.comparing.tolerances import Tolerance
from support_exudyn.postprocessing.comparing.verdict import JudgedDifference, ToleranceVerdict, worst
from support_exudyn.postprocessing.comparing.with_errors import BesideErrors
from support_exudyn.simulation.estimate import Estimate
from user_forces.values.value import InputError

T = TypeVar("T")
Values = npt.NDArray[np.float64]
JUDGED = ("mean", "rms", "spread", "quantile_95")  # statistics that are in the unit of the channel
LARGEST = "largest difference"
GAPS = "values that are missing"
MISSED = 2.0  # times the distance from every second record: what lies between all of them
FEWEST = 2  # times that make a curve
CONFIDENCE = 0.95  # of all intervals of the statistics of two files together


@dataclass(frozen=True)
class ComparedWindow:
    """What of two files is compared, and how.

    after, until: times [s]. parting: from when on curves are compared by their statistics [s]; infinite: never.
    edges: of the bands in which spectra are compared [Hz]; empty: they are not. among: how many statistics are
    told together.
    """

    after: float = -math.inf
    until: float = math.inf
    parting: float = math.inf
    edges: Sequence[float] = ()
    among: int = 1


@dataclass(frozen=True)
class ComparedChannel:
    """A channel of a file beside that of the reference; all in SI.

    name, unit, meaning: of the channel. common: both curves at common times.
    errors: numerical ones of the difference at these times, (n,), of the files `with_errors`; NaN if of none.
    before: how many of the times lie before the parting. measures: of these.
    reference, other, mean: means over the whole window, and that of the difference. largest: magnitude of the
    largest difference before the parting, with its numerical error; NaN if nothing lies before.
    statistics: after the parting, by their names; empty if the curves do not part, or if nothing lies after.
    bands: of the reference and the other, over the whole window.
    tolerance, allowed: what was asked for, and what that is; None and NaN if nothing was.
    not_told: what could not be computed and why, in sentences.
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
    bands: tuple[BandRms, BandRms] | None
    tolerance: Tolerance | None
    allowed: float
    not_told: tuple[str, ...]

    @cached_property
    def rating(self) -> IsoRating | None:
        """The rating of ISO/TS 18571 before the parting; None if it cannot be computed. It takes its time."""
        pieces = (one[: self.before] for one in self.common[:3])
        try:
            return iso_rating(*pieces) if self.before >= FEWEST else None
        except InputError:
            return None

    @property
    def beside_errors(self) -> BesideErrors:
        """The largest difference beside the numerical errors that are known."""
        return BesideErrors(self.largest.value, self.largest.error)

    @property
    def largest_of_reference(self) -> float:
        """The largest difference over the reference at its time; NaN if that is zero."""
        if math.isnan(self.measures.largest):
            return math.nan
        there = abs(float(self.common.reference[np.searchsorted(self.common.time, self.measures.largest_time)]))
        return self.largest.value / there if there > 0.0 else math.nan

    @property
    def is_same(self) -> bool:
        """Whether both curves are the same to the bit."""
        return bool(np.array_equal(self.common.reference, self.common.other, equal_nan=True))

    @property
    def gaps(self) -> int:
        """At how many times the other curve is not known and the reference is."""
        return int(np.count_nonzero(np.isfinite(self.common.reference) & ~np.isfinite(self.common.other)))

    @property
    def judged(self) -> tuple[JudgedDifference, ...]:
        """What is judged: the largest difference before the parting, and statistics after it.

        Curves that are the same to the bit have the same errors, whatever these are. What the other curve lacks
        of the reference is nothing that can be judged.
        """
        if self.is_same:
            return (JudgedDifference(LARGEST, 0.0, 0.0, self.allowed),)
        error = self.largest.error if math.isfinite(self.largest.error) else self._interpolation
        if self.gaps:
            return (JudgedDifference(GAPS, math.nan, 0.0, self.allowed),)
        found = [JudgedDifference(LARGEST, abs(self.largest.value), error, self.allowed)] if self.before else []
        for name in JUDGED:
            if (one := self.statistics.get(name)) is not None:
                known = one.tellable if math.isfinite(one.tellable) else math.inf
                found.append(JudgedDifference(name, abs(one.difference.value), known, self.allowed))
        return tuple(found)

    @property
    def _interpolation(self) -> float:
        """By how much interpolation may have changed the largest difference; all that is known without runs."""
        if math.isnan(self.measures.largest) or math.isinf(self.largest.error):
            return math.inf
        where = int(np.searchsorted(self.common.time, self.measures.largest_time))
        return float(self.common.interpolation_error[where])

    @property
    def verdict(self) -> ToleranceVerdict:
        """Whether the channel is within its tolerance; "not decided" if there is nothing to judge by."""
        if self.tolerance is None:
            return "told"
        return worst(one.verdict for one in self.judged) if self.judged else "not decided"


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
        channel, unit: its name, and the unit in SI that it is told in.
        window: what is compared.
        tolerance: by how much it may differ; None: that is told only.
        impacts: times of the impacts of its contact in both [s], if it is of one.

    Raises InputError if units are not known or of two kinds, or if the curves do not overlap.
    """
    laid = LaidCurves(reference, other, channel, unit, window.after, window.until)
    means = _means(laid)
    common, errors = laid.common, laid.errors()
    before = common.time < window.parting
    start, not_told = int(before.sum()), list[str]()
    pieces = common.time[before], common.reference[before], common.other[before]
    measures = curve_measures(*pieces)
    statistics = _statistics(reference, other, channel, unit, window, impacts, not_told)
    return ComparedChannel(
        name=channel,
        unit=unit,
        meaning=reference.meaning(channel) or other.meaning(channel),
        common=common,
        errors=errors,
        with_errors=laid.with_errors,
        before=start,
        measures=measures,
        reference=means[0],
        other=means[1],
        mean=means[2],
        largest=_largest(laid, errors, measures, window.parting),
        statistics=statistics,
        bands=_bands(common, window, not_told) if window.edges else None,
        tolerance=tolerance,
        allowed=math.nan if tolerance is None else tolerance.in_si(channel, unit, extent(common.reference)),
        not_told=tuple(not_told),
    )


def extent(values: Values) -> float:
    """The largest less the least value; 0 if none is known."""
    known = values[np.isfinite(values)]
    return float(known.max() - known.min()) if known.size else 0.0


def _means(laid: LaidCurves) -> tuple[Estimate, Estimate, Estimate]:
    """Means over time of the reference, of the other curve and of the difference, with their errors.

    Of two runs from all of their steps; beside another table both by straight lines between the common times.
    """
    ends = float(laid.common.time[0]), float(laid.common.time[-1])
    first, second = (one.mean(laid.channel, laid.unit, *ends) for one in (laid.reference, laid.other))
    if first is None or second is None:
        names = ("mean_reference", "mean_other", "mean_difference")
        first, second, apart = (_mean(laid, operator.attrgetter(name)) for name in names)
        return first, second, apart
    known = [one.error for one in (first, second) if not math.isnan(one.error)]
    return first, second, Estimate(second.value - first.value, sum(known) if known else math.nan, laid.unit)


def _mean(laid: LaidCurves, which: Callable[[CurveMeasures], float]) -> Estimate:
    """A mean over time and its error: that of the runs, and that of the straight lines between their records.

    Of the latter twice the distance from the mean by every second record: it falls as h after a jump, such as
    that of a force as a drive starts, and as h^2 else.
    """

    def mean(both: CommonCurves) -> float:
        return which(curve_measures(*both[:3]))

    found, common = laid.estimate(mean), laid.common
    if math.isnan(found.error):
        return found
    rows = np.unique(np.append(np.arange(0, common.time.size, 2), common.time.size - 1))
    thinned = which(curve_measures(*(one[rows] for one in common[:3])))
    return found._replace(error=found.error + MISSED * abs(found.value - thinned))


def _largest(laid: LaidCurves, errors: Values, measures: CurveMeasures, parting: float) -> Estimate:
    """The magnitude of the largest difference before the parting, and its error.

    Of the error of this number and that of the difference at its time the larger one counts: where two curves
    cross as steps become shorter, either alone can be too small.
    """

    def magnitude(both: CommonCurves) -> float:
        before = both.time < parting
        apart = np.abs(both.other[before] - both.reference[before])
        return float(np.nanmax(apart)) if np.isfinite(apart).any() else math.nan

    if math.isnan(measures.largest):
        return Estimate(math.nan, math.nan, laid.unit)
    found = laid.estimate(magnitude)
    where = int(np.searchsorted(laid.common.time, measures.largest_time))
    return found._replace(error=max(found.error, float(errors[where])))


def _statistics(
    reference: ComparedFile,
    other: ComparedFile,
    channel: str,
    unit: str,
    window: ComparedWindow,
    impacts: tuple[Sequence[float], Sequence[float]] | None,
    not_told: list[str],
) -> Mapping[str, StatisticDifference]:
    """Statistics of what both curves have after the parting, at the times of each."""
    if not math.isfinite(window.parting):
        return {}
    ends = [(file.time(channel)[0], file.time(channel)[-1]) for file in (reference, other)]
    start = max(window.parting, window.after, *(first for first, _ in ends))
    end = min(window.until, *(last for _, last in ends))
    pieces, touches = [], []
    for n, file in enumerate((reference, other)):
        time, values = file.time(channel), file.values(channel, unit)
        chosen = (time >= start) & (time <= end) & np.isfinite(values)
        pieces += [time[chosen], values[chosen]]
        touches.append(None if impacts is None else [t for t in impacts[n] if start <= t <= end])
    if min(pieces[0].size, pieces[2].size) < FEWEST:
        return {}
    return (
        _tried(
            lambda: compared_statistics(
                *pieces,
                first_impacts=touches[0],
                second_impacts=touches[1],
                confidence=CONFIDENCE,
                among=window.among,
            ),
            "statistics",
            not_told,
        )
        or {}
    )


def _bands(common: CommonCurves, window: ComparedWindow, not_told: list[str]) -> tuple[BandRms, BandRms] | None:
    """RMS values in bands of both curves."""

    def both() -> tuple[BandRms, BandRms]:
        first, second = (band_rms(common.time, one, window.edges) for one in (common.reference, common.other))
        return first, second

    return _tried(both, "spectrum", not_told)


def _tried(work: Callable[[], T], what: str, not_told: list[str]) -> T | None:
    """What comes out; None if it cannot be computed, which is noted."""
    try:
        return work()
    except InputError as error:
        not_told.append(f"{what}: {error}")
        return None
