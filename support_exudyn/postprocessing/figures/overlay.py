"""Several runs in one figure: their channels one upon another, or what differs from the first."""

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from support_exudyn.files.series.named_series import SeriesFile
from support_exudyn.files.series.units import converted
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.channels import (
    Curve,
    draw_panels,
    error_over_time,
    label_values,
    name_curves,
    unit_of,
)
from support_exudyn.postprocessing.figures.selection import common_records, inside, matching, window_text
from support_exudyn.postprocessing.figures.units import quantity
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
    end, notes = max(float(one.time[-1]) for one in runs.values()), []
    for look, (name, file) in zip(CURVES[len(runs) :], curves.items(), strict=False):
        drawn, beyond = 0, 0
        for channel in (channel for channel in panels if channel in file.series):
            one = file.series[channel]
            unit = next(run.unit(channel) for run in runs.values() if channel in run.channels)
            values = converted(one, unit)
            chosen = (one.time >= after) & (one.time <= min(until, end)) & np.isfinite(values)
            dashes = "" if (count := int(chosen.sum())) <= FEW else look[1]
            if count:
                curve = Curve(name, one.time[chosen], values[chosen], np.zeros(count), look[0], dashes)
                panels[channel].append(curve)
            drawn, beyond = drawn + count, max(beyond, int((one.time > end).sum()))
        if not drawn:
            raise InputError(
                f"{file.path}: has no number of {', '.join(list(panels)[:6])} from {max(after, 0.0):g} to "
                f"{min(until, end):g} s; allowed: series of such names, with times within the run; it has "
                f"{', '.join(list(file.series)[:6])}"
            )
        if beyond and until >= end:
            notes.append(f"{beyond} points of {name}")
    title = f"{_several([*runs, *curves])}, {window_text(next(iter(runs.values())), after, until)}"
    more = f" The errors of {_several(curves)} are not known." if curves else ""
    if notes:
        more += f" {' and '.join(notes)} beyond the end of the run, {end:g} s, are not drawn."
    return draw(runs, panels, title, "", more)


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


def difference(
    runs: Mapping[str, Result], channels: Sequence[str], after: float = 0.0, until: float = math.inf
) -> Figure:
    """Channels of runs less those of the first, at the times at which both have records.

    Arguments, and what is raised, are those of `overlay`.
    """
    (reference, first), *others = runs.items()
    panels: dict[str, list[Curve]] = {}
    for channel in (name for name in _channels(runs, channels) if name in first.channels):
        for (name, run), look in zip(others, CURVES, strict=False):
            if channel in run.channels:
                mine, its = common_records(first, run, after, until)
                known = error_over_time(first, channel), error_over_time(run, channel)
                band = None if known[0] is None or known[1] is None else known[0][mine] + known[1][its]
                values = run[channel][its] - first[channel][mine]
                curve = Curve(f"{name} less {reference}", first.time[mine], values, band, *look)
                panels.setdefault(channel, []).append(curve)
    if not panels:
        raise InputError(
            f"{', '.join(runs)}: have none of these channels in common; allowed: runs of like machines"
        )
    title = f"{_several(dict(others))} less {reference}, {window_text(first, after, until)}"
    return draw(runs, panels, title, "difference of ")


def _channels(runs: Mapping[str, Result], patterns: Sequence[str], others: int = 0) -> list[str]:
    if not (runs and 2 <= len(runs) + others <= len(CURVES)):
        raise InputError(f"{len(runs) + others} runs: allowed in a figure: 2 to {len(CURVES)}")
    known = list(dict.fromkeys(name for run in runs.values() for name in run.channels))
    names = matching(known, patterns)
    if not 1 <= len(names) <= MOST:
        raise InputError(f"{len(names)} channels match; allowed in a figure of several runs: 1 to {MOST}")
    check_units(runs, names)
    return names


def check_units(runs: Mapping[str, Result], names: Sequence[str]) -> None:
    """Raise InputError if a channel has two units."""
    for name in names:
        if len(found := {run.unit(name) for run in runs.values() if name in run.channels}) > 1:
            raise InputError(f"{name}: is in {' and in '.join(sorted(found))}; allowed: one unit")


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
    channels = {
        name: next(run for run in runs.values() if name in run.channels).channels[name] for name in panels
    }
    rows, _ = draw_panels(drawing, [(channels[name].unit, curves) for name, curves in panels.items()])
    handles: dict[str, Any] = {}
    for axes, (name, channel) in zip(rows, channels.items(), strict=True):
        axes.set_title(f"{what}{name}: {channel.meaning}", fontsize=8)
        label_values(axes, quantity(channel.unit, (name,)), unit_of(axes))
        handles |= dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
    name_curves(rows[0], handles, 1.12)
    every = [curve for curves in panels.values() for curve in curves]
    marks = " (few points of a file: markers)" if any(not curve.dashes for curve in every) else ""
    errors = (
        "Not all runs were made to an accuracy: the numerical errors of those are unknown."
        if any(curve.errors is None for curve in every)
        else "Shaded where it is visible: estimated numerical error of the runs."
    )
    style.caption(drawing, f"Records, joined by straight lines{marks}. {errors}{more}")
    return drawing
