"""What does 1.5 mm of clearance in the rear-link pin do to the rise? (Section 3 of the paper.)

The support stands still for 3 s, while the journal falls from the middle of its bore and comes to rest,
and rises by 500 mm in the next 2 s. Ideal pin against 1.5 mm, with friction and without.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common import paper_machine, rise
from studies.common.chapter import Chapter, Picture, Sheet
from studies.common.study import (
    Number,
    Options,
    compared,
    counted,
    measured,
    options,
    rounded,
    run_cases,
    run_main,
    save_figures,
    save_run,
    show_table,
    touches,
    write_summary,
)
from studies.common.wording import against, by_case, how_sure, percent, said
from support_exudyn import Result, Scenario
from support_exudyn.postprocessing.figures import style

STUDY = "clearance_influence"
CLEARANCE_MM = 1.5
IDEAL = "ideal"
DRY = f"{CLEARANCE_MM} mm, mu_d = {paper_machine.SLIDING_COEFFICIENT}"
SMOOTH = f"{CLEARANCE_MM} mm, mu_d = 0"
CASES = (IDEAL, SMOOTH, DRY)
STEP = 1e-3  # [s], which the accuracy does not use
WINDOWS = {"early": (3.0, 3.12), "middle": (4.0, 4.12), "late": (4.6, 4.72)}  # enlarged in Fig. 3 [s]


def scenarios(quick: bool) -> dict[str, Scenario]:
    """The three cases."""
    rises = {
        SMOOTH: paper_machine.loose_rise(CLEARANCE_MM, 0.0, STEP),
        DRY: paper_machine.loose_rise(CLEARANCE_MM, paper_machine.SLIDING_COEFFICIENT, STEP),
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
    printed = case == DRY  # the paper has friction, though with data it does not give
    table: list[tuple[str, str, Callable[[Result], float], float | None]] = [
        (
            "mean_pin_force",
            "N",
            lambda r: float(r[rise.FORCE][rise.in_rise(r)].mean()),
            paper_machine.MEAN_FORCE[CLEARANCE_MM],
        ),
        (
            "std_pin_force",
            "N",
            lambda r: float(r[rise.FORCE][rise.in_rise(r)].std()),
            paper_machine.FORCE_SPREAD[CLEARANCE_MM],
        ),
        ("largest_pin_force", "N", rise.Peak(rise.FORCE, begin=0.0), None),
        ("largest_pin_force_in_rise", "N", rise.Peak(rise.FORCE), None),
        ("largest_angular_speed_in_rise", "deg/s", rise.Peak(rise.SPEED, rise.DEGREES), None),
        (
            "mean_angular_acceleration",
            "deg/s^2",
            lambda r: float(acceleration_deg(r)[rise.in_rise(r)].mean()),
            paper_machine.MEAN_ACCELERATION[CLEARANCE_MM],
        ),
        (
            "std_angular_acceleration",
            "deg/s^2",
            lambda r: float(acceleration_deg(r)[rise.in_rise(r)].std()),
            None,
        ),
    ]
    return [
        measured(name, case, unit, result, measure, paper if printed else None)
        for name, unit, measure, paper in table
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
    """The first three touches, and how many there are."""
    pin = paper_machine.LOOSE_PIN
    numbers = [counted("touches", case, result, lambda r: len(r.onsets[pin]))]
    numbers.append(
        measured("largest_pin_force_any_step", case, "N", result, lambda r: float(r.largest_force[pin]))
    )
    for n in range(min(3, touches(result, pin))):
        numbers += [
            measured(f"onset_{n + 1}_time", case, "s", result, _onset(n, "time")),
            measured(f"onset_{n + 1}_speed", case, "m/s", result, _onset(n, "speed")),
        ]
    return numbers


def _onset(n: int, field: Literal["time", "speed"]) -> Callable[[Result], float]:
    return lambda r: float(getattr(r.onsets[paper_machine.LOOSE_PIN][n], field))


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
        (DRY, style.LOOSE, 0.9, "-", f"{CLEARANCE_MM} mm, friction {paper_machine.SLIDING_COEFFICIENT}"),
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
        _fit_height(axes, window, [velocity_deg(results[c]) for c in CASES], results[IDEAL].time)
        panels[0, 0].axvspan(*window, color="#eeeeee", zorder=0)
    _legend(drawing, panels[0, 0])
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
    values = [scale * get(results[c]) for c in CASES]
    _fit_height(part, (rise.START + 1e-3, rise.END - 1e-3), values, results[IDEAL].time)
    _legend(drawing, whole)
    drawing.suptitle(title)
    return drawing


def _legend(drawing: Figure, axes: Axes) -> None:
    """One legend for all panels, below them."""
    drawing.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=3)


def _fit_height(
    axes: Axes, window: tuple[float, float], curves: Sequence[rise.Series], times: rise.Series
) -> None:
    inside = (times >= window[0]) & (times <= window[1])
    low = min(curve[inside].min() for curve in curves)
    high = max(curve[inside].max() for curve in curves)
    margin = 0.05 * (high - low)
    axes.set_ylim(low - margin, high + margin)


# --- table ---


def table(numbers: Sequence[Number]) -> Sheet:
    """All numbers, a row a name, a column a case."""
    by_name: dict[str, dict[str, Number]] = {}
    for number in numbers:
        by_name.setdefault(number.name, {})[number.case] = number
    return Sheet(
        title="Rise of the reference support: ideal rear-link pin against 1.5 mm clearance",
        header=("quantity", "unit", *CASES, "paper"),
        rows=tuple(_row(name, row) for name, row in by_name.items()),
        caption=(
            "± is the estimated error, of three runs. Means and spreads: records from 3 to 5 s, every 1 ms. "
            "The paper gives no machine data: its numbers stand beside ours for orientation, not as a check."
        ),
        left=2,
    )


def _row(name: str, row: Mapping[str, Number]) -> tuple[str, ...]:
    any_case = f"{CLEARANCE_MM} mm"
    cells = [rounded(row[c].value, row[c].numerical_error) if c in row else "" for c in CASES]
    if any_case in row:
        cells[1] = cells[2] = rounded(row[any_case].value, row[any_case].numerical_error)
    printed = next((n.paper for n in row.values() if n.paper is not None), None)
    unit = next(iter(row.values())).unit
    return name.replace("_", " "), unit, *cells, "" if printed is None else f"{printed:.9g}"


# --- words ---


def chapter(numbers: Sequence[Number], quick: bool) -> Chapter:
    """The study as a chapter of the report."""
    return Chapter(
        study=STUDY,
        title=f"Influence of {CLEARANCE_MM} mm clearance (section 3 of the paper)",
        question=f"What do {CLEARANCE_MM} mm of clearance in the rear-link pin do to the rise of the support?",
        method=_method(quick),
        findings=_findings(numbers),
        pictures=_pictures(),
        sheets=(table(numbers),),
        quick=quick,
    )


def _method(quick: bool) -> tuple[str, ...]:
    return (
        "The reference support stands still for 3 s; then its columns extend along a cubic step (the paper's "
        "mode 2) and raise it by 500 mm in 2 s. The same rise is computed with an ideal rear-link pin, and "
        f"with {CLEARANCE_MM} mm of radial clearance in it, without friction and with a friction coefficient "
        f"of {paper_machine.SLIDING_COEFFICIENT}. All other pins are ideal.",
        "The loose journal starts at rest in the middle of its bore, falls and bounces. Its contact force is "
        "that of Lankarani and Nikravesh with the paper's stiffness (its Eq. 5, external contact) and a "
        f"restitution of {paper_machine.RESTITUTION}; a contact that does not part is damped by the speed of "
        "its last touch, not below 1 mm/s, as in the textbook. Friction is that of Ambrosio. Links and canopy "
        "are rigid, the motion is planar, and both sides of the support are lumped into one plane.",
        f"All is computed to an accuracy of {scenarios(quick)[DRY].goal:g} by the two free coordinates of the "
        f"support, with steps that end where the journal touches or parts. {how_sure(quick)}",
    )


def _findings(numbers: Sequence[Number]) -> tuple[str, ...]:
    found = by_case(numbers)
    ideal, smooth, dry = ({name: n for (name, c), n in found.items() if c == case} for case in CASES)

    def compared(name: str, scale: float = 1.0, unit: str | None = None) -> str:
        base = ideal[name]
        return (
            f"{said(base, scale, unit)} with the ideal pin, {said(smooth[name], scale, unit)} "
            f"({against(smooth[name], base)}) with clearance but no friction, and "
            f"{said(dry[name], scale, unit)} ({against(dry[name], base)}) with clearance and friction."
        )

    speed = ideal["largest_angular_speed_in_rise"].value
    departures = [percent(case["rms_angular_velocity_departure"].value / speed) for case in (smooth, dry)]
    peak = smooth["largest_pin_force"].value / ideal["largest_pin_force"].value
    return (
        f"Mean pin force during the rise: {compared('mean_pin_force', 1e-3, 'kN')}",
        f"Its standard deviation: {compared('std_pin_force', 1e-3, 'kN')}",
        "The largest force belongs to the fall into the bore, not to the rise: without friction "
        f"{said(smooth['largest_pin_force'], 1e-3, 'kN')}, {peak:.1f} times the largest of the ideal pin. Over "
        f"the rise alone the largest is {compared('largest_pin_force_in_rise', 1e-3, 'kN')}",
        f"The angular velocity of the rear link departs from that with the ideal pin by {departures[0]} "
        f"(no friction) and {departures[1]} (friction) of its largest value, root mean square.",
        f"Standard deviation of the rear link's angular acceleration: {compared('std_angular_acceleration')}",
        f"The mean angular acceleration is {said(ideal['mean_angular_acceleration'])} with the ideal pin, "
        f"{said(smooth['mean_angular_acceleration'])} without and {said(dry['mean_angular_acceleration'])} "
        "with friction. Over a rise from rest to rest it is the change of angular velocity divided by the "
        "time, so it says nothing of how much the motion fluctuates.",
        f"The canopy tip stands {said(smooth['mean_tip_shift'])} (no friction) and "
        f"{said(dry['mean_tip_shift'])} (friction) from where the ideal pin has it, on average over the "
        "rise; minus is towards the rear link.",
        f"Impacts and friction take {said(smooth['energy_dissipated'])} without and "
        f"{said(dry['energy_dissipated'])} with friction. {said(smooth['energy_error'])} and "
        f"{said(dry['energy_error'])} are not accounted for.",
    )


def _pictures() -> tuple[Picture, ...]:
    return (
        Picture(
            "fig3_angular_velocity",
            "Angular velocity of the rear link: the whole run (a), and three windows of the rise enlarged (b "
            "to d). Counterpart of the paper's Fig. 3.",
        ),
        Picture(
            "fig4_angular_acceleration",
            "Angular acceleration of the rear link: the whole run (a), and the rise on its own scale (b). "
            "Counterpart of the paper's Fig. 4.",
        ),
        Picture(
            "fig5_pin_force",
            "Force in the rear-link pin: the whole run with the impacts of the fall into the bore (a), and the "
            "rise on its own scale (b). Counterpart of the paper's Fig. 5.",
        ),
    )


# --- main ---


def study(chosen: Options) -> None:
    """Run, measure, draw and write everything into the output folder."""
    started = time.perf_counter()
    results = run_cases(scenarios(chosen.quick), chosen.workers)
    for name, result in results.items():
        save_run(result, chosen.out, _file_name(name))
    with style.look():
        drawings = figures(results)
    save_figures(chosen, drawings)
    numbers = measure(results)
    show_table(chosen.out / "table.txt", table(numbers))
    chapter(numbers, chosen.quick).save(chosen.out)
    write_summary(chosen.out, STUDY, numbers, time.perf_counter() - started)


def _file_name(case: str) -> str:
    return case.replace(" mm, mu_d = ", "mm_mu").replace(".", "p")


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.clearance_influence`."""
    description = (__doc__ or "").splitlines()[0]
    return run_main(study, options(STUDY, argv, description))
