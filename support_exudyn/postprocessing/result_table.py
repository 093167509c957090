"""A table of a run or of a sweep: as text for the terminal and what reads standard output, and in HTML."""

import io
from collections.abc import Sequence
from html import escape
from shutil import get_terminal_size
from typing import Literal, NamedTuple

from user_forces.values.value import cleaned

WORDS = ("words", "meaning", "remark")  # heads of columns whose cells may be broken
NARROWEST = 25  # characters of such a column
PIPED = 150  # characters of a line where there is no terminal
LEFT, RIGHT = "text-align: left", "text-align: right"
CAPTION = f"caption-side: top; white-space: nowrap; {LEFT}"


class ResultTable(NamedTuple):
    """A table: title, heads of its columns, those of numbers with a > before them, rows, lines below it.

    Without heads the columns are names and words.
    """

    title: str
    header: tuple[str, ...]
    rows: Sequence[tuple[str, ...]]
    note: str = ""

    def html(self) -> str:
        """The table with its title, as notebooks show it."""
        columns = max(map(len, (self.header, *self.rows)), default=0)
        styles = [RIGHT if head.startswith(">") else LEFT for head in self.header or columns * ("",)]

        def line(tag: str, cells: Sequence[str]) -> str:
            pairs = zip(cells, styles, strict=True)
            one = "".join(f"<{tag} style='{style}'>{escape(cleaned(cell))}</{tag}>" for cell, style in pairs)
            return f"<tr>{one}</tr>"

        title = f"<caption style='{CAPTION}'><b>{escape(cleaned(self.title))}</b></caption>"
        head = f"<thead>{line('th', [name.lstrip('>') for name in self.header])}</thead>" if self.header else ""
        return f"<table>{title}{head}<tbody>{''.join(line('td', row) for row in self.rows)}</tbody></table>"

    def text(self) -> str:
        """The table and the lines below it.

        Names and numbers are never cut or broken, even if the terminal is too narrow for them. Words are broken
        at its width; a last column of words is left out where there is no room for it.
        """
        from rich import box  # and its console, which notebooks have no use for
        from rich.cells import cell_len
        from rich.console import Console
        from rich.markup import escape as plain
        from rich.table import Table

        title, header, rows, note = self
        heads = header or ("", "words")
        widths = [
            NARROWEST if head in WORDS else max(cell_len(text) for text in (head, *(row[n] for row in rows)))
            for n, head in enumerate(heads)
        ]
        room = get_terminal_size((PIPED, 24)).columns
        needed = sum(widths) + 3 * len(widths) + 2  # with what stands between them
        if header and heads[-1] in WORDS and needed > room:
            return ResultTable(title, header[:-1], [row[:-1] for row in rows], note).text()
        table = Table(
            box=box.SIMPLE_HEAD if header else None, show_header=bool(header), pad_edge=False, padding=(0, 1)
        )
        for head in heads:
            side: Literal["left", "right"] = "right" if head.startswith(">") else "left"
            word = plain(head.lstrip(">")) if header else ""
            table.add_column(word, justify=side, no_wrap=head not in WORDS, overflow="fold")
        for row in rows:
            table.add_row(*(plain(cleaned(cell)) for cell in row))
        console = Console(file=io.StringIO(), width=max(room, needed))
        with console.capture() as printed:
            console.print(table)
        lines = [title, *(line.rstrip() for line in printed.get().splitlines()), ""]
        return "\n".join([*lines, note, ""] if note else lines)
