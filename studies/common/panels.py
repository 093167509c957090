"""What figures of several studies do with their panels."""

from collections.abc import Iterable, Sequence
from string import ascii_lowercase
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from studies.common import rise
from studies.common.numbers import Number
from support_exudyn.postprocessing.figures import style


def letters(panels: Sequence[Axes]) -> None:
    """Letter the panels of a figure a, b, c, ... above their upper left corners."""
    for letter, axes in zip(ascii_lowercase, panels, strict=False):
        axes.annotate(
            letter, (0.0, 1.0), (-26.0, 7.0), "axes fraction", "offset points", weight="bold", fontsize=9,
            annotation_clip=False,
        )  # fmt: skip


def forward_arrow(axes: Axes) -> None:
    """Draw an arrow to the right that says which way is forward, in the lower right corner."""
    axes.annotate(
        "forward", (0.97, 0.05), (-42.0, 0.0), "axes fraction", "offset points", fontsize=7, va="center",
        ha="right", arrowprops={"arrowstyle": "-|>", "color": "#555555", "lw": 0.8}, color="#555555",
    )  # fmt: skip


def time_ticks(axes: Axes, watched: rise.Watched) -> None:
    """Ticks of a time axis that has the beginning and the end of the motion among them."""
    low, high = axes.get_xlim()
    inside = [t for t in (watched.start, watched.end) if low <= t <= high]
    near = 0.12 * (high - low)
    others = [t for t in MaxNLocator(6, steps=[1, 2.5, 5, 10]).tick_values(low, high) if low <= t <= high]
    axes.set_xticks(sorted({*inside, *(t for t in others if all(abs(t - one) > near for one in inside))}))
    axes.set_xlim(low, high)


def grid(height_mm: float, rows: int, columns: int, width_mm: float = 170, **given: Any) -> tuple[Figure, Any]:
    """A figure and its panels, shape (rows, columns); given: other arguments of `Figure.subplots`."""
    drawing = Figure(figsize=style.size(width_mm, height_mm))
    return drawing, drawing.subplots(rows, columns, squeeze=False, **given)


def finish(drawing: Figure, panels: Iterable[Axes], columns: int = 0, key: Axes | None = None) -> Figure:
    """Letter the panels, and put one legend below them: of the first panel, or of `key`; columns = 0: none."""
    shown = list(panels.flat if isinstance(panels, np.ndarray) else panels)
    letters(shown)
    if columns:
        handles = (key or shown[0]).get_legend_handles_labels()
        drawing.legend(*handles, loc="outside lower center", ncols=columns)
    return drawing


def heading(axes: Axes, text: str) -> None:
    """A title in the middle above a panel."""
    axes.annotate(text, (0.5, 1.0), (0.0, 4.0), "axes fraction", "offset points", ha="center", fontsize=8)


def error_bars(
    axes: Axes,
    places: Sequence[float] | np.ndarray,
    row: Sequence[Number],
    scale: float = 1.0,
    *,
    across: bool = False,
    **look: Any,
) -> None:
    """Numbers with their errors at places along the x axis; across: along the y axis."""
    values, errors = ([scale * getattr(n, one) for n in row] for one in ("value", "numerical_error"))
    if across:
        axes.errorbar(values, places, xerr=errors, **look)
    else:
        axes.errorbar(places, values, yerr=errors, **look)


def fit_height(axes: Axes, curves: Iterable[rise.Series]) -> None:
    """The height of a panel: that of its curves, and a twentieth above and below."""
    values = list(curves)
    low, high = min(curve.min() for curve in values), max(curve.max() for curve in values)
    axes.set_ylim(low - 0.05 * (high - low), high + 0.05 * (high - low))
