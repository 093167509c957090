"""The runs of a sweep as a table for a text."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from support_exudyn.postprocessing.figures.sweep_chart import bare, in_words, metadata, varied_in
from support_exudyn.postprocessing.figures.units import readable

if TYPE_CHECKING:
    import pyarrow as pa

DIGITS = 6  # of numbers whose error is not known
LATEX = {
    "\\": r"\textbackslash{}", "&": r"\&", "%": r"\%", "$": r"\$", "#": r"\#", "_": r"\_", "{": r"\{",
    "}": r"\}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "±": r"$\pm$", "µ": r"$\mu$",
    "²": r"$^2$",
}  # fmt: skip


def as_markdown(table: pa.Table, columns: Sequence[str]) -> str:
    """A table of Markdown: what varied and these numbers, with their errors where they are known.

    columns: of the sweep's table. Units are those in which the numbers are read best.
    """
    head, rows = _cells(table, columns)
    lines = [head, ["---", *["---:"] * (len(head) - 1)], *rows]
    return "\n".join(f"| {' | '.join(cell.replace('|', '/') for cell in line)} |" for line in lines) + "\n"


def as_latex(table: pa.Table, columns: Sequence[str]) -> str:
    """A tabular of LaTeX with the rules of booktabs; columns as of `as_markdown`."""
    head, rows = _cells(table, columns)
    lines = [
        " & ".join("".join(LATEX.get(one, one) for one in cell) for cell in line) for line in (head, *rows)
    ]
    body = " \\\\\n".join(lines[1:])
    return (
        f"\\begin{{tabular}}{{l{'r' * (len(head) - 1)}}}\n\\toprule\n{lines[0]} \\\\\n\\midrule\n{body} \\\\\n"
        "\\bottomrule\n\\end{tabular}\n"
    )


def as_csv(table: pa.Table, columns: Sequence[str]) -> str:
    """Comma-separated values in SI with all digits, units in the names; errors have columns of their own."""
    errors = [f"{name}_error" for name in columns if f"{name}_error" in table.column_names]
    kept = [
        name for name in table.column_names if name in {"run", "status", *varied_in(table), *columns, *errors}
    ]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(kept)
    for row in table.select(kept).to_pylist():
        writer.writerow(["" if row[name] is None else row[name] for name in kept])
    return text.getvalue()


def _cells(table: pa.Table, columns: Sequence[str]) -> tuple[list[str], list[list[str]]]:
    head, cells = ["run"], [table.column("run").to_pylist()]
    for name in varied_in(table):
        head.append(in_words(name))
        cells.append([_plain(one) for one in table.column(name).to_pylist()])
    for name in columns:
        values = table.column(name).to_pylist()
        unit = metadata(table, name).get("unit", "")
        shown = readable(unit, max((abs(one) for one in values if one is not None), default=0.0))
        known = f"{name}_error" in table.column_names
        errors = table.column(f"{name}_error").to_pylist() if known else [None] * len(values)
        head.append(f"{bare(name, unit)} [{shown.name}]" if shown.name else bare(name, unit))
        cells.append([_said(*pair, shown.scale) for pair in zip(values, errors, strict=True)])
    return head, [list(row) for row in zip(*cells, strict=True)]


def _plain(item: Any) -> str:
    return f"{item:.{DIGITS}g}" if isinstance(item, float) else str(item)


def _said(value: float | None, error: float | None, scale: float) -> str:
    if value is None or not np.isfinite(value):
        return ""
    if error is None or not 0.0 < error < math.inf:
        return f"{scale * value:.{DIGITS}g}"
    digits = min(max(0, 1 - math.floor(math.log10(scale * error))), 9)
    return f"{scale * value:.{digits}f} ± {scale * error:.1g}"
