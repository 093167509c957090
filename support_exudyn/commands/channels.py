"""`channels FILE [CHANNEL...]`: what a run of it can record, before it is run."""

import argparse

from support_exudyn.commands.command_line import add_json, answer
from support_exudyn.commands.tables import printed, show_table
from support_exudyn.postprocessing.known_channels import ALLOWED, HEADER, channels


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The file, and which channels."""
    parser.add_argument("file", metavar="FILE", help=ALLOWED)
    parser.add_argument(
        "channels",
        nargs="*",
        default=[],
        metavar="CHANNEL",
        help="only these: names or patterns, such as 'pin.*.force'",
    )
    add_json(parser)


def run(given: argparse.Namespace) -> None:
    """Print the table, or the object."""
    found = channels(given.file, *given.channels)
    if given.json:
        answer({name: one._asdict() for name, one in found.items()})
        return
    title = f"{given.file}: {len(found)} channels"
    printed(lambda console: show_table(console, title, HEADER, found.rows()))
