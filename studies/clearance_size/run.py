"""What does the size of the clearance change in the rise: motion, force, posture? (Section 4 of the paper.)

Ideal pin, 0.5, 1.0, 1.5 and 2.0 mm, all with friction and all without: motion and force of the rear link, path
of the canopy's tip, angles of the columns.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np

from studies.clearance_size.figures import COLUMNS, figures, live
from studies.common import paper_machine, rise
from studies.common.numbers import (
    Found,
    Number,
    by_case,
    cell,
    compared,
    difference,
    measured,
    printed,
    witnessed,
)
from studies.common.options import Options
from studies.common.paper_machine import SIZES_MM, case_name, ideal_name, ideal_of
from studies.common.study import Study, StudyOutcome
from studies.common.subject import Subject
from studies.common.witness import Witness, run_on_exudyn, with_errors
from studies.common.words import text_table
from support_exudyn import Result, Scenario
from support_exudyn.postprocessing.page.pieces import Sheet

Against = Callable[[rise.MeasuredRun, rise.MeasuredRun], float]  # of a run and that of the ideal pin


def scenarios(subject: Subject) -> dict[str, Scenario]:
    """The ideal pin and every clearance, with and without friction."""
    frictions = (subject.friction, 0.0)
    with_clearance = {
        case_name(size, friction): subject.with_clearance(size, friction)
        for friction in frictions
        for size in SIZES_MM
    }
    return with_clearance | {ideal_name(friction): subject.ideal(friction) for friction in frictions}


# --- measures ---


def measures(subject: Subject, ideal: Result) -> dict[str, tuple[str, Against]]:
    """Unit and measure of everything that this machine has, by name."""
    watched, degrees = subject.watched, rise.DEGREES

    def over_motion(of: Callable[..., float], scale: float, *more: object) -> Against:
        return lambda run, ideal: scale * of(run, *more)

    def shaking(channel: str, scale: float, *times: float) -> Against:
        return lambda run, ideal: scale * watched.rms_fluctuation(run, run[channel], *times)

    def angle(of: Callable[[rise.MeasuredRun, str], rise.Series], column: str) -> Against:
        return lambda run, ideal: degrees * watched.mean(run, of(run, column))

    def extent(run: rise.MeasuredRun, ideal: rise.MeasuredRun) -> float:
        return 1e3 * float(np.ptp(run["tip.x"][watched.in_rise(run)]))

    def shift(run: rise.MeasuredRun, ideal: rise.MeasuredRun) -> float:
        return 1e3 * rise.mean(run.time[watched.in_rise(run)], watched.departure(run, ideal, "tip.x"))

    force, speed, acceleration = watched.force, watched.speed, watched.acceleration
    found: dict[str, tuple[str, Against]] = {
        "mean_pin_force": ("N", over_motion(watched.mean, 1.0, force)),
        "std_pin_force": ("N", over_motion(watched.spread, 1.0, force)),
        "rms_pin_force": ("N", shaking(force, 1.0)),
        "mean_angular_acceleration": ("deg/s^2", over_motion(watched.mean, degrees, acceleration)),
        "std_angular_acceleration": ("deg/s^2", over_motion(watched.spread, degrees, acceleration)),
        "rms_angular_acceleration": ("deg/s^2", shaking(acceleration, degrees)),
        "rms_angular_velocity": ("deg/s", shaking(speed, degrees)),
    }
    for stage, times in watched.stages.items():
        found[f"rms_angular_velocity_{stage}"] = ("deg/s", shaking(speed, degrees, *times))
        found[f"mean_angular_speed_{stage}"] = ("deg/s", over_motion(watched.stage_mean, degrees, speed, stage))
    if "tip.x" in ideal.channels:
        found |= {"mean_tip_shift": ("mm", shift), "tip_range": ("mm", extent)}
    for column in COLUMNS:
        if f"{column}.angle" in ideal.channels:
            found[f"mean_{column}_angle"] = ("deg", angle(rise.rearward_angle, column))
            found[f"mean_{column}_lean"] = ("deg", angle(rise.lean, column))
    return found


def measure(subject: Subject, results: Mapping[str, Result]) -> list[Number]:
    """All numbers of the study, each case compared with the ideal pin of the same friction."""
    numbers = []
    if subject.is_paper:
        numbers = [
            Number("stiffness_coefficient", f"{size:.1f} mm", paper_machine.stiffness(size) / 1e3**1.5,
                   "N/mm^1.5", 0.0, paper_machine.STIFFNESS[size])
            for size in SIZES_MM
        ]  # fmt: skip
    for case, result in results.items():
        ideal = results[ideal_of(case)]
        for name, (unit, get) in measures(subject, ideal).items():
            paper = of_paper(name, case) if subject.is_paper else None
            numbers.append(compared(name, case, unit, result, ideal, get, paper))
        if result is not ideal:
            name, unit = "largest_pin_force_any_step", "N"
            numbers.append(
                measured(name, case, unit, result, lambda run: float(run.largest_force[subject.pin]))
            )
    return numbers


def of_paper(name: str, case: str) -> float | None:
    """The printed value; the paper's friction is not known, so it stands with the cases that have friction."""
    tables = {
        "mean_pin_force": paper_machine.MEAN_FORCE,
        "std_pin_force": paper_machine.FORCE_SPREAD,
        "mean_angular_acceleration": paper_machine.MEAN_ACCELERATION,
    }
    sizes = {case_name(size, paper_machine.SLIDING_COEFFICIENT): size for size in SIZES_MM}
    return tables[name][sizes[case]] if name in tables and case in sizes else None


# --- tables ---

KEY = {  # of the key table: heading and scale
    "mean_pin_force": ("mean force [kN]", 1e-3),
    "rms_pin_force": ("fluctuation of force [kN]", 1e-3),
    "rms_angular_acceleration": ("of angular acceleration [deg/s²]", 1.0),
    "mean_tip_shift": ("tip shift [mm]", 1.0),
}
OF_FORCE = {
    "mean_pin_force": "mean", "std_pin_force": "standard deviation", "rms_pin_force": "RMS fluctuation",
}  # fmt: skip


def _cases(friction: float) -> dict[str, str]:
    """The ideal pin and every clearance, all with the same friction, by heading."""
    cases = [ideal_name(friction), *(case_name(size, friction) for size in SIZES_MM)]
    return {case.split(",")[0]: case for case in cases}


def key_table(found: Found, friction: float) -> Sheet:
    """What an engineer asks for first, a row for each clearance, with friction."""
    shown = {name: about for name, about in KEY.items() if (name, ideal_name(friction)) in found}
    rows = [
        (heading, *(cell(found[name, case], scale) for name, (_, scale) in shown.items()))
        for heading, case in _cases(friction).items()
    ]
    return text_table(("clearance", *(heading for heading, _ in shown.values())), rows)


def stiffness_table(numbers: Sequence[Number]) -> Sheet:
    """Counterpart of Table 2."""
    rows = []
    for n in numbers:
        if n.name == "stiffness_coefficient" and n.paper is not None:
            shaft = 1e3 * paper_machine.BORE_RADIUS - float(n.case.split()[0])
            rows.append((n.case, f"{shaft:.1f}", f"{n.value:.3f}", f"{n.paper:.3f}"))
    return text_table(("clearance", "shaft radius [mm]", "here [N/mm^1.5]", "paper"), rows)


def force_table(found: Found, frictions: Sequence[float]) -> Sheet:
    """Counterpart of Table 3."""
    rows = []
    for case in [case for friction in frictions for case in _cases(friction).values()]:
        for name, title in OF_FORCE.items():
            number = found[name, case]
            rows.append((case, title, cell(number), witnessed(number), difference(number), printed(number)))
    return text_table(("case", "pin force", "Exudyn [N]", "witness", "difference", "paper"), rows, left=2)


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """All rises, their numbers, figures and tables."""
    subject = chosen.subject
    frictions = (subject.friction, 0.0)
    numbers_of = partial(measure, subject)

    def tables(numbers: Sequence[Number]) -> dict[str, Sheet]:
        known = by_case(numbers)
        return {
            "by_clearance": key_table(known, subject.friction),
            **({"table_2": stiffness_table(numbers)} if subject.is_paper else {}),
            "table_3": force_table(known, frictions),
        }

    cases = scenarios(subject)
    results = run_on_exudyn(cases, chosen)
    numbers = with_errors(numbers_of(results))
    found = by_case(numbers)
    words = {
        "found": found,
        "case_name": case_name,
        "ideal_name": ideal_name,
        "sizes": SIZES_MM,
        "frictions": frictions,
        "mu": subject.friction,
        "watched": subject.watched,
        "window": f"{subject.watched.window:g} s",
        "has_tip": ("mean_tip_shift", ideal_name(0.0)) in found,
    }
    drawings = figures(subject, results, found)
    witness = Witness(cases, numbers_of, tables)
    return StudyOutcome(
        numbers, words, drawings, tables(numbers), results, live=live(drawings), witness=witness
    )


study = Study("clearance_size", __doc__, work, seconds=14.0, own_machine=True)
