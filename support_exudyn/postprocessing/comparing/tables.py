"""The tables of a comparison, which the terminal and the page show: channels and statistics."""

from __future__ import annotations

import math
from typing import NamedTuple

from support_exudyn.postprocessing.comparing.compared_channel import (
    GAPS,
    LARGEST,
    WORST_FIRST,
    ComparedChannel,
    JudgedDifference,
    ToleranceVerdict,
)
from support_exudyn.postprocessing.comparing.files_compared import ComparedPair
from support_exudyn.postprocessing.comparing.statistics import StatisticDifference
from support_exudyn.postprocessing.figures.units import DisplayUnit, readable, readable_change, said
from support_exudyn.simulation.estimate import Estimate

Row = tuple[str, ...]
DIGITS = 6  # of numbers without a known error
MOST_DECIMALS = 9
NONE = "-"
VERDICTS: dict[ToleranceVerdict, str] = {
    "within": "All channels are within their tolerances.",
    "not within": "Not all channels are within their tolerances.",
    "not decided": "Whether all channels are within their tolerances cannot be told.",
    "told": "No tolerance was given: nothing is judged.",
}


class Table(NamedTuple):
    """A table: title, heads of the columns, which begin with > over numbers, rows, and a note below it."""

    title: str
    header: Row
    rows: tuple[Row, ...]
    note: str = ""


def tables(pair: ComparedPair, brief: bool) -> list[Table]:
    """The tables of a file compared with the reference, those with rows.

    brief: of the statistics after the horizon the means alone, and those that differ.
    """
    statistics = tuple(
        _statistic(name, what, channel.unit, statistic)
        for name, channel in pair.channels.items()
        for what, statistic in channel.statistics.items()
        if not brief or what == "mean" or statistic.equal is False
    )
    after = f"{pair.window.horizon:.6g} s"
    shown = [
        _channels(pair),
        Table(
            f"after {after}: means, and what else differs (all: --page)"
            if brief
            else f"Statistics after {after}",
            ("channel", "statistic", "unit", ">reference", ">other", ">difference", ">±", "difference is"),
            statistics,
            "±: half of the confidence interval of the difference.",
        ),
    ]
    return [table for table in shown if table.rows]


def _channels(pair: ComparedPair) -> Table:
    """A row a channel, with the verdict if a tolerance is given. The title states files, times and errors."""
    first = min(channel.common.time[0] for channel in pair.channels.values())
    last = max(channel.common.time[-1] for channel in pair.channels.values())
    title = f"{pair.other.name} less {pair.reference.name}, {first:g} to {last:g} s ({_errors_known(pair)})"
    header: Row = (
        "channel", "unit", ">reference, mean", ">difference, mean", ">largest", ">at [s]", ">RMS/range", ">C",
        "beside errors",
    )  # fmt: skip
    rows = [_channel(channel) for channel in pair.channels.values()]
    if pair.verdict != "told":
        header = (*header, "verdict")
        rows = [(*row, verdict_words(one)) for row, one in zip(rows, pair.channels.values(), strict=True)]
    before = " before the horizon" if math.isfinite(pair.window.horizon) else ""
    note = (
        f"Means are over all times. Largest difference, RMS over the reference's range and C of Sprague and "
        f"Geers{before}. Beside errors: whether the largest difference is larger than the numerical errors "
        "that are known."
    )
    return Table(title, header, tuple(rows), note)


def _errors_known(pair: ComparedPair) -> str:
    """Whose numerical errors are known, in words."""
    known = [file.name for file in (pair.reference, pair.other) if file.has_errors]
    if len(known) == 2:
        return "± numerical errors of both runs"
    return f"± numerical errors of {known[0]} alone" if known else "numerical errors not known"


def _channel(one: ComparedChannel) -> Row:
    unit = shown_unit(one)
    largest = one.largest
    if math.isfinite(one.measures.largest):
        largest = largest._replace(value=one.measures.largest)
    return (
        one.name,
        unit.name,
        number(one.reference._replace(error=math.nan), unit.scale),
        number(one.mean, unit.scale),
        number(largest, unit.scale),
        NONE if math.isnan(one.measures.largest_time) else f"{one.measures.largest_time:.6g}",
        share(one.measures.rms_of_range),
        share(one.measures.combined_error),
        beside(one),
    )


def shown_unit(one: ComparedChannel) -> DisplayUnit:
    """The unit in which a channel and its differences are read best."""
    means = max(abs(one.reference.value), abs(one.other.value))
    largest = one.largest.value if math.isfinite(one.largest.value) else abs(one.mean.value)
    return readable_change(one.unit, means, abs(largest))


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


def beside(one: ComparedChannel) -> str:
    """The largest difference against the numerical errors that are known, in words."""
    if not one.with_errors:
        return "not known"
    errors = "both errors" if len(one.with_errors) > 1 else f"the error of {one.with_errors[0]}"
    return in_multiples(one.beside_errors, errors)


def in_multiples(judged: JudgedDifference, errors: str = "both errors") -> str:
    """A difference against errors: "within both errors", "larger: 3.1 times", "errors not known"."""
    if judged.verdict != "not within":
        return f"within {errors}" if judged.verdict == "within" else "errors not known"
    if math.isinf(judged.ratio):
        return "larger, and no errors"
    return f"larger: {float(f'{judged.ratio:.2g}'):.15g} times"  # 310, and not 3.1e+02


def verdict_words(one: ComparedChannel) -> str:
    """The verdict on a channel, with its tolerance."""
    if one.tolerance is None:
        return "no tolerance"
    words = {"within": "within ", "not within": "NOT within "}.get(one.verdict, "not decided, ")
    return f"{words}{one.tolerance.text}"


def _statistic(channel: str, what: str, unit: str, one: StatisticDifference) -> Row:
    shown = readable(unit, max(abs(one.first), abs(one.second)))
    numbers = (f"{shown.scale * value:.5g}" for value in (one.first, one.second, one.difference))
    half = NONE if one.equal is None else f"{shown.scale * one.tellable:.3g}"
    words = {True: "0 or not to be told from it", False: "not 0", None: "not known: too few records"}[one.equal]
    return channel, what.replace("_", " "), shown.name, *numbers, half, words


# --- why a channel is not within its tolerance ---


def faults(one: ComparedChannel) -> list[str]:
    """Why a channel is not within its tolerance, or not decided: a sentence a number, the worst first."""
    if one.tolerance is None:
        return []
    if not one.judged:
        return [f"{one.name}: there is nothing to judge by: there are no two common times."]
    worst_first = sorted(one.judged, key=lambda judged: WORST_FIRST.index(judged.verdict))
    return [_fault(one, judged) for judged in worst_first if judged.verdict in ("not within", "not decided")]


def _fault(one: ComparedChannel, judged: JudgedDifference) -> str:
    if judged.what == GAPS:
        return (
            f"{one.name}: has no value at {one.gaps} of {one.common.time.size} times at which the reference is "
            "known: not decided. A part without gaps can be judged (--after, --until), or the file with gaps "
            "be the reference."
        )
    allowed = said(judged.allowed, one.unit, 4)
    if one.tolerance is not None and one.tolerance.is_relative:
        share_of = f" ({one.tolerance.text} of the reference's range)"
        constant = ", for the reference is constant (give an amount with its unit)"
        allowed += share_of if judged.allowed else constant
    what, kind = f"{judged.what.replace('_', ' ')} after the horizon", "half its confidence interval"
    if judged.what == LARGEST:
        what, kind = LARGEST, "its error"
    if math.isnan(judged.value):
        return f"{one.name}: {what}: could not be computed; allowed is {allowed}."
    what += f" {said(judged.value, one.unit, 4)}"
    if judged.what == LARGEST:
        what += f" at {one.measures.largest_time:.6g} s"
        if math.isfinite(one.largest_of_reference):
            what += f" ({share(one.largest_of_reference)} of the reference there)"
    if judged.verdict == "not within":
        return f"{one.name}: {what}; allowed is {allowed}."
    error = said(judged.error, one.unit, 2) if math.isfinite(judged.error) else "not known"
    return (
        f"{one.name}: {what}; {kind}, {error}, is larger than what is allowed, {allowed}: not decided. "
        "A finer accuracy, longer runs or more records may decide it."
    )
