"""Quick look: channels of a run over time."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import StrMethodFormatter

from support_exudyn.postprocessing.figures import style, units
from support_exudyn.postprocessing.figures.journal import Series, clearance_joints, corners
from support_exudyn.postprocessing.figures.selection import inside, matching, said, spacing
from support_exudyn.postprocessing.figures.style import caption
from support_exudyn.postprocessing.figures.units import DisplayUnit, readable
from support_exudyn.simulation.estimate import believed, multiple
from support_exudyn.simulation.reported_numbers import ROUNDING
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

CURVES = style.CURVES  # of a panel
MOST = 32  # channels in a figure
PANEL_MM, LINE_MM, REST_MM = 38.0, 4.0, 30.0  # height of a panel, of a line of its legend, and of the rest
LETTERS = 22  # of a line beside a panel
PLAIN = (1e-3, 1e5)  # sizes of numbers that an axis shows as they are
UNLIKE = 50.0  # by what factor sizes differ that are not drawn together
FLAT = (
    100.0  # by what factor the range of a panel may exceed that of a channel in it, which would look constant
)
VISIBLE = 2e-3  # share of a panel's height from which on an error is shaded


class Panel(NamedTuple):
    """Channels that are drawn in one panel, and the unit in which."""

    unit: DisplayUnit
    names: tuple[str, ...]


def groups(result: Result, names: Sequence[str], chosen: np.ndarray) -> list[Panel]:
    """Panels: channels of one unit, of like size and like range together, as many as there are colours."""
    found: list[_Group] = []
    for name in names:
        values = result[name][chosen]
        one = _Group([name], result.unit(name), float(values.min()), float(values.max()), float(np.ptp(values)))
        place = next((n for n, other in enumerate(found) if other.takes(one)), None)
        if place is None:
            found.append(one)
        else:
            found[place] = found[place].with_another(one)
    most = len(CURVES)
    return [
        Panel(readable(group.unit, group.size), tuple(part.tolist()))
        for group in found
        for part in np.array_split(np.array(group.names), math.ceil(len(group.names) / most))
    ]


class _Group(NamedTuple):
    """Channels of a unit [SI]: their least and greatest value, and the smallest range of one that varies."""

    names: list[str]
    unit: str
    low: float
    high: float
    least_range: float

    @property
    def size(self) -> float:
        return max(abs(self.low), abs(self.high))

    def takes(self, one: _Group) -> bool:
        """Whether another channel is drawn with these: none looks flat then, nor is told in another unit."""
        if self.unit != one.unit:
            return False
        if self.size == 0.0 or one.size == 0.0:
            return self.size == one.size
        alike = 1.0 / UNLIKE < one.size / self.size < UNLIKE
        together = self.with_another(one)
        flat = together.high - together.low > FLAT * together.least_range > 0.0
        return alike and not flat and readable(self.unit, self.size) == readable(one.unit, one.size)

    def with_another(self, one: _Group) -> _Group:
        ranges = [each for each in (self.least_range, one.least_range) if each > 0.0]
        low, high = min(self.low, one.low), max(self.high, one.high)
        return _Group(self.names + one.names, self.unit, low, high, min(ranges, default=0.0))


def error_over_time(result: Result, name: str) -> Series | None:
    """Estimated numerical error of a channel at every record (n,), SI; None if nothing tells it.

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
    lines = sum(len(panel.names) for panel in panels)
    title = f"{type(result.scenario.machine).__name__}, {said(result, after, until)}"
    drawing = style.begin(170, REST_MM + PANEL_MM * len(panels) + LINE_MM * lines, title)
    errors = {name: error for name in names if (error := error_over_time(result, name)) is not None}
    with_clearance = {f"pin.{pin}.force" for pin in clearance_joints(result)}
    shown = []
    for panel in panels:
        loose = with_clearance & set(panel.names)
        curves = []
        for name, (colour, dashes) in zip(panel.names, CURVES, strict=False):
            if len(loose) == 1 and name in loose:  # several are told apart as others are
                colour = style.CONTACT
            label = f"{name}: {result.channels[name].meaning}"
            error = errors.get(name)
            band = None if error is None else error[chosen]
            curves.append(Curve(label, time, result[name][chosen], band, colour, dashes))
        shown.append(curves)
    rows, seconds = draw_panels(
        drawing, [(result.unit(panel.names[0]), curves) for panel, curves in zip(panels, shown, strict=True)]
    )
    for axes in rows:
        axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), fontsize=7, borderaxespad=0.0, ncols=1)
        _mark_impacts(axes, result, chosen, seconds)
    caption(drawing, _words(result, {name: float(error[chosen].max()) for name, error in errors.items()}))
    return drawing


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
            time, values = seconds.scale * curve.time, shown.scale * curve.values
            look: dict[str, Any] = {"ls": curve.dashes, "lw": 0.9, "rasterized": time.size > 20000}
            if not curve.dashes:
                look = {"ls": "", "marker": "o", "ms": 3.5, "mfc": "none", "mew": 1.0, "zorder": 3}
            axes.plot(time, values, color=curve.colour, label=curve.label, **look)
            band = None if curve.errors is None else shown.scale * curve.errors
            extent = float(np.nanmax(values, initial=-math.inf) - np.nanmin(values, initial=math.inf))
            if band is not None and float(band.max(initial=0.0)) > VISIBLE * max(extent, 1e-300):
                axes.fill_between(time, values - band, values + band, color=curve.colour, alpha=0.25, lw=0.0)
        label_values(axes, units.QUANTITIES.get(unit, "value"), shown.name)
    drawing.align_ylabels(rows)
    rows[-1].set_xlabel(f"time [{seconds.name}]")
    rows[-1].set_xlim(seconds.scale * first, seconds.scale * last)
    return rows, seconds


def label_values(axes: Axes, quantity: str, unit: str) -> None:
    """Write beside an axis what is drawn along it, with no power of ten of its own above it."""
    if not PLAIN[0] < max(np.abs(axes.get_ylim())) < PLAIN[1]:
        axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.set_ylabel(textwrap.fill(f"{quantity} [{unit}]", LETTERS))


def _mark_impacts(axes: Axes, result: Result, chosen: np.ndarray, seconds: DisplayUnit) -> None:
    first, last = result.time[chosen][[0, -1]]
    times = [
        one.time
        for joint in (*clearance_joints(result), *corners(result))
        for one in result.onsets.get(joint, ())
        if first <= one.time <= last
    ]
    if not times:
        return
    axes.plot(
        seconds.scale * np.array(times), np.zeros(len(times)), "|", ms=6, mew=0.7, color=style.CONTACT,
        transform=axes.get_xaxis_transform(), clip_on=False, zorder=4,
    )  # fmt: skip


def _words(result: Result, worst: dict[str, float]) -> str:
    text = f"Records every {units.said(spacing(result), 's')}, joined by straight lines. "
    if any(result.onsets.values()):
        text += "Strokes on the time axis: impacts. "
    if not worst:
        return text + "The run was not made to an accuracy: nothing tells its numerical error."
    said_of = ", ".join(
        f"{name} {units.said(error, result.unit(name), 2)}"
        for name, error in list(worst.items())[:6]
    )  # fmt: skip
    more = f" and {len(worst) - 6} more" if len(worst) > 6 else ""
    return (
        f"{text}Largest numerical error at any record, shaded where it can be seen: {said_of}{more}; largest "
        "around impacts, whose times are uncertain too."
    )
