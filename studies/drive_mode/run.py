"""What does the oil inlet's drive mode do to the rise? (Section 5 of the paper.)

Mode 1 starts and stops the columns suddenly, mode 2 gently; with the ideal pin and with 1.5 mm of clearance;
on rigid columns, which pass a jump of speed on as an impulse, on columns of oil, in which its peaks have a
limit, and on hydraulic cylinders, which no displacement drives but the oil that a valve lets in.
"""

from collections.abc import Mapping, Sequence

from studies.common.numbers import Found, Number, by_case
from studies.common.options import Options
from studies.common.study import Study, StudyOutcome
from studies.common.witness import Witness, run_on_exudyn, with_errors
from studies.common.words import TextTable
from studies.drive_mode import assumed, cases, tables
from studies.drive_mode.cases import MODES, ModePlan, case_name, naive_peaks
from studies.drive_mode.figures import LIVE, figures
from studies.drive_mode.measures import START, STOP, measure
from support_exudyn import Result


def work(chosen: Options) -> StudyOutcome:
    """Both modes on all kinds of columns, the start by assumptions, and the recipe that has no limit."""
    plan = ModePlan(chosen.subject)
    is_paper = plan.subject.is_paper
    starts = assumed.scenarios(plan) if is_paper else {}
    cases = {**plan.scenarios, **starts}

    def numbers_of(made: Mapping[str, Result]) -> list[Number]:
        of_modes = measure(plan, {name: made[name] for name in plan.scenarios})
        return [*of_modes, *assumed.measure({name: made[name] for name in starts})]

    def sheets(numbers: Sequence[Number]) -> dict[str, TextTable]:
        known = by_case(numbers)
        return {
            "drive_modes": tables.key_table(known, plan),
            **({"assumed": assumed.band_table(known)} if starts else {}),
            "table_saving": tables.saving_table(known, plan),
            **{f"table_{columns}": tables.mode_table(known, plan, columns) for columns in plan.columns},
            **({"table_valves": tables.valve_table(known, plan)} if "cylinder" in plan.columns else {}),
        }

    made = run_on_exudyn(cases, chosen)
    results = {name: made[name] for name in plan.scenarios}
    numbers = with_errors(numbers_of(made))
    drawings = figures(plan, results)
    return StudyOutcome(
        numbers,
        _words(plan, by_case(numbers), tables.naive_said(naive_peaks()) if is_paper else None),
        drawings,
        sheets(numbers),
        results,
        live={name: LIVE[name] for name in drawings},
        witness=Witness(cases, numbers_of, sheets),
    )


def _words(plan: ModePlan, found: Found, naive: str | None) -> dict[str, object]:
    ideal, with_clearance = plan.pins

    def value(name: str, mode: str, pin: str, columns: str) -> float:
        return found[name, case_name(mode, pin, columns)].value

    def heat(mode: str) -> float:
        work = value("work_of_pumps", mode, ideal, "cylinder")
        return 100.0 * value("loss_in_valves", mode, ideal, "cylinder") / work

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
        "naive": naive,
        "assumed": assumed if plan.subject.is_paper else None,
        "velocity_converges": plan.subject.is_paper and tables.velocity_converges(found),
    }


def _struck(plan: ModePlan) -> str:
    """The case of the sudden start that says with how much it strikes."""
    return case_name("mode 1", plan.pins[1], "rigid")


study = Study("drive_mode", __doc__, work, seconds=50.0, own_machine=True)
main = study.main
