"""Figures of time series to look into in a browser: values under the pointer, zoom, curves off and on.

A figure is kept as JSON next to its picture. A page holds bokeh's script once and all its figures as data, so
that it loads nothing.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from pydantic import TypeAdapter, ValidationError

from support_exudyn.files.whole_file import contents, whole_file
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.figures.selection import in_line
from user_forces.values.value import InputError

LARGEST_FILE = 50_000_000  # bytes
MOST_POINTS = 1500  # of a curve; a few more of several rough ones with the same x
DIGITS = 7
Dash = Literal["solid", "dashed", "dotted", "dotdash", "points"]
DASHES: dict[str, Dash] = {"-": "solid", "--": "dashed", ":": "dotted", "-.": "dotdash"}


@dataclass(frozen=True)
class LiveCurve:
    """A curve: its name, its points, None in y where it is broken; colour as "#rrggbb", dash, width [points].

    Of dash "points" each point is a mark, and none is joined with the next.
    """

    label: str
    x: tuple[float, ...]
    y: tuple[float | None, ...]
    colour: str
    dash: Dash = "solid"
    width: float = 1.0


@dataclass(frozen=True)
class LivePanel:
    """A panel: label of its y axis with the unit in brackets, and its curves, the undermost first."""

    label: str
    curves: tuple[LiveCurve, ...]


@dataclass(frozen=True)
class LiveFigure:
    """Panels one below the other over the same x axis; x_label: its label with the unit in brackets."""

    x_label: str
    panels: tuple[LivePanel, ...]

    def save(self, path: Path) -> None:
        """Write it as JSON, whole or not at all."""
        with whole_file(path) as temporary:
            text = json.dumps(asdict(self), ensure_ascii=False, allow_nan=False, separators=(",", ":"))
            temporary.write_text(text + "\n", encoding="utf-8")

    @staticmethod
    def load(path: Path) -> LiveFigure:
        """Read it back. Raises InputError that names the file and its fault; OSError if it cannot."""
        try:
            return TypeAdapter(LiveFigure).validate_json(contents(path, LARGEST_FILE))
        except ValidationError as error:
            raise InputError(f"{path}: no live figure: {error.errors()[0]['msg']}") from None


# --- from a drawing ---


def of_drawing(drawing: Figure, panels: Sequence[int] | Mapping[int, str]) -> LiveFigure:
    """The curves of some panels of a matplotlib figure, thinned so that no peak is lost.

    Curves are the lines of a panel that have a label. Those without one, and those across the whole panel, are
    aids to the eye and left out.

    Arguments:
        drawing: whose panels are drawn over the same quantity.
        panels: which of `drawing.axes`; or their labels by which, if the drawing says them elsewhere.
    """
    named = panels if isinstance(panels, Mapping) else {}
    found = []
    for number in panels:
        axes = drawing.axes[number]
        lines = [line for line in axes.get_lines() if _is_curve(axes, line)]
        lines.sort(key=lambda line: float(line.get_zorder()))
        found.append(LivePanel(in_line(named.get(number, axes.get_ylabel())), _curves(lines)))
    of_panels = [drawing.axes[number].get_xlabel() for number in panels]
    labels = of_panels + [axes.get_xlabel() for axes in drawing.axes]
    return LiveFigure(in_line(next((label for label in labels if label), "")), tuple(found))


def _is_curve(axes: Axes, line: Line2D) -> bool:
    """Whether it has a label, is drawn in the data's coordinates, and has points."""
    label = str(line.get_label())
    in_data = line.get_transform() == axes.transData
    return in_data and bool(label) and not label.startswith("_") and bool(np.size(line.get_xdata()))


def _curves(lines: Sequence[Line2D]) -> tuple[LiveCurve, ...]:
    """Lines as curves, thinned so that no peak is lost, in 7 digits.

    Those with the same x stay so: all their values at a place can be read together.
    """
    groups: dict[bytes, list[tuple[Line2D, Series, Series]]] = {}
    for line in lines:
        data: list[Any] = [np.ma.asarray(one, float) for one in line.get_data(orig=False)]
        x, y = (np.asarray(one.filled(np.nan)) for one in data)
        groups.setdefault(x.tobytes(), []).append((line, x, y))
    made: dict[Line2D, LiveCurve] = {}
    for group in groups.values():
        x = group[0][1]
        placed = np.flatnonzero(np.isfinite(x))
        kept = placed[thinned(np.array([y[placed] for *_, y in group]), MOST_POINTS)]
        places = tuple(_rounded(value) for value in x[kept].tolist())
        for line, _, y in group:
            values = [_rounded(value) if math.isfinite(value) else None for value in y[kept].tolist()]
            style = str(line.get_linestyle())
            dash: Dash = "points" if style in ("None", "", " ") else DASHES.get(style, "solid")
            colour, width = to_hex(line.get_color()), round(float(line.get_linewidth()), 2)
            label = in_line(str(line.get_label()))
            made[line] = LiveCurve(label, places, tuple(values), colour, dash, width)
    return tuple(made[line] for line in lines)


def thinned(curves: Series, most: int) -> npt.NDArray[np.intp]:
    """The indexes of points of curves (k, n) that are kept, so that about `most` are left.

    Of every bin of equally many points the first and the last one stay, and the lowest and the highest of every
    curve; of points that are not finite, at which a curve is broken, the first one.
    """
    number = curves.shape[1]
    if number <= most:
        return np.arange(number, dtype=np.intp)
    edges = np.linspace(0, number, max(1, most // (2 + len(curves))) + 1).astype(int).tolist()
    kept = {*edges[:-1], *(edge - 1 for edge in edges[1:])}
    for start, end in pairwise(edges):
        for y in curves[:, start:end]:
            finite = np.isfinite(y)
            if not finite.all():
                kept.add(start + int(finite.argmin()))
            if finite.any():
                known = np.where(finite, y, np.nan)
                kept |= {start + int(np.nanargmin(known)), start + int(np.nanargmax(known))}
    return np.array(sorted(kept), dtype=np.intp)


def _rounded(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")
