"""The rise by valves over time, and its start enlarged."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.figure import Figure

from studies.common import rise
from studies.common.panels import legend, letters
from studies.valve_modes.cases import LONG, MODES, PINS, PUMPS, START, case_name
from studies.valve_modes.measures import ROWS, extension
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style

COLOURS = dict(zip(ROWS, (style.SMOOTH, style.WITH_CLEARANCE), strict=True))
DASHES = (0, (4, 2))
ENLARGED = (START - 0.01, START + 0.25)


def figures(results: Mapping[str, Result]) -> dict[str, Figure]:
    """Both figures, by file name."""
    return {"rise_by_valves": rise_figure(results), "opening": start_figure(results)}


def rise_figure(results: Mapping[str, Result]) -> Figure:
    """Extensions of both rows, and the pump's pressure, in both modes on the limited pump."""
    drawing = Figure(figsize=style.size(170, 100))
    panels = drawing.subplots(2, 2, sharex=True, sharey="row")
    for place, mode in enumerate(MODES):
        run = results[case_name(mode, PUMPS[0], PINS[0])]
        upper, lower = panels[:, place]
        for row in ROWS:
            upper.plot(run.time, 1e3 * extension(run, row), color=COLOURS[row], label=f"{row} columns")
        lower.plot(run.time, 1e-6 * run["pump.pressure"], color=style.IDEAL, lw=0.9)
        upper.set_title(mode, fontsize=9)
        lower.set_xlabel("time [s]")
        lower.set_xlim(START - 0.5, LONG + 1.0)
    panels[0, 0].set_ylabel("extension [mm]")
    panels[1, 0].set_ylabel("pump [MPa]")
    letters(list(panels.flat))
    legend(drawing, panels[0, 0], 2)
    return drawing


def start_figure(results: Mapping[str, Result]) -> Figure:
    """Pressures, cavities and the pin's force just after the valve opens, on the limited pump."""
    drawing = Figure(figsize=style.size(170, 130))
    panels = drawing.subplots(3, 2, sharex=True, sharey="row")
    for place, mode in enumerate(MODES):
        boils, pulls = (results[case_name(mode, PUMPS[0], PINS[0], oil)] for oil in ("boils", "pulls"))
        inside = rise.between(boils, *ENLARGED)
        time = 1e3 * (boils.time[inside] - START)
        for row in ROWS:
            for run, dashes in ((boils, "-"), (pulls, DASHES)):
                values = 1e-6 * run[f"{row}_column.pressure"][inside]
                said = f"{row} columns" if run is boils else f"{row} columns, oil that pulls"
                panels[0, place].plot(time, values, color=COLOURS[row], ls=dashes, lw=1.0, label=said)
            cavity = 1e6 * boils[f"{row}_column.cavity"][inside]
            panels[1, place].plot(time, cavity, color=COLOURS[row])
        for run, dashes in ((boils, "-"), (pulls, DASHES)):
            panels[2, place].plot(time, 1e-3 * run[rise.FORCE][inside], color=style.IDEAL, ls=dashes)
        panels[0, place].axhline(0.0, color="0.6", lw=0.6, zorder=0)
        panels[0, place].set_title(mode, fontsize=9)
        panels[-1, place].set_xlabel("time since the valve opens [ms]")
    for axes, label in zip(panels[:, 0], ("pressure [MPa]", "cavity [ml]", "pin force [kN]"), strict=True):
        axes.set_ylabel(label)
    letters(list(panels.flat))
    legend(drawing, panels[0, 0], 2)
    return drawing
