"""A comparison in words: a row for each channel, notes, why a verdict is bad."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from support_exudyn.postprocessing.comparing.compared_channel import GAPS, LARGEST, ComparedChannel
from support_exudyn.postprocessing.comparing.files_compared import SHOWN, ComparedPair
from support_exudyn.postprocessing.comparing.statistics import CONFIDENCE
from support_exudyn.postprocessing.comparing.tolerance import WORST_FIRST, JudgedDifference, ToleranceVerdict
from support_exudyn.postprocessing.figures.selection import CLEARANCE
from support_exudyn.postprocessing.figures.units import readable_change, said
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.estimate import Estimate

Row = tuple[str, ...]
DIGITS = 6  # of numbers without a known error
MOST_DECIMALS = 9
NONE = "-"
VERDICTS: dict[ToleranceVerdict, str] = {
    "within": "All channels are within their tolerances.",
    "not within": "Not all channels are within their tolerances.",
    "not decided": "Whether all channels are within their tolerances is not decided.",
    "told": "No tolerance was given: nothing is judged.",
}


def table(pair: ComparedPair) -> Sheet:
    """The table of a comparison: a row for each channel. The title states files, times and errors."""
    channels = pair.channels.values()
    first = min(one.common.time[0] for one in channels)
    last = max(one.common.time[-1] for one in channels)
    known = [file.name for file in (pair.reference, pair.other) if file.has_errors]
    errors = f"± numerical errors of {' and '.join(known)}" if known else "numerical errors not known"
    header: Row = (
        "channel", "unit", "reference, mean", "difference, mean", "largest", "at [s]", "RMS/range", "C",
        "over errors", *(["verdict"] if pair.verdict != "told" else []),
    )  # fmt: skip
    return Sheet(
        f"{pair.other.name} less {pair.reference.name}, {first:g} to {last:g} s ({errors})",
        header,
        tuple(_channel(one)[: len(header)] for one in channels),
        "Means are over all times; largest difference, RMS over the reference's range and C of Sprague and "
        "Geers over those before the horizon. Over errors: the largest multiple of the numerical error.",
        left=2,
    )


def _channel(one: ComparedChannel) -> Row:
    """The cells of a channel, in the unit in which its mean and its differences are read best."""
    largest, size = one.largest, max(abs(mean.value) for mean in one.means[:2])
    apart = largest.value if math.isfinite(largest.value) else abs(one.mean.value)
    unit = readable_change(one.unit, size, apart)
    ratio = one.beside_errors.ratio
    return (
        one.name,
        unit.name,
        number(one.means[0]._replace(error=math.nan), unit.scale),
        number(one.mean, unit.scale),
        number(largest._replace(value=one.measures.largest), unit.scale),
        NONE if math.isnan(one.measures.largest_time) else f"{one.measures.largest_time:.6g}",
        share(one.measures.rms_of_range),
        share(one.measures.combined_error),
        NONE if math.isnan(ratio) else f"{ratio:.2g}",
        verdict_words(one),
    )


def number(estimate: Estimate, scale: float) -> str:
    """A number in a unit, with its error if that is known."""
    value, error = scale * estimate.value, scale * estimate.error
    if math.isnan(value):
        return NONE
    if math.isnan(error):
        return f"{value:.{DIGITS}g}"
    if not math.isfinite(error) or error <= 0.0:
        return f"{value:.{DIGITS}g} ± {'not known' if error else '0'}"
    digits = max(0, 1 - math.floor(math.log10(error)))
    shown = f"{value:.{digits}f}" if digits <= MOST_DECIMALS else f"{value:.{DIGITS}g}"
    return f"{shown} ± {error:.1g}"


def share(value: float) -> str:
    """A share in percent."""
    return NONE if math.isnan(value) else f"{100.0 * value:.3g} %"


def verdict_words(one: ComparedChannel) -> str:
    """The verdict on a channel, with its tolerance."""
    if one.tolerance is None:
        return "no tolerance"
    words = {"within": "within ", "not within": "NOT within "}.get(one.verdict, "not decided, ")
    return f"{words}{one.tolerance.text}"


# --- why a channel is not within its tolerance ---


def faults(one: ComparedChannel) -> list[str]:
    """Why a channel is not within its tolerance, or not decided: a sentence a number, the worst first."""
    if one.tolerance is None:
        return []
    if not one.judged:
        return [f"{one.name}: not decided: there are no two common times."]
    worst_first = sorted(one.judged, key=lambda judged: WORST_FIRST.index(judged.verdict))
    return [_fault(one, judged) for judged in worst_first if judged.verdict in ("not within", "not decided")]


def _fault(one: ComparedChannel, judged: JudgedDifference) -> str:
    if judged.what == GAPS:
        return f"{one.name}: not decided: no value at {one.gaps} times at which the reference is known."
    words = f"{judged.what} after the horizon differs by"
    if judged.what == LARGEST:
        where = one.record
        at = f" at {one.common.time[where]:.6g} s" if one.common.time.size > 1 else ""
        now, was = (f"{curve[where]:.9g}" for curve in (one.common.other, one.common.reference))
        words = f"{now} {one.unit}{at}, where the reference is {was}, differs by"
    allowed = said(judged.allowed, one.unit, 4)
    if one.tolerance is not None and one.tolerance.is_relative and not judged.allowed:
        allowed += ", for the reference is constant (give an amount with its unit)"
    rule = one.tolerance.text if one.tolerance is not None else ""
    words += f" {said(judged.value, one.unit, 4)}; allowed: {allowed} ({rule})"
    if judged.verdict == "not within":
        return f"{one.name}: {words}"
    error = said(judged.error, one.unit, 2) if math.isfinite(judged.error) else "not known"
    return f"{one.name}: {words}; not decided, its error is {error}: a finer accuracy may decide"


# --- notes ---


def notes(pair: ComparedPair) -> Iterator[str]:
    """Notes on a comparison: reading, shifts, the horizon, interpolation, gaps, what is left out."""
    for file in (pair.reference, pair.other):
        yield from (f"{file.name}: {note}" for note in file.notes)
        if file.mapped.shift and (pair.shift is None or file is pair.reference):
            yield f"{file.name}: {said(file.mapped.shift, 's', 4)} are added to its times"
    if pair.shift is not None:
        shift = pair.shift.found
        late = "lags behind" if shift.shift > 0.0 else "is ahead of"
        yield (
            f"{pair.other.name} {late} {pair.reference.name} by {said(abs(shift.shift), 's', 5)} in "
            f"{pair.shift.channel} (correlation {shift.correlation:.4f}); that is taken off its times"
        )
    yield from _horizon(pair)
    yield from _times(pair)
    for channel in pair.channels.values():
        for file, values in ((pair.reference, channel.common.reference), (pair.other, channel.common.other)):
            if missing := int(np.count_nonzero(~np.isfinite(values))):
                yield f"{channel.name}: {file.name} has no value at {missing} of {values.size} times"
    if lacking := pair.common.lacking:
        yield f"{pair.other.name} has no {_some(lacking)}"
    if reasons := pair.common.not_alike:
        yield f"left out: {_some(list(reasons))}; {next(iter(reasons.values()))}"


def _some(names: Sequence[str]) -> str:
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return f"{', '.join(names[:SHOWN])}{more}"


def _horizon(pair: ComparedPair) -> Iterator[str]:
    """Up to when curves are compared point by point, and which of their statistics differ after that."""
    horizon = pair.window.horizon
    if math.isinf(horizon):
        return
    file = min((pair.reference, pair.other), key=lambda file: file.horizon)
    yield (
        f"point by point up to {horizon:.6g} s, the horizon of {file.name}, from which on shorter steps change "
        "its impacts; after it by statistics"
    )
    known, differ = 0, []
    for name, channel in pair.channels.items():
        for what, one in channel.statistics.items():
            known += one.equal is not None
            if one.equal is False:
                apart, half = said(one.difference, channel.unit), said(one.half, channel.unit)
                differ.append(f"{what} of {name} by {apart} ± {half}")
    sure = f"with {100.0 * CONFIDENCE:.3g} % confidence of all together"
    which = f": {_some(differ)}" if differ else ""
    yield f"after it {len(differ)} of {known} statistics differ, {sure}{which}"


def _times(pair: ComparedPair) -> Iterator[str]:
    """How many times are interpolated; and the times of the reference that the other file lacks, at the worst.

    A gap that is no longer than the time between two records is none.
    """
    between = [one for one in pair.channels.values() if one.common.interpolated]
    if between:
        common = between[0].common
        yield f"{common.interpolated} of {common.time.size} times lie between records of one file"
    sentence, most = "", 0.0
    for name, one in pair.channels.items():
        time, common_time = pair.reference.column(name, one.unit).time, one.common.time
        start, end = max(float(time[0]), pair.window.after), min(float(time[-1]), pair.window.until)
        gap = max(float(common_time[0]) - start, end - float(common_time[-1]))
        step = float(np.diff(common_time).max(initial=0.0))
        if gap > max(most, CLEARANCE + 1.5 * step):
            most = gap
            sentence = (
                f"compared are {common_time[0]:.6g} to {common_time[-1]:.6g} s of {start:.6g} to {end:.6g} s "
                f"of {pair.reference.name} ({name}), for {pair.other.name} has no more"
            )
    if sentence:
        yield sentence
