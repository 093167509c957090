"""Live figures for a page: bokeh's script once, and all figures as data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from support_exudyn.postprocessing.page.live import DIGITS, LiveCurve, LiveFigure, LivePanel

if TYPE_CHECKING:
    from bokeh.models import LayoutDOM, Range1d
    from bokeh.models.renderers import GlyphRenderer
    from bokeh.plotting import figure as Plot  # noqa: N812

PANEL_PX, LOWER_PX, ROW_PX = 215, 180, 24  # heights of a panel alone, of one of several, of a row of names
PHONE_PX, LETTER_PX, GLYPH_PX = 330, 5.7, 30  # by which names are put in columns
LONG = 28  # letters of a y axis's label, above which its unit stands in a line of its own
THICKER = 1.3  # pixels to a point
KEPT = 64  # figures, for the next page
# in dark mode light becomes dark, and colours stay, made brighter: orange would be brown
FILTER = "invert(0.92) hue-rotate(180deg) brightness(1.4)"
CSS = f"@media screen and (prefers-color-scheme: dark) {{ .live {{ filter: {FILTER}; }} }}"


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
    return LiveHtml(
        f"<style>{CSS}</style>\n{library}\n{scripts}\n", {name: at for name, (_, at) in made.items()}
    )


@lru_cache(maxsize=KEPT)  # a report is written anew after each study, and most of its figures are those before
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
    from bokeh.models import Range1d

    places = [place for panel in figure.panels for one in panel.curves for place in (min(one.x), max(one.x))]
    shared = Range1d(start=min(places), end=max(places))
    plots: list[Plot] = []
    drawn: dict[str, list[GlyphRenderer[Any]]] = {}
    first: dict[str, int] = {}
    for number, panel in enumerate(figure.panels):
        height = LOWER_PX if len(figure.panels) > 1 else PANEL_PX
        plot = _plot(shared, height, panel.label, figure.x_label if number == len(figure.panels) - 1 else None)
        _draw(plot, panel, figure.x_label, drawn)
        plots.append(plot)
        for one in panel.curves:
            first.setdefault(one.label, number)
    for number, plot in enumerate(plots):
        _add_legend(plot, {label: drawn[label] for label, place in first.items() if place == number})
    return gridplot([[plot] for plot in plots], sizing_mode="stretch_width", toolbar_options={"logo": None})


def _plot(shared: Range1d, height: int, label: str, x_label: str | None) -> Plot:
    """An empty panel with its tools."""
    from bokeh.models import BoxZoomTool, PanTool, ResetTool, WheelZoomTool
    from bokeh.plotting import figure as bokeh_figure

    zoom = BoxZoomTool()
    return bokeh_figure(
        height=height, x_range=shared, sizing_mode="stretch_width", x_axis_label=x_label,
        y_axis_label=label.replace(" [", "\n[") if len(label) > LONG else label,
        tools=[zoom, PanTool(), WheelZoomTool(), ResetTool()], active_drag=zoom, active_scroll=None,
        background_fill_alpha=0.0, border_fill_alpha=0.0, outline_line_color=None,
    )  # fmt: skip


def _draw(plot: Plot, panel: LivePanel, x_label: str, drawn: dict[str, list[GlyphRenderer[Any]]]) -> None:
    """Draw the curves of a panel, and add them to those that are known by their name.

    Under the pointer all values of curves with the same x are shown at once, hidden ones too. Data are in
    single precision, which has their digits.
    """
    from bokeh.models import ColumnDataSource, HoverTool

    groups: dict[tuple[float, ...], list[LiveCurve]] = {}
    for one in panel.curves:
        groups.setdefault(one.x, []).append(one)
    sources = {}
    for x, group in groups.items():
        columns = {f"y{n}": np.array(one.y, dtype=np.float32) for n, one in enumerate(group)}
        sources[x] = source = ColumnDataSource(data={"x": np.array(x, dtype=np.float32), **columns})
        target = plot.line("x", "y0", source=source, line_alpha=0.0)
        lines = [_line("x", x_label.partition("[")[0], x_label)]
        lines += [_line(f"y{n}", one.label, panel.label) for n, one in enumerate(group)]
        formatters: dict[str, Any] = {f"@{name}": "printf" for name in ("x", *columns)}
        hover = HoverTool(
            renderers=[target], mode="vline", point_policy="follow_mouse", tooltips=lines,
            formatters=formatters, visible=False,
        )  # fmt: skip
        plot.add_tools(hover)
    for one in panel.curves:
        source, column, colour, name = sources[one.x], f"y{groups[one.x].index(one)}", one.colour, one.label
        look: dict[str, Any] = {"source": source, "color": colour, "name": name}
        renderer: GlyphRenderer[Any]
        if one.dash == "points":
            renderer = plot.scatter("x", column, size=6, marker="x", line_width=1.5, **look)
        else:
            renderer = plot.line("x", column, line_dash=one.dash, line_width=THICKER * one.width, **look)
        drawn.setdefault(one.label, []).append(renderer)


def _line(column: str, name: str, label: str) -> tuple[str, str]:
    """A line of what is shown under the pointer: a name, and the value of a column with the unit of a label."""
    unit = label.partition("[")[2].rstrip("]")
    return name.strip(), f"@{column}{{%.{DIGITS}g}} {unit}".strip()


def _add_legend(plot: Plot, drawn: Mapping[str, Sequence[GlyphRenderer[Any]]]) -> None:
    """Write the names of curves above a panel, in as many columns as a phone has room for."""
    from bokeh.models.annotations.legends import Legend, LegendItem

    if not drawn:
        return
    items = [LegendItem(label=label, renderers=list(renderers)) for label, renderers in drawn.items()]
    columns = max(1, int(PHONE_PX / (LETTER_PX * max(map(len, drawn)) + GLYPH_PX)))
    legend = Legend(
        items=items, orientation="horizontal", ncols=columns, click_policy="hide", border_line_width=0,
        background_fill_alpha=0.0, label_text_font_size="12px", margin=0, spacing=6, location="left",
    )  # fmt: skip
    plot.add_layout(legend, "above")
    plot.height = (plot.height or PANEL_PX) + ROW_PX * -(-len(items) // columns)
