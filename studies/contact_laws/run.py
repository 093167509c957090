"""What do contact laws deliver, and what does the choice of a law change in the rise of the support?

Every normal law is tried in free impacts through the engine: restitution asked for against delivered, beside
the closed form, and loops of force over depth. Then the support rises under each law, frictionless under the
normal laws and with each friction law; and with the textbook treatment of a contact that does not part.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence

from studies.common import paper_machine, rise
from studies.common.chapter import Chapter, Sheet
from studies.common.study import (
    Number,
    Options,
    counted,
    measured,
    options,
    rounded,
    run_cases,
    run_main,
    run_with_errors,
    save_figures,
    save_run,
    show_table,
    write_summary,
)
from studies.common.wording import by_case, how_sure, percent, said
from studies.contact_laws import catalogue
from studies.contact_laws.cases import (
    CLEARANCE_MM,
    FEW,
    FRICTION,
    IMPACT_STEPS,
    LOOSE,
    RESTITUTION,
    RISE_IMPACT_STEPS,
    RISE_STEP,
    SPEED,
    TEXTBOOK,
    impact_laws,
    loop_laws,
    rises,
)
from studies.contact_laws.catalogue import POWER_LAWS, title
from studies.contact_laws.figures import (
    loop_figure,
    permanent_figure,
    pictures,
    restitution_figure,
    rise_figure,
    row_title,
)
from studies.contact_laws.free_impact import (
    BORE_MASS,
    JOURNAL_MASS,
    delivered_restitution,
    free_impact,
)
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style
from support_exudyn.sweeps.workers import worker_pool

STUDY = "contact_laws"


# --- measures ---


def restitution_numbers(results: Mapping[str, Result], expected: Mapping[str, float]) -> list[Number]:
    """Delivered restitution and its closed form, by case."""
    numbers = []
    for case, closed_form in expected.items():
        numbers.append(measured("delivered_restitution", case, "1", results[case], delivered_restitution))
        numbers.append(Number("closed_form_restitution", case, closed_form, "1", 0.0))
    return numbers


RISE_MEASURES: dict[str, tuple[str, Callable[[Result], float]]] = {
    "mean_pin_force": ("N", lambda r: float(r[rise.FORCE][rise.in_rise(r)].mean())),
    "std_pin_force": ("N", lambda r: float(r[rise.FORCE][rise.in_rise(r)].std())),
    "largest_pin_force_any_step": ("N", lambda r: float(r.largest_force[LOOSE])),
    "energy_dissipated": ("J", lambda r: r.dissipated),
    "energy_error": ("J", lambda r: r.energy_error),
}
RISE_COUNTS: dict[str, Callable[[Result], int]] = {
    "touches": lambda r: len(r.onsets[LOOSE]),
    "clamped_steps": lambda r: r.counts.clamped_steps,
}
RISE_UNITS = {name: unit for name, (unit, _) in RISE_MEASURES.items()} | dict.fromkeys(RISE_COUNTS, "1")


def rise_numbers(results: Mapping[str, Result]) -> list[Number]:
    """Mean and spread over the records from 3 to 5 s, the rest over the whole run, by case."""
    numbers = []
    for case, result in results.items():
        numbers += [
            measured(name, case, unit, result, measure) for name, (unit, measure) in RISE_MEASURES.items()
        ]
        numbers += [counted(name, case, result, count) for name, count in RISE_COUNTS.items()]
    return numbers


# --- tables ---


def restitution_table(numbers: Sequence[Number]) -> Sheet:
    """Delivered restitution, a row a law; and the largest distance from the closed form."""
    values = {(n.name, n.case): n.value for n in numbers}
    asked = [e for e in FEW if ("delivered_restitution", f"exact e={e:g}") in values]
    rows = []
    for name, own in _impacts(numbers).items():
        cells = [values.get(("delivered_restitution", f"{name} e={e:g}")) for e in asked]
        off = max(_off(values, case) for case in own)
        rows.append((title(name), *("" if v is None else f"{v:.4f}" for v in cells), f"{off:.0e}"))
    return Sheet(
        title="Restitution that a free impact delivers, through the engine",
        header=("law", *(f"e = {e:g}" for e in asked), "off the closed form, at most"),
        rows=tuple(rows),
    )


def _impacts(numbers: Sequence[Number]) -> dict[str, list[str]]:
    """Cases of free impacts by law."""
    by_law: dict[str, list[str]] = {}
    for n in numbers:
        if n.name == "delivered_restitution":
            by_law.setdefault(n.case.split(" ")[0], []).append(n.case)
    return by_law


def _off(values: Mapping[tuple[str, str], float], case: str) -> float:
    """Distance of a delivered restitution from its closed form."""
    return abs(values["delivered_restitution", case] - values["closed_form_restitution", case])


def rise_table(numbers: Sequence[Number]) -> Sheet:
    """The rise under each law, a row a law."""
    found = by_case(numbers)
    rows = []
    for case in dict.fromkeys(n.case for n in numbers):
        row = [found[name, case] for name in RISE_UNITS]
        rows.append((row_title(case), *(rounded(n.value, n.numerical_error) for n in row)))
    return Sheet(
        title=f"Rise of the reference support, {CLEARANCE_MM} mm, restitution {RESTITUTION}",
        header=("law", *(f"{name.replace('_', ' ')} [{unit}]" for name, unit in RISE_UNITS.items())),
        rows=tuple(rows),
        caption=(
            "± is the estimated error, of three runs. Mean and std: 3 to 5 s, every "
            f"{1e3 * RISE_STEP:g} ms; the rest: 0 to 5 s. Laws without damping, or with little under "
            "load, never come to rest: their numbers are those of a chaotic vibration, and the ± says so."
        ),
    )


# --- words ---


def chapter(restitutions: Sequence[Number], risen: Sequence[Number], quick: bool) -> Chapter:
    """The study as a chapter of the report."""
    return Chapter(
        study=STUDY,
        title="Contact and friction laws",
        question=(
            "What restitution does each contact law deliver, and what does the choice of a law change in the "
            "rise?"
        ),
        method=_method(quick),
        findings=(*_impact_findings(restitutions), *_rise_findings(risen)),
        pictures=pictures(),
        sheets=(restitution_table(restitutions), rise_table(risen)),
        quick=quick,
    )


def _method(quick: bool) -> tuple[str, ...]:
    bearing = paper_machine.bearing(CLEARANCE_MM)
    few = "This quick form takes only some of the restitutions, and in the rise only some of the laws. "
    return (
        f"Free impacts: a journal of {JOURNAL_MASS:g} kg flies at {SPEED} m/s against the wall of a free bore "
        f"of {BORE_MASS:g} kg, with nothing else acting, under every normal law and for a range of "
        "restitutions asked for. What comes out of the engine is compared with the closed form, or, where a "
        "law has none, with an integration in one dimension.",
        f"The rise: the reference support with {CLEARANCE_MM} mm of clearance in the rear-link pin and a "
        f"restitution of {RESTITUTION}, raised as in the paper (mode 2), once under each normal law without "
        f"friction and once with each friction law (sliding coefficient {FRICTION}, static a quarter above it) "
        "on the exact law. "
        f"{few if quick else ''}"
        "Point-contact laws have the paper's stiffness, linear laws the stiffness that holds the pin's load at "
        f"the same depth, line-contact laws an assumed length of {1e3 * catalogue.PIN_LENGTH:g} mm and a "
        f"bore radius of {1e3 * bearing.bore_radius:g} mm.",
        "A contact that does not part is damped by the depth it reaches (DepthSpeed); two more rises use the "
        "textbook's speed of the last touch, with two floors below which that speed is not let fall.",
        f"In the first run an undamped free impact takes {IMPACT_STEPS} steps, one in the rise "
        f"{RISE_IMPACT_STEPS[quick]}. Between impacts its step is {1e3 * RISE_STEP:g} ms, and so is the "
        "time between two records. "
        f"{how_sure(quick)}",
    )


def _impact_findings(numbers: Sequence[Number]) -> tuple[str, ...]:
    values = {(n.name, n.case): n.value for n in numbers}
    laws = _impacts(numbers)
    off = max(_off(values, case) for cases in laws.values() for case in cases)
    low = min(FEW)
    power = {name: values["delivered_restitution", f"{name} e={low:g}"] for name in POWER_LAWS}
    most, least = max(power, key=power.__getitem__), min(power, key=power.__getitem__)
    paper = [(e, values["delivered_restitution", f"lankarani_nikravesh e={e:g}"]) for e in (low, max(FEW))]
    return (
        f"The engine delivers what the closed forms say: all {sum(map(len, laws.values()))} free impacts are "
        f"within {off:.0e} of it.",
        f"Laws deliver other restitutions than they are asked for. Asked for {low:g}, "
        f"{title(most)} delivers {power[most]:.3f} and {title(least)} {power[least]:.3f}; the exact law "
        f"delivers {power['exact']:.3f}. The paper's law, Lankarani-Nikravesh, delivers "
        f"{paper[0][1]:.3f} for {paper[0][0]:g} and {paper[1][1]:.3f} for {paper[1][0]:g}.",
    )


def _rise_findings(numbers: Sequence[Number]) -> tuple[str, ...]:
    found = by_case(numbers)
    cases = list(dict.fromkeys(n.case for n in numbers))
    power = [case for case in cases if case in POWER_LAWS]
    frictions = [case for case in cases if case.startswith("friction ")]
    sentences = [_spread(found, power)]
    peaks = {case: found["largest_pin_force_any_step", case] for case in cases if case not in frictions}
    low, high = min(peaks, key=lambda c: peaks[c].value), max(peaks, key=lambda c: peaks[c].value)
    sentences.append(
        "The largest force follows the stiffness: from "
        f"{said(peaks[low], 1e-3, 'kN')} ({row_title(low)}) to {said(peaks[high], 1e-3, 'kN')} "
        f"({row_title(high)})."
    )
    stds = "; ".join(
        f"{row_title(c).partition(': ')[2]} {said(found['std_pin_force', c], 1e-3, 'kN')}" for c in frictions
    )
    frictionless = said(found["std_pin_force", "exact"], 1e-3, "kN")
    sentences.append(
        f"Standard deviation of the pin force with friction laws: {stds}; without: {frictionless}."
    )
    textbook = "; ".join(
        f"floor {1e3 * floor:g} mm/s {said(found['std_pin_force', case], 1e-3, 'kN')}"
        for case, floor in TEXTBOOK.items()
    )
    sentences.append(
        "How a contact that does not part is damped decides how much vibration is left. Standard deviation of "
        f"the pin force under Lankarani-Nikravesh: by the depth "
        f"{said(found['std_pin_force', 'lankarani_nikravesh'], 1e-3, 'kN')}; by the last touch: {textbook}."
    )
    lost = max(found["energy_error", c].value / found["energy_dissipated", c].value for c in power)
    sentences.append(
        f"Under the laws with hysteresis damping at most {lost:.0e} of the dissipated energy is not accounted "
        "for."
    )
    return tuple(sentences)


def _spread(found: Mapping[tuple[str, str], Number], cases: Sequence[str]) -> str:
    """How far laws with hysteresis damping and the same stiffness are apart."""
    apart = []
    for name in ("mean_pin_force", "std_pin_force"):
        values = [found[name, case].value for case in cases]
        apart.append(percent(max(values) / min(values) - 1.0))
    return (
        f"Among the {len(cases)} laws with hysteresis damping and the paper's stiffness, mean pin force and "
        f"its standard deviation over the rise differ, largest from smallest, by {apart[0]} and {apart[1]}."
    )


# --- main ---


def study(chosen: Options) -> None:
    """Run, measure, draw and write everything into the output folder."""
    started = time.perf_counter()
    laws = impact_laws(chosen.quick)
    impacts = {case: free_impact(law, SPEED, IMPACT_STEPS) for case, (law, _) in laws.items()}
    lifted = rises(chosen.quick)
    with worker_pool(chosen.workers) as pool:
        done = run_with_errors(lifted | impacts, pool)
        loops = run_cases(
            {name: free_impact(law, SPEED, 128, records=800) for name, law in loop_laws().items()}, pool
        )
    restitutions = restitution_numbers(done, {case: expected for case, (_, expected) in laws.items()})
    risen = {name: done[name] for name in lifted}
    numbers = rise_numbers(risen)
    for name, result in risen.items():
        save_run(result, chosen.out, _file_name(name))
    with style.look():
        drawings = {
            "delivered_restitution": restitution_figure(restitutions),
            "force_depth_loops": loop_figure(loops),
            "rise_under_each_law": rise_figure(numbers),
            "permanent_contact": permanent_figure(risen),
        }
    save_figures(chosen, drawings)
    tables = [restitution_table(restitutions), rise_table(numbers)]
    for name, table in zip(("restitution_table", "rise_table"), tables, strict=True):
        show_table(chosen.out / f"{name}.txt", table, width=200)
    chapter(restitutions, numbers, chosen.quick).save(chosen.out)
    write_summary(chosen.out, STUDY, [*restitutions, *numbers], time.perf_counter() - started)


def _file_name(case: str) -> str:
    kept = case.replace("m/s", "mps").replace(" ", "_").replace(",", "").replace(".", "p")
    return kept.replace("/", "_")


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.contact_laws`."""
    description = (__doc__ or "").splitlines()[0]
    return run_main(study, options(STUDY, argv, description))
