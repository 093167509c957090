"""What do 1.5 mm of clearance in the rear-link pin do to the rise? (Section 3 of the paper.)

The support stands still for 3 s, while the journal falls from the middle of its bore and comes to rest,
and rises by 500 mm in the next 2 s. Ideal pin against 1.5 mm, both without friction and both with the same.
The same again with line contact, a pin that touches its bore along its length, in place of the paper's spheres.
"""

import math
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from studies.clearance_influence.figures import CASES, DRY, FRICTION, IDEAL, IDEAL_DRY, LIVE, SMOOTH, figures
from studies.common import paper_machine, rise
from studies.common.numbers import (
    Found,
    Measures,
    Number,
    against,
    by_case,
    cell,
    compared,
    counted,
    measured,
    measured_all,
    short,
)
from studies.common.options import Options
from studies.common.paper_machine import CLEARANCE_MM, CONTACT_TITLES, CYLINDERS, PAPER, ideal_of
from studies.common.runs import impacts
from studies.common.study import Study, StudyOutcome
from studies.common.subject import paper_subject
from studies.common.witness import Witness, run_on_exudyn, with_errors
from studies.common.words import Tile, text_table
from support_exudyn import Result, Scenario
from support_exudyn.postprocessing.figures.linkage_drawing import machine_drawing
from support_exudyn.postprocessing.page.pieces import Sheet

PIN = paper_machine.CLEARANCE_PIN
STIFFNESS_CASE = f"{CLEARANCE_MM} mm"


def scenarios() -> dict[str, Scenario]:
    """The four cases with the paper's contact, and the rise with line contact, with friction and without."""
    paper = paper_subject()
    found = {
        IDEAL: paper.ideal(),
        IDEAL_DRY: paper.ideal(FRICTION),
        SMOOTH: paper.with_clearance(CLEARANCE_MM, 0.0),
        DRY: paper.with_clearance(CLEARANCE_MM, FRICTION),
    }
    for friction in (FRICTION, 0.0):
        law = paper_machine.PAPERS_LAW
        pin = paper_machine.clearance_joint(CLEARANCE_MM, friction, contact=CYLINDERS, law=law)
        line = replace(paper.motion, pins={PIN: pin}, channels=(f"pin.{PIN}.*",))
        found[contact_case(CYLINDERS, friction)] = line
    return found


def contact_case(contact: str, friction: float = FRICTION) -> str:
    """Name of a case by its contact; the paper's is not named."""
    paper = paper_machine.case_name(CLEARANCE_MM, friction)
    return paper if contact == PAPER else paper.replace(",", f", {contact},")


# --- measures ---


def _mean(channel: str, scale: float = 1.0) -> Callable[[Result], float]:
    return lambda run: scale * rise.PAPER.mean(run, channel)


def _spread(channel: str, scale: float = 1.0) -> Callable[[Result], float]:
    return lambda run: scale * rise.PAPER.spread(run, channel)


OF_RISE: Measures = {  # from 3 to 5 s; the largest force from 0 to 5 s
    "mean_pin_force": ("N", _mean(rise.FORCE)),
    "std_pin_force": ("N", _spread(rise.FORCE)),
    "rms_pin_force": ("N", lambda run: rise.PAPER.rms_fluctuation(run, run[rise.FORCE])),
    "largest_pin_force": ("N", rise.Crest(rise.FORCE, begin=0.0)),
    "largest_pin_force_in_rise": ("N", rise.Crest(rise.FORCE)),
    "largest_angular_speed_in_rise": ("deg/s", rise.Crest(rise.SPEED, rise.DEGREES)),
    "mean_angular_acceleration": ("deg/s^2", _mean(rise.ACCELERATION, rise.DEGREES)),
    "std_angular_acceleration": ("deg/s^2", _spread(rise.ACCELERATION, rise.DEGREES)),
}
OF_PAPER = {  # printed values; the paper has friction, though with data that it does not print
    "mean_pin_force": paper_machine.MEAN_FORCE,
    "std_pin_force": paper_machine.FORCE_SPREAD,
    "mean_angular_acceleration": paper_machine.MEAN_ACCELERATION,
}
OF_FALL: Measures = {"largest_pin_force_any_step": ("N", lambda run: float(run.largest_force[PIN]))}
OF_CONTACTS: Measures = {
    "mean_pin_force": ("N", lambda run: rise.PAPER.mean(run, run[rise.FORCE])),
    "rms_pin_force": OF_RISE["rms_pin_force"],
    **OF_FALL,
}


def measure(results: Mapping[str, Result]) -> list[Number]:
    """All numbers of the study."""
    stiffness = paper_machine.stiffness(CLEARANCE_MM) / 1e3**1.5, "N/mm^1.5", 0.0  # a closed form
    printed_stiffness = paper_machine.STIFFNESS[CLEARANCE_MM]
    numbers = [Number("stiffness_coefficient", STIFFNESS_CASE, *stiffness, printed_stiffness)]
    for case in CASES:
        result = results[case]
        of_case = measured_all({case: result}, OF_RISE)
        if case == DRY:
            papers = {name: printed_by[CLEARANCE_MM] for name, printed_by in OF_PAPER.items()}
            of_case = [replace(one, paper=papers.get(one.name)) for one in of_case]
        numbers += of_case
        if case in (SMOOTH, DRY):
            numbers += _comparison_numbers(case, result, results[ideal_of(case)])
            numbers += _impact_numbers(case, result)
        numbers += measured_all({case: result}, _energies(case))
    line = {case: results[case] for case in (contact_case(CYLINDERS), contact_case(CYLINDERS, 0.0))}
    return [*numbers, *measured_all(line, OF_CONTACTS)]


def _comparison_numbers(case: str, result: Result, ideal: Result) -> list[Number]:
    """The changes against the ideal pin with the same friction, record by record, from 3 to 5 s."""

    def departure(channel: str, run: Result, other: Result) -> tuple[rise.Series, rise.Series]:
        return run.time[rise.in_rise(run)], rise.departure(run, other, channel)

    def rms(channel: str, scale: float = 1.0) -> Callable[[Result, Result], float]:
        def get(run: Result, other: Result) -> float:
            time, values = departure(channel, run, other)
            return scale * math.sqrt(rise.mean(time, values**2))

        return get

    measures: dict[str, tuple[str, Callable[[Result, Result], float]]] = {
        "rms_pin_force_departure": ("N", rms(rise.FORCE)),
        "rms_angular_velocity_departure": ("deg/s", rms(rise.SPEED, rise.DEGREES)),
        "mean_tip_shift": ("mm", lambda run, other: 1e3 * rise.mean(*departure("tip.x", run, other))),
    }
    return [compared(name, case, unit, result, ideal, get) for name, (unit, get) in measures.items()]


def _impact_numbers(case: str, result: Result) -> list[Number]:
    """How many impacts there are, the largest force, and the first three impacts."""
    numbers = [counted("impacts", case, result, lambda run: len(run.onsets[PIN]))]
    numbers += measured_all({case: result}, OF_FALL)
    for n in range(min(3, impacts(result, PIN))):
        numbers += [
            measured(f"onset_{n + 1}_time", case, "s", result, rise.onset(PIN, n, "time")),
            measured(f"onset_{n + 1}_speed", case, "m/s", result, rise.onset(PIN, n, "speed")),
        ]
    return numbers


def _energies(case: str) -> Measures:
    found: dict[str, tuple[str, Callable[[Result], float]]] = {
        "column_work": ("J", lambda run: float(run["energy.work"][-1])),
        "energy_dissipated": ("J", lambda run: run.dissipated),
        "energy_error": ("J", lambda run: run.energy_error),
    }
    if case == IDEAL:
        del found["energy_dissipated"]
    return found


# --- tables and tiles ---

KEY = {  # of the key table: what, and its scale to the unit in brackets
    "mean_pin_force": ("mean force in the pin, 3 to 5 s [kN]", 1e-3),
    "std_pin_force": ("its standard deviation [kN]", 1e-3),
    "rms_pin_force": ("its fluctuation (RMS) [kN]", 1e-3),
    "largest_pin_force_in_rise": ("largest force in the rise [kN]", 1e-3),
    "largest_pin_force_any_step": ("largest force, fall into the bore [kN]", 1e-3),
    "std_angular_acceleration": ("angular acceleration, std. deviation [deg/s²]", 1.0),
    "mean_tip_shift": ("mean shift of the canopy's tip [mm]", 1.0),
    "energy_dissipated": ("energy lost in the pin [J]", 1.0),
}


def key_table(found: Found) -> Sheet:
    """What an engineer asks for first, a column a case."""
    rows = []
    for name, (heading, scale) in KEY.items():
        numbers = [found.get((name, case)) for case in CASES]
        paper = next((n.paper for n in numbers if n is not None and n.paper is not None), None)
        cells = (cell(one, scale) for one in numbers)
        rows.append((heading, *cells, "" if paper is None else f"{scale * paper:.3f}"))
    return text_table(("quantity", *CASES, "paper, 1.5 mm"), rows)


def contact_table(found: Found) -> Sheet:
    """A row for each contact and friction coefficient."""
    rows = [
        (
            *(CONTACT_TITLES[contact], f"{friction:g}"),
            *(cell(found[name, contact_case(contact, friction)], 1e-3) for name in OF_CONTACTS),
        )
        for contact in (PAPER, CYLINDERS)
        for friction in (FRICTION, 0.0)
    ]
    header = ("contact", "mu_d", "mean force [kN]", "fluctuation [kN]", "largest force [kN]")
    return text_table(header, rows, left=2)


def tables(numbers: Sequence[Number]) -> dict[str, Sheet]:
    """All tables, the key table first."""
    found = by_case(numbers)
    return {"key_numbers": key_table(found), "by_contact": contact_table(found)}


def tiles(found: Found) -> tuple[Tile, ...]:
    """The first screen of the report: the ideal pin against 1.5 mm, both with the same friction."""

    def tile(title: str, ideal: str, name: str, change: str) -> Tile:
        tight, loose = (short(found[key], 1e-3, "kN") for key in ((ideal, IDEAL_DRY), (name, DRY)))
        return Tile(title, tight, loose, change)

    def along(name: str) -> str:
        return f"pin along its length: {short(found[name, contact_case(CYLINDERS)], 1e-3, 'kN')}"

    mean, fall, ripple = "mean_pin_force", "largest_pin_force_any_step", "rms_pin_force"
    ideal_mean, ideal_peak = found[mean, IDEAL_DRY], found["largest_pin_force", IDEAL_DRY]
    in_rise, shift = found["largest_pin_force_in_rise", DRY], found["mean_tip_shift", DRY]
    friction = f"friction alone, in the ideal pin: {against(ideal_mean, found[mean, IDEAL])}"
    times = f"{found[fall, DRY].value / ideal_peak.value:.1f} times, in the fall"
    alone = f"in the rise {in_rise.value / 1e3:.1f} kN ({against(in_rise, ideal_peak)})"
    towards = "to the rear" if shift.value < 0.0 else "forward"
    return (
        tile("mean force in the pin", mean, mean, f"{against(found[mean, DRY], ideal_mean)}; {friction}"),
        tile("peak force", "largest_pin_force", fall, f"{times}; {alone}; {along(fall)}"),
        Tile("canopy tip, mean place", "0", short(shift), f"{towards}, against the ideal pin"),
        tile("fluctuation of the force", ripple, ripple, f"RMS, faster than 0.1 s; {along(ripple)}"),
    )


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """The four rises and those with line contact, their numbers, figures and tables."""
    cases = scenarios()
    made = run_on_exudyn(cases, chosen)
    results = {name: made[name] for name in CASES}
    numbers = with_errors(measure(made))
    found = by_case(numbers)
    words = {"found": found, "run": sys.modules[__name__], "paper": paper_machine}
    drawings = figures(results)
    drawings["machine"] = machine_drawing(cases[DRY], marked=(PIN,))
    witness = Witness(cases, measure, tables)
    return StudyOutcome(
        numbers, words, drawings, tables(numbers), results, live=LIVE, tiles=tiles(found), witness=witness
    )


study = Study("clearance_influence", __doc__, work, seconds=12.0)
