"""What do contact laws deliver, and what does the choice of a law change in the motion?

Every normal law is tried in free impacts through the engine: restitution asked for against delivered, beside
the closed form, and loops of force over depth. Then the machine moves under each law: without friction under
the normal laws, with each friction law, and with several rest velocities, by which a contact that stays closed
is damped.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import ClassVar

from matplotlib.figure import Figure

from studies.common.numbers import Found, Measures, Number, by_case, cell, measured_all
from studies.common.rise import Watched, WholeNumber
from studies.common.runs import run_cases, run_with_errors
from studies.common.study import Study
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
DELIVERED, CLOSED_FORM = "delivered_restitution", "closed_form_restitution"
MEAN, STD, PEAK = "mean_pin_force", "std_pin_force", "largest_pin_force_any_step"
LOW, HIGH = min(FEW), max(FEW)  # restitutions asked for in the key table


# --- measures ---


def restitution_numbers(results: Mapping[str, Result], expected: Mapping[str, float]) -> list[Number]:
    """Delivered restitution and its closed form, by case."""
    delivered = measured_all(
        {case: results[case] for case in expected}, {DELIVERED: ("1", cases.delivered_restitution)}
    )
    return delivered + [Number(CLOSED_FORM, case, value, "1", 0.0) for case, value in expected.items()]


def rise_numbers(watched: Watched, results: Mapping[str, Result]) -> list[Number]:
    """Mean and spread while the machine moves, the rest over the whole run, by case."""
    measures: Measures = {
        MEAN: ("N", watched.mean_of(watched.force)),
        STD: ("N", watched.spread_of(watched.force)),
        PEAK: ("N", lambda run: float(run.largest_force[watched.pin])),
        "energy_dissipated": ("J", lambda run: run.dissipated),
        "energy_error": ("J", lambda run: run.energy_error),
        "impacts": ("1", WholeNumber(lambda run: len(run.onsets[watched.pin]))),
        "clamped_steps": ("1", WholeNumber(lambda run: run.counts.clamped_steps)),
    }
    return measured_all(results, measures)


class ContactLaws(Study):
    """What do contact laws deliver, and what does the choice of a law change in the motion?"""

    name, seconds, own_machine = "contact_laws", 30.0, True
    live: ClassVar = {"permanent_contact": (0, 1)}

    def work(self) -> None:
        """Free impacts, and the motion under every law."""
        subject, chosen = self.subject, self.chosen
        self.ideal = run_cases({"ideal": subject.ideal()}, chosen)["ideal"]
        self.joint = joint = Joint(subject, subject.watched.mean(self.ideal, self.ideal[subject.watched.force]))
        laws = cases.impact_laws()
        impacts = {case: cases.free_impact(law, SPEED, IMPACT_STEPS) for case, (law, _) in laws.items()}
        loops = {
            name: cases.free_impact(law, SPEED, 128, records=800) for name, law in cases.loop_laws().items()
        }
        made_anew = replace(chosen, kept=None)  # sooner than read: each takes a twentieth of a second
        struck, self.looped = run_with_errors(impacts, made_anew), run_cases(loops, made_anew)
        self.risen = run_with_errors(joint.runs, chosen)
        rubbed = run_with_errors({f"{name}{RUBBING}": case for name, case in joint.rubbing.items()}, chosen)
        self.resting = run_with_errors(joint.resting, chosen)
        restitutions = restitution_numbers(struck, {case: expected for case, (_, expected) in laws.items()})
        self.in_rise, self.with_friction, self.rested = (
            rise_numbers(subject.watched, one) for one in (self.risen, rubbed, self.resting)
        )
        self.runs = self.risen | self.resting
        self.numbers = [*restitutions, *self.in_rise, *self.with_friction, *self.rested]
        self.of_laws = by_case([*restitutions, *self.in_rise])

    def figures(self) -> dict[str, Figure]:
        """All figures."""
        watched = self.subject.watched
        return {
            "laws_at_a_glance": answer_figure(self.of_laws),
            "force_depth_loops": loop_figure(self.looped),
            "rise_under_each_law": rise_figure(watched, self.in_rise),
            "permanent_contact": permanent_figure(watched, self.resting),
        }

    def tables(self) -> dict[str, Sheet]:
        """All tables."""
        return {"laws": self.key_table(), "rest_table": self.rest_table()}

    def key_table(self) -> Sheet:
        """What an engineer asks for first, a row a law: what it delivers, and the motion under it."""
        found, rows = self.of_laws, []
        for case in KEY:
            restitutions = [found.get((DELIVERED, f"{case} e={asked:g}")) for asked in (LOW, HIGH)]
            delivered = ["" if n is None else f"{n.value:.3f}" for n in restitutions]
            forces = (cell(found[name, case], 1e-3) for name in (MEAN, STD, PEAK))
            rows.append((row_title(case), *delivered, *forces))
        asked = tuple(f"delivers for e = {e:g}" for e in (LOW, HIGH))
        return text_table(("law", *asked, "mean force [kN]", "its std [kN]", "largest force [kN]"), rows)

    def rest_table(self) -> Sheet:
        """What the rest velocity changes, a row a velocity: damping, soft impacts, the motion, its cost."""
        found, rows, pin = by_case(self.rested), [], self.subject.watched.pin
        for case, velocity in REST.items():
            result = self.resting[case]
            ratio = damping_ratio(result.scenario, pin)
            soft = [f"{soft_restitution(result.scenario, pin, speed):.3f}" for speed in SOFT]
            force = cell(found[STD, case])
            rows.append((f"{1e3 * velocity:g}", f"{ratio:.2g}", *soft, force, f"{result.counts.steps}"))
        impacts = (f"delivered at {1e3 * speed:g} mm/s" for speed in SOFT)
        header = ("rest velocity [mm/s]", "damping ratio at rest", *impacts, "std pin force [N]", "steps")
        return text_table(header, rows)

    def words(self) -> dict[str, object]:
        """Numbers of free impacts, and of the motion under each law."""
        found, joint = self.of_laws, self.joint
        bore_radius = joint.pin.contact.bearing.bore_radius
        power = {name: found[DELIVERED, f"{name} e={LOW:g}"].value for name in POWER_LAWS}
        frictions = [case for case in self.risen if case.startswith("friction ")]
        hysteresis = [case for case in self.risen if case in POWER_LAWS]
        closed = [one for one in found.values() if one.name == CLOSED_FORM]
        peaks = {case: found[PEAK, case].value for case in self.risen if case not in frictions}
        return {
            "joint": joint,
            "pin_length": joint.length or catalogue.pin_length(bore_radius),
            "bore_radius": bore_radius,
            "rubbing": _spreads(by_case(self.with_friction), [f"{name}{RUBBING}" for name in POWER_LAWS]),
            "rested": by_case(self.rested),
            "at_steps": {name: case for name, case in joint.runs.items() if case.accuracy is None},
            "goal": self.ideal.goal,
            "cases": cases,
            "title": title,
            "row_title": row_title,
            "offs": [abs(found[DELIVERED, one.case].value - one.value) for one in closed],
            "low": LOW,
            "high": HIGH,
            "power": power,
            "most": max(power, key=power.__getitem__),
            "least": min(power, key=power.__getitem__),
            "paper_high": found[DELIVERED, f"lankarani_nikravesh e={HIGH:g}"].value,
            "risen": found,
            "frictions": frictions,
            "hysteresis": hysteresis,
            "spread": _spreads(found, hysteresis),
            "softest": min(peaks, key=peaks.__getitem__),
            "stiffest": max(peaks, key=peaks.__getitem__),
            "lost": max(
                found["energy_error", c].value / found["energy_dissipated", c].value for c in hysteresis
            ),
        }


def _spreads(found: Found, cases_of: Sequence[str]) -> dict[str, float]:
    """By what share the largest of some cases exceeds the smallest: mean pin force and standard deviation."""
    rows = {name: [found[name, case].value for case in cases_of] for name in (MEAN, STD)}
    return {name: max(values) / min(values) - 1.0 for name, values in rows.items()}
