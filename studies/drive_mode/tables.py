"""Tables of the drive modes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

from studies.common import paper_machine
from studies.common.chapter import Sheet
from studies.common.study import Number, brief, halvings
from studies.common.wording import by_case
from studies.drive_mode.cases import COLUMNS, FRICTION, MODES, NAIVE, PINS, case_name
from studies.drive_mode.measures import IMPULSES, MEASURES, measures_of
from support_exudyn import Result

NAMES = {"rigid": "rigid columns", "oil": "columns of oil", "cylinder": "hydraulic cylinders"}
SAID = {
    "rigid": "At the jumps of mode 1 forces and accelerations do not exist; the largest are of what follows "
    "them.",
    "oil": "Oil: " + paper_machine.OIL_SAID,
    "cylinder": "Cylinders: " + paper_machine.CYLINDERS_SAID,
}
SAVED = (
    "largest_pin_force_in_rise",
    "std_pin_force",
    "ripple_pin_force",
    "largest_front_column_force",
    "largest_rear_column_force",
    "largest_angular_acceleration",
    "std_angular_acceleration",
)
CONVERGES = "converges"
DIVERGES = "does not converge"
SAID_CONVERGES = (
    "Impact steps are halved with the steps. Converges: the last change is below 1 % of the value, or less "
    "than 0.7 of the change before. Rigid columns: records at the jump itself hold the values before it."
)


def mode_sheet(numbers: Sequence[Number], columns: str) -> Sheet:
    """Both modes side by side."""
    found = by_case(numbers)
    cases = [case_name(mode, pin, columns) for pin in PINS for mode in MODES]
    rows = []
    for name, (unit, _) in MEASURES.items():
        rows.append((name.replace("_", " "), unit, *(_cell(found[name, case]) for case in cases)))
    for name in IMPULSES:
        cells = [_cell(found[name, case]) if (name, case) in found else "" for case in cases]
        if any(cells):
            rows.append((name.replace("_", " "), "N s", *cells))
    return Sheet(
        f"Drive modes on {NAMES[columns]}",
        ("quantity", "unit", *(f"{mode}, {pin}" for pin in PINS for mode in MODES)),
        tuple(rows),
        f"Over the rise, friction {FRICTION} in the loose pin. ± is the estimated error. " + SAID[columns],
        left=2,
    )


def saving_sheet(numbers: Sequence[Number]) -> Sheet:
    """What the gentle drive saves."""
    found = by_case(numbers)
    headings = [(pin, columns) for columns in COLUMNS for pin in PINS]
    rows = []
    for name in SAVED:
        cells = []
        for pin, columns in headings:
            sudden, gentle = (found[name, case_name(mode, pin, columns)].value for mode in MODES)
            struck = (pin, columns) == (PINS[0], "rigid")  # nothing gives: all of it is in the impulse
            cells.append("impulse" if struck else f"{100.0 * (gentle / sudden - 1.0):+.0f} %")
        rows.append((name.replace("_", " "), *cells))
    return Sheet(
        "What mode 2 changes against mode 1",
        ("quantity", *(f"{pin}, {columns}" for pin, columns in headings)),
        tuple(rows),
        "Minus: mode 2 is gentler. Impulse: with rigid columns and the ideal pin nothing gives, and mode 1 "
        "has no peak that could be compared.",
    )


def convergence_sheet(results: Mapping[str, Result]) -> Sheet:
    """Every number at every step."""
    rows = []
    for case, result in results.items():
        for name, (unit, get) in measures_of(result).items():
            values = [get(run) for run in halvings(result)]
            rows.append((case, name.replace("_", " "), unit, *(f"{v:.7g}" for v in values), verdict(values)))
    return Sheet(
        "Step halving, every number",
        ("case", "quantity", "unit", "step h", "step h/2", "step h/4", "verdict"),
        tuple(rows),
        SAID_CONVERGES,
        left=3,
    )


def short_convergence_sheet(results: Mapping[str, Result], naive: Mapping[float, float]) -> Sheet:
    """How far the numbers of each case still move; and the peaks that are no numbers."""
    rows = []
    for case, result in results.items():
        columns = [[get(run) for run in halvings(result)] for _, get in measures_of(result).values()]
        last = max(abs(values[-1] - values[-2]) / abs(values[-1]) for values in columns)
        good = sum(verdict(values) == CONVERGES for values in columns)
        rows.append((case, f"{100.0 * last:.1g} %", f"{good} of {len(columns)}", ""))
    rows.append((NAIVE, "", "0 of 1", f"peak angular acceleration {naive_said(naive)}"))
    return Sheet(
        "Step halving",
        ("case", "largest last change", "converge", "remark"),
        tuple(rows),
        f"{SAID_CONVERGES} All values stand in table_convergence.txt.",
        wide=True,
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


def _cell(number: Number) -> str:
    return brief(number.value, number.numerical_error)
