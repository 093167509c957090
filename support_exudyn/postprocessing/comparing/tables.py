"""A comparison as a table with notes and reasons, as data for scripts, as JUnit XML for test servers."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.comparing.compared_channel import GAPS, LARGEST, ComparedChannel
from support_exudyn.postprocessing.comparing.files_compared import SHOWN, ComparedPair, FilesCompared
from support_exudyn.postprocessing.comparing.measures import CONFIDENCE
from support_exudyn.postprocessing.comparing.tolerance import WORST_FIRST, JudgedDifference, ToleranceVerdict
from support_exudyn.postprocessing.figures.selection import CLEARANCE
from support_exudyn.postprocessing.figures.units import readable_change, said
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.estimate import Estimate
from user_forces.values.value import cleaned

NAME = "support-exudyn compare"
HEADER = (
    "channel", "unit", "reference, mean", "difference, mean", "largest", "at [s]", "RMS/range", "C",
    "over errors", "verdict",
)  # fmt: skip
DIGITS = 6  # of numbers without a known error
MOST_DECIMALS = 9
VERDICTS: dict[ToleranceVerdict, str] = {
    "within": "All channels are within their tolerances.",
    "not within": "Not all channels are within their tolerances.",
    "not decided": "Whether all channels are within their tolerances is not decided.",
    "no tolerance": "No tolerance was given: nothing is judged.",
}


def table(pair: ComparedPair) -> Sheet:
    """The table of a comparison: a row for each channel. The title states files, times and errors."""
    channels = pair.channels.values()
    first = min(one.common.time[0] for one in channels)
    last = max(one.common.time[-1] for one in channels)
    known = [file.name for file in (pair.reference, pair.other) if file.has_errors]
    errors = f"± numerical errors of {' and '.join(known)}" if known else "numerical errors not known"
    header = HEADER if pair.verdict != "no tolerance" else HEADER[:-1]
    return Sheet(
        f"{pair.other.name} less {pair.reference.name}, {first:g} to {last:g} s ({errors})",
        header,
        tuple(_row(one)[: len(header)] for one in channels),
        "Means are over all times; largest difference, RMS over the reference's range and C of Sprague and "
        "Geers over those before the horizon. Over errors: the largest multiple of the numerical error.",
        left=2,
    )


def _row(one: ComparedChannel) -> tuple[str, ...]:
    """The cells of a channel, in the unit in which its mean and its differences are read best."""
    largest, size = one.largest, max(abs(mean.value) for mean in one.means[:2])
    apart = largest.value if math.isfinite(largest.value) else abs(one.mean.value)
    unit = readable_change(one.unit, size, apart)
    return (
        one.name,
        unit.name,
        _plain_number(unit.scale * one.means[0].value),
        _with_error(one.mean, unit.scale),
        _with_error(largest._replace(value=one.measures.largest), unit.scale),
        _plain_number(one.measures.largest_time),
        _plain_number(100.0 * one.measures.rms_of_range, 3, " %"),
        _plain_number(100.0 * one.measures.combined_error, 3, " %"),
        _plain_number(one.beside_errors.ratio, 2),
        verdict_words(one),
    )


def _plain_number(value: float, digits: int = DIGITS, unit: str = "") -> str:
    return "-" if math.isnan(value) else f"{value:.{digits}g}{unit}"


def _with_error(estimate: Estimate, scale: float) -> str:
    """A number in a unit, with its error if that is known."""
    value, error = scale * estimate.value, scale * estimate.error
    if math.isnan(value) or math.isnan(error):
        return _plain_number(value)
    if not math.isfinite(error) or error <= 0.0:
        return f"{value:.{DIGITS}g} ± {'not known' if error else '0'}"
    digits = max(0, 1 - math.floor(math.log10(error)))
    shown = f"{value:.{digits}f}" if digits <= MOST_DECIMALS else f"{value:.{DIGITS}g}"
    return f"{shown} ± {error:.1g}"


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
    return [
        f"{one.name}: {_fault(one, judged, one.tolerance.text)}"
        for judged in worst_first
        if judged.verdict in ("not within", "not decided")
    ]


def _fault(one: ComparedChannel, judged: JudgedDifference, rule: str) -> str:
    if judged.what == GAPS:
        return f"not decided: no value at {one.gaps} times at which the reference is known."
    words = f"{judged.what} after the horizon differs by"
    if judged.what == LARGEST:
        where = one.record
        at = f" at {one.common.time[where]:.6g} s" if one.common.time.size > 1 else ""
        now, was = (f"{curve[where]:.9g}" for curve in (one.common.other, one.common.reference))
        words = f"{now} {one.unit}{at}, where the reference is {was}, differs by"
    allowed = said(judged.allowed, one.unit, 4)
    if one.tolerance is not None and one.tolerance.is_relative and not judged.allowed:
        allowed += ", for the reference is constant (give an amount with its unit)"
    words += f" {said(judged.value, one.unit, 4)}; allowed: {allowed} ({rule})"
    if judged.verdict == "not within":
        return words
    error = said(judged.error, one.unit, 2) if math.isfinite(judged.error) else "not known"
    return f"{words}; not decided, its error is {error}: a finer accuracy may decide"


# --- notes ---


def notes(pair: ComparedPair) -> Iterator[str]:
    """Notes on a comparison: reading, shifts, the horizon, times, gaps, what is left out."""
    for file in (pair.reference, pair.other):
        yield from (f"{file.name}: {note}" for note in file.notes)
        if file.shift and (pair.shift is None or file is pair.reference):
            yield f"{file.name}: {said(file.shift, 's', 4)} are added to its times"
    if (shift := pair.shift) is not None:
        late = "lags behind" if shift.shift > 0.0 else "is ahead of"
        yield (
            f"{pair.other.name} {late} {pair.reference.name} by {said(abs(shift.shift), 's', 5)} in "
            f"{shift.channel} (correlation {shift.correlation:.4f}); that is taken off its times"
        )
    if math.isfinite(pair.window.horizon):
        yield from _horizon(pair)
    for name, one in pair.channels.items():
        for file, values in ((pair.reference, one.common.reference), (pair.other, one.common.other)):
            if missing := int(np.count_nonzero(~np.isfinite(values))):
                yield f"{name}: {file.name} has no value at {missing} of {values.size} times"
    yield from _times(pair)
    lacking = [name for name in pair.left_out if name not in pair.other.columns]
    for names in (lacking, [name for name in pair.left_out if name not in lacking]):
        if names:
            yield f"left out: {_some(names)}; {pair.left_out[names[0]]}"


def _some(names: list[str]) -> str:
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return f"{', '.join(names[:SHOWN])}{more}"


def _horizon(pair: ComparedPair) -> Iterator[str]:
    """Up to when curves are compared point by point, and which of their statistics differ after that."""
    file = min((pair.reference, pair.other), key=lambda file: file.horizon)
    yield (
        f"point by point up to {pair.window.horizon:.6g} s, the horizon of {file.name}, from which on shorter "
        "steps change its impacts; after it by statistics"
    )
    found = [(name, what, one) for name, it in pair.channels.items() for what, one in it.statistics.items()]
    known = [one.equal for _, _, one in found if one.equal is not None]
    differ = [
        f"{what} of {name} by {said(one.difference, pair.channels[name].unit)} ± "
        f"{said(one.half, pair.channels[name].unit)}"
        for name, what, one in found
        if one.equal is False
    ]
    sure = f"with {100.0 * CONFIDENCE:.3g} % confidence of all together"
    which = f": {_some(differ)}" if differ else ""
    yield f"after it {len(differ)} of {len(known)} statistics differ, {sure}{which}"


def _times(pair: ComparedPair) -> Iterator[str]:
    """How many times are interpolated; and which times of the reference the other file lacks."""
    name, one = next(iter(pair.channels.items()))
    common, time = one.common, pair.reference.columns[name].time
    if common.interpolated:
        yield f"{common.interpolated} of {common.time.size} times lie between records of one file"
    start, end = max(float(time[0]), pair.window.after), min(float(time[-1]), pair.window.until)
    gap = max(float(common.time[0]) - start, end - float(common.time[-1]))
    if gap > CLEARANCE + 1.5 * float(np.diff(common.time).max(initial=0.0)):  # more than a record's distance
        yield (
            f"compared are {common.time[0]:.6g} to {common.time[-1]:.6g} s of {start:.6g} to {end:.6g} s of "
            f"{pair.reference.name}, for {pair.other.name} has no more"
        )


# --- for other programs ---


def as_data(compared: FilesCompared) -> dict[str, Any]:
    """The whole comparison: the verdict, and the results of each file and each of its channels, in SI."""
    return {
        "reference": compared.reference.path,
        "kind": compared.reference.kind,
        "verdict": compared.verdict,
        "files": {
            pair.other.name: {
                "path": pair.other.path,
                "kind": pair.other.kind,
                "verdict": pair.verdict,
                "notes": list(notes(pair)),
                "shift_s": pair.other.shift,
                "horizon_s": pair.window.horizon,
                "left_out": dict(pair.left_out),
                "channels": {name: _channel_data(one) for name, one in pair.channels.items()},
            }
            for pair in compared.pairs
        },
    }


def _channel_data(one: ComparedChannel) -> Mapping[str, Any]:
    reference, other, mean = (number._asdict() for number in one.means)
    within = {"within": True, "not within": False}.get(one.beside_errors.verdict)
    return {
        "unit": one.unit,
        "verdict": one.verdict,
        "tolerance": None if one.tolerance is None else one.tolerance.text,
        "allowed": one.allowed,
        "faults": faults(one),
        "reference": reference,
        "other": other,
        "mean": mean,
        "largest": one.largest._asdict(),
        "beside_errors": {"within": within, "times": one.beside_errors.ratio},
        "measures": one.measures._asdict(),
        "statistics": {name: {**what._asdict(), "equal": what.equal} for name, what in one.statistics.items()},
    }


def write_junit(compared: FilesCompared, path: Path) -> None:
    """Write JUnit XML, whole or not at all: a test suite for each file, a test case for each channel.

    A channel that is not within its tolerance, or not decided, is a failure; a channel that could not be
    compared is skipped. Raises OSError if the file cannot be written.
    """

    def within(parent: ElementTree.Element, tag: str, **attributes: str) -> ElementTree.Element:
        return ElementTree.SubElement(parent, tag, {name: cleaned(text) for name, text in attributes.items()})

    whole = ElementTree.Element("testsuites", name=NAME)
    for pair in compared.pairs:
        suite = within(whole, "testsuite", name=f"{pair.other.name} less {pair.reference.name}", errors="0")
        for name, one in pair.channels.items():
            case = within(suite, "testcase", classname=pair.other.name, name=name)
            if lines := faults(one):
                failure = within(case, "failure", type=one.verdict, message=lines[0])
                failure.text = cleaned("\n".join(lines))
        for name, why in pair.left_out.items():
            case = within(suite, "testcase", classname=pair.other.name, name=name)
            within(case, "skipped", message=why)
        if lines := list(notes(pair)):
            within(suite, "system-out").text = cleaned("\n".join(lines))
    for counted in (whole, *whole):
        for name, found in (("tests", "testcase"), ("failures", "failure"), ("skipped", "skipped")):
            counted.set(name, str(len(list(counted.iter(found)))))
    ElementTree.indent(whole)
    with whole_file(path) as temporary:
        ElementTree.ElementTree(whole).write(temporary, encoding="UTF-8", xml_declaration=True)
