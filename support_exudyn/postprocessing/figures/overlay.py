"""Several runs in one figure: their channels one upon another, or what differs from the first."""

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from support_exudyn.files.series.named_series import SeriesFile
from support_exudyn.files.series.units import converted
from support_exudyn.postprocessing.figures import style, units
from support_exudyn.postprocessing.figures.channels import error_over_time, label_values
from support_exudyn.postprocessing.figures.journal import Series
from support_exudyn.postprocessing.figures.selection import common_records, inside, matching, said
from support_exudyn.postprocessing.figures.units import readable
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

CURVES = style.CURVES
NO_CURVES: Mapping[str, SeriesFile] = {}
MOST = 16  # panels
FEW = 60  # points of a file that are drawn as markers
PANEL_MM, REST_MM, LINE_MM = 38.0, 34.0, 4.5  # height of a panel, of the rest, and of a line that names a run
SECONDS = "s"


class _Curve(NamedTuple):
    """A line of a panel: its run, times [s], values and their errors, NaN if not known (n,), SI.

    of_file: whether it is of a file of curves, of whose errors nothing is said.
    """

    run: str
    time: Series
    values: Series
    errors: Series
    of_file: bool = False


def overlay(
    runs: Mapping[str, Result],
    channels: Sequence[str],
    after: float = 0.0,
    until: float = math.inf,
    curves: Mapping[str, SeriesFile] = NO_CURVES,
) -> Figure:
    """Channels of several runs over time: a panel for each channel, a curve for each run that has it.

    Arguments:
        runs: by the names that the figure calls them, at least one.
        channels: names, or patterns of them as in a shell.
        after, until: what of the runs is drawn [s].
        curves: files of others, by the names that the figure calls them; with the runs 2 to 5.

    Raises InputError if runs or channels are too few or too many, if a pattern matches no channel, if a channel
    has two units, or if no records lie between the times.
    """

    def curve(name: str, run: Result, channel: str) -> _Curve:
        chosen = inside(run, after, until)
        return _Curve(name, run.time[chosen], run[channel][chosen], _errors(run, channel)[chosen])

    panels = {
        channel: [curve(name, run, channel) for name, run in runs.items() if channel in run.channels]
        for channel in _channels(runs, channels, len(curves))
    }
    for name, found in curves.items():
        drawn = {channel: _measured(name, found, channel, runs, after, until) for channel in panels}
        if not any(drawn.values()):
            raise InputError(_none_drawn(found, panels, runs, after, until))
        for channel, one in drawn.items():
            panels[channel] += one
    title = f"{_several([*runs, *curves])}, {said(next(iter(runs.values())), after, until)}"
    return _drawn(runs, panels, title, "", _left_out(curves, panels, runs, until))


def _measured(
    name: str, found: SeriesFile, channel: str, runs: Mapping[str, Result], after: float, until: float
) -> list[_Curve]:
    """The curve of a file for a channel; none if it has none."""
    run = next(run for run in runs.values() if channel in run.channels)
    if channel not in found.series:
        return []
    values, time = converted(found.series[channel], run.unit(channel)), found.series[channel].time
    last = min(until, _end(runs))
    chosen = (time >= after) & (time <= last) & np.isfinite(values)
    none = np.zeros(int(chosen.sum()))
    return [_Curve(name, time[chosen], values[chosen], none, of_file=True)] if chosen.any() else []


def _end(runs: Mapping[str, Result]) -> float:
    """Last time of all runs [s]."""
    return max(float(one.time[-1]) for one in runs.values())


def _none_drawn(
    found: SeriesFile, channels: Iterable[str], runs: Mapping[str, Result], after: float, until: float
) -> str:
    """Why nothing of a file is drawn: it lacks the channels, or its times are others."""
    if times := [found.series[channel].time for channel in channels if channel in found.series]:
        return (
            f"{found.path}: its times, {times[0][0]:g} to {times[0][-1]:g} s, have no number between "
            f"{max(after, 0.0):g} and {min(until, _end(runs)):g} s; allowed: some within the run"
        )
    known = ", ".join(list(found.series)[:6])
    return (
        f"{found.path}: has a series of none of these channels; allowed: names such as "
        f"{next(iter(channels))}; it has {known}"
    )


def _left_out(
    curves: Mapping[str, SeriesFile], channels: Iterable[str], runs: Mapping[str, Result], until: float
) -> str:
    """A sentence on points of files beyond the end of the runs; empty if there are none."""
    end = _end(runs)
    beyond = {
        name: max(int((found.series[one].time > end).sum()) for one in channels if one in found.series)
        for name, found in curves.items()
        if until >= end
    }
    told = [f"{number} points of {name}" for name, number in beyond.items() if number]
    return f"{' and '.join(told)} beyond the end of the run, {end:g} s, are not drawn." if told else ""


def difference(
    runs: Mapping[str, Result], channels: Sequence[str], after: float = 0.0, until: float = math.inf
) -> Figure:
    """Channels of runs less those of the first, at the times at which both have records.

    Arguments, and what is raised, are those of `overlay`.
    """
    (reference, first), *others = runs.items()

    def curve(name: str, run: Result, channel: str) -> _Curve:
        mine, its = common_records(first, run, after, until)
        errors = _errors(first, channel)[mine] + _errors(run, channel)[its]
        return _Curve(
            f"{name} less {reference}", first.time[mine], run[channel][its] - first[channel][mine], errors
        )

    panels = {
        channel: [curve(name, run, channel) for name, run in others if channel in run.channels]
        for channel in _channels(runs, channels)
        if channel in first.channels
    }
    panels = {channel: curves for channel, curves in panels.items() if curves}
    if not panels:
        raise InputError(
            f"{', '.join(runs)}: have none of these channels in common; allowed: runs of like machines"
        )
    title = f"{_several(dict(others))} less {reference}, {said(first, after, until)}"
    return _drawn(runs, panels, title, "difference of ")


def _channels(runs: Mapping[str, Result], patterns: Sequence[str], others: int = 0) -> list[str]:
    if not (runs and 2 <= len(runs) + others <= len(CURVES)):
        raise InputError(f"{len(runs) + others} runs: allowed in a figure: 2 to {len(CURVES)}")
    known = list(dict.fromkeys(name for run in runs.values() for name in run.channels))
    names = matching(known, patterns)
    if not 1 <= len(names) <= MOST:
        raise InputError(f"{len(names)} channels match; allowed in a figure of several runs: 1 to {MOST}")
    for name in names:
        if len(found := {run.unit(name) for run in runs.values() if name in run.channels}) > 1:
            raise InputError(f"{name}: is in {' and in '.join(sorted(found))}; allowed: one unit")
    return names


def _errors(run: Result, channel: str) -> Series:
    found = error_over_time(run, channel)
    return np.full(run.time.size, np.nan) if found is None else found


def _several(runs: Iterable[str]) -> str:
    *before, last = runs
    return f"{', '.join(before)} and {last}" if before else last


def _drawn(
    runs: Mapping[str, Result],
    panels: Mapping[str, Sequence[_Curve]],
    title: str,
    what: str,
    more: str = "",
) -> Figure:
    lines = max(len(curves) for curves in panels.values())
    drawing = style.begin(170, REST_MM + PANEL_MM * len(panels) + LINE_MM * lines, title)
    rows = drawing.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    ends = [(one.time[0], one.time[-1]) for curves in panels.values() for one in curves]
    first, last = min(start for start, _ in ends), max(end for _, end in ends)
    seconds = readable(SECONDS, float(last - first))
    names = dict.fromkeys(one.run for curves in panels.values() for one in curves)
    looks = dict(zip(names, CURVES, strict=False))
    for axes, (channel, curves) in zip(rows, panels.items(), strict=True):
        run = next(run for run in runs.values() if channel in run.channels)
        _panel(axes, curves, looks, run.unit(channel), seconds.scale)
        axes.set_title(f"{what}{channel}: {run.channels[channel].meaning}", fontsize=8)
    handles = {line.get_label(): line for axes in rows for line in axes.lines}
    rows[0].legend(
        handles.values(), handles.keys(), loc="lower left", bbox_to_anchor=(0.0, 1.12), fontsize=7,
        borderaxespad=0.0,
    )  # fmt: skip
    drawing.align_ylabels(rows)
    rows[-1].set_xlabel(f"time [{seconds.name}]")
    rows[-1].set_xlim(seconds.scale * first, seconds.scale * last)
    known = all(np.isfinite(one.errors).all() for curves in panels.values() for one in curves)
    files = dict.fromkeys(one.run for curves in panels.values() for one in curves if one.of_file)
    style.caption(
        drawing,
        f"Records, joined by straight lines{' (few points of a file: markers)' if files else ''}. "
        + (
            f"Shaded where it can be seen: estimated numerical error{' of the runs' if files else ''}."
            if known
            else "Not all runs were made to an accuracy: nothing tells the numerical errors of those."
        )
        + (f" Nothing is said of the errors of {_several(files)}." if files else "")
        + (f" {more}" if more else ""),
    )
    return drawing


def _panel(
    axes: Axes,
    curves: Sequence[_Curve],
    looks: Mapping[str, tuple[str, style.Dashes]],
    unit: str,
    seconds: float,
) -> None:
    shown = readable(unit, max(float(np.abs(one.values).max()) for one in curves))
    for one in curves:
        colour, dashes = looks[one.run]
        time, values, band = seconds * one.time, shown.scale * one.values, shown.scale * one.errors
        look: dict[str, Any] = {"ls": dashes, "lw": 0.9}
        if one.of_file and time.size <= FEW:  # measured points are seen as such
            look = {"ls": "", "marker": "o", "ms": 3.5, "mfc": "none", "mew": 1.0, "zorder": 3}
        axes.plot(time, values, color=colour, label=one.run, rasterized=time.size > 20000, **look)
        if np.isfinite(band).all() and band.max() > 0.0:
            axes.fill_between(time, values - band, values + band, color=colour, alpha=0.25, lw=0.0)
    label_values(axes, units.QUANTITIES.get(unit, "value"), shown.name)
