"""What do clearance in one pin and its size change in the rise? (Sections 3 and 4 of the paper.)

The support stands still for 3 s, while the journal falls from the middle of its bore and comes to rest,
and rises by 500 mm in the next 2 s. Section 3: ideal pin against 1.5 mm, both without friction and both with
the same, and with line contact, a pin that touches its bore along its length, in place of the paper's spheres.
Section 4: ideal pin, 0.5, 1.0, 1.5 and 2.0 mm. The runs that both have in common are made once.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial

from matplotlib.figure import Figure

from studies.clearance import figures
from studies.clearance.figures import CASES, COLUMNS, DRY, FRICTION, IDEAL, IDEAL_DRY
from studies.common import paper_machine, rise
from studies.common.numbers import Measured, Number, against, cell, printed, short, witnessed
from studies.common.paper_machine import (
    CLEARANCE_MM,
    CLEARANCE_PIN,
    CONTACT_TITLES,
    CYLINDERS,
    PAPER,
    SIZES_MM,
    case_name,
    ideal_name,
    ideal_of,
)
from studies.common.rise import DEGREES, WholeNumber
from studies.common.runs import impacts
from studies.common.study import Study
from studies.common.subject import Subject
from studies.common.words import text_table
from support_exudyn import Result, Scenario
from support_exudyn.postprocessing.figures.linkage_drawing import machine_drawing
from support_exudyn.postprocessing.page.pieces import KeyNumber, Sheet

PAPERS = {  # printed values by name and case; the paper has friction, though with data that it does not print
    (name, case_name(size, FRICTION)): value
    for name, values in (
        ("mean_pin_force", paper_machine.MEAN_FORCE),
        ("std_pin_force", paper_machine.FORCE_SPREAD),
        ("mean_angular_acceleration", paper_machine.MEAN_ACCELERATION),
    )
    for size, value in values.items()
}
Table = dict[str, tuple[str, Measured]]  # unit and measure, by name


def size_cases(subject: Subject) -> dict[str, Scenario]:
    """The ideal pin and every clearance, with and without friction."""
    frictions = (subject.friction, 0.0)
    with_clearance = {
        case_name(size, friction): subject.with_clearance(size, friction)
        for friction in frictions
        for size in SIZES_MM
    }
    return with_clearance | {ideal_name(friction): subject.ideal(friction) for friction in frictions}


def contact_case(contact: str, friction: float = FRICTION) -> str:
    """Name of a case by its contact; the paper's is not named."""
    paper = case_name(CLEARANCE_MM, friction)
    return paper if contact == PAPER else paper.replace(",", f", {contact},")


def stiffness_numbers(sizes: Sequence[float]) -> list[Number]:
    """Eq. 5, a closed form, for clearances [mm]."""
    name, unit, printed_by = "stiffness_coefficient", "N/mm^1.5", paper_machine.STIFFNESS
    return [
        Number(name, f"{size:.1f} mm", paper_machine.stiffness(size) / 1e3**1.5, unit, 0.0, printed_by[size])
        for size in sizes
    ]


def measures_of_both(watched: rise.Watched, run: Result) -> Table:
    """What both studies measure in the motion, and the largest force of the whole run of a loose pin."""
    force, acceleration = watched.force, watched.acceleration
    found: Table = {
        "mean_pin_force": ("N", watched.mean_of(force)),
        "std_pin_force": ("N", watched.spread_of(force)),
        "rms_pin_force": ("N", watched.fluctuation_of(force)),
        "mean_angular_acceleration": ("deg/s^2", watched.mean_of(acceleration, DEGREES)),
        "std_angular_acceleration": ("deg/s^2", watched.spread_of(acceleration, DEGREES)),
    }
    if watched.pin in run.scenario.clearance_pins:
        found["largest_pin_force_any_step"] = ("N", lambda run: float(run.largest_force[watched.pin]))
    return found


# --- section 3 ---

OF_CONTACTS = ("mean_pin_force", "rms_pin_force", "largest_pin_force_any_step")
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


class ClearanceInfluence(Study):
    """What do 1.5 mm of clearance in the rear-link pin do to the rise? (Section 3 of the paper.)"""

    name, seconds, sentences = "clearance_influence", 12.0, "influence.md.j2"
    has_witness = True
    live, papers = figures.LIVE, PAPERS

    def cases(self) -> dict[str, Scenario]:
        """The four cases with the paper's contact, and those with line contact, with friction and without."""
        every = size_cases(self.subject)
        found = {case: every[case] for case in CASES}
        for friction in (FRICTION, 0.0):
            law = paper_machine.PAPERS_LAW
            pin = paper_machine.clearance_joint(CLEARANCE_MM, friction, contact=CYLINDERS, law=law)
            channels = (f"pin.{CLEARANCE_PIN}.*",)
            line = replace(self.subject.motion, pins={CLEARANCE_PIN: pin}, channels=channels)
            found[contact_case(CYLINDERS, friction)] = line
        return found

    def measures(self, run: Result) -> Table:
        """From 3 to 5 s; energies and largest forces from 0 to 5 s."""
        watched = rise.PAPER
        found = measures_of_both(watched, run)
        if "tip.x" not in run.channels:  # line contact
            return {name: found[name] for name in OF_CONTACTS}
        found |= {
            "largest_pin_force": ("N", rise.Crest(rise.FORCE, begin=0.0)),
            "largest_pin_force_in_rise": ("N", rise.Crest(rise.FORCE)),
            "largest_angular_speed_in_rise": ("deg/s", rise.Crest(rise.SPEED, DEGREES)),
            "column_work": ("J", lambda run: float(run["energy.work"][-1])),
            "energy_error": ("J", lambda run: run.energy_error),
        }
        pin = run.scenario.pins[CLEARANCE_PIN]
        if CLEARANCE_PIN in run.scenario.clearance_pins or getattr(pin, "friction", None):
            found["energy_dissipated"] = ("J", lambda run: run.dissipated)
        if CLEARANCE_PIN in run.scenario.clearance_pins:
            found |= {
                "rms_pin_force_departure": ("N", watched.shift_of(rise.FORCE, power=2.0)),
                "rms_angular_velocity_departure": ("deg/s", watched.shift_of(rise.SPEED, DEGREES, power=2.0)),
                "mean_tip_shift": ("mm", watched.shift_of("tip.x", 1e3)),
                "impacts": ("1", WholeNumber(lambda run: len(run.onsets[CLEARANCE_PIN]))),
            }
            for n in range(min(3, impacts(run, CLEARANCE_PIN))):
                found[f"onset_{n + 1}_time"] = ("s", rise.onset(CLEARANCE_PIN, n, "time"))
                found[f"onset_{n + 1}_speed"] = ("m/s", rise.onset(CLEARANCE_PIN, n, "speed"))
        return found

    def ideal_of(self, case: str) -> str:
        return ideal_of(case)

    def measure(self, runs: Mapping[str, Result]) -> list[Number]:
        return stiffness_numbers([CLEARANCE_MM]) + super().measure(runs)

    def saved(self) -> dict[str, Result]:
        return {name: self.runs[name] for name in CASES}

    def figures(self) -> dict[str, Figure]:
        machine = machine_drawing(self.runs[DRY].scenario, marked=(CLEARANCE_PIN,))
        return figures.influence_figures(self.saved()) | {"machine": machine}

    def tables(self) -> dict[str, Sheet]:
        """What an engineer asks for first, a column a case; a row for each contact and friction coefficient."""
        rows = []
        for name, (heading, scale) in INFLUENCE_KEY.items():
            paper = PAPERS.get((name, DRY))
            cells = (cell(self.found.get((name, case)), scale) for case in CASES)
            rows.append((heading, *cells, "" if paper is None else f"{scale * paper:.3f}"))
        contacts = [(contact, friction) for contact in (PAPER, CYLINDERS) for friction in (FRICTION, 0.0)]
        of_contacts = []
        for contact, friction in contacts:
            cells = (cell(self.found[name, contact_case(contact, friction)], 1e-3) for name in OF_CONTACTS)
            of_contacts.append((CONTACT_TITLES[contact], f"{friction:g}", *cells))
        header = ("contact", "mu_d", "mean force [kN]", "fluctuation [kN]", "largest force [kN]")
        return {
            "key_numbers": text_table(("quantity", *CASES, "paper, 1.5 mm"), rows),
            "by_contact": text_table(header, of_contacts, left=2),
        }

    def tiles(self) -> tuple[KeyNumber, ...]:
        """The ideal pin against 1.5 mm, both with the same friction."""
        found, mean, fall, ripple = self.found, "mean_pin_force", "largest_pin_force_any_step", "rms_pin_force"

        def tile(title: str, ideal: str, name: str, change: str) -> KeyNumber:
            tight, loose = (short(found[key], 1e-3, "kN") for key in ((ideal, IDEAL_DRY), (name, DRY)))
            return KeyNumber(title, loose, tight, change)

        def along(name: str) -> str:
            return f"pin along its length: {short(found[name, contact_case(CYLINDERS)], 1e-3, 'kN')}"

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

    def words(self) -> dict[str, object]:
        return {"cases": figures, "contact_case": contact_case, "paper": paper_machine}


# --- section 4 ---

SIZE_KEY = {
    "mean_pin_force": ("mean force [kN]", 1e-3),
    "rms_pin_force": ("fluctuation of force [kN]", 1e-3),
    "rms_angular_acceleration": ("of angular acceleration [deg/s²]", 1.0),
    "mean_tip_shift": ("tip shift [mm]", 1.0),
}
OF_FORCE = {
    "mean_pin_force": "mean", "std_pin_force": "standard deviation", "rms_pin_force": "RMS fluctuation",
}  # fmt: skip


class ClearanceSize(Study):
    """What does the clearance's size change in the rise: motion, force, posture? (Section 4 of the paper.)"""

    name, seconds, sentences = "clearance_size", 14.0, "size.md.j2"
    own_machine = has_witness = True
    live, papers = figures.LIVE, PAPERS

    def cases(self) -> dict[str, Scenario]:
        return size_cases(self.subject)

    def measures(self, run: Result) -> Table:
        """Everything that this machine has."""
        watched, speed = self.subject.watched, self.subject.watched.speed
        found = measures_of_both(watched, run) | {
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
        return found

    def ideal_of(self, case: str) -> str:
        return ideal_of(case)

    def measure(self, runs: Mapping[str, Result]) -> list[Number]:
        """All numbers; printed ones and the stiffness by Eq. 5 are of the paper's machine."""
        if self.subject.is_paper:
            return stiffness_numbers(SIZES_MM) + super().measure(runs)
        return [replace(number, paper=None) for number in super().measure(runs)]

    def figures(self) -> dict[str, Figure]:
        return figures.size_figures(self.subject, self.runs, self.found)

    def tables(self) -> dict[str, Sheet]:
        """What an engineer asks for first, a row for each clearance; counterparts of Tables 2 and 3."""
        found, frictions = self.found, (self.subject.friction, 0.0)
        cases = {mu: [ideal_name(mu), *(case_name(size, mu) for size in SIZES_MM)] for mu in frictions}
        key = {name: about for name, about in SIZE_KEY.items() if (name, ideal_name(0.0)) in found}
        by_clearance = [
            (case.split(",")[0], *(cell(found[name, case], scale) for name, (_, scale) in key.items()))
            for case in cases[self.subject.friction]
        ]
        of_force = [
            (case, title, cell(n), *witnessed(n), printed(n))
            for mu in frictions
            for case in cases[mu]
            for name, title in OF_FORCE.items()
            if (n := found[name, case])
        ]
        sheets = {
            "by_clearance": text_table(("clearance", *(heading for heading, _ in key.values())), by_clearance)
        }
        if self.subject.is_paper:
            radius = 1e3 * paper_machine.BORE_RADIUS
            stiffness = [
                (n.case, f"{radius - float(n.case.split()[0]):.1f}", f"{n.value:.3f}", f"{n.paper:.3f}")
                for n in stiffness_numbers(SIZES_MM)
            ]
            header = ("clearance", "shaft radius [mm]", "here [N/mm^1.5]", "paper")
            sheets["table_2"] = text_table(header, stiffness)
        header_3 = ("case", "pin force", "Exudyn [N]", "witness", "difference", "paper")
        return sheets | {"table_3": text_table(header_3, of_force, left=2)}

    def words(self) -> dict[str, object]:
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
