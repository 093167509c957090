"""What does 1.5 mm of clearance in the rear-link pin do to the rise? (Section 3 of the paper.)

The support stands still for 3 s, while the journal falls from the middle of its bore and comes to rest,
and rises by 500 mm in the next 2 s. Ideal pin against 1.5 mm, with friction and without.
"""

import sys
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common import paper_machine, rise
from studies.common.numbers import Number, by_case, compared, counted, measured, printed, rounded
from studies.common.options import Options
from studies.common.panels import WINDOWS, fit_height, legend
from studies.common.runs import impacts, run_cases
from studies.common.study import Study, StudyOutcome
from studies.common.words import TextTable
from support_exudyn import Result, Scenario
from support_exudyn.postprocessing.figures import style

CLEARANCE_MM = 1.5
IDEAL = "ideal"
DRY = f"{CLEARANCE_MM} mm, mu_d = {paper_machine.SLIDING_COEFFICIENT}"
SMOOTH = f"{CLEARANCE_MM} mm, mu_d = 0"
CASES = (IDEAL, SMOOTH, DRY)
STEP = 1e-3  # [s], which the accuracy does not use


def scenarios(quick: bool) -> dict[str, Scenario]:
    """The three cases."""
    rises = {
        SMOOTH: paper_machine.clearance_rise(CLEARANCE_MM, 0.0, STEP),
        DRY: paper_machine.clearance_rise(CLEARANCE_MM, paper_machine.SLIDING_COEFFICIENT, STEP),
        IDEAL: paper_machine.ideal_rise(STEP),
    }
    return {case: paper_machine.to_accuracy(rise, quick) for case, rise in rises.items()}


# --- measures ---


def velocity_deg(result: Result) -> rise.Series:
    """Angular velocity of the rear link [deg/s]."""
    return rise.DEGREES * result[rise.SPEED]


def acceleration_deg(result: Result) -> rise.Series:
    """Angular acceleration of the rear link [deg/s^2]."""
    return rise.DEGREES * result[rise.ACCELERATION]


# unit, measure, and what the paper prints of it, by clearance
OF_RISE: dict[str, tuple[str, Callable[[Result], float], Mapping[float, float] | None]] = {
    "mean_pin_force": ("N", lambda r: float(r[rise.FORCE][rise.in_rise(r)].mean()), paper_machine.MEAN_FORCE),
    "std_pin_force": ("N", lambda r: float(r[rise.FORCE][rise.in_rise(r)].std()), paper_machine.FORCE_SPREAD),
    "largest_pin_force": ("N", rise.Peak(rise.FORCE, begin=0.0), None),
    "largest_pin_force_in_rise": ("N", rise.Peak(rise.FORCE), None),
    "largest_angular_speed_in_rise": ("deg/s", rise.Peak(rise.SPEED, rise.DEGREES), None),
    "mean_angular_acceleration": (
        "deg/s^2", lambda r: float(acceleration_deg(r)[rise.in_rise(r)].mean()),
        paper_machine.MEAN_ACCELERATION,
    ),
    "std_angular_acceleration": ("deg/s^2", lambda r: float(acceleration_deg(r)[rise.in_rise(r)].std()), None),
}  # fmt: skip


def measure(results: Mapping[str, Result]) -> list[Number]:
    """All numbers of the study."""
    numbers = [
        Number(
            "stiffness_coefficient",
            f"{CLEARANCE_MM} mm",
            paper_machine.stiffness(CLEARANCE_MM) / 1e3**1.5,
            "N/mm^1.5",
            0.0,  # a closed form
            paper_machine.STIFFNESS[CLEARANCE_MM],
        )
    ]
    for case, result in results.items():
        numbers += _rise_numbers(case, result)
        if case != IDEAL:
            numbers += _comparison_numbers(case, result, results[IDEAL])
            numbers += _impact_numbers(case, result)
        numbers += _energy_numbers(case, result)
    return numbers


def _rise_numbers(case: str, result: Result) -> list[Number]:
    """Statistics over the records from 3 to 5 s, every 1 ms; the largest from 0 to 5 s."""
    # the paper has friction, though with data it does not give
    return [
        measured(name, case, unit, result, get, table[CLEARANCE_MM] if table and case == DRY else None)
        for name, (unit, get, table) in OF_RISE.items()
    ]


def _comparison_numbers(case: str, result: Result, ideal: Result) -> list[Number]:
    """What the clearance changes against the ideal pin, record by record, from 3 to 5 s."""

    def departure(channel: str, scale: float) -> Callable[[Result, Result], rise.Series]:
        return lambda run, other: scale * rise.departure(run, other, channel)

    force = departure(rise.FORCE, 1.0)
    speed = departure(rise.SPEED, rise.DEGREES)
    tip = departure("tip.x", 1e3)
    table: list[tuple[str, str, Callable[[Result, Result], float]]] = [
        ("rms_pin_force_departure", "N", lambda run, other: _rms(force(run, other))),
        ("rms_angular_velocity_departure", "deg/s", lambda run, other: _rms(speed(run, other))),
        ("mean_tip_shift", "mm", lambda run, other: float(tip(run, other).mean())),
    ]
    return [compared(name, case, unit, result, ideal, get) for name, unit, get in table]


def _impact_numbers(case: str, result: Result) -> list[Number]:
    """The first three impacts, and how many there are."""
    pin = paper_machine.CLEARANCE_PIN
    numbers = [counted("impacts", case, result, lambda r: len(r.onsets[pin]))]
    numbers.append(
        measured("largest_pin_force_any_step", case, "N", result, lambda r: float(r.largest_force[pin]))
    )
    for n in range(min(3, impacts(result, pin))):
        numbers += [
            measured(f"onset_{n + 1}_time", case, "s", result, rise.onset(pin, n, "time")),
            measured(f"onset_{n + 1}_speed", case, "m/s", result, rise.onset(pin, n, "speed")),
        ]
    return numbers


def _energy_numbers(case: str, result: Result) -> list[Number]:
    numbers = [measured("column_work", case, "J", result, lambda r: float(r["energy.work"][-1]))]
    if case != IDEAL:
        numbers.append(measured("energy_dissipated", case, "J", result, lambda r: r.dissipated))
    numbers.append(measured("energy_error", case, "J", result, lambda r: r.energy_error))
    return numbers


def _rms(values: rise.Series) -> float:
    return float(np.sqrt(np.mean(values**2)))


# --- figures ---


def figures(results: Mapping[str, Result]) -> dict[str, Figure]:
    """Counterparts of Fig. 3, 4 and 5, by file name."""
    return {
        "fig3_angular_velocity": _velocity_figure(results),
        "fig4_angular_acceleration": _line_figure(
            results,
            acceleration_deg,
            1.0,
            "angular acceleration\n[deg/s²]",
            "Angular acceleration of the rear link (paper: Fig. 4)",
        ),
        "fig5_pin_force": _line_figure(
            results,
            lambda r: r[rise.FORCE],
            1e-3,
            "pin force [kN]",
            "Force in the rear-link pin (paper: Fig. 5)",
        ),
    }


def _draw(
    axes: Axes, results: Mapping[str, Result], get: Callable[[Result], rise.Series], scale: float
) -> None:
    """The three cases, the most restless one undermost."""
    curves = [
        (
            DRY,
            style.WITH_CLEARANCE,
            0.9,
            "-",
            f"{CLEARANCE_MM} mm, friction {paper_machine.SLIDING_COEFFICIENT}",
        ),
        (SMOOTH, style.SMOOTH, 1.2, "-", f"{CLEARANCE_MM} mm, no friction"),
        (IDEAL, style.IDEAL, 1.0, (0, (4, 2)), "ideal pin"),
    ]
    for case, colour, width, dashes, label in curves:
        result = results[case]
        axes.plot(result.time, scale * get(result), color=colour, lw=width, ls=dashes, label=label)


def _velocity_figure(results: Mapping[str, Result]) -> Figure:
    drawing = Figure(figsize=style.size(170, 125))
    panels = drawing.subplots(2, 2)
    titles = ["a) 0 to 5 s"] + [f"{letter}) {name}" for letter, name in zip("bcd", WINDOWS, strict=True)]
    for axes, title in zip(panels.flat, titles, strict=True):
        _draw(axes, results, velocity_deg, 1.0)
        axes.set(title=title, xlabel="time [s]", ylabel="angular velocity [deg/s]")
    panels[0, 0].set_xlim(0.0, 5.0)
    for axes, window in zip(list(panels.flat)[1:], WINDOWS.values(), strict=True):
        axes.set_xlim(*window)
        fit_height(axes, (velocity_deg(r)[rise.between(r, *window)] for r in results.values()))
        panels[0, 0].axvspan(*window, color="#eeeeee", zorder=0)
    legend(drawing, panels[0, 0], 3)
    drawing.suptitle("Angular velocity of the rear link (paper: Fig. 3). Grey in a): enlarged in b) to d)")
    return drawing


def _line_figure(
    results: Mapping[str, Result], get: Callable[[Result], rise.Series], scale: float, label: str, title: str
) -> Figure:
    """The whole run above, the rise alone below on its own scale: the first impacts dwarf the rest."""
    drawing = Figure(figsize=style.size(170, 125))
    whole, part = drawing.subplots(2, 1)
    for axes in (whole, part):
        _draw(axes, results, get, scale)
        axes.set(xlabel="time [s]", ylabel=label)
    whole.set(xlim=(0.0, 5.0), title="a) 0 to 5 s, start with the journal in the middle of its bore")
    part.set(xlim=(rise.START, rise.END), title="b) the rise, 3 to 5 s")
    inside = rise.START + 1e-3, rise.END - 1e-3
    fit_height(part, (scale * get(r)[rise.between(r, *inside)] for r in results.values()))
    legend(drawing, whole, 3)
    drawing.suptitle(title)
    return drawing


# --- table ---


def table(numbers: Sequence[Number]) -> TextTable:
    """All numbers, a row a name, a column a case."""
    by_name: dict[str, dict[str, Number]] = {}
    for number in numbers:
        by_name.setdefault(number.name, {})[number.case] = number
    rows = tuple(_row(name, row) for name, row in by_name.items())
    return TextTable(("quantity", "unit", *CASES, "paper"), rows, left=2)


def _row(name: str, row: Mapping[str, Number]) -> tuple[str, ...]:
    any_case = f"{CLEARANCE_MM} mm"
    cells = [rounded(row[c].value, row[c].numerical_error) if c in row else "" for c in CASES]
    if any_case in row:
        cells[1] = cells[2] = rounded(row[any_case].value, row[any_case].numerical_error)
    of_paper = next((n for n in row.values() if n.paper is not None), None)
    return name.replace("_", " "), next(iter(row.values())).unit, *cells, printed(of_paper)


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """The three rises, their numbers, figures and table."""
    cases = scenarios(chosen.quick)
    results = run_cases(cases, chosen)
    numbers = measure(results)
    words = {
        "found": by_case(numbers), "goal": cases[DRY].goal, "run": sys.modules[__name__],
        "paper": paper_machine,
    }  # fmt: skip
    return StudyOutcome(numbers, words, figures(results), {"table": table(numbers)}, results)


study = Study("clearance_influence", __doc__, work)
main = study.main
