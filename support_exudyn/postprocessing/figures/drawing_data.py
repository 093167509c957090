"""The data of a drawing as a table: what its lines, bars, marks, bands and maps show, in long form."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from string import ascii_lowercase
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import PathCollection, PolyCollection, QuadMesh
from matplotlib.container import BarContainer, Container, ErrorbarContainer
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.ticker import FixedLocator

from support_exudyn.files.whole_file import whole_file
from support_exudyn.mechanics.trajectory import Series

DIGITS = 7
COLUMNS = ("x", "y", "x_low", "x_high", "y_low", "y_high", "value")


@dataclass(frozen=True)
class DrawnData:
    """What one thing in a panel shows: its name, and columns of `COLUMNS`, each (n,).

    x_low, x_high, y_low, y_high: ends of error bars, bars and bands. value: of a cell of a map.
    """

    name: str
    columns: Mapping[str, Series]


def save_drawing_data(drawing: Figure, path: Path) -> bool:
    """Write the data of a drawing as CSV, in 7 digits; lines that begin with "#" have the labels of its axes.

    A row has the letter of its panel, the name of the curve, and its numbers; where ticks have names, these
    too. Curves are written as far as the panel shows them along x. Returns whether there were any: panels
    without axes, such as drawings of machines, have none.
    """
    panels = [(letter, axes, list(drawn_data(axes))) for letter, axes in _lettered(drawing)]
    panels = [panel for panel in panels if panel[2]]
    if not panels:
        return False
    used = [name for name in COLUMNS if any(name in one.columns for *_, found in panels for one in found)]
    names = {letter: (_tick_names(axes.xaxis), _tick_names(axes.yaxis)) for letter, axes, _ in panels}
    named = [name for n, name in enumerate(("x_name", "y_name")) if any(pair[n] for pair in names.values())]
    text = io.StringIO()
    for letter, axes, _ in panels:
        text.write(f"# panel {letter}: x = {_in_line(axes.get_xlabel())}; y = {_in_line(axes.get_ylabel())}\n")
    text.write(",".join(("panel", "curve", *used, *named)) + "\n")
    for letter, _, found in panels:
        for one in found:
            head = _quoted(letter, one.name)
            cells = [_cells(one.columns.get(name)) for name in used]
            for n, name in enumerate(("x_name", "y_name")):
                if name in named:
                    cells.append(_named(one.columns.get("xy"[n]), names[letter][n]))
            count = next(iter(one.columns.values())).size
            rows = zip(*(column or [""] * count for column in cells), strict=True)
            text.writelines(f"{head},{','.join(row)}\n" for row in rows)
    with whole_file(path) as temporary:
        temporary.write_text(text.getvalue(), encoding="utf-8")
    return True


def _lettered(drawing: Figure) -> list[tuple[str, Axes]]:
    """The panels that have axes, each with the letter that stands on it, else with its place's."""
    panels = [axes for axes in drawing.axes if axes.axison and axes.get_label() != "<colorbar>"]
    found = []
    for place, axes in enumerate(panels):
        written = [text.get_text() for text in axes.texts if text.get_fontweight() == "bold"]
        letters = [text for text in written if len(text) == 1 and text in ascii_lowercase]
        found.append((letters[0] if letters else ascii_lowercase[place % 26], axes))
    return found


def drawn_data(axes: Axes) -> Iterator[DrawnData]:
    """What a panel shows: error bars, bars, lines, marks, bands, maps."""
    bars = [one for one in axes.containers if isinstance(one, BarContainer) and len(one)]
    points = [one for one in axes.containers if isinstance(one, ErrorbarContainer)]
    of_bars = {id(one.errorbar) for one in bars}
    told = {id(part) for one in points for part in one.get_children()}
    yield from (_of_bars(one) for one in bars)
    yield from (_of_error_bars(one) for one in points if id(one) not in of_bars)
    yield from _of_lines(axes, [line for line in axes.get_lines() if id(line) not in told])
    for place, item in enumerate(axes.collections, 1):
        if isinstance(item, PathCollection):
            places = _filled(item.get_offsets())
            yield DrawnData(_name(item, f"marks {place}"), {"x": places[:, 0], "y": places[:, 1]})
        elif isinstance(item, QuadMesh):
            yield _of_mesh(item)
        elif isinstance(item, PolyCollection):
            for path in item.get_paths():
                corners = _filled(path.vertices)
                yield DrawnData(_name(item, f"area {place}"), {"x": corners[:, 0], "y": corners[:, 1]})
    yield from (_of_image(image) for image in axes.get_images() if np.ndim(_filled(image.get_array())) == 2)


def _filled(data: Any) -> Series:
    """Numbers, those that are masked as NaN."""
    numbers: Series = np.ma.filled(np.ma.asarray(data, dtype=float), np.nan)
    return numbers


def _of_lines(axes: Axes, lines: Sequence[Line2D]) -> Iterator[DrawnData]:
    """Lines in the data's coordinates, as far as they are seen along x."""
    low, high = sorted(axes.get_xlim())
    for number, line in enumerate((line for line in lines if line.get_transform() == axes.transData), 1):
        x, y = (_filled(data) for data in line.get_data(orig=False))
        seen = np.isfinite(x) & np.isfinite(y) & (x >= low) & (x <= high)
        if seen.any():
            yield DrawnData(_name(line, f"line {number}"), {"x": x[seen], "y": y[seen]})


def _of_error_bars(container: ErrorbarContainer) -> DrawnData:
    """The points, and the ends of their bars."""
    line, _, bars = container.lines
    found: dict[str, Series] = {}
    for bar, along in zip(bars, "x" * container.has_xerr + "y" * container.has_yerr, strict=False):
        ends = np.array(bar.get_segments())  # (n, 2, 2): ends of each, x and y
        values = ends[:, :, "xy".index(along)]
        found |= {f"{along}_low": values.min(axis=1), f"{along}_high": values.max(axis=1)}
        found |= {"x": ends[:, :, 0].mean(axis=1), "y": ends[:, :, 1].mean(axis=1)} if line is None else {}
    if line is not None:
        found["x"], found["y"] = (_filled(data) for data in line.get_data(orig=False))
    return DrawnData(_name(container, "points"), found)


def _of_bars(container: BarContainer) -> DrawnData:
    """Bars by the middle of their width and their end, and the ends of their error bars."""
    boxes = [
        (*box.get_xy(), box.get_width(), box.get_height()) for box in container if isinstance(box, Rectangle)
    ]
    x, y, wide, high = np.array(boxes).T
    level = container.orientation == "horizontal"
    along = "x" if level else "y"
    found = {"x": x + wide, "y": y + 0.5 * high} if level else {"x": x + 0.5 * wide, "y": y + high}
    if container.errorbar is not None:
        bars = _of_error_bars(container.errorbar).columns
        found |= {name: bars[name] for name in (f"{along}_low", f"{along}_high")}
    return DrawnData(_name(container, "bars"), found)


def _of_mesh(mesh: QuadMesh) -> DrawnData:
    """The middles of the cells of a map, and their values."""
    corners, values = _filled(mesh.get_coordinates()), _filled(mesh.get_array()).ravel()
    middle = 0.25 * (corners[:-1, :-1] + corners[1:, :-1] + corners[:-1, 1:] + corners[1:, 1:])
    places = (middle if middle[..., 0].size == values.size else corners).reshape(-1, 2)
    return DrawnData(_name(mesh, "map"), {"x": places[:, 0], "y": places[:, 1], "value": values})


def _of_image(image: AxesImage) -> DrawnData:
    """The middles of the pixels of an image, and their values."""
    values = _filled(image.get_array())
    left, right, bottom, top = image.get_extent()
    rows, columns = values.shape
    first, last = (top, bottom) if image.origin == "upper" else (bottom, top)
    x = left + (np.arange(columns) + 0.5) * (right - left) / columns
    y = first + (np.arange(rows) + 0.5) * (last - first) / rows
    cells = {"x": np.tile(x, rows), "y": np.repeat(y, columns), "value": values.ravel()}
    return DrawnData(_name(image, "map"), cells)


def _tick_names(axis: Axis) -> dict[str, str]:
    """The names that stand at ticks instead of numbers, by their place in digits."""
    if not isinstance(axis.get_major_locator(), FixedLocator):
        return {}
    places = [f"{place:.{DIGITS}g}" for place in axis.get_majorticklocs()]
    names = [_in_line(label.get_text()) for label in axis.get_ticklabels()]
    return {} if all(map(_is_number, names)) else dict(zip(places, names, strict=False))


def _is_number(text: str) -> bool:
    try:
        float(text.replace("\N{MINUS SIGN}", "-") or "0")
    except ValueError:
        return False
    return True


def _name(item: Artist | Container, otherwise: str) -> str:
    """The label of a thing, unless it is one that matplotlib gave."""
    text = _in_line(str(item.get_label() or ""))
    return otherwise if not text or text.startswith("_") else text


def _in_line(text: str) -> str:
    return " ".join(text.split())


def _cells(column: Series | None) -> list[str]:
    """Numbers of a column as text; what is none is empty."""
    if column is None:
        return []
    return [f"{value:.{DIGITS}g}" if value == value else "" for value in column.tolist()]


def _named(column: Series | None, names: Mapping[str, str]) -> list[str]:
    """The names of ticks at the numbers of a column."""
    return [_quoted(names.get(cell, "")) for cell in _cells(column)]


def _quoted(*cells: str) -> str:
    """Cells of CSV."""
    written = io.StringIO()
    csv.writer(written, lineterminator="").writerow(cells)
    return written.getvalue()
