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
from matplotlib.patches import Rectangle

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
    for letter, axes in _lettered(drawing):
        names = {"x": _tick_names(axes.xaxis), "y": _tick_names(axes.yaxis)}
        before = len(rows)
        for curve, columns in drawn_data(axes):
            for numbers in zip(*(column.tolist() for column in columns.values()), strict=True):
                cells = {name: _cell(number) for name, number in zip(columns, numbers, strict=True)}
                cells |= {f"{axis}_name": names[axis].get(cells.get(axis, ""), "") for axis in names}
                rows.append({"panel": letter, "curve": curve, **cells})
        if len(rows) > before:
            labels = in_line(axes.get_xlabel()), in_line(axes.get_ylabel())
            notes.append(f"# panel {letter}: x = {labels[0]}; y = {labels[1]}\n")
    if not rows:
        return False
    used = [name for name in COLUMNS if any(row.get(name) for row in rows)]
    with whole_file(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        file.writelines(notes)
        writer = csv.DictWriter(file, used, "", "ignore", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return True


def _lettered(drawing: Figure) -> list[tuple[str, Axes]]:
    """The panels that have axes, each with the letter that stands on it, else with its place's."""
    panels = [axes for axes in drawing.axes if axes.axison and axes.get_label() != "<colorbar>"]
    found = []
    for place, axes in enumerate(panels):
        bold = [text.get_text() for text in axes.texts if text.get_fontweight() == "bold"]
        letters = [text for text in bold if len(text) == 1 and text in ascii_lowercase]
        found.append((letters[0] if letters else ascii_lowercase[place % 26], axes))
    return found


def drawn_data(axes: Axes) -> Iterator[tuple[str, Columns]]:
    """What a panel shows, each with its name: bars, error bars, lines, marks, bands, maps; columns are (n,)."""
    bars = [one for one in axes.containers if isinstance(one, BarContainer) and len(one)]
    of_bars = {id(one.errorbar) for one in bars}
    points = [one for one in axes.containers if isinstance(one, ErrorbarContainer) and id(one) not in of_bars]
    inside = {id(part) for one in axes.containers for part in one.get_children()}
    yield from ((_name(one, "bars"), _of_bars(one)) for one in bars)
    yield from ((_name(one, "points"), _of_error_bars(one)) for one in points)
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
    for image in axes.get_images():
        if np.ndim(pixels := _filled(image.get_array())) == 2:  # the middles of its pixels
            left, right, *ends = image.get_extent()
            first, last = ends[::-1] if image.origin == "upper" else ends
            y, x = (np.indices(pixels.shape) + 0.5) / np.reshape(pixels.shape, (2, 1, 1))
            x, y = left + (right - left) * x.ravel(), first + (last - first) * y.ravel()
            yield _name(image, "map"), {"x": x, "y": y, "value": pixels.ravel()}


def _of_error_bars(container: ErrorbarContainer) -> Columns:
    """The points, and the ends of their bars."""
    line, _, bars = container.lines
    found: Columns = {}
    for bar, along in zip(bars, "x" * container.has_xerr + "y" * container.has_yerr, strict=False):
        ends = np.array(bar.get_segments())  # (n, 2, 2): ends of each, x and y
        values = ends[:, :, "xy".index(along)]
        found |= {f"{along}_low": values.min(axis=1), f"{along}_high": values.max(axis=1)}
        found |= {"x": ends[:, :, 0].mean(axis=1), "y": ends[:, :, 1].mean(axis=1)} if line is None else {}
    if line is not None:
        found["x"], found["y"] = (_filled(data) for data in line.get_data(orig=False))
    return found


def _of_bars(container: BarContainer) -> Columns:
    """Bars by the middle of their width and their end, and the ends of their error bars."""
    boxes = [
        (*box.get_xy(), box.get_width(), box.get_height()) for box in container if isinstance(box, Rectangle)
    ]
    x, y, wide, high = np.array(boxes).T
    level = container.orientation == "horizontal"
    found = {"x": x + wide, "y": y + 0.5 * high} if level else {"x": x + 0.5 * wide, "y": y + high}
    if container.errorbar is not None:
        along, ends = "x" if level else "y", _of_error_bars(container.errorbar)
        found |= {name: ends[name] for name in (f"{along}_low", f"{along}_high")}
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
    text = in_line(str(item.get_label() or ""))
    return otherwise if not text or text.startswith("_") else text


def _cell(number: float) -> str:
    """A number as text; NaN is empty."""
    return f"{number:.{DIGITS}g}" if number == number else ""
