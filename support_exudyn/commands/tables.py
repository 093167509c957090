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
from support_exudyn.postprocessing import leg_table, pin_contact, pin_shaking
from support_exudyn.postprocessing import summary as summary
from support_exudyn.postprocessing.figures import selection
from support_exudyn.postprocessing.shown_numbers import ranking
from support_exudyn.scenario.pin_pressure import PressedPin
from support_exudyn.scenario.pin_stability import PinOutlook
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


def show_touches(console: Console, result: Result) -> None:
    """The table of the first impacts of a run, if it has clearance pins."""
    if rows := summary.impacts(result):
        more = any(len(onsets) > summary.IMPACTS for onsets in result.onsets.values())
        show_impacts(console, "first impacts" + (" (all: show RUN --impacts)" if more else ""), rows)


def show_impacts(console: Console, title: str, rows: Sequence[summary.Row]) -> None:
    """A table of impacts."""
    header = IMPACTS
    if _unbroken(header, rows) > console.width:  # of records, and so the first that can be missed
        header, rows = header[:-1], [row[:-1] for row in rows]
    told = "speeds of approach and separation"
    if len(header) == len(IMPACTS):
        told += ", largest force at the records"
    show_table(console, f"{title}, {told}", header, rows)


def show_pressed(console: Console, title: str, pins: Sequence[PressedPin]) -> None:
    """The table of how hard clearance pins are pressed, and what yields; nothing without such pins."""
    if not pins:
        return
    header, rows = pin_contact.HEADER, pin_contact.rows(pins)
    while len(header) > FEWEST and _unbroken(header, rows) > console.width:  # from the last on
        header, rows = header[:-1], [row[:-1] for row in rows]
    show_table(console, title, header, rows)
    for warning in pin_contact.warnings(pins):
        console.print(f"warning: {warning}", markup=False, soft_wrap=True, end="\n\n")


def show_shaking(console: Console, outlooks: Sequence[PinOutlook]) -> None:
    """The table of which loaded pins shake as they slide; nothing where nothing is told of them."""
    if outlooks:
        show_table(console, pin_shaking.TITLE, pin_shaking.HEADER, pin_shaking.rows(outlooks))


def facts(result: Result, after: float, until: float) -> dict[str, Any]:
    """Accuracy, cost and numbers of a run between two times [s], for scripts, in SI."""
    return {
        "accuracy": {"asked": result.goal, "met": result.met if result.goal is not None else None},
        "counts": asdict(result.counts),
        "wall_time_s": result.wall_time,
        "warnings": list(result.warnings),
        "numbers": {name: found._asdict() for name, found in summary.numbers(result, after, until).items()},
    }


def show_legs(console: Console, result: Result, after: float, until: float) -> None:
    """What hydraulic legs with elements have done, if there are some; between two times [s]."""
    rows = leg_table.leg_rows(result, after, until)
    if rows:
        show_table(console, "hydraulic legs", leg_table.LEGS, rows)
