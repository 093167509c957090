"""What do the paper's drive modes become if valves and a pump make them?

A valve opens at once (mode 1) or along a ramp (mode 2) and lets oil of a pump into both rows of columns. The
usual station gives 450 l/min, shared by all; one without a limit makes the paper's rise of 2 s.
"""

from studies.common.numbers import Found, by_case, cell
from studies.common.options import Options
from studies.common.runs import run_with_errors
from studies.common.study import Study, StudyOutcome
from studies.common.words import TextTable
from studies.valve_modes import cases
from studies.valve_modes.cases import MODES, OILS, PINS, PUMPS, case_name
from studies.valve_modes.figures import figures
from studies.valve_modes.measures import ROWS, measure

SHOWN = (
    "speed_in_mid_rise",
    "extension_at_end",
    "least_pressure",
    "largest_pressure",
    "largest_cavity",
    "least_force",
)


def work(chosen: Options) -> StudyOutcome:
    """Both modes on both pumps, with both pins, and with oil that pulls."""
    results = run_with_errors(cases.scenarios(), chosen)
    numbers = measure(results)
    found = by_case(numbers)
    sheets = {
        **{
            f"table_{place}": row_table(found, pump)
            for place, pump in zip(("pump", "free"), PUMPS, strict=True)
        },
        "table_pin": pin_table(found),
    }
    words = {"found": found, "cases": cases, "case_name": case_name, "pumps": PUMPS, "pins": PINS}
    return StudyOutcome(numbers, words, figures(results), sheets, results)


def row_table(found: Found, pump: str) -> TextTable:
    """Each row of columns on a pump, with the ideal pin, by mode and oil."""
    columns = [(mode, oil) for mode in MODES for oil in OILS]
    rows = [
        (
            f"{name.replace('_', ' ')}, {row}",
            *(_cell(found, f"{name}_{row}", mode, pump, PINS[0], oil) for mode, oil in columns),
        )
        for name in SHOWN
        for row in ROWS
    ]
    header = ("number", *(f"{mode}, oil {oil}" for mode, oil in columns))
    return TextTable(header, tuple(rows))


def pin_table(found: Found) -> TextTable:
    """The pin's largest force, by pump, pin, mode and oil."""
    columns = [(mode, oil) for mode in MODES for oil in OILS]
    rows = [
        (
            f"at the {when}, {pump}, {pin}",
            *(_cell(found, f"largest_pin_force_at_{when}", mode, pump, pin, oil) for mode, oil in columns),
        )
        for when in ("start", "end")
        for pump in PUMPS
        for pin in PINS
    ]
    header = ("largest pin force", *(f"{mode}, oil {oil}" for mode, oil in columns))
    return TextTable(header, tuple(rows))


def _cell(found: Found, name: str, mode: str, pump: str, pin: str, oil: str) -> str:
    return cell(found.get((name, case_name(mode, pump, pin, oil))))


study = Study("valve_modes", __doc__, work, seconds=40.0)
main = study.main
