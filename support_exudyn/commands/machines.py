"""Commands about machines before a run: `check` draws and checks one, `stand` computes its strength."""

from __future__ import annotations

import argparse
import json
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from support_exudyn.commands.command_line import add_json, add_out, answer, folder, number, say
from support_exudyn.files.machines import SHIPPED
from support_exudyn.files.scenarios.scenario_file import read_machine_in, read_scenario
from support_exudyn.files.scenarios.simple_scenario import simple_scenario
from support_exudyn.files.toml.text import load_toml
from support_exudyn.machines.machine_data import MachineData
from user_forces.values.value import InputError

if TYPE_CHECKING:
    from support_exudyn.machines.check import CheckReport
    from support_exudyn.machines.strength import StandReport
    from support_exudyn.scenario.scenario import Scenario


# --- check ---


FARTHEST = 1e5  # [mm]
# assumed of a machine alone: the clearance and the friction of its pins, and the time for its stroke [s]
PLAY_MM, FRICTION, RISE_TIME = 1.0, 0.25, 2.0


def add_check(parser: argparse.ArgumentParser) -> None:
    """The machine's file, and what of it is looked at."""
    add = parser.add_argument
    add(
        "machine",
        metavar="FILE",
        help="machine data file, a path that ends in .toml; or a scenario's file, also of a machine of one's "
        f"own; or a machine that comes with the package: {', '.join(SHIPPED)}",
    )
    add_out(parser, "where the figure goes; by default beside the file, or here")
    add(
        "--stroke-mm",
        type=partial(number, low=-FARTHEST, high=FARTHEST),
        metavar="S",
        help="by how much the actuators extend from the start on [mm]; by default what the file says",
    )
    add("--json", action="store_true", help="one JSON object, SI units, on standard output")


def run_check(given: argparse.Namespace) -> None:
    """Print what was found, and write the figure."""
    from support_exudyn.machines.check import CheckTable, check_machine  # and numpy's linear algebra
    from support_exudyn.postprocessing.figures import style
    from support_exudyn.postprocessing.figures.linkage_check import check_figure
    from support_exudyn.postprocessing.joint_tables import (
        STATIC,
        contact_lines,
        pressure_data,
        pressure_table,
        stability_data,
        stability_table,
    )
    from support_exudyn.scenario.pin_pressure import statically_pressed
    from support_exudyn.scenario.pin_stability import NOT_TOLD, pin_outlooks
    from support_exudyn.simulation.simulate import look_at_laws

    data = read_machine_in(given.machine)
    try:
        report = check_machine(data, None if given.stroke_mm is None else given.stroke_mm / 1e3)
    except InputError as error:  # of a stroke that is too long
        where = "stroke_mm" if given.stroke_mm is None else f"--stroke-mm {given.stroke_mm:g}"
        raise InputError(f"{given.machine}: {where}: {error}") from None
    path = Path(given.machine)
    own = path.suffix.lower() == ".toml"
    out = given.out or (path.parent if own else Path())
    with style.look():
        written = style.save(check_figure(report), out, f"{path.stem if own else given.machine}_check")
    scenario, told = _looked_at(given, data, report)
    if scenario:
        look_at_laws(scenario)
    outlooks = pin_outlooks(scenario) if scenario else []
    if scenario and scenario.clearance_pins and not outlooks:
        told.append(f"whether its pins shake: {NOT_TOLD}")
    pressed = statically_pressed(scenario) if scenario else []
    contacts = contact_lines(scenario) if scenario else []
    report = replace(report, warnings=[*report.warnings, *(one.warning for one in pressed if one.warning)])
    if given.json:
        more = {
            "pins_under_static_load": pressure_data(pressed),
            "pin_stability": stability_data(outlooks),
            "contacts": contacts,
            "figures": [str(one) for one in written],
        }
        say(json.dumps(report.data() | more, indent=2))
        return
    for line in report.lines():
        say(line)
    for title, header, rows in (pressure_table(STATIC, pressed), stability_table(outlooks)):
        if rows:
            say("")
            for line in CheckTable(title, [name.lstrip(">") for name in header], rows).lines():
                say(line)
    for said in (*told, *contacts):
        say(f"  {said}")
    say("")
    for one in written:
        say(str(one))


def _looked_at(
    given: argparse.Namespace, data: MachineData, report: CheckReport
) -> tuple[Scenario | None, list[str]]:
    """The scenario whose pins are looked at, and what was assumed for it or why there is none.

    Of a scenario's file that with the pins, laws and drives that it says; of a machine's one with play assumed.
    """
    if _is_scenario(given.machine):
        try:
            scenario = read_scenario(given.machine)
            return scenario, [f"a run is recorded every {1e3 * scenario.recorded_every:g} ms"]
        except InputError as error:  # its machine is all that had to be right so far
            first = str(error).splitlines()[0]
            return None, [f"nothing is told of its pins, the scenario has errors: {first}"]
    stroke = report.numbers.get("stroke_m")
    if stroke is None or not data.bore_radii:
        return None, []
    drive = {"mode": 1, "start_s": 0.0, "end_s": RISE_TIME, "stroke_mm": 1e3 * stroke}
    pins = {name: {"clearance_mm": PLAY_MM, "friction": FRICTION} for name in data.bore_radii}
    try:
        scenario = simple_scenario(data, duration_s=RISE_TIME, drive=drive, pins=pins)
    except InputError as error:  # all its drives together do not go so far
        return None, [f"nothing is told of its pins: {str(error).splitlines()[0]}"]
    return scenario, [f"assumed of every pin: {PLAY_MM:g} mm of clearance, a friction of {FRICTION:g}"]


def _is_scenario(name: str) -> bool:
    """Whether a file is that of a scenario, which names its machine."""
    path = Path(name)
    return path.suffix.lower() == ".toml" and path.is_file() and "machine" in load_toml(path)


# --- stand ---


def add_stand(parser: argparse.ArgumentParser) -> None:
    """The machine, and where its figure goes."""
    parser.add_argument(
        "machine",
        metavar="MACHINE",
        help="machine data file with a section [strength], a path that ends in .toml; or the file of a "
        f"scenario with such a machine; or a machine that comes with the package: {', '.join(SHIPPED)}",
    )
    parser.add_argument(
        "--figure",
        type=folder,
        metavar="DIR",
        help="draw the support force over height and canopy, and the forces in pins, into this folder",
    )
    add_json(parser)


def run_stand(given: argparse.Namespace) -> None:
    """Print the page or its numbers, and draw the figure that is asked for."""
    from support_exudyn.machines.strength import stand  # and scipy
    from support_exudyn.machines.strength.page import page

    data = read_machine_in(given.machine)
    try:
        report = stand(data)
    except InputError as error:
        raise InputError(f"{given.machine}: {error}") from None
    figures = _drawn(given, report) if given.figure else []
    if given.json:
        answer({**report.data(), "figures": [str(one) for one in figures]})
        return
    for line in page(report):
        say(line)
    for one in figures:
        say(str(one))


def _drawn(given: argparse.Namespace, report: StandReport) -> list[Path]:
    """The files of the figure, named after the machine."""
    from support_exudyn.postprocessing.figures import style
    from support_exudyn.postprocessing.figures.stand import stand_figure

    path = Path(given.machine)
    name = path.stem if path.suffix.lower() == ".toml" else given.machine
    with style.look():
        return style.save(stand_figure(report), given.figure, f"{name}_stand")
