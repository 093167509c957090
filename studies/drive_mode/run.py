"""What does the oil inlet's drive mode do to the rise? (Section 5 of the paper.)

Mode 1 starts and stops the columns suddenly, mode 2 gently; with the ideal pin and with 1.5 mm of clearance;
on rigid columns, which pass a jump of speed on as an impulse, on columns of oil, in which its peaks have a
limit, and on hydraulic cylinders, which no displacement drives but the oil that a valve lets in.
"""

from collections.abc import Mapping

from studies.common import runs
from studies.common.numbers import Found, by_case
from studies.common.options import Options
from studies.common.study import Study, StudyOutcome
from studies.common.words import TextTable
from studies.drive_mode import assumed, cases, tables
from studies.drive_mode.cases import MODES, ModePlan, case_name, naive_peaks
from studies.drive_mode.figures import LIVE, figures
from studies.drive_mode.measures import START, STOP, measure
from support_exudyn import Result


def work(chosen: Options) -> StudyOutcome:
    """Both modes on all kinds of columns, and the peaks of the recipe that has no limit."""
    plan = ModePlan(chosen.subject)
    results = runs.run_with_errors(plan.scenarios, chosen)
    is_paper = plan.subject.is_paper
    bands = assumed.bands(runs.run_cases(assumed.scenarios(plan), chosen)) if is_paper else {}
    numbers = measure(plan, results)
    found = by_case(numbers)
    naive = tables.naive_said(naive_peaks()) if is_paper else None
    cylinders = {"table_valves": tables.valve_table(found, plan)} if "cylinder" in plan.columns else {}
    sheets = {
        "drive_modes": tables.key_table(found, plan),
        **({"assumed": assumed.band_table(bands)} if bands else {}),
        "table_saving": tables.saving_table(found, plan),
        **{f"table_{columns}": tables.mode_table(found, plan, columns) for columns in plan.columns},
        **cylinders,
        "step_halving": tables.halving_table(plan, results, naive),
        "table_convergence": tables.convergence_table(plan, results),
    }
    drawings = figures(plan, results)
    live = {name: LIVE[name] for name in drawings}
    return StudyOutcome(
        numbers,
        _words(plan, found, results, naive, sheets) | {"bands": bands},
        drawings,
        sheets,
        results,
        live=live,
    )


def _words(
    plan: ModePlan,
    found: Found,
    results: Mapping[str, Result],
    naive: str | None,
    sheets: Mapping[str, TextTable],
) -> dict[str, object]:
    ideal, with_clearance = plan.pins

    def value(name: str, mode: str, pin: str, columns: str) -> float:
        return found[name, case_name(mode, pin, columns)].value

    def heat(mode: str) -> float:
        work = value("work_of_pumps", mode, ideal, "cylinder")
        return 100.0 * value("loss_in_valves", mode, ideal, "cylinder") / work

    rows = sheets["table_convergence"].rows
    return {
        "cases": cases,
        "plan": plan,
        "found": found,
        "case_name": case_name,
        "START": START,
        "STOP": STOP,
        "ideal": ideal,
        "with_clearance": with_clearance,
        "softest": "oil" if "oil" in plan.columns else "rigid",
        "drive": plan.drive("mode 1", plan.leading[0]),
        "impulses": [name for name, case in found if name.startswith("impulse") and case == _struck(plan)],
        "value": value,
        "heat": {mode: heat(mode) for mode in MODES} if "cylinder" in plan.columns else {},
        "formulations": {run.scenario.formulation for run in results.values()},
        "naive": naive,
        "limits": tables.limits(rows),
        "velocity_converges": tables.velocity_converges(rows),
    }


def _struck(plan: ModePlan) -> str:
    """The case of the sudden start that says with how much it strikes."""
    return case_name("mode 1", plan.pins[1], "rigid")


study = Study("drive_mode", __doc__, work, seconds=35.0, own_machine=True)
main = study.main
