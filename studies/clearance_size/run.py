"""What does the size of the clearance do to the rise? (Section 4 of the paper.)

Ideal pin, 0.5, 1.0, 1.5 and 2.0 mm, with the friction assumed throughout and without any: motion and force of
the rear link, path of the canopy's tip, angles of the columns.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from studies.clearance_size.figures import figures
from studies.common import paper_machine, rise
from studies.common.numbers import Found, Number, by_case, cell, compared, measured, printed
from studies.common.options import Options
from studies.common.paper_machine import SIZES_MM, case_name
from studies.common.runs import run_cases, run_with_errors
from studies.common.study import Study, StudyOutcome
from studies.common.words import TextTable
from support_exudyn import Result, Scenario, SolverSettings

IDEAL = "ideal"
QUICK_SMOOTH_MM = (0.5, 2.0)  # tried without friction in the quick form
FRICTIONS = (paper_machine.SLIDING_COEFFICIENT, 0.0)
STEP = 1e-3  # [s] of the engine's first runs; accuracies do not use it


def scenarios(quick: bool) -> dict[str, Scenario]:
    """The ideal pin, and every clearance with and without friction; the quick form has fewer without."""
    with_clearance = {
        case_name(size, friction): paper_machine.clearance_rise(size, friction, STEP)
        for friction in FRICTIONS
        for size in (QUICK_SMOOTH_MM if quick and not friction else SIZES_MM)
    }
    rises = with_clearance | {IDEAL: paper_machine.ideal_rise(STEP)}
    return {case: paper_machine.to_accuracy(rise, quick) for case, rise in rises.items()}


def by_the_engine(quick: bool) -> dict[str, Scenario]:
    """The cases by rigid bodies and constraints, at the longest of their steps; the quick form has fewer."""
    settings = SolverSettings(impact_steps=16 if quick else 256, backend="symbolic")
    cases = {
        case: replace(rise, formulation="redundant", solver=settings, accuracy=None)
        for case, rise in scenarios(quick).items()
    }
    kept = (IDEAL, case_name(SIZES_MM[0], FRICTIONS[0]))
    return {case: rise for case, rise in cases.items() if case in kept or not quick}


# --- measures ---

Against = Callable[[rise.MeasuredRun, rise.MeasuredRun], float]  # of a run and that of the ideal pin


def _of_rise(channel: str, statistic: Callable[[rise.Series], float], scale: float = 1.0) -> Against:
    return lambda run, ideal: scale * float(statistic(run[channel][rise.in_rise(run)]))


def _rms_fluctuation(channel: str, scale: float, *times: float) -> Against:
    return lambda run, ideal: scale * rise.rms_fluctuation(run, run[channel], *times)


def _stage_mean(stage: str) -> Against:
    return lambda run, ideal: rise.DEGREES * rise.stage_mean(run, rise.SPEED, stage)


def _lean(column: str) -> Against:
    return lambda run, ideal: rise.DEGREES * float(rise.lean(run, column)[rise.in_rise(run)].mean())


def _angle(column: str) -> Against:
    return lambda run, ideal: rise.DEGREES * float(rise.rearward_angle(run, column)[rise.in_rise(run)].mean())


MEASURES: dict[str, tuple[str, Against]] = {
    "mean_pin_force": ("N", _of_rise(rise.FORCE, np.mean)),
    "std_pin_force": ("N", _of_rise(rise.FORCE, np.std)),
    "rms_pin_force": ("N", _rms_fluctuation(rise.FORCE, 1.0)),
    "mean_angular_acceleration": ("deg/s^2", _of_rise(rise.ACCELERATION, np.mean, rise.DEGREES)),
    "std_angular_acceleration": ("deg/s^2", _of_rise(rise.ACCELERATION, np.std, rise.DEGREES)),
    "rms_angular_acceleration": ("deg/s^2", _rms_fluctuation(rise.ACCELERATION, rise.DEGREES)),
    "rms_angular_velocity": ("deg/s", _rms_fluctuation(rise.SPEED, rise.DEGREES)),
    **{
        f"rms_angular_velocity_{stage}": ("deg/s", _rms_fluctuation(rise.SPEED, rise.DEGREES, *times))
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
            numbers.append(compared(name, case, unit, result, results[IDEAL], get, of_paper(name, case)))
        if case != IDEAL:
            numbers.append(measured("largest_pin_force_any_step", case, "N", result, _largest_at_any_step))
    return numbers


def _largest_at_any_step(result: Result) -> float:
    return float(result.largest_force[paper_machine.CLEARANCE_PIN])


def of_paper(name: str, case: str) -> float | None:
    """What the paper prints; its friction is not known, so it stands beside the cases with friction."""
    tables = {
        "mean_pin_force": paper_machine.MEAN_FORCE,
        "std_pin_force": paper_machine.FORCE_SPREAD,
        "mean_angular_acceleration": paper_machine.MEAN_ACCELERATION,
    }
    sizes = {case_name(size, FRICTIONS[0]): size for size in SIZES_MM}
    return tables[name][sizes[case]] if name in tables and case in sizes else None


# --- tables ---


def stiffness_table(numbers: Sequence[Number]) -> TextTable:
    """Counterpart of Table 2."""
    rows = []
    for n in numbers:
        if n.name == "stiffness_coefficient" and n.paper is not None:
            shaft = 1e3 * paper_machine.BORE_RADIUS - float(n.case.split()[0])
            rows.append((n.case, f"{shaft:.1f}", f"{n.value:.3f}", f"{n.paper:.3f}"))
    return TextTable(("clearance", "shaft radius [mm]", "here [N/mm^1.5]", "paper"), tuple(rows))


def force_table(found: Found) -> TextTable:
    """Counterpart of Table 3."""
    rows = []
    for case in (IDEAL, *(case for mu in FRICTIONS for case in _cases(found, mu))):
        mean, spread, shaking = (found[f"{n}_pin_force", case] for n in ("mean", "std", "rms"))
        rows.append((case, cell(mean), printed(mean), cell(spread), printed(spread), cell(shaking)))
    header = ("case", "mean [N]", "paper", "standard deviation [N]", "paper", "RMS fluctuation [N]")
    return TextTable(header, tuple(rows))


def _cases(found: Found, friction: float) -> list[str]:
    """Cases with clearance and this friction, the smallest clearance first."""
    names = [case_name(size, friction) for size in SIZES_MM]
    return [name for name in names if ("mean_pin_force", name) in found]


def number_table(found: Found, friction: float) -> TextTable:
    """All measures, a column a clearance."""
    cases = [IDEAL, *_cases(found, friction)]
    rows = tuple(
        (name.replace("_", " "), unit, *(cell(found[name, case]) for case in cases))
        for name, (unit, _) in MEASURES.items()
    )
    return TextTable(("quantity", "unit", *(case.split(",")[0] for case in cases)), rows, left=2)


def formulation_table(results: Mapping[str, Result], engines: Mapping[str, Result]) -> TextTable:
    """The engine's statistics of the same scenes, beside those of the study."""
    rows = []
    for case, engine in engines.items():
        cells = []
        for name in ("mean_pin_force", "std_pin_force", "rms_pin_force"):
            unit, get = MEASURES[name]
            its = compared(name, case, unit, engine, engine, get)
            ours = compared(name, case, unit, results[case], results[case], get)
            cells += [cell(its), f"{its.value - ours.value:+.1g}"]
        rows.append((case, *cells))
    header = ("case", "mean [N]", "off by", "standard deviation [N]", "off by", "RMS fluctuation [N]", "off by")
    return TextTable(header, tuple(sorted(rows)))


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """All rises, their numbers, figures and tables, and some of them by the engine."""
    cases = scenarios(chosen.quick)
    results = run_cases(cases, chosen)
    engines = run_with_errors(by_the_engine(chosen.quick), chosen)
    numbers = measure(results)
    found = by_case(numbers)
    measures = {f"table_mu{friction:g}".replace(".", "p"): friction for friction in FRICTIONS}
    tables = {
        "table_2": stiffness_table(numbers),
        "table_3": force_table(found),
        "table_formulations": formulation_table(results, engines),
        **{name: number_table(found, friction) for name, friction in measures.items()},
    }
    words = {
        "found": found, "goal": cases[IDEAL].goal, "mu": FRICTIONS[0], "frictions": FRICTIONS,
        "sizes": SIZES_MM, "case_name": case_name, "all_measures": measures,
    }  # fmt: skip
    return StudyOutcome(numbers, words, figures(results, numbers), tables, results)


study = Study("clearance_size", __doc__, work)
main = study.main
