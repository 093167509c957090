"""Whether a result is close to a reference: within a tolerance, or within the errors of both."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from support_exudyn.files.series.named_series import NamedSeries, SeriesFile
from support_exudyn.files.series.read import read_series
from support_exudyn.postprocessing.comparing.common_times import ComparedColumn
from support_exudyn.postprocessing.comparing.compared_channel import ComparedChannel, ComparedWindow, compared
from support_exudyn.postprocessing.comparing.compared_file import is_own
from support_exudyn.postprocessing.comparing.kept_run import determined_until, kept_number
from support_exudyn.postprocessing.comparing.tolerance import BOTH_ERRORS, PERCENT, Tolerance, tolerance
from support_exudyn.postprocessing.comparing.with_errors import curve_errors
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.result import Result
from user_forces.values.names import meant
from user_forces.values.value import InputError, short

Measured = Result | NamedSeries | Estimate | float
Reference = Measured | SeriesFile | str | PathLike[str] | Mapping[str, NamedSeries | Estimate | float]
ALONE = "it"  # the name of a number without a name


def closeness(
    result: Measured,
    reference: Reference,
    allowed: float | str | None = None,
    *,
    channels: Sequence[str] = (),
    after: float = 0.0,
    until: float = math.inf,
) -> list[ComparedChannel]:
    """Each curve or number of a result against its reference, those that are not within first.

    Arguments:
        result: a Result, a NamedSeries, an Estimate such as `result.numbers()[name]`, or a number.
        reference: another Result; a file with curves, by its path or as `read_series` gives it; a NamedSeries;
            an Estimate or a number; or several of these by the names of channels and numbers of a Result.
        allowed: a relative tolerance, such as 0.02 or "2 %": of curves it is of the range of the reference, of
            numbers of their reference; an amount with its unit, "0.1 mm"; None: the errors of both, which have
            to be known of one side at least, and of curves up to the time when runs are determined.
        channels: of a Result, by names or patterns; without, all that both have.
        after, until: the part of curves and runs that is compared [s].

    Raises InputError if there is nothing to compare, if units do not fit, or if the tolerance is none.
    """
    if isinstance(reference, (str, PathLike)):
        path = Path(reference)
        reference = Result.load(path) if is_own(path) else read_series(path)
    rule, window = _rule(allowed), ComparedWindow(after, until)
    if not isinstance(result, Result):
        name = result.name if isinstance(result, NamedSeries) else ALONE
        found = [compared(name, _column(reference), _column(result), rule, window)]
    else:
        if rule.is_errors:
            runs = [run for run in (result, reference) if isinstance(run, Result)]
            window = ComparedWindow(after, min([until, *map(determined_until, runs)]))
        numbers = result.numbers(after, until) if result.coarser is not None else {}
        names = _names(result, numbers, reference, channels)
        mine, its = _columns(result, numbers, names), _columns(reference, {}, names)
        found = [compared(name, its[name], mine[name], rule, window) for name in names]
    if rule.is_errors and (unknown := [one.name for one in found if np.isnan(one.errors).all()]):
        raise InputError(
            f"{unknown[0]}: no numerical error is known; allowed: a tolerance, such as '2 %', or runs with an "
            "accuracy"
        )
    return sorted(found, key=lambda one: one.verdict == "within")


def _rule(allowed: float | str | None) -> Tolerance:
    if allowed is None:
        return BOTH_ERRORS
    if isinstance(allowed, str):
        return tolerance("*", allowed)
    if isinstance(allowed, (int, float)) and not isinstance(allowed, bool) and 0.0 <= allowed < math.inf:
        return Tolerance("*", f"{100.0 * allowed:.4g} %", 100.0 * allowed, PERCENT)
    raise InputError(
        f"tolerance = {short(allowed)}: allowed: a share from 0 on, a text, '2 %' or '0.1 mm', None"
    )


def _names(
    result: Result, numbers: Mapping[str, Estimate], reference: Any, channels: Sequence[str]
) -> list[str]:
    """Names of the channels and numbers of a run that its reference has, too."""
    own = [*result.channels, *numbers]
    if isinstance(reference, Result):
        names = [name for name, channel in reference.channels.items() if channel.is_determined]
    elif isinstance(reference, (SeriesFile, NamedSeries, Mapping)):
        names = list(_several(reference))
    else:
        raise InputError(
            f"reference = {short(reference)}: is one number, the result a whole run; allowed: numbers by names"
        )
    if isinstance(reference, Mapping) and (missing := [name for name in names if name not in own]):
        raise InputError(
            f"{missing[0]}: the result has no such channel or number with an error; {meant(missing[0], own)}"
        )
    common = [name for name in names if name in own and name != "time"]
    if not common:
        known = ", ".join(list(result.channels)[1:4])
        raise InputError(f"reference: has no channel of the result; allowed: names such as {known}")
    return matching(common, channels) if channels else common


def _several(reference: SeriesFile | NamedSeries | Mapping[str, Any]) -> Mapping[str, Any]:
    if isinstance(reference, NamedSeries):
        return {reference.name: reference}
    return reference.series if isinstance(reference, SeriesFile) else reference


def _columns(item: Any, numbers: Mapping[str, Estimate], names: Sequence[str]) -> dict[str, ComparedColumn]:
    """Channels or numbers of these names with their errors."""
    if not isinstance(item, Result):
        several = _several(item)
        return {name: _column(several[name]) for name in names}
    errors = curve_errors(item, [name for name in names if name in item.channels])
    curves = {name: ComparedColumn(item.unit(name), item.time, item[name], errors[name]) for name in errors}
    return curves | {name: kept_number(numbers[name]) for name in names if name not in curves}


def _column(item: Any) -> ComparedColumn:
    """A curve or number as a column. Raises InputError if it is none."""
    if isinstance(item, NamedSeries):
        return ComparedColumn(item.unit, item.time, item.values, np.full(item.time.size, math.nan))
    if isinstance(item, Estimate):
        return kept_number(item)
    if isinstance(item, (int, float)) and not isinstance(item, bool):
        return kept_number(Estimate(float(item), math.nan, ""))._replace(unit=None)
    raise InputError(f"{short(item)}: cannot be compared; allowed: a NamedSeries, an Estimate, a number")
