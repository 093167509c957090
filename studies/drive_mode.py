"""What does the oil inlet's drive mode do to the rise? (Section 5 of the paper.)

Mode 1 starts and stops the columns suddenly, mode 2 gently; with the ideal pin and with 1.5 mm of clearance;
on rigid columns, which pass a jump of speed on as an impulse, on columns of oil, in which its peaks have a
limit, and on hydraulic cylinders, which no displacement drives but the oil that a valve lets in.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from studies import drive_mode_cylinders as cylinders
from studies import paper_machine, rise
from studies.drive_mode_figures import figures, pictures
from studies.ladder import Ladder, run_ladders
from studies.reporting.chapter import Chapter, Sheet
from studies.reporting.wording import by_case
from studies.study import (
    Number,
    Options,
    brief,
    options,
    run_cases,
    run_main,
    save_figures,
    show_table,
    write_summary,
)
from support_exudyn import CubicStep, Drive, Result, Scenario, UniformSpeed
from support_exudyn.figures import style
from user_forces import value

STUDY = "drive_mode"
CLEARANCE_MM = 1.5
MODES: dict[str, Drive] = {"mode 1": UniformSpeed(), "mode 2": CubicStep()}
NAMES = {"rigid": "rigid columns", "oil": "columns of oil", "cylinder": "hydraulic cylinders"}
SAID = {
    "rigid": "At the jumps of mode 1 forces and accelerations do not exist; the largest are of what follows "
    "them.",
    "oil": "Oil: " + paper_machine.OIL_SAID,
    "cylinder": "Cylinders: " + paper_machine.CYLINDERS_SAID,
}
PINS = ("ideal pin", f"{CLEARANCE_MM} mm")
COLUMNS = ("rigid", "oil", "cylinder")
FRICTION = paper_machine.SLIDING_COEFFICIENT
HALVINGS, QUICK_HALVINGS = 2, 1
DURATION = 5.1  # the sudden stop at 5 s is part of it [s]
NAIVE = "mode 1, stock recipe"  # velocities not made consistent


@value
class UnannouncedSpeed(UniformSpeed):
    """Mode 1 as a stock model has it: the speed jumps and the solver is not told."""

    def speed_jump(self, t: float) -> float:
        """None that anybody knows of."""
        del t
        return 0.0


def case_name(mode: str, pin: str, columns: str) -> str:
    """Name of a case."""
    return f"{mode}, {pin}, {columns} columns"


def scenarios(quick: bool) -> dict[str, Scenario]:
    """Both modes, both pins, all kinds of columns."""
    step, steps = (2e-3, 16) if quick else (1e-3, 64)
    bases = {
        PINS[0]: paper_machine.ideal_rise(step),
        PINS[1]: paper_machine.loose_rise(CLEARANCE_MM, FRICTION, step, steps, symbolic=True),
    }

    def run(mode: str, pin: str, columns: str) -> Scenario:
        base = replace(bases[pin], duration=DURATION, record_period=step, drive=MODES[mode])
        if columns == "cylinder":
            return cylinders.scenario(base, mode)
        return replace(base, columns=paper_machine.oil_columns() if columns == "oil" else {})

    return {
        case_name(mode, pin, columns): run(mode, pin, columns)
        for columns in reversed(COLUMNS)  # the longest first
        for pin in reversed(PINS)
        for mode in MODES
    }


def naive_scenarios() -> dict[str, Scenario]:
    """Mode 1 without consistent velocities, recorded step by step, at three steps, each half the one before."""
    drive = UnannouncedSpeed(start=0.05, end=2.05)
    base = replace(paper_machine.ideal_rise(1e-3), drive=drive, duration=0.06)
    base = replace(base, solver=replace(base.solver, audit=False))  # that energy does not add up is the point
    # after a break of the drive the solver takes a 32nd of its step
    return {
        f"{NAIVE}, step {1e3 * step:g} ms": replace(base, step=32 * step, record_period=step)
        for step in (1e-3, 5e-4, 2.5e-4)
    }


# --- measures ---

Get = Callable[[Result], float]


def _largest(channel: str, scale: float = 1.0) -> Get:
    return lambda r: scale * float(np.abs(r[channel][rise.in_rise(r)]).max())


def _ripple(channel: str, scale: float = 1.0) -> Get:
    # from the very start on, which is where mode 1 strikes
    return lambda r: scale * rise.ripple(r, r[channel], rise.START)


MEASURES: dict[str, tuple[str, Get]] = {
    "mean_pin_force": ("N", lambda r: float(r[rise.FORCE][rise.in_rise(r)].mean())),
    "std_pin_force": ("N", lambda r: float(r[rise.FORCE][rise.in_rise(r)].std())),
    "ripple_pin_force": ("N", _ripple(rise.FORCE)),
    "largest_pin_force_in_rise": ("N", _largest(rise.FORCE)),
    "largest_front_column_force": ("N", _largest("front_column.force")),
    "largest_rear_column_force": ("N", _largest("rear_column.force")),
    "largest_angular_acceleration": ("deg/s^2", _largest(rise.ACCELERATION, rise.DEGREES)),
    "std_angular_acceleration": (
        "deg/s^2",
        lambda r: rise.DEGREES * float(r[rise.ACCELERATION][rise.in_rise(r)].std()),
    ),
    "ripple_angular_velocity": ("deg/s", _ripple(rise.SPEED, rise.DEGREES)),
}


def _impulse(column: str, place: int) -> Get:
    return lambda r: r.impulses[place].columns[column]


IMPULSES: dict[str, Get] = {
    f"impulse_{column}_{end}": _impulse(column, place)
    for place, end in enumerate(("start", "end"))
    for column in ("front_column", "rear_column")
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


def peak_acceleration(result: Result) -> float:
    """Largest angular acceleration of the rear link at any record [deg/s^2]."""
    return rise.DEGREES * float(np.abs(result[rise.ACCELERATION]).max())


def measure(ladders: Mapping[str, Ladder]) -> list[Number]:
    """All numbers of the study, but for those that are none."""
    numbers = []
    for case, ladder in ladders.items():
        for name, (unit, get) in _measures_of(ladder).items():
            numbers.append(ladder.number(name, case, unit, get))
    return numbers


# --- tables ---


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
        f"Over the rise, friction {FRICTION} in the loose pin. ± is the change when all steps are halved a "
        "last time. " + SAID[columns],
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


def convergence_sheet(ladders: Mapping[str, Ladder]) -> Sheet:
    """Every number at every step."""
    rows = []
    for case, ladder in ladders.items():
        for name, (unit, get) in _measures_of(ladder).items():
            values = [get(result) for result in ladder.results]
            rows.append((case, name.replace("_", " "), unit, *(f"{v:.7g}" for v in values), verdict(values)))
    return Sheet(
        "Step halving, every number",
        ("case", "quantity", "unit", *_steps(ladders), "verdict"),
        tuple(rows),
        SAID_CONVERGES,
        left=3,
    )


def short_convergence_sheet(ladders: Mapping[str, Ladder], naive: Mapping[str, Result]) -> Sheet:
    """How far the numbers of each case still move; and the peaks that are no numbers."""
    rows = []
    for case, ladder in ladders.items():
        columns = [[get(result) for result in ladder.results] for _, get in _measures_of(ladder).values()]
        last = max(abs(values[-1] - values[-2]) / abs(values[-1]) for values in columns)
        good = sum(verdict(values) == CONVERGES for values in columns)
        rows.append((case, f"{100.0 * last:.1g} %", f"{good} of {len(columns)}", ""))
    peaks = ", ".join(f"{peak_acceleration(result):.0f}" for result in naive.values())
    rows.append((NAIVE, "", "0 of 1", f"peak angular acceleration {peaks} deg/s² at 1, 0.5, 0.25 ms"))
    return Sheet(
        "Step halving",
        ("case", "largest last change", "converge", "remark"),
        tuple(rows),
        f"{SAID_CONVERGES} All values stand in table_convergence.txt.",
        wide=True,
    )


CONVERGES = "converges"
SAID_CONVERGES = (
    "Impact steps are halved with the steps. Converges: the last change is below 1 % of the value, or less "
    "than 0.7 of the change before. Rigid columns: records at the jump itself hold the values before it."
)


def _measures_of(ladder: Ladder) -> dict[str, tuple[str, Get]]:
    impulses = {name: ("N s", get) for name, get in IMPULSES.items()} if ladder.finest.impulses else {}
    return MEASURES | impulses | (cylinders.MEASURES if ladder.finest.scenario.cylinders else {})


def verdict(values: Sequence[float]) -> str:
    """Whether values under step halving tend to a limit."""
    *before, last = (abs(b - a) for a, b in pairwise(values[-3:]))
    if last <= 0.01 * abs(values[-1]) or (before and last < 0.7 * before[0]):
        return CONVERGES
    return "does not converge" if before else "open: halved once only"


def _steps(ladders: Mapping[str, Ladder]) -> list[str]:
    """Headings of the steps."""
    number = len(next(iter(ladders.values())).results)
    return ["step h", *(f"step h/{2**n}" for n in range(1, number))]


def _cell(number: Number) -> str:
    return brief(number.value, number.numerical_error)


# --- words ---


def chapter(
    ladders: Mapping[str, Ladder], naive: Mapping[str, Result], numbers: Sequence[Number], quick: bool
) -> Chapter:
    """The study as a chapter of the report."""
    first = next(iter(ladders.values()))
    return Chapter(
        study=STUDY,
        title="Influence of the drive mode (section 5 of the paper)",
        question="What does a sudden oil inlet do that a gentle one does not, with and without clearance?",
        method=(
            "Mode 1 extends the columns at 0.25 m/s from 3 to 5 s, from standstill to standstill without "
            f"transition; mode 2 along a cubic step. Both with the ideal pin and with {CLEARANCE_MM} mm of "
            f"clearance (friction {FRICTION}).",
            "On rigid columns the sudden start is an impulse: all velocities jump with the columns'. They are "
            "given the values that masses and constraints demand (one linear solve), and the columns' "
            "impulses are reported in N s. A force or an acceleration at that instant does not exist; a "
            "program that integrates over the jump prints one that doubles whenever its step is halved (last "
            "row of the table of step halving).",
            "On columns of oil the sudden start is a finite load, and its peaks converge. "
            + paper_machine.OIL_SAID,
            "On hydraulic cylinders nothing prescribes a displacement: pressures of both chambers are "
            "coordinates of the engine's actuator, and the valve opens at once in mode 1, along ramps in mode "
            "2. " + paper_machine.CYLINDERS_SAID,
            f"Every case is run at a step of {1e3 * first.results[0].scenario.step:g} ms, and with all steps "
            f"halved {len(first.results) - 1} times, those of impacts included. Values are of the finest run, "
            "± is the last change."
            + (" This is the quick form: its steps are coarser than those of the full one." if quick else ""),
        ),
        findings=(*_findings(ladders, naive, numbers), *cylinders.findings(numbers)),
        pictures=(*pictures(), *cylinders.pictures()),
        sheets=(
            *(mode_sheet(numbers, columns) for columns in COLUMNS),
            saving_sheet(numbers),
            cylinders.sheet(numbers),
            short_convergence_sheet(ladders, naive),
        ),
        quick=quick,
    )


def _findings(
    ladders: Mapping[str, Ladder], naive: Mapping[str, Result], numbers: Sequence[Number]
) -> tuple[str, ...]:
    found = by_case(numbers)

    def value_of(name: str, mode: str, pin: str, columns: str) -> float:
        return found[name, case_name(mode, pin, columns)].value

    def peaks(pin: str) -> str:
        one, two = (1e-3 * value_of("largest_pin_force_in_rise", mode, pin, "oil") for mode in MODES)
        return f"{one:.0f} kN in mode 1 and {two:.0f} kN in mode 2 with {pin}"

    front, rear = (
        found[f"impulse_{column}_start", case_name("mode 1", PINS[1], "rigid")].value
        for column in ("front_column", "rear_column")
    )
    loose, ideal = (value_of("largest_pin_force_in_rise", "mode 1", pin, "oil") for pin in (PINS[1], PINS[0]))
    sheet = convergence_sheet(ladders)
    failing = [row for row in sheet.rows if row[-1] != CONVERGES]
    tested = len(sheet.rows)
    peaks_naive = ", ".join(f"{peak_acceleration(result):.0f}" for result in naive.values())
    return (
        f"On rigid columns the sudden start of mode 1 strikes the front columns with {front:.0f} N s and the "
        f"rear columns with {rear:.0f} N s (1.5 mm; a negative one pulls).",
        f"On columns of oil the largest pin force of the rise is {peaks(PINS[0])}, {peaks(PINS[1])}: the "
        "gentle drive saves most of the peak.",
        "That clearance makes the sudden start's shock worse is not seen in the largest pin force: it is "
        f"{100 * (loose / ideal - 1):+.0f} % with clearance against the ideal pin (oil, mode 1).",
        f"{tested - len(failing)} of {tested} numbers converge under step halving. "
        + (
            "Not so: " + "; ".join(sorted({f"{row[1]} in {row[0]}" for row in failing})) + "."
            if failing
            else ""
        ),
        "The curves of the paper's Fig. 13 c and d for mode 1 cannot converge at 3 s and 5 s if its columns "
        "are rigid, as its drive by prescribed displacement suggests: without consistent velocities the peak "
        f"angular acceleration here is {peaks_naive} deg/s² at 1, 0.5 and 0.25 ms. Fig. 13 a and b converge.",
    )


# --- main ---


def study(chosen: Options) -> None:
    """Run, measure, draw and write everything into the output folder."""
    started = time.perf_counter()
    halvings = QUICK_HALVINGS if chosen.quick else HALVINGS
    ladders = run_ladders(scenarios(chosen.quick), halvings, chosen.workers)
    for name, ladder in ladders.items():
        ladder.finest.save(chosen.out / "runs" / f"{_file_name(name)}.h5")
    naive = run_cases(naive_scenarios(), chosen.workers)
    numbers = measure(ladders)
    with style.look():
        finest = {case: ladder.finest for case, ladder in ladders.items()}
        drawings = figures(finest) | cylinders.figures(finest)
    save_figures(chosen, drawings)
    for columns in COLUMNS:
        show_table(chosen.out / f"table_{columns}.txt", mode_sheet(numbers, columns))
    show_table(chosen.out / "table_saving.txt", saving_sheet(numbers))
    show_table(chosen.out / "table_valves.txt", cylinders.sheet(numbers))
    show_table(chosen.out / "table_convergence.txt", convergence_sheet(ladders), width=170)
    chapter(ladders, naive, numbers, chosen.quick).save(chosen.out)
    write_summary(chosen.out, STUDY, numbers, time.perf_counter() - started)


def _file_name(case: str) -> str:
    return case.replace(",", "").replace(" ", "_").replace(".", "p")


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.drive_mode`."""
    description = (__doc__ or "").splitlines()[0]
    return run_main(study, options(STUDY, argv, description))


if __name__ == "__main__":
    sys.exit(main())
