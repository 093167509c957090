"""What assumptions on oil and contact do to the peak of the sudden inlet: a band beside the numerical error.

The start of mode 1 on columns of oil, over bulk modulus and hoses of the oil and over the contact of the pin.
It starts as soon as the journal rests, and ends when the first swings are over.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

from studies.common import paper_machine, rise
from studies.common.paper_machine import CLEARANCE_MM, CONTACT_TITLES, CYLINDERS, PAPER
from studies.common.words import TextTable
from studies.drive_mode.cases import PINS, ModePlan, case_name
from support_exudyn import ClearancePin, Line, Result, Scenario, UniformSpeed

MODULI = (1.5e9, 2.2e9)  # of the oil [Pa]; four published shields give 1.96 GPa
HOSES = {  # of a pair of columns, by what they are called
    "wide hoses": Line(volume=5e-3, nominal_flow=200e-3 / 60.0, nominal_drop=5e5),
    "usual hoses": paper_machine.HOSES,  # those of the rest of the study
    "narrow hoses": Line(volume=20e-3, nominal_flow=200e-3 / 60.0, nominal_drop=2e6),
}
START, AFTER = 0.8, 0.4  # of mode 1, when the journal rests; and how long is looked at [s]
PEAK = rise.Peak(rise.FORCE, 1e-3, START, START + AFTER)  # [kN]
USUAL = "usual hoses"


class Band(NamedTuple):
    """The peak of a pin [kN]: as assumed in the rest of the study, the lowest and the highest of the grid."""

    usual: float
    low: float
    high: float

    @property
    def said(self) -> str:
        """From where to where, in words."""
        return f"{self.low:.0f} to {self.high:.0f} kN"


def pins() -> dict[str, str]:
    """The pins, by name, with what they are called: ideal, and 1.5 mm by two contacts."""
    return {PINS[0]: PINS[0]} | {one: f"{PINS[1]}, {CONTACT_TITLES[one]}" for one in (PAPER, CYLINDERS)}


def scenarios(plan: ModePlan) -> dict[str, Scenario]:
    """Every run of the grid, by name."""
    return {
        _name(pin, modulus, hoses): _run(plan, pin, modulus, hoses)
        for pin in pins()
        for modulus in MODULI
        for hoses in HOSES
    }


def _name(pin: str, modulus: float, hoses: str) -> str:
    return f"start of mode 1, {pin}, {modulus / 1e9:g} GPa, {hoses}"


def _run(plan: ModePlan, pin: str, modulus: float, hoses: str) -> Scenario:
    ideal = pin == PINS[0]
    base = plan.scenarios[case_name("mode 1", PINS[0] if ideal else PINS[1], "oil")]
    own = base.drive
    assert isinstance(own, UniformSpeed)
    drive = replace(own, start=START, end=START + own.end - own.start)
    columns = {
        name: replace(column, bulk_modulus=modulus, line=HOSES[hoses])
        for name, column in paper_machine.oil_columns().items()
    }
    pins = base.pins if ideal else {paper_machine.CLEARANCE_PIN: _joint(plan, pin)}
    return replace(
        base, drive=drive, duration=START + AFTER, actuators=columns, pins=pins, channels=(rise.FORCE,)
    )


def _joint(plan: ModePlan, contact: str) -> ClearancePin:
    return paper_machine.clearance_joint(
        CLEARANCE_MM, plan.subject.friction, contact=contact, law=paper_machine.PAPERS_LAW
    )


def bands(results: Mapping[str, Result]) -> dict[str, Band]:
    """The peak of each pin over the grid, by the pin's name."""
    found = {}
    for pin in pins():
        peaks = {
            (modulus, hoses): PEAK(results[_name(pin, modulus, hoses)]) for modulus in MODULI for hoses in HOSES
        }
        usual = peaks[paper_machine.BULK_MODULUS, USUAL]
        found[pin] = Band(usual, min(peaks.values()), max(peaks.values()))
    return found


def band_table(found: Mapping[str, Band]) -> TextTable:
    """A row a pin: its peak as assumed, and from where to where it may lie."""
    rows = []
    ideal = found[PINS[0]]
    for pin, title in pins().items():
        band = found[pin]
        against = "" if pin == PINS[0] else f"{100.0 * (band.usual / ideal.usual - 1.0):+.0f} %"
        rows.append((title, f"{band.usual:.0f}", against, f"{band.low:.0f} to {band.high:.0f}"))
    return TextTable(("pin", "peak [kN]", "against ideal", "over oil and hoses [kN]"), tuple(rows))
