"""The figure of a comparison, and the page: verdict, notes, tables, and the figure to look into."""

from __future__ import annotations

import math
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.comparing import tables
from support_exudyn.postprocessing.comparing.files_compared import ComparedPair, FilesCompared
from support_exudyn.postprocessing.figures import style, units
from support_exudyn.postprocessing.figures.channels import label_values
from support_exudyn.postprocessing.figures.units import readable, said
from support_exudyn.postprocessing.page.live import of_drawing
from support_exudyn.postprocessing.page.live_html import html
from support_exudyn.postprocessing.page.pieces import ShownFigure, ShownTable, image, templates
from user_forces.values.value import InputError

TEMPLATE = "compare.html.j2"
FIGURES, PAGES = (".png", ".pdf", ".svg"), (".html",)
OTHERS = tuple(look for look in style.CURVES if look[0] != style.IDEAL)  # the reference is black
MOST = 8  # channels
FEW = 60  # points of a curve that are drawn as markers
CURVES_MM, DIFFERENCE_MM, REST_MM, LINE_MM = 38.0, 30.0, 30.0, 4.5
ALLOWED, AFTER = "#009E73", "#f0f0f0"  # colours of what is allowed, and of what lies after the horizon
CAPTION = (
    "Curves as their files have them (few points: markers); below each, the difference from the reference up "
    "to the first horizon, shaded by its numerical error where that is known. Green: what is allowed. "
    "Grey: after the horizon, from which on curves are compared by their statistics only."
)


def check_ending(path: Path, endings: tuple[str, ...]) -> None:
    """Raise InputError for a file of a kind that is not written."""
    if path.suffix.lower() not in endings:
        raise InputError(f"{path}: allowed: a file that ends in {', '.join(endings)}")


def write_figure(compared: FilesCompared, path: Path) -> None:
    """Write the figure, whole or not at all, as its ending says. Raises InputError as `compare_figure` does."""
    check_ending(path, FIGURES)
    with style.look(), whole_file(path) as temporary:
        compare_figure(compared).savefig(temporary, format=path.suffix.lower()[1:])


def compare_figure(compared: FilesCompared, most: int | None = None) -> Figure:
    """The figure of a comparison: of each channel the curves, and below them the differences.

    most: number of channels that are drawn, of more the first; None: all.

    Raises InputError if files are too many, or of all channels more than `MOST`.
    """
    names = list(dict.fromkeys(name for pair in compared.pairs for name in pair.channels))
    if most is None and len(names) > MOST:
        raise InputError(
            f"{len(names)} channels: allowed in a figure: {MOST}; name fewer, such as {names[0]!r}"
        )
    if len(compared.pairs) > len(OTHERS):
        raise InputError(f"{len(compared.pairs) + 1} files: allowed in a figure: {len(OTHERS) + 1}")
    names = names[:most]
    times = [one.common.time for pair in compared.pairs for one in pair.channels.values()]
    ends = min(float(time[0]) for time in times), max(float(time[-1]) for time in times)
    horizon = min(pair.window.horizon for pair in compared.pairs)
    others = ", ".join(pair.other.name for pair in compared.pairs)
    with style.look():
        height = REST_MM + (CURVES_MM + DIFFERENCE_MM) * len(names) + LINE_MM * (1 + len(compared.pairs))
        drawing = style.begin(170, height, f"{others} compared with {compared.reference.name}")
        ratios = [CURVES_MM, DIFFERENCE_MM] * len(names)
        panels = drawing.subplots(2 * len(names), 1, sharex=True, squeeze=False, height_ratios=ratios)[:, 0]
        for n, name in enumerate(names):
            there = {OTHERS[k][0]: pair for k, pair in enumerate(compared.pairs) if name in pair.channels}
            _curves(panels[2 * n], name, there, ends)
            _differences(panels[2 * n + 1], name, there)
        if horizon < ends[1]:
            for axes in panels:
                axes.axvspan(horizon, ends[1], color=AFTER, lw=0.0, zorder=0)
        panels[0].legend(loc="lower left", bbox_to_anchor=(0.0, 1.2), fontsize=7, borderaxespad=0.0)
        drawing.align_ylabels(list(panels))
        panels[-1].set_xlabel("time [s]")
        if ends[1] > ends[0]:
            panels[-1].set_xlim(*ends)
        style.caption(drawing, CAPTION)
    return drawing


def _curves(axes: Axes, name: str, there: dict[str, ComparedPair], ends: tuple[float, float]) -> None:
    """The curves of a channel as their files have them, by the colours of the pairs."""
    first = next(iter(there.values()))
    unit, drawn = first.channels[name].unit, []
    for colour, file in ((style.IDEAL, first.reference), *((key, pair.other) for key, pair in there.items())):
        column = file.columns[name].in_unit(unit, name)
        chosen = (column.time >= ends[0]) & (column.time <= ends[1])
        drawn.append((file, colour, column.time[chosen], column.values[chosen]))
    shown = readable(unit, max(float(np.nanmax(np.abs(curve[3]), initial=0.0)) for curve in drawn))
    for file, colour, time, values in drawn:
        look: dict[str, Any] = {"ls": dict(OTHERS).get(colour, "-"), "lw": 1.0}
        if file.run is None and time.size <= FEW:  # points are seen as such
            look = {"ls": "", "marker": "o", "ms": 3.5, "mfc": "none", "mew": 1.0, "zorder": 3}
        axes.plot(time, shown.scale * values, color=colour, label=file.name, **look)
    label_values(axes, units.QUANTITIES.get(unit, "value"), shown.name)
    axes.set_title(name, fontsize=8)


def _differences(axes: Axes, name: str, there: dict[str, ComparedPair]) -> None:
    """The differences from the reference before the horizon, with numerical errors, inside what is allowed."""
    channels = [pair.channels[name] for pair in there.values()]
    sizes = [one.largest.value for one in channels if math.isfinite(one.largest.value)]
    shown, titles = readable(channels[0].unit, max(sizes, default=0.0)), []
    for (colour, pair), one in zip(there.items(), channels, strict=True):
        time, errors = one.common.time[: one.before], shown.scale * one.errors[: one.before]
        difference = shown.scale * one.common.difference[: one.before]
        axes.plot(
            time, difference, color=colour, lw=0.9, marker="." if time.size <= FEW else "", label="difference"
        )
        axes.fill_between(time, difference - errors, difference + errors, color=colour, alpha=0.25, lw=0.0)
        largest = "nothing lies before the horizon"
        if math.isfinite(one.measures.largest):
            largest = f"largest {said(one.measures.largest, one.unit)} at {one.measures.largest_time:.4g} s"
        verdict = f", {tables.verdict_words(one)}" if one.tolerance is not None else ""
        titles.append(f"{pair.other.name}: {largest}{verdict}")
    if math.isfinite(channels[0].allowed):
        bound = shown.scale * channels[0].allowed
        axes.axhspan(-bound, bound, color=ALLOWED, alpha=0.10, lw=0.0, zorder=0)
        for end in (-bound, bound):
            axes.axhline(end, color=ALLOWED, lw=0.8, ls="--", label="allowed")
    label_values(axes, "difference", shown.name)
    axes.set_title("; ".join(titles), fontsize=7)


def write_page(compared: FilesCompared, path: Path) -> None:
    """Write the page, HTML that needs nothing from elsewhere, whole or not at all.

    Its live figures have all channels, and the printed ones of more than `MOST` channels the first.
    """
    check_ending(path, PAGES)
    drawn = [FilesCompared(compared.reference, (pair,)) for pair in compared.pairs]
    figures = [compare_figure(one, len(one.pairs[0].channels)) for one in drawn]
    pages = html(
        {f"curves{n}": of_drawing(figure, range(len(figure.axes))) for n, figure in enumerate(figures)}
    )
    files = []
    with tempfile.TemporaryDirectory() as folder, style.look():
        for n, pair in enumerate(compared.pairs):
            printed = Path(folder) / f"{n}.png"
            compare_figure(drawn[n], MOST).savefig(printed)
            files.append({
                "name": pair.other.name,
                "anchor": f"file{n}",
                "faults": [text for one in pair.channels.values() for text in tables.faults(one)],
                "sentences": [line[:1].upper() + line[1:].rstrip(".") for line in tables.notes(pair)],
                "tables": [ShownTable(tables.table(pair))],
                "curves": ShownFigure(image(printed), CAPTION, Markup(pages.places[f"curves{n}"])),
            })  # fmt: skip
    names = ", ".join(pair.other.name for pair in compared.pairs)
    page = {
        "title": f"{names} compared with {compared.reference.name}",
        "verdict": tables.VERDICTS[compared.verdict],
        "files": files,
    }
    text = templates().get_template(TEMPLATE).render(page=page, scripts=Markup(pages.scripts))
    with whole_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
