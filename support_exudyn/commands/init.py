"""`init KIND`: a commented set of files to start from, which run as they are."""

import argparse
from pathlib import Path

from support_exudyn.commands.command_line import add_out, say
from support_exudyn.files.starters import KINDS, write_starter


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which set, and where it goes."""
    parser.add_argument(
        "kind",
        nargs="?",
        choices=tuple(KINDS),
        default="four_column_support",
        metavar="KIND",
        help="; ".join(f"{kind}: {what}" for kind, (what, _) in KINDS.items()),
    )
    add_out(parser, "write the files there (a folder named KIND)")


def run(given: argparse.Namespace) -> None:
    """Write them, and say what they are."""
    for path in write_starter(given.kind, given.out or Path(given.kind)):
        say(str(path))
