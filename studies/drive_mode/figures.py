"""Counterparts of Fig. 13 of the paper, and the rise on hydraulic cylinders."""

from collections.abc import Callable, Mapping

import numpy as np
from matplotlib.figure import Figure

from studies.common import rise
from studies.common.panels import finish
from studies.common.study import LivePanels
from studies.drive_mode.cases import END, MODES, ModePlan, case_name
from studies.drive_mode.measures import extension
from support_exudyn import Result, SuddenOpening
from support_exudyn.postprocessing.figures import style

DASHES = (0, (4, 2))
# panels to look into, by figure
PIN_FORCES = {6: "pin force, mode 1 [kN]", 7: "pin force, mode 2 [kN]"}
LIVE: dict[str, LivePanels] = {
    "fig13_rigid_columns": PIN_FORCES, "fig13_oil_columns": PIN_FORCES,
    "cylinders": {2: "speed, front, mode 1 [mm/s]", 4: "pressure, rear, mode 1 [MPa]", **PIN_FORCES},
}  # fmt: skip
Curve = Callable[[Result], rise.Series]  # what is drawn of a run at its records


def figures(plan: ModePlan, results: Mapping[str, Result]) -> dict[str, Figure]:
    """All figures, by file name."""
    found = {
        f"fig13_{columns}_columns": by_mode(plan, results, columns, _of_motion(plan))
        for columns in ("oil", "rigid")
        if columns in plan.columns
    }
    if plan.subject.is_paper:
        found |= {
            "cylinders": by_mode(plan, results, "cylinder", ON_CYLINDERS),
        }
    return found


def _of_motion(plan: ModePlan) -> dict[str, Curve]:
    watched, first = plan.subject.watched, plan.actuators[0]

    def of(channel: str, scale: float) -> Curve:
        return lambda run: scale * run[channel]

    return {
        "extension [mm]": lambda run: 1e3 * extension(run, first),
        "angular velocity\n[deg/s]": of(watched.speed, rise.DEGREES),
        "angular acceleration\n[deg/s²]": of(watched.acceleration, rise.DEGREES),
        "pin force [kN]": of(watched.force, 1e-3),
    }


def _behind(run: Result) -> rise.Series:
    """How far the front columns are behind the displacement drive of the mode [mm]."""
    sudden = isinstance(run.scenario.valved["front_column"].inlet, SuddenOpening)
    drive = MODES["mode 1" if sudden else "mode 2"]()
    driven = np.array([drive.extension(t) for t in run.time.tolist()])
    return np.asarray(1e3 * (driven - extension(run, "front_column")))


ON_CYLINDERS: dict[str, Curve] = {
    "behind the drive\n[mm]": _behind,
    "speed, front\n[mm/s]": lambda run: 1e3 * np.gradient(extension(run, "front_column"), run.time),
    "pressure, rear\n[MPa]": lambda run: 1e-6 * run["rear_column.pressure"],
    "pin force [kN]": lambda run: 1e-3 * run[rise.FORCE],
}


def by_mode(plan: ModePlan, results: Mapping[str, Result], columns: str, curves: Mapping[str, Curve]) -> Figure:
    """A column of panels for each mode, a row for each quantity, with the same scale in both."""
    drawing = Figure(figsize=style.size(170, 165))
    panels = drawing.subplots(len(curves), 2, sharey="row", sharex=True)
    watched = plan.subject.watched
    margin = 0.05 * (watched.end - watched.start)
    end = END if columns == "cylinder" else watched.end + margin
    for place, mode in enumerate(MODES):
        for axes, (label, curve) in zip(panels[:, place], curves.items(), strict=True):
            for pin, colour, dashes, width in (
                (plan.pins[1], style.WITH_CLEARANCE, "-", 1.0), (plan.pins[0], style.IDEAL, DASHES, 0.8),
            ):  # fmt: skip
                run = results[case_name(mode, pin, columns)]
                inside = rise.between(run, watched.start - margin, end)
                axes.plot(run.time[inside], curve(run)[inside], color=colour, ls=dashes, lw=width, label=pin)
            if place == 0:
                axes.set_ylabel(label)
            axes.set_xlim(watched.start - margin, end)
            axes.set_xticks(np.linspace(watched.start, watched.end, 5))
        panels[0, place].annotate(
            mode, (0.5, 1.0), (0.0, 4.0), "axes fraction", "offset points", ha="center", fontsize=9
        )
        panels[-1, place].set_xlabel("time [s]")
    drawing.align_ylabels(panels[:, 0])
    return finish(drawing, panels, 2)
