"""`show RUN`: what a run was and what came out, as a table in the terminal."""

from __future__ import annotations

import argparse

from rich.console import Console
from rich.table import Table

from support_exudyn.command_line import folder
from support_exudyn.result import Result

HELP = "a table of what a run was and what came out of it"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run's file."""
    parser.add_argument("run", type=folder, metavar="RUN", help="file of a run, as Result.save writes it")


def run(given: argparse.Namespace) -> None:
    """Print the table."""
    result = Result.load(given.run)
    shown = Table("channel", "unit", "least", "mean", "largest")
    for name, channel in result.channels.items():
        values = channel.values
        shown.add_row(name, channel.unit, *(f"{f():.6g}" for f in (values.min, values.mean, values.max)))
    Console().print(shown)
