"""`show RUN [CHANNEL...]`: what a run was and what came out, as tables in the terminal."""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections.abc import Sequence

from rich import box
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from support_exudyn import account
from support_exudyn.command_line import folder
from support_exudyn.commands.plot import seconds
from support_exudyn.figures.names import matching
from support_exudyn.result import Result

HELP = "tables of what a run was and what came out of it"
NARROWEST = 25  # characters that meanings are worth showing in
PIPED = 150  # characters of a line where there is no terminal


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run's file, and which channels."""
    parser.add_argument("run", type=folder, metavar="RUN", help="file of a run, as Result.save writes it")
    parser.add_argument(
        "channels", nargs="*", metavar="CHANNEL", help="only these: names or patterns, such as 'pin.*.force'"
    )
    parser.add_argument("--all", action="store_true", help="all channels, not only those looked at first")
    parser.add_argument(
        "--from", dest="start", type=seconds, default=0.0, metavar="T", help="numbers from this time on [s]"
    )  # fmt: skip
    parser.add_argument(
        "--until", type=seconds, default=math.inf, metavar="T", help="numbers up to this time [s]"
    )


def run(given: argparse.Namespace) -> None:
    """Print the tables; as many of them as are read, if another program takes them."""
    result = Result.load(given.run)
    try:
        _tables(result, given)
        sys.stdout.flush()
    except BrokenPipeError:  # `show RUN | head`: at its end Python would try once more, and complain
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _tables(result: Result, given: argparse.Namespace) -> None:
    names = matching(result.channels, given.channels)
    console = Console(width=None if sys.stdout.isatty() else PIPED, highlight=False)
    if names:
        _show_channels(console, result, names, "channels")
        return
    _show(console, "what was run", (), account.what_was_run(result))
    _show(console, "how", (), account.how(result))
    numbers = account.came_out(result, given.start, given.until)
    known = (
        "± estimated numerical error" if result.coarser else "numerical errors not known: no accuracy was asked"
    )
    _show(console, f"what came out ({known})", ("number", ">value", ">±", "unit"), numbers)
    if rows := account.touches(result):
        header = ("pin", "touch", ">time", ">lasts", ">approach", ">parting")
        _show(console, "touches, and speeds of approach and parting", header, rows)
    telling = [name for name in result.channels if name != "time"] if given.all else account.telling(result)
    rest = len(result.channels) - 1 - len(telling)
    _show_channels(console, result, telling, f"channels ({rest} more: --all)" if rest else "channels")


def _show_channels(console: Console, result: Result, names: Sequence[str], title: str) -> None:
    header: tuple[str, ...] = ("channel", "unit", ">least", ">mean", ">largest", "meaning")
    rows = account.of_channels(result, names)
    taken = sum(max(len(row[n]) for row in rows) + 3 for n in range(len(header) - 1))
    if console.width - taken < NARROWEST:  # the numbers first
        header, rows = header[:-1], [row[:-1] for row in rows]
    _show(console, title, header, rows)


def _show(console: Console, title: str, header: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """A table; columns whose header begins with > are of numbers. Without a header: names and words.

    Names and numbers are never cut or broken; words are broken, at the width of the terminal.
    """
    table = Table(
        box=box.SIMPLE_HEAD if header else None, show_header=bool(header), pad_edge=False, padding=(0, 1)
    )
    for name in header or ("", "words"):
        table.add_column(
            name.lstrip(">") if header else "",
            justify="right" if name.startswith(">") else "left",
            no_wrap=name not in ("words", "meaning"),
            overflow="fold",
        )
    for row in rows:
        table.add_row(*(escape(cell) for cell in row))
    with console.capture() as shown:
        console.print(title, style="bold", markup=False)
        console.print(table)
    print("\n".join(line.rstrip() for line in shown.get().splitlines()), end="\n\n")
