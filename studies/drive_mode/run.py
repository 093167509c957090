"""What does the oil inlet's drive mode do to the rise? (Section 5 of the paper.)

Mode 1 starts and stops the columns suddenly, mode 2 gently; with the ideal pin and with 1.5 mm of clearance;
on rigid columns, which pass a jump of speed on as an impulse, on columns of oil, in which its peaks have a
limit, and on hydraulic cylinders, which no displacement drives but the oil that a valve lets in.
"""

from collections.abc import Mapping

from studies.common.numbers import Found, by_case
from studies.common.options import Options
from studies.common.runs import halvings, run_with_errors
from studies.common.study import Study, StudyOutcome
from studies.common.words import TextTable
from studies.drive_mode import cases, tables
from studies.drive_mode.cases import COLUMNS, MODES, PINS, case_name, naive_peaks, scenarios
from studies.drive_mode.figures import figures
from studies.drive_mode.measures import measure
from support_exudyn import Result


def work(chosen: Options) -> StudyOutcome:
    """Both modes on all kinds of columns, and the peaks of the recipe that has no limit."""
    results = run_with_errors(scenarios(chosen.quick), chosen)
    numbers = measure(results)
    found = by_case(numbers)
    naive = tables.naive_said(naive_peaks())
    sheets = {
        **{f"table_{columns}": tables.mode_table(found, columns) for columns in COLUMNS},
        "table_saving": tables.saving_table(found),
        "table_valves": tables.valve_table(found),
        "step_halving": tables.halving_table(results, naive),
        "table_convergence": tables.convergence_table(results),
    }
    return StudyOutcome(numbers, _words(found, results, naive, sheets), figures(results), sheets, results)


def _words(
    found: Found, results: Mapping[str, Result], naive: str, sheets: Mapping[str, TextTable]
) -> dict[str, object]:
    ideal, with_clearance = PINS

    def value(name: str, mode: str, pin: str, columns: str) -> float:
        return found[name, case_name(mode, pin, columns)].value

    def heat(mode: str) -> float:
        work = value("work_of_pumps", mode, ideal, "cylinder")
        return 100.0 * value("loss_in_valves", mode, ideal, "cylinder") / work

    rows = sheets["table_convergence"].rows
    return {
        "cases": cases,
        "ideal": ideal,
        "with_clearance": with_clearance,
        "value": value,
        "step": halvings(next(iter(results.values())))[0].scenario.step,
        "heat": {mode: heat(mode) for mode in MODES},
        "naive": naive,
        "limits": tables.limits(rows),
        "velocity_converges": tables.velocity_converges(rows),
    }


study = Study("drive_mode", __doc__, work)
main = study.main
