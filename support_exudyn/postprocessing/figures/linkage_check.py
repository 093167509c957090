"""The figure of a check of any linkage: its bodies over the way of its drives, and curves of what was found."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from support_exudyn.machines.check.drive_way import DriveWay, Moved
from support_exudyn.machines.check.report import CheckReport
from support_exudyn.machines.check.transmission import LEAST
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.linkage_drawing import GREY, START, LinkageDrawing
from support_exudyn.postprocessing.figures.selection import as_words
from support_exudyn.postprocessing.figures.style import CURVES

GHOSTS = 3  # further postures of a crank that turns right round
PANELS = 4  # drives that have curves of their own
CAPTION = (
    "Static forces are those under weight and the machine's own loads, with ideal pins. Red dashes: dead "
    "centre or change point; grey dots: a part on the ground turns back."
)
POOR = f" Grey: poor transmission, nearer than {math.degrees(LEAST):.0f} degrees to a straight line."
WIDTH_MM, COLUMNS, MARGIN_MM, HANDLE_MM = 180.0, 6, 18.0, 9.0  # of the figure, a panel, a line in a legend
KEY: dict[str, Any] = {"fontsize": 7, "columnspacing": 1.0, "handlelength": 2.2, "borderaxespad": 0.0}
MANY = 5  # curves of a panel


def check_figure(report: CheckReport) -> Figure:
    """A linkage in its start posture and others of its way, the paths of its points, forces and angles.

    Of one drive: postures, static forces in pins, what holds the machine, transmission angles. Of several: both
    ends of the way of each, and what holds the machine over the way of each.
    """
    ways = report.ways[:PANELS]
    rows = 0 if not ways else 1 if len(ways) < 3 else 2
    drawing = style.begin(WIDTH_MM, 105 + 70 * rows, report.name or report.kind)
    grid = drawing.add_gridspec(1 + rows, COLUMNS, height_ratios=[1.7] + [1.0] * rows)
    _linkage(drawing.add_subplot(grid[0, :]), report)
    if len(ways) == 1:
        angles = report.transmission[ways[0].drive]
        wide = 2 if angles else 3
        moved, pins = ways[0].moved, report.linkage.pins
        forces = {name: [float(np.hypot(*one.forces.pins[name])) for one in moved] for name in pins}
        _curves(drawing.add_subplot(grid[1, :wide]), ways[0], "static force in pins", "force", forces, "N")
        _holding(drawing.add_subplot(grid[1, wide : 2 * wide]), ways[0])
        if angles:
            curves = {f"{as_words(one.pin)}: {as_words(one.output)}": np.degrees(one.angles) for one in angles}
            _angles(drawing.add_subplot(grid[1, 4:]), ways[0], curves)
    for number, way in enumerate(ways if len(ways) > 1 else ()):
        first = 3 * (number % 2)
        _holding(drawing.add_subplot(grid[1 + number // 2, first : first + 3]), way)
    if ways:
        style.caption(drawing, CAPTION + (POOR if any(report.transmission.values()) else ""))
    return drawing


def _linkage(axes: Axes, report: CheckReport) -> None:
    """Bodies at the start, and pale ones at ends of ranges or over a turn; paths of traced points."""
    reached = [report.start.position, *(one.position for way in report.ways for one in way.moved)]
    drawing = LinkageDrawing(axes, report.linkage, reached)
    looks = list(zip(report.ways, itertools.cycle(CURVES), strict=False))
    for way, (colour, dashes) in looks:
        drawing.paths([one.position for one in way.moved], colour)
        for one in _others(way, len(report.ways) == 1):
            drawing.posture(one.position, colour, dashes, strong=False)
    drawing.posture(report.start.position)
    for name, load in report.loads.items():
        drawing.load(name, load)
    drawing.pin_names(report.start.position)
    drawing.names(report.start.position)
    starts = [way.at(0.0) for way in report.ways if len(way.drives) == 1]
    label = f"start: {starts[0]}" if len(starts) == 1 else "start"
    handles = [axes.plot([], [], color=START, lw=1.8, label=label)[0]]
    for way, (colour, dashes) in looks:
        if others := _others(way, len(report.ways) == 1):
            where = ", ".join(f"{way.shown(one.travel):.4g}" for one in others)
            label = f"{way.label} at {where} {way.unit}"
            handles.append(axes.plot([], [], color=colour, ls=dashes, lw=1.2, label=label)[0])
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(0.0, -0.17), ncols=2, fontsize=7.5)


def _others(way: DriveWay, alone: bool) -> list[Moved]:
    """Postures besides the start: ends, and the middle if no other part is driven; or some of a turn."""
    if way.right_round:
        return [way.moved[round(n)] for n in np.linspace(0, len(way.moved) - 1, GHOSTS + 2)[1:-1]]
    shown = (way.moved[0], *([way.moved[len(way.moved) // 2]] if alone else []), way.moved[-1])
    return [one for one in shown if one.travel != 0.0]


def _holding(axes: Axes, way: DriveWay) -> None:
    """What holds the machine over the way of a drive: pushes of actuators, or moments of cranks."""
    linkage = way.linkage
    if linkage.actuators:
        forces = {name: [one.forces.actuators[name] for one in way.moved] for name in linkage.actuators}
        _curves(axes, way, "static push of actuators", "push", forces, "N")
    else:
        moments = {name: [one.forces.cranks[name] for one in way.moved] for name in linkage.cranks}
        _curves(axes, way, "static moment on cranks", "moment", moments, "N m")


def _curves(
    axes: Axes, way: DriveWay, title: str, what: str, values: Mapping[str, Sequence[float]], unit: str
) -> None:
    """Curves over a way; near a dead centre, where they have no bound, they leave the panel."""
    inner = {name: _bounded(way, one) for name, one in values.items()}
    most = sorted(values, key=lambda name: -max(map(abs, inner[name])))[:MANY]
    highest = max((abs(one) for name in most for one in inner[name]), default=0.0)
    factor, unit = (1e-3, f"k{unit}") if highest >= 2e3 else (1.0, unit)
    x, span = [way.shown(one.travel) for one in way.moved], way.ends[1] - way.ends[0]
    singular = [one.travel for one in way.points if one.what == "change point"]
    # in a change point itself forces are not determined
    shown = [all(abs(one.travel - end) > 1e-6 * span for end in singular) for one in way.moved]
    for name, (colour, dashes) in zip([one for one in values if one in most], CURVES, strict=False):
        y = np.where(shown, factor * np.array(values[name]), np.nan)
        axes.plot(x, y, color=colour, ls=dashes, lw=1.2, label=as_words(name))
    low = factor * min((min(inner[name]) for name in most), default=0.0)
    high = factor * max((max(inner[name]) for name in most), default=1.0)
    room = 0.06 * (high - low) or 0.1
    axes.set_ylim(min(0.0, low) - room, max(0.0, high) + room)
    if most:
        _legend(axes, max(map(len, most)))
    axes.set(title=title, ylabel=f"{what} [{unit}]")
    _abscissa(axes, way)


def _bounded(way: DriveWay, values: Sequence[float]) -> list[float]:
    """Values without those next to a dead centre."""
    near = 0.03 * (way.ends[1] - way.ends[0])
    ends = [one.travel for one in way.points if one.what != "turns back"]
    pairs = zip(way.moved, values, strict=True)
    return [value for one, value in pairs if all(abs(one.travel - end) > near for end in ends)] or [0.0]


def _angles(axes: Axes, way: DriveWay, curves: Mapping[str, Series]) -> None:
    """Transmission angles over a way; grey where they are poor."""
    x, edge = [way.shown(one.travel) for one in way.moved], math.degrees(LEAST)
    for (name, values), (colour, dashes) in zip(curves.items(), CURVES, strict=False):
        axes.plot(x, values, color=colour, ls=dashes, lw=1.4, label=name)
    for low in (0.0, 180.0 - edge):
        axes.axhspan(low, low + edge, color=GREY, alpha=0.18, lw=0)
    axes.set(ylim=(0.0, 180.0), yticks=range(0, 181, 30), ylabel="angle [deg]", title="transmission angle")
    _legend(axes, max(map(len, curves)))
    _abscissa(axes, way)


def _legend(axes: Axes, letters: int) -> None:
    """The names of curves below a panel, in as many columns as names of so many letters leave room for."""
    place = axes.get_subplotspec()
    width = WIDTH_MM * len(place.colspan) / COLUMNS - MARGIN_MM if place else 0.0
    columns = int(width / (style.LETTER_MM * letters + HANDLE_MM))
    legend = axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.36), ncols=min(3, max(1, columns)), **KEY)
    legend.set_in_layout(columns > 0)


def _abscissa(axes: Axes, way: DriveWay) -> None:
    """The way below curves, with dead centres and where parts turn back as lines."""
    axes.set_xlabel(f"{way.label} [{way.unit}]")
    first, last = way.shown(way.ends[0]), way.shown(way.ends[1])
    axes.set_xlim(first, last)
    if way.right_round:
        axes.set_xticks(90.0 * np.arange(math.ceil(first / 90.0 - 1e-9), math.floor(last / 90.0 + 1e-9) + 1))
    for one in way.points:
        colour, dashes = (GREY, ":") if one.what == "turns back" else (style.CONTACT, "--")
        axes.axvline(way.shown(one.travel), color=colour, ls=dashes, lw=0.9, zorder=1)
