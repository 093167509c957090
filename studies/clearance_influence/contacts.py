"""The contact of pin and bore: the paper's, two spheres, against a pin that touches along its length.

The rise with the paper's clearance by each contact, with friction and without; nothing else differs. Runs of
the paper's contact are those of the rest of the study.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from studies.common import paper_machine
from studies.common.numbers import Found, Number, cell, measured_all
from studies.common.paper_machine import CLEARANCE_MM, CONTACT_TITLES, CYLINDERS, PAPER
from studies.common.subject import Subject
from studies.common.words import TextTable
from support_exudyn import Result, Scenario

SHOWN = {"mean": "mean_pin_force", "ripple": "rms_pin_force", "fall": "largest_pin_force_any_step"}


def case_name(contact: str, friction: float) -> str:
    """Name of a case; the paper's contact is not named."""
    paper = paper_machine.case_name(CLEARANCE_MM, friction)
    return paper if contact == PAPER else paper.replace(",", f", {contact},")


def along_the_length() -> str:
    """The case of a pin that touches along its length, with friction."""
    return case_name(CYLINDERS, paper_machine.SLIDING_COEFFICIENT)


def scenarios(subject: Subject) -> dict[str, Scenario]:
    """The rise of a pin that touches along its length, with friction and without."""
    return {case_name(CYLINDERS, friction): _rise(subject, friction) for friction in (subject.friction, 0.0)}


def _rise(subject: Subject, friction: float) -> Scenario:
    law = paper_machine.PAPERS_LAW
    pin = paper_machine.clearance_joint(CLEARANCE_MM, friction, contact=CYLINDERS, law=law)
    return replace(subject.motion, pins={subject.pin: pin}, channels=(f"pin.{subject.pin}.*",))


def measure(subject: Subject, results: Mapping[str, Result]) -> list[Number]:
    """Mean force and fluctuation in the rise, and the largest force of the fall into the bore."""
    watched = subject.watched
    return measured_all(
        results,
        {
            SHOWN["mean"]: ("N", lambda r: watched.mean(r, r[watched.force])),
            SHOWN["ripple"]: ("N", lambda r: watched.rms_fluctuation(r, r[watched.force])),
            SHOWN["fall"]: ("N", lambda r: float(r.largest_force[watched.pin])),
        },
    )


def contact_table(found: Found, frictions: Sequence[float]) -> TextTable:
    """A row for each contact and friction coefficient."""
    rows = []
    for contact in (PAPER, CYLINDERS):
        for friction in frictions:
            cells = [in_kilonewtons(found[name, case_name(contact, friction)]) for name in SHOWN.values()]
            rows.append((CONTACT_TITLES[contact], f"{friction:g}", *map(cell, cells)))
    header = ("contact", "mu_d", "mean force [kN]", "fluctuation [kN]", "largest force [kN]")
    return TextTable(header, tuple(rows), left=2)


def in_kilonewtons(number: Number) -> Number:
    """A force in kN."""
    return replace(number, value=1e-3 * number.value, numerical_error=1e-3 * number.numerical_error, unit="kN")
