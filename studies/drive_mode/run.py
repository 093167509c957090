"""What does the oil inlet's drive mode do to the rise? (Section 5 of the paper.)

Mode 1 starts and stops the columns suddenly, mode 2 gently; with the ideal pin and with 1.5 mm of clearance;
on rigid columns, which pass a jump of speed on as an impulse, on columns of oil, in which its peaks have a
limit, and on hydraulic cylinders, which no displacement drives but the oil that a valve lets in.
"""

from collections.abc import Mapping, Sequence

from studies.common.numbers import Found, Number, against, by_case, cell, measured_all
from studies.common.options import Options
from studies.common.study import Study, StudyOutcome
from studies.common.witness import Witness, run_on_exudyn, with_errors
from studies.common.words import text_table
from studies.drive_mode import assumed, cases
from studies.drive_mode.cases import MODES, PINS, ModePlan, case_name
from studies.drive_mode.figures import LIVE, figures
from studies.drive_mode.measures import START, STOP, measures_of
from support_exudyn import Result
from support_exudyn.postprocessing.page.pieces import Sheet

SAVED = (START, STOP, "std_pin_force", "rms_pin_force", "largest_angular_acceleration")
IMPULSE = "an impulse"
VELOCITY = "rms_angular_velocity"
CONVERGED = 0.01  # error of a number that has a limit, as a share of it


# --- tables ---


def key_table(found: Found, plan: ModePlan) -> Sheet:
    """The largest pin force in both modes, in the motion and after its end, by actuators and pin."""
    watched, rows = plan.subject.watched, []
    windows = {START: f"{watched.start:g} to {watched.end:g} s", STOP: f"after {watched.end:g} s"}
    for columns in plan.columns:
        for pin in plan.pins:
            numbers = [found.get((name, case_name(mode, pin, columns))) for mode in MODES for name in windows]
            rows.append((columns, pin, *(cell(one, 1e-3) or IMPULSE for one in numbers)))
    headings = (f"{mode}, {window} [kN]" for mode in MODES for window in windows.values())
    return text_table(("actuators", "pin", *headings), rows, left=2)


def saving_table(found: Found, plan: ModePlan) -> Sheet:
    """What the gentle drive saves."""
    headings = [(pin, columns) for columns in plan.columns for pin in plan.pins]
    rows = []
    for name in (*SAVED, *(f"largest_{actuator}_force" for actuator in plan.actuators)):
        cells = []
        for pin, columns in headings:
            sudden, gentle = (found.get((name, case_name(mode, pin, columns))) for mode in MODES)
            cells.append(IMPULSE if sudden is None or gentle is None else against(gentle, sudden))
        rows.append((name.replace("_", " "), *cells))
    return text_table(("quantity", *(f"{columns}, {pin}" for pin, columns in headings)), rows)


def tables(found: Found, plan: ModePlan) -> dict[str, Sheet]:
    """All tables, by name."""
    sheets = {"drive_modes": key_table(found, plan), "table_saving": saving_table(found, plan)}
    if plan.subject.is_paper:
        sheets["assumed"] = assumed.band_table(found)
    return sheets


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """Both modes on all kinds of columns, and the start by assumptions."""
    plan = ModePlan(chosen.subject)
    starts = assumed.scenarios(plan) if plan.subject.is_paper else {}
    every = {**plan.scenarios, **starts}

    def numbers_of(made: Mapping[str, Result]) -> list[Number]:
        of_modes = {name: made[name] for name in plan.scenarios}
        of_starts = assumed.measure({name: made[name] for name in starts})
        return [*measured_all(of_modes, lambda run: measures_of(plan, run)), *of_starts]

    def sheets(numbers: Sequence[Number]) -> dict[str, Sheet]:
        return tables(by_case(numbers), plan)

    made = run_on_exudyn(every, chosen)
    results = {name: made[name] for name in plan.scenarios}
    numbers = with_errors(numbers_of(made))
    drawings = figures(plan, results)
    return StudyOutcome(
        numbers,
        _words(plan, by_case(numbers)),
        drawings,
        sheets(numbers),
        results,
        live={name: LIVE[name] for name in drawings},
        witness=Witness(every, numbers_of, sheets),
    )


def _words(plan: ModePlan, found: Found) -> dict[str, object]:
    ideal, with_clearance = plan.pins
    struck = case_name("mode 1", with_clearance, "rigid")  # by the sudden start
    is_paper = plan.subject.is_paper

    def heat(mode: str) -> float:
        work, loss = (
            found[name, case_name(mode, ideal, "cylinder")].value
            for name in ("work_of_pumps", "loss_in_valves")
        )
        return 100.0 * loss / work

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
        "impulses": [name for name, case in found if name.startswith("impulse") and case == struck],
        "heat": {mode: heat(mode) for mode in MODES} if is_paper else {},
        "assumed": assumed if is_paper else None,
        "velocity_converges": is_paper and velocity_converges(found),
    }


def velocity_converges(found: Found) -> bool:
    """Whether the paper's Fig. 13 b, for mode 1 on rigid columns, has a limit: its errors are small."""
    numbers = [found[VELOCITY, case_name("mode 1", pin, "rigid")] for pin in PINS]
    return all(one.numerical_error <= CONVERGED * one.value for one in numbers)


study = Study("drive_mode", __doc__, work, seconds=50.0, own_machine=True)
