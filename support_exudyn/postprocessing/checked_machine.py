"""What is known of a machine before a run: the report of its check, and how its clearance pins are loaded."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from support_exudyn.files.scenarios.scenario_file import read_machine_in, read_scenario, simple_scenario
from support_exudyn.files.toml.text import load_toml
from support_exudyn.machines.check import CheckReport, CheckTable, check_machine
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.postprocessing import joint_tables
from support_exudyn.scenario.pin_pressure import PressedPin, statically_pressed
from support_exudyn.scenario.pin_stability import NOT_TOLD, PinOutlook, pin_outlooks
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.simulate import look_at_laws
from user_forces.values.value import InputError

# assumed of a machine alone: the clearance and the friction of its pins, and the time for its stroke [s]
CLEARANCE_MM, FRICTION, RISE_TIME = 1.0, 0.25, 2.0


@dataclass(frozen=True)
class CheckedMachine:
    """A machine that is checked.

    report: of the machine. notes: what was assumed, or why the pins are not checked. contacts: a line for each
    kind of contact. outlooks, pressed: of the pins, under static load.
    """

    report: CheckReport
    notes: list[str]
    contacts: list[str]
    outlooks: list[PinOutlook]
    pressed: list[PressedPin]

    @classmethod
    def of(cls, file: str, stroke: float | None = None) -> CheckedMachine:
        """Check the machine of a file.

        Arguments:
            file: a machine's data file, a scenario's file, or the name of a machine of the package.
            stroke: by how much the actuators extend from the start on [m]; None: as the file has it.

        Raises InputError if the file cannot be used, or the stroke is too long.
        """
        data = read_machine_in(file)
        try:
            report = check_machine(data, stroke)
        except InputError as error:
            where = "stroke_mm" if stroke is None else f"--stroke-mm {1e3 * stroke:g}"
            raise InputError(f"{file}: {where}: {error}") from None
        scenario, notes = _scenario(Path(file), data, report)
        if scenario is None:
            return cls(report, notes, [], [], [])
        look_at_laws(scenario)
        outlooks, pressed = pin_outlooks(scenario), statically_pressed(scenario)
        if scenario.clearance_pins and not outlooks:
            notes.append(f"friction-induced vibration of its pins: {NOT_TOLD}")
        report = replace(report, warnings=[*report.warnings, *(pin.warning for pin in pressed if pin.warning)])
        return cls(report, notes, joint_tables.contact_lines(scenario), outlooks, pressed)

    def lines(self) -> list[str]:
        """All of it as lines of text."""
        lines = [*self.report.lines()]
        pressed = joint_tables.pressure_table(joint_tables.STATIC, self.pressed)
        for table in (pressed, joint_tables.stability_table(self.outlooks)):
            if table.rows:
                heads = [name.lstrip(">") for name in table.header]
                lines += ["", *CheckTable(table.title, heads, table.rows).lines()]
        return [*lines, *(f"  {line}" for line in (*self.notes, *self.contacts))]

    def data(self) -> dict[str, Any]:
        """All of it as plain data in SI."""
        return self.report.data() | {
            "pins_under_static_load": joint_tables.pressure_data(self.pressed),
            "pin_stability": joint_tables.stability_data(self.outlooks),
            "contacts": self.contacts,
        }


def _scenario(path: Path, data: MachineData, report: CheckReport) -> tuple[Scenario | None, list[str]]:
    """The scenario whose pins are checked, and what was assumed for it or why there is none.

    Of a scenario's file the scenario with its pins, laws and drives; of a machine's file a scenario with
    assumed clearance and friction.
    """
    if path.suffix.lower() == ".toml" and path.is_file() and "machine" in load_toml(path):
        try:
            scenario = read_scenario(path)
            return scenario, [f"a run is recorded every {1e3 * scenario.recorded_every:g} ms"]
        except InputError as error:  # its machine is all that had to be right so far
            return None, [f"its pins are not checked, the scenario has errors: {str(error).splitlines()[0]}"]
    stroke = report.numbers.get("stroke_m")
    if stroke is None or not data.bore_radii:
        return None, []
    drive = {"mode": 1, "start_s": 0.0, "end_s": RISE_TIME, "stroke_mm": 1e3 * stroke}
    pins = {name: {"clearance_mm": CLEARANCE_MM, "friction": FRICTION} for name in data.bore_radii}
    try:
        scenario = simple_scenario(data, duration_s=RISE_TIME, drive=drive, pins=pins)
    except InputError as error:  # all its drives together do not go so far
        return None, [f"its pins are not checked: {str(error).splitlines()[0]}"]
    return scenario, [f"assumed of every pin: {CLEARANCE_MM:g} mm of clearance, a friction of {FRICTION:g}"]
