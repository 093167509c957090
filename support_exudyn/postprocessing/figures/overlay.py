"""Several runs in one figure: their channels one upon another, or what differs from the first."""

import math
from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from support_exudyn.files.series.named_series import SeriesFile
from support_exudyn.files.series.units import converted
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.channels import Curve, draw_panels, error_over_time
from support_exudyn.postprocessing.figures.selection import common_records, inside, matching, said
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

CURVES = style.CURVES
NO_CURVES: Mapping[str, SeriesFile] = {}
MOST = 16  # panels
FEW = 60  # points of a file that are drawn as markers
PANEL_MM, REST_MM, LINE_MM = 38.0, 34.0, 4.5  # height of a panel, of the rest, and of a line that names a run


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
    panels = of_runs(runs, _channels(runs, channels, len(curves)), after, until)
    for n, (name, found) in enumerate(curves.items(), len(runs)):
        drawn = {channel: _measured(name, n, found, channel, runs, after, until) for channel in panels}
        if not any(drawn.values()):
            raise InputError(_none_drawn(found, panels, runs, after, until))
        for channel, one in drawn.items():
            panels[channel] += one
    title = f"{_several([*runs, *curves])}, {said(next(iter(runs.values())), after, until)}"
    files = f" Nothing is said of the errors of {_several(curves)}." if curves else ""
    return draw(runs, panels, title, "", files + _left_out(curves, panels, runs, until))


def of_runs(
    runs: Mapping[str, Result], channels: Sequence[str], after: float = 0.0, until: float = math.inf
) -> dict[str, list[Curve]]:
    """The curves of each channel, in the order of the runs; channels are names, all else is as of `overlay`."""
    panels: dict[str, list[Curve]] = {channel: [] for channel in channels}
    for n, (name, run) in enumerate(runs.items()):
        chosen, look = inside(run, after, until), CURVES[n % len(CURVES)]
        for channel in (one for one in channels if one in run.channels):
            error = error_over_time(run, channel)
            band = None if error is None else error[chosen]
            panels[channel].append(Curve(name, run.time[chosen], run[channel][chosen], band, *look))
    return panels


def _measured(
    name: str, n: int, found: SeriesFile, channel: str, runs: Mapping[str, Result], after: float, until: float
) -> list[Curve]:
    """The curve of a file for a channel, with the n-th look; none if it has none. Few points are marks."""
    run = next(run for run in runs.values() if channel in run.channels)
    if channel not in found.series:
        return []
    values, time = converted(found.series[channel], run.unit(channel)), found.series[channel].time
    chosen = (time >= after) & (time <= min(until, _end(runs))) & np.isfinite(values)
    colour, dashes = CURVES[n % len(CURVES)]
    known = np.zeros(int(chosen.sum()))
    look = "" if known.size <= FEW else dashes
    return [Curve(name, time[chosen], values[chosen], known, colour, look)] if chosen.any() else []


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
    return f" {' and '.join(told)} beyond the end of the run, {end:g} s, are not drawn." if told else ""


def difference(
    runs: Mapping[str, Result], channels: Sequence[str], after: float = 0.0, until: float = math.inf
) -> Figure:
    """Channels of runs less those of the first, at the times at which both have records.

    Arguments, and what is raised, are those of `overlay`.
    """
    (reference, first), *others = runs.items()
    names = [channel for channel in _channels(runs, channels) if channel in first.channels]
    panels: dict[str, list[Curve]] = {channel: [] for channel in names}
    for n, (name, run) in enumerate(others):
        mine, its = common_records(first, run, after, until)
        for channel in (one for one in names if one in run.channels):
            known = error_over_time(first, channel), error_over_time(run, channel)
            band = None if known[0] is None or known[1] is None else known[0][mine] + known[1][its]
            values = run[channel][its] - first[channel][mine]
            panels[channel].append(
                Curve(f"{name} less {reference}", first.time[mine], values, band, *CURVES[n])
            )
    panels = {channel: curves for channel, curves in panels.items() if curves}
    if not panels:
        raise InputError(
            f"{', '.join(runs)}: have none of these channels in common; allowed: runs of like machines"
        )
    title = f"{_several(dict(others))} less {reference}, {said(first, after, until)}"
    return draw(runs, panels, title, "difference of ")


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


def _several(runs: Iterable[str]) -> str:
    *before, last = runs
    return f"{', '.join(before)} and {last}" if before else last


def draw(
    runs: Mapping[str, Result],
    panels: Mapping[str, Sequence[Curve]],
    title: str,
    what: str = "",
    more: str = "",
) -> Figure:
    """Draw the curves of channels, a panel each; what: before the names of channels, more: in the caption."""
    lines = max(len(curves) for curves in panels.values())
    drawing = style.begin(170, REST_MM + PANEL_MM * len(panels) + LINE_MM * lines, title)
    owners = {channel: next(run for run in runs.values() if channel in run.channels) for channel in panels}
    rows, _ = draw_panels(drawing, [(owners[name].unit(name), curves) for name, curves in panels.items()])
    for axes, (channel, run) in zip(rows, owners.items(), strict=True):
        axes.set_title(f"{what}{channel}: {run.channels[channel].meaning}", fontsize=8)
    handles = {str(line.get_label()): line for axes in rows for line in axes.lines}
    rows[0].legend(
        list(handles.values()), list(handles), loc="lower left", bbox_to_anchor=(0.0, 1.12), fontsize=7,
        borderaxespad=0.0,
    )  # fmt: skip
    every = [curve for curves in panels.values() for curve in curves]
    marks = " (few points of a file: markers)" if any(not curve.dashes for curve in every) else ""
    errors = (
        "Not all runs were made to an accuracy: the numerical errors of those are unknown."
        if any(curve.errors is None for curve in every)
        else "Shaded where it can be seen: estimated numerical error of the runs."
    )
    style.caption(drawing, f"Records, joined by straight lines{marks}. {errors}{more}")
    return drawing
