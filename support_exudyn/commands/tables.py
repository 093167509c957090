"""Tables of a run for the terminal or for what reads standard output, and its numbers for scripts."""

import io
import math
from collections.abc import Sequence
from dataclasses import asdict
from shutil import get_terminal_size
from typing import Any

from rich import box
from rich.cells import cell_len
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from support_exudyn.commands.command_line import say
from support_exudyn.postprocessing import summary as summary
from support_exudyn.postprocessing.figures import selection
from support_exudyn.postprocessing.shown_numbers import LARGEST, hardest_first, ranking, stem
from support_exudyn.simulation.result import Result
from user_forces.values.value import cleaned

WHOLE = (0.0, math.inf)  # run
WORDS = ("words", "meaning", "remark")  # heads of columns whose cells may be broken
NARROWEST = 25  # characters of such a column
PIPED = 150  # characters of a line where there is no terminal
IMPACTS: tuple[str, ...] = ("pin", "impact", ">time", ">lasts", ">approach", ">parting", ">force")


def show_table(title: str, header: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print a table if it has rows; heads of columns of numbers begin with >. Without heads: names and words.

    Names and numbers are never cut or broken, even if the terminal is too narrow for them. Words are broken at
    its width; a last column of words is left out where there is no room for it.
    """
    if not rows:
        return
    heads = header or ("", "words")
    widths = [
        NARROWEST if head in WORDS else max(cell_len(text) for text in (head, *(row[n] for row in rows)))
        for n, head in enumerate(heads)
    ]
    room = get_terminal_size((PIPED, 24)).columns
    needed = sum(widths) + 3 * len(widths) + 2  # with what stands between them
    if header and heads[-1] in WORDS and needed > room:
        show_table(title, header[:-1], [row[:-1] for row in rows])
        return
    table = Table(
        box=box.SIMPLE_HEAD if header else None, show_header=bool(header), pad_edge=False, padding=(0, 1)
    )
    for head in heads:
        table.add_column(
            escape(head.lstrip(">")) if header else "",
            justify="right" if head.startswith(">") else "left",
            no_wrap=head not in WORDS,
            overflow="fold",
        )
    for row in rows:
        table.add_row(*(escape(cleaned(cell)) for cell in row))
    console = Console(file=io.StringIO(), width=max(room, needed))
    with console.capture() as shown:
        console.print(table)
    say("\n".join([title, *(line.rstrip() for line in shown.get().splitlines()), ""]))


def show_numbers(
    title: str, unknown: str, result: Result, ends: tuple[float, float], only: Sequence[str] = ()
) -> None:
    """Print the numbers of a run between two times [s], and which pin is hit hardest.

    unknown: why they may have no errors. only: names of those that are shown; without, all and the pins.
    """
    known = "± estimated numerical error" if result.coarser else f"numerical errors not known: {unknown}"
    found = summary.printed(result, *ends, only)
    rows = summary.rows_of(found)
    header: tuple[str, ...] = ("number", ">value", ">±", "unit")
    if not any(row[2] for row in rows):  # nothing to show there
        header, rows = (*header[:2], header[3]), [(*row[:2], row[3]) for row in rows]
    show_table(f"{title}, {selection.said(result, *ends)} ({known})", header, rows)
    if not only and (order := ranking(found)):
        say(f"{order}\n")


def show_impacts(title: str, result: Result, most: int | None, ends: tuple[float, float]) -> None:
    """Print the impacts between two times [s], so many of each joint; nothing without clearance joints."""
    words = f"{title}, speeds of approach and separation, largest force at the records"
    show_table(words, IMPACTS, summary.impacts(result, most, *ends))


def in_short(result: Result) -> list[tuple[str, str]]:
    """Mean, peak, fluctuation and impacts of the clearance joint that is hit hardest, as names and words.

    Without a clearance joint of the pin with the largest force.
    """
    found = summary.numbers(result, *WHOLE)
    if joints := hardest_first(found):
        own = stem(joints[0], found)
        peak = f"{own}{LARGEST}"
    else:
        forces = [name for name in found if name.startswith("pin.") and name.endswith(".force.largest")]
        peak = max(forces, key=lambda name: found[name].value, default="")
        own = peak.removesuffix(".force.largest")
    if not own:
        return [("forces", "none recorded")]
    numbers = {"mean force": f"{own}.force.mean", "peak force": peak, "fluctuation (RMS)": f"{own}.force.std"}
    rows = [(f"{own}: {what}", _number(found.get(name))) for what, name in numbers.items()]
    onsets = next((some for pin, some in result.onsets.items() if result.scenario.contact_stem(pin) == own), ())
    others = f"; {len(joints) - 1} more clearance joints are hit less hard" if len(joints) > 1 else ""
    impacts = f"{len(onsets)}{others}" if joints else "none, for there is no clearance joint"
    return [*rows, (f"{own}: impacts", impacts)]


def _number(found: Any) -> str:
    if found is None:
        return "not recorded"
    value, error, unit = summary.with_error(found)
    return f"{value} ± {error} {unit}" if error else f"{value} {unit}"


def facts(result: Result, ends: tuple[float, float]) -> dict[str, Any]:
    """Accuracy, cost and numbers of a run between two times [s], for scripts, in SI."""
    return {
        "accuracy": {"asked": result.goal, "met": result.met if result.goal is not None else None},
        "counts": asdict(result.counts),
        "wall_time_s": result.wall_time,
        "warnings": list(result.warnings),
        "numbers": {name: found._asdict() for name, found in summary.numbers(result, *ends).items()},
    }
