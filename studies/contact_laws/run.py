"""What do contact laws deliver, and what does the choice of a law change in the motion?

Every normal law is tried in free impacts through the engine: restitution asked for against delivered, beside
the closed form, and loops of force over depth. Then the machine moves under each law: without friction under
the normal laws, with each friction law, and with several rest velocities, by which a contact that stays closed
is damped.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from studies.common.numbers import Found, Number, by_case, cell, counted, measured, measured_all, rounded
from studies.common.options import Options
from studies.common.rise import Watched
from studies.common.runs import run_cases, run_with_errors
from studies.common.study import Study, StudyOutcome
from studies.common.words import text_table
from studies.contact_laws import cases, catalogue
from studies.contact_laws.cases import (
    FEW,
    IMPACT_STEPS,
    KEY,
    REST,
    SOFT,
    SPEED,
    Joint,
    damping_ratio,
    soft_restitution,
)
from studies.contact_laws.catalogue import POWER_LAWS, title
from studies.contact_laws.figures import (
    answer_figure,
    loop_figure,
    permanent_figure,
    rise_figure,
    row_title,
)
from support_exudyn import Result
from support_exudyn.postprocessing.page.pieces import Sheet

RUBBING = ", with friction"  # what cases of laws with hysteresis damping are called
DELIVERED = "delivered_restitution"


# --- measures ---


def restitution_numbers(results: Mapping[str, Result], expected: Mapping[str, float]) -> list[Number]:
    """Delivered restitution and its closed form, by case."""
    numbers = []
    for case, closed_form in expected.items():
        numbers.append(measured(DELIVERED, case, "1", results[case], cases.delivered_restitution))
        numbers.append(Number("closed_form_restitution", case, closed_form, "1", 0.0))
    return numbers


RISE_UNITS = {
    "mean_pin_force": "N", "std_pin_force": "N", "largest_pin_force_any_step": "N", "energy_dissipated": "J",
    "energy_error": "J", "impacts": "1", "clamped_steps": "1",
}  # fmt: skip


def rise_numbers(watched: Watched, results: Mapping[str, Result]) -> list[Number]:
    """Mean and spread while the machine moves, the rest over the whole run, by case."""
    measures: dict[str, Callable[[Result], float]] = {
        "mean_pin_force": lambda r: watched.mean(r, watched.force),
        "std_pin_force": lambda r: watched.spread(r, watched.force),
        "largest_pin_force_any_step": lambda r: float(r.largest_force[watched.pin]),
        "energy_dissipated": lambda r: r.dissipated,
        "energy_error": lambda r: r.energy_error,
    }
    counts: dict[str, Callable[[Result], int]] = {
        "impacts": lambda r: len(r.onsets[watched.pin]),
        "clamped_steps": lambda r: r.counts.clamped_steps,
    }
    units = {name: (RISE_UNITS[name], measure) for name, measure in measures.items()}
    numbers = []
    for case, result in results.items():
        numbers += measured_all({case: result}, units)
        numbers += [counted(name, case, result, count) for name, count in counts.items()]
    return numbers


# --- tables ---


def key_table(found: Found) -> Sheet:
    """What an engineer asks for first, a row a law: what it delivers, and the motion under it."""
    rows = []
    for case in KEY:
        restitutions = [found.get((DELIVERED, f"{case} e={asked:g}")) for asked in (min(FEW), max(FEW))]
        forces = [found[f"{name}_pin_force", case] for name in ("mean", "std")]
        peak = found["largest_pin_force_any_step", case]
        kilonewtons = [rounded(1e-3 * n.value, 1e-3 * n.numerical_error) for n in (*forces, peak)]
        delivered = ["" if n is None else f"{n.value:.3f}" for n in restitutions]
        rows.append((row_title(case), *delivered, *kilonewtons))
    asked = tuple(f"delivers for e = {e:g}" for e in (min(FEW), max(FEW)))
    header = ("law", *asked, "mean force [kN]", "its std [kN]", "largest force [kN]")
    return text_table(header, rows)


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


def rest_table(watched: Watched, results: Mapping[str, Result], numbers: Sequence[Number]) -> Sheet:
    """What the rest velocity changes, a row a velocity: damping, soft impacts, the motion, its cost."""
    found, rows = by_case(numbers), []
    for case, velocity in REST.items():
        result = results[case]
        ratio = damping_ratio(result.scenario, watched.pin)
        soft = [f"{soft_restitution(result.scenario, watched.pin, speed):.3f}" for speed in SOFT]
        force = cell(found["std_pin_force", case])
        rows.append((f"{1e3 * velocity:g}", f"{ratio:.2g}", *soft, force, f"{result.counts.steps}"))
    impacts = (f"delivered at {1e3 * speed:g} mm/s" for speed in SOFT)
    header = ("rest velocity [mm/s]", "damping ratio at rest", *impacts, "std pin force [N]", "steps")
    return text_table(header, rows)


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """Free impacts, and the motion under every law."""
    subject = chosen.subject
    ideal = run_cases({"ideal": subject.ideal()}, chosen)["ideal"]
    joint = Joint(subject, subject.watched.mean(ideal, ideal[subject.watched.force]))
    laws = cases.impact_laws()
    impacts = {case: cases.free_impact(law, SPEED, IMPACT_STEPS) for case, (law, _) in laws.items()}
    loops = {
        f"loop {name}": cases.free_impact(law, SPEED, 128, records=800)
        for name, law in cases.loop_laws().items()
    }
    at_steps = {name: case for name, case in joint.runs.items() if case.accuracy is None}
    made_anew = replace(chosen, kept=None)  # sooner than read: each takes a twentieth of a second
    done = run_with_errors(impacts, made_anew) | run_cases(loops, made_anew)
    done |= run_with_errors(joint.runs, chosen)
    rubbed = run_with_errors({f"{name}{RUBBING}": case for name, case in joint.rubbing.items()}, chosen)
    resting = run_with_errors(joint.resting, chosen)
    restitutions = restitution_numbers(done, {case: expected for case, (_, expected) in laws.items()})
    risen = {name: done[name] for name in joint.runs}
    numbers = rise_numbers(subject.watched, risen)
    with_friction = rise_numbers(subject.watched, rubbed)
    rested = rise_numbers(subject.watched, resting)
    found = by_case([*restitutions, *numbers])
    drawings = {
        "laws_at_a_glance": answer_figure(found),
        "force_depth_loops": loop_figure({name.removeprefix("loop "): done[name] for name in loops}),
        "rise_under_each_law": rise_figure(subject.watched, numbers),
        "permanent_contact": permanent_figure(subject.watched, resting),
    }
    tables = {
        "laws": key_table(found),
        "rest_table": rest_table(subject.watched, resting, rested),
    }
    words = (
        _of_impacts(joint, restitutions)
        | _of_rises(numbers)
        | {"rubbing": _spreads(by_case(with_friction), [f"{name}{RUBBING}" for name in POWER_LAWS])}
        | {
            "joint": joint,
            "rested": by_case(rested),
            "at_steps": at_steps,
            "goal": ideal.goal,
        }
    )
    live = {"permanent_contact": (0, 1)}
    return StudyOutcome(
        [*restitutions, *numbers, *with_friction, *rested], words, drawings, tables, risen | resting, live=live
    )


def _of_impacts(joint: Joint, numbers: Sequence[Number]) -> dict[str, object]:
    """What is said of free impacts, and of how all was run."""
    found = by_case(numbers)
    low, high = min(FEW), max(FEW)
    power = {name: found[DELIVERED, f"{name} e={low:g}"].value for name in POWER_LAWS}
    return {
        "cases": cases,
        "impact": cases,
        "title": title,
        "row_title": row_title,
        "pin_length": joint.length or catalogue.pin_length(joint.pin.contact.bearing.bore_radius),
        "bore_radius": joint.pin.contact.bearing.bore_radius,
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

    return {
        "risen": found,
        "frictions": frictions,
        "hysteresis": hysteresis,
        "spread": _spreads(found, hysteresis),
        "softest": min(peaks, key=peaks.__getitem__),
        "stiffest": max(peaks, key=peaks.__getitem__),
        "lost": max(found["energy_error", c].value / found["energy_dissipated", c].value for c in hysteresis),
    }


def _spreads(found: Found, cases_of: Sequence[str]) -> dict[str, float]:
    """By what share the largest of some cases exceeds the smallest: mean pin force and standard deviation."""
    spreads = {}
    for name in ("mean_pin_force", "std_pin_force"):
        values = [found[name, case].value for case in cases_of]
        spreads[name] = max(values) / min(values) - 1.0
    return spreads


study = Study("contact_laws", __doc__, work, seconds=30.0, own_machine=True)
