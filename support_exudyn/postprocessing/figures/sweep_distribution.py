"""A number over all runs of a sweep: how it is distributed, and by which input it is moved most."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.units import readable_change
from support_exudyn.postprocessing.sweep_runs import SweepNumber, SweepRuns, in_words
from support_exudyn.postprocessing.sweep_summary import ranked
from support_exudyn.sweeps.statistics import FEWEST, percentiles
from user_forces.values.value import InputError

if TYPE_CHECKING:
    import pyarrow as pa

END = 0.2  # share of the runs with the least and with the greatest values of an input, between which a bar goes
MOST = 12  # inputs
HALVES = ((style.FLIGHT, "fifth with the least input"), (style.CONTACT, "with the greatest"))


def histogram(table: pa.Table, y: str) -> Figure:
    """How a number is distributed over the runs, with its percentiles and their confidence intervals.

    Arguments:
        table: of a sweep, as `read_table` gives it.
        y: a number of the table, with its unit at the end or without.

    Raises InputError if there is no such number, or too few runs have it.
    """
    runs = SweepRuns(table)
    one, scale, unit = _number(runs, y)
    values = scale * one.known
    drawing = style.begin(170, 85, f"{one.name}: {values.size} runs of {table.num_rows}")
    axes = drawing.subplots()
    axes.hist(values, bins="auto", color=style.FLIGHT, edgecolor="white", lw=0.6)
    for each in percentiles(values.tolist()):
        low, high = (
            end if np.isfinite(end) else edge
            for end, edge in ((each.low, values.min()), (each.high, values.max()))
        )
        axes.axvspan(low, high, color=style.SMOOTH, alpha=0.25, lw=0.0)
        axes.axvline(each.value, color=style.IDEAL, lw=1.0)
        axes.text(
            each.value, 1.01, f"{100 * each.share:g} %", transform=axes.get_xaxis_transform(), ha="center",
            va="bottom", fontsize=7,
        )  # fmt: skip
    axes.set_xlabel(f"{one.name} [{unit}]" if unit else one.name)
    axes.set_ylabel("number of runs")
    style.caption(
        drawing,
        "Lines: percentiles. Orange: their 95 % confidence intervals, between two runs each (order "
        "statistics); to the edge where the runs are too few to bound them.",
    )
    return drawing


def tornado(table: pa.Table, y: str) -> Figure:
    """By how much a number moves between the runs with the least and the greatest values of each input.

    Arguments, and what is raised, are those of `histogram`; also if no input is a number that varies.
    """
    runs = SweepRuns(table)
    one, scale, unit = _number(runs, y)
    found = []
    for rank in ranked(runs, one):
        given = np.array(runs.column(rank.name), dtype=object)[one.rows].astype(float)
        low, high = np.quantile(given, [END, 1.0 - END])
        ends = one.known[given <= low].mean(), one.known[given >= high].mean()
        found.append((abs(ends[1] - ends[0]), ends, rank))
    if not found:
        raise InputError(f"{one.name}: no input is a number that varies; allowed: sweeps that vary numbers")
    found.sort(key=lambda item: -item[0])
    found = found[:MOST]
    drawing = style.begin(170, 38 + 9 * len(found), f"{one.name}: {one.known.size} runs")
    axes = drawing.subplots()
    middle = scale * float(one.known.mean())
    for place, (_, ends, rank) in enumerate(found):
        for end, off, (colour, label) in zip(ends, (-0.18, 0.18), HALVES, strict=True):
            axes.barh(
                place + off, scale * end - middle, left=middle, color=colour, height=0.34,
                label=label if place == 0 else None,
            )  # fmt: skip
        axes.text(
            1.01, place, f"{rank.correlation:+.2f} ({rank.low:+.2f} to {rank.high:+.2f})", fontsize=7,
            va="center", transform=axes.get_yaxis_transform(),
        )  # fmt: skip
    axes.axvline(middle, color=style.IDEAL, lw=1.0)
    axes.set_yticks(range(len(found)), [in_words(rank.name) for *_, rank in found])
    axes.invert_yaxis()
    axes.grid(visible=False, axis="y")
    axes.set_xlabel(f"mean of {one.name} [{unit}]" if unit else f"mean of {one.name}")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, fontsize=7, borderaxespad=0.0)
    style.caption(
        drawing,
        "Bars: from the mean over all runs to that over the fifth with the least and with the greatest "
        "values of an input. On the right: rank correlation with its 95 % confidence interval.",
    )
    return drawing


def _number(runs: SweepRuns, y: str) -> tuple[SweepNumber, float, str]:
    """A number of the runs, and the factor and unit in which it is read best."""
    one = runs.number(y)
    if one.known.size < FEWEST:
        raise InputError(f"{one.name}: {one.known.size} runs have this number; allowed: {FEWEST} and more")
    shown = readable_change(one.unit, float(np.abs(one.known).max()), float(np.ptp(one.known)))
    return one, shown.scale, shown.name
