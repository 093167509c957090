"""Figures of a sweep: a number over a varied field, its distribution, and the inputs that move it most."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.selection import as_words
from support_exudyn.postprocessing.figures.units import readable_change
from support_exudyn.postprocessing.sweep_runs import SweepNumber, SweepRuns, in_words, some
from support_exudyn.postprocessing.sweep_summary import ranked
from support_exudyn.sweeps.statistics import FEWEST, percentiles
from user_forces.values.value import InputError

if TYPE_CHECKING:
    import pyarrow as pa

LOST = "#666666"  # runs without a result
# curves: with markers, too, for grey prints
CURVES = tuple((colour, marker, dashes) for (colour, dashes), marker in zip(style.CURVES, "os^D", strict=False))
END = 0.2  # share of the runs with the least and with the greatest values of an input, between which a bar goes
MOST = 12  # inputs
HALVES = ((style.FLIGHT, "fifth with the least input"), (style.CONTACT, "with the greatest"))
ABOVE: dict[str, Any] = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0), "borderaxespad": 0.0, "fontsize": 7}


def label(name: str) -> str:
    """A number or a field of a sweep in words: "pins.rear_base.clearance_mm" as "rear base: clearance [mm]"."""
    bare, bracket, unit = in_words(name).partition(" [")
    joint, dot, what = bare.removeprefix("pins.").removeprefix("pin.").partition(".")
    words = f"{as_words(joint)}: {as_words(what.replace('.', ', '))}" if dot else as_words(joint)
    return f"{words}{bracket}{unit}"


class _Shown:
    """A number of the runs in the unit in which it is read best, on axes of a figure."""

    def __init__(self, number: SweepNumber, height_mm: float, title: str) -> None:
        shown = readable_change(number.unit, float(np.abs(number.known).max()), float(np.ptp(number.known)))
        self.scale, words = shown.scale, label(number.name)
        self.label = f"{words} [{shown.name}]" if shown.name else words
        self.drawing = style.begin(170, height_mm, f"{words}{title}")
        self.axes: Axes = self.drawing.subplots()


def sweep_chart(table: pa.Table, x: str, y: str, by: str | None = None) -> Figure:
    """One number over one varied field, with estimated errors as bars; runs that failed are marked on the axis.

    Points are joined where there is but one for every place on the axis and nothing else was varied: a line
    between runs that differ in more than the axis shows would look like a course of the number.

    Arguments:
        table: of a sweep, as `read_table` gives it.
        x: what was varied, as the sweep's file calls it.
        y: a number of the table, with its unit at the end or without.
        by: something else that was varied, with few values: each has a curve.

    Raises InputError if there is no such column, or if it has too many values for `by`.
    """
    runs = SweepRuns(table)
    x = runs.input(x)
    by = None if by is None else runs.input(by, besides=x)
    number = runs.number(y)
    if not number.rows.size:
        raise InputError(f"{y}: no run has this number; allowed: {some(list(runs.numbers))}")
    places, ticks = _places(runs.column(x))
    shown = _Shown(number, 95, f" over {label(x).partition(' [')[0]}")
    axes, values, errors = shown.axes, shown.scale * number.values, number.errors
    others = [name for name in runs.varied if name not in (x, by)]
    alike = all(len(set(map(str, runs.column(name)))) == 1 for name in others)
    items: list[Any] = [None] * len(values) if by is None else runs.column(by)
    for name, (colour, marker, dashes) in zip(_kinds(items), CURVES, strict=False):
        there = np.array([item == name for item in items]) & ~np.isnan(values)
        order = np.flatnonzero(there)[np.argsort(places[there], kind="stable")]
        joined = alike and ticks is None and len(np.unique(places[order])) == order.size
        bars = None if errors is None else shown.scale * np.nan_to_num(errors[order])
        axes.errorbar(
            places[order], values[order], bars, color=colour, marker=marker, ms=5, mfc="none", mew=1.2,
            ls=dashes if joined else "none", lw=1.0, capsize=2.5, elinewidth=0.8,
            label=f"{name:g}" if isinstance(name, float) else str(name or "runs"),
        )  # fmt: skip
    lost = np.array([one != "done" for one in runs.column("status")])
    if lost.any():
        axes.plot(
            places[lost], np.zeros(int(lost.sum())), "x", color=LOST, ms=6, mew=1.4, clip_on=False,
            zorder=5, transform=axes.get_xaxis_transform(), label=f"no result ({int(lost.sum())} runs)",
        )  # fmt: skip
    if ticks is not None:
        axes.set_xticks(range(len(ticks)), ticks)
    axes.set(xlabel=label(x), ylabel=shown.label)
    if by is not None or lost.any():
        handles, labels = axes.get_legend_handles_labels()
        pairs = sorted(zip(labels, handles, strict=True), key=lambda pair: pair[0].startswith("no result"))
        title = None if by is None else label(by)
        drawn = [handle for _, handle in pairs]
        axes.legend(drawn, [name for name, _ in pairs], title=title, alignment="left", ncols=3, **ABOVE)
    text = f"{runs.column('status').count('done')} runs of {len(values)}. "
    if others:
        text += f"Also varied, and not distinguished here: {', '.join(map(label, others))}. "
    known = "Bars: estimated numerical error, often smaller than the mark."
    unknown = "The numerical errors are not known: the runs were not made to an accuracy."
    style.caption(shown.drawing, text + (unknown if errors is None else known))
    return shown.drawing


def _kinds(items: list[Any]) -> list[Any]:
    """The values by which runs have a curve each, in order. Raises InputError if they are too many."""
    values = list(dict.fromkeys(items))
    if all(isinstance(one, (int, float)) for one in values):
        values.sort()
    if len(values) > len(CURVES):
        raise InputError(f"by: has {len(values)} values; allowed for a curve each: up to {len(CURVES)}")
    return values


def _places(values: list[Any]) -> tuple[np.ndarray, list[str] | None]:
    """Where on the axis; with names of the places if they are no numbers."""
    if all(isinstance(one, (int, float)) and not isinstance(one, bool) for one in values):
        return np.array(values, dtype=float), None
    names = list(dict.fromkeys(map(str, values)))
    return np.array([names.index(str(one)) for one in values], dtype=float), names


def histogram(table: pa.Table, y: str) -> Figure:
    """How a number is distributed over the runs, with its percentiles and their confidence intervals.

    Arguments:
        table: of a sweep, as `read_table` gives it.
        y: a number of the table, with its unit at the end or without.

    Raises InputError if there is no such number, or too few runs have it.
    """
    number = _number(SweepRuns(table), y)
    shown = _Shown(number, 85, f", {number.known.size} runs of {table.num_rows}")
    axes, values = shown.axes, shown.scale * number.known
    axes.hist(values, bins="auto", color=style.FLIGHT, edgecolor="white", lw=0.6)
    for each in percentiles(values.tolist()):
        low = each.low if np.isfinite(each.low) else values.min()
        high = each.high if np.isfinite(each.high) else values.max()
        axes.axvspan(low, high, color=style.SMOOTH, alpha=0.25, lw=0.0)
        axes.axvline(each.value, color=style.IDEAL, lw=1.0)
        axes.text(
            each.value, 1.01, f"{100 * each.share:g} %", transform=axes.get_xaxis_transform(), ha="center",
            va="bottom", fontsize=7,
        )  # fmt: skip
    axes.set(xlabel=shown.label, ylabel="number of runs")
    style.caption(
        shown.drawing,
        "Lines: percentiles. Orange: their 95 % confidence intervals, between two runs each (order "
        "statistics); to the edge where the runs are too few to bound them.",
    )
    return shown.drawing


def tornado(table: pa.Table, y: str) -> Figure:
    """By how much a number moves between the runs with the least and the greatest values of each input.

    Arguments, and what is raised, are those of `histogram`; also if no input is a number that varies.
    """
    runs = SweepRuns(table)
    number = _number(runs, y)
    found = []
    for rank in ranked(runs, number):
        given = np.array(runs.column(rank.name), dtype=object)[number.rows].astype(float)
        low, high = np.quantile(given, [END, 1.0 - END])
        found.append((number.known[given <= low].mean(), number.known[given >= high].mean(), rank))
    if not found:
        raise InputError(f"{number.name}: no input is a number that varies; allowed: sweeps that vary numbers")
    found = sorted(found, key=lambda item: -abs(item[1] - item[0]))[:MOST]
    shown = _Shown(number, 38 + 9 * len(found), f", {number.known.size} runs")
    axes, middle = shown.axes, shown.scale * float(number.known.mean())
    rows = np.arange(len(found))
    for n, (off, (colour, name)) in enumerate(zip((-0.18, 0.18), HALVES, strict=True)):
        ends = shown.scale * np.array([item[n] for item in found])
        axes.barh(rows + off, ends - middle, left=middle, color=colour, height=0.34, label=name)
    for place, (*_, rank) in enumerate(found):
        axes.text(
            1.01, place, f"{rank.correlation:+.2f} ({rank.low:+.2f} to {rank.high:+.2f})", fontsize=7,
            va="center", transform=axes.get_yaxis_transform(),
        )  # fmt: skip
    axes.axvline(middle, color=style.IDEAL, lw=1.0)
    axes.set_yticks(rows, [label(rank.name) for *_, rank in found])
    axes.invert_yaxis()
    axes.grid(visible=False, axis="y")
    axes.set_xlabel(f"mean of {shown.label}")
    axes.legend(ncols=2, **ABOVE)
    style.caption(
        shown.drawing,
        "Bars: from the mean over all runs to that over the fifth with the least and with the greatest "
        "values of an input. On the right: rank correlation with its 95 % confidence interval.",
    )
    return shown.drawing


def _number(runs: SweepRuns, y: str) -> SweepNumber:
    """A number of the runs. Raises InputError if too few runs have it."""
    number = runs.number(y)
    if number.known.size < FEWEST:
        raise InputError(
            f"{number.name}: {number.known.size} runs have this number; allowed: {FEWEST} and more"
        )
    return number
