"""The drive modes on hydraulic cylinders: what an inlet does that a prescribed displacement does not."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from studies.common import paper_machine, rise
from studies.common.chapter import Picture, Sheet
from studies.common.study import Number, brief
from studies.common.wording import by_case
from support_exudyn import CubicStep, Drive, Result, Scenario, UniformSpeed
from support_exudyn.postprocessing.figures import style

END = 5.4  # so that what rings after the valve has closed is seen [s]
LATE = 5.2  # from here on it is taken as settled in the mean [s]
DRIVES: dict[str, Drive] = {"mode 1": UniformSpeed(), "mode 2": CubicStep()}
COLOURS = {"mode 1": style.SMOOTH, "mode 2": style.LOOSE}
PAIRS = {"front": style.SMOOTH, "rear": style.LOOSE}
PINS = ("ideal pin", "1.5 mm")
DASHES = (0, (4, 2))
MIDDLE = (3.6, 4.4)  # of the rise, ramps of mode 2 excluded [s]

Get = Callable[[Result], float]


def case_name(mode: str, pin: str) -> str:
    """Name of a case."""
    return f"{mode}, {pin}, cylinder columns"


def scenario(base: Scenario, mode: str) -> Scenario:
    """The run on cylinders with the inlet of a mode."""
    return replace(paper_machine.on_cylinders(base, paper_machine.INLETS[mode]), duration=END)


# --- measures ---


def extension(result: Result, column: str) -> np.ndarray:
    """Of a column since the start (n,) [m]."""
    length = result[f"{column}.length"]
    return np.asarray(length - length[0])


def _after(result: Result, time: float = rise.START) -> np.ndarray:
    return np.asarray(result.time >= time - 1e-9)


def _of_column(column: str) -> dict[str, tuple[str, Get]]:
    short, pressure = column.partition("_")[0], f"{column}.pressure"

    def speed(r: Result) -> float:
        begin, end = np.searchsorted(r.time, np.array(MIDDLE) - 1e-9)
        moved = extension(r, column)
        return float(1e3 * (moved[end] - moved[begin]) / (r.time[end] - r.time[begin]))

    def settled(r: Result) -> float:
        return float(1e3 * extension(r, column)[_after(r, LATE)].mean())

    return {
        f"speed_in_mid_rise_{short}": ("mm/s", speed),
        f"extension_at_5s_{short}": (
            "mm",
            lambda r: float(1e3 * np.interp(rise.END, r.time, extension(r, column))),
        ),
        f"settled_extension_{short}": ("mm", settled),
        f"overshoot_{short}": ("mm", lambda r: float(1e3 * extension(r, column).max()) - settled(r)),
        f"largest_pressure_{short}": (
            "MPa",
            rise.Peak(pressure, 1e-6, end=math.inf, extreme="max"),
        ),
        f"least_pressure_{short}": ("MPa", rise.Peak(pressure, 1e-6, end=math.inf, extreme="min")),
        f"pressure_after_{short}": (
            "MPa",
            lambda r: float(1e-6 * r[f"{column}.pressure"][_after(r, LATE)].mean()),
        ),
        f"largest_flow_{short}": ("l/min", rise.Peak(f"{column}.flow", 6e4, begin=0.0, end=math.inf)),
    }


MEASURES: dict[str, tuple[str, Get]] = {
    **_of_column("front_column"),
    **_of_column("rear_column"),
    "largest_pin_force_after_closing": ("N", rise.Peak(rise.FORCE, begin=rise.END, end=math.inf)),
    "loss_in_valves": ("kJ", lambda r: float(1e-3 * r["energy.damping_loss"][-1])),
    "work_of_pumps": ("kJ", lambda r: float(1e-3 * r["energy.work"][-1])),
}


def sheet(numbers: Sequence[Number]) -> Sheet:
    """What there is on cylinders only."""
    found = by_case(numbers)
    cases = [case_name(mode, pin) for pin in PINS for mode in DRIVES]
    rows = []
    for name, (unit, _) in MEASURES.items():
        cells = (brief(found[name, case].value, found[name, case].numerical_error) for case in cases)
        rows.append((name.replace("_", " "), unit, *cells))
    return Sheet(
        "Motion, pressures and flow of the cylinders",
        ("quantity", "unit", *(f"{mode}, {pin}" for pin in PINS for mode in DRIVES)),
        tuple(rows),
        "Pressures and flows of the piston side of a pair, from 3 s on; settled and after: means from "
        f"{LATE:g} s on. Losses include seals and contacts. No liquid bears a pressure below 0: "
        "there a real column would cavitate. ± is the estimated error.",
        left=2,
    )


def findings(numbers: Sequence[Number]) -> tuple[str, ...]:
    """What the inlet does that a displacement does not."""
    found = by_case(numbers)
    ideal, loose = PINS
    speeds = [found[f"speed_in_mid_rise_{pair}", case_name("mode 1", ideal)].value for pair in PAIRS]
    heat = [100.0 * found["loss_in_valves", case_name(mode, ideal)].value for mode in DRIVES]
    work = [found["work_of_pumps", case_name(mode, ideal)].value for mode in DRIVES]
    shares = [lost / done for lost, done in zip(heat, work, strict=True)]

    def said(name: str, mode: str, digits: int = 2) -> str:
        return f"{found[name, case_name(mode, ideal)].value:.{digits}f}"

    def of_both(name: str) -> str:
        one, two = (1e-3 * found[name, case_name(mode, loose)].value for mode in DRIVES)
        return f"{one:.0f} kN in mode 1 and {two:.0f} kN in mode 2"

    def peaks(name: str, columns: str) -> str:
        one, two = (1e-3 * found[name, f"{mode}, {loose}, {columns} columns"].value for mode in DRIVES)
        return f"{one:.0f} and {two:.0f} kN"

    force, front = "largest_pin_force_in_rise", "largest_front_column_force"
    return (
        "On hydraulic cylinders the speed follows the load: in mid-rise of mode 1 the front columns extend at "
        f"{speeds[0]:.2f} mm/s, the rear ones, which carry more, at {speeds[1]:.2f} mm/s "
        f"({100 * (speeds[1] / speeds[0] - 1):+.2f} %); in the end they are "
        f"{said('settled_extension_front', 'mode 1', 1)} and {said('settled_extension_rear', 'mode 1', 1)} mm "
        "longer, where a displacement drive makes it 500 mm for both.",
        f"In mode 1 the columns swing {said('overshoot_front', 'mode 1')} mm (front) and "
        f"{said('overshoot_rear', 'mode 1')} mm (rear) beyond where they come to rest, in mode 2 "
        f"{said('overshoot_front', 'mode 2', 3)} and {said('overshoot_rear', 'mode 2', 3)} mm (ideal pin).",
        f"Pressure under the rear pistons rises to {said('largest_pressure_rear', 'mode 1')} MPa in mode 1 and "
        f"{said('largest_pressure_rear', 'mode 2')} MPa in mode 2 (ideal pin) and settles at "
        f"{said('pressure_after_rear', 'mode 1')} and {said('pressure_after_rear', 'mode 2')} MPa; "
        "the least under the front ones is "
        f"{said('least_pressure_front', 'mode 1')} and {said('least_pressure_front', 'mode 2')} MPa. Below 0 a "
        "real column would cavitate.",
        "With 1.5 mm the largest pin force of the rise is, in modes 1 and 2, "
        f"{peaks(force, 'cylinder')} on cylinders and {peaks(force, 'oil')} on oil columns that a displacement "
        f"drives; the largest force of the front columns {peaks(front, 'cylinder')}, by displacement "
        f"{peaks(front, 'oil')}.",
        f"Closing the valve strikes, too: from 5 s on the largest pin force is "
        f"{of_both('largest_pin_force_after_closing')}, where that of the rise is {of_both(force)} (1.5 mm).",
        f"Valves and seals turn {shares[0]:.1f} % (mode 1) and {shares[1]:.1f} % (mode 2) of the pumps' work "
        "into heat: the load needs so little of the pump's pressure that the valve sets the flow, and the "
        "inlet is almost a displacement drive with oil.",
    )


# --- figures ---


def figures(results: Mapping[str, Result]) -> dict[str, Figure]:
    """Figures by file name: the rise on cylinders, and what opening and closing at once does."""
    return {"cylinders": rise_figure(results), "cylinders_mode_1": valve_figure(results)}


def pictures() -> tuple[Picture, ...]:
    """The figures with what they show."""
    return (
        Picture(
            "cylinders",
            "The rise on hydraulic cylinders: how far the front columns are behind the displacement drive of "
            "the mode (a), their speed (b), pressure under the rear pistons (c) and pin force (d). Full lines "
            "1.5 mm, dashed in c and d the ideal pin; dotted in b the displacement drives.",
        ),
        Picture(
            "cylinders_mode_1",
            "Valves open (left) and close (right) at once, ideal pin: pressures of the piston side (above) "
            "and force of the columns (below), full lines; dashed: force of oil columns driven by "
            "displacement, until 5.1 s. Below 0 MPa a real column would cavitate.",
        ),
    )


def rise_figure(results: Mapping[str, Result]) -> Figure:
    """Motion, pressure and pin force over the rise."""
    drawing = Figure(figsize=style.size(170, 135))
    panels = list(drawing.subplots(2, 2).flat)
    for mode, colour in COLOURS.items():
        drive = DRIVES[mode]
        for pin in reversed(PINS):
            run = results[case_name(mode, pin)]
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
    labels = (
        "behind the drive [mm]",
        "speed, front [mm/s]",
        "pressure, rear [MPa]",
        "pin force [kN]",
    )
    for axes, letter, label in zip(panels, "abcd", labels, strict=True):
        axes.set(xlim=(2.9, END), xlabel="time [s]", ylabel=label)
        axes.set_title(f"{letter})")
    handles = [Line2D([], [], color=colour, label=f"{mode}, 1.5 mm") for mode, colour in COLOURS.items()]
    handles.append(Line2D([], [], color=style.IDEAL, ls=DASHES, label="ideal pin, both modes"))
    handles.append(Line2D([], [], color=style.IDEAL, ls=":", lw=1.2, label="displacement drives"))
    drawing.legend(handles=handles, loc="outside lower center", ncols=2)
    drawing.suptitle("The rise on hydraulic cylinders")
    return drawing


def valve_figure(results: Mapping[str, Result]) -> Figure:
    """Opening and closing at once, enlarged."""
    drawing = Figure(figsize=style.size(170, 120))
    panels = drawing.subplots(2, 2, sharey="row")
    run, driven = results[case_name("mode 1", PINS[0])], results[f"mode 1, {PINS[0]}, oil columns"]
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
