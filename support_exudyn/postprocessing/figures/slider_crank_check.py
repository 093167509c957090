"""Figure of a checked slider-crank: postures, slider, static forces over a revolution."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from support_exudyn.machines.slider_crank import SliderCrank
from support_exudyn.postprocessing.figures import style

if TYPE_CHECKING:
    from support_exudyn.machines.check.slider_crank import Turn

POSTURES = ((45.0, style.IDEAL, "-"), (135.0, style.LOOSE, "--"), (270.0, style.THIRD, "-."))
CURVES = ((style.LOOSE, "-"), (style.SMOOTH, "--"), (style.THIRD, "-."), (style.IDEAL, ":"))
GREY = "#777777"


def crank_figure(name: str, machine: SliderCrank, fine: Sequence[Turn]) -> Figure:
    """Drawing and curves of a slider-crank over one revolution."""
    drawing = Figure(figsize=style.size(170, 150))
    grid = drawing.add_gridspec(2, 2, height_ratios=(1.2, 1.0))
    _machine(drawing.add_subplot(grid[0, :]), machine)
    degrees = [math.degrees(one.angle) for one in fine]
    left, right = drawing.add_subplot(grid[1, 0]), drawing.add_subplot(grid[1, 1])
    left.plot(degrees, [1e3 * one.slider for one in fine], color=style.IDEAL, lw=1.4)
    left.set(title="slider; dead centres at 0 and 180 degrees", ylabel="x of the slider [mm]")
    for dead in (0.0, 180.0, 360.0):
        left.axvline(dead, color=GREY, ls=":", lw=0.8)
    forces = {pin: [float(np.hypot(*one.forces.pins[pin])) for one in fine] for pin in fine[0].forces.pins} | {
        "guide": [abs(one.forces.slides["guide"]) for one in fine]
    }
    for (pin, values), (colour, dashes) in zip(forces.items(), CURVES, strict=True):
        right.plot(degrees, values, color=colour, ls=dashes, lw=1.2, label=pin)
    right.set(title="static forces under weight", ylabel="force [N]")
    low, high = right.get_ylim()
    right.set_ylim(low, high + 0.4 * (high - low))
    right.legend(loc="upper left", ncols=2, fontsize=7)
    for axes in (left, right):
        axes.set(xlim=(0.0, 360.0), xticks=range(0, 361, 90), xlabel="crank from +x [degrees]")
    drawing.suptitle(name, x=0.01, ha="left")
    return drawing


def _machine(axes: Axes, machine: SliderCrank) -> None:
    r, mm = machine.crank_length, 1e3
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    axes.plot(mm * r * np.cos(turn), mm * r * np.sin(turn), color=GREY, lw=0.6, ls=":")
    axes.axhline(0.0, color=GREY, lw=0.6)
    side = 0.12 * r * mm
    for degrees, colour, dashes in POSTURES:
        angle = math.radians(degrees)
        pin = mm * r * math.cos(angle), mm * r * math.sin(angle)
        slider = mm * machine.slider_position(angle)
        axes.plot([0.0, pin[0]], [0.0, pin[1]], color=colour, ls=dashes, lw=3.0)
        axes.plot(
            [pin[0], slider], [pin[1], 0.0], color=colour, ls=dashes, lw=1.6, label=f"{degrees:.0f} degrees"
        )
        corners = (
            [slider - 2 * side, slider + 2 * side, slider + 2 * side, slider - 2 * side],
            [-side, -side, side, side],
        )
        axes.fill(*corners, fc="white", ec=colour, lw=1.2, zorder=3)
        axes.plot([0.0, pin[0], slider], [0.0, pin[1], 0.0], "o", ms=4, mfc="white", mec=colour, zorder=4)
    axes.annotate("main", (0.0, 0.0), xytext=(-7, -12), textcoords="offset points", ha="right", fontsize=8)
    first = math.radians(POSTURES[0][0])
    axes.annotate(
        "crank_pin", (mm * r * math.cos(first), mm * r * math.sin(first)), xytext=(6, 6),
        textcoords="offset points", fontsize=8,
    )  # fmt: skip
    axes.annotate(
        "slider_pin", (mm * machine.slider_position(first), side), xytext=(0, 6), textcoords="offset points",
        fontsize=8, ha="center",
    )  # fmt: skip
    axes.set(aspect="equal", xlabel="x, along the guide [mm]", ylabel="y [mm]")
    axes.set_title(f"crank {mm * r:g} mm, rod {mm * machine.rod_length:g} mm, at three angles of the crank")
    axes.legend(loc="lower right", fontsize=8)
    axes.grid(False)
