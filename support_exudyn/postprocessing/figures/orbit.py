"""Journal orbit: the path of the journal's centre within the clearance circle."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from support_exudyn.postprocessing.figures import style, units
from support_exudyn.postprocessing.figures.journal import JournalPath, journal, shortest_impact
from support_exudyn.postprocessing.figures.selection import as_words, window_text
from support_exudyn.postprocessing.figures.units import DisplayUnit, readable
from support_exudyn.simulation.result import Result

CORNERS = 181  # of the clearance circle
MARGIN = 1.12  # of the largest eccentricity
MANY = 20000  # points from which on a line is a picture within a PDF
WIDTHS = (0.8, 1.6)  # of flight and of contact [points]
IMPACT: dict[str, Any] = {
    "marker": "v", "ms": 3.5, "mfc": "white", "mec": style.IDEAL, "mew": 0.7, "ls": "none", "zorder": 4,
}  # fmt: skip


def orbit(result: Result, pin: str | None = None, after: float = 0.0, until: float = math.inf) -> Figure:
    """Path of a journal's centre in its bore, true to scale; depth over time; speeds of the impacts.

    Arguments:
        pin: name of a clearance pin; the first one by default.
        after, until: what of the run is drawn [s].

    Raises InputError if there is no such clearance pin, or fewer than two records lie between the times.
    """
    shown = journal(result, pin, after, until)
    title = f"journal orbit in {as_words(shown.pin)}, radial clearance {1e3 * shown.clearance:g} mm"
    drawing = style.begin(170, 112, f"{title}, {window_text(result, after, until)}")
    grid = drawing.add_gridspec(3, 2, width_ratios=(1.15, 1.0), height_ratios=(1.0, 1.0, 0.12))
    place, depth = drawing.add_subplot(grid[:2, 0]), drawing.add_subplot(grid[0, 1])
    speeds, below = drawing.add_subplot(grid[1, 1], sharex=depth), drawing.add_subplot(grid[2, :])
    place.set_title("a) path of the centre")
    draw_path(place, shown, readable("m", max(shown.clearance, float(np.hypot(shown.x, shown.y).max()))))
    over_time = readable("s", float(np.ptp(shown.time)))
    _draw_depth(depth, shown, over_time)
    _draw_speeds(speeds, shown, over_time)
    below.axis("off")
    handles, labels = place.get_legend_handles_labels()
    below.legend(handles, labels, loc="center left", ncols=len(labels), fontsize=7, borderaxespad=0.0)
    depth.locator_params(axis="x", nbins=5)
    style.caption(drawing, _words(shown, in_space=result.scenario.dimensions == 3))
    return drawing


def draw_path(axes: Axes, shown: JournalPath, unit: DisplayUnit) -> None:
    """The path in the colours of contact and flight, within the clearance circle, on equal axes."""
    x, y, contact = shown.path()
    angle, bore = np.linspace(0.0, 2.0 * np.pi, CORNERS), unit.scale * shown.clearance
    circle = bore * np.cos(angle), bore * np.sin(angle)
    axes.plot(*circle, color=style.IDEAL, ls=(0, (4, 2)), zorder=2, label="clearance circle")
    reach = MARGIN * unit.scale * max(shown.clearance, float(np.hypot(shown.x, shown.y).max()))
    axes.set(aspect="equal", xlim=(-reach, reach), ylim=(-reach, reach))
    axes.set(xlabel=f"eccentricity x [{unit.name}]", ylabel=f"eccentricity y [{unit.name}]")
    more: dict[str, Any] = {"rasterized": x.size > MANY, "zorder": 3}
    style.draw_pieces(axes, unit.scale * x, unit.scale * y, contact, WIDTHS, **more)
    if shown.impacts:
        directions = shown.directions
        axes.plot(bore * np.cos(directions), bore * np.sin(directions), label="impact", **IMPACT)
    for n, mark, name, inner in ((0, "o", "start", "white"), (-1, "s", "end", style.IDEAL)):
        place = unit.scale * shown.x[n], unit.scale * shown.y[n]
        axes.plot(*place, mark, ms=5, color=style.IDEAL, label=name, zorder=5, mfc=inner)


def _draw_depth(axes: Axes, shown: JournalPath, over_time: DisplayUnit) -> None:
    unit = readable("m", float(np.abs(shown.depth).max()))
    time, depth = over_time.scale * shown.time, unit.scale * shown.depth
    axes.axhline(0.0, color=style.IDEAL, lw=0.6)
    contact = shown.in_contact[:-1] & shown.in_contact[1:]
    style.draw_pieces(axes, time, depth, contact, WIDTHS, rasterized=time.size > MANY, zorder=3)
    axes.plot(over_time.scale * shown.touches, np.zeros(len(shown.impacts)), **IMPACT)
    axes.set(xlabel=f"time [{over_time.name}]", ylabel=f"depth [{unit.name}]", xlim=time[[0, -1]])
    axes.set_title("b) depth; negative: gap")


def _draw_speeds(axes: Axes, shown: JournalPath, over_time: DisplayUnit) -> None:
    separated = [one for one in shown.impacts if one.separation_time <= shown.time[-1]]
    approach, away = [one.speed for one in shown.impacts], [one.separation_velocity for one in separated]
    unit = readable("m/s", max(approach, default=0.0))
    axes.set(title="c) speeds", xlabel=f"time [{over_time.name}]", ylabel=f"speed [{unit.name}]")
    if not shown.impacts:
        text = "in contact throughout" if shown.in_contact.all() else "no impact"
        axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center")
        axes.set_yticks([])
        return
    impacts: dict[str, Any] = IMPACT | {"mew": 0.8, "label": "impact"}
    axes.plot(over_time.scale * shown.touches, unit.scale * np.array(approach), **impacts)
    ends = over_time.scale * np.array([one.separation_time for one in separated])
    axes.plot(ends, unit.scale * np.array(away), "^", ms=3.5, color=style.FLIGHT, label="separation")
    axes.set_ylim(0.0, 1.1 * unit.scale * max(*approach, *away, 1e-30))
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, fontsize=7, borderaxespad=0.0)


def _words(shown: JournalPath, *, in_space: bool) -> str:
    """What is drawn, and what is not."""
    text = (
        f"Drawn true to scale: {shown.time.size} records, one every {units.amount(shown.spacing, 's')}, joined "
        "by straight lines."
    )
    if shown.impacts:
        text += (
            f" Impacts ({len(shown.impacts)}) and separations are put in between them at the times when they "
            "were located, impacts on the circle in the direction of the last flight."
        )
    if (shortest := shortest_impact(shown.impacts)) < 2.0 * shown.spacing:
        text += (
            f" The shortest impact lasts {units.amount(shortest, 's')}: its depth falls between the records; a "
            "smaller record_period shows it."
        )
    if (deepest := float(shown.depth.max())) > 0.0:
        text += f" Deepest record: {units.amount(deepest, 'm')}."
    if in_space:
        text += " In space: the middle of the journal; the depth is that where it is deepest along the pin."
    return text
