"""`check FILE`: what can be said of a machine before it is run."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from support_exudyn.commands.command_line import add_out, number, say
from support_exudyn.files.machines import SHIPPED
from support_exudyn.files.scenarios.scenario_file import read_machine_in, read_scenario
from support_exudyn.files.scenarios.simple_scenario import simple_scenario
from support_exudyn.files.toml.text import load_toml
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.postprocessing import pin_contact, pin_shaking
from user_forces.values.value import InputError

if TYPE_CHECKING:
    from support_exudyn.machines.check import CheckReport, CheckTable
    from support_exudyn.scenario.pin_pressure import PressedPin
    from support_exudyn.scenario.pin_stability import PinOutlook
    from support_exudyn.scenario.scenario import Scenario

FARTHEST = 1e5  # [mm]
# assumed of a machine alone: the clearance and the friction of its pins, and the time for its stroke [s]
PLAY_MM, FRICTION, RISE_TIME = 1.0, 0.25, 2.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
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


def run(given: argparse.Namespace) -> None:
    """Print what was found, and write the figure."""
    from support_exudyn.machines.check import check_machine  # and numpy's linear algebra
    from support_exudyn.postprocessing.contact_description import contact_lines
    from support_exudyn.postprocessing.figures import style
    from support_exudyn.postprocessing.figures.linkage_check import check_figure
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
    report = replace(report, warnings=[*report.warnings, *pin_contact.warnings(pressed)])
    if given.json:
        more = {
            "pins_under_static_load": pin_contact.data(pressed),
            "pin_stability": pin_shaking.data(outlooks),
            "contacts": contacts,
            "figures": [str(one) for one in written],
        }
        say(json.dumps(report.data() | more, indent=2))
        return
    for line in report.lines():
        say(line)
    for table in _tables(pressed, outlooks):
        say("")
        for line in table.lines():
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


def _tables(pressed: Sequence[PressedPin], outlooks: Sequence[PinOutlook]) -> Iterator[CheckTable]:
    """How hard clearance pins are pressed, and whether they shake; what there is nothing of is left out."""
    from support_exudyn.machines.check import CheckTable

    for title, header, rows in (
        (pin_contact.STATIC, pin_contact.HEADER, pin_contact.rows(pressed)),
        (pin_shaking.TITLE, pin_shaking.HEADER, pin_shaking.rows(outlooks)),
    ):
        if rows:
            yield CheckTable(title, [name.lstrip(">") for name in header], rows)


def _is_scenario(name: str) -> bool:
    """Whether a file is that of a scenario, which names its machine."""
    path = Path(name)
    return path.suffix.lower() == ".toml" and path.is_file() and "machine" in load_toml(path)
