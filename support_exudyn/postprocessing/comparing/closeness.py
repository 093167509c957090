"""Whether a result is close to a reference: within a tolerance, or within the errors of both."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from support_exudyn.files.series.named_series import NamedSeries, SeriesFile
from support_exudyn.files.series.read import read_series
from support_exudyn.files.series.units import converted
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.comparing.common_times import on_common_times
from support_exudyn.postprocessing.comparing.compared_channel import (
    WORST_FIRST,
    JudgedDifference,
    verdict_ranks,
)
from support_exudyn.postprocessing.comparing.compared_file import is_own
from support_exudyn.postprocessing.comparing.kept_run import KeptColumn, kept_impacts, kept_number
from support_exudyn.postprocessing.comparing.mapping import PERCENT, Tolerance, tolerance
from support_exudyn.postprocessing.comparing.with_errors import curve_errors, errors_at
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.result import Result
from user_forces.values.names import meant
from user_forces.values.value import InputError, short

Measured = Result | NamedSeries | Estimate | float
Reference = Measured | SeriesFile | str | PathLike[str] | Mapping[str, NamedSeries | Estimate | float]
ALONE = "it"  # the name of a number without a name
KINDS = "a NamedSeries, an Estimate, a number"
BOTH_ERRORS = "both errors"


class Closeness(NamedTuple):
    """A curve or number against its reference, at the record that is farthest beyond what is allowed.

    name: of it. unit: of all. time: of the record [s]; None of a number. value, reference: there.
    judged: their difference, with its error where that is not what is allowed. rule: the tolerance in words.
    """

    name: str
    unit: str
    time: float | None
    value: float
    reference: float
    judged: JudgedDifference
    rule: str

    @property
    def is_close(self) -> bool:
        """Whether it is surely as close as is allowed."""
        return self.judged.verdict == "within"

    def __str__(self) -> str:
        """The worst number in a line: where, what it is, what it should be."""
        at = "" if self.time is None else f" at t = {self.time:.6g} s"
        now, was = self._said(self.value, 9), self._said(self.reference, 9)
        limit = self._said(self.judged.allowed, 3)
        words = f"{self.name}: {now}{at}, where the reference is {was}: "
        if self.judged.verdict == "not decided":
            known = self._said(self.judged.error, 3) if math.isfinite(self.judged.error) else "not known"
            words += f"it cannot be told whether they are close, for the numerical error is {known}"
            return f"{words}; allowed: {limit} ({self.rule}); a higher accuracy may tell"
        return f"{words}they differ by {self._said(self.judged.value, 3)}; allowed: {limit} ({self.rule})"

    def _said(self, value: float, digits: int) -> str:
        return f"{value:.{digits}g} {self.unit}".rstrip()


def closeness(
    result: Measured,
    reference: Reference,
    allowed: float | str | None = None,
    *,
    channels: Sequence[str] = (),
    after: float = 0.0,
    until: float = math.inf,
) -> list[Closeness]:
    """Each curve or number of a result against its reference, the farthest from it first.

    Arguments:
        result: a Result, a NamedSeries, an Estimate such as `result.numbers()[name]`, or a number.
        reference: another Result; a file with curves, by its path or as `read_series` gives it; a NamedSeries;
            an Estimate or a number; or several of these by the names of channels and numbers of a Result.
        allowed: a relative tolerance, such as 0.02 or "2 %": of curves it is of the range of the reference, of
            numbers of their reference; an amount with its unit, "0.1 mm"; None: the errors of both, which have
            to be known of one side at least, and of curves up to the time when runs are determined, see
            `kept_impacts`.
        channels: of a Result, by names or patterns; without, all that both have.
        after, until: the part of curves and runs that is compared [s].

    Raises InputError if there is nothing to compare, if units do not fit, or if the tolerance is none.
    """
    if isinstance(reference, (str, PathLike)):
        path = Path(reference)
        reference = Result.load(path) if is_own(path) else read_series(path)
    end, rule = until, _rule(allowed)
    if rule is None:
        runs = [one for one in (result, reference) if isinstance(one, Result) and one.coarser is not None]
        end = min([until, *(kept_impacts(run)[1] for run in runs)])
    pairs = _pairs(result, reference, channels, (after, until))
    compared = [compared_columns(name, mine, its, rule, after, end) for name, mine, its in pairs]
    return sorted(compared, key=lambda one: (one.is_close, -one.judged.ratio))


def _rule(allowed: float | str | None) -> Tolerance | None:
    if allowed is None:
        return None
    if isinstance(allowed, str):
        return tolerance("*", allowed)
    if isinstance(allowed, (int, float)) and not isinstance(allowed, bool) and 0.0 <= allowed < math.inf:
        return Tolerance("*", f"{100.0 * allowed:.4g} %", 100.0 * allowed, PERCENT)
    raise InputError(
        f"tolerance = {short(allowed)}: allowed: a share from 0 on, a text, '2 %' or '0.1 mm', None"
    )


# --- what is compared with what ---


def _pairs(
    result: Measured, reference: Any, channels: Sequence[str], window: tuple[float, float]
) -> list[tuple[str, KeptColumn, KeptColumn]]:
    """Names, and the columns of both."""
    if not isinstance(result, Result):
        name = result.name if isinstance(result, NamedSeries) else ALONE
        return [(name, _column(result), _column(reference))]
    numbers = result.numbers(*window) if result.coarser is not None else {}
    own = [*result.channels, *numbers]
    others = _several(reference)
    if isinstance(reference, Mapping) and (missing := [name for name in others if name not in own]):
        raise InputError(
            f"{missing[0]}: the result has no such channel or number with an error; {meant(missing[0], own)}"
        )
    known = [name for name in others if name in own and name != "time"]
    names = matching(known, channels) if channels else known
    if not names:
        raise InputError(
            "reference: has no channel of the result; allowed: names such as "
            f"{', '.join(list(result.channels)[1:4])}"
        )
    mine = _columns(result, [name for name in names if name in result.channels])
    mine |= {name: _column(numbers[name]) for name in names if name not in mine}
    if isinstance(reference, Result):
        its = _columns(reference, names)
    else:
        its = {name: _column(others[name]) for name in names}
    return [(name, mine[name], its[name]) for name in names]


def _several(reference: Any) -> Mapping[str, Any]:
    """What a run is compared with, by its names. Raises InputError if that is a number without a name."""
    if isinstance(reference, Result):
        return {name: channel for name, channel in reference.channels.items() if channel.is_determined}
    if isinstance(reference, SeriesFile):
        return reference.series
    if isinstance(reference, NamedSeries):
        return {reference.name: reference}
    if isinstance(reference, Mapping):
        return reference
    raise InputError(
        f"reference = {short(reference)}: is one number, the result a whole run; allowed: numbers by names"
    )


def _columns(run: Result, names: Sequence[str]) -> dict[str, KeptColumn]:
    """Channels of a run with their errors."""
    errors = curve_errors(run, names)
    return {name: KeptColumn(run.unit(name), run.time, run[name], errors[name]) for name in names}


def _column(item: Any) -> KeptColumn:
    """A curve or number as a column. Raises InputError if it is none."""
    if isinstance(item, NamedSeries):
        return KeptColumn(item.unit, item.time, item.values, np.full(item.time.size, math.nan))
    if isinstance(item, Estimate):
        return kept_number(item)
    if isinstance(item, (int, float)) and not isinstance(item, bool):
        return kept_number(Estimate(float(item), math.nan, ""))._replace(unit=None)
    raise InputError(f"{short(item)}: cannot be compared; allowed: {KINDS}")


# --- by how much ---


def compared_columns(
    name: str,
    mine: KeptColumn,
    its: KeptColumn,
    rule: Tolerance | None = None,
    after: float = -math.inf,
    until: float = math.inf,
) -> Closeness:
    """A column against its reference, curves at common times between two times [s].

    rule: the tolerance; None: the errors of both.

    Raises InputError if a curve stands against a number, if units do not fit, or if no error is known.
    """
    if bool(mine.time.size) != bool(its.time.size):
        raise InputError(f"{name}: is a curve beside a number; allowed: curves with curves")
    unit = its.unit or "" if mine.unit is None else mine.unit
    time, values, reference, scale = mine.time, mine.values, its.values, 1.0
    if its.unit != unit and (its.unit is not None or its.time.size):  # a number without a unit is in that unit
        reference = converted(NamedSeries(name, its.unit, its.time, reference), unit)
        ends = NamedSeries(name, its.unit, np.zeros(2), np.array([0.0, 1.0]))
        scale = abs(float(np.diff(converted(ends, unit))[0]))
    errors, other, more = mine.errors, scale * its.errors, np.zeros(1)
    if time.size:
        common = on_common_times(its.time, reference, time, values, after, until)
        errors, other = errors_at(common.time, time, errors), errors_at(common.time, its.time, other)
        time, values, reference, more = common.time, common.other, common.reference, common.interpolation_error
    # an error that is not known counts for nothing if the other is
    errors = np.where(np.isnan(errors), other, np.where(np.isnan(other), errors, errors + other))
    if rule is None:
        if np.isnan(errors).all():
            raise InputError(
                f"{name}: no numerical error is known; allowed: a tolerance, such as '2 %', or runs with an "
                "accuracy"
            )
        known = np.isfinite(errors)
        allowed, errors = np.where(known, errors + more, 0.0), np.where(known, 0.0, math.inf)
        return _worst(name, unit, time, values, reference, allowed, errors, BOTH_ERRORS)
    size = float(np.nanmax(reference) - np.nanmin(reference)) if time.size else abs(float(reference[0]))
    allowed = np.full(values.size, rule.in_si(name, unit, size))
    of = f" of the {'range' if time.size else 'value'} of the reference" if rule.is_relative else ""
    errors = np.nan_to_num(errors) + more
    return _worst(name, unit, time, values, reference, allowed, errors, f"{rule.text}{of}")


def _worst(
    name: str,
    unit: str,
    time: Series,
    values: Series,
    reference: Series,
    allowed: Series,
    errors: Series,
    rule: str,
) -> Closeness:
    """The verdict on all records (n,), and the worst: the farthest, as a share of what is allowed.

    Where errors are larger than what is allowed, and a difference that is within them could turn the answer,
    nothing is decided. Where the reference has no value there is nothing to compare with.
    """
    off = np.abs(values - reference)
    off[np.isnan(reference)] = 0.0
    off = np.where(np.isnan(off), math.inf, off)
    ranks = verdict_ranks(off, errors, allowed)
    if WORST_FIRST[ranks.min()] == "not decided":
        sizes = errors
    else:
        sizes = np.divide(off, allowed, out=np.where(off > 0.0, math.inf, 0.0), where=allowed > 0.0)
    where = int(np.where(ranks == ranks.min(), sizes, -1.0).argmax())
    at = float(time[where]) if time.size else None
    judged = JudgedDifference(rule, float(off[where]), float(errors[where]), float(allowed[where]))
    return Closeness(name, unit, at, float(values[where]), float(reference[where]), judged, rule)
