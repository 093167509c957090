"""What a comparison says, in sentences and rows of tables."""

from __future__ import annotations

import math

import numpy as np

from support_exudyn.postprocessing.comparing.compared_channel import GAPS, LARGEST, ComparedChannel
from support_exudyn.postprocessing.comparing.files_compared import ComparedPair
from support_exudyn.postprocessing.comparing.verdict import WORST_FIRST, JudgedDifference, ToleranceVerdict
from support_exudyn.postprocessing.figures.units import DisplayUnit, readable_change, said
from support_exudyn.simulation.estimate import Estimate

Row = tuple[str, ...]
DIGITS = 6  # of numbers without a known error
MOST_DECIMALS = 9
BALANCED = 1e-14  # of the largest value
SHARE = 3  # of shares of a range
NONE = "-"
HEADER = (
    "channel", "unit", ">reference, mean", ">difference, mean", ">largest", ">at [s]", ">RMS/range", ">C",
    "beside errors",
)  # fmt: skip
WITH_VERDICT = (*HEADER, "verdict")
VERDICTS: dict[ToleranceVerdict, str] = {
    "within": "All channels are within their tolerances.",
    "not within": "Not all channels are within their tolerances.",
    "not decided": "Whether all channels are within their tolerances cannot be told.",
    "told": "No tolerance was given: nothing is judged.",
}


def title(pair: ComparedPair) -> str:
    """The head of the table of a file: which files, which times, whose numerical errors stand behind ±."""
    first = min(one.common.time[0] for one in pair.channels.values())
    last = max(one.common.time[-1] for one in pair.channels.values())
    return f"{pair.other.name} less {pair.reference.name}, {first:g} to {last:g} s ({errors_said(pair)})"


def errors_said(pair: ComparedPair) -> str:
    """Whose numerical errors are known, in words."""
    with_errors = [one for one in (pair.reference, pair.other) if one.has_errors]
    if len(with_errors) == 2:
        return "± numerical errors of both runs"
    if not with_errors:
        runs = [one for one in (pair.reference, pair.other) if one.run is not None]
        return "numerical errors not known" + (": an accuracy was not asked of the runs" if runs else "")
    rest = pair.other if with_errors[0] is pair.reference else pair.reference
    return f"± numerical errors of {with_errors[0].name}; those of {rest.name} are not known"


def rows(pair: ComparedPair) -> list[Row]:
    """A row a channel; without the verdict if no tolerance is given."""
    return [_row(one, len(header(pair)) > len(HEADER)) for one in pair.channels.values()]


def header(pair: ComparedPair) -> Row:
    """Heads of the table of the channels."""
    return HEADER if pair.verdict == "told" else WITH_VERDICT


def _row(one: ComparedChannel, judged: bool) -> Row:
    unit = shown_unit(one)
    largest = "" if math.isnan(one.largest.value) else math.copysign(1.0, one.measures.largest)
    signed = one.largest._replace(value=one.measures.largest) if largest else one.largest
    cells = (
        one.name,
        unit.name,
        number(_rounded(one.reference._replace(error=math.nan), one), unit.scale),
        number(_rounded(one.mean, one), unit.scale),
        number(signed, unit.scale),
        NONE if math.isnan(one.measures.largest_time) else f"{one.measures.largest_time:.6g}",
        share(one.measures.rms_of_range),
        share(one.measures.combined_error),
        beside(one),
    )
    return (*cells, verdict_words(one)) if judged else cells


def _rounded(mean: Estimate, one: ComparedChannel) -> Estimate:
    """A mean; 0 if it is what rounding leaves of values that balance."""
    largest = np.fmax(*(np.abs(curve).max(initial=0.0, where=np.isfinite(curve)) for curve in one.common[1:3]))
    balanced = math.isnan(mean.error) and abs(mean.value) < BALANCED * largest
    return mean._replace(value=0.0) if balanced else mean


def shown_unit(one: ComparedChannel) -> DisplayUnit:
    """The unit in which a channel and its differences are read best."""
    means = max(abs(one.reference.value), abs(one.other.value))
    largest = one.largest.value if math.isfinite(one.largest.value) else abs(one.mean.value)
    return readable_change(one.unit, means, abs(largest))


def number(found: Estimate, scale: float) -> str:
    """A number in a unit, with its error if that is known."""
    value, error = scale * found.value, scale * found.error
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
    return NONE if math.isnan(value) else f"{100.0 * value:.{SHARE}g} %"


def beside(one: ComparedChannel) -> str:
    """The largest difference beside the numerical errors that are known, in words."""
    if not one.with_errors:
        return "not known"
    said_so = str(one.beside_errors)
    if len(one.with_errors) == 2:
        return said_so
    of = f"the error of {one.with_errors[0]}"
    if one.beside_errors.within is False and math.isfinite(one.beside_errors.times):
        return f"{said_so} {of}"
    return said_so.replace("both errors", of)


def verdict_words(one: ComparedChannel) -> str:
    """The verdict on a channel, with its tolerance."""
    if one.tolerance is None:
        return "no tolerance"
    asked = one.tolerance.text
    return {"within": f"within {asked}", "not within": f"NOT within {asked}"}.get(
        one.verdict, f"not decided, {asked}"
    )


def faults(one: ComparedChannel) -> list[str]:
    """Why a channel is not within its tolerance, or not decided: a sentence a number, the worst first."""
    if one.tolerance is None:
        return []
    if not one.judged:
        return [f"{one.name}: there is nothing to judge by: no two common times on one side of the parting."]
    worst_first = sorted(one.judged, key=lambda judged: WORST_FIRST.index(judged.verdict))
    return [_fault(one, judged) for judged in worst_first if judged.verdict in ("not within", "not decided")]


def fault(one: ComparedChannel) -> str:
    """The first of the faults, and how many more there are; empty if there are none."""
    first, *more = faults(one) or [""]
    return f"{first} And {len(more)} more." if more else first


def _fault(one: ComparedChannel, judged: JudgedDifference) -> str:
    assert one.tolerance is not None
    allowed = said(judged.allowed, one.unit, 4)
    if one.tolerance.is_relative and judged.allowed == 0.0:
        allowed = f"{allowed}, for the reference is constant (give an amount with its unit)"
    elif one.tolerance.is_relative:
        allowed = f"{allowed} ({one.tolerance.text} of the reference's range)"
    if judged.what == GAPS:
        return (
            f"{one.name}: has no value at {one.gaps} of {one.common.time.size} times at which the reference is "
            "known: not decided. A part without gaps can be judged (--after, --until), or the file with gaps "
            "be the reference."
        )
    what = judged.what if judged.what == LARGEST else f"{judged.what.replace('_', ' ')} after the parting"
    at = f" at {one.measures.largest_time:.6g} s" if judged.what == LARGEST else ""
    if judged.what == LARGEST and math.isfinite(one.largest_of_reference):
        at += f" ({share(one.largest_of_reference)} of the reference there)"
    if math.isnan(judged.value):
        return f"{one.name}: {what}: could not be computed; allowed is {allowed}."
    value = said(judged.value, one.unit, 4)
    if judged.verdict == "not within":
        return f"{one.name}: {what} {value}{at}; allowed is {allowed}."
    error = said(judged.error, one.unit, 2) if math.isfinite(judged.error) else "not known"
    kind = "its error" if judged.what == LARGEST else "half its confidence interval"
    return (
        f"{one.name}: {what} {value}{at}; {kind}, {error}, is larger than what is allowed, {allowed}: not "
        "decided. "
        "A finer accuracy, longer runs or more records may decide it."
    )
