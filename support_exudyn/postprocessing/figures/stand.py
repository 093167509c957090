"""Figure of what a support stands: its force over the height, over the canopy, and what its pins carry."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from support_exudyn.machines.strength.results import StandReport
from support_exudyn.machines.strength.roof_forces import RoofForce
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.selection import as_words

BAR = 0.27  # width of a bar, of the distance of two groups
LABELS = {
    "nominal": "legs alike, smooth roof",
    "worst": "any force, smooth roof",
    "rubbed": "any force, rough roof",
}


def stand_figure(report: StandReport) -> Figure:
    """The support force and its place over the height, the resistance over the canopy, forces in pins."""
    drawing = style.begin(180, 150, f"{report.name or 'machine'}: support force at yield")
    grid = drawing.add_gridspec(2, 2, width_ratios=(1.15, 1.0))
    _over_height(drawing.add_subplot(grid[0, 0]), report)
    _place(drawing.add_subplot(grid[0, 1]), report)
    _over_canopy(drawing.add_subplot(grid[1, 0]), report)
    _pins(drawing.add_subplot(grid[1, 1]), report)
    return drawing


def _curve(roofs: list[RoofForce | None]) -> list[float]:
    return [np.nan if roof is None else 1e-3 * roof.force for roof in roofs]


def _over_height(axes: Axes, report: StandReport) -> None:
    forces, heights = report.forces, [1e3 * one.contact.height for one in report.forces]
    curves = {"yield, smooth roof": [one.yielding for one in forces]}
    curves |= {f"yield, rough {mu:+g}": [one.rubbed[mu] for one in forces] for mu in forces[0].rubbed}
    curves["setting"] = [one.setting for one in forces]
    looks = ((style.IDEAL, "-"), *style.CURVES)
    for (label, roofs), (colour, dashes) in zip(curves.items(), looks, strict=False):
        if any(roof is not None for roof in roofs):
            axes.plot(heights, _curve(roofs), color=colour, ls=dashes, label=label)
    axes.axhline(1e-3 * report.rated, color="#777777", lw=0.7)
    axes.annotate("rated", (heights[0], 1e-3 * report.rated), xytext=(2, 2), textcoords="offset points",
                  fontsize=7, color="#777777")  # fmt: skip
    low, high = axes.get_ylim()
    axes.set_ylim(low - 0.25 * (high - low), high + 0.08 * (high - low))
    axes.set(title="legs alike", xlabel="height of the roof [mm]", ylabel="support force [kN]")
    axes.legend(fontsize=7, loc="lower left", ncol=2)


def _place(axes: Axes, report: StandReport) -> None:
    found = [
        (1e3 * one.contact.height, 1e3 * (one.yielding.x - one.contact.rear))
        for one in report.forces
        if one.yielding is not None
    ]
    if found:
        axes.plot(*zip(*found, strict=True), color=style.IDEAL)
    length = 1e3 * (report.forces[0].contact.front - report.forces[0].contact.rear)
    axes.set_ylim(0.0, length)
    axes.set(title="its place on the canopy", xlabel="height of the roof [mm]")
    axes.set_ylabel("place, from the rear end [mm]")


def _over_canopy(axes: Axes, report: StandReport) -> None:
    last = len(report.forces) - 1
    for n, (colour, dashes) in zip(dict.fromkeys((0, last // 2, last)), style.CURVES, strict=False):
        one = report.forces[n]
        places = sorted([*one.over, one.largest], key=lambda roof: roof.x)
        x = [1e3 * (roof.x - one.contact.rear) for roof in places]
        label = f"roof at {1e3 * one.contact.height:.0f} mm"
        axes.plot(x, [1e-3 * roof.force for roof in places], color=colour, ls=dashes, label=label)
    axes.set_ylim(bottom=0.0)
    axes.set(title="opens no valve, lifts no leg", ylabel="largest roof force [kN]")
    axes.set_xlabel("place on the canopy, from the rear end [mm]")
    axes.legend(fontsize=7)


def _pins(axes: Axes, report: StandReport) -> None:
    names = list(report.pins)
    rows = np.arange(len(names))
    for k, (field, (colour, _)) in enumerate(zip(LABELS, style.CURVES, strict=False)):
        loads = [1e-3 * max(getattr(report.pins[name], field).values()) for name in names]
        axes.barh(rows + (k - 1) * BAR, loads, BAR, color=colour, label=LABELS[field])
    axes.set_yticks(rows, [as_words(name) for name in names])
    axes.set_ylim(len(names) + 0.9, -0.6)  # with room for the legend
    axes.grid(visible=False, axis="y")
    axes.set_axisbelow(True)
    axes.set(title="pins at 1.2 times yield", xlabel="largest force over the height [kN]")
    axes.legend(fontsize=7, loc="lower right")
