"""Whether a result is close to a reference: within a tolerance, or within the errors of both."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import NamedTuple, TypeGuard

import numpy as np

from support_exudyn.files.series.named_series import NamedSeries, SeriesFile
from support_exudyn.files.series.read import read_series
from support_exudyn.files.series.units import converted
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.baselines.kept_impacts import kept_impacts
from support_exudyn.postprocessing.baselines.safe_errors import safe_errors
from support_exudyn.postprocessing.comparing.common_times import on_common_times
from support_exudyn.postprocessing.comparing.compared_channel import ToleranceVerdict
from support_exudyn.postprocessing.comparing.compared_file import is_own
from support_exudyn.postprocessing.comparing.mapping import Tolerance, tolerance
from support_exudyn.postprocessing.figures.selection import CLEARANCE, matching
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.result import Result
from user_forces.values.names import meant
from user_forces.values.value import InputError, short

Number = Estimate | float
Referred = Result | SeriesFile | NamedSeries | Estimate | float | str | PathLike[str]
Reference = Referred | Mapping[str, NamedSeries | Estimate | float]
Measured = Result | NamedSeries | Estimate | float
ALONE = "it"  # the name of what has none
TIME = "time"
KINDS = "a Result, a NamedSeries, an Estimate, a number"
PERCENT = "%"


class Closeness(NamedTuple):
    """A curve or number beside its reference.

    name: of it. unit: of all. time: [s], (n,); of a number empty. values, reference, allowed: (n,), of a number
    (1,). allowed: by how much they may differ. verdict: within, not within, or not decided. where: the record
    that is farthest beyond what is allowed. rule: the tolerance in words. error: of the difference there if it
    is not decided, NaN: not known.
    """

    name: str
    unit: str
    time: Series
    values: Series
    reference: Series
    allowed: Series
    verdict: ToleranceVerdict
    where: int
    rule: str
    error: float = 0.0

    @property
    def is_close(self) -> bool:
        """Whether it is surely as close as is allowed."""
        return self.verdict == "within"

    @property
    def ratio(self) -> float:
        """Difference over what is allowed where that is worst; infinite if nothing is allowed, or unknown."""
        off = abs(float(self.values[self.where] - self.reference[self.where]))
        if math.isnan(off):
            return math.inf
        allowed = float(self.allowed[self.where])
        return off / allowed if allowed > 0.0 else (math.inf if off > 0.0 else 0.0)

    def __str__(self) -> str:
        """The worst number in a line: where, what it is, what it should be."""
        now, was, allowed = (float(one[self.where]) for one in (self.values, self.reference, self.allowed))
        at = f" at t = {self.time[self.where]:.6g} s" if self.time.size else ""
        said = f"{self.name}: {self._said(now, 9)}{at}, where the reference is {self._said(was, 9)}: "
        limit = f"allowed: {self._said(allowed, 3)} ({self.rule})"
        if self.verdict == "not decided":
            known = self._said(self.error, 3) if math.isfinite(self.error) else "not known"
            return (
                f"{said}it cannot be told whether they are close, for the numerical error is {known}; {limit}; "
                "a higher accuracy may tell"
            )
        return f"{said}they differ by {self._said(abs(now - was), 3)}; {limit}"

    def _said(self, value: float, digits: int) -> str:
        return f"{value:.{digits}g} {self.unit}".rstrip()


class _Side(NamedTuple):
    """One of two things that are compared: a curve over time, or with no times a number."""

    unit: str | None
    time: Series
    values: Series
    errors: Series  # NaN: not known


def closeness(
    result: Measured,
    reference: Reference,
    allowed: float | str | None = None,
    *,
    channels: Sequence[str] = (),
    after: float = 0.0,
    until: float = math.inf,
) -> list[Closeness]:
    """Each curve or number of a result beside its reference, the farthest from it first.

    Arguments:
        result: a Result, a NamedSeries, an Estimate such as `result.numbers()[name]`, or a number.
        reference: another Result; a file with curves, by its path or as `read_series` gives it; a NamedSeries;
            an Estimate or a number; or several of these by the names of channels and numbers of a Result.
        allowed: a relative tolerance, such as 0.02 or "2 %": of curves it is of the range of the reference, of
            numbers of their reference; an amount with its unit, "0.1 mm"; None: the errors of both, which have
            to be known of one side at least, and of curves up to the time when runs are determined, see
            `kept_impacts`.
        channels: of a Result, by names or patterns; without, all that both have.
        after, until: what of curves and runs is compared [s].

    Raises InputError if there is nothing to compare, if units do not fit, or if the tolerance is none.
    """
    if isinstance(reference, (str, PathLike)):
        path = Path(reference)
        reference = Result.load(path) if is_own(path) else read_series(path)
    end = until
    if allowed is None:
        runs = [one for one in (result, reference) if isinstance(one, Result) and one.coarser is not None]
        end = min([until, *(kept_impacts(run)[1] for run in runs)])
    rule = _rule(allowed)
    found = [
        _compared(name, mine, its, rule, (after, end))
        for name, mine, its in _pairs(result, reference, channels, (after, until))
    ]
    return sorted(found, key=lambda one: (one.is_close, -one.ratio))


def _rule(allowed: float | str | None) -> Tolerance | None:
    if allowed is None:
        return None
    if isinstance(allowed, str):
        return tolerance("*", allowed)
    if _is_number(allowed):
        if not 0.0 <= allowed < math.inf:
            raise InputError(f"tolerance = {short(allowed)}: allowed: a share from 0 on, such as 0.02")
        return Tolerance("*", f"{100.0 * allowed:.4g} %", 100.0 * allowed, PERCENT)
    raise InputError(f"tolerance = {short(allowed)}: allowed: a share, a text such as '2 %' or '0.1 mm', None")


def _is_number(item: object) -> TypeGuard[float]:
    return isinstance(item, (int, float)) and not isinstance(item, bool)


# --- what is compared with what ---


def _pairs(
    result: Measured, reference: Reference, channels: Sequence[str], window: tuple[float, float]
) -> list[tuple[str, _Side, _Side]]:
    if not isinstance(result, Result):
        if isinstance(reference, (Result, SeriesFile, Mapping)):
            raise InputError(
                f"result = {short(result)}: has one value, its reference several; allowed: a Result, or the "
                "one channel or number of the reference"
            )
        return [(_name(result), _side(result), _side(reference))]
    others = _others(reference)
    numbers_of = result.numbers(*window) if result.coarser is not None else {}
    known = [name for name in others if name in result.channels or name in numbers_of]
    if isinstance(reference, Mapping) and len(known) < len(others):
        missing = next(name for name in others if name not in known)
        known = [*result.channels, *numbers_of]
        raise InputError(
            f"{missing}: the result has no such channel or number with an error; {meant(missing, known)}"
        )
    names = [name for name in (matching(known, channels) if channels else known) if name != TIME]
    if not names:
        raise InputError(
            "reference: has no channel of the result; allowed: names such as "
            f"{', '.join(list(result.channels)[1:4])}"
        )
    pairs = []
    for name in names:
        its = others[name] if not isinstance(reference, Result) else _channel(reference, name)
        mine = _channel(result, name) if name in result.channels else _side(numbers_of[name])
        pairs.append((name, mine, its if isinstance(its, _Side) else _side(its)))
    return pairs


def _others(reference: Reference) -> Mapping[str, object]:
    if isinstance(reference, SeriesFile):
        return reference.series
    if isinstance(reference, Result):
        return {name: one for name, one in reference.channels.items() if one.is_determined}
    if isinstance(reference, NamedSeries):
        return {reference.name: reference}
    if isinstance(reference, Mapping):
        return reference
    raise InputError(
        f"reference = {short(reference)}: is one number, the result a whole run; allowed: numbers by names"
    )


def _name(one: object) -> str:
    return one.name if isinstance(one, NamedSeries) else ALONE


def _channel(run: Result, name: str) -> _Side:
    return _Side(run.unit(name), run.time, run[name], safe_errors(run, [name])[name])


def _side(one: object) -> _Side:
    if isinstance(one, NamedSeries):
        return _Side(one.unit, one.time, one.values, np.full(one.time.size, math.nan))
    none = np.zeros(0)
    if isinstance(one, Estimate):
        return _Side(one.unit, none, np.array([one.value]), np.array([one.error]))
    if _is_number(one):
        return _Side(None, none, np.array([float(one)]), np.array([math.nan]))
    raise InputError(f"{short(one)}: cannot be compared; allowed: {KINDS}")


# --- by how much ---


def _compared(
    name: str, mine: _Side, its: _Side, rule: Tolerance | None, window: tuple[float, float]
) -> Closeness:
    if bool(mine.time.size) != bool(its.time.size):
        raise InputError(f"{name}: is a curve beside a number; allowed: curves with curves")
    unit = mine.unit if mine.unit is not None else (its.unit or "")
    reference = its.values
    scale = 1.0
    if its.unit is not None and its.unit != unit:
        one = NamedSeries(name, its.unit, np.zeros(1), np.ones(1))
        reference = converted(NamedSeries(name, its.unit, np.zeros(reference.size), reference), unit)
        scale = abs(float(converted(one, unit)[0]))
    elif its.unit is None and its.time.size:
        reference = converted(NamedSeries(name, None, its.time, reference), unit)  # which refuses it
    time, values, more = mine.time, mine.values, np.zeros(1)
    if mine.time.size:
        common = on_common_times(its.time, reference, mine.time, mine.values, *window)
        time, values, reference, more = common.time, common.other, common.reference, common.interpolation_error
        errors = _sum(_at(mine, time), scale * _at(its, time))
    else:
        errors = _sum(mine.errors, scale * its.errors)
    if rule is None:
        if np.isnan(errors).all():
            raise InputError(
                f"{name}: no numerical error is known; allowed: a tolerance, such as '2 %', or runs with an "
                "accuracy"
            )
        allowed, errors, words = errors + more, np.zeros(values.size), "both errors"
    else:
        extent = float(np.nanmax(reference) - np.nanmin(reference)) if time.size else abs(float(reference[0]))
        allowed = np.full(values.size, rule.in_si(name, unit, extent))
        errors, words = np.nan_to_num(errors) + more, _in_words(rule, bool(time.size))
    return _judged(Closeness(name, unit, time, values, reference, allowed, "within", 0, words), errors)


def _in_words(rule: Tolerance, of_curve: bool) -> str:
    return (
        f"{rule.text} of the {'range' if of_curve else 'value'} of the reference"
        if rule.is_relative
        else rule.text
    )


def _judged(one: Closeness, errors: Series) -> Closeness:
    """Whether it is as close as is allowed, and where it is least so.

    errors: of the difference, (n,). Where they are larger than what is allowed, and a difference that is within
    them could turn the answer, nothing is decided.
    """
    off, unknown = np.abs(one.values - one.reference), ~np.isfinite(one.allowed)
    off[np.isnan(one.reference)] = 0.0  # where there is nothing to compare with
    off = np.where(np.isnan(off), math.inf, off)
    undecided = unknown | ((errors > one.allowed) & (off - errors <= one.allowed))
    beyond = (off > one.allowed) & ~undecided
    if beyond.any():
        excess = np.where(beyond, off - one.allowed, -math.inf)
        return one._replace(verdict="not within", where=int(excess.argmax()))
    if undecided.any():
        where = int(np.where(undecided, errors, -1.0).argmax())
        return one._replace(
            verdict="not decided", where=where, error=math.nan if unknown[where] else float(errors[where])
        )
    return one._replace(where=int((off - one.allowed).argmax()))


def _sum(one: Series, other: Series) -> Series:
    """The sum of two errors; one that is not known counts for nothing if the other is."""
    return np.where(np.isnan(one), other, np.where(np.isnan(other), one, one + other))


def _at(side: _Side, time: Series) -> Series:
    """Errors of a curve at other times, (n,): those of the next record, which are no smaller."""
    following = np.searchsorted(side.time, time - CLEARANCE)
    return side.errors[np.minimum(following, side.time.size - 1)]
