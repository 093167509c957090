"""What commands say of a run: tables in the terminal or in what reads standard output, and numbers for scripts.

Numbers in tables are whole, words are broken at the width of the terminal.
"""

import sys
from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any

from rich import box
from rich.cells import cell_len
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from support_exudyn.commands.command_line import silence_output
from support_exudyn.postprocessing import summary as summary
from support_exudyn.postprocessing.figures import selection
from support_exudyn.postprocessing.joint_tables import ResultTable
from support_exudyn.postprocessing.shown_numbers import ranking
from support_exudyn.simulation.result import Result
from user_forces.values.value import cleaned

NARROWEST = 25  # characters that words are worth showing in
IMPACTS: tuple[str, ...] = ("pin", "impact", ">time", ">lasts", ">approach", ">parting", ">force")
WORDS = ("words", "meaning", "remark")  # heads of columns whose cells may be broken
FEWEST = 3  # columns: pin, force, pressure
PIPED = 150  # characters of a line where there is no terminal


def printed(tables: Callable[[Console], None]) -> None:
    """Print tables; as many of them as are read, if another program takes them."""
    if sys.stdout is None:  # it was closed before the program began
        return
    try:
        tables(Console(width=None if sys.stdout.isatty() else PIPED, highlight=False))
        sys.stdout.flush()
    except BrokenPipeError:  # `show RUN | head`
        silence_output()


def _unbroken(header: Sequence[str], rows: Sequence[Sequence[str]]) -> int:
    """Width of a table's names and numbers, with the least that words take; the terminal may be narrower."""
    names = header or ("", "words")
    wide = [
        NARROWEST if name in WORDS else max(cell_len(text) for text in (name, *(row[n] for row in rows)))
        for n, name in enumerate(names)
    ]
    return sum(wide) + 3 * len(wide) + 2  # with what stands between and beside them


def show_table(console: Console, title: str, header: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """A table; columns whose header begins with > are of numbers. Without a header: names and words.

    Names and numbers are never cut or broken, even if the terminal is too narrow for them; words are broken, at
    its width.
    """
    table = Table(
        box=box.SIMPLE_HEAD if header else None, show_header=bool(header), pad_edge=False, padding=(0, 1)
    )
    for name in header or ("", "words"):
        table.add_column(
            escape(name.lstrip(">")) if header else "",
            justify="right" if name.startswith(">") else "left",
            no_wrap=name not in WORDS,
            overflow="fold",
        )
    for row in rows:
        table.add_row(*(escape(cleaned(cell)) for cell in row))
    with console.capture() as shown:
        console.print(cleaned(title), style="bold", markup=False)
    broad = Console(width=max(console.width, _unbroken(header, rows)), highlight=False)
    with broad.capture() as told:
        broad.print(table)
    lines = (shown.get() + told.get()).splitlines()
    print("\n".join(line.rstrip() for line in lines), end="\n\n")


def show_numbers(
    console: Console,
    title: str,
    unknown: str,
    result: Result,
    after: float,
    until: float,
    only: Sequence[str] = (),
) -> None:
    """The numbers of a run between two times [s], and which pin is hit hardest.

    unknown: why they may have no errors. only: names of those that are shown; without, all and the pins.
    """
    known = "± estimated numerical error" if result.coarser else f"numerical errors not known: {unknown}"
    found = summary.printed(result, after, until, only)
    rows = summary.rows_of(found)
    header: tuple[str, ...] = ("number", ">value", ">±", "unit")
    if not any(row[2] for row in rows):  # nothing to show there
        header, rows = (*header[:2], header[3]), [(*row[:2], row[3]) for row in rows]
    window = f"{selection.said(result, after, until)}"
    show_table(console, f"{title}, {window} ({known})", header, rows)
    if not only and (order := ranking(found)):
        console.print(order, markup=False, soft_wrap=True, end="\n\n")


def show_impacts(
    console: Console, title: str, result: Result, most: int | None, after: float, until: float
) -> None:
    """The table of impacts between two times [s], so many of each joint; nothing without clearance joints."""
    words = f"{title}, speeds of approach and separation, largest force at the records"
    show_fitting(console, ResultTable(words, IMPACTS, summary.impacts(result, most, after, until)))


def first_impacts(console: Console, result: Result) -> None:
    """The table of the first impacts of each clearance joint of a run."""
    more = any(len(onsets) > summary.IMPACTS for onsets in result.onsets.values())
    title = "first impacts" + (" (all: show RUN --impacts)" if more else "")
    show_impacts(console, title, result, summary.IMPACTS, 0.0, float("inf"))


def show_fitting(console: Console, table: ResultTable) -> None:
    """A table if it has rows; of a narrow terminal without its last columns, as many as do not fit."""
    title, header, rows = table
    while len(header) > FEWEST and _unbroken(header, rows) > console.width:
        header, rows = header[:-1], [row[:-1] for row in rows]
    if rows:
        show_table(console, title, header, rows)


def facts(result: Result, after: float, until: float) -> dict[str, Any]:
    """Accuracy, cost and numbers of a run between two times [s], for scripts, in SI."""
    return {
        "accuracy": {"asked": result.goal, "met": result.met if result.goal is not None else None},
        "counts": asdict(result.counts),
        "wall_time_s": result.wall_time,
        "warnings": list(result.warnings),
        "numbers": {name: found._asdict() for name, found in summary.numbers(result, after, until).items()},
    }
