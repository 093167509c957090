"""A comparison as a table with notes, as data for scripts, as JUnit XML for test servers."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.comparing.compared_channel import ComparedChannel, Verdict
from support_exudyn.postprocessing.comparing.files_compared import ComparedPair, FilesCompared, first_names
from support_exudyn.postprocessing.comparing.measures import CONFIDENCE
from support_exudyn.postprocessing.figures.selection import CLEARANCE
from support_exudyn.postprocessing.figures.units import readable_change, said
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.postprocessing.shown_numbers import to_error
from support_exudyn.simulation.estimate import Estimate
from user_forces.values.value import cleaned

NAME = "support-exudyn compare"
HEADER = (
    "channel", "unit", "reference, mean", "difference, mean", "largest", "at [s]", "RMS/range", "C",
    "beyond errors", "verdict",
)  # fmt: skip
DIGITS = 6  # of numbers without a known error
MOST_DIGITS = 9  # of numbers with their errors
CERTAIN = 10.0  # times the numerical errors from which on a difference is certain: errors are estimates
VERDICTS: dict[Verdict, str] = {
    "within": "All channels are within their tolerances.",
    "not within": "Not all channels are within their tolerances.",
    "not decided": "Whether all channels are within their tolerances is not decided.",
    "no tolerance": "No tolerance was given: nothing is judged.",
}


def table(pair: ComparedPair) -> Sheet:
    """The table of a comparison: a row for each channel. The title states files, times and errors."""
    times = [channel.common.time for channel in pair.channels.values()]
    first, last = min(time[0] for time in times), max(time[-1] for time in times)
    known = [file.name for file in (pair.reference, pair.other) if file.has_errors]
    errors = f"± numerical errors of {' and '.join(known)}" if known else "numerical errors not known"
    header = HEADER if pair.verdict != "no tolerance" else HEADER[:-1]
    return Sheet(
        f"{pair.other.name} less {pair.reference.name}, {first:g} to {last:g} s ({errors})",
        header,
        tuple(_row(channel)[: len(header)] for channel in pair.channels.values()),
        "Means are over all times; largest difference, RMS over the reference's range and C of Sprague and "
        "Geers over those before the horizon. Beyond errors: no, if the numerical errors explain all "
        f"differences; yes from {CERTAIN:g} times these errors on; uncertain between.",
        left=2,
    )


def _row(channel: ComparedChannel) -> tuple[str, ...]:
    """The cells of a channel, in the unit in which its mean and its differences are read best."""
    largest, measures = channel.largest, channel.measures
    apart = largest.value if math.isfinite(largest.value) else abs(channel.mean.value)
    unit = readable_change(channel.unit, max(abs(mean.value) for mean in channel.means[:2]), apart)
    return (
        channel.name,
        unit.name,
        _number(unit.scale * channel.means[0].value),
        _with_error(channel.mean, unit.scale),
        _with_error(largest._replace(value=measures.largest), unit.scale),
        _number(measures.largest_time),
        _number(100.0 * measures.rms_of_range, 3, " %"),
        _number(100.0 * measures.combined_error, 3, " %"),
        beyond_errors(channel),
        verdict_words(channel),
    )


def _number(value: float, digits: int = DIGITS, unit: str = "") -> str:
    return "-" if math.isnan(value) else f"{value:.{digits}g}{unit}"


def _with_error(number: Estimate, scale: float) -> str:
    """A number in a unit, with its error if that is known."""
    if math.isnan(number.value) or math.isnan(number.error):
        return _number(scale * number.value)
    shown = to_error(number, scale, MOST_DIGITS)
    return shown if math.isfinite(number.error) else f"{_number(scale * number.value)} ± not known"


def beyond_errors(channel: ComparedChannel) -> str:
    """Whether the curves differ by more than their numerical errors, in a word; "-" if no error is known."""
    times = channel.over_errors
    if math.isnan(times):
        return "-"
    return "no" if times <= 1.0 else "yes" if times >= CERTAIN else "uncertain"


def verdict_words(channel: ComparedChannel) -> str:
    """The verdict on a channel, with its tolerance."""
    if channel.tolerance is None:
        return "no tolerance"
    words = {"within": "within ", "not within": "NOT within "}.get(channel.verdict, "not decided, ")
    return f"{words}{channel.tolerance.text}"


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
    if math.isfinite(pair.horizon):
        yield from _horizon(pair)
    for name, channel in pair.channels.items():
        sides = (pair.reference, channel.common.reference), (pair.other, channel.common.other)
        for file, values in sides:
            if missing := int(np.count_nonzero(~np.isfinite(values))):
                yield f"{name}: {file.name} has no value at {missing} of {values.size} times"
    name, channel = next(iter(pair.channels.items()))
    time, own = channel.common.time, pair.reference.columns[name].time
    start, end = max(float(own[0]), pair.after), min(float(own[-1]), pair.until)
    gap = max(float(time[0]) - start, end - float(time[-1]))
    if gap > CLEARANCE + 1.5 * float(np.diff(time).max(initial=0.0)):  # more than a record's distance
        yield (
            f"compared are {time[0]:.6g} to {time[-1]:.6g} s of {start:.6g} to {end:.6g} s of "
            f"{pair.reference.name}, for {pair.other.name} has no more"
        )
    lacking = [name for name in pair.left_out if name not in pair.other.columns]
    for names in (lacking, [name for name in pair.left_out if name not in lacking]):
        if names:
            yield f"left out: {first_names(names)}; {pair.left_out[names[0]]}"


def _horizon(pair: ComparedPair) -> Iterator[str]:
    """Up to when curves are compared point by point, and which of their statistics differ after that."""
    file = min((pair.reference, pair.other), key=lambda file: file.horizon)
    yield (
        f"point by point up to {pair.horizon:.6g} s, the horizon of {file.name}, from which on shorter "
        "steps change its impacts; after it by statistics"
    )
    equal, differ = 0, []
    for name, channel in pair.channels.items():
        for what, each in channel.statistics.items():
            equal += each.equal is True
            if each.equal is False:
                half = said(each.half, channel.unit)
                differ.append(f"{what} of {name} by {said(each.difference, channel.unit)} ± {half}")
    if not equal and not differ:
        yield "after it there are too few common times for confidence intervals"
        return
    which = f": {first_names(differ)}" if differ else ""
    yield (
        f"after it {len(differ)} of {equal + len(differ)} statistics differ, with {100.0 * CONFIDENCE:.3g} % "
        f"confidence of all together{which}"
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
                "horizon_s": pair.horizon,
                "left_out": dict(pair.left_out),
                "channels": {name: _channel_data(channel) for name, channel in pair.channels.items()},
            }
            for pair in compared.pairs
        },
    }


def _channel_data(channel: ComparedChannel) -> Mapping[str, Any]:
    reference, other, mean = (number._asdict() for number in channel.means)
    return {
        "unit": channel.unit,
        "verdict": channel.verdict,
        "tolerance": None if channel.tolerance is None else channel.tolerance.text,
        "allowed": channel.allowed,
        "faults": channel.faults,
        "reference": reference,
        "other": other,
        "mean": mean,
        "largest": channel.largest._asdict(),
        "over_errors": channel.over_errors,
        "measures": channel.measures._asdict(),
        "statistics": {
            name: {**each._asdict(), "equal": each.equal} for name, each in channel.statistics.items()
        },
    }


def write_junit(compared: FilesCompared, path: Path) -> None:
    """Write JUnit XML, whole or not at all: a test suite for each file, a test case for each channel.

    A channel that is not within its tolerance, or not decided, is a failure; a channel that could not be
    compared is skipped. Raises OSError if the file cannot be written.
    """

    def within(parent: ElementTree.Element, tag: str, text: str = "", **attributes: str) -> ElementTree.Element:
        named = {name: cleaned(value) for name, value in attributes.items()}
        element = ElementTree.SubElement(parent, tag, named)
        element.text = cleaned(text) or None
        return element

    whole = ElementTree.Element("testsuites", name=NAME)
    for pair in compared.pairs:
        suite = within(whole, "testsuite", name=f"{pair.other.name} less {pair.reference.name}", errors="0")
        for name in (*pair.channels, *pair.left_out):
            case = within(suite, "testcase", classname=pair.other.name, name=name)
            if name in pair.left_out:
                within(case, "skipped", message=pair.left_out[name])
            elif faults := pair.channels[name].faults:
                verdict = pair.channels[name].verdict
                within(case, "failure", "\n".join(faults), type=verdict, message=faults[0])
        if text := "\n".join(notes(pair)):
            within(suite, "system-out", text)
    for counted in (whole, *whole):
        for name, tag in (("tests", "testcase"), ("failures", "failure"), ("skipped", "skipped")):
            counted.set(name, str(len(list(counted.iter(tag)))))
    ElementTree.indent(whole)
    with whole_file(path) as temporary:
        ElementTree.ElementTree(whole).write(temporary, encoding="UTF-8", xml_declaration=True)
