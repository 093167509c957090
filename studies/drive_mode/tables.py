"""Tables of the drive modes, and what converges under step halving."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from studies.common.numbers import Found, Number, against, cell
from studies.common.runs import halvings
from studies.common.words import TextTable
from studies.drive_mode.cases import MODES, NAIVE, PINS, ModePlan, case_name
from studies.drive_mode.measures import ON_CYLINDERS, START, STOP, all_measures, measures_of
from support_exudyn import Result

SAVED = (START, STOP, "std_pin_force", "rms_pin_force", "largest_angular_acceleration")
IMPULSE = "an impulse"
CONVERGES = "converges"
DIVERGES = "does not converge"
VELOCITY = "RMS fluctuation angular velocity"  # as the table of step halving has it
Rows = Sequence[Sequence[str]]  # of that table


def key_table(found: Found, plan: ModePlan) -> TextTable:
    """The largest pin force in both modes, in the motion and after its end, by actuators and pin."""
    watched, rows = plan.subject.watched, []
    windows = {START: f"{watched.start:g} to {watched.end:g} s", STOP: f"after {watched.end:g} s"}
    for columns in plan.columns:
        for pin in plan.pins:
            numbers = [found.get((name, case_name(mode, pin, columns))) for mode in MODES for name in windows]
            cells = (IMPULSE if one is None else cell(in_kilonewtons(one)) for one in numbers)
            rows.append((columns, pin, *cells))
    headings = (f"{mode}, {window} [kN]" for mode in MODES for window in windows.values())
    return TextTable(("actuators", "pin", *headings), tuple(rows), left=2)


def in_kilonewtons(number: Number) -> Number:
    """A force in kN."""
    return replace(number, value=1e-3 * number.value, numerical_error=1e-3 * number.numerical_error, unit="kN")


def mode_table(found: Found, plan: ModePlan, columns: str) -> TextTable:
    """Both modes side by side."""
    return _side_by_side(found, plan, {name: unit for name, (unit, _) in all_measures(plan).items()}, columns)


def valve_table(found: Found, plan: ModePlan) -> TextTable:
    """What there is on cylinders only."""
    return _side_by_side(found, plan, {name: unit for name, (unit, _) in ON_CYLINDERS.items()}, "cylinder")


def _side_by_side(found: Found, plan: ModePlan, units: Mapping[str, str], columns: str) -> TextTable:
    """A row a quantity that is known of any case."""
    cases = [case_name(mode, pin, columns) for pin in plan.pins for mode in MODES]
    rows = []
    for name, unit in units.items():
        cells = [cell(found.get((name, case))) for case in cases]
        if any(cells):
            rows.append((f"{name.replace('_', ' ')} [{unit}]", *cells))
    return TextTable(("quantity", *(f"{mode}, {pin}" for pin in plan.pins for mode in MODES)), tuple(rows))


def saving_table(found: Found, plan: ModePlan) -> TextTable:
    """What the gentle drive saves."""
    headings = [(pin, columns) for columns in plan.columns for pin in plan.pins]
    rows = []
    for name in (*SAVED, *(f"largest_{actuator}_force" for actuator in plan.actuators)):
        cells = []
        for pin, columns in headings:
            sudden, gentle = (found.get((name, case_name(mode, pin, columns))) for mode in MODES)
            cells.append(IMPULSE if sudden is None or gentle is None else against(gentle, sudden))
        rows.append((name.replace("_", " "), *cells))
    return TextTable(("quantity", *(f"{columns}, {pin}" for pin, columns in headings)), tuple(rows))


def convergence_table(plan: ModePlan, results: Mapping[str, Result]) -> TextTable:
    """Every number of every run."""
    rows = []
    for case, result in results.items():
        for name, (unit, get) in measures_of(plan, result).items():
            values = [get(run) for run in halvings(result)]
            rows.append((case, name.replace("_", " "), unit, *(f"{v:.7g}" for v in values), verdict(values)))
    header = ("case", "quantity", "unit", "run 1", "run 2", "run 3", "verdict")
    return TextTable(header, tuple(rows), left=3, width=170, in_chapter=False)


def halving_table(plan: ModePlan, results: Mapping[str, Result], naive: str | None) -> TextTable:
    """How far the numbers of each case still move; and the peaks that are no numbers."""
    rows = []
    for case, result in results.items():
        columns = [[get(run) for run in halvings(result)] for _, get in measures_of(plan, result).values()]
        last = max(abs(values[-1] - values[-2]) / abs(values[-1]) for values in columns if values[-1] != 0.0)
        good = sum(verdict(values) == CONVERGES for values in columns)
        rows.append((case, f"{100.0 * last:.1g} %", f"{good} of {len(columns)}", ""))
    if naive:
        rows.append((NAIVE, "", "0 of 1", f"peak angular acceleration {naive}"))
    return TextTable(
        ("case", "largest last change", "converge", "remark"), tuple(rows), wide=True, in_file=False
    )


def naive_said(peaks: Mapping[float, float]) -> str:
    """Peaks of the stock recipe [deg/s^2] by its steps [s], in words."""
    values = ", ".join(f"{peak:.0f}" for peak in peaks.values())
    steps = ", ".join(f"{1e3 * step:g}" for step in peaks)
    return f"{values} deg/s² at {steps} ms"


def verdict(values: Sequence[float]) -> str:
    """Whether three values under step halving tend to a limit."""
    before, last = (abs(b - a) for a, b in pairwise(values))
    return CONVERGES if last <= 0.01 * abs(values[-1]) or last < 0.7 * before else DIVERGES


def limits(rows: Rows) -> tuple[int, int, list[str]]:
    """How many numbers converge, of how many, and which do not."""
    diverging = sorted({f"{row[1]} in {row[0]}" for row in rows if row[-1] == DIVERGES})
    return sum(row[-1] == CONVERGES for row in rows), len(rows), diverging


def velocity_converges(rows: Rows) -> bool:
    """Whether the paper's Fig. 13 b, for mode 1 on rigid columns, has a limit."""
    cases = [case_name("mode 1", pin, "rigid") for pin in PINS]
    judged = [row[-1] for row in rows if row[0] in cases and row[1] == VELOCITY]
    return bool(judged) and all(one == CONVERGES for one in judged)
