"""What do contact laws deliver, and what does the choice of a law change in the rise of the support?

Every normal law is tried in free impacts through the engine: restitution asked for against delivered, beside
the closed form, and loops of force over depth. Then the support rises under each law, frictionless under the
normal laws and with each friction law; and with the textbook treatment of a contact that does not part.
"""

from collections.abc import Callable, Mapping, Sequence

from studies.common import paper_machine, rise
from studies.common.numbers import Found, Number, by_case, counted, measured, measured_all, rounded
from studies.common.options import Options
from studies.common.runs import run_cases, run_with_errors
from studies.common.study import Study, StudyOutcome
from studies.common.words import TextTable
from studies.contact_laws import cases, catalogue, free_impact
from studies.contact_laws.cases import FEW, IMPACT_STEPS, SPEED, WITH_CLEARANCE
from studies.contact_laws.catalogue import POWER_LAWS, title
from studies.contact_laws.figures import (
    loop_figure,
    permanent_figure,
    restitution_figure,
    rise_figure,
    row_title,
)
from support_exudyn import Result

DELIVERED = "delivered_restitution"


# --- measures ---


def restitution_numbers(results: Mapping[str, Result], expected: Mapping[str, float]) -> list[Number]:
    """Delivered restitution and its closed form, by case."""
    numbers = []
    for case, closed_form in expected.items():
        numbers.append(measured(DELIVERED, case, "1", results[case], free_impact.delivered_restitution))
        numbers.append(Number("closed_form_restitution", case, closed_form, "1", 0.0))
    return numbers


RISE_MEASURES: dict[str, tuple[str, Callable[[Result], float]]] = {
    "mean_pin_force": ("N", lambda r: float(r[rise.FORCE][rise.in_rise(r)].mean())),
    "std_pin_force": ("N", lambda r: float(r[rise.FORCE][rise.in_rise(r)].std())),
    "largest_pin_force_any_step": ("N", lambda r: float(r.largest_force[WITH_CLEARANCE])),
    "energy_dissipated": ("J", lambda r: r.dissipated),
    "energy_error": ("J", lambda r: r.energy_error),
}
RISE_COUNTS: dict[str, Callable[[Result], int]] = {
    "impacts": lambda r: len(r.onsets[WITH_CLEARANCE]),
    "clamped_steps": lambda r: r.counts.clamped_steps,
}
RISE_UNITS = {name: unit for name, (unit, _) in RISE_MEASURES.items()} | dict.fromkeys(RISE_COUNTS, "1")


def rise_numbers(results: Mapping[str, Result]) -> list[Number]:
    """Mean and spread over the records from 3 to 5 s, the rest over the whole run, by case."""
    numbers = []
    for case, result in results.items():
        numbers += measured_all({case: result}, RISE_MEASURES)
        numbers += [counted(name, case, result, count) for name, count in RISE_COUNTS.items()]
    return numbers


# --- tables ---


def restitution_table(numbers: Sequence[Number]) -> TextTable:
    """Delivered restitution, a row a law; and the largest distance from the closed form."""
    found = by_case(numbers)
    asked = [e for e in FEW if (DELIVERED, f"exact e={e:g}") in found]
    rows = []
    for name, own in _impacts(numbers).items():
        cells = [found.get((DELIVERED, f"{name} e={e:g}")) for e in asked]
        off = max(_off(found, case) for case in own)
        rows.append((title(name), *("" if n is None else f"{n.value:.4f}" for n in cells), f"{off:.0e}"))
    header = ("law", *(f"e = {e:g}" for e in asked), "off the closed form, at most")
    return TextTable(header, tuple(rows), width=200)


def _impacts(numbers: Sequence[Number]) -> dict[str, list[str]]:
    """Cases of free impacts by law."""
    by_law: dict[str, list[str]] = {}
    for n in numbers:
        if n.name == DELIVERED:
            by_law.setdefault(n.case.split(" ")[0], []).append(n.case)
    return by_law


def _off(found: Found, case: str) -> float:
    """Distance of a delivered restitution from its closed form."""
    return abs(found[DELIVERED, case].value - found["closed_form_restitution", case].value)


def rise_table(numbers: Sequence[Number]) -> TextTable:
    """The rise under each law, a row a law."""
    found = by_case(numbers)
    rows = []
    for case in dict.fromkeys(n.case for n in numbers):
        row = [found[name, case] for name in RISE_UNITS]
        rows.append((row_title(case), *(rounded(n.value, n.numerical_error) for n in row)))
    header = ("law", *(f"{name.replace('_', ' ')} [{unit}]" for name, unit in RISE_UNITS.items()))
    return TextTable(header, tuple(rows), width=200)


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """Free impacts and the rise under every law."""
    laws = cases.impact_laws(chosen.quick)
    impacts = {case: free_impact.free_impact(law, SPEED, IMPACT_STEPS) for case, (law, _) in laws.items()}
    loops = {
        name: free_impact.free_impact(law, SPEED, 128, records=800) for name, law in cases.loop_laws().items()
    }
    lifted = cases.rises(chosen.quick)
    done = run_with_errors(lifted | impacts, chosen)
    looped = run_cases(loops, chosen)
    restitutions = restitution_numbers(done, {case: expected for case, (_, expected) in laws.items()})
    risen = {name: done[name] for name in lifted}
    numbers = rise_numbers(risen)
    drawings = {
        "delivered_restitution": restitution_figure(restitutions),
        "force_depth_loops": loop_figure(looped),
        "rise_under_each_law": rise_figure(numbers),
        "permanent_contact": permanent_figure(risen),
    }
    tables = {"restitution_table": restitution_table(restitutions), "rise_table": rise_table(numbers)}
    words = _of_impacts(restitutions) | _of_rises(numbers)
    live = {"permanent_contact": (0, 1)}
    return StudyOutcome([*restitutions, *numbers], words, drawings, tables, risen, live=live)


def _of_impacts(numbers: Sequence[Number]) -> dict[str, object]:
    """What is said of free impacts, and of how all was run."""
    found = by_case(numbers)
    low, high = min(FEW), max(FEW)
    power = {name: found[DELIVERED, f"{name} e={low:g}"].value for name in POWER_LAWS}
    return {
        "cases": cases,
        "impact": free_impact,
        "title": title,
        "row_title": row_title,
        "pin_length": catalogue.PIN_LENGTH,
        "bore_radius": paper_machine.bearing(cases.CLEARANCE_MM).bore_radius,
        "offs": [_off(found, case) for of_law in _impacts(numbers).values() for case in of_law],
        "low": low,
        "high": high,
        "power": power,
        "most": max(power, key=power.__getitem__),
        "least": min(power, key=power.__getitem__),
        "paper_high": found[DELIVERED, f"lankarani_nikravesh e={high:g}"].value,
    }


def _of_rises(numbers: Sequence[Number]) -> dict[str, object]:
    """What is said of the rise under each law."""
    found = by_case(numbers)
    all_cases = list(dict.fromkeys(n.case for n in numbers))
    frictions = [case for case in all_cases if case.startswith("friction ")]
    hysteresis = [case for case in all_cases if case in POWER_LAWS]
    peaks = {
        case: found["largest_pin_force_any_step", case].value for case in all_cases if case not in frictions
    }

    def spread(name: str) -> float:
        values = [found[name, case].value for case in hysteresis]
        return max(values) / min(values) - 1.0

    return {
        "risen": found,
        "frictions": frictions,
        "hysteresis": hysteresis,
        "spread": {name: spread(name) for name in ("mean_pin_force", "std_pin_force")},
        "softest": min(peaks, key=peaks.__getitem__),
        "stiffest": max(peaks, key=peaks.__getitem__),
        "lost": max(found["energy_error", c].value / found["energy_dissipated", c].value for c in hysteresis),
    }


study = Study("contact_laws", __doc__, work)
main = study.main
