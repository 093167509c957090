"""A page with a slider for every input of a sweep; it shows the run nearest to them, without a network.

The page is one file with bokeh's script in it. Nothing is computed between runs: what it shows was run.
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.sweep_runs import SweepRuns, in_words
from user_forces.values.value import InputError

if TYPE_CHECKING:
    from bokeh.document import Document
    from bokeh.models.widgets import Widget

STEPS = 200  # of a slider
NEAREST = """
const inputs = all.data, count = inputs["run"].length
let nearest = 0, least = Infinity
for (let n = 0; n < count; n++) {
  let away = 0
  for (const [name, widget] of Object.entries(widgets)) {
    const own = inputs[name][n]
    away += spans[name] === null ? (own === widget.value ? 0 : 1) : ((own - widget.value) / spans[name]) ** 2
  }
  if (away < least) { least = away; nearest = n }
}
const text = (value) => typeof value !== "number" ? value : Number.isNaN(value) ? "" : value.toPrecision(5)
const row = (title, column) => {
  const errors = all.data["error of " + column]
  const off = errors === undefined ? NaN : errors[nearest]
  const error = Number.isNaN(off) ? "" : " &plusmn; " + off.toPrecision(1)
  return "<tr><td>" + title + "</td><td>" + text(inputs[column][nearest]) + error + "</td></tr>"
}
shown.text = "<table><tr><th>nearest run</th><th>" + inputs["run"][nearest] + "</th></tr>"
  + titles.map(([column, title]) => row(title, column)).join("") + "</table>"
drawn.data = { x: inputs[across.value], y: inputs[up.value] }
here.data = { x: [inputs[across.value][nearest]], y: [inputs[up.value][nearest]] }
x_axis.axis_label = across.value
y_axis.axis_label = up.value
"""


def write_sliders(runs: SweepRuns, columns: Sequence[str], path: Path, title: str) -> Path:
    """Write the page of a sweep and return its path.

    Arguments:
        runs: of the sweep; those that are done are shown.
        columns: of the numbers that are shown.
        title: of the page.

    Raises InputError if no run is done, or if nothing varied; OSError if the page cannot be written.
    """
    from bokeh.embed import file_html  # it takes half a second
    from bokeh.resources import Resources

    document = _document(runs, columns, title)
    with whole_file(path) as temporary:
        temporary.write_text(file_html(document, Resources(mode="inline"), title=title), encoding="utf-8")
    return path


def _data(runs: SweepRuns, columns: Sequence[str]) -> tuple[dict[str, Any], list[str], list[str]]:
    """Columns of all runs that are done by their titles, and the titles of inputs and of numbers."""
    done = np.flatnonzero(np.array(runs.column("status")) == "done")
    inputs = {in_words(name): [runs.column(name)[n] for n in done] for name in runs.varied}
    inputs = {name: values for name, values in inputs.items() if len(set(values)) > 1}
    if not done.size or not inputs:
        raise InputError(
            "--sliders: allowed: a sweep with two runs or more that are done and differ in an input"
        )
    found: dict[str, Any] = {"run": [runs.column("run")[n] for n in done], **inputs}
    numbers = []
    for one in map(runs.number, columns):
        numbers.append(one.title)
        found[one.title] = one.values[done] * one.display.scale
        if one.errors is not None:
            found[f"error of {one.title}"] = one.errors[done] * one.display.scale
    return found, list(inputs), numbers


def _widget(name: str, values: Sequence[Any]) -> tuple[Widget, float | None]:
    """What sets an input, and by how much it may move; None for what is no number."""
    from bokeh.models.widgets import Select, Slider

    if not all(isinstance(one, (int, float)) and not isinstance(one, bool) for one in values):
        words: list[Any] = list(dict.fromkeys(map(str, values)))
        return Select(title=name, options=words, value=words[0]), None
    low, high = float(min(values)), float(max(values))
    middle = float(np.median(values))
    return Slider(
        title=name, start=low, end=high, step=(high - low) / STEPS, value=middle, format="0[.]0000"
    ), high - low


def _document(runs: SweepRuns, columns: Sequence[str], title: str) -> Document:
    from bokeh.document import Document
    from bokeh.events import DocumentReady
    from bokeh.layouts import column, row
    from bokeh.models import ColumnDataSource, CustomJS
    from bokeh.models.widgets import Div, Select
    from bokeh.plotting import figure

    data, inputs, numbers = _data(runs, columns)
    widgets, spans = {}, {}
    for name in inputs:
        widgets[name], spans[name] = _widget(name, data[name])
        if spans[name] is None:
            data[name] = [str(one) for one in data[name]]
    across_names: list[Any] = [name for name in inputs if spans[name] is not None] or numbers
    across = Select(title="horizontal axis", options=[*across_names, *numbers], value=across_names[0])
    up = Select(title="vertical axis", options=list[Any](numbers), value=numbers[0])
    plot = figure(height=420, width=640, tools="pan,wheel_zoom,box_zoom,reset,save")
    drawn, here, shown = (
        ColumnDataSource({"x": [], "y": []}),
        ColumnDataSource({"x": [], "y": []}),
        Div(text="", name="nearest"),
    )
    plot.scatter("x", "y", source=drawn, size=4, alpha=0.5)
    plot.scatter("x", "y", source=here, size=12, color="firebrick")
    names = {
        "all": ColumnDataSource(data),
        "widgets": widgets,
        "spans": spans,
        "titles": [(name, escape(name)) for name in (*inputs, *numbers)],
        "drawn": drawn,
        "here": here,
        "shown": shown,
        "across": across,
        "up": up,
        "x_axis": plot.xaxis[0],
        "y_axis": plot.yaxis[0],
    }
    changed = CustomJS(args=names, code=NEAREST)
    for widget in (*widgets.values(), across, up):
        widget.js_on_change("value", changed)
    document = Document()
    count = len(data["run"])
    head = Div(text=f"<b>{escape(title)}</b>: {count} runs; the sliders choose the nearest run, marked red.")
    document.add_root(column(head, row(column(*widgets.values(), shown), column(row(across, up), plot))))
    document.js_on_event(DocumentReady, changed)
    return document
