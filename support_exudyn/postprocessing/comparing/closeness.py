"""Whether a result is close to a reference: within a tolerance, or within the errors of both."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

from support_exudyn.files.series.named_series import NamedSeries, SeriesFile
from support_exudyn.files.series.read import read_series
from support_exudyn.files.series.units import converted
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.comparing.common_times import on_common_times
from support_exudyn.postprocessing.comparing.compared_channel import ToleranceVerdict
from support_exudyn.postprocessing.comparing.compared_file import is_own
from support_exudyn.postprocessing.comparing.kept_run import KeptColumn, kept_impacts
from support_exudyn.postprocessing.comparing.mapping import PERCENT, Tolerance, tolerance
from support_exudyn.postprocessing.comparing.with_errors import curve_errors, errors_at
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.postprocessing.figures.units import readable, readable_change
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.result import Result
from user_forces.values.names import meant
from user_forces.values.value import InputError, short

Measured = Result | NamedSeries | Estimate | float
Reference = Measured | SeriesFile | str | PathLike[str] | Mapping[str, NamedSeries | Estimate | float]
Flags = npt.NDArray[np.bool_]
ALONE = "it"  # the name of a number without a name
KINDS = "a Result, a NamedSeries, an Estimate, a number"
BOTH_ERRORS = "both errors"
WIDTH_MM, HEIGHT_MM = 140.0, 95.0
SIDE = 10.0  # times the largest difference up to which the allowed difference is drawn


class Closeness(NamedTuple):
    """A curve or number against its reference.

    name: of it. unit: of all. time: [s], (n,); of a number empty. values, reference, allowed, errors: (n,), of
    a number (1,). allowed: by how much they may differ. errors: of the difference, where they are not what is
    allowed. rule: the tolerance in words.
    """

    name: str
    unit: str
    time: Series
    values: Series
    reference: Series
    allowed: Series
    errors: Series
    rule: str

    @property
    def _verdicts(self) -> tuple[Series, Flags, Flags]:
        """Shares of what is allowed (n,), where it is exceeded (n,), and where that cannot be decided (n,).

        Where errors are larger than what is allowed, and a difference that is within them could turn the
        answer, nothing is decided.
        """
        off = np.abs(self.values - self.reference)
        off[np.isnan(self.reference)] = 0.0  # where there is nothing to compare with
        off = np.where(np.isnan(off), math.inf, off)
        unknown = ~np.isfinite(self.allowed)
        undecided = unknown | ((self.errors > self.allowed) & (off - self.errors <= self.allowed))
        ratio = np.divide(off, self.allowed, out=np.where(off > 0.0, math.inf, 0.0), where=self.allowed > 0.0)
        return np.where(unknown, 0.0, ratio), (off > self.allowed) & ~undecided, undecided

    @property
    def verdict(self) -> ToleranceVerdict:
        """Within, not within, or not decided."""
        _, beyond, undecided = self._verdicts
        return "not within" if beyond.any() else "not decided" if undecided.any() else "within"

    @property
    def is_close(self) -> bool:
        """Whether it is surely as close as is allowed."""
        return self.verdict == "within"

    @property
    def where(self) -> int:
        """The record that is farthest beyond what is allowed, as a share of it; or least decided."""
        ratio, beyond, undecided = self._verdicts
        if not beyond.any() and undecided.any():
            errors = np.where(np.isfinite(self.allowed), self.errors, math.inf)
            return int(np.where(undecided, errors, -1.0).argmax())
        return int(np.where(beyond | ~beyond.any(), ratio, -1.0).argmax())

    @property
    def ratio(self) -> float:
        """Difference over what is allowed where that is worst; infinite if nothing is allowed, or unknown."""
        return float(self._verdicts[0][self.where])

    def __str__(self) -> str:
        """The worst number in a line: where, what it is, what it should be."""
        where = self.where
        now, was, allowed = (float(one[where]) for one in (self.values, self.reference, self.allowed))
        at = f" at t = {self.time[where]:.6g} s" if self.time.size else ""
        words = f"{self.name}: {self._said(now, 9)}{at}, where the reference is {self._said(was, 9)}: "
        limit = f"allowed: {self._said(allowed, 3)} ({self.rule})"
        if self.verdict == "not decided":
            known = self._said(float(self.errors[where]), 3) if math.isfinite(allowed) else "not known"
            why = f"it cannot be told whether they are close, for the numerical error is {known}"
            return f"{words}{why}; {limit}; a higher accuracy may tell"
        return f"{words}they differ by {self._said(abs(now - was), 3)}; {limit}"

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
        return KeptColumn(item.unit, np.zeros(0), np.array([item.value]), np.array([item.error]))
    if isinstance(item, (int, float)) and not isinstance(item, bool):
        return KeptColumn(None, np.zeros(0), np.array([float(item)]), np.array([math.nan]))
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
        return Closeness(name, unit, time, values, reference, errors + more, np.zeros(values.size), BOTH_ERRORS)
    size = float(np.nanmax(reference) - np.nanmin(reference)) if time.size else abs(float(reference[0]))
    allowed = np.full(values.size, rule.in_si(name, unit, size))
    of = f" of the {'range' if time.size else 'value'} of the reference" if rule.is_relative else ""
    errors = np.nan_to_num(errors) + more
    return Closeness(name, unit, time, values, reference, allowed, errors, f"{rule.text}{of}")


# --- the figure of a curve ---


def save_figure(one: Closeness, folder: Path, name: str) -> Path | None:
    """Write the figure of a curve as PNG; nothing of a number, or of a single record."""
    if one.time.size < 2:
        return None
    with style.look():
        return style.save(difference_figure(one), folder, name, pdf=False)[0]


def difference_figure(one: Closeness) -> Figure:
    """Both curves in the same panel, below them their difference within the band that is allowed."""
    off = one.values - one.reference
    size, largest = (
        float(np.nanmax(np.abs(values), initial=0.0)) for values in (np.append(one.values, one.reference), off)
    )
    seconds, shown = readable("s", float(np.ptp(one.time))), readable(one.unit, size)
    smaller = readable_change(one.unit, size, largest)
    word = "farthest" if one.verdict == "not within" else "not decided"
    with style.look():
        drawing = style.begin(WIDTH_MM, HEIGHT_MM, f"{one.name}: {word} at {one.time[one.where]:.6g} s")
        above, below = drawing.subplots(2, 1, sharex=True)
        time = seconds.scale * one.time
        curves = (("reference", one.reference), ("result", one.values))
        for (name, values), (colour, dashes) in zip(curves, style.CURVES, strict=False):
            above.plot(time, shown.scale * values, color=colour, ls=dashes, label=name)
        above.legend(fontsize=7)
        above.set_ylabel(f"[{shown.name}]")
        below.plot(time, smaller.scale * off, color=style.IDEAL, lw=0.9)
        allowed = np.where(np.isfinite(one.allowed), one.allowed, np.nan)
        reach = smaller.scale * np.minimum(allowed, SIDE * largest if largest else np.inf)
        below.fill_between(time, -reach, reach, color=style.THIRD, alpha=0.25, lw=0.0)
        below.axvline(time[one.where], color=style.CONTACT, lw=0.8, ls=":")
        below.set_ylabel(f"difference [{smaller.name}]")
        below.set_xlabel(f"time [{seconds.name}]")
        style.caption(drawing, f"Shaded: allowed, {one.rule}. Dotted: {word}.")
    return drawing
