"""The drive modes as a chapter of the report: method and findings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from studies.common import paper_machine
from studies.common.chapter import Chapter
from studies.common.study import Number, halvings
from studies.common.wording import by_case, how_sure
from studies.drive_mode import cylinders as cylinders
from studies.drive_mode.cases import CLEARANCE_MM, COLUMNS, FRICTION, MODES, PINS, STUDY, case_name
from studies.drive_mode.figures import pictures
from studies.drive_mode.tables import (
    CONVERGES,
    DIVERGES,
    convergence_sheet,
    mode_sheet,
    naive_said,
    saving_sheet,
    short_convergence_sheet,
)
from support_exudyn import Result

VELOCITY = "ripple angular velocity"  # as the table has it
Rows = Sequence[Sequence[str]]  # of the table of step halving


def chapter(
    results: Mapping[str, Result], naive: Mapping[float, float], numbers: Sequence[Number], quick: bool
) -> Chapter:
    """The study as a chapter of the report."""
    step = next(iter(halvings(next(iter(results.values()))))).scenario.step
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
            "On columns of oil the sudden start is a finite load, and its peaks have a limit. "
            + paper_machine.OIL_SAID,
            "On hydraulic cylinders nothing prescribes a displacement: pressures of both chambers are "
            "coordinates of the engine's actuator, and the valve opens at once in mode 1, along ramps in mode "
            "2. " + paper_machine.CYLINDERS_SAID,
            f"Steps of the first run are {1e3 * step:g} ms, and so is the time between records. "
            f"{how_sure(quick)}",
        ),
        findings=(*_findings(results, naive, numbers), *cylinders.findings(numbers)),
        pictures=(*pictures(), *cylinders.pictures()),
        sheets=(
            *(mode_sheet(numbers, columns) for columns in COLUMNS),
            saving_sheet(numbers),
            cylinders.sheet(numbers),
            short_convergence_sheet(results, naive),
        ),
        quick=quick,
    )


def _findings(
    results: Mapping[str, Result], naive: Mapping[float, float], numbers: Sequence[Number]
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
    sheet = convergence_sheet(results)
    return (
        f"On rigid columns the sudden start of mode 1 strikes the front columns with {front:.0f} N s and the "
        f"rear columns with {rear:.0f} N s (1.5 mm; a negative one pulls).",
        f"On columns of oil the largest pin force of the rise is {peaks(PINS[0])}, {peaks(PINS[1])}: the "
        "gentle drive saves most of the peak.",
        "That clearance makes the sudden start's shock worse is not seen in the largest pin force: it is "
        f"{100 * (loose / ideal - 1):+.0f} % with clearance against the ideal pin (oil, mode 1).",
        _converging_said(sheet.rows),
        "The curves of the paper's Fig. 13 c and d for mode 1 cannot converge at 3 s and 5 s if its columns "
        "are rigid, as its drive by prescribed displacement suggests: without consistent velocities the peak "
        f"angular acceleration of a stock recipe is {naive_said(naive)}. "
        f"{_velocity_said(sheet.rows)}",
    )


def _converging_said(rows: Rows) -> str:
    """How many numbers converge, and which do not."""
    said = f"{sum(row[-1] == CONVERGES for row in rows)} of {len(rows)} numbers converge under step halving."
    if diverging := sorted({f"{row[1]} in {row[0]}" for row in rows if row[-1] == DIVERGES}):
        said += f" Not so: {'; '.join(diverging)}."
    return said


def _velocity_said(rows: Rows) -> str:
    """Of the paper's Fig. 13 b for mode 1 on rigid columns."""
    cases = [case_name("mode 1", pin, "rigid") for pin in PINS]
    judged = [row[-1] for row in rows if row[0] in cases and row[1] == VELOCITY]
    good = judged and all(verdict == CONVERGES for verdict in judged)
    return f"Angular velocities as in Fig. 13 b {'converge' if good else 'are not shown to converge here'}."
