"""The figure of a comparison: of each channel the curves, and below them what differs and what is allowed."""

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
from support_exudyn.postprocessing.comparing.told import verdict_words
from support_exudyn.postprocessing.figures import style, units
from support_exudyn.postprocessing.figures.channels import label_values
from support_exudyn.postprocessing.figures.units import DisplayUnit, readable, said
from user_forces.values.value import InputError

FORMATS = (".png", ".pdf", ".svg")
OTHERS = tuple(one for one in style.CURVES if one[0] != style.IDEAL)  # the reference is black
MOST = 8  # channels
FEW = 60  # points of a curve that are drawn as markers
CURVES_MM, DIFFERENCE_MM, REST_MM, LINE_MM = 38.0, 30.0, 30.0, 4.5
ALLOWED, AFTER = "#009E73", "#f0f0f0"  # colours of what is allowed, and of what lies after the parting
BEYOND = 8.0  # times the largest difference at which what is allowed lies beyond a panel
SPARE = 1.15
BY_STATISTICS = "compared by statistics"  # after the parting


def check_format(path: Path) -> None:
    """Raise InputError for a figure's file of a kind that is not written."""
    if path.suffix.lower() not in FORMATS:
        raise InputError(f"{path}: allowed: a file that ends in {', '.join(FORMATS)}")


def write_figure(found: FilesCompared, path: Path) -> None:
    """Write the figure, whole or not at all, as its ending says. Raises InputError as `compare_figure` does."""
    check_format(path)
    with style.look(), whole_file(path) as temporary:
        compare_figure(found).savefig(temporary, format=path.suffix.lower()[1:])


def compare_figure(found: FilesCompared) -> Figure:
    """The figure of a comparison. Raises InputError if files or channels are too many for one."""
    names = list(dict.fromkeys(name for pair in found.pairs for name in pair.channels))
    if len(names) > MOST:
        raise InputError(
            f"{len(names)} channels: allowed in a figure: {MOST}; name fewer, such as {names[0]!r}"
        )
    if len(found.pairs) > len(OTHERS):
        raise InputError(f"{len(found.pairs) + 1} files: allowed in a figure: {len(OTHERS) + 1}")
    with style.look():
        return _figure(found, names)


def _figure(found: FilesCompared, names: Sequence[str]) -> Figure:
    lines = 1 + len(found.pairs)
    height = REST_MM + (CURVES_MM + DIFFERENCE_MM) * len(names) + LINE_MM * lines
    drawing = style.begin(170, height, _title(found))
    panels = drawing.subplots(
        2 * len(names), 1, sharex=True, squeeze=False, height_ratios=[CURVES_MM, DIFFERENCE_MM] * len(names)
    )
    rows: list[Axes] = list(panels[:, 0])
    times = [one.common.time for pair in found.pairs for one in pair.channels.values()]
    first, last = min(time[0] for time in times), max(time[-1] for time in times)
    seconds = readable("s", float(max(abs(first), abs(last))))
    for n, name in enumerate(names):
        _curves(rows[2 * n], found, name, seconds, (first, last))
        _differences(rows[2 * n + 1], found, name, seconds)
    named = (line for line in rows[0].lines if not str(line.get_label()).startswith("_"))
    handles = {str(line.get_label()): line for line in named}
    rows[0].legend(
        list(handles.values()),
        list(handles),
        loc="lower left",
        bbox_to_anchor=(0.0, 1.2),
        fontsize=7,
        borderaxespad=0.0,
    )
    drawing.align_ylabels(rows)
    rows[-1].set_xlabel(f"time [{seconds.name}]")
    if last > first:
        rows[-1].set_xlim(seconds.scale * first, seconds.scale * last)
    style.caption(drawing, _caption(found))
    return drawing


def _title(found: FilesCompared) -> str:
    *before, last = [pair.other.name for pair in found.pairs]
    others = f"{', '.join(before)} and {last}" if before else last
    return f"{others} compared with {found.reference.name}"


def _curves(
    axes: Axes, found: FilesCompared, name: str, seconds: DisplayUnit, ends: tuple[float, float]
) -> None:
    """The curves of a channel as their files have them."""
    there = [(n, pair, pair.channels[name]) for n, pair in enumerate(found.pairs) if name in pair.channels]
    one = there[0][2]
    curves: list[tuple[ComparedFile, str, Any, float]] = [(found.reference, style.IDEAL, "-", 1.3)]
    curves += [(pair.other, *OTHERS[n], 1.0) for n, pair, _ in there]
    drawn = []
    for file, colour, dashes, width in curves:
        time, values = file.time(name), file.values(name, one.unit)
        chosen = (time >= ends[0]) & (time <= ends[1])
        drawn.append((file, time[chosen], values[chosen], colour, dashes, width))
    shown = readable(one.unit, max(float(np.nanmax(np.abs(values), initial=0.0)) for _, _, values, *_ in drawn))
    for file, time, values, colour, dashes, width in drawn:
        look: dict[str, Any] = {"ls": dashes, "lw": width}
        if file.run is None and time.size <= FEW:  # points are seen as such
            look = {"ls": "", "marker": "o", "ms": 3.5, "mfc": "none", "mew": 1.0, "zorder": 3}
        axes.plot(
            seconds.scale * time,
            shown.scale * values,
            color=colour,
            label=file.name,
            rasterized=time.size > 20000,
            **look,
        )
    _shade(axes, found, seconds, ends[1])
    label_values(axes, units.QUANTITIES.get(one.unit, "value"), shown.name)
    axes.set_title(f"{name}: {one.meaning}" if one.meaning else name, fontsize=8)


def _shade(axes: Axes, found: FilesCompared, seconds: DisplayUnit, last: float) -> None:
    """What lies after the earliest parting."""
    parting = min(pair.parting.time for pair in found.pairs)
    if parting < last:
        axes.axvspan(seconds.scale * parting, seconds.scale * last, color=AFTER, lw=0.0, zorder=0)
        axes.axvline(seconds.scale * parting, color="#888888", lw=0.8, ls=":")


def _differences(axes: Axes, found: FilesCompared, name: str, seconds: DisplayUnit) -> None:
    """What differs from the reference, with numerical errors, inside what is allowed."""
    there = [(n, pair, pair.channels[name]) for n, pair in enumerate(found.pairs) if name in pair.channels]
    sizes = [size_of_difference(one) for _, _, one in there]
    shown = readable(there[0][2].unit, max(sizes))
    for n, pair, one in there:
        _difference(axes, pair, one, OTHERS[n][0], seconds.scale, shown.scale)
    last = max(float(one.common.time[-1]) for _, _, one in there)
    _shade(axes, found, seconds, last)
    if any(one.before < one.common.time.size for _, _, one in there):
        axes.text(0.99, 0.5, BY_STATISTICS, transform=axes.transAxes, ha="right", va="center", fontsize=7)
    height, beyond = reach(there[0][2].allowed, max(sizes))
    if height > 0.0:
        axes.set_ylim(-shown.scale * height, shown.scale * height)
    allowed = there[0][2].allowed
    if math.isfinite(allowed) and not beyond:
        axes.axhspan(-shown.scale * allowed, shown.scale * allowed, color=ALLOWED, alpha=0.10, lw=0.0, zorder=0)
        for end in (-allowed, allowed):
            axes.axhline(shown.scale * end, color=ALLOWED, lw=0.8, ls="--")
    label_values(axes, "difference", shown.name)
    told = [_told(pair, one, len(there) > 1) for _, pair, one in there]
    far = f" (±{said(allowed, there[0][2].unit)} allowed: beyond the panel)" if beyond else ""
    axes.set_title(f"{'; '.join(told)}{far}", fontsize=7)


def size_of_difference(one: ComparedChannel) -> float:
    """Largest difference that a panel is to show: before the parting, or where nothing lies before, at all."""
    apart = np.abs(one.common.other - one.common.reference)
    piece = apart[: one.before] if one.before and np.isfinite(apart[: one.before]).any() else apart
    return float(np.nanmax(piece, initial=0.0))


def reach(allowed: float, size: float) -> tuple[float, bool]:
    """Half the height of a panel of differences, 0 if it may choose; whether what is allowed lies beyond it."""
    if not math.isfinite(allowed):
        return SPARE * size, False
    beyond = allowed > BEYOND * size > 0.0
    return SPARE * (size if beyond else max(size, allowed)), beyond


def _difference(
    axes: Axes, pair: ComparedPair, one: ComparedChannel, colour: str, seconds: float, scale: float
) -> None:
    """The line of a difference up to the parting, with its numerical errors."""
    time, apart = seconds * one.common.time, scale * (one.common.other - one.common.reference)
    marks: dict[str, Any] = {"marker": "o", "ms": 2.5} if time.size <= FEW else {}
    start = one.before
    axes.plot(time[:start], apart[:start], color=colour, lw=0.9, rasterized=time.size > 20000, **marks)
    errors = scale * one.errors
    if start and np.isfinite(errors[:start]).any() and np.nanmax(errors[:start]) > 0.0:
        band = slice(0, start)
        axes.fill_between(
            time[band], (apart - errors)[band], (apart + errors)[band], color=colour, alpha=0.25, lw=0.0
        )
    if math.isfinite(one.measures.largest) and one.largest.value > 0.0:
        axes.plot(
            seconds * one.measures.largest_time,
            scale * one.measures.largest,
            "v" if one.measures.largest > 0.0 else "^",
            color=colour,
            ms=5,
            mfc="white",
            zorder=4,
        )


def _told(pair: ComparedPair, one: ComparedChannel, several: bool) -> str:
    """What the title of a panel of differences says of a file."""
    name = f"{pair.other.name}: " if several else "less reference: "
    if math.isnan(one.largest.value):
        return f"{name}nothing lies before the parting"
    at = f"largest {said(one.measures.largest, one.unit)} at {one.measures.largest_time:.4g} s"
    verdict = f", {verdict_words(one)}" if one.tolerance is not None else ""
    return f"{name}{at}{verdict}"


def _caption(found: FilesCompared) -> str:
    """What is drawn, in sentences."""
    channels = [one for pair in found.pairs for one in pair.channels.values()]
    told = [
        "Curves as their files have them (few points of a file: markers); below each, what differs from the "
        "reference."
    ]
    if any(one.with_errors for one in channels):
        told.append("Shaded in the colour of a curve, where it can be seen: numerical errors that are known.")
    else:
        told.append("Numerical errors are not known.")
    if any(one.tolerance is not None for one in channels):
        told.append("Green: what is allowed.")
    parted = [pair for pair in found.pairs if math.isfinite(pair.parting.time)]
    if parted:
        told.append(
            "Grey: after the first parting, from which on curves are compared by their statistics only."
        )
    return " ".join(told)
