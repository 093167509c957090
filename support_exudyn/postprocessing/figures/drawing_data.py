"""The data of a drawing as a table: what its lines, bars, marks, bands and maps show, in long form."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from pathlib import Path
from string import ascii_lowercase
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import PathCollection, PolyCollection, QuadMesh
from matplotlib.container import BarContainer, ErrorbarContainer
from matplotlib.figure import Figure

from support_exudyn.files.whole_file import whole_file
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.figures.selection import in_line

DIGITS = 7
COLUMNS = ("panel", "curve", "x", "y", "x_low", "x_high", "y_low", "y_high", "value", "x_name", "y_name")
Columns = dict[str, Series]


def save_drawing_data(drawing: Figure, path: Path) -> bool:
    """Write the data of a drawing as CSV, in 7 digits; lines that begin with "#" have the labels of its axes.

    A row has the letter of its panel, the name of the curve, and its numbers: x_low, x_high, y_low, y_high are
    ends of error bars, value is that of a cell of a map. Where ticks have names, these are columns, too. Curves
    are written as far as the panel shows them along x. Returns whether there were any: pictures have none.
    """
    rows: list[dict[str, str]] = []
    notes: list[str] = []
    panels = [axes for axes in drawing.axes if axes.axison and axes.get_label() != "<colorbar>"]
    for place, axes in enumerate(panels):
        bold = [text.get_text() for text in axes.texts if text.get_fontweight() == "bold"]
        letter = next((text for text in bold if text and text in ascii_lowercase), ascii_lowercase[place % 26])
        names = {"x": _tick_names(axes.xaxis), "y": _tick_names(axes.yaxis)}
        found = [
            {"panel": letter, "curve": in_line(curve), **dict(zip(columns, map(_cell, numbers), strict=True))}
            for curve, columns in drawn_data(axes)
            for numbers in zip(*(column.tolist() for column in columns.values()), strict=True)
        ]
        if found:
            labels = in_line(axes.get_xlabel()), in_line(axes.get_ylabel())
            notes.append(f"# panel {letter}: x = {labels[0]}; y = {labels[1]}\n")
        rows += [
            row | {f"{axis}_name": names[axis].get(row.get(axis, ""), "") for axis in names} for row in found
        ]
    used = [name for name in COLUMNS if any(row.get(name) for row in rows)]
    if rows:
        with whole_file(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
            file.writelines(notes)
            writer = csv.DictWriter(file, used, "", "ignore", lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    return bool(rows)


def drawn_data(axes: Axes) -> Iterator[tuple[str, Columns]]:
    """What a panel shows, each with its name: bars, error bars, lines, marks, bands, maps; columns are (n,)."""
    for one in axes.containers:
        if isinstance(one, BarContainer):
            boxes: list[Any] = [*one]
            x, y, wide, high = np.array([(*box.get_xy(), box.get_width(), box.get_height()) for box in boxes]).T
            level = one.orientation == "horizontal"
            ends = {"x": x + wide, "y": y + 0.5 * high} if level else {"x": x + 0.5 * wide, "y": y + high}
            yield _name(one, "bars"), ends
        elif isinstance(one, ErrorbarContainer):
            yield _name(one, "error bars"), _of_error_bars(one)
    inside = {id(part) for one in axes.containers for part in one.get_children()}
    low, high = sorted(axes.get_xlim())
    in_data = [line for line in axes.get_lines() if line.get_transform() == axes.transData]
    for number, line in enumerate((line for line in in_data if id(line) not in inside), 1):
        x, y = (_filled(data) for data in line.get_data(orig=False))
        seen = np.isfinite(x) & np.isfinite(y) & (x >= low) & (x <= high)
        if seen.any():
            yield _name(line, f"line {number}"), {"x": x[seen], "y": y[seen]}
    for place, item in enumerate(axes.collections, 1):
        if isinstance(item, PathCollection):
            x, y = _filled(item.get_offsets()).T
            yield _name(item, f"marks {place}"), {"x": x, "y": y}
        elif isinstance(item, QuadMesh):
            corners, values = _filled(item.get_coordinates()), _filled(item.get_array()).ravel()
            middle = 0.25 * (corners[:-1, :-1] + corners[1:, :-1] + corners[:-1, 1:] + corners[1:, 1:])
            x, y = middle.reshape(-1, 2).T
            yield _name(item, "map"), {"x": x, "y": y, "value": values}
        elif isinstance(item, PolyCollection):
            for path in item.get_paths():
                x, y = _filled(path.vertices).T
                yield _name(item, f"area {place}"), {"x": x, "y": y}


def _of_error_bars(container: ErrorbarContainer) -> Columns:
    """The points, else the middles of their bars; and the ends of these."""
    line, _, bars = container.lines
    found: Columns = {}
    for bar, along in zip(bars, "x" * container.has_xerr + "y" * container.has_yerr, strict=False):
        ends = np.array(bar.get_segments())  # (n, 2, 2): ends of each, x and y
        values = ends[:, :, "xy".index(along)]
        found |= {f"{along}_low": values.min(axis=1), f"{along}_high": values.max(axis=1)}
        found |= {"x": ends[:, :, 0].mean(axis=1), "y": ends[:, :, 1].mean(axis=1)}
    if line is not None:
        found["x"], found["y"] = (_filled(data) for data in line.get_data(orig=False))
    return found


def _filled(data: Any) -> Series:
    """Numbers, those that are masked as NaN."""
    numbers: Series = np.ma.filled(np.ma.asarray(data, dtype=float), np.nan)
    return numbers


def _tick_names(axis: Axis) -> dict[str, str]:
    """The names that stand at ticks instead of numbers, by their place in digits."""
    places, labels = axis.get_majorticklocs(), [in_line(one.get_text()) for one in axis.get_ticklabels()]
    words = any(any(map(str.isalpha, label)) and "mathdefault" not in label for label in labels)
    return dict(zip(map(_cell, places), labels, strict=False)) if words else {}


def _name(item: Any, otherwise: str) -> str:
    """The label of a thing, unless it is one that matplotlib gave."""
    label = str(item.get_label() or "_")
    return otherwise if label.startswith("_") else label


def _cell(number: float) -> str:
    """A number as text; NaN is empty."""
    return f"{number:.{DIGITS}g}" if number == number else ""
