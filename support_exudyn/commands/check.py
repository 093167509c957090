"""`check FILE`: what can be said of a machine before it is run."""

import argparse
import json
from functools import partial
from pathlib import Path

from support_exudyn.commands.command_line import add_out, number, say
from support_exudyn.files.scenarios.scenario_file import read_machine_in
from user_forces.values.value import InputError

HELP = "draw a machine and tell its mobility, closure, dead centres, static forces, and what looks wrong"
FARTHEST = 1e5  # [mm]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The machine's file, and what of it is looked at."""
    add = parser.add_argument
    add(
        "machine",
        metavar="FILE",
        help="machine data file, a path that ends in .toml; or a scenario's file, also of a machine of one's "
        "own; or a machine that comes with the package: reference, zf18000, two_leg_shield, slider_crank",
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
    from support_exudyn.postprocessing.figures import style
    from support_exudyn.postprocessing.figures.checks import check_figure

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
    if given.json:
        say(json.dumps(report.data() | {"figures": [str(one) for one in written]}, indent=2))
        return
    for line in report.lines():
        say(line)
    say("")
    for one in written:
        say(str(one))
