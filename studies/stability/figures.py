"""Pictures of predicted and measured growth, and of where in the stroke pins shake."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common.panels import letters
from studies.stability.cases import PINS, STIFFNESSES, Prepared
from studies.stability.measures import Growth, difference
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.stability_map import draw_map, finish
from support_exudyn.scenario.pin_stability import PinOutlook

COLOURS = dict(zip(PINS, (style.WITH_CLEARANCE, style.THIRD, style.SMOOTH, style.PAPER), strict=True))
MARKERS = dict(zip(STIFFNESSES, ("o", "s", "D", "^"), strict=True))
LINEAR = 0.1  # [1/s] up to which the axes of growth rates are linear


def answer_figure(found: Sequence[Growth], shown: Prepared, runs: Mapping[str, Result]) -> Figure:
    """Measured over predicted growth rates (a), and the small motion of one case with what is predicted (b)."""
    drawing = Figure(figsize=style.size(170, 88))
    rates, motion = drawing.subplots(1, 2, width_ratios=(1.0, 1.15))
    for one in found:
        rates.plot(
            one.predicted, one.halved, MARKERS[one.stiffness], color=COLOURS[one.pin], ms=4, mfc="none", mew=0.9
        )
    ends = (1.5 * min(one.predicted for one in found), 1.5 * max(one.predicted for one in found))
    rates.plot(ends, ends, color="#999999", lw=0.8, zorder=0.5)
    rates.set_xscale("symlog", linthresh=LINEAR)
    rates.set_yscale("symlog", linthresh=LINEAR)
    ticks = [-1.0, 0.0, 1.0, 10.0, 100.0]
    for axis in (rates.xaxis, rates.yaxis):
        axis.set_ticks(ticks, [f"{tick:g}" for tick in ticks])
        axis.set_ticks([], minor=True)
    rates.set(xlim=ends, ylim=ends, xlabel="predicted growth rate [1/s]", ylabel="in a run [1/s]")
    for pin, colour in COLOURS.items():
        rates.plot([], [], "o", color=colour, ms=4, label=pin)
    for name, marker in MARKERS.items():
        rates.plot([], [], marker, color="black", ms=4, mfc="none", label=name)
    drawing.legend(*rates.get_legend_handles_labels(), loc="outside lower left", ncols=4, fontsize=7)
    _motion(motion, shown, runs)
    letters([rates, motion])
    return drawing


def _motion(axes: Axes, shown: Prepared, runs: Mapping[str, Result]) -> None:
    time, motion = difference(shown, runs, fine=True)
    normal = shown.predicted.place / np.linalg.norm(shown.predicted.place)
    across = motion @ np.array([-normal[1], normal[0]])
    growth = shown.predicted.growth
    axes.plot(1e3 * time, 1e9 * across, color=COLOURS[shown.case.pin], label="difference of two runs")
    size = np.max(np.abs(across) * np.exp(-growth * time))
    for sign in (1.0, -1.0):
        label = f"exp({growth:.3g}/s t), predicted" if sign > 0 else None
        axes.plot(
            1e3 * time, sign * 1e9 * size * np.exp(growth * time), "--", color="black", lw=0.8, label=label
        )
    axes.set(xlim=(0, 1e3 * time[-1]), xlabel="time [ms]", ylabel="motion along the wall [nm]")
    axes.legend(fontsize=7, loc="upper left")


def map_figure(maps: Mapping[str, PinOutlook]) -> Figure:
    """Growth rates over stroke and friction, a panel for each pin and stiffness, by their titles."""
    drawing = Figure(figsize=style.size(170, 120))
    panels = list(drawing.subplots(2, 2, sharex=True, sharey=True).flat)
    for axes, (title, outlook) in zip(panels, maps.items(), strict=True):
        colours = draw_map(axes, outlook)
        axes.set_title(title, fontsize=8)
    finish(drawing, panels, colours)
    letters(panels)
    return drawing
