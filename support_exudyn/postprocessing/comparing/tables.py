"""The rows of a comparison for a terminal, as CSV, as data for scripts, as JUnit XML; and its notes."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.comparing.compared_channel import ComparedChannel, ComparedRow, Verdict
from support_exudyn.postprocessing.comparing.files_compared import ComparedPair, FilesCompared, first_names
from support_exudyn.postprocessing.comparing.mapping import PERCENT
from support_exudyn.postprocessing.comparing.measures import CONFIDENCE
from support_exudyn.postprocessing.figures.selection import CLEARANCE
from support_exudyn.postprocessing.figures.units import DisplayUnit, amount, readable_change
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.postprocessing.shown_numbers import rounded
from user_forces.values.value import cleaned

HEADER = ("channel", "measure", "unit", "reference", "other", "difference", "tolerance", "verdict")
DIGITS, MOST_DIGITS = 6, 9  # of numbers without a known error, and with it
VERDICTS: dict[Verdict, str] = {
    "agrees": "All channels agree.",
    "differs within tolerance": "All channels are within their tolerances.",
    "differs": "Not all channels are within their tolerances.",
    "not decided": "Whether all channels are within their tolerances is not decided.",
    "not comparable": "No channel is comparable.",
}


def conclusion(compared: FilesCompared) -> str:
    """The verdict on all files as a sentence."""
    if all(channel.tolerance is None for channel in compared.channels):
        return "No tolerance was given: the verdicts are by numerical errors alone."
    return VERDICTS[compared.verdict]


def table(pair: ComparedPair) -> Sheet:
    """The table of a comparison: its rows in the units in which they are read best."""
    times = [channel.common.time for channel in pair.channels.values()]
    first, last = min(time[0] for time in times), max(time[-1] for time in times)
    known = [file.name for file in (pair.reference, pair.other) if file.has_errors]
    errors = f"± numerical errors of {' and '.join(known)}" if known else "numerical errors not known"
    return Sheet(
        f"{pair.other.name} less {pair.reference.name}, {first:g} to {last:g} s ({errors})",
        HEADER,
        tuple(cells for channel in pair.channels.values() for cells in _cells(channel)),
        "Means are over all times; largest difference, RMS over the reference's range and C of Sprague and "
        "Geers over those before the horizon.",
        left=3,
    )


def _cells(channel: ComparedChannel) -> Iterator[tuple[str, ...]]:
    """The cells of the rows of a channel, in the unit in which its mean and its differences are read best."""
    mean, largest = channel.rows[0], channel.largest.value
    apart = largest if math.isfinite(largest) else abs(mean.difference)
    shown = readable_change(channel.unit, max(abs(mean.reference), abs(mean.other)), apart)
    for row in channel.rows:
        unit, digits = (DisplayUnit(PERCENT, 1.0), 3) if row.unit == PERCENT else (shown, DIGITS)
        numbers = (unit.scale * value for value in (row.reference, row.other, row.difference))
        *sides, difference = ("" if math.isnan(number) else f"{number:.{digits}g}" for number in numbers)
        if math.isinf(row.error):
            difference += " ± not known" if difference else ""
        elif not math.isnan(row.error + row.difference):
            difference = rounded(unit.scale * row.difference, unit.scale * row.error, MOST_DIGITS)
        tolerance = channel.tolerance.text if channel.tolerance is not None and row.verdict else ""
        when = f", at {row.time:.6g} s" if math.isfinite(row.time) else ""
        yield row.channel, f"{row.measure}{when}", unit.name, *sides, difference, tolerance, row.verdict or ""


def notes(pair: ComparedPair) -> Iterator[str]:
    """Notes on a comparison: reading, shifts, the horizon, times, gaps, what is left out."""
    files = pair.reference, pair.other
    for file in files:
        yield from (f"{file.name}: {note}" for note in file.notes)
        if file.shift and (pair.shift is None or file is pair.reference):
            yield f"{file.name}: {amount(file.shift, 's', 4)} are added to its times"
    if (shift := pair.shift) is not None:
        late = "lags behind" if shift.shift > 0.0 else "is ahead of"
        yield (
            f"{pair.other.name} {late} {pair.reference.name} by {amount(abs(shift.shift), 's', 5)} in "
            f"{shift.channel} (correlation {shift.correlation:.4f}); that is taken off its times"
        )
    if math.isfinite(pair.horizon):
        yield (
            f"point by point up to {pair.horizon:.6g} s, the horizon of "
            f"{min(files, key=lambda each: each.horizon).name}, from which on shorter steps change impacts; "
            "after it by statistics, if there are enough common times, with "
            f"{100.0 * CONFIDENCE:.3g} % confidence of all together"
        )
    for name, channel in pair.channels.items():
        for file, values in zip(files, channel.common[1:3], strict=True):
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


# --- for other programs ---


def as_data(compared: FilesCompared) -> dict[str, Any]:
    """The whole comparison: the verdict, and the results of each file and each of its channels, in SI."""
    return {
        "reference": compared.reference.path,
        "kind": compared.reference.kind,
        "verdict": compared.verdict,
        "failed": compared.failed,
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


def _channel_data(channel: ComparedChannel) -> dict[str, Any]:
    return {
        "unit": channel.unit,
        "verdict": channel.verdict,
        "tolerance": None if channel.tolerance is None else channel.tolerance.text,
        "allowed": channel.allowed,
        "faults": channel.faults,
        "mean": channel.mean._asdict(),
        "largest": channel.largest._asdict(),
        "over_errors": channel.over_errors,
        "measures": channel.measures._asdict(),
        "statistics": {
            name: {**each._asdict(), "equal": each.equal} for name, each in channel.statistics.items()
        },
        "rows": [row._asdict() for row in channel.rows],
    }


def write_csv(compared: FilesCompared, path: Path) -> None:
    """Write all rows as CSV in SI, whole or not at all; empty cells where a number is not known."""
    import pandas as pd  # which a comparison without a file has no use for

    rows = [(pair.other.name, *row) for pair in compared.pairs for row in pair.rows()]
    with whole_file(path) as temporary:
        pd.DataFrame(rows, columns=["file", *ComparedRow._fields]).to_csv(temporary, index=False)


def write_junit(compared: FilesCompared, path: Path) -> None:
    """Write JUnit XML, whole or not at all: a test suite for each file, a test case for each channel.

    A channel that is not within its tolerance, or not decided, is a failure; a channel that could not be
    compared is skipped. Raises OSError if the file cannot be written.
    """

    def within(parent: ElementTree.Element, tag: str, text: str = "", **attributes: str) -> ElementTree.Element:
        element = ElementTree.SubElement(parent, tag, {name: cleaned(it) for name, it in attributes.items()})
        element.text = cleaned(text) or None
        return element

    whole = ElementTree.Element("testsuites", name="support-exudyn compare")
    for pair in compared.pairs:
        suite = within(whole, "testsuite", name=f"{pair.other.name} less {pair.reference.name}", errors="0")
        for name, reason in {**dict.fromkeys(pair.channels, ""), **pair.left_out}.items():
            case = within(suite, "testcase", classname=pair.other.name, name=name)
            if reason:
                within(case, "skipped", message=reason)
            elif faults := pair.channels[name].faults:
                kind = pair.channels[name].verdict
                within(case, "failure", "\n".join(faults), type=kind, message=faults[0])
        if text := "\n".join(notes(pair)):
            within(suite, "system-out", text)
    for counted in (whole, *whole):
        for name, tag in (("tests", "testcase"), ("failures", "failure"), ("skipped", "skipped")):
            counted.set(name, str(len(list(counted.iter(tag)))))
    ElementTree.indent(whole)
    with whole_file(path) as temporary:
        ElementTree.ElementTree(whole).write(temporary, encoding="UTF-8", xml_declaration=True)
