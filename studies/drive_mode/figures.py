"""Counterparts of Fig. 13 of the paper."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from studies.common import rise
from studies.common.chapter import Picture
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style

MODES = {"mode 1": style.SMOOTH, "mode 2": style.LOOSE}
PINS = ("ideal pin", "1.5 mm")
BEFORE, AFTER = 2.9, 5.0  # shown [s]


def figures(results: Mapping[str, Result]) -> dict[str, Figure]:
    """All figures, by file name: both pins on rigid columns and on oil, and the first moments of both modes."""
    return {
        "fig13_rigid_columns": four_panels(results, "rigid"),
        "fig13_oil_columns": four_panels(results, "oil"),
        "start_of_mode_1": start_figure(results),
    }


def pictures() -> tuple[Picture, ...]:
    """The figures with what they show."""
    common = (
        "Extension of the columns (a), angular velocity (b), angular acceleration (c) of the rear link and "
        "pin force (d) in both drive modes; full lines 1.5 mm, dashed the ideal pin. Counterpart of the "
        "paper's Fig. 13"
    )
    return (
        Picture("fig13_rigid_columns", f"{common}, on rigid columns. What is out of scale at 3 s is finite "
            f"but tells of the contact's stiffness."),
        Picture("fig13_oil_columns", f"{common}, on columns of oil."),
        Picture("start_of_mode_1", "Pin force and column forces in the first 0.4 s of mode 1, on columns of "
            "oil."),
    )  # fmt: skip


def four_panels(results: Mapping[str, Result], columns: str) -> Figure:
    """The paper's four panels."""
    drawing = Figure(figsize=style.size(170, 135))
    panels = list(drawing.subplots(2, 2).flat)
    shown = [
        (rise.SPEED, rise.DEGREES, "angular velocity [deg/s]"),
        (rise.ACCELERATION, rise.DEGREES, "angular acceleration [deg/s²]"),
        (rise.FORCE, 1e-3, "pin force [kN]"),
    ]
    for mode, colour in MODES.items():
        run = results[f"{mode}, ideal pin, {columns} columns"]
        drive = run.scenario.drive
        inside = rise.between(run, BEFORE, AFTER)
        extension = [1e3 * drive.extension(float(t)) for t in run.time[inside]]
        panels[0].plot(run.time[inside], extension, color=colour, label=mode)
    panels[0].set_ylabel("extension of columns [mm]")
    for axes, (channel, scale, label) in zip(panels[1:], shown, strict=True):
        for mode, colour in MODES.items():
            for pin in reversed(PINS):
                _curve(axes, results[f"{mode}, {pin}, {columns} columns"], channel, scale, colour, pin)
        axes.set_ylabel(label)
        _scale(axes, results, channel, scale, columns)
    for axes, letter in zip(panels, "abcd", strict=True):
        axes.set(xlim=(BEFORE, AFTER), xlabel="time [s]")
        axes.set_title(f"{letter})")
    drawing.legend(handles=_key(), loc="outside lower center", ncols=3)
    drawing.suptitle(
        f"Drive modes on {'rigid columns' if columns == 'rigid' else 'columns of oil'} (paper: Fig. 13)"
    )
    return drawing


def _key() -> list[Line2D]:
    """Handles of the legend."""
    modes = [Line2D([], [], color=colour, label=f"{mode}, 1.5 mm") for mode, colour in MODES.items()]
    return [*modes, Line2D([], [], color=style.IDEAL, ls=(0, (4, 2)), label="ideal pin, both modes")]


def start_figure(results: Mapping[str, Result]) -> Figure:
    """What the sudden start does, enlarged."""
    drawing = Figure(figsize=style.size(170, 75))
    panels = drawing.subplots(1, 3, sharex=True)
    channels = {"pin": rise.FORCE, "front columns": "front_column.force", "rear columns": "rear_column.force"}
    for axes, letter, (name, channel) in zip(panels, "abc", channels.items(), strict=True):
        for pin, colour, dashes in ((PINS[1], style.LOOSE, "-"), (PINS[0], style.IDEAL, (0, (4, 2)))):
            run = results[f"mode 1, {pin}, oil columns"]
            inside = rise.between(run, 2.95, 3.4)
            axes.plot(run.time[inside], 1e-3 * run[channel][inside], color=colour, ls=dashes, lw=0.9, label=pin)
        axes.set(title=f"{letter}) {name}", xlabel="time [s]", ylabel="force [kN]", xlim=(2.95, 3.4))
    drawing.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    drawing.suptitle("Mode 1 starts: forces on columns of oil")
    return drawing


def _curve(axes: Axes, run: Result, channel: str, scale: float, colour: str, pin: str) -> None:
    inside = rise.between(run, BEFORE, AFTER)
    dashes = (0, (4, 2)) if pin == PINS[0] else "-"
    shade = style.IDEAL if pin == PINS[0] else colour
    axes.plot(run.time[inside], scale * run[channel][inside], color=shade, ls=dashes, lw=0.8)


def _scale(axes: Axes, results: Mapping[str, Result], channel: str, scale: float, columns: str) -> None:
    """A scale that fits all but the rarest values."""
    values = np.concatenate(
        [
            scale
            * results[f"{mode}, {pin}, {columns} columns"][channel][
                rise.between(results[f"{mode}, {pin}, {columns} columns"], BEFORE, AFTER)
            ]
            for mode in MODES
            for pin in PINS
        ]
    )
    low, high = np.quantile(values, (0.002, 0.998))
    axes.set_ylim(low - 0.1 * (high - low), high + 0.1 * (high - low))
