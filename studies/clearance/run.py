"""What do clearance in one pin and its size change in the rise? (Sections 3 and 4 of the paper.)

The support stands still for 3 s, while the journal falls from the middle of its bore and comes to rest,
and rises by 500 mm in the next 2 s. Section 3: ideal pin against 1.5 mm, both without friction and both with
the same, and with line contact, a pin that touches its bore along its length, in place of the paper's spheres.
Section 4: ideal pin, 0.5, 1.0, 1.5 and 2.0 mm. The runs that both have in common are made once.
"""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial

from matplotlib.figure import Figure

from studies.clearance import figures
from studies.clearance.figures import CASES, COLUMNS, DRY, FRICTION, IDEAL, IDEAL_DRY, SMOOTH
from studies.common import paper_machine, rise
from studies.common.numbers import (
    Found,
    Measures,
    Number,
    against,
    by_case,
    cell,
    counted,
    difference,
    measured_all,
    printed,
    short,
    witnessed,
)
from studies.common.paper_machine import (
    CLEARANCE_MM,
    CONTACT_TITLES,
    CYLINDERS,
    PAPER,
    SIZES_MM,
    case_name,
    ideal_name,
    ideal_of,
)
from studies.common.rise import DEGREES
from studies.common.runs import impacts
from studies.common.study import Study
from studies.common.subject import Subject, paper_subject
from studies.common.words import text_table
from support_exudyn import Result, Scenario
from support_exudyn.postprocessing.figures.linkage_drawing import machine_drawing
from support_exudyn.postprocessing.page.pieces import KeyNumber, Sheet

PIN = paper_machine.CLEARANCE_PIN
PAPERS = {  # printed values by name and case; the paper has friction, though with data that it does not print
    (name, case_name(size, FRICTION)): value
    for name, values in (
        ("mean_pin_force", paper_machine.MEAN_FORCE),
        ("std_pin_force", paper_machine.FORCE_SPREAD),
        ("mean_angular_acceleration", paper_machine.MEAN_ACCELERATION),
    )
    for size, value in values.items()
}


# --- cases ---


def size_cases(subject: Subject) -> dict[str, Scenario]:
    """The ideal pin and every clearance, with and without friction."""
    frictions = (subject.friction, 0.0)
    with_clearance = {
        case_name(size, friction): subject.with_clearance(size, friction)
        for friction in frictions
        for size in SIZES_MM
    }
    return with_clearance | {ideal_name(friction): subject.ideal(friction) for friction in frictions}


def influence_cases() -> dict[str, Scenario]:
    """The four cases with the paper's contact, and the rise with line contact, with friction and without."""
    paper = paper_subject()
    every = size_cases(paper)
    found = {case: every[case] for case in CASES}
    for friction in (FRICTION, 0.0):
        law = paper_machine.PAPERS_LAW
        pin = paper_machine.clearance_joint(CLEARANCE_MM, friction, contact=CYLINDERS, law=law)
        line = replace(paper.motion, pins={PIN: pin}, channels=(f"pin.{PIN}.*",))
        found[contact_case(CYLINDERS, friction)] = line
    return found


def contact_case(contact: str, friction: float = FRICTION) -> str:
    """Name of a case by its contact; the paper's is not named."""
    paper = case_name(CLEARANCE_MM, friction)
    return paper if contact == PAPER else paper.replace(",", f", {contact},")


# --- measures ---


def stiffness_numbers(sizes: Sequence[float]) -> list[Number]:
    """Eq. 5, a closed form, for clearances [mm]."""
    stiffness = {size: paper_machine.stiffness(size) / 1e3**1.5 for size in sizes}
    name, unit, printed_by = "stiffness_coefficient", "N/mm^1.5", paper_machine.STIFFNESS
    return [Number(name, f"{size:.1f} mm", k, unit, 0.0, printed_by[size]) for size, k in stiffness.items()]


def _of_both(watched: rise.Watched) -> Measures:
    force, acceleration = watched.force, watched.acceleration
    return {
        "mean_pin_force": ("N", watched.mean_of(force)),
        "std_pin_force": ("N", watched.spread_of(force)),
        "rms_pin_force": ("N", watched.fluctuation_of(force)),
        "mean_angular_acceleration": ("deg/s^2", watched.mean_of(acceleration, DEGREES)),
        "std_angular_acceleration": ("deg/s^2", watched.spread_of(acceleration, DEGREES)),
    }


def _of_fall(pin: str) -> Measures:
    return {"largest_pin_force_any_step": ("N", lambda run: float(run.largest_force[pin]))}


OF_CONTACTS = ("mean_pin_force", "rms_pin_force", "largest_pin_force_any_step")


def influence_measures(run: Result) -> Measures:
    """What is measured of a case of section 3: from 3 to 5 s; energies and largest forces from 0 to 5 s."""
    watched = rise.PAPER
    loose = PIN in run.scenario.clearance_pins
    if "tip.x" not in run.channels:  # line contact
        every = {**_of_both(watched), **_of_fall(PIN)}
        return {name: every[name] for name in OF_CONTACTS}
    found: dict[str, tuple[str, rise.Measure | rise.Versus]] = {
        **_of_both(watched),
        "largest_pin_force": ("N", rise.Crest(rise.FORCE, begin=0.0)),
        "largest_pin_force_in_rise": ("N", rise.Crest(rise.FORCE)),
        "largest_angular_speed_in_rise": ("deg/s", rise.Crest(rise.SPEED, DEGREES)),
        "column_work": ("J", lambda run: float(run["energy.work"][-1])),
        "energy_error": ("J", lambda run: run.energy_error),
    }
    if loose or getattr(run.scenario.pins[PIN], "friction", None):
        found["energy_dissipated"] = ("J", lambda run: run.dissipated)
    if loose:
        found |= _of_fall(PIN)
        found |= {
            "rms_pin_force_departure": ("N", watched.shift_of(rise.FORCE, power=2.0)),
            "rms_angular_velocity_departure": ("deg/s", watched.shift_of(rise.SPEED, DEGREES, power=2.0)),
            "mean_tip_shift": ("mm", watched.shift_of("tip.x", 1e3)),
        }
        for n in range(min(3, impacts(run, PIN))):
            found[f"onset_{n + 1}_time"] = ("s", rise.onset(PIN, n, "time"))
            found[f"onset_{n + 1}_speed"] = ("m/s", rise.onset(PIN, n, "speed"))
    return found


def influence_numbers(results: Mapping[str, Result]) -> list[Number]:
    """All numbers of section 3."""
    numbers = stiffness_numbers([CLEARANCE_MM]) + measured_all(results, influence_measures, ideal_of, PAPERS)
    for case in (SMOOTH, DRY):
        numbers.append(counted("impacts", case, results[case], lambda run: len(run.onsets[PIN])))
    return numbers


def size_measures(subject: Subject, run: Result) -> Measures:
    """Unit and measure of everything that this machine has, by name."""
    watched, speed = subject.watched, subject.watched.speed
    found: dict[str, tuple[str, rise.Measure | rise.Versus]] = {
        **_of_both(watched),
        "rms_angular_acceleration": ("deg/s^2", watched.fluctuation_of(watched.acceleration, DEGREES)),
        "rms_angular_velocity": ("deg/s", watched.fluctuation_of(speed, DEGREES)),
    }
    for stage, times in watched.stages.items():
        found[f"rms_angular_velocity_{stage}"] = ("deg/s", watched.fluctuation_of(speed, DEGREES, *times))
        found[f"mean_angular_speed_{stage}"] = ("deg/s", watched.stage_mean_of(speed, stage, DEGREES))
    if "tip.x" in run.channels:
        found["mean_tip_shift"] = ("mm", watched.shift_of("tip.x", 1e3))
        found["tip_range"] = ("mm", watched.extent_of("tip.x", 1e3))

    def mean_angle(angle: rise.OfColumn, column: str, run: Result) -> float:
        return DEGREES * watched.mean(run, angle(run, column))

    for column in COLUMNS:
        if f"{column}.angle" in run.channels:
            found[f"mean_{column}_angle"] = ("deg", partial(mean_angle, rise.rearward_angle, column))
            found[f"mean_{column}_lean"] = ("deg", partial(mean_angle, rise.lean, column))
    return {**found, **(_of_fall(subject.pin) if subject.pin in run.scenario.clearance_pins else {})}


def size_numbers(subject: Subject, results: Mapping[str, Result]) -> list[Number]:
    """All numbers of section 4, each case compared with the ideal pin of the same friction."""
    measures, is_paper = partial(size_measures, subject), subject.is_paper
    numbers = measured_all(results, measures, ideal_of, PAPERS if is_paper else None)
    return [*(stiffness_numbers(SIZES_MM) if is_paper else ()), *numbers]


# --- tables and tiles ---

INFLUENCE_KEY = {  # of the key table: what, and its scale to the unit in brackets
    "mean_pin_force": ("mean force in the pin, 3 to 5 s [kN]", 1e-3),
    "std_pin_force": ("its standard deviation [kN]", 1e-3),
    "rms_pin_force": ("its fluctuation (RMS) [kN]", 1e-3),
    "largest_pin_force_in_rise": ("largest force in the rise [kN]", 1e-3),
    "largest_pin_force_any_step": ("largest force, fall into the bore [kN]", 1e-3),
    "std_angular_acceleration": ("angular acceleration, std. deviation [deg/s²]", 1.0),
    "mean_tip_shift": ("mean shift of the canopy's tip [mm]", 1.0),
    "energy_dissipated": ("energy lost in the pin [J]", 1.0),
}
SIZE_KEY = {
    "mean_pin_force": ("mean force [kN]", 1e-3),
    "rms_pin_force": ("fluctuation of force [kN]", 1e-3),
    "rms_angular_acceleration": ("of angular acceleration [deg/s²]", 1.0),
    "mean_tip_shift": ("tip shift [mm]", 1.0),
}
OF_FORCE = {
    "mean_pin_force": "mean", "std_pin_force": "standard deviation", "rms_pin_force": "RMS fluctuation",
}  # fmt: skip


def influence_tables(numbers: Sequence[Number]) -> dict[str, Sheet]:
    """What an engineer asks for first, a column a case; and a row for each contact and friction coefficient."""
    found, rows = by_case(numbers), []
    for name, (heading, scale) in INFLUENCE_KEY.items():
        paper = PAPERS.get((name, DRY))
        cells = (cell(found.get((name, case)), scale) for case in CASES)
        rows.append((heading, *cells, "" if paper is None else f"{scale * paper:.3f}"))
    of_contacts = [
        (
            *(CONTACT_TITLES[contact], f"{friction:g}"),
            *(cell(found[name, contact_case(contact, friction)], 1e-3) for name in OF_CONTACTS),
        )
        for contact in (PAPER, CYLINDERS)
        for friction in (FRICTION, 0.0)
    ]
    header = ("contact", "mu_d", "mean force [kN]", "fluctuation [kN]", "largest force [kN]")
    return {
        "key_numbers": text_table(("quantity", *CASES, "paper, 1.5 mm"), rows),
        "by_contact": text_table(header, of_contacts, left=2),
    }


def size_tables(subject: Subject, numbers: Sequence[Number]) -> dict[str, Sheet]:
    """What an engineer asks for first, a row for each clearance; counterparts of Tables 2 and 3."""
    found = by_case(numbers)

    def cases(friction: float) -> list[str]:
        return [ideal_name(friction), *(case_name(size, friction) for size in SIZES_MM)]

    key = {name: about for name, about in SIZE_KEY.items() if (name, ideal_name(0.0)) in found}
    by_clearance = [
        (case.split(",")[0], *(cell(found[name, case], scale) for name, (_, scale) in key.items()))
        for case in cases(subject.friction)
    ]
    of_force = [
        (case, title, cell(n), witnessed(n), difference(n), printed(n))
        for friction in (subject.friction, 0.0)
        for case in cases(friction)
        for name, title in OF_FORCE.items()
        if (n := found[name, case])
    ]
    stiffness = [
        (n.case, f"{1e3 * paper_machine.BORE_RADIUS - float(n.case.split()[0]):.1f}", f"{n.value:.3f}",
         f"{n.paper:.3f}")
        for n in numbers
        if n.name == "stiffness_coefficient"
    ]  # fmt: skip
    table_2 = text_table(("clearance", "shaft radius [mm]", "here [N/mm^1.5]", "paper"), stiffness)
    header = ("case", "pin force", "Exudyn [N]", "witness", "difference", "paper")
    return {
        "by_clearance": text_table(("clearance", *(heading for heading, _ in key.values())), by_clearance),
        **({"table_2": table_2} if subject.is_paper else {}),
        "table_3": text_table(header, of_force, left=2),
    }


def tiles(found: Found) -> tuple[KeyNumber, ...]:
    """The first screen of the report: the ideal pin against 1.5 mm, both with the same friction."""

    def tile(title: str, ideal: str, name: str, change: str) -> KeyNumber:
        tight, loose = (short(found[key], 1e-3, "kN") for key in ((ideal, IDEAL_DRY), (name, DRY)))
        return KeyNumber(title, loose, tight, change)

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
        KeyNumber("canopy tip, mean place", short(shift), "0", f"{towards}, against the ideal pin"),
        tile("fluctuation of the force", ripple, ripple, f"RMS, faster than 0.1 s; {along(ripple)}"),
    )


# --- the studies ---


class ClearanceInfluence(Study):
    """What do 1.5 mm of clearance in the rear-link pin do to the rise? (Section 3 of the paper.)"""

    name, seconds, sentences = "clearance_influence", 12.0, "influence.md.j2"
    has_witness = True
    live = figures.LIVE

    def cases(self) -> dict[str, Scenario]:
        """The four rises, and those with line contact."""
        return influence_cases()

    def measure(self, runs: Mapping[str, Result]) -> list[Number]:
        """All numbers of section 3."""
        return influence_numbers(runs)

    def saved(self) -> dict[str, Result]:
        """The four rises."""
        return {name: self.runs[name] for name in CASES}

    def figures(self) -> dict[str, Figure]:
        """Counterparts of Fig. 3 to 5, and the machine."""
        machine = machine_drawing(self.runs[DRY].scenario, marked=(PIN,))
        return figures.influence_figures(self.saved()) | {"machine": machine}

    def tables(self) -> dict[str, Sheet]:
        """Numbers by case, and by contact."""
        return influence_tables(self.numbers)

    def tiles(self) -> tuple[KeyNumber, ...]:
        """The ideal pin against 1.5 mm."""
        return tiles(self.found)

    def words(self) -> dict[str, object]:
        return {"run": sys.modules[__name__], "paper": paper_machine}


class ClearanceSize(Study):
    """What does the clearance's size change in the rise: motion, force, posture? (Section 4 of the paper.)"""

    name, seconds, sentences = "clearance_size", 14.0, "size.md.j2"
    own_machine = has_witness = True
    live = figures.LIVE

    def cases(self) -> dict[str, Scenario]:
        """The ideal pin and every clearance."""
        return size_cases(self.subject)

    def measure(self, runs: Mapping[str, Result]) -> list[Number]:
        """All numbers of section 4."""
        return size_numbers(self.subject, runs)

    def figures(self) -> dict[str, Figure]:
        """Counterparts of Fig. 6 to 12, and trends."""
        return figures.size_figures(self.subject, self.runs, self.found)

    def tables(self) -> dict[str, Sheet]:
        """Numbers by clearance."""
        return size_tables(self.subject, self.numbers)

    def words(self) -> dict[str, object]:
        """Names of cases, and what the machine has."""
        mu, watched = self.subject.friction, self.subject.watched
        return {
            "case_name": case_name,
            "ideal_name": ideal_name,
            "sizes": SIZES_MM,
            "frictions": (mu, 0.0),
            "mu": mu,
            "watched": watched,
            "window": f"{watched.window:g} s",
            "has_tip": ("mean_tip_shift", ideal_name(0.0)) in self.found,
        }
