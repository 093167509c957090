"""`view RUN`: the run in Exudyn's solution viewer, in a window."""

import argparse

from support_exudyn.commands.command_line import add_run, count, folder
from support_exudyn.simulation.result import Result


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run's file, and what of it is shown."""
    add = parser.add_argument
    add_run(parser)
    add(
        "--solution",
        type=folder,
        metavar="FILE",
        help="show this solution file of Exudyn, of the same run, in place of its records",
    )
    add(
        "--every",
        type=count,
        metavar="N",
        help="records from frame to frame, up to 200; by default the run takes about 10 s",
    )


def run(given: argparse.Namespace) -> None:
    """Open it, and wait until it is closed."""
    result = Result.load(given.run)
    from support_exudyn.postprocessing.viewer.view import (
        open_viewer,  # libraries of shapes, which refusing a file has no use for
    )

    open_viewer(result, solution=given.solution, every=given.every, name=given.run.name)
