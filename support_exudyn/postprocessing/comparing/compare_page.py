"""The figure of a comparison, and the page: verdict, notes, tables, and the figure."""

from __future__ import annotations

import math
import tempfile
from pathlib import Path

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.comparing import tables
from support_exudyn.postprocessing.comparing.files_compared import ComparedPair, FilesCompared
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.channels import Curve, draw_panels, label_values
from support_exudyn.postprocessing.figures.units import amount, readable
from support_exudyn.postprocessing.page.live import html, of_drawing
from support_exudyn.postprocessing.page.pieces import ShownFigure, ShownTable, image, templates
from user_forces.values.value import InputError

TEMPLATE = "compare.html.j2"
REFERENCE: tuple[str, style.Dashes] = (style.IDEAL, "-")
OTHERS = tuple(look for look in style.CURVES if look[0] != style.IDEAL)
MOST = 8  # channels
FEW = 60  # points of a curve that are drawn as markers
PANEL_MM, REST_MM, LINE_MM = 34.0, 30.0, 4.5
ALLOWED, AFTER = "#009E73", "#f0f0f0"  # colours of what is allowed, and of what lies after the horizon
CAPTION = (
    "Curves as their files have them (few points: markers); below each, the difference from the reference up "
    "to the first horizon, shaded by its numerical error where that is known. Green: what is allowed. "
    "Grey: after the horizon, from which on curves are compared by their statistics only."
)


def write_figure(compared: FilesCompared, path: Path) -> None:
    """Write the figure, as its ending says, else as PNG. Raises InputError if channels are more than `MOST`."""
    names = list(dict.fromkeys(channel.name for channel in compared.channels))
    if len(names) > MOST:
        raise InputError(
            f"{len(names)} channels: allowed in a figure: {MOST}; name fewer, such as {names[0]!r}"
        )
    with style.look(), whole_file(path) as temporary:
        kind = {".pdf": "pdf", ".svg": "svg"}.get(path.suffix.lower(), "png")
        compare_figure(compared).savefig(temporary, format=kind)


def compare_figure(compared: FilesCompared, most: int = MOST) -> Figure:
    """The figure of a comparison: of each of the first channels the curves, and below them the differences.

    Raises InputError if files are too many.
    """
    pairs = compared.pairs
    if len(pairs) > len(OTHERS):
        raise InputError(f"{len(pairs) + 1} files: allowed in a figure: {len(OTHERS) + 1}")
    names = list(dict.fromkeys(channel.name for channel in compared.channels))[:most]
    panels = [panel for name in names for panel in _panels(compared, name)]
    horizon = min(pair.horizon for pair in pairs)
    with style.look():
        height = REST_MM + PANEL_MM * len(panels) + LINE_MM * (1 + len(pairs))
        drawing = style.begin(170, height, _title(compared))
        rows, seconds = draw_panels(drawing, panels)
        for n, name in enumerate(names):
            rows[2 * n].set_title(name, fontsize=8)
            _mark(rows[2 * n + 1], [pair for pair in pairs if name in pair.channels], name)
        end = rows[0].get_xlim()[1]
        if seconds.scale * horizon < end:
            for axes in rows:
                axes.axvspan(seconds.scale * horizon, end, color=AFTER, lw=0.0, zorder=0)
        rows[0].legend(loc="lower left", bbox_to_anchor=(0.0, 1.2), fontsize=7, borderaxespad=0.0)
        style.caption(drawing, CAPTION)
    return drawing


def _title(compared: FilesCompared) -> str:
    return f"{', '.join(pair.other.name for pair in compared.pairs)} compared with {compared.reference.name}"


def _panels(compared: FilesCompared, name: str) -> list[tuple[str, list[Curve]]]:
    """Unit and curves of the two panels of a channel: those of the files, and the differences."""
    there = [(pair, look) for pair, look in zip(compared.pairs, OTHERS, strict=False) if name in pair.channels]
    channels = [pair.channels[name] for pair, _ in there]
    unit, times = channels[0].unit, np.concatenate([channel.common.time for channel in channels])
    curves, differences = [], []
    for file, look in [(compared.reference, REFERENCE), *((pair.other, look) for pair, look in there)]:
        column = file.columns[name].in_unit(unit, name)
        shown = (column.time >= times.min()) & (column.time <= times.max())
        few = file.run is None and np.count_nonzero(shown) <= FEW
        line = column.time[shown], column.values[shown]
        curves.append(Curve(file.name, *line, None, look[0], "" if few else look[1]))
    for channel, (_, look) in zip(channels, there, strict=True):
        before = slice(channel.before)
        line = channel.common.time[before], channel.common.difference[before]
        differences.append(Curve("difference", *line, channel.errors[before], *look))
    return [(unit, curves), (unit, differences)]


def _mark(axes: Axes, pairs: list[ComparedPair], name: str) -> None:
    """Mark what is allowed in a panel of differences; its title states the largest one and the verdict."""
    titles, sizes, first = [], [0.0], pairs[0].channels[name]
    for pair in pairs:
        channel, largest = pair.channels[name], "nothing lies before the horizon"
        if math.isfinite(channel.measures.largest):
            sizes.append(channel.largest.value)
            at = f"{channel.measures.largest_time:.4g} s"
            largest = f"largest {amount(channel.measures.largest, channel.unit)} at {at}"
        verdict = f", {channel.verdict} ({channel.tolerance.text})" if channel.tolerance is not None else ""
        titles.append(f"{pair.other.name}: {largest}{verdict}")
    axes.set_title("; ".join(titles), fontsize=7)
    shown = readable(first.unit, max(sizes))
    label_values(axes, "difference", shown.name)
    if math.isfinite(first.allowed):
        bound = shown.scale * first.allowed
        axes.axhspan(-bound, bound, color=ALLOWED, alpha=0.10, lw=0.0, zorder=0)
        for end in (-bound, bound):
            axes.axhline(end, color=ALLOWED, lw=0.8, ls="--", label="allowed")


def write_page(compared: FilesCompared, path: Path) -> None:
    """Write the page, HTML that needs nothing from elsewhere, whole or not at all.

    Its live figures have all channels, and the printed ones of more than `MOST` channels the first.
    """
    drawn = [FilesCompared(compared.reference, (pair,)) for pair in compared.pairs]
    figures = [compare_figure(each, len(each.channels)) for each in drawn]
    live = html({f"curves{n}": of_drawing(each, range(len(each.axes))) for n, each in enumerate(figures)})
    files = []
    with tempfile.TemporaryDirectory() as folder, style.look():
        for n, pair in enumerate(compared.pairs):
            printed = Path(folder) / f"{n}.png"
            compare_figure(drawn[n]).savefig(printed)
            files.append({
                "name": pair.other.name,
                "anchor": f"file{n}",
                "faults": pair.faults,
                "sentences": [line[:1].upper() + line[1:].rstrip(".") for line in tables.notes(pair)],
                "tables": [ShownTable(tables.table(pair))],
                "curves": ShownFigure(image(printed), CAPTION, Markup(live.places[f"curves{n}"])),
            })  # fmt: skip
    page = {"title": _title(compared), "verdict": tables.conclusion(compared), "files": files}
    text = templates().get_template(TEMPLATE).render(page=page, scripts=Markup(live.scripts))
    with whole_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
