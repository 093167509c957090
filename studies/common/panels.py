"""What figures of several studies do with their panels."""

from collections.abc import Iterable

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common import rise

WINDOWS = {"early": (3.0, 3.12), "middle": (4.0, 4.12), "late": (4.6, 4.72)}  # enlarged in Fig. 3 and 6 [s]


def legend(drawing: Figure, axes: Axes, columns: int) -> None:
    """One legend for all panels, below them."""
    drawing.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=columns)


def fit_height(axes: Axes, curves: Iterable[rise.Series]) -> None:
    """The height of a panel: that of its curves, and a twentieth above and below."""
    values = list(curves)
    low, high = min(curve.min() for curve in values), max(curve.max() for curve in values)
    axes.set_ylim(low - 0.05 * (high - low), high + 0.05 * (high - low))
