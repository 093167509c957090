"""Figures of checked machines: postures, paths and static forces over the stroke."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import singledispatch
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from support_exudyn.machines.check.any_machine import MachineReport
from support_exudyn.machines.check.report import CheckReport
from support_exudyn.machines.check.shield import ShieldReport
from support_exudyn.machines.check.shield_stroke import WANDER, Limit, Shield, Station
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.linkage_check import linkage_check_figure
from support_exudyn.postprocessing.figures.style import CURVES, Dashes
from user_forces.values.value import Vector2

LETTERS = {
    "rear_base": "B", "front_base": "A", "rear_shield": "C", "front_shield": "D", "hinge": "I",
    "front_foot": "F", "front_head": "E", "rear_foot": "H", "rear_head": "G", "leg_foot": "F", "leg_head": "L",
    "ram_foot": "P", "ram_head": "Q", "tip": "T",
}  # fmt: skip
# where the letter of a pivot stands beside it [points]
ASIDE = {
    "hinge": (0.0, 9.0), "front_head": (0.0, 9.0), "rear_head": (0.0, 9.0), "leg_head": (0.0, 9.0),
    "tip": (0.0, 9.0), "rear_shield": (-9.0, 2.0), "rear_base": (-9.0, 2.0), "front_shield": (-2.0, 9.0),
    "front_foot": (9.0, -2.0), "rear_foot": (9.0, -2.0), "leg_foot": (9.0, -2.0),
}  # fmt: skip
ELSEWHERE = (9.0, -4.0)  # ... of the others
LENGTHS = (
    ("rear_base", "rear_shield"), ("front_base", "front_shield"), ("rear_shield", "front_shield"),
    ("rear_shield", "hinge"), ("hinge", "tip"),
)  # fmt: skip
# of lowest, middle and highest posture
POSTURES: tuple[tuple[str, Dashes], ...] = (
    (style.WITH_CLEARANCE, (0, (4, 1.5))),
    (style.IDEAL, "-"),
    (style.THIRD, (0, (3, 1, 1, 1))),
)
GREY = "#777777"


@singledispatch
def check_figure(report: CheckReport) -> Figure:
    """The figure of a check: drawing of the machine, and curves of what was found."""
    raise TypeError(f"{type(report).__name__}: has no figure; allowed: reports of `check_machine`")


@check_figure.register
def _(report: ShieldReport) -> Figure:
    """A support in three postures, and curves over its stroke."""
    machine, fine = report.machine, report.fine
    drawing = style.begin(180, 205, report.name)
    grid = drawing.add_gridspec(3, 2, height_ratios=(1.75, 1.0, 1.0))
    upper = grid[0, :].subgridspec(1, 2, width_ratios=(2.7, 1.0))
    _machine(drawing.add_subplot(upper[0]), machine, fine)
    _pivots(drawing.add_subplot(upper[1]), machine, fine)
    _tip_path(drawing.add_subplot(grid[1, 0]), fine)
    _angles(drawing.add_subplot(grid[1, 1]), fine, report.limits)
    stroke, pins, columns = [1e3 * one.stroke for one in fine], fine[0].forces.pins, fine[0].forces.actuators
    for place, title, forces in (
        (grid[2, 0], "static force in pins [kN]",
         {name: [1e-3 * float(np.hypot(*one.forces.pins[name])) for one in fine] for name in pins}),
        (grid[2, 1], "push of columns, under weight [kN]",
         {name: [1e-3 * one.forces.actuators[name] for one in fine] for name in columns}),
    ):  # fmt: skip
        axes = drawing.add_subplot(place)
        axes.axhline(0.0, color=GREY, lw=0.6)
        axes.set(xlabel="stroke [mm]", title=title, ylabel="force [kN]")
        _forces(axes, stroke, forces, room=0.45)
    return drawing


check_figure.register(MachineReport, linkage_check_figure)


def _forces(axes: Axes, x: Sequence[float], forces: Mapping[str, Sequence[float]], room: float) -> None:
    """Forces by name over x; room: what is left for the names above, of the height."""
    for (name, values), (colour, dashes) in zip(forces.items(), CURVES, strict=False):
        axes.plot(x, values, color=colour, ls=dashes, lw=1.2, label=name)
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + room * (high - low))
    axes.legend(loc="upper left", ncols=2, fontsize=7)


def places(machine: Shield, posture: Any) -> dict[str, Vector2]:
    """All pivots but those of the tail beam in a posture [m]."""
    found: dict[str, Vector2] = {
        "rear_base": machine.rear_base,
        "front_base": machine.front_base,
        "rear_shield": posture.rear_shield,
        "front_shield": posture.front_shield,
        "hinge": posture.hinge,
    }
    for strut in machine.STRUTS.values():
        for body, pivot in strut:
            found[pivot] = machine.place(body, pivot, posture)
    return found | {"tip": posture.tip}


def _three(fine: Sequence[Station]) -> list[Station]:
    """Lowest, middle, highest."""
    order = sorted(fine, key=lambda one: one.posture.hinge[1])
    return [order[0], order[len(order) // 2], order[-1]]


def _machine(axes: Axes, machine: Shield, fine: Sequence[Station]) -> None:
    three = _three(fine)
    for number in (0, 2, 1):  # the middle one in front
        station, (colour, dashes) = three[number], POSTURES[number]
        _posture(axes, machine, station, colour, dashes, strong=number == 1)
    at = places(machine, three[1].posture)
    size = max(np.ptp([p[0] for p in at.values()]), np.ptp([p[1] for p in at.values()]))
    for pivot, (x, y) in at.items():
        axes.annotate(
            LETTERS[pivot], (1e3 * x, 1e3 * y), xytext=ASIDE.get(pivot, ELSEWHERE), textcoords="offset points",
            fontsize=8, ha="center", va="center",
            bbox={"boxstyle": "round,pad=0.1", "fc": "white", "ec": "none", "alpha": 0.8},
            zorder=6,
        )  # fmt: skip
    axes.axhline(0.0, color=GREY, lw=0.8)
    right = max(one.posture.tip[0] for one in three)
    for n, number in enumerate((0, 2)):
        top = three[number].posture.tip[1]
        _dimension(axes, right + (0.05 + 0.09 * n) * size, 0.0, top, POSTURES[number][0])
    # a box that shrank to its data would be given too little room for its labels
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel="x, forward [mm]", ylabel="y [mm]")
    axes.set_title("lowest, middle and highest posture; heights of the tip [mm]", pad=10)
    handles = [
        axes.plot([], [], color=colour, ls=dashes, lw=1.6, label=f"stroke {1e3 * one.stroke:.0f} mm")[0]
        for one, (colour, dashes) in zip(three, POSTURES, strict=True)
    ]
    under_the_tip = (1e3 * right, 0.04e3 * size)  # nothing stands there
    axes.legend(
        handles=handles, loc="lower right", bbox_to_anchor=under_the_tip, bbox_transform=axes.transData,
        fontsize=7.5,
    )  # fmt: skip
    axes.plot(1e3 * (right + 0.24 * size), 0.0)  # room for the dimensions
    axes.grid(False)


def _posture(
    axes: Axes, machine: Shield, station: Station, colour: str, dashes: Dashes, *, strong: bool
) -> None:
    at = {name: 1e3 * np.array(point) for name, point in places(machine, station.posture).items()}
    wide = 1.0 if strong else 0.6

    def line(*names: str, width: float) -> None:
        points = np.array([at[name] for name in names])
        axes.plot(points[:, 0], points[:, 1], color=colour, ls=dashes, lw=wide * width, zorder=3 + strong)

    line("rear_base", "rear_shield", width=2.2)
    line("front_base", "front_shield", width=2.2)
    line("rear_shield", "front_shield", "hinge", "rear_shield", width=1.4)
    corners = np.array([at[name] for name in ("rear_shield", "front_shield", "hinge")])
    axes.fill(corners[:, 0], corners[:, 1], color=colour, alpha=0.12 if strong else 0.05, lw=0)
    on_canopy = [pivot for strut in machine.STRUTS.values() for body, pivot in strut if body == "canopy"]
    roof = np.array([at["hinge"], *(at[name] for name in on_canopy), at["tip"]])
    corners = roof[np.lexsort((roof[:, 1], roof[:, 0]))]
    axes.plot(corners[:, 0], corners[:, 1], color=colour, ls=dashes, lw=wide * 2.2, zorder=3 + strong)
    for strut in machine.STRUTS.values():
        line(strut.foot[1], strut.head[1], width=3.2)
    points = np.array([point for name, point in at.items() if name != "tip"])
    axes.plot(
        points[:, 0], points[:, 1], "o", ms=4.0 if strong else 2.5, mfc="white", mec=colour, mew=0.8, zorder=5
    )
    if strong:
        axes.plot(*at["tip"], "D", ms=3.5, mfc="white", mec=colour, zorder=5)
        feet = {place for strut in machine.STRUTS.values() for body, place in strut if body == GROUND}
        for name in ("rear_base", "front_base", *sorted(feet)):
            x, y = at[name]
            axes.plot([x, x], [0.0, y], color=GREY, lw=0.6, ls=":", zorder=1)


def _dimension(axes: Axes, x: float, low: float, high: float, colour: str) -> None:
    """A height, with arrows at both ends."""
    axes.annotate(
        "", (1e3 * x, 1e3 * low), (1e3 * x, 1e3 * high),
        arrowprops={"arrowstyle": "<->", "color": colour, "lw": 0.8, "shrinkA": 0, "shrinkB": 0},
    )  # fmt: skip
    axes.text(
        1e3 * x, 500.0 * (low + high), f"{1e3 * (high - low):.0f}", rotation=90, ha="center", va="center",
        fontsize=8, color=colour, bbox={"boxstyle": "square,pad=0.15", "fc": "white", "ec": "none"},
    )  # fmt: skip


def _pivots(axes: Axes, machine: Shield, fine: Sequence[Station]) -> None:
    """Table of the pivots at the start, and of the lengths of links and columns."""
    axes.set_axis_off()
    at = places(machine, machine.start())
    lines = [("", "at the start", "x", "y")]
    lines += [(LETTERS[name], name, f"{1e3 * x:.0f}", f"{1e3 * y:.0f}") for name, (x, y) in at.items()]
    lines += [("", "", "", ""), ("", "lengths", "", "mm")]
    for first, second in LENGTHS:
        apart = float(np.hypot(*np.subtract(at[second], at[first])))
        lines.append(("", f"{LETTERS[first]}-{LETTERS[second]}", "", f"{1e3 * apart:.0f}"))
    for name in machine.STRUTS:
        lengths = [1e3 * one.lengths[name] for one in fine]
        lines.append(("", name, "", f"{lengths[0]:.0f} to {lengths[-1]:.0f}"))
    for n, line in enumerate(lines):
        heavy = "bold" if line[1] in ("at the start", "lengths") else "normal"
        for x, text, side in zip((0.0, 0.1, 0.74, 1.0), line, ("left", "left", "right", "right"), strict=True):
            axes.text(
                x, 1.0 - 0.05 * n, text, ha=side, va="top", fontsize=7.5, weight=heavy,
                transform=axes.transAxes,
            )  # fmt: skip


def _tip_path(axes: Axes, fine: Sequence[Station]) -> None:
    x = np.array([1e3 * one.posture.tip[0] for one in fine])
    y = np.array([1e3 * one.posture.hinge[1] for one in fine])
    middle, allowed = 0.5 * (x.min() + x.max()), 1e3 * WANDER
    axes.axvspan(middle - 0.5 * allowed, middle + 0.5 * allowed, color=style.FLIGHT, alpha=0.25, lw=0)
    axes.plot(x, y, color=style.IDEAL, lw=1.4)
    half = 0.65 * max(allowed, float(np.ptp(x)))
    axes.set(xlim=(middle - half, middle + half), xlabel="x of the tip [mm]", ylabel="height of the hinge [mm]")
    axes.set_title(f"tip wander {np.ptp(x):.1f} mm (band: {allowed:.0f} mm)")


def _angles(axes: Axes, fine: Sequence[Station], limits: Mapping[str, Limit | None]) -> None:
    heights = [1e3 * one.posture.hinge[1] for one in fine]
    for pin, (colour, dashes) in zip(("rear_shield", "front_shield"), CURVES, strict=False):
        angles = [np.degrees(one.transmission[pin]) for one in fine]
        axes.plot(heights, angles, color=colour, ls=dashes, lw=1.4, label=f"{LETTERS[pin]}: {pin}")
    for edge in (0.0, 160.0):
        axes.axhspan(edge, edge + 20.0, color=GREY, alpha=0.2, lw=0)
    axes.set(ylim=(0.0, 180.0), yticks=range(0, 181, 30), xlabel="height of the hinge [mm]")
    axes.set_ylabel("link to shield beam [degrees]")
    margins = [f"{1e3 * found.margin:.0f} mm {where}" for where, found in limits.items() if found]
    axes.set_title(f"way ends {' and '.join(margins)}" if margins else "no dead centre near")
    axes.legend(loc="best", fontsize=7)
