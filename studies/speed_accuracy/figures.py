"""Work-precision diagrams."""

import math
import re
from collections.abc import Callable, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter, NullLocator, StrMethodFormatter

from studies.benchmarking.trade import ENGINE
from studies.benchmarking.variants import BUILT_IN, STOCK, WayRun, front
from studies.common.panels import letters
from support_exudyn.postprocessing.figures import style

PANELS: dict[str, Callable[[WayRun], float]] = {
    "relative error of the mean force": lambda row: _error(row, "mean"),
    "of its spread": lambda row: _error(row, "spread"),
    "of its peak": lambda row: _error(row, "peak"),
    "of impact velocities": lambda row: _error(row, "onset 1", "onset 2", "onset 3"),
}
HARDLY = 0.7  # decades
SMALLEST = 1e-11  # errors below are those of the reference
# by family: colour, which none of `style` is that means something else, and marker
LOOKS = {
    "compiled": ("#997700", "v"),
    ENGINE: ("#0072B2", "o"),
    f"{ENGINE}, growing steps": ("#004466", "^"),
    BUILT_IN: ("#444444", "+"),
    STOCK: ("#000000", "*"),
}


def _error(row: WayRun, *names: str) -> float:
    """The largest of a row's errors; not a number where there is none."""
    return max((row.errors[name] for name in names if name in row.errors), default=math.nan)


def stem(scene: str) -> str:
    """File name of a scene's figure."""
    return f"work_{re.sub('[^a-z0-9]+', '_', scene)}"


def figure(rows: Sequence[WayRun]) -> Figure:
    """Errors of all ways of a scene over their processor time; a number that the scene lacks is left out."""
    good = [row for row in rows if not row.failure]
    drawing = Figure(figsize=style.size(180, 130))
    axes = drawing.subplots(2, 2, sharex=True)
    for ax, (name, error) in zip(axes.flat, PANELS.items(), strict=True):
        _panel(ax, good, error)
        ax.set_ylabel(name, fontsize=8)
        ax.tick_params(labelsize=7.5)
    for ax in axes[-1]:
        ax.set_xlabel("processor time [s]", fontsize=8)
    letters(list(axes.flat))
    drawing.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=4, fontsize=8)
    return drawing


def _panel(ax: Axes, rows: Sequence[WayRun], error: Callable[[WayRun], float]) -> None:
    for family, (colour, marker) in LOOKS.items():
        points = sorted(
            (row.seconds, max(SMALLEST, error(row)))
            for row in rows
            if row.family == family and math.isfinite(error(row))
        )
        if not points:
            continue
        x, y = zip(*points, strict=True)
        ax.plot(x, y, color=colour, marker=marker, ms=7.0 if family == STOCK else 4.5, lw=0.8, label=family)
    ringed = [(row.seconds, max(SMALLEST, error(row))) for row in front(rows) if math.isfinite(error(row))]
    if ringed:
        ax.plot(
            *zip(*ringed, strict=True), "o", ms=9, mfc="none", color="#AA0000", mew=0.8, clip_on=False,
            label="the front",
        )  # fmt: skip
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.margins(x=0.1)
    ax.yaxis.set_major_locator(LogLocator(numticks=6))
    ax.yaxis.set_minor_locator(NullLocator())
    _label_costs(ax, [row.seconds for row in rows])


def _label_costs(ax: Axes, costs: Sequence[float]) -> None:
    """Ticks at powers of ten, as many as there is room for; at parts of them too if there is but one."""
    decades = math.log10(max(costs) / min(costs)) if costs else 1.0
    if decades < HARDLY:  # next to a straight scale
        ax.xaxis.set_major_locator(MaxNLocator(2))
        ax.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    elif decades < 2.0:
        ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 3.0) if decades < 1.0 else (1.0,)))
        ax.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    else:
        ax.xaxis.set_major_locator(LogLocator(numticks=4))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.xaxis.set_minor_formatter(NullFormatter())
