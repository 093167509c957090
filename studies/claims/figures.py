"""Figures of the verdicts: shares of machines, and the paper's numbers among those of the machines."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from studies.claims.evidence import Evidence
from studies.claims.plausible_runs import CLEARANCES
from studies.claims.verdicts import BOUNDS, KINDS, Machines, Ruling
from studies.common import paper_machine
from studies.common.panels import finish, grid, letters
from studies.common.paper_machine import SIZES_MM
from support_exudyn.postprocessing.figures import style

COLOURS = dict(zip(KINDS, (style.THIRD, style.SMOOTH, style.PAPER, "#56B4E9", "#999999"), strict=True))
SMALL = 6.5  # letters of the names of statements [points]
SECOND: dict[str, Any] = {"color": "black", "marker": "D", "ls": "", "ms": 3.0, "mfc": "white", "mew": 0.7}
HYPERCUBES = {  # label and colour of lines of machines
    "machine as printed": "#999999",
    "machine with an engineer's contact": "#56B4E9",
}


def figures(
    rulings: Sequence[Ruling], reference: Evidence, first: Machines, second: Machines
) -> dict[str, Figure]:
    """All figures, by file name."""
    drawn = {"claims_shares": share_figure(rulings)}
    if first:
        drawn["force_over_clearance"] = force_figure(reference, first, second)
    return drawn


def share_figure(rulings: Sequence[Ruling]) -> Figure:
    """A bar a measurable statement, in two columns."""
    shown = [(n, ruling) for n, ruling in enumerate(rulings, 1) if ruling.claim.is_measurable]
    rows = -(-len(shown) // 2)
    drawing = Figure(figsize=style.size(180, 25 + 3.5 * rows))
    panels = drawing.subplots(1, 2)
    for axes, part in zip(panels, (shown[:rows], shown[rows:]), strict=True):
        _bars(axes, part, rows)
    letters(panels)
    found = {ruling.kind for _, ruling in shown}
    bars = [Patch(color=colour, label=kind) for kind, colour in COLOURS.items() if kind in found]
    squares = {"holds on the reference support": "black", "does not": "none"}
    marks = [Line2D([], [], **SECOND, label="second hypercube")]
    marks += [
        Line2D([], [], color="black", marker="s", ls="", ms=4, mfc=c, label=n) for n, c in squares.items()
    ]
    drawing.legend(handles=[*bars, *marks], loc="outside lower center", ncols=3, fontsize=8)
    return drawing


def _bars(axes: Axes, shown: Sequence[tuple[int, Ruling]], rows: int) -> None:
    """A column of so many rows: names and numbers of statements, shares, and the reference support."""
    for y, (_, ruling) in enumerate(shown):
        if ruling.first.share is not None:
            axes.barh(y, 100 * ruling.first.share, color=COLOURS[ruling.kind], height=0.68)
            axes.plot([100 * end for end in ruling.first.interval], [y, y], color="black", lw=0.9)
        else:
            why = "closed form" if ruling.claim.stiffness_mm else "undecided on all"
            axes.text(8.0, y, why, va="center", fontsize=SMALL)
        if ruling.second.share is not None:
            axes.plot(100 * ruling.second.share, y, **SECOND)
        full = "black" if ruling.reference else "none"
        axes.plot(110, y, "s", ms=3.5, color="black", mfc=full, clip_on=False)
    axes.set_yticks(range(len(shown)), [f"{ruling.claim.name}  {n}" for n, ruling in shown], fontsize=SMALL)
    axes.set(xlim=(0, 115), xticks=(5, 50, 95), ylim=(rows - 0.4, -0.6), xlabel="share of machines [%]")
    for bound in BOUNDS:
        axes.axvline(100 * bound, color="#777777", lw=0.7, ls=(0, (4, 2)))
    axes.grid(visible=False, axis="y")
    axes.set_axisbelow(True)


def force_figure(reference: Evidence, first: Machines, second: Machines) -> Figure:
    """Table 3 over all machines, against 0.5 mm: a column a measure; how many lines leave a panel is noted."""
    drawing, panels = grid(85, 1, 2, sharex=True)
    measures = {
        "mean_force": ("mean", paper_machine.MEAN_FORCE),
        "std_force": ("std. deviation", paper_machine.FORCE_SPREAD),
    }
    for axes, (name, (what, paper)) in zip(panels.flat, measures.items(), strict=True):

        def change(evidence: Evidence, name: str = name) -> np.ndarray:
            return _against_first([evidence[case][name].value for case in CLEARANCES])

        every = []
        for (label, colour), machines in zip(HYPERCUBES.items(), (first, second), strict=True):
            lines = np.array([change(evidence) for _, evidence in machines]).reshape(-1, len(SIZES_MM))
            every.append(lines)
            for n, line in enumerate(lines):
                axes.plot(SIZES_MM, line, color=colour, lw=0.5, alpha=0.6, label=None if n else label)
        printed = _against_first(list(paper.values()))
        axes.plot(SIZES_MM, change(reference), color="black", lw=1.6, label="reference support")
        axes.plot(SIZES_MM, printed, "x", color=style.PAPER, ms=6, mew=1.5, label="paper")
        ends = np.concatenate(every)
        lowest, highest = ends.min(axis=1), ends.max(axis=1)
        low = min(float(np.quantile(lowest, 0.05)), printed.min())  # nine tenths of the lines
        high = max(float(np.quantile(highest, 0.95)), printed.max())
        edge = 0.08 * (high - low)
        axes.set_ylim(low - edge, high + edge)
        if out := int(np.sum((lowest < low - edge) | (highest > high + edge))):
            note = f"{out} of {len(ends)} lines leave the panel"
            axes.text(0.02, 0.98, note, transform=axes.transAxes, va="top", fontsize=7)
        axes.set(ylabel=f"{what}, change [%]", xticks=SIZES_MM, xlabel="clearance [mm]")
    return finish(drawing, panels, 2)


def _against_first(values: Sequence[float]) -> np.ndarray:
    return 100.0 * (np.array(values) / values[0] - 1.0)
