"""Tables of the drive modes."""

from collections.abc import Mapping
from dataclasses import replace

from studies.common.numbers import Found, Number, against, cell
from studies.common.words import TextTable
from studies.drive_mode.cases import MODES, PINS, ModePlan, case_name
from studies.drive_mode.measures import ON_CYLINDERS, START, STOP, all_measures

SAVED = (START, STOP, "std_pin_force", "rms_pin_force", "largest_angular_acceleration")
IMPULSE = "an impulse"
VELOCITY = "rms_angular_velocity"
CONVERGED = 0.01  # error of a number that has a limit, as a share of it


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


def naive_said(peaks: Mapping[float, float]) -> str:
    """Peaks of the stock recipe [deg/s^2] by its steps [s], in words."""
    values = ", ".join(f"{peak:.0f}" for peak in peaks.values())
    steps = ", ".join(f"{1e3 * step:g}" for step in peaks)
    return f"{values} deg/s² at {steps} ms"


def velocity_converges(found: Found) -> bool:
    """Whether the paper's Fig. 13 b, for mode 1 on rigid columns, has a limit: its errors are small."""
    numbers = [found[VELOCITY, case_name("mode 1", pin, "rigid")] for pin in PINS]
    return all(one.numerical_error <= CONVERGED * one.value for one in numbers)
