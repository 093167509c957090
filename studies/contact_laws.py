"""What do contact laws deliver, and what does the choice of a law change in the rise of the support?

Every normal law is tried in free impacts through the engine: restitution asked for against delivered, beside
the closed form, and loops of force over depth. Then the support rises under each law, frictionless under the
normal laws and with each friction law; and with the textbook treatment of a contact that does not part.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from studies import law_catalogue, paper_machine, style
from studies.free_impact import (
    BORE_MASS,
    JOURNAL_MASS,
    PIN,
    delivered_restitution,
    free_impact,
    one_dimensional_restitution,
)
from studies.law_catalogue import CYLINDER_LAWS, POWER_LAWS, title
from studies.reporting.chapter import Chapter, Picture, Sheet
from studies.reporting.wording import by_case, how_sure, percent, said
from studies.study import (
    Number,
    Options,
    Pair,
    options,
    rounded,
    run_cases,
    run_main,
    run_pairs,
    show_table,
    write_summary,
)
from support_exudyn import ClearancePin, Result, Scenario, SolverSettings
from support_exudyn.workers import worker_pool
from user_forces import (
    AdamsImpact,
    Anagnostopoulos,
    Exact,
    FrictionLaw,
    Frictionless,
    Hertz,
    JournalContact,
    KelvinVoigt,
    LankaraniNikravesh,
    NormalLaw,
    TouchSpeed,
)

Series = npt.NDArray[np.float64]
STUDY = "contact_laws"
ASKED = tuple(n / 20 for n in range(1, 20))  # e = 0.05, 0.1 ... 0.95
FEW = (0.1, 0.3, 0.5, 0.7, 0.9)  # for laws whose damping factor is another's
QUICK_ASKED = (0.1, 0.5, 0.9)  # of all laws in the quick form
SPEED = 0.2  # of free impacts [m/s]
# by whether the form is the quick one: of the coarser of the two runs of a case
IMPACT_STEPS = {False: 192, True: 96}  # of a free impact
RISE_IMPACT_STEPS = {False: 64, True: 32}  # of an impact in a rise
RISE_STEP = {False: 1e-3, True: 4e-3}  # of a rise between impacts, and time between records [s]
LOOP_RESTITUTION = 0.5
CLEARANCE_MM = 1.5
RESTITUTION = paper_machine.RESTITUTION
FRICTION = paper_machine.SLIDING_COEFFICIENT
LOOSE = paper_machine.LOOSE_PIN
FORCE = f"pin.{LOOSE}.force"
RISE_START = 3.0  # [s]
QUICK_RISE = ("exact", "lankarani_nikravesh", "anagnostopoulos", "friction ambrosio")
TEXTBOOK = {
    "lankarani_nikravesh, last touch, floor 1 mm/s": 1e-3,
    "lankarani_nikravesh, last touch, floor 100 mm/s": 0.1,
}
REDUCED_MASS = BORE_MASS * JOURNAL_MASS / (BORE_MASS + JOURNAL_MASS)  # of free impacts [kg]
STIFFNESS = 1e8  # K of free impacts [N/m^1.5], or [N/m] of linear laws


# --- cases ---


def impact_laws(quick: bool) -> dict[str, tuple[NormalLaw, float]]:
    """Laws of the free impacts and the restitution that is to come out, by case."""
    cases: dict[str, tuple[NormalLaw, float]] = {}
    for name, law in POWER_LAWS.items():
        for asked in QUICK_ASKED if quick else ASKED:
            chosen = law(stiffness=STIFFNESS, restitution=asked)
            cases[f"{name} e={asked:g}"] = (chosen, chosen.delivered_restitution)
    for asked in QUICK_ASKED if quick else FEW:
        linear = Anagnostopoulos(stiffness=STIFFNESS, restitution=asked)
        cases[f"anagnostopoulos e={asked:g}"] = (linear, linear.delivered_restitution)
        bearing = paper_machine.bearing(CLEARANCE_MM)
        for name in CYLINDER_LAWS:
            line = law_catalogue.cylinder_law(name, bearing, asked)
            cases[f"{name} e={asked:g}"] = (line, line.delivered_restitution)
    cases["hertz e=1"] = (Hertz(stiffness=STIFFNESS), 1.0)
    for ratio in (0.05, 0.2, 0.5, 1.0):
        dashpot = KelvinVoigt(
            stiffness=STIFFNESS, damping=float(2.0 * ratio * np.sqrt(STIFFNESS * REDUCED_MASS))
        )
        cases[f"kelvin_voigt zeta={ratio:g}"] = (dashpot, dashpot.delivered_restitution(REDUCED_MASS))
    for depth in (1e-3, 1e-4):
        impact = AdamsImpact(stiffness=STIFFNESS, full_damping=500.0, full_damping_depth=depth)
        cases[f"adams_impact d_max={1e3 * depth:g} mm"] = (
            impact,
            one_dimensional_restitution(impact, REDUCED_MASS, SPEED),
        )
    return cases


def loop_laws() -> dict[str, NormalLaw]:
    """Laws whose loops of force over depth are drawn, by name."""
    laws: dict[str, NormalLaw] = {
        name: law(stiffness=STIFFNESS, restitution=LOOP_RESTITUTION) for name, law in POWER_LAWS.items()
    }
    laws["kelvin_voigt"] = KelvinVoigt(stiffness=STIFFNESS, damping=5e3)
    laws["anagnostopoulos"] = Anagnostopoulos(stiffness=STIFFNESS, restitution=LOOP_RESTITUTION)
    laws["adams_impact"] = AdamsImpact(stiffness=STIFFNESS, full_damping=2e3, full_damping_depth=3e-4)
    bearing = paper_machine.bearing(CLEARANCE_MM)
    laws["johnson"] = law_catalogue.cylinder_law("johnson", bearing, LOOP_RESTITUTION)
    return laws


def rises(quick: bool) -> dict[str, Scenario]:
    """The rise under every law, by case."""
    friction = law_catalogue.friction_laws(FRICTION)
    stiffness = paper_machine.stiffness(CLEARANCE_MM)
    laws: dict[str, tuple[NormalLaw, FrictionLaw]] = {
        name: (law, Frictionless())
        for name, law in law_catalogue.normal_laws(CLEARANCE_MM, RESTITUTION).items()
    }
    exact = Exact(stiffness=stiffness, restitution=RESTITUTION)
    laws |= {f"friction {name}": (exact, law) for name, law in friction.items()}
    if quick:
        laws = {name: laws[name] for name in QUICK_RISE}
    for name, floor in TEXTBOOK.items():
        speed = TouchSpeed(floor=floor)
        law = LankaraniNikravesh(stiffness=stiffness, restitution=RESTITUTION, damping_speed=speed)
        laws[name] = (law, Frictionless())
    step = RISE_STEP[quick]
    base = replace(paper_machine.ideal_rise(step), record_period=step)
    # of Newton's iterations a looser tolerance spares one a step; it changes means and spreads by 1e-6
    settings = SolverSettings(impact_steps=RISE_IMPACT_STEPS[quick], newton_tolerance=1e-6, backend="symbolic")
    bearing = paper_machine.bearing(CLEARANCE_MM)
    return {
        name: replace(
            base,
            pins={
                LOOSE: ClearancePin(contact=JournalContact(bearing=bearing, normal=normal, friction=tangential))
            },
            solver=settings,
        )
        for name, (normal, tangential) in laws.items()
    }


# --- measures ---


def restitution_numbers(pairs: Mapping[str, Pair], expected: Mapping[str, float]) -> list[Number]:
    """Delivered restitution and its closed form, by case."""
    numbers = []
    for case, closed_form in expected.items():
        numbers.append(pairs[case].number("delivered_restitution", case, "1", delivered_restitution))
        numbers.append(Number("closed_form_restitution", case, closed_form, "1", 0.0))
    return numbers


def in_rise(result: Result) -> npt.NDArray[np.bool_]:
    """Mask of the records from 3 to 5 s."""
    return result.time >= RISE_START - 1e-9


RISE_MEASURES: dict[str, tuple[str, Callable[[Result], float]]] = {
    "mean_pin_force": ("N", lambda r: float(r[FORCE][in_rise(r)].mean())),
    "std_pin_force": ("N", lambda r: float(r[FORCE][in_rise(r)].std())),
    "largest_pin_force_any_step": ("N", lambda r: float(r.largest_force[LOOSE])),
    "energy_dissipated": ("J", lambda r: r.dissipated),
    "energy_error": ("J", lambda r: r.energy_error),
    "touches": ("1", lambda r: float(len(r.onsets[LOOSE]))),
    "clamped_steps": ("1", lambda r: float(r.counts.clamped_steps)),
}


def rise_numbers(pairs: Mapping[str, Pair]) -> list[Number]:
    """Mean and spread over the records from 3 to 5 s, the rest over the whole run, by case."""
    return [
        pair.number(name, case, unit, measure)
        for case, pair in pairs.items()
        for name, (unit, measure) in RISE_MEASURES.items()
    ]


# --- figures ---


def restitution_figure(numbers: Sequence[Number]) -> Figure:
    """A panel for each power law: closed form as a line, the engine as points, what was asked dashed."""
    drawing = Figure(figsize=style.size(170, 150))
    panels = drawing.subplots(3, 4, sharex=True, sharey=True)
    values = {(n.name, n.case): n.value for n in numbers}
    fine = np.linspace(0.01, 1.0, 200)
    for axes, (name, law) in zip(panels.flat, POWER_LAWS.items(), strict=True):
        curve = [law(stiffness=1.0, restitution=float(e)).delivered_restitution for e in fine]
        measured = {e: values.get(("delivered_restitution", f"{name} e={e:g}")) for e in ASKED}
        shown = [(e, value) for e, value in measured.items() if value is not None]
        axes.plot([0, 1], [0, 1], color="#999999", lw=0.8, ls=(0, (4, 2)), label="as asked")
        axes.plot(fine, curve, color=style.LOOSE, label="closed form")
        axes.plot(
            *zip(*shown, strict=True), "o", ms=2.6, color=style.SMOOTH, mec="black", mew=0.3, label="engine"
        )
        axes.set(xlim=(0, 1), ylim=(0, 1), xticks=(0, 0.5, 1), yticks=(0, 0.5, 1))
        axes.set_title(title(name), fontsize=8)
    drawing.supxlabel("restitution asked for [-]", fontsize=9)
    drawing.supylabel("restitution delivered [-]", fontsize=9)
    panels[0, 0].legend(loc="lower right", fontsize=7, handlelength=1.5, borderaxespad=0.2)
    drawing.suptitle("Free impact: restitution asked for and delivered")
    return drawing


def loop_figure(results: Mapping[str, Result]) -> Figure:
    """Force over depth in a free impact, a panel for each law."""
    drawing = Figure(figsize=style.size(170, 170))
    panels = drawing.subplots(4, 4)
    for axes, (name, result) in zip(panels.flat, results.items(), strict=True):
        depth, force = result[f"pin.{PIN}.depth"], result[f"pin.{PIN}.normal_force"]
        touching = depth > 0.0
        ends = np.concatenate([[0.0], depth[touching], [0.0]])
        axes.plot(1e3 * ends, 1e-3 * np.concatenate([[0.0], force[touching], [0.0]]), color=style.LOOSE)
        elastic = np.linspace(0.0, ends.max(), 60)
        law = result.scenario.clearance_pins[PIN].contact.normal
        held = [law.elastic_force(float(d)) if d > 0.0 else 0.0 for d in elastic]
        axes.plot(1e3 * elastic, 1e-3 * np.array(held), color="#999999", lw=0.8, ls=(0, (4, 2)))
        axes.set(xlim=(0, None), ylim=(0, None))
        axes.set_title(title(name), fontsize=8)
        axes.locator_params(nbins=3)
    drawing.supxlabel("depth [mm]", fontsize=9)
    drawing.supylabel("normal force [kN]", fontsize=9)
    drawing.suptitle(
        f"Force over depth in a free impact at {SPEED} m/s, restitution {LOOP_RESTITUTION} asked for "
        "(dashed: elastic part)"
    )
    return drawing


def rise_figure(numbers: Sequence[Number]) -> Figure:
    """Mean, spread, peak and energy lost of the rise, a row for each law."""
    cases = list(dict.fromkeys(n.case for n in numbers))
    found = {(n.name, n.case): n for n in numbers}
    shown = [
        ("mean_pin_force", 1e-3, "mean force,\n3 to 5 s [kN]"),
        ("std_pin_force", 1e-3, "its std,\n3 to 5 s [kN]"),
        ("largest_pin_force_any_step", 1e-3, "largest force,\n0 to 5 s [kN]"),
        ("energy_dissipated", 1.0, "energy lost,\n0 to 5 s [J]"),
    ]
    drawing = Figure(figsize=style.size(190, 35 + 5 * len(cases)))
    panels = drawing.subplots(1, len(shown), sharey=True)
    rows = np.arange(len(cases))
    for axes, (name, scale, label) in zip(panels, shown, strict=True):
        values = np.array([scale * found[name, case].value for case in cases])
        errors = np.array([scale * found[name, case].numerical_error for case in cases])
        axes.errorbar(values, rows, xerr=errors, fmt="o", ms=3, color=style.LOOSE, capsize=2, lw=0.8)
        axes.set(xlabel=label)
        if values.max() > 4.0 * np.median(values) and values.min() > 0.0:
            axes.set_xscale("log")
            axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 3.0)))
            axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
            axes.xaxis.set_minor_formatter(NullFormatter())
    panels[0].set_yticks(rows, [_row_title(case) for case in cases], fontsize=7)
    panels[0].invert_yaxis()
    drawing.suptitle("Rise of the support, 1.5 mm clearance (bars: change when all steps are halved)")
    return drawing


def permanent_figure(pairs: Mapping[str, Pair]) -> Figure:
    """What becomes of the vibration after the last bounce, by how a contact that does not part is damped."""
    drawing = Figure(figsize=style.size(170, 125))
    whole, rest = drawing.subplots(2, 1)
    curves = [
        ("lankarani_nikravesh", style.LOOSE, "damped by the depth (DepthSpeed)"),
        *zip(
            TEXTBOOK,
            (style.SMOOTH, style.THIRD),
            (f"textbook: by the last touch, not below {floor:g} m/s" for floor in TEXTBOOK.values()),
            strict=True,
        ),
    ]
    for axes, (begin, end) in ((whole, (0.0, 0.5)), (rest, (0.5, 1.5))):
        for case, colour, label in curves:
            result = pairs[case].fine
            axes.plot(result.time, 1e-3 * result[FORCE], color=colour, lw=0.9, label=label)
        axes.set(xlim=(begin, end), xlabel="time [s]", ylabel="pin force [kN]")
    inside = [pairs[c].fine[FORCE][(pairs[c].fine.time > 0.5) & (pairs[c].fine.time < 1.5)] for c, *_ in curves]
    _fit(rest, [1e-3 * force for force in inside])
    whole.set_title("a) the fall into the bore")
    rest.set_title("b) what is left of it")
    drawing.legend(*whole.get_legend_handles_labels(), loc="outside lower center", ncols=1)
    drawing.suptitle("Lankarani-Nikravesh in the support: a contact that does not part, three ways to damp it")
    return drawing


def _fit(axes: Axes, curves: Sequence[Series]) -> None:
    low, high = min(c.min() for c in curves), max(c.max() for c in curves)
    axes.set_ylim(low - 0.05 * (high - low), high + 0.05 * (high - low))


def _row_title(case: str) -> str:
    if case.startswith("friction "):
        return f"friction: {title(case.removeprefix('friction '))}"
    name, _, rest = case.partition(", ")
    return title(name) + (f", {rest}" if rest else "")


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


def rise_table(numbers: Sequence[Number], quick: bool) -> Sheet:
    """The rise under each law, a row a law."""
    found = by_case(numbers)
    rows = []
    for case in dict.fromkeys(n.case for n in numbers):
        row = [found[name, case] for name in RISE_MEASURES]
        rows.append((_row_title(case), *(rounded(n.value, n.numerical_error) for n in row)))
    return Sheet(
        title=f"Rise of the reference support, {CLEARANCE_MM} mm, restitution {RESTITUTION}",
        header=("law", *(f"{name.replace('_', ' ')} [{unit}]" for name, (unit, _) in RISE_MEASURES.items())),
        rows=tuple(rows),
        caption=(
            "± is the change when all steps are halved. Mean and std: 3 to 5 s, every "
            f"{1e3 * RISE_STEP[quick]:g} ms; the rest: 0 to 5 s. Laws without damping, or with little under "
            "load, never come to rest: their numbers are those of a chaotic vibration, and the ± says so."
        ),
    )


# --- words ---


def chapter(restitutions: Sequence[Number], rise: Sequence[Number], quick: bool) -> Chapter:
    """The study as a chapter of the report."""
    return Chapter(
        study=STUDY,
        title="Contact and friction laws",
        question=(
            "What restitution does each contact law deliver, and what does the choice of a law change in the "
            "rise?"
        ),
        method=_method(quick),
        findings=(*_impact_findings(restitutions), *_rise_findings(rise)),
        pictures=_pictures(),
        sheets=(restitution_table(restitutions), rise_table(rise, quick)),
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
        f"the same depth, line-contact laws an assumed length of {1e3 * law_catalogue.PIN_LENGTH:g} mm and a "
        f"bore radius of {1e3 * bearing.bore_radius:g} mm.",
        "A contact that does not part is damped by the depth it reaches (DepthSpeed); two more rises use the "
        "textbook's speed of the last touch, with two floors below which that speed is not let fall.",
        f"An undamped free impact takes {IMPACT_STEPS[quick]} steps, one in the rise "
        f"{RISE_IMPACT_STEPS[quick]}. Between impacts the step is {1e3 * RISE_STEP[quick]:g} ms, and so is the "
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
        f"{said(peaks[low], 1e-3, 'kN')} ({_row_title(low)}) to {said(peaks[high], 1e-3, 'kN')} "
        f"({_row_title(high)})."
    )
    stds = "; ".join(
        f"{_row_title(c).partition(': ')[2]} {said(found['std_pin_force', c], 1e-3, 'kN')}" for c in frictions
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


def _pictures() -> tuple[Picture, ...]:
    return (
        Picture(
            "delivered_restitution",
            "Restitution that a free impact delivers over the restitution asked for, a panel for each law: "
            "closed form (line), through the engine (points), and as asked (dashed).",
        ),
        Picture(
            "force_depth_loops",
            f"Force over depth in a free impact at {SPEED} m/s, a restitution of {LOOP_RESTITUTION} asked for; "
            "dashed: the elastic part alone.",
        ),
        Picture(
            "rise_under_each_law",
            "The rise under each law: mean force and its standard deviation from 3 to 5 s, largest force and "
            "energy lost from 0 to 5 s. Bars are the change when all steps are halved.",
        ),
        Picture(
            "permanent_contact",
            "Lankarani-Nikravesh in the support, three ways to damp a contact that does not part: the fall "
            "into the bore (a), and what is left of the vibration (b).",
        ),
    )


# --- main ---


def study(chosen: Options) -> None:
    """Run, measure, draw and write everything into the output folder."""
    started = time.perf_counter()
    laws = impact_laws(chosen.quick)
    impacts = {case: free_impact(law, SPEED, IMPACT_STEPS[chosen.quick]) for case, (law, _) in laws.items()}
    lifted = rises(chosen.quick)
    with worker_pool(chosen.workers) as pool:
        done = run_pairs(lifted | impacts, pool)
        loops = run_cases(
            {name: free_impact(law, SPEED, 128, records=800) for name, law in loop_laws().items()}, pool
        )
    restitutions = restitution_numbers(done, {case: expected for case, (_, expected) in laws.items()})
    pairs = {name: done[name] for name in lifted}
    measured = rise_numbers(pairs)
    for name, pair in pairs.items():
        pair.fine.save(chosen.out / "runs" / f"{_file_name(name)}.h5")
    with style.look():
        drawings = {
            "delivered_restitution": restitution_figure(restitutions),
            "force_depth_loops": loop_figure(loops),
            "rise_under_each_law": rise_figure(measured),
            "permanent_contact": permanent_figure(pairs),
        }
        for name, drawing in drawings.items():
            style.save(drawing, chosen.out, name, pdf=not chosen.quick)
    tables = [restitution_table(restitutions), rise_table(measured, chosen.quick)]
    for name, table in zip(("restitution_table", "rise_table"), tables, strict=True):
        show_table(chosen.out / f"{name}.txt", table, width=200)
    chapter(restitutions, measured, chosen.quick).save(chosen.out)
    write_summary(chosen.out, STUDY, [*restitutions, *measured], time.perf_counter() - started)


def _file_name(case: str) -> str:
    kept = case.replace("m/s", "mps").replace(" ", "_").replace(",", "").replace(".", "p")
    return kept.replace("/", "_")


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.contact_laws`."""
    description = (__doc__ or "").splitlines()[0]
    return run_main(study, options(STUDY, argv, description))


if __name__ == "__main__":
    sys.exit(main())
