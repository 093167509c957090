"""Quick look: channels of a run over time."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import StrMethodFormatter

from support_exudyn.postprocessing.figures import style, units
from support_exudyn.postprocessing.figures.journal import Series, clearance_joints, corners
from support_exudyn.postprocessing.figures.selection import inside, machine_name, matching, spacing, window_text
from support_exudyn.postprocessing.figures.style import caption
from support_exudyn.postprocessing.figures.units import DisplayUnit, quantity, readable
from support_exudyn.simulation.estimate import believed, multiple
from support_exudyn.simulation.reported_numbers import ROUNDING
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

CURVES = style.CURVES  # of a panel
MOST = 32  # channels in a figure
NAMED = 6  # channels whose errors are in the caption
PANEL_MM, LINE_MM, REST_MM = 38.0, 4.0, 30.0  # height of a panel, of a line of its legend, and of the rest
LETTERS = 22  # of a line next to a panel
PLAIN = (1e-3, 1e5)  # sizes of numbers that an axis shows as they are
UNLIKE = 50.0  # by what factor sizes differ that are not drawn together
FLAT = 100.0  # factor of a panel's range to that of a channel in it, from which on it would look constant
VISIBLE = 2e-3  # share of a panel's height from which on an error is shaded


def groups(result: Result, names: Sequence[str], chosen: np.ndarray) -> list[list[str]]:
    """Channels by panel: of one unit, of like size and like range, at most as many as there are colours."""
    ends = {name: (float(result[name][chosen].min()), float(result[name][chosen].max())) for name in names}

    def fit(panel: Sequence[str]) -> bool:
        """Whether the last channel is drawn with the others: none looks flat then, nor has another unit."""
        unit, low_high = result.unit(panel[-1]), np.array([ends[name] for name in panel])
        sizes, ranges = np.abs(low_high).max(axis=1), np.ptp(low_high, axis=1)
        size, others = float(sizes[-1]), float(sizes[:-1].max())
        if result.unit(panel[0]) != unit or 0.0 in (size, others):
            return result.unit(panel[0]) == unit and size == others
        alike = 1.0 / UNLIKE < size / others < UNLIKE and readable(unit, others) == readable(unit, size)
        return alike and bool(np.ptp(low_high) <= FLAT * ranges[ranges > 0.0].min(initial=math.inf))

    panels: list[list[str]] = []
    for name in names:
        panel = next((panel for panel in panels if fit([*panel, name])), None)
        if panel is None:
            panels.append([name])
        else:
            panel.append(name)
    most = len(CURVES)
    parts = (np.array_split(panel, math.ceil(len(panel) / most)) for panel in panels)
    return [part.tolist() for split in parts for part in split]


def error_over_time(result: Result, name: str) -> Series | None:
    """Estimated numerical error of a channel at every record (n,), SI; None if it is not known.

    As those of numbers, see `simulation.estimate`. Around an impact it is large because the time of the
    impact is uncertain, too.
    """
    coarser = result.coarser
    if coarser is None or name not in coarser.channels or coarser[name].shape != result[name].shape:
        return None
    last, before, r = np.abs(result[name] - coarser[name]), np.zeros_like(result[name]), result.fall
    if coarser.coarser is not None and name in coarser.coarser.channels:
        before = np.abs(coarser[name] - coarser.coarser[name])
    rounding = ROUNDING * float(np.abs(result[name]).max())
    return multiple(result, r, last, before) * believed(result, r, last, before) + rounding


def over_time(result: Result, channels: Sequence[str], after: float = 0.0, until: float = math.inf) -> Figure:
    """Channels over time, those of one unit together in a panel, with impacts and numerical errors.

    Arguments:
        channels: names, or patterns of them as in a shell.
        after, until: what of the run is drawn [s].

    Raises InputError if there are none, if a pattern matches no channel, if they are too many, or if no records
    lie between the times.
    """
    names = matching(result.channels, channels)
    if not names:
        raise InputError("channels = []: none to draw; allowed: runs that have recorded more than their time")
    if len(names) > MOST:
        raise InputError(
            f"{len(names)} channels match; allowed in a figure: {MOST}; name fewer, such as {names[0]!r}"
        )
    chosen = inside(result, after, until)
    time, panels = result.time[chosen], groups(result, names, chosen)
    title = f"{machine_name(result.scenario)}, {window_text(result, after, until)}"
    drawing = style.begin(170, REST_MM + PANEL_MM * len(panels) + LINE_MM * len(names), title)
    errors = {name: error[chosen] for name in names if (error := error_over_time(result, name)) is not None}
    with_clearance = {f"pin.{pin}.force" for pin in clearance_joints(result)}
    shown: list[tuple[str, Sequence[Curve]]] = []
    for panel in panels:
        loose = with_clearance & set(panel)
        curves = []
        for name, (colour, dashes) in zip(panel, CURVES, strict=False):
            if len(loose) == 1 and name in loose:  # several have colours as others have
                colour = style.CONTACT
            label, values = f"{name}: {result.channels[name].meaning}", result[name][chosen]
            curves.append(Curve(label, time, values, errors.get(name), colour, dashes))
        shown.append((result.unit(panel[0]), curves))
    rows, seconds = draw_panels(drawing, shown)
    joints = (*clearance_joints(result), *corners(result))
    impacts = [one.time for joint in joints for one in result.onsets.get(joint, ())]
    times = seconds.scale * np.array([one for one in impacts if time[0] <= one <= time[-1]])
    for axes, panel in zip(rows, panels, strict=True):
        label_values(axes, quantity(result.unit(panel[0]), tuple(panel)), unit_of(axes))
        name_curves(axes, dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True)), 1.0)
        if times.size:
            axes.plot(
                times, np.zeros(times.size), "|", ms=6, mew=0.7, color=style.CONTACT,
                transform=axes.get_xaxis_transform(), clip_on=False, zorder=4,
            )  # fmt: skip
    caption(drawing, _words(result, {name: float(error.max()) for name, error in errors.items()}))
    return drawing


# --- panels over time ---

COLUMNS = 400  # of a panel's width, in which the least and the greatest value of a dense curve are drawn
TURNS = 3.0  # changes of direction in a column, from which on a curve is a block


class Curve(NamedTuple):
    """A line of a panel over time.

    label: its name. time [s], values [SI] (n,). errors: of the values (n,) [SI], None if they are not known.
    colour, dashes: of the line; no dashes: the points are marks.
    """

    label: str
    time: Series
    values: Series
    errors: Series | None
    colour: str
    dashes: style.Dashes


def draw_panels(
    drawing: Figure, panels: Sequence[tuple[str, Sequence[Curve]]]
) -> tuple[list[Axes], DisplayUnit]:
    """Draw panels one below the other over the same time, each of a unit [SI] with its curves.

    Returns the panels, and the unit of their time.
    """
    rows: list[Axes] = drawing.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0].tolist()
    every = [curve.time for _, curves in panels for curve in curves if curve.time.size]
    first, last = min(time[0] for time in every), max(time[-1] for time in every)
    seconds = readable("s", float(last - first))
    for axes, (unit, curves) in zip(rows, panels, strict=True):
        shown = readable(unit, max(float(np.nanmax(np.abs(curve.values), initial=0.0)) for curve in curves))
        for curve in curves:
            _draw_curve(axes, curve, seconds.scale * curve.time, shown)
        label_values(axes, quantity(unit), shown.name)
    drawing.align_ylabels(rows)
    rows[-1].set_xlabel(f"time [{seconds.name}]")
    rows[-1].set_xlim(seconds.scale * first, seconds.scale * last)
    return rows, seconds


def _draw_curve(axes: Axes, curve: Curve, time: Series, unit: DisplayUnit) -> None:
    """Draw a curve over time in a unit; if it is so dense that it is a block, pale, with its envelope."""
    values = unit.scale * curve.values
    look: dict[str, Any] = {"ls": curve.dashes, "lw": 0.9, "rasterized": time.size > 20000}
    if not curve.dashes:
        look = {"ls": "", "marker": "o", "ms": 3.5, "mfc": "none", "mew": 1.0, "zorder": 3}
    elif np.count_nonzero(np.diff(np.sign(np.diff(values)))) > TURNS * COLUMNS:
        look |= {"ls": "-", "lw": 0.4, "alpha": 0.35}
        edges = np.linspace(0, values.size, COLUMNS + 1).astype(int)[:-1]
        for pick in (np.fmin, np.fmax):
            axes.plot(time[edges], pick.reduceat(values, edges), color=curve.colour, lw=0.8, zorder=3)
    axes.plot(time, values, color=curve.colour, label=curve.label, **look)
    band = np.zeros(1) if curve.errors is None else unit.scale * curve.errors
    extent = float(np.nanmax(values, initial=-math.inf) - np.nanmin(values, initial=math.inf))
    if float(band.max(initial=0.0)) > VISIBLE * max(extent, 1e-300):
        axes.fill_between(time, values - band, values + band, color=curve.colour, alpha=0.25, lw=0.0)


def label_values(axes: Axes, what: str, unit: str) -> None:
    """Label an axis with a quantity and its unit; it has no power of ten of its own above it."""
    if not PLAIN[0] < max(np.abs(axes.get_ylim())) < PLAIN[1]:
        axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.set_ylabel(textwrap.fill(f"{what} [{unit}]", LETTERS))


def name_curves(axes: Axes, curves: Mapping[str, Any], height: float) -> None:
    """Write the names of curves above a panel, at a height in shares of its own; no line is pale there."""
    legend = axes.legend(
        list(curves.values()), list(curves), loc="lower left", bbox_to_anchor=(0.0, height), fontsize=7,
        borderaxespad=0.0,
    )  # fmt: skip
    for line in legend.get_lines():
        line.set(alpha=1.0, linewidth=1.0)


def unit_of(axes: Axes) -> str:
    """The unit in the label of an axis of values."""
    return axes.get_ylabel().partition("[")[2].rstrip("]")


def _words(result: Result, worst: dict[str, float]) -> str:
    text = f"Records every {units.amount(spacing(result), 's')}, joined by straight lines. "
    if any(result.onsets.values()):
        text += "Strokes on the time axis: impacts. "
    if not worst:
        return text + "The numerical error is not known: the run was not made to an accuracy."
    known = [f"{name} {units.amount(error, result.unit(name), 2)}" for name, error in worst.items()]
    more = f" and {len(known) - NAMED} more" if len(known) > NAMED else ""
    return (
        f"{text}Largest numerical error at any record, shaded where it is visible: "
        f"{', '.join(known[:NAMED])}{more}; largest around impacts, whose times are uncertain too."
    )
