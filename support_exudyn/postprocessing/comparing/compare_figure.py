"""The figure of a comparison: of each channel the curves, and below them the difference and what is allowed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.comparing.compared_channel import ComparedChannel
from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from support_exudyn.postprocessing.comparing.files_compared import ComparedPair, FilesCompared
from support_exudyn.postprocessing.comparing.tables import verdict_words
from support_exudyn.postprocessing.figures import style, units
from support_exudyn.postprocessing.figures.channels import label_values
from support_exudyn.postprocessing.figures.units import readable, said
from user_forces.values.value import InputError

FORMATS = (".png", ".pdf", ".svg")
OTHERS = tuple(look for look in style.CURVES if look[0] != style.IDEAL)  # the reference is black
MOST = 8  # channels
FEW = 60  # points of a curve that are drawn as markers
CURVES_MM, DIFFERENCE_MM, REST_MM, LINE_MM = 38.0, 30.0, 30.0, 4.5
ALLOWED, AFTER = "#009E73", "#f0f0f0"  # colours of what is allowed, and of what lies after the horizon
BY_STATISTICS = "compared by statistics"  # after the horizon
CAPTION = (
    "Curves as their files have them (few points of a file: markers); below each, the difference from the "
    "reference, shaded by its numerical error where that is known. Green: what is allowed. Grey: after the "
    "first horizon, from which on curves are compared by their statistics only."
)
Compared = Sequence[tuple[str, ComparedPair, ComparedChannel]]  # a channel of each file, with its colour


def check_format(path: Path) -> None:
    """Raise InputError for a figure's file of a kind that is not written."""
    if path.suffix.lower() not in FORMATS:
        raise InputError(f"{path}: allowed: a file that ends in {', '.join(FORMATS)}")


def write_figure(compared: FilesCompared, path: Path) -> None:
    """Write the figure, whole or not at all, as its ending says. Raises InputError as `compare_figure` does."""
    check_format(path)
    with style.look(), whole_file(path) as temporary:
        compare_figure(compared).savefig(temporary, format=path.suffix.lower()[1:])


def compare_figure(compared: FilesCompared, most: int | None = None) -> Figure:
    """The figure of a comparison.

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
            there = [
                (OTHERS[k][0], pair, pair.channels[name])
                for k, pair in enumerate(compared.pairs)
                if name in pair.channels
            ]
            _curves(panels[2 * n], compared.reference, there, ends)
            _differences(panels[2 * n + 1], there)
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


def _curves(axes: Axes, reference: ComparedFile, there: Compared, ends: tuple[float, float]) -> None:
    """The curves of a channel as their files have them."""
    one = there[0][2]
    drawn = []
    for file, colour in ((reference, style.IDEAL), *((pair.other, colour) for colour, pair, _ in there)):
        column = file.column(one.name, one.unit)
        chosen = (column.time >= ends[0]) & (column.time <= ends[1])
        drawn.append((file, colour, column.time[chosen], column.values[chosen]))
    shown = readable(one.unit, max(float(np.nanmax(np.abs(curve[3]), initial=0.0)) for curve in drawn))
    for file, colour, time, values in drawn:
        look: dict[str, Any] = {"ls": dict(OTHERS).get(colour, "-"), "lw": 1.3 if file is reference else 1.0}
        if file.run is None and time.size <= FEW:  # points are seen as such
            look = {"ls": "", "marker": "o", "ms": 3.5, "mfc": "none", "mew": 1.0, "zorder": 3}
        axes.plot(time, shown.scale * values, color=colour, label=file.name, **look)
    label_values(axes, units.QUANTITIES.get(one.unit, "value"), shown.name)
    axes.set_title(one.name, fontsize=8)


def _differences(axes: Axes, there: Compared) -> None:
    """The differences from the reference before the horizon, with numerical errors, inside what is allowed."""
    allowed, unit, titles = there[0][2].allowed, there[0][2].unit, []
    sizes = [one.largest.value for _, _, one in there if math.isfinite(one.largest.value)]
    shown = readable(unit, max(sizes, default=0.0))
    for colour, pair, one in there:
        before = slice(0, one.before)
        time, errors = one.common.time[before], shown.scale * one.errors[before]
        difference = shown.scale * (one.common.other - one.common.reference)[before]
        axes.plot(
            time, difference, color=colour, lw=0.9, marker="." if time.size <= FEW else "", label="difference"
        )
        axes.fill_between(time, difference - errors, difference + errors, color=colour, alpha=0.25, lw=0.0)
        name = f"{pair.other.name}: " if len(there) > 1 else "less reference: "
        if math.isnan(one.measures.largest):
            titles.append(f"{name}nothing lies before the horizon")
            continue
        verdict = f", {verdict_words(one)}" if one.tolerance is not None else ""
        at = f"at {one.measures.largest_time:.4g} s"
        titles.append(f"{name}largest {said(one.measures.largest, one.unit)} {at}{verdict}")
    if any(one.before < one.common.time.size for _, _, one in there):
        axes.text(0.99, 0.5, BY_STATISTICS, transform=axes.transAxes, ha="right", va="center", fontsize=7)
    if math.isfinite(allowed):
        bound = shown.scale * allowed
        axes.axhspan(-bound, bound, color=ALLOWED, alpha=0.10, lw=0.0, zorder=0)
        for end in (-bound, bound):
            axes.axhline(end, color=ALLOWED, lw=0.8, ls="--", label="allowed")
    label_values(axes, "difference", shown.name)
    axes.set_title("; ".join(titles), fontsize=7)
