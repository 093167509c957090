"""Commands about machines before a run: `check` draws and checks a machine, `stand` computes its strength."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter
from cyclopts.validators import Number

from support_exudyn.commands.command_line import Json, put
from support_exudyn.commands.runs import FIGURES, save_figures
from support_exudyn.files.machines import SHIPPED
from support_exudyn.files.scenarios.scenario_file import read_machine_in, read_scenario
from support_exudyn.files.scenarios.simple_scenario import simple_scenario
from support_exudyn.files.toml.text import load_toml
from support_exudyn.machines.machine_data import MachineData
from user_forces.values.value import InputError

if TYPE_CHECKING:
    from support_exudyn.machines.check import CheckReport
    from support_exudyn.scenario.pin_pressure import PressedPin
    from support_exudyn.scenario.pin_stability import PinOutlook
    from support_exudyn.scenario.scenario import Scenario

FARTHEST = 1e5  # [mm]
# assumed of a machine alone: the clearance and the friction of its pins, and the time for its stroke [s]
CLEARANCE_MM, FRICTION, RISE_TIME = 1.0, 0.25, 2.0
A_MACHINE = (
    "A machine's data file, a path that ends in .toml; or a scenario's file; or a machine that comes with the "
    f"package: {', '.join(SHIPPED)}."
)
MachineFile = Annotated[str, Parameter(help=A_MACHINE)]


def check(
    machine: MachineFile,
    /,
    *,
    out: Annotated[Path | None, FIGURES] = None,
    stroke_mm: Annotated[float | None, Parameter(validator=Number(gte=-FARTHEST, lte=FARTHEST))] = None,
    json: Json = False,
) -> None:
    """Print what is known of a machine, and draw it.

    Args:
        out: Folder of the figure (next to the file, or here), or its file (.png, .pdf, .svg).
        stroke_mm: By how much the actuators extend from the start on [mm] (what the file says).
    """
    from support_exudyn.machines.check import CheckTable, check_machine  # and numpy's linear algebra
    from support_exudyn.postprocessing import joint_tables
    from support_exudyn.postprocessing.figures import style
    from support_exudyn.postprocessing.figures.linkage_check import check_figure
    from support_exudyn.scenario.pin_pressure import statically_pressed
    from support_exudyn.scenario.pin_stability import NOT_TOLD, pin_outlooks
    from support_exudyn.simulation.simulate import look_at_laws

    data = read_machine_in(machine)
    try:
        report = check_machine(data, None if stroke_mm is None else stroke_mm / 1e3)
    except InputError as error:  # of a stroke that is too long
        where = "stroke_mm" if stroke_mm is None else f"--stroke-mm {stroke_mm:g}"
        raise InputError(f"{machine}: {where}: {error}") from None
    folder = Path(machine).parent if Path(machine).suffix.lower() == ".toml" else Path()
    with style.look():
        drawn = save_figures({f"{_stem(machine)}_check": check_figure(report)}, out, folder)
    written = [path for paths in drawn.values() for path in paths]
    scenario, notes = _checked_scenario(machine, data, report)
    outlooks: list[PinOutlook] = []
    pressed: list[PressedPin] = []
    contacts: list[str] = []
    if scenario:
        look_at_laws(scenario)
        outlooks, pressed = pin_outlooks(scenario), statically_pressed(scenario)
        contacts = joint_tables.contact_lines(scenario)
        if scenario.clearance_pins and not outlooks:
            notes.append(f"whether its pins shake: {NOT_TOLD}")
    report = replace(report, warnings=[*report.warnings, *(one.warning for one in pressed if one.warning)])
    lines = [*report.lines()]
    tables = joint_tables.pressure_table(joint_tables.STATIC, pressed), joint_tables.stability_table(outlooks)
    for table in tables:
        if table.rows:
            heads = [name.lstrip(">") for name in table.header]
            lines += ["", *CheckTable(table.title, heads, table.rows).lines()]
    more = {
        "pins_under_static_load": joint_tables.pressure_data(pressed),
        "pin_stability": joint_tables.stability_data(outlooks),
        "contacts": contacts,
        "figures": written,
    }
    put(json, report.data() | more, *lines, *(f"  {note}" for note in (*notes, *contacts)), "", *written)


def _stem(machine: str) -> str:
    """The name of a machine's figures."""
    path = Path(machine)
    return path.stem if path.suffix.lower() == ".toml" else machine


def _checked_scenario(
    machine: str, data: MachineData, report: CheckReport
) -> tuple[Scenario | None, list[str]]:
    """The scenario whose pins are checked, and what was assumed for it or why there is none.

    Of a scenario's file the scenario with its pins, laws and drives; of a machine's file a scenario with
    assumed clearance and friction.
    """
    path = Path(machine)
    if path.suffix.lower() == ".toml" and path.is_file() and "machine" in load_toml(path):
        try:
            scenario = read_scenario(machine)
            return scenario, [f"a run is recorded every {1e3 * scenario.recorded_every:g} ms"]
        except InputError as error:  # its machine is all that had to be right so far
            first = str(error).splitlines()[0]
            return None, [f"its pins are not checked, the scenario has errors: {first}"]
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


def stand(
    machine: MachineFile, /, *, figure: Annotated[Path | None, FIGURES] = None, json: Json = False
) -> None:
    """Print what a support must stand, and draw it. Its file has a section [strength].

    Args:
        figure: Folder, or file (.png, .pdf, .svg), of a figure of the support force over height and canopy,
            and of the forces in pins.
    """
    from support_exudyn.machines.strength import stand as computed  # and scipy
    from support_exudyn.machines.strength.page import page
    from support_exudyn.postprocessing.figures import style
    from support_exudyn.postprocessing.figures.stand import stand_figure

    data = read_machine_in(machine)
    try:
        report = computed(data)
    except InputError as error:
        raise InputError(f"{machine}: {error}") from None
    figures: list[Path] = []
    if figure:
        name = f"{_stem(machine)}_stand"
        with style.look():
            figures = save_figures({name: stand_figure(report)}, figure, Path())[name]
    put(json, {**report.data(), "figures": figures}, *page(report), *figures)
