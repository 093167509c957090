"""Loops of force over displacement, and slack and stiffness over the clearance."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common.numbers import Found
from studies.common.panels import letters
from studies.slack_stiffness.cases import CLEARANCES_MM, FRICTION, MACHINES, ROOF_SHARES, PushedSupport
from studies.slack_stiffness.measures import Loop
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style

Ran = Mapping[str, tuple[PushedSupport, Result]]
DRAWN_MM = (0.0, 0.5, 1.0, 2.0)  # clearances whose loops are drawn
MIDDLE = ROOF_SHARES[1]


def loop_figure(ran: Ran) -> Figure:
    """Push over displacement of the canopy, a panel for each machine, under the middle roof load."""
    drawing = Figure(figsize=style.size(170, 85))
    panels = list(drawing.subplots(1, 2))
    for axes, machine in zip(panels, MACHINES, strict=True):
        for (colour, dashes), size in zip(reversed(style.CURVES[:4]), DRAWN_MM, strict=True):
            case, run = ran[PushedSupport(machine, size, MIDDLE, FRICTION).name]
            loop = Loop(case, run)
            label = f"{size:g} mm" if size else "ideal pins"
            axes.plot(1e3 * loop.shift, 1e-3 * loop.force, color=colour, ls=dashes, label=label)
        axes.set(xlabel="displacement of the canopy [mm]", ylabel="horizontal force [kN]", title=machine)
    drawing.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    letters(panels)
    return drawing


def slack_figure(found: Found, factors: Mapping[str, float]) -> Figure:
    """Slack over clearance with what virtual work says (a), and stiffness from turn to turn (b)."""
    drawing = Figure(figsize=style.size(170, 85))
    slack, whole = drawing.subplots(1, 2)
    markers = dict(zip(ROOF_SHARES, ("o", "s", "^"), strict=True))
    for machine, (colour, dashes) in zip(MACHINES, style.CURVES, strict=False):
        ends = (0.0, CLEARANCES_MM[-1])
        slack.plot(ends, [factors[machine] * one for one in ends], color=colour, ls=dashes, lw=0.8)
        for share, marker in markers.items():
            _draw(slack, found, "slack", machine, share, color=colour, marker=marker, ls="none")
            _draw(whole, found, "whole", machine, share, color=colour, marker=marker, ls=dashes)
    slack.set(xlabel="radial clearance of all pins [mm]", ylabel="slack of the canopy [mm]")
    whole.set(
        xlabel="radial clearance of all pins [mm]", ylabel="stiffness from turn to turn [kN/mm]", ylim=(0, None)
    )
    for machine, (colour, dashes) in zip(MACHINES, style.CURVES, strict=False):
        slack.plot([], [], color=colour, ls=dashes, label=machine)
    for share, marker in markers.items():
        slack.plot([], [], marker, color="black", mfc="none", label=f"roof load {100 * share:g} % of rated")
    drawing.legend(*slack.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    letters([slack, whole])
    return drawing


def _draw(axes: Axes, found: Found, measure: str, machine: str, share: float, **look: Any) -> None:
    sizes = CLEARANCES_MM[1:]
    values = [found[measure, PushedSupport(machine, size, share, FRICTION).name].value for size in sizes]
    axes.plot(sizes, values, mfc="none", ms=4.5, lw=0.8, **look)
