"""`stand MACHINE`: what a support must stand, on one page."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from support_exudyn.commands.command_line import add_json, answer, folder, say
from support_exudyn.files.machines import SHIPPED
from support_exudyn.files.scenarios.scenario_file import read_machine_in
from user_forces.values.value import InputError

if TYPE_CHECKING:
    from support_exudyn.machines.strength import StandReport


def add_arguments(parser: argparse.ArgumentParser) -> None:
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


def run(given: argparse.Namespace) -> None:
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
