"""What assumptions on oil and contact do to the peak of the sudden inlet: a band beside the numerical error.

The start of mode 1 on columns of oil, as assumed and with the stiffest and the softest oil, by each contact of
the pin. The machine starts at rest, its journal on the bore: after a fall into the bore the phase of its last
bounces would decide about a tenth of the peak. It ends when the first swings are over.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial

from studies.common import paper_machine, rise
from studies.common.numbers import Found, Number, against, cell, measured_all
from studies.common.paper_machine import CLEARANCE_MM, CONTACT_TITLES, CYLINDERS, PAPER
from studies.common.words import text_table
from studies.drive_mode.cases import PINS, ModePlan, case_name
from support_exudyn import Line, Result, Scenario, UniformSpeed
from support_exudyn.postprocessing.page.pieces import Sheet

USUAL, SOFTEST, STIFFEST = "oil as assumed", "softest oil", "stiffest oil"
OIL = {  # bulk modulus [Pa], four published shields give 1.96 GPa; and hoses of a pair of columns
    USUAL: (paper_machine.BULK_MODULUS, paper_machine.HOSES),
    SOFTEST: (1.5e9, Line(volume=20e-3, nominal_flow=200e-3 / 60.0, nominal_drop=2e6)),
    STIFFEST: (2.2e9, Line(volume=5e-3, nominal_flow=200e-3 / 60.0, nominal_drop=5e5)),
}
START, AFTER = 0.05, 0.4  # of mode 1, and how long is looked at [s]
PEAK = rise.Crest(rise.FORCE, 1e-3, START, START + AFTER)  # [kN]
NAME = "peak_at_start"


def pins() -> dict[str, str]:
    """The pins, by name, with what they are called: ideal, and 1.5 mm by two contacts."""
    return {PINS[0]: PINS[0]} | {one: f"{PINS[1]}, {CONTACT_TITLES[one]}" for one in (PAPER, CYLINDERS)}


def scenarios(plan: ModePlan) -> dict[str, Scenario]:
    """Every run, by name."""
    return {run_name(pin, oil): _run(plan, pin, oil) for pin in pins() for oil in OIL}


def run_name(pin: str, oil: str) -> str:
    """The name of a run."""
    return f"start of mode 1, {pin}, {oil}"


def _run(plan: ModePlan, pin: str, oil: str) -> Scenario:
    ideal = pin == PINS[0]
    base = plan.scenarios[case_name("mode 1", PINS[0] if ideal else PINS[1], "oil")]
    own = base.drive
    assert isinstance(own, UniformSpeed)
    drive = replace(own, start=START, end=START + own.end - own.start)
    modulus, hoses = OIL[oil]
    columns = {
        name: replace(column, bulk_modulus=modulus, line=hoses)
        for name, column in paper_machine.oil_columns().items()
    }
    joint = partial(paper_machine.clearance_joint, CLEARANCE_MM, law=paper_machine.PAPERS_LAW)
    pins = base.pins if ideal else {paper_machine.CLEARANCE_PIN: joint(plan.subject.friction, contact=pin)}
    return replace(
        base,
        drive=drive,
        duration=START + AFTER,
        start="settled",
        actuators=columns,
        pins=pins,
        channels=(rise.FORCE,),
    )


def measure(results: Mapping[str, Result]) -> list[Number]:
    """The peak of every run."""
    return measured_all(results, {NAME: ("kN", PEAK)})


def peak(found: Found, pin: str, oil: str = USUAL) -> Number:
    """The peak of a pin."""
    return found[NAME, run_name(pin, oil)]


def band(found: Found, pin: str) -> str:
    """From where to where the peak of a pin may lie, in words."""
    peaks = [peak(found, pin, oil).value for oil in OIL]
    return f"{min(peaks):.0f} to {max(peaks):.0f} kN"


def band_table(found: Found) -> Sheet:
    """A row a pin: its peak as assumed, and with the softest and the stiffest oil."""
    rows = []
    for pin, title in pins().items():
        change = "" if pin == PINS[0] else against(peak(found, pin), peak(found, PINS[0]))
        usual, soft, stiff = (cell(peak(found, pin, oil)) for oil in (USUAL, SOFTEST, STIFFEST))
        rows.append((title, usual, change, soft, stiff))
    header = ("pin", "peak [kN]", "against ideal", f"{SOFTEST} [kN]", f"{STIFFEST} [kN]")
    return text_table(header, rows)
