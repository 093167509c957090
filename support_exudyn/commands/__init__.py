"""The commands of `python -m support_exudyn`, one per file.

A command is a module with HELP, a line of what it does; `add_arguments(parser)`; and `run(given)`, which does
it with the arguments that were given and raises InputError, OSError or SimulationError. Its name is the
module's. A further one is a file here and its name in NAMES.
"""

from __future__ import annotations

import argparse
from importlib import import_module
from typing import Protocol, cast

from support_exudyn.command_line import Parser

NAMES: tuple[str, ...] = ("check", "show", "plot", "render", "view", "export")


class Command(Protocol):
    """What a module of a command offers."""

    HELP: str

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Tell the parser what the command takes."""

    def run(self, given: argparse.Namespace) -> None:
        """Do it."""


def command(name: str) -> Command:
    """The command of this name."""
    return cast(Command, import_module(f"{__name__}.{name}"))


def parser() -> Parser:
    """Of the whole command line."""
    whole = Parser(
        prog="python -m support_exudyn",
        description="Look at runs: files that Result.save has written.",
    )
    several = whole.add_subparsers(dest="command", required=True, metavar="COMMAND", parser_class=Parser)
    for name in NAMES:
        one = command(name)
        one.add_arguments(several.add_parser(name, help=one.HELP, description=one.HELP))
    return whole
