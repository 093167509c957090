"""`show RUN [CHANNEL...]`: what a run was and what came out, as tables in the terminal."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from rich import box
from rich.cells import cell_len
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from support_exudyn import account
from support_exudyn.command_line import add_json, add_times, answer, folder, hush
from support_exudyn.figures import windows
from support_exudyn.figures.names import matching
from support_exudyn.result import Result

HELP = "tables of what a run was and what came out of it"
NARROWEST = 25  # characters that meanings are worth showing in
WHOLE = (0.0, math.inf)  # run
PIPED = 150  # characters of a line where there is no terminal


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run's file, and which channels."""
    parser.add_argument("run", type=folder, metavar="RUN", help="file of a run, as Result.save writes it")
    parser.add_argument(
        "channels", nargs="*", metavar="CHANNEL", help="only these: names or patterns, such as 'pin.*.force'"
    )
    parser.add_argument("--all", action="store_true", help="all channels, not only those looked at first")
    add_json(parser)
    add_times(parser, *WHOLE)


def run(given: argparse.Namespace) -> None:
    """Print the tables; as many of them as are read, if another program takes them."""
    result = Result.load(given.run)
    if given.json:
        answer(_object(result, given))
        return
    if sys.stdout is None:  # it was closed before the program began
        return
    try:
        _tables(result, given)
        sys.stdout.flush()
    except BrokenPipeError:  # `show RUN | head`
        hush()


def _object(result: Result, given: argparse.Namespace) -> dict[str, Any]:
    """The same for scripts, in SI: every number with its error, and all channels unless some are asked for."""
    ends = given.start, given.end
    names = matching(result.channels, given.channels) or [name for name in result.channels if name != "time"]
    return {
        "run": given.run,
        "scenario": result.scenario.to_data(),
        "accuracy": {"asked": result.goal, "met": result.met if result.goal is not None else None},
        "counts": asdict(result.counts),
        "wall_time_s": result.wall_time,
        "provenance": dict(result.provenance),
        "numbers": {name: found._asdict() for name, found in account.numbers(result, *ends).items()},
        "touches": {
            pin: [
                {"time_s": o.time, "speed_m_per_s": o.speed, "parting_time_s": o.parting_time} for o in onsets
            ]
            for pin, onsets in result.onsets.items()
        },
        "channels": {name: account.extent(result, name, *ends) for name in names},
    }


def _tables(result: Result, given: argparse.Namespace) -> None:
    names = matching(result.channels, given.channels)
    ends = given.start, given.end
    piece = "" if ends == WHOLE else f", {windows.said(result, *ends)}"
    console = Console(width=None if sys.stdout.isatty() else PIPED, highlight=False)
    if names:
        _show_channels(console, account.of_channels(result, names, *ends), f"channels{piece}")
        return
    numbers = account.came_out(result, *ends)
    _show(console, "what was run", (), account.what_was_run(result))
    _show(console, "how", (), account.how(result))
    known = (
        "± estimated numerical error" if result.coarser else "numerical errors not known: no accuracy was asked"
    )
    _show(console, f"what came out{piece} ({known})", ("number", ">value", ">±", "unit"), numbers)
    if rows := account.touches(result):
        header = ("pin", "touch", ">time", ">lasts", ">approach", ">parting")
        _show(console, "touches, and speeds of approach and parting", header, rows)
    telling = [name for name in result.channels if name != "time"] if given.all else account.telling(result)
    rest = len(result.channels) - 1 - len(telling)
    more = f" ({rest} more: --all)" if rest else ""
    _show_channels(console, account.of_channels(result, telling, *ends), f"channels{piece}{more}")


def _show_channels(console: Console, rows: list[account.Row], title: str) -> None:
    if not rows:  # nothing was recorded but the time
        return
    header: tuple[str, ...] = ("channel", "unit", ">least", ">mean", ">largest", "meaning")
    taken = sum(max(len(row[n]) for row in rows) + 3 for n in range(len(header) - 1))
    if console.width - taken < NARROWEST:  # the numbers first
        header, rows = header[:-1], [row[:-1] for row in rows]
    _show(console, title, header, rows)


def _unbroken(header: Sequence[str], rows: Sequence[Sequence[str]]) -> int:
    """Width of a table's names and numbers, with the least that words take; the terminal may be narrower."""
    names = header or ("", "words")
    wide = [
        NARROWEST
        if name in ("words", "meaning")
        else max(cell_len(text) for text in (name, *(row[n] for row in rows)))
        for n, name in enumerate(names)
    ]
    return sum(wide) + 3 * len(wide) + 2  # with what stands between and beside them


def _show(console: Console, title: str, header: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """A table; columns whose header begins with > are of numbers. Without a header: names and words.

    Names and numbers are never cut or broken, even if the terminal is too narrow for them; words are broken, at
    its width.
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
    broad = Console(width=max(console.width, _unbroken(header, rows)), highlight=False)
    with broad.capture() as told:
        broad.print(table)
    lines = (shown.get() + told.get()).splitlines()
    print("\n".join(line.rstrip() for line in lines), end="\n\n")
