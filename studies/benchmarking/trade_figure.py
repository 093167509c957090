"""The figure of what accuracy costs: one panel, a line a program."""

from collections.abc import Mapping, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from studies.benchmarking.trade import (
    ONCE,
    OURS_COMPILED,
    OURS_ENGINE,
    PRESETS,
    PROGRAMS,
    STOCK,
    TradePoint,
    lasting_errors,
)
from support_exudyn.postprocessing.figures import style

# by program: colour, marker; ours are blue
LOOKS: Mapping[str, tuple[str, str]] = {
    OURS_COMPILED: ("#0072B2", "o"),
    OURS_ENGINE: ("#56B4E9", "o"),
    STOCK: ("#000000", "s"),
    "MuJoCo": ("#D55E00", "P"),
    "Drake": ("#882255", "^"),
    "scipy's LSODA": ("#009E73", "v"),
}
SMALLEST = 1e-10  # errors below are those of the reference


def figure(points: Sequence[TradePoint]) -> Figure:
    """Errors of all programs over their processor time, on logarithmic axes."""
    drawing = Figure(figsize=style.size(160, 100))
    axes = drawing.subplots()
    for name in PROGRAMS:
        _line(axes, name, [one for one in points if one.program == name])
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="processor time [s]",
        ylabel="relative error of the largest pin force",
    )
    axes.margins(x=0.08, y=0.08)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(numticks=12))
        axis.set_minor_formatter(NullFormatter())
    axes.grid(which="major", lw=0.4, color="#DDDDDD")
    drawing.legend(loc="outside right upper", fontsize=8, frameon=False)
    return drawing


def _line(axes: Axes, name: str, points: Sequence[TradePoint]) -> None:
    if not points:
        return
    colour, marker = LOOKS[name.removesuffix(ONCE)]
    reports = name in (OURS_COMPILED, OURS_ENGINE)
    x = [one.seconds for one in points]
    y = [max(error, SMALLEST) for error in lasting_errors(points)]
    label = f"{name},\nto an accuracy" if reports else name.replace(ONCE, f"{ONCE[:1]}\nsingle run")
    axes.plot(
        x,
        y,
        color=colour,
        marker=marker,
        ms=7.0 if reports else 5.0,
        mfc=colour if reports else "white",
        lw=1.8 if reports else 1.0,
        ls="--" if name.endswith(ONCE) else "-",
        label=label,
    )
    if reports:
        for one, at in zip(points, y, strict=True):
            is_last = one.setting == PRESETS[-1] and name == OURS_ENGINE  # at the edge
            axes.annotate(
                f'"{one.setting}"',
                (one.seconds, at),
                (-7, -2) if is_last else (7, -2),
                textcoords="offset points",
                ha="right" if is_last else "left",
                fontsize=7.5,
                color=colour,
                bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.5},
            )
