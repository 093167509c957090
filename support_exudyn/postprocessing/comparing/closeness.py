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
from support_exudyn.postprocessing.comparing.compared_channel import ToleranceVerdict
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
KINDS = "a Result, a NamedSeries, an Estimate, a number"
BOTH_ERRORS = "both errors"


class Closeness(NamedTuple):
    """A curve or number against its reference, at the record that is farthest beyond what is allowed.

    name: of it. unit: of all. time: of the record [s]; None of a number. value, reference: there.
    allowed: by how much they may differ. error: of their difference, where that is not what is allowed.
    ratio: difference over what is allowed; infinite if nothing is allowed, or unknown.
    verdict: on all records. rule: the tolerance in words.
    """

    name: str
    unit: str
    time: float | None
    value: float
    reference: float
    allowed: float
    error: float
    ratio: float
    verdict: ToleranceVerdict
    rule: str

    @property
    def is_close(self) -> bool:
        """Whether it is surely as close as is allowed."""
        return self.verdict == "within"

    def __str__(self) -> str:
        """The worst number in a line: where, what it is, what it should be."""
        at = "" if self.time is None else f" at t = {self.time:.6g} s"
        now, was, limit = self._said(self.value, 9), self._said(self.reference, 9), self._said(self.allowed, 3)
        words = f"{self.name}: {now}{at}, where the reference is {was}: "
        if self.verdict == "not decided":
            known = self._said(self.error, 3) if math.isfinite(self.allowed) else "not known"
            words += f"it cannot be told whether they are close, for the numerical error is {known}"
            return f"{words}; allowed: {limit} ({self.rule}); a higher accuracy may tell"
        apart = self._said(abs(self.value - self.reference), 3)
        return f"{words}they differ by {apart}; allowed: {limit} ({self.rule})"

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
    return sorted(compared, key=lambda one: (one.is_close, -one.ratio))


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
    several = isinstance(reference, (Result, SeriesFile, Mapping))
    if not isinstance(result, Result):
        if several:
            raise InputError(
                f"result = {short(result)}: has one value, its reference several; allowed: a Result, or the "
                "one channel or number of the reference"
            )
        name = result.name if isinstance(result, NamedSeries) else ALONE
        return [(name, _column(result), _column(reference))]
    if not several and not isinstance(reference, NamedSeries):
        raise InputError(
            f"reference = {short(reference)}: is one number, the result a whole run; allowed: numbers by names"
        )
    numbers = result.numbers(*window) if result.coarser is not None else {}
    others: Mapping[str, Any] = {reference.name: reference} if isinstance(reference, NamedSeries) else reference
    if isinstance(reference, SeriesFile):
        others = reference.series
    elif isinstance(reference, Result):
        others = {name: None for name, channel in reference.channels.items() if channel.is_determined}
    known = [name for name in others if name in result.channels or name in numbers]
    if isinstance(reference, Mapping) and len(known) < len(others):
        missing = next(name for name in others if name not in known)
        meaning = meant(missing, [*result.channels, *numbers])
        raise InputError(f"{missing}: the result has no such channel or number with an error; {meaning}")
    names = [name for name in (matching(known, channels) if channels else known) if name != "time"]
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
        return _worst(name, unit, time, values, reference, errors + more, np.zeros(values.size), BOTH_ERRORS)
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
    unknown = ~np.isfinite(allowed)
    undecided = unknown | ((errors > allowed) & (off - errors <= allowed))
    beyond = (off > allowed) & ~undecided
    ratio = np.divide(off, allowed, out=np.where(off > 0.0, math.inf, 0.0), where=allowed > 0.0)
    ratio[unknown] = 0.0
    verdict: ToleranceVerdict = "not within" if beyond.any() else "not decided" if undecided.any() else "within"
    if verdict == "not decided":
        where = int(np.where(undecided, np.where(unknown, math.inf, errors), -1.0).argmax())
    else:
        where = int(np.where(beyond | ~beyond.any(), ratio, -1.0).argmax())
    at = float(time[where]) if time.size else None
    now, was, limit, error = (float(one[where]) for one in (values, reference, allowed, errors))
    return Closeness(name, unit, at, now, was, limit, error, float(ratio[where]), verdict, rule)
