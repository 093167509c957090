"""Counterparts of Fig. 13 of the paper, and the rise on hydraulic cylinders."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from studies.common import rise
from studies.common.panels import legend
from studies.drive_mode.cases import END, PINS, case_name
from studies.drive_mode.cases import MODES as DRIVES
from studies.drive_mode.measures import extension
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style

MODES = {"mode 1": style.SMOOTH, "mode 2": style.WITH_CLEARANCE}
PAIRS = {"front": style.SMOOTH, "rear": style.WITH_CLEARANCE}
DASHES = (0, (4, 2))
BEFORE, AFTER = 2.9, 5.0  # shown [s]


def figures(results: Mapping[str, Result]) -> dict[str, Figure]:
    """All figures, by file name."""
    return {
        "fig13_rigid_columns": four_panels(results, "rigid"),
        "fig13_oil_columns": four_panels(results, "oil"),
        "start_of_mode_1": start_figure(results),
        "cylinders": rise_figure(results),
        "cylinders_mode_1": valve_figure(results),
    }


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
        run = results[case_name(mode, PINS[0], columns)]
        drive = run.scenario.drive
        inside = rise.between(run, BEFORE, AFTER)
        extension = [1e3 * drive.extension(float(t)) for t in run.time[inside]]
        panels[0].plot(run.time[inside], extension, color=colour, label=mode)
    panels[0].set_ylabel("extension of columns [mm]")
    for axes, (channel, scale, label) in zip(panels[1:], shown, strict=True):
        for mode, colour in MODES.items():
            for pin in reversed(PINS):
                _curve(axes, results[case_name(mode, pin, columns)], channel, scale, colour, pin)
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
    return [*modes, Line2D([], [], color=style.IDEAL, ls=DASHES, label="ideal pin, both modes")]


def start_figure(results: Mapping[str, Result]) -> Figure:
    """What the sudden start does, enlarged."""
    drawing = Figure(figsize=style.size(170, 75))
    panels = drawing.subplots(1, 3, sharex=True)
    channels = {"pin": rise.FORCE, "front columns": "front_column.force", "rear columns": "rear_column.force"}
    for axes, letter, (name, channel) in zip(panels, "abc", channels.items(), strict=True):
        for pin, colour, dashes in ((PINS[1], style.WITH_CLEARANCE, "-"), (PINS[0], style.IDEAL, DASHES)):
            run = results[case_name("mode 1", pin, "oil")]
            inside = rise.between(run, 2.95, 3.4)
            axes.plot(run.time[inside], 1e-3 * run[channel][inside], color=colour, ls=dashes, lw=0.9, label=pin)
        axes.set(title=f"{letter}) {name}", xlabel="time [s]", ylabel="force [kN]", xlim=(2.95, 3.4))
    legend(drawing, panels[0], 2)
    drawing.suptitle("Mode 1 starts: forces on columns of oil")
    return drawing


def _curve(axes: Axes, run: Result, channel: str, scale: float, colour: str, pin: str) -> None:
    inside = rise.between(run, BEFORE, AFTER)
    dashes = DASHES if pin == PINS[0] else "-"
    shade = style.IDEAL if pin == PINS[0] else colour
    axes.plot(run.time[inside], scale * run[channel][inside], color=shade, ls=dashes, lw=0.8)


def _scale(axes: Axes, results: Mapping[str, Result], channel: str, scale: float, columns: str) -> None:
    """A scale that fits all but the rarest values."""
    values = np.concatenate(
        [
            scale
            * results[case_name(mode, pin, columns)][channel][
                rise.between(results[case_name(mode, pin, columns)], BEFORE, AFTER)
            ]
            for mode in MODES
            for pin in PINS
        ]
    )
    low, high = np.quantile(values, (0.002, 0.998))
    axes.set_ylim(low - 0.1 * (high - low), high + 0.1 * (high - low))


def rise_figure(results: Mapping[str, Result]) -> Figure:
    """Motion, pressure and pin force over the rise."""
    drawing = Figure(figsize=style.size(170, 135))
    panels = list(drawing.subplots(2, 2).flat)
    for mode, colour in MODES.items():
        drive = DRIVES[mode]
        for pin in reversed(PINS):
            run = results[case_name(mode, pin, "cylinder")]
            inside = rise.between(run, 2.9, END)
            t = run.time[inside]
            look = {"color": style.IDEAL, "ls": DASHES} if pin == PINS[0] else {"color": colour}
            driven = np.array([drive.extension(at) for at in t.tolist()])
            behind = 1e3 * (driven - extension(run, "front_column")[inside])
            speed = 1e3 * np.gradient(extension(run, "front_column")[inside], t)
            if pin != PINS[0]:  # hardly anything else with the ideal pin
                panels[0].plot(t, behind, lw=0.8, **look)
                panels[1].plot(t, speed, lw=0.8, **look)
            panels[2].plot(t, 1e-6 * run["rear_column.pressure"][inside], lw=0.8, **look)
            panels[3].plot(t, 1e-3 * run[rise.FORCE][inside], lw=0.8, **look)
        panels[1].plot(t, [1e3 * drive.speed(at) for at in t.tolist()], color=style.IDEAL, ls=":", lw=1.2)
    labels = ("behind the drive [mm]", "speed, front [mm/s]", "pressure, rear [MPa]", "pin force [kN]")
    for axes, letter, label in zip(panels, "abcd", labels, strict=True):
        axes.set(xlim=(2.9, END), xlabel="time [s]", ylabel=label)
        axes.set_title(f"{letter})")
    handles = [Line2D([], [], color=colour, label=f"{mode}, 1.5 mm") for mode, colour in MODES.items()]
    handles.append(Line2D([], [], color=style.IDEAL, ls=DASHES, label="ideal pin, both modes"))
    handles.append(Line2D([], [], color=style.IDEAL, ls=":", lw=1.2, label="displacement drives"))
    drawing.legend(handles=handles, loc="outside lower center", ncols=2)
    drawing.suptitle("The rise on hydraulic cylinders")
    return drawing


def valve_figure(results: Mapping[str, Result]) -> Figure:
    """Opening and closing at once, enlarged."""
    drawing = Figure(figsize=style.size(170, 120))
    panels = drawing.subplots(2, 2, sharey="row")
    run, driven = (
        results[case_name("mode 1", PINS[0], "cylinder")],
        results[case_name("mode 1", PINS[0], "oil")],
    )
    for place, (begin, end) in enumerate(((2.95, 3.3), (4.95, 5.3))):
        for pair, colour in PAIRS.items():
            _piece(panels[0, place], run, f"{pair}_column.pressure", 1e-6, (begin, end), colour, "-")
            _piece(panels[1, place], run, f"{pair}_column.force", 1e-3, (begin, end), colour, "-")
            _piece(panels[1, place], driven, f"{pair}_column.force", 1e-3, (begin, end), colour, DASHES)
        panels[0, place].axhline(0.0, color="0.6", lw=0.6, zorder=0)
        panels[0, place].set_title(f"{'ab'[place]}) {('opens', 'closes')[place]}")
        panels[1, place].set_title(f"{'cd'[place]})")
        for axes in panels[:, place]:
            axes.set(xlim=(begin, end), xlabel="time [s]", xticks=np.arange(begin + 0.05, end - 0.01, 0.1))
    panels[0, 0].set_ylabel("pressure [MPa]")
    panels[1, 0].set_ylabel("column force [kN]")
    handles = [Line2D([], [], color=colour, label=f"{pair} columns") for pair, colour in PAIRS.items()]
    handles.append(Line2D([], [], color="0.3", ls=DASHES, label="oil, by displacement"))
    drawing.legend(handles=handles, loc="outside lower center", ncols=3)
    drawing.suptitle("Mode 1: the valves open and close at once")
    return drawing


def _piece(
    axes: Axes,
    run: Result,
    channel: str,
    scale: float,
    limits: tuple[float, float],
    colour: str,
    dashes: object,
) -> None:
    inside = rise.between(run, *limits)
    axes.plot(run.time[inside], scale * run[channel][inside], color=colour, ls=dashes, lw=0.9)
