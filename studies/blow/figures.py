"""Peaks by place, courses of the hardest blow on the tip, and what clearance does to peaks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.blow.cases import MIDDLE, PINS, PLACES, Blow, yield_pressure
from studies.blow.measures import Ran, Struck
from studies.common.numbers import Found
from studies.common.panels import letters
from studies.common.rise import DEGREES
from support_exudyn.postprocessing.figures import style

OVERLOAD = 1.2  # of the yield force, up to which no part may fail (EN 1804-1, 4.3.2)
LOOKS = dict(zip(PINS, (style.CURVES[3], style.CURVES[1], style.CURVES[0]), strict=True))
TITLES = {"ideal": "ideal pins", "one": "1.5 mm in one pin", "all": "1.5 mm in all pins"}


def peak_figure(found: Found, machines: Sequence[str]) -> Figure:
    """Largest leg pressure and pin force of the middle blow, by place, a column for each machine."""
    drawing = Figure(figsize=style.size(170, 120))
    panels = drawing.subplots(2, len(machines), sharex=True, squeeze=False)
    for column, machine in enumerate(machines):
        for row, (measure, label) in enumerate(
            (("pressure", "largest leg pressure [MPa]"), ("pin_force", "largest pin force [kN]"))
        ):
            axes = panels[row, column]
            for n, pins in enumerate(PINS):
                for valve in (True, False):
                    _points(axes, found, measure, machine, pins, valve=valve, shift=0.22 * (n - 1))
            axes.set_ylabel(label)
        limit = 1e-6 * yield_pressure(machine)
        panels[0, column].axhline(limit, color="#777777", lw=0.8)
        panels[0, column].axhline(OVERLOAD * limit, color="#777777", lw=0.8, ls=(0, (4, 2)))
        panels[0, column].set_title(machine)
        for axes in panels[:, column]:
            axes.set_ylim(0.0, 1.05 * axes.get_ylim()[1])  # of all that is drawn
        panels[1, column].set_xticks(range(len(PLACES)), [place.replace(" ", "\n", 1) for place in PLACES])
    drawing.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=7)
    letters(list(panels.flat))
    return drawing


def _points(
    axes: Axes, found: Found, measure: str, machine: str, pins: str, *, valve: bool, shift: float
) -> None:
    colour, _ = LOOKS[pins]
    values = [found[measure, Blow(machine, place, *MIDDLE, pins, valve).name].value for place in PLACES]
    axes.plot(
        np.arange(len(PLACES)) + shift, values, "o" if valve else "^", color=colour, ms=4.5,
        mfc=colour if valve else "none", label=f"{TITLES[pins]}{'' if valve else ', no valves'}",
    )  # fmt: skip


def course_figure(ran: Ran, machine: str, mass: float, height: float) -> Figure:
    """Courses of a blow on the tip: pressure of the front legs, flow, force of a pin, turn of the canopy."""
    drawing = Figure(figsize=style.size(170, 120))
    panels = list(drawing.subplots(2, 2, sharex=True).flat)
    blow = Blow(machine, "tip", mass, height, "ideal", valve=True)
    for pins, (colour, dashes) in LOOKS.items():
        here, run = ran[replace(blow, pins=pins).name]
        struck = Struck(here, run)
        time = 1e3 * (struck.of("time") - here.strike)
        look = {"color": colour, "ls": dashes, "label": TITLES[pins]}
        panels[0].plot(time, 1e-6 * struck.of("front_column.pressure"), **look)
        panels[1].plot(time, 6e4 * struck.of("front_column.yield_flow"), **look)
        panels[2].plot(time, 1e-3 * struck.of("pin.front_base.force"), **look)
        panels[3].plot(time, DEGREES * struck.of("canopy.angle"), **look)
    bare, run = ran[replace(blow, valve=False).name]
    struck = Struck(bare, run)
    time = 1e3 * (struck.of("time") - bare.strike)
    panels[0].plot(
        time, 1e-6 * struck.of("front_column.pressure"), color=style.THIRD, lw=0.8, label="ideal, no valves"
    )
    for axes, label in zip(
        panels,
        ("front legs [MPa]", "flow of a pair's valves [l/min]", "pin front_base [kN]", "canopy [deg]"),
        strict=True,
    ):
        axes.set(ylabel=label, xlim=(0.0, 120.0))
    for axes in panels[2:]:
        axes.set_xlabel("time after the strike [ms]")
    drawing.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    letters(panels)
    return drawing


def clearance_figure(found: Found, blows: Sequence[Blow]) -> Figure:
    """Peaks with clearance over those with ideal pins: rise of the leg pressure (a), pin force (b)."""
    drawing = Figure(figsize=style.size(170, 80))
    panels = list(drawing.subplots(1, 2))
    for axes, measure, title in zip(
        panels, ("rise", "pin_force"), ("rise of the pressure", "pin force"), strict=True
    ):
        for pins in ("one", "all"):
            chosen = [one for one in blows if one.pins == pins and one.valve]
            ideal = [found[measure, replace(one, pins="ideal").name].value for one in chosen]
            loose = [found[measure, one.name].value for one in chosen]
            axes.plot(
                [1e-3 * one.energy for one in chosen], np.divide(loose, ideal), "o" if pins == "all" else "s",
                color=LOOKS[pins][0], mfc="none", ms=4.5, ls="none", label=TITLES[pins],
            )  # fmt: skip
        axes.axhline(1.0, color="#777777", lw=0.8)
        axes.set(xscale="log", xlabel="energy of the block [kJ]", ylabel=f"{title}, over ideal pins")
    drawing.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    letters(panels)
    return drawing
