"""Figures of time series to look into in a browser: values under the pointer, zoom, curves off and on.

A figure is kept as JSON next to its picture. A page holds bokeh's script once and all its figures as data, so
that it loads nothing.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from pydantic import TypeAdapter, ValidationError

from support_exudyn.files.whole_file import contents, whole_file
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.figures.selection import in_line
from user_forces.values.value import InputError

if TYPE_CHECKING:
    from bokeh.models import LayoutDOM

LARGEST_FILE = 50_000_000  # bytes
MOST_POINTS = 1500  # of a curve
DIGITS = 7
PANEL_PX, LOWER_PX, ROW_PX = 215, 180, 24  # heights of a panel alone, of one of several, of a row of names
PHONE_PX, LETTER_PX, GLYPH_PX = 330, 5.7, 30  # by which names are put in columns
LONG = 28  # letters of a y axis's label, above which its unit stands in a line of its own
THICKER = 1.3  # pixels to a point
# in dark mode light becomes dark, and colours stay, made brighter: orange would be brown
FILTER = "invert(0.92) hue-rotate(180deg) brightness(1.4)"
CSS = f"@media screen and (prefers-color-scheme: dark) {{ .live {{ filter: {FILTER}; }} }}"
Dash = Literal["solid", "dashed", "dotted", "dotdash", "points"]
DASHES: dict[str, Dash] = {
    "-": "solid", "--": "dashed", ":": "dotted", "-.": "dotdash", "None": "points", "": "points",
}  # fmt: skip


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
    made = []
    for number in panels:
        axes = drawing.axes[number]
        lines = [line for line in axes.get_lines() if line.get_transform() == axes.transData]
        lines = [
            line for line in lines if str(line.get_label())[:1] not in ("", "_") and np.size(line.get_xdata())
        ]
        curves = tuple(_curve(line) for line in sorted(lines, key=lambda line: float(line.get_zorder())))
        label = panels[number] if isinstance(panels, Mapping) else axes.get_ylabel()
        made.append(LivePanel(in_line(label), curves))
    labels = [axes.get_xlabel() for axes in (*(drawing.axes[number] for number in panels), *drawing.axes)]
    return LiveFigure(in_line(next(filter(None, labels), "")), tuple(made))


def _curve(line: Line2D) -> LiveCurve:
    """A line as a curve, in 7 digits."""
    data: list[Any] = [np.ma.asarray(one, float).filled(np.nan) for one in line.get_data(orig=False)]
    x, y = (one[np.isfinite(data[0])] for one in data)
    kept = thinned(y, MOST_POINTS)
    places, values = ([float(f"{one:.{DIGITS}g}") for one in of[kept].tolist()] for of in (x, y))
    broken = tuple(value if math.isfinite(value) else None for value in values)
    dash = DASHES.get(str(line.get_linestyle()), "solid")
    width = round(float(line.get_linewidth()), 2)
    return LiveCurve(
        in_line(str(line.get_label())), tuple(places), broken, to_hex(line.get_color()), dash, width
    )


def thinned(y: Series, most: int) -> npt.NDArray[np.intp]:
    """The indexes of points of a curve (n,) that are kept, so that about `most` are left.

    Both ends stay, of every piece of equally many points the lowest and the highest one, and the first that is
    not finite, at which the curve is broken.
    """
    if y.size <= most:
        return np.arange(y.size, dtype=np.intp)
    kept = {0, y.size - 1}
    for piece in np.array_split(np.arange(y.size), max(1, most // 3)):
        finite = piece[np.isfinite(y[piece])]
        if finite.size < piece.size:
            kept.add(int(piece[np.isfinite(y[piece]).argmin()]))
        if finite.size:
            kept |= {int(finite[y[finite].argmin()]), int(finite[y[finite].argmax()])}
    return np.array(sorted(kept), dtype=np.intp)


# --- for a page ---


@dataclass(frozen=True)
class LiveHtml:
    """Pieces of a page.

    scripts: the library and all figures, for the end of the body. places: elements where figures are to stand,
    by their names; each inside one of class "live", for the dark mode. Nothing is loaded, and no script is made
    of text: a content policy allows these scripts, styles "unsafe-inline", and nothing else.
    """

    scripts: str
    places: Mapping[str, str]


def html(figures: Mapping[str, LiveFigure]) -> LiveHtml:
    """Figures for a page: hover for values, zoom in a box, curves off and on by a click on the legend.

    Panels of a figure share their time axis. Without figures there is no script.
    """
    if not figures:
        return LiveHtml("", {})
    from bokeh.resources import Resources  # it takes half a second, which pages alone spend

    made = {name: _components(name, figure) for name, figure in figures.items()}
    library = Resources(mode="inline", components=["bokeh"], minified=True).render_js()
    scripts = "\n".join(script for script, _ in made.values())
    places = {name: place for name, (_, place) in made.items()}
    return LiveHtml(f"<style>{CSS}</style>\n{library}\n{scripts}\n", places)


@lru_cache(maxsize=64)  # a report is written anew after each study, and most of its figures are those before
def _components(name: str, figure: LiveFigure) -> tuple[str, str]:
    """The script of a figure, and the element where it is to stand, of its own name."""
    del name
    from bokeh.embed import components

    script, place = components(_laid_out(figure))
    return script.strip(), place.strip()


def _laid_out(figure: LiveFigure) -> LayoutDOM:
    """A figure of bokeh: panels one below the other with one time axis.

    The name of a curve stands above the first panel that has it, and hides it in all.
    """
    from bokeh.layouts import gridplot
    from bokeh.models import (
        BoxZoomTool,
        ColumnDataSource,
        HoverTool,
        PanTool,
        Range1d,
        ResetTool,
        WheelZoomTool,
    )
    from bokeh.models.annotations.legends import Legend, LegendItem
    from bokeh.plotting import figure as bokeh_figure

    places = [place for panel in figure.panels for one in panel.curves for place in (min(one.x), max(one.x))]
    shared = Range1d(start=min(places), end=max(places))
    x_name, _, x_unit = figure.x_label.rstrip("]").partition(" [")
    plots: list[Any] = []
    items: dict[str, tuple[int, list[Any]]] = {}  # by the name of a curve: its first panel, and its lines
    for number, panel in enumerate(figure.panels):
        zoom = BoxZoomTool()
        plot = bokeh_figure(
            height=LOWER_PX if len(figure.panels) > 1 else PANEL_PX, x_range=shared,
            sizing_mode="stretch_width", x_axis_label=figure.x_label if panel is figure.panels[-1] else None,
            y_axis_label=panel.label.replace(" [", "\n[") if len(panel.label) > LONG else panel.label,
            tools=[zoom, PanTool(), WheelZoomTool(), ResetTool()], active_drag=zoom, active_scroll=None,
            background_fill_alpha=0.0, border_fill_alpha=0.0, outline_line_color=None,
        )  # fmt: skip
        for one in panel.curves:
            # in single precision, which has their digits
            data = {"x": np.array(one.x, dtype=np.float32), "y": np.array(one.y, dtype=np.float32)}
            look: dict[str, Any] = {"source": ColumnDataSource(data), "color": one.colour, "name": one.label}
            if one.dash == "points":
                line: Any = plot.scatter("x", "y", size=6, marker="x", line_width=1.5, **look)
            else:
                line = plot.line("x", "y", line_dash=one.dash, line_width=THICKER * one.width, **look)
            items.setdefault(one.label, (number, []))[1].append(line)
        unit = panel.label.rstrip("]").partition(" [")[2]
        tips = [(x_name, f"@x{{%.{DIGITS}g}} {x_unit}"), ("$name", f"@y{{%.{DIGITS}g}} {unit}")]
        formats: dict[str, Any] = {"@x": "printf", "@y": "printf"}
        plot.add_tools(HoverTool(mode="vline", tooltips=tips, formatters=formats, visible=False))
        plots.append(plot)
    for number, plot in enumerate(plots):
        own = {label: lines for label, (first, lines) in items.items() if first == number}
        if not own:
            continue
        columns = max(1, int(PHONE_PX / (LETTER_PX * max(map(len, own)) + GLYPH_PX)))
        named = [LegendItem(label=label, renderers=lines) for label, lines in own.items()]
        legend = Legend(
            items=named, orientation="horizontal", ncols=columns, click_policy="hide", border_line_width=0,
            background_fill_alpha=0.0, label_text_font_size="12px", margin=0, spacing=6, location="left",
        )  # fmt: skip
        plot.add_layout(legend, "above")
        plot.height += ROW_PX * -(-len(own) // columns)
    return gridplot([[plot] for plot in plots], sizing_mode="stretch_width", toolbar_options={"logo": None})
