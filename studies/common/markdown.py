"""Text and tables as Markdown that reads well in a terminal too."""

import re
import textwrap
from collections.abc import Iterable, Sequence

WIDEST = 160  # characters of a row; longer rows of text become lists
WIDTH = 100  # of running text
HARD_SPACE = "\u00a0"
SPECIAL = re.compile(
    r"[\\|<*`]"
    r"|(?<!\w)_|_(?!\w)"  # mu_d stays as it is
    r"|(?<=\])[(\[:]"  # a link needs a bracket and what follows it
    r"|&(?=#?\w+;)"
)
BEGINNING = re.compile(  # what makes a list, a quotation, a heading or a rule of the line
    r"^(\s*)(?:(\d+)([.)])(?=\s|$)|([>~=]|#(?=[#\s]|$)|[-+](?=[-\s]|$)))"
)


def escaped(text: str) -> str:
    """Text in one line that Markdown shows as it is, within a line."""
    return SPECIAL.sub(r"\\\g<0>", " ".join(text.split()))


def paragraph(text: str, indent: str = "") -> str:
    """Text in lines of a terminal's width, all but the first indented."""
    lines = textwrap.wrap(
        unbroken(escaped(text)), WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
    )
    return "\n".join(_no_beginning(line) for line in lines).replace(HARD_SPACE, " ")


def unbroken(text: str) -> str:
    """Text with a value and its error, and a share and its sign, kept in one line."""
    return text.replace(" ± ", f"{HARD_SPACE}±{HARD_SPACE}").replace(" %", f"{HARD_SPACE}%")


def _no_beginning(line: str) -> str:
    """A line that does not begin a list or a heading though it begins with a dash or a number with a dot."""
    return BEGINNING.sub(lambda found: f"{found[1]}{found[2] or ''}\\{found[3] or found[4]}", line)


def bullets(texts: Iterable[str]) -> str:
    """A list."""
    return "\n".join(f"- {paragraph(text, '  ')}" for text in texts)


def pipe_table(header: Sequence[str], rows: Sequence[Sequence[str]], left: int) -> str:
    """A pipe table with padded columns; the first `left` of them left-aligned, the others right-aligned."""
    cells = [[escaped(cell) for cell in row] for row in (header, *rows)]
    widths = [max(3, *(len(cell) for cell in column)) for column in zip(*cells, strict=True)]
    rule = ["-" * width if n < left else "-" * (width - 1) + ":" for n, width in enumerate(widths)]
    return "\n".join(_line(row, widths, left) for row in (cells[0], rule, *cells[1:]))


def _line(cells: Sequence[str], widths: Sequence[int], left: int) -> str:
    padded = [
        cell.ljust(width) if n < left else cell.rjust(width)
        for n, (cell, width) in enumerate(zip(cells, widths, strict=True))
    ]
    return f"| {' | '.join(padded)} |"


def record_list(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A list entry a row: its first cell, and below it the others with their headings, empty ones left out."""
    lines = []
    for first, *others in rows:
        lines.append(f"- **{escaped(first) or '(no name)'}**")
        named = zip(header[1:], others, strict=True)
        lines += [f"  - {paragraph(f'{name}: {cell}', '    ')}" for name, cell in named if cell.strip()]
    return "\n".join(lines)
