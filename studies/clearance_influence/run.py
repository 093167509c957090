"""What does 1.5 mm of clearance in the rear-link pin do to the rise? (Section 3 of the paper.)

The support stands still for 3 s, while the journal falls from the middle of its bore and comes to rest,
and rises by 500 mm in the next 2 s. Ideal pin against 1.5 mm, both without friction and both with the same.
"""

import math
import sys
from collections.abc import Callable, Mapping, Sequence

from studies.clearance_influence import contacts
from studies.clearance_influence.figures import CASES, DRY, IDEAL, IDEAL_DRY, LIVE, SMOOTH, figures
from studies.common import paper_machine, rise
from studies.common.chapter import Tile
from studies.common.numbers import (
    Found,
    Number,
    against,
    by_case,
    cell,
    compared,
    counted,
    in_tile,
    measured,
    printed,
    rounded,
    short,
)
from studies.common.options import Options
from studies.common.paper_machine import CLEARANCE_MM, ideal_of
from studies.common.runs import impacts
from studies.common.study import Study, StudyOutcome
from studies.common.subject import paper_subject
from studies.common.witness import Witness, run_on_exudyn, with_errors
from studies.common.words import TextTable
from support_exudyn import Result, Scenario
from support_exudyn.postprocessing.figures.linkage_drawing import machine_drawing


def scenarios() -> dict[str, Scenario]:
    """The four cases."""
    paper = paper_subject()
    return {
        IDEAL: paper.ideal(),
        IDEAL_DRY: paper.ideal(paper.friction),
        SMOOTH: paper.with_clearance(CLEARANCE_MM, 0.0),
        DRY: paper.with_clearance(CLEARANCE_MM, paper.friction),
    }


# --- measures ---


def _mean(channel: str, scale: float = 1.0) -> Callable[[Result], float]:
    return lambda run: scale * rise.PAPER.mean(run, channel)


def _spread(channel: str, scale: float = 1.0) -> Callable[[Result], float]:
    return lambda run: scale * rise.PAPER.spread(run, channel)


# unit, measure, and what the paper prints of it, by clearance
OF_RISE: dict[str, tuple[str, Callable[[Result], float], Mapping[float, float] | None]] = {
    "mean_pin_force": ("N", _mean(rise.FORCE), paper_machine.MEAN_FORCE),
    "std_pin_force": ("N", _spread(rise.FORCE), paper_machine.FORCE_SPREAD),
    "rms_pin_force": ("N", lambda run: rise.PAPER.rms_fluctuation(run, run[rise.FORCE]), None),
    "largest_pin_force": ("N", rise.Crest(rise.FORCE, begin=0.0), None),
    "largest_pin_force_in_rise": ("N", rise.Crest(rise.FORCE), None),
    "largest_angular_speed_in_rise": ("deg/s", rise.Crest(rise.SPEED, rise.DEGREES), None),
    "mean_angular_acceleration": (
        "deg/s^2", _mean(rise.ACCELERATION, rise.DEGREES), paper_machine.MEAN_ACCELERATION
    ),
    "std_angular_acceleration": ("deg/s^2", _spread(rise.ACCELERATION, rise.DEGREES), None),
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
        if case in (SMOOTH, DRY):
            numbers += _comparison_numbers(case, result, results[ideal_of(case)])
            numbers += _impact_numbers(case, result)
        numbers += _energy_numbers(case, result)
    return numbers


def _rise_numbers(case: str, result: Result) -> list[Number]:
    """Statistics of the rise, from 3 to 5 s; the largest from 0 to 5 s."""
    # the paper has friction, though with data it does not give
    return [
        measured(name, case, unit, result, get, table[CLEARANCE_MM] if table and case == DRY else None)
        for name, (unit, get, table) in OF_RISE.items()
    ]


def _comparison_numbers(case: str, result: Result, ideal: Result) -> list[Number]:
    """The changes against the ideal pin with the same friction, record by record, from 3 to 5 s."""

    def departure(channel: str, scale: float) -> Callable[[Result, Result], rise.Series]:
        return lambda run, other: scale * rise.departure(run, other, channel)

    force = departure(rise.FORCE, 1.0)
    speed = departure(rise.SPEED, rise.DEGREES)
    tip = departure("tip.x", 1e3)

    def over(run: Result, values: rise.Series) -> tuple[rise.Series, rise.Series]:
        return run.time[rise.in_rise(run)], values

    table: list[tuple[str, str, Callable[[Result, Result], float]]] = [
        ("rms_pin_force_departure", "N", lambda run, other: _rms(*over(run, force(run, other)))),
        ("rms_angular_velocity_departure", "deg/s", lambda run, other: _rms(*over(run, speed(run, other)))),
        ("mean_tip_shift", "mm", lambda run, other: rise.mean(*over(run, tip(run, other)))),
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


def _rms(time: rise.Series, values: rise.Series) -> float:
    return math.sqrt(rise.mean(time, values**2))


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


def key_table(found: Found) -> TextTable:
    """What an engineer asks for first, a column a case."""
    rows = []
    for name, (what, scale) in KEY.items():
        numbers = [found.get((name, case)) for case in CASES]
        of_paper = next((n.paper for n in numbers if n is not None and n.paper is not None), None)
        cells = ["" if n is None else rounded(scale * n.value, scale * n.numerical_error) for n in numbers]
        rows.append((what, *cells, "" if of_paper is None else f"{scale * of_paper:.3f}"))
    return TextTable(("quantity", *CASES, "paper, 1.5 mm"), tuple(rows))


def full_table(numbers: Sequence[Number]) -> TextTable:
    """All numbers of the four cases, a row a name, a column a case."""
    by_name: dict[str, dict[str, Number]] = {}
    for number in numbers:
        if number.case in (*CASES, f"{CLEARANCE_MM} mm"):
            by_name.setdefault(number.name, {})[number.case] = number
    rows = tuple(_row(name, row) for name, row in by_name.items())
    return TextTable(("quantity", "unit", *CASES, "paper"), rows, left=2)


def _row(name: str, row: Mapping[str, Number]) -> tuple[str, ...]:
    any_case = f"{CLEARANCE_MM} mm"
    cells = [cell(row.get(case)) for case in CASES]
    if any_case in row:
        cells = [cell(row[any_case]) if case in (SMOOTH, DRY) else "" for case in CASES]
    of_paper = next((n for n in row.values() if n.paper is not None), None)
    return name.replace("_", " "), next(iter(row.values())).unit, *cells, printed(of_paper)


def tiles(found: Found) -> tuple[Tile, ...]:
    """The first screen of the report: the ideal pin against 1.5 mm, both with the same friction."""
    peak, in_rise = found["largest_pin_force_any_step", DRY], found["largest_pin_force_in_rise", DRY]
    ideal_peak, shift = found["largest_pin_force", IDEAL_DRY], found["mean_tip_shift", DRY]
    mean, ideal_mean = found["mean_pin_force", DRY], found["mean_pin_force", IDEAL_DRY]
    ripple, ideal_ripple = found["rms_pin_force", DRY], found["rms_pin_force", IDEAL_DRY]
    times = f"{peak.value / ideal_peak.value:.1f} times"
    along = [
        short(found[n, contacts.along_the_length()], 1e-3, "kN")
        for n in ("largest_pin_force_any_step", "rms_pin_force")
    ]
    alone = f"{in_rise.value / 1e3:.1f} kN ({against(in_rise, ideal_peak)})"
    towards = "to the rear" if shift.value < 0.0 else "forward"
    friction = against(ideal_mean, found["mean_pin_force", IDEAL])
    return (
        Tile("mean force in the pin", in_tile(ideal_mean, 1e-3, "kN"), in_tile(mean, 1e-3, "kN"),
             f"{against(mean, ideal_mean)}; friction alone, in the ideal pin: {friction}"),
        Tile("peak force", in_tile(ideal_peak, 1e-3, "kN"), in_tile(peak, 1e-3, "kN"),
             f"{times}, in the fall; in the rise {alone}; pin along its length: {along[0]}"),
        Tile("canopy tip, mean place", "0", in_tile(shift, 1.0, "mm"), f"{towards}, against the ideal pin"),
        Tile("fluctuation of the force", in_tile(ideal_ripple, 1e-3, "kN"), in_tile(ripple, 1e-3, "kN"),
             f"root mean square of what is faster than 0.1 s; pin along its length: {along[1]}"),
    )  # fmt: skip


# --- the study ---


def tables(numbers: Sequence[Number]) -> dict[str, TextTable]:
    """All tables, the key table first."""
    found = by_case(numbers)
    return {
        "key_numbers": key_table(found),
        "table": full_table(numbers),
        "by_contact": contacts.contact_table(found, (paper_machine.SLIDING_COEFFICIENT, 0.0)),
    }


def work(chosen: Options) -> StudyOutcome:
    """The four rises and those by another contact, their numbers, figures and tables."""
    cases, subject = scenarios(), paper_subject()
    by_contact = contacts.scenarios(subject)

    def numbers_of(made: Mapping[str, Result]) -> list[Number]:
        of_contacts = contacts.measure(subject, {name: made[name] for name in by_contact})
        return [*measure({name: made[name] for name in cases}), *of_contacts]

    made = run_on_exudyn(cases | by_contact, chosen)
    results = {name: made[name] for name in cases}
    numbers = with_errors(numbers_of(made))
    found = by_case(numbers)
    words = {"found": found, "run": sys.modules[__name__], "paper": paper_machine, "contacts": contacts}
    drawings = figures(results)
    drawings["machine"] = machine_drawing(cases[DRY], marked=(paper_machine.CLEARANCE_PIN,))
    witness = Witness(cases | by_contact, numbers_of, tables)
    return StudyOutcome(
        numbers, words, drawings, tables(numbers), results, live=LIVE, tiles=tiles(found), witness=witness
    )


study = Study("clearance_influence", __doc__, work, seconds=12.0)
main = study.main
