"""Work-precision diagrams."""

import math
from collections.abc import Callable, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter, NullLocator, StrMethodFormatter

from studies.benchmarking.variants import BUILT_IN, STOCK, WayRun, front
from support_exudyn.postprocessing.figures import style

PANELS: dict[str, Callable[[WayRun], float]] = {
    "mean force": lambda row: row.errors["mean"],
    "spread": lambda row: row.errors["spread"],
    "peak force": lambda row: row.errors["peak"],
    "impact velocities": lambda row: max(row.errors[f"onset {n}"] for n in (1, 2, 3)),
    "path [m]": lambda row: row.errors["path"],
    "acceleration": lambda row: row.errors["acceleration"],
}
COSTS: dict[str, Callable[[WayRun], float]] = {
    "wall time [s]": lambda row: row.seconds,
    "calls of the contact in Python": lambda row: float(row.calls),
}
HARDLY = 0.7  # decades
SMALLEST = 1e-11  # errors below are those of the reference
# by family: colour, which none of `style` is that means something else, and marker
LOOKS = {
    "redundant, python": ("#0072B2", "o"),
    "redundant, symbolic": ("#332288", "s"),
    "redundant, growing steps": ("#004466", "^"),
    "reduced": ("#997700", "v"),
    "tree": ("#009E73", "P"),
    "trapezoidal, index 2": ("#CC79A7", "<"),
    "nothing located": ("#888888", "x"),
    "spectral radius": ("#999933", "1"),
    "Newton's method": ("#661100", "2"),
    BUILT_IN: ("#444444", "+"),
    STOCK: ("#000000", "*"),
}


def stem(scene: str) -> str:
    """File name of a scene's figure."""
    return f"work_{scene.replace(', ', '_').replace('-', '_').replace(' ', '_')}"


def figure(title: str, rows: Sequence[WayRun]) -> Figure:
    """Errors of all ways of a scene over their costs; a cost that none has is left out."""
    good = [row for row in rows if not row.failure]
    asked = {cost: spent for cost, spent in COSTS.items() if any(spent(row) > 0.0 for row in good)}
    costs = asked or dict(list(COSTS.items())[:1])  # empty panels where every run has failed
    drawing = Figure(figsize=style.size(260, 20 + 53 * len(costs)))
    axes = drawing.subplots(len(costs), len(PANELS), sharex="row", sharey="col", squeeze=False)
    for line, (cost, spent) in zip(axes, costs.items(), strict=True):
        for n, (ax, (name, error)) in enumerate(zip(line, PANELS.items(), strict=True)):
            _panel(ax, good, spent, error)
            if cost == next(iter(costs)):
                ax.set_title(f"{'abcdef'[n]}) {name}")
        line[len(PANELS) // 2].set_xlabel(cost, x=0.0)  # in the middle of the row
        line[0].set_ylabel("relative error, path: in m", fontsize=8)
    handles, labels = axes[0][0].get_legend_handles_labels()
    drawing.suptitle(title)
    drawing.legend(handles, labels, loc="outside lower center", ncols=7, fontsize=8)
    return drawing


def _panel(
    ax: Axes, rows: Sequence[WayRun], spent: Callable[[WayRun], float], error: Callable[[WayRun], float]
) -> None:
    best = front(rows)
    for family, (colour, marker) in LOOKS.items():
        points = sorted(
            (spent(row), max(SMALLEST, error(row)))
            for row in rows
            if row.family == family and error(row) < float("inf") and spent(row) > 0.0
        )
        if not points:
            continue
        size = 8.0 if family == STOCK else 4.0
        x, y = zip(*points, strict=True)
        ax.plot(x, y, color=colour, marker=marker, markersize=size, linewidth=0.6, label=family)
    ringed = [(spent(row), max(SMALLEST, error(row))) for row in best if spent(row) > 0.0]
    if ringed:
        ax.plot(
            *zip(*ringed, strict=True),
            "o",
            markersize=9,
            markerfacecolor="none",
            color="#AA0000",
            markeredgewidth=0.7,
            clip_on=False,
            label="the front",
        )
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.margins(x=0.1)
    ax.yaxis.set_major_locator(LogLocator(numticks=6))
    ax.yaxis.set_minor_locator(NullLocator())
    _label_costs(ax, [spent(row) for row in rows if spent(row) > 0.0])


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
    ax.tick_params(axis="x", labelsize=7.5)
