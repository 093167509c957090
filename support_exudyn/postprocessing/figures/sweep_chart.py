"""A number of the runs of a sweep over what was varied."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.style import caption
from support_exudyn.postprocessing.figures.units import readable_change
from support_exudyn.postprocessing.sweep_runs import SweepRuns, in_words, some
from user_forces.values.value import InputError

if TYPE_CHECKING:
    import pyarrow as pa

LOST = "#666666"  # runs without a result
# curves: with markers, too, for grey prints
CURVES = tuple((colour, marker, dashes) for (colour, dashes), marker in zip(style.CURVES, "os^D", strict=False))


def sweep_chart(table: pa.Table, x: str, y: str, by: str | None = None) -> Figure:
    """One number over one varied field, with estimated errors as bars; runs that failed are marked on the axis.

    Points are joined where there is but one for every place on the axis and nothing else was varied: a line
    between runs that differ in more than the axis tells would look like a course of the number.

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
    places, ticks = _places(runs.column(x))
    values = number.values
    if not number.rows.size:
        raise InputError(f"{y}: no run has this number; allowed: {some(list(runs.numbers))}")
    shown = readable_change(number.unit, float(np.abs(number.known).max()), float(np.ptp(number.known)))
    alike = all(name in (x, by) or len(set(map(str, runs.column(name)))) == 1 for name in runs.varied)
    errors = number.errors
    drawing = style.begin(170, 95, f"{number.name} over {in_words(x).partition(' [')[0]}")
    axes = drawing.subplots()
    for label, chosen, (colour, marker, dashes) in _curves(
        None if by is None else runs.column(by), len(values)
    ):
        there = chosen & ~np.isnan(values)
        order = np.flatnonzero(there)[np.argsort(places[there], kind="stable")]
        alone = alike and len(np.unique(places[order])) == order.size
        bars = None if errors is None else shown.scale * np.nan_to_num(errors[order])
        axes.errorbar(
            places[order], shown.scale * values[order], bars, color=colour, marker=marker, ms=5, mfc="none",
            mew=1.2, ls=dashes if alone and ticks is None else "none", lw=1.0, capsize=2.5, elinewidth=0.8,
            label=label,
        )  # fmt: skip
    lost = np.array([one != "done" for one in runs.column("status")])
    if lost.any():
        axes.plot(
            places[lost], np.zeros(int(lost.sum())), "x", color=LOST, ms=6, mew=1.4, clip_on=False,
            zorder=5, transform=axes.get_xaxis_transform(), label=f"no result ({int(lost.sum())} runs)",
        )  # fmt: skip
    if ticks is not None:
        axes.set_xticks(range(len(ticks)), ticks)
    axes.set_xlabel(in_words(x))
    axes.set_ylabel(f"{number.name} [{shown.name}]" if shown.name else number.name)
    if by is not None or lost.any():
        handles, labels = axes.get_legend_handles_labels()
        sequence = sorted(range(len(labels)), key=lambda n: labels[n].startswith("no result"))  # these last
        handles, labels = [handles[n] for n in sequence], [labels[n] for n in sequence]
        axes.legend(handles, labels, title=None if by is None else in_words(by), loc="best", alignment="left")
    caption(drawing, _words(runs, x, by, errors is not None))
    return drawing


def _curves(items: list[Any] | None, size: int) -> list[tuple[str, Any, Any]]:
    """Label, chosen runs and look of each curve; items: by which runs are told apart, None: all in one."""
    if items is None:
        return [("runs", np.ones(size, dtype=bool), CURVES[0])]
    values = list(dict.fromkeys(items))
    if all(isinstance(one, (int, float)) for one in values):
        values.sort()
    if len(values) > len(CURVES):
        raise InputError(f"by: has {len(values)} values; allowed for a curve each: up to {len(CURVES)}")
    return [
        (f"{one:g}" if isinstance(one, float) else str(one), np.array([item == one for item in items]), curve)
        for one, curve in zip(values, CURVES, strict=False)
    ]


def _places(values: list[Any]) -> tuple[np.ndarray, list[str] | None]:
    """Where on the axis; with names of the places if they are no numbers."""
    if all(isinstance(one, (int, float)) and not isinstance(one, bool) for one in values):
        return np.array(values, dtype=float), None
    names = list(dict.fromkeys(map(str, values)))
    return np.array([names.index(str(one)) for one in values], dtype=float), names


def _words(runs: SweepRuns, x: str, by: str | None, known: bool) -> str:
    status = runs.column("status")
    text = f"{status.count('done')} runs of {len(status)}. "
    rest = [name for name in runs.varied if name not in (x, by)]
    if rest:
        text += f"Also varied, and not told apart here: {', '.join(map(in_words, rest))}. "
    if known:
        return text + "Bars: estimated numerical error, often smaller than the mark."
    return text + "The runs were not made to an accuracy: nothing tells their numerical errors."
