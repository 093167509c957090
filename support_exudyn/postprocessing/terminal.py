"""Tables as text, for the terminal or for what reads standard output."""

import io
from collections.abc import Sequence
from shutil import get_terminal_size

from rich import box
from rich.cells import cell_len
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from user_forces.values.value import cleaned

WORDS = ("words", "meaning", "remark")  # heads of columns whose cells may be broken
NARROWEST = 25  # characters of such a column
PIPED = 150  # characters of a line where there is no terminal


def table_text(title: str, header: Sequence[str], rows: Sequence[Sequence[str]], note: str = "") -> str:
    """A table and the lines below it as text, see `ResultTable`.

    Names and numbers are never cut or broken, even if the terminal is too narrow for them. Words are broken at
    its width; a last column of words is left out where there is no room for it.
    """
    heads = header or ("", "words")
    widths = [
        NARROWEST if head in WORDS else max(cell_len(text) for text in (head, *(row[n] for row in rows)))
        for n, head in enumerate(heads)
    ]
    room = get_terminal_size((PIPED, 24)).columns
    needed = sum(widths) + 3 * len(widths) + 2  # with what stands between them
    if header and heads[-1] in WORDS and needed > room:
        return table_text(title, header[:-1], [row[:-1] for row in rows], note)
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
    with console.capture() as printed:
        console.print(table)
    lines = [title, *(line.rstrip() for line in printed.get().splitlines()), ""]
    return "\n".join([*lines, note, ""] if note else lines)
