"""What does the size of the clearance change in the rise: motion, force, posture? (Section 4 of the paper.)

Ideal pin, 0.5, 1.0, 1.5 and 2.0 mm, all with friction and all without: motion and force of the rear link, path
of the canopy's tip, angles of the columns.
"""

from collections.abc import Mapping, Sequence

from studies.clearance_size.figures import figures, live
from studies.clearance_size.measures import measure
from studies.common import paper_machine
from studies.common.numbers import Found, Number, by_case, cell, printed, rounded
from studies.common.options import Options
from studies.common.paper_machine import SIZES_MM, case_name, ideal_name, ideal_of
from studies.common.study import Study, StudyOutcome
from studies.common.subject import Subject
from studies.common.witness import Witness, difference, run_on_exudyn, with_errors, witnessed
from studies.common.words import TextTable
from support_exudyn import Result, Scenario


def scenarios(subject: Subject) -> dict[str, Scenario]:
    """The ideal pin and every clearance, with and without friction."""
    frictions = (subject.friction, 0.0)
    with_clearance = {
        case_name(size, friction): subject.with_clearance(size, friction)
        for friction in frictions
        for size in SIZES_MM
    }
    return with_clearance | {ideal_name(friction): subject.ideal(friction) for friction in frictions}


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


def key_table(found: Found, friction: float) -> TextTable:
    """What an engineer asks for first, a row for each clearance, with friction."""
    shown = {name: about for name, about in KEY.items() if (name, ideal_name(friction)) in found}
    rows = []
    for case in _cases(friction):
        numbers = [(found[name, case], scale) for name, (_, scale) in shown.items()]
        cells = [rounded(scale * n.value, scale * n.numerical_error) for n, scale in numbers]
        rows.append((case.split(",")[0], *cells))
    return TextTable(("clearance", *(heading for heading, _ in shown.values())), tuple(rows))


def stiffness_table(numbers: Sequence[Number]) -> TextTable:
    """Counterpart of Table 2."""
    rows = []
    for n in numbers:
        if n.name == "stiffness_coefficient" and n.paper is not None:
            shaft = 1e3 * paper_machine.BORE_RADIUS - float(n.case.split()[0])
            rows.append((n.case, f"{shaft:.1f}", f"{n.value:.3f}", f"{n.paper:.3f}"))
    return TextTable(("clearance", "shaft radius [mm]", "here [N/mm^1.5]", "paper"), tuple(rows))


def force_table(found: Found, frictions: Sequence[float]) -> TextTable:
    """Counterpart of Table 3."""
    rows = []
    for case in [case for mu in frictions for case in _cases(mu)]:
        for name, title in OF_FORCE.items():
            number = found[name, case]
            rows.append((case, title, cell(number), witnessed(number), difference(number), printed(number)))
    return TextTable(("case", "pin force", "Exudyn [N]", "witness", "difference", "paper"), tuple(rows), left=2)


def number_table(found: Found, friction: float) -> TextTable:
    """All measures, a column for each clearance."""
    cases = _cases(friction)
    names = {name: number.unit for (name, case), number in found.items() if case == ideal_name(friction)}
    rows = tuple(
        (name.replace("_", " "), unit, *(cell(found[name, case]) for case in cases))
        for name, unit in names.items()
    )
    return TextTable(("quantity", "unit", *(case.split(",")[0] for case in cases)), rows, left=2)


def _cases(friction: float) -> list[str]:
    """The ideal pin and every clearance, all with the same friction."""
    return [ideal_name(friction), *(case_name(size, friction) for size in SIZES_MM)]


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """All rises, their numbers, figures and tables."""
    subject = chosen.subject
    frictions = (subject.friction, 0.0)
    measures = {f"table_mu{friction:g}".replace(".", "p"): friction for friction in frictions}

    def numbers_of(results: Mapping[str, Result]) -> list[Number]:
        return measure(subject, results)

    def tables(numbers: Sequence[Number]) -> dict[str, TextTable]:
        known = by_case(numbers)
        return {
            "by_clearance": key_table(known, subject.friction),
            **({"table_2": stiffness_table(numbers)} if subject.is_paper else {}),
            "table_3": force_table(known, frictions),
            **{name: number_table(known, friction) for name, friction in measures.items()},
        }

    cases = scenarios(subject)
    results = run_on_exudyn(cases, chosen)
    numbers = with_errors(numbers_of(results))
    found = by_case(numbers)
    words = {
        "found": found, "mu": subject.friction, "frictions": frictions,
        "sizes": SIZES_MM, "case_name": case_name, "ideal_name": ideal_name, "ideal_of": ideal_of,
        "all_measures": measures, "has_tip": ("mean_tip_shift", ideal_name(0.0)) in found,
        "watched": subject.watched, "window": f"{subject.watched.window:g} s",
    }  # fmt: skip
    drawings = figures(subject, results, found)
    witness = Witness(cases, numbers_of, tables)
    return StudyOutcome(
        numbers, words, drawings, tables(numbers), results, live=live(drawings), witness=witness
    )


study = Study("clearance_size", __doc__, work, seconds=14.0, own_machine=True)
main = study.main
