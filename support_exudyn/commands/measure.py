"""`measure RUN [INSTRUMENTS]`: what instruments on the machine read of a run, as a table."""

import argparse

from support_exudyn.commands.command_line import add_json, add_out, add_run, answer, folder, say, warn
from support_exudyn.simulation.result import Result


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run's file, that of the instruments, and where to."""
    add_run(parser)
    parser.add_argument(
        "instruments",
        nargs="?",
        type=folder,
        metavar="INSTRUMENTS",
        help="TOML file of the instruments; without it perfect ones, 10 times a second: pressure and extension "
        "of all columns, tilt of all bodies and of the base",
    )
    add_out(parser, "the table, CSV; by default RUN_measured.csv beside the run", "FILE")
    add_json(parser)


def run(given: argparse.Namespace) -> None:
    """Write the table, and print what is in it."""
    from support_exudyn.postprocessing.instruments.station import (
        measure,
        read_station,
        usual_station,
        write_measured,
    )

    result = Result.load(given.run)
    if given.instruments is None:
        station, refused = usual_station(result.scenario)
    else:
        station, refused = read_station(given.instruments), {}
    measured = measure(result, station)
    out = given.out or given.run.with_name(f"{given.run.stem}_measured.csv")
    write_measured(measured, out)
    for name, reason in refused.items():
        warn(f"{name}: left out: {reason}")
    if given.json:
        sizes = {name: one.time.size for name, one in measured.items()}
        answer(
            {"written": out, "samples": sizes, "left_out": {name: str(one) for name, one in refused.items()}}
        )
        return
    say(f"{out}: {len(measured)} instruments, {max(one.time.size for one in measured.values())} samples")
