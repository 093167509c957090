"""What does the size of the clearance do to the rise? (Section 4 of the paper.)

Ideal pin, 0.5, 1.0, 1.5 and 2.0 mm, with the friction assumed throughout and without any: motion and force of
the rear link, path of the canopy's tip, angles of the columns.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from studies.clearance_size.figures import figures, pictures
from studies.common import paper_machine, rise
from studies.common.chapter import Chapter, Sheet
from studies.common.paper_machine import SIZES_MM, case_name
from studies.common.study import (
    Number,
    Options,
    brief,
    compared,
    measured,
    options,
    run_cases,
    run_main,
    run_with_errors,
    save_figures,
    save_run,
    show_table,
    write_summary,
)
from studies.common.wording import by_case, how_sure, said
from support_exudyn import Result, Scenario, SolverSettings
from support_exudyn.postprocessing.figures import style

STUDY = "clearance_size"
IDEAL = "ideal"
QUICK_SMOOTH_MM = (0.5, 2.0)  # tried without friction in the quick form
FRICTIONS = (paper_machine.SLIDING_COEFFICIENT, 0.0)
STEP = 1e-3  # [s] of the engine's first runs; accuracies do not use it


def scenarios(quick: bool) -> dict[str, Scenario]:
    """The ideal pin, and every clearance with and without friction; the quick form has fewer without."""
    loose = {
        case_name(size, friction): paper_machine.loose_rise(size, friction, STEP)
        for friction in FRICTIONS
        for size in (QUICK_SMOOTH_MM if quick and not friction else SIZES_MM)
    }
    rises = loose | {IDEAL: paper_machine.ideal_rise(STEP)}
    return {case: paper_machine.to_accuracy(rise, quick) for case, rise in rises.items()}


def by_the_engine(quick: bool) -> dict[str, Scenario]:
    """The same by rigid bodies and constraints, at the longest of their steps; the quick form has fewer."""
    settings = SolverSettings(impact_steps=16 if quick else 256, backend="symbolic")
    cases = {
        case: replace(rise, formulation="redundant", solver=settings, accuracy=None)
        for case, rise in scenarios(quick).items()
    }
    kept = (IDEAL, case_name(SIZES_MM[0], FRICTIONS[0]))
    return {case: rise for case, rise in cases.items() if case in kept or not quick}


# --- measures ---

Against = Callable[[rise.Run, rise.Run], float]  # of a run and that of the ideal pin


def _of_rise(channel: str, statistic: Callable[[rise.Series], float], scale: float = 1.0) -> Against:
    return lambda run, ideal: scale * float(statistic(run[channel][rise.in_rise(run)]))


def _ripple(channel: str, scale: float, *times: float) -> Against:
    return lambda run, ideal: scale * rise.ripple(run, run[channel], *times)


def _stage_mean(stage: str) -> Against:
    return lambda run, ideal: rise.DEGREES * rise.stage_mean(run, rise.SPEED, stage)


def _lean(column: str) -> Against:
    return lambda run, ideal: rise.DEGREES * float(rise.lean(run, column)[rise.in_rise(run)].mean())


def _angle(column: str) -> Against:
    return lambda run, ideal: rise.DEGREES * float(rise.rearward_angle(run, column)[rise.in_rise(run)].mean())


MEASURES: dict[str, tuple[str, Against]] = {
    "mean_pin_force": ("N", _of_rise(rise.FORCE, np.mean)),
    "std_pin_force": ("N", _of_rise(rise.FORCE, np.std)),
    "ripple_pin_force": ("N", _ripple(rise.FORCE, 1.0)),
    "mean_angular_acceleration": ("deg/s^2", _of_rise(rise.ACCELERATION, np.mean, rise.DEGREES)),
    "std_angular_acceleration": ("deg/s^2", _of_rise(rise.ACCELERATION, np.std, rise.DEGREES)),
    "ripple_angular_acceleration": ("deg/s^2", _ripple(rise.ACCELERATION, rise.DEGREES)),
    "ripple_angular_velocity": ("deg/s", _ripple(rise.SPEED, rise.DEGREES)),
    **{
        f"ripple_angular_velocity_{stage}": ("deg/s", _ripple(rise.SPEED, rise.DEGREES, *times))
        for stage, times in rise.STAGES.items()
    },
    **{f"mean_angular_speed_{stage}": ("deg/s", _stage_mean(stage)) for stage in rise.STAGES},
    "mean_tip_shift": ("mm", lambda run, ideal: 1e3 * float(rise.departure(run, ideal, "tip.x").mean())),
    "tip_range": ("mm", _of_rise("tip.x", np.ptp, 1e3)),
    "mean_front_column_angle": ("deg", _angle("front_column")),
    "mean_rear_column_angle": ("deg", _angle("rear_column")),
    "mean_front_column_lean": ("deg", _lean("front_column")),
    "mean_rear_column_lean": ("deg", _lean("rear_column")),
}


def measure(results: Mapping[str, Result]) -> list[Number]:
    """All numbers of the study."""
    numbers = [
        Number("stiffness_coefficient", f"{size:.1f} mm", paper_machine.stiffness(size) / 1e3**1.5, "N/mm^1.5",
               0.0, paper_machine.STIFFNESS[size])
        for size in SIZES_MM
    ]  # fmt: skip
    for case, result in results.items():
        for name, (unit, get) in MEASURES.items():
            numbers.append(compared(name, case, unit, result, results[IDEAL], get, printed(name, case)))
        if case != IDEAL:
            numbers.append(measured("largest_pin_force_any_step", case, "N", result, _largest_at_any_step))
    return numbers


def _largest_at_any_step(result: Result) -> float:
    return float(result.largest_force[paper_machine.LOOSE_PIN])


def printed(name: str, case: str) -> float | None:
    """What the paper prints; its friction is not known, so it stands beside the cases with friction."""
    tables = {
        "mean_pin_force": paper_machine.MEAN_FORCE,
        "std_pin_force": paper_machine.FORCE_SPREAD,
        "mean_angular_acceleration": paper_machine.MEAN_ACCELERATION,
    }
    sizes = {case_name(size, FRICTIONS[0]): size for size in SIZES_MM}
    return tables[name][sizes[case]] if name in tables and case in sizes else None


# --- tables ---


def stiffness_sheet(numbers: Sequence[Number]) -> Sheet:
    """Counterpart of Table 2."""
    rows = []
    for n in numbers:
        if n.name == "stiffness_coefficient" and n.paper is not None:
            shaft = 1e3 * paper_machine.BORE_RADIUS - float(n.case.split()[0])
            rows.append((n.case, f"{shaft:.1f}", f"{n.value:.3f}", f"{n.paper:.3f}"))
    return Sheet(
        "Stiffness by Eq. 5 (paper: Table 2)",
        ("clearance", "shaft radius [mm]", "here [N/mm^1.5]", "paper"),
        tuple(rows),
        "Closed form, no numerical error. The bore radius of 65.5 mm and the unit are implied by the paper's "
        "numbers.",
    )


def force_sheet(numbers: Sequence[Number]) -> Sheet:
    """Counterpart of Table 3."""
    found = by_case(numbers)
    rows = [_force_row(found, IDEAL)]
    rows += [_force_row(found, case) for mu in FRICTIONS for case in _cases(found, mu)]
    return Sheet(
        "Pin force during the rise (paper: Table 3)",
        ("case", "mean [N]", "paper", "standard deviation [N]", "paper", "ripple [N]"),
        tuple(rows),
        "Records from 3 to 5 s, every 1 ms. ± is the estimated error. Ripple: root mean "
        "square of what is left when a moving mean of 0.1 s is taken away. The paper gives neither machine "
        "nor friction, so its numbers stand beside ours for orientation.",
    )


def _cases(found: Mapping[tuple[str, str], Number], friction: float) -> list[str]:
    """Cases with clearance and this friction, the smallest clearance first."""
    names = [case_name(size, friction) for size in SIZES_MM]
    return [name for name in names if ("mean_pin_force", name) in found]


def _force_row(found: Mapping[tuple[str, str], Number], case: str) -> tuple[str, ...]:
    mean, spread, shaking = (found[f"{n}_pin_force", case] for n in ("mean", "std", "ripple"))
    return (case, _cell(mean), _paper(mean), _cell(spread), _paper(spread), _cell(shaking))


def number_sheet(numbers: Sequence[Number], friction: float) -> Sheet:
    """All measures, a column a clearance."""
    found = by_case(numbers)
    cases = [IDEAL, *_cases(found, friction)]
    rows = []
    for name, (unit, _) in MEASURES.items():
        rows.append((name.replace("_", " "), unit, *(_cell(found[name, case]) for case in cases)))
    return Sheet(
        f"All measures, friction {friction:g}",
        ("quantity", "unit", *(case.split(",")[0] for case in cases)),
        tuple(rows),
        "Over the rise. Early, middle, late: 3.1 to 3.6, 3.75 to 4.25, 4.4 to 4.9 s. Tip shift is against the "
        "ideal pin, minus towards the rear link. Column angles are those of the paper's Fig. 12, from the "
        "rearward horizontal; lean is the distance from the vertical.",
        left=2,
    )


def _cell(number: Number) -> str:
    return brief(number.value, number.numerical_error)


def _paper(number: Number) -> str:
    return "" if number.paper is None else f"{number.paper:.9g}"


def formulation_sheet(results: Mapping[str, Result], engines: Mapping[str, Result]) -> Sheet:
    """The engine's statistics of the same scenes, beside those of the study."""
    rows = []
    for case, engine in engines.items():
        cells = []
        for name in ("mean_pin_force", "std_pin_force", "ripple_pin_force"):
            unit, get = MEASURES[name]
            its = compared(name, case, unit, engine, engine, get)
            ours = compared(name, case, unit, results[case], results[case], get)
            cells += [_cell(its), f"{its.value - ours.value:+.1g}"]
        rows.append((case, *cells))
    return Sheet(
        "The same by another formulation",
        ("case", "mean [N]", "off by", "standard deviation [N]", "off by", "ripple [N]", "off by"),
        tuple(sorted(rows)),
        "The engine's rigid bodies, constraints and generalised alpha. The study itself is computed with two "
        "free coordinates, equations of motion by hand and an embedded Runge-Kutta method; it shares with the "
        "engine's run nothing but the machine's data and the constants of the laws. Off by: the engine's less "
        "the study's [N].",
    )


# --- words ---


def chapter(numbers: Sequence[Number], check: Sheet, quick: bool) -> Chapter:
    """The study as a chapter of the report."""
    return Chapter(
        study=STUDY,
        title="Influence of the clearance's size (section 4 of the paper)",
        question="What does the size of the clearance change in the rise: motion, force, posture?",
        method=(
            "The rise of the first study, with the ideal pin and with 0.5, 1.0, 1.5 and 2.0 mm of radial "
            f"clearance, each with the friction coefficient {FRICTIONS[0]} that is assumed throughout and "
            "without friction. The stiffness follows the clearance (Eq. 5); nothing else changes.",
            "The standard deviation of a force over the rise is mostly its slow fall as the posture changes. "
            "To tell fluctuation from trend, a moving mean of 0.1 s is taken away; the root mean square of "
            "the rest is called ripple. The pin shakes at 20 Hz and more.",
            "All is computed to an accuracy of "
            f"{scenarios(quick)[IDEAL].goal:g} by the two free coordinates of the support. {how_sure(quick)}",
        ),
        findings=_findings(by_case(numbers)),
        pictures=pictures(),
        sheets=(
            stiffness_sheet(numbers),
            force_sheet(numbers),
            check,
            *(number_sheet(numbers, friction) for friction in FRICTIONS),
        ),
        quick=quick,
    )


def _findings(found: Mapping[tuple[str, str], Number]) -> tuple[str, ...]:
    rows: list[str] = []
    for friction in FRICTIONS:
        first, last = case_name(SIZES_MM[0], friction), case_name(SIZES_MM[-1], friction)

        def ends(name: str, first: str = first, last: str = last) -> str:
            small, large = said(found[name, first]), said(found[name, last])
            return f"{small} at {SIZES_MM[0]} mm and {large} at {SIZES_MM[-1]} mm"

        label = f"With friction {friction:g}" if friction else "Without friction"
        rows += [
            f"{label} the mean force is {ends('mean_pin_force')}; its standard deviation "
            f"{ends('std_pin_force')}.",
            f"{label} the ripple of the force is {ends('ripple_pin_force')}; that of the angular acceleration "
            f"{ends('ripple_angular_acceleration')}.",
            f"{label} the tip is moved by {ends('mean_tip_shift')}, over a range of "
            f"{said(found['tip_range', IDEAL])} with the ideal pin and {ends('tip_range')}.",
            f"{label} the mean angular acceleration from rest to rest is {ends('mean_angular_acceleration')}: "
            "the change of angular velocity over the time, next to nothing whatever the clearance.",
        ]
    return tuple(rows)


# --- main ---


def study(chosen: Options) -> None:
    """Run, measure, draw and write everything into the output folder."""
    started = time.perf_counter()
    results = run_cases(scenarios(chosen.quick), chosen.workers)
    for name, result in results.items():
        save_run(result, chosen.out, _file_name(name))
    numbers = measure(results)
    with style.look():
        drawings = figures(results, numbers)
    save_figures(chosen, drawings)
    show_table(chosen.out / "table_3.txt", force_sheet(numbers))
    show_table(chosen.out / "table_2.txt", stiffness_sheet(numbers))
    for friction in FRICTIONS:
        name = f"table_mu{friction:g}".replace(".", "p")
        show_table(chosen.out / f"{name}.txt", number_sheet(numbers, friction))
    check = formulation_sheet(results, run_with_errors(by_the_engine(chosen.quick), chosen.workers))
    show_table(chosen.out / "table_formulations.txt", check)
    chapter(numbers, check, chosen.quick).save(chosen.out)
    write_summary(chosen.out, STUDY, numbers, time.perf_counter() - started)


def _file_name(case: str) -> str:
    return case.replace(" mm, mu_d = ", "mm_mu").replace(".", "p")


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.clearance_size`."""
    description = (__doc__ or "").splitlines()[0]
    return run_main(study, options(STUDY, argv, description))
