"""Pictures of the verdicts: shares of machines, and where the paper's numbers lie among them."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from studies.claims.evidence import Evidence
from studies.claims.plausible import REFERENCE, Sample
from studies.claims.plausible_runs import CLEARANCES
from studies.claims.verdicts import NEARLY_ALL, Ruling
from studies.common import paper_machine
from studies.common.panels import legend
from studies.common.paper_machine import SIZES_MM
from support_exudyn.postprocessing.figures import style

COLOURS = {"holds only": style.SMOOTH, "holds": style.THIRD, "not supported": style.PAPER, "cannot": "#999999"}

OTHER_WINDOW = "#CC79A7"

Machines = Sequence[tuple[Sample, Evidence]]


def figures(rulings: Sequence[Ruling], reference: Evidence, machines: Machines) -> dict[str, Figure]:
    """All figures, by file name."""
    drawn = {"claims_shares": share_figure(rulings)}
    if machines:
        drawn["force_over_clearance"] = force_figure(reference, machines)
        drawn["rms_and_friction"] = rms_figure(reference, machines)
    return drawn


def share_figure(rulings: Sequence[Ruling]) -> Figure:
    """A bar a claim."""
    drawing = Figure(figsize=style.size(170, 20 + 4.6 * len(rulings)))
    axes = drawing.subplots()
    for n, ruling in enumerate(rulings, 1):
        colour = next(value for kind, value in COLOURS.items() if ruling.verdict.startswith(kind))
        if ruling.share is not None and ruling.interval is not None:
            low, high = ruling.interval
            axes.barh(n, 100 * ruling.share, color=colour, height=0.62)
            axes.plot([100 * low, 100 * high], [n, n], color="black", lw=0.8)
        if ruling.reference is not None:
            axes.plot(
                103, n, "s", ms=4, color="black", mfc="black" if ruling.reference else "none", clip_on=False
            )
    labels = [f"{_short(ruling.claim.text)}  {n}" for n, ruling in enumerate(rulings, 1)]
    axes.set_yticks(range(1, len(rulings) + 1), labels, fontsize=6.5)
    axes.set(
        xlim=(0, 106),
        xticks=range(0, 101, 20),
        ylim=(len(rulings) + 0.6, 0.4),
        xlabel="share of plausible machines [%]",
    )
    for bound in (NEARLY_ALL, 1.0 - NEARLY_ALL):
        axes.axvline(100 * bound, color="#777777", lw=0.7, ls=(0, (4, 2)))
    axes.grid(visible=False, axis="y")
    drawing.suptitle("For how many plausible machines each claim holds")
    return drawing


def _short(text: str) -> str:
    return text if len(text) <= 78 else text[:75].rsplit(" ", 1)[0] + " ..."


def force_figure(reference: Evidence, machines: Machines) -> Figure:
    """Table 3 over all machines, against 0.5 mm."""
    drawing = Figure(figsize=style.size(170, 85))
    panels = drawing.subplots(1, 2)
    printed = {"mean_force": paper_machine.MEAN_FORCE, "std_force": paper_machine.FORCE_SPREAD}
    for axes, letter, (name, paper) in zip(panels, "ab", printed.items(), strict=True):
        rises = []
        for sample, evidence in machines:
            line = _against_first([m.value for m in evidence.row(name, CLEARANCES)])
            in_rise = sample["window"] == "rise"
            axes.plot(SIZES_MM, line, color="#999999" if in_rise else OTHER_WINDOW, lw=0.5, alpha=0.5)
            rises += list(line) if in_rise else []
        axes.plot(
            SIZES_MM,
            _against_first([m.value for m in reference.row(name, CLEARANCES)]),
            color="black",
            lw=1.4,
        )
        axes.plot(SIZES_MM, _against_first(list(paper.values())), "x", color=style.PAPER, ms=6, mew=1.5)
        # a few that shake would dwarf the rest
        low, high = np.quantile(rises or [0.0, 1.0], (0.1, 0.9))
        low, high = (
            min(low, *_against_first(list(paper.values()))),
            max(high, *_against_first(list(paper.values()))),
        )
        axes.set_ylim(low - 0.3 * (high - low), high + 0.3 * (high - low))
        what = "mean" if name == "mean_force" else "standard deviation"
        axes.set(title=f"{letter}) {what}", xlabel="clearance [mm]", ylabel="change against 0.5 mm [%]")
        axes.set_xticks(SIZES_MM)
    drawing.suptitle("Pin force over the clearance (paper: Table 3)")
    return drawing


def _against_first(values: Sequence[float]) -> np.ndarray:
    return 100.0 * (np.array(values) / values[0] - 1.0)


def rms_figure(reference: Evidence, machines: Machines) -> Figure:
    """What decides whether the pin shakes."""
    drawing = Figure(figsize=style.size(170, 85))
    left, right = drawing.subplots(1, 2, sharey=True)
    for axes, factor in ((left, "sliding_coefficient"), (right, "dynamic_speed")):
        for bore, look in (("base", (style.WITH_CLEARANCE, "o")), ("rear link", (style.SMOOTH, "^"))):
            _scatter(axes, [m for m in machines if m[0]["bore"] == bore], factor, look, f"bore in the {bore}")
        shown = reference[CLEARANCES[2], "rms_force"].over(reference[CLEARANCES[2], "mean_force"]).value
        axes.plot(float(REFERENCE[factor]), 100.0 * shown, "s", color="black", ms=5, label="reference support")
        axes.set_yscale("log")
    left.set(
        title="a)", xlabel="friction coefficient [-]", ylabel="RMS fluctuation of the pin force [% of its mean]"
    )
    right.set(title="b)", xlabel="v_d [m/s]", xscale="log")
    right.xaxis.set_major_locator(LogLocator(subs=(1.0, 3.0)))
    right.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    right.xaxis.set_minor_formatter(NullFormatter())
    legend(drawing, left, 3)
    drawing.suptitle("What shakes the pin during the rise, 1.5 mm")
    return drawing


def _scatter(axes: Axes, machines: Machines, factor: str, look: tuple[str, str], label: str) -> None:
    x = [float(sample[factor]) for sample, _ in machines]
    y = [
        100.0 * evidence[CLEARANCES[2], "rms_force"].over(evidence[CLEARANCES[2], "mean_force"]).value
        for _, evidence in machines
    ]
    colour, marker = look
    axes.plot(x, y, marker, ms=2.5, color=colour, label=label)
