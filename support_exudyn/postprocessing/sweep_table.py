"""The runs of a sweep as a table for a text."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from support_exudyn.postprocessing.figures.units import readable
from support_exudyn.postprocessing.sweep_runs import SweepRuns, in_words

DIGITS = 6  # of numbers whose error is not known
LATEX = {
    "\\": r"\textbackslash{}", "&": r"\&", "%": r"\%", "$": r"\$", "#": r"\#", "_": r"\_", "{": r"\{",
    "}": r"\}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "±": r"$\pm$", "µ": r"$\mu$",
    "²": r"$^2$",
}  # fmt: skip


def as_markdown(runs: SweepRuns, columns: Sequence[str]) -> str:
    """A table of Markdown: what varied and these numbers, with their errors where they are known.

    columns: of the sweep's table. Units are those in which the numbers are read best.
    """
    head, rows = _cells(runs, columns)
    lines = [head, ["---", *["---:"] * (len(head) - 1)], *rows]
    return "\n".join(f"| {' | '.join(cell.replace('|', '/') for cell in line)} |" for line in lines) + "\n"


def as_latex(runs: SweepRuns, columns: Sequence[str]) -> str:
    """A tabular of LaTeX with the rules of booktabs; columns as of `as_markdown`."""
    head, rows = _cells(runs, columns)
    lines = [
        " & ".join("".join(LATEX.get(one, one) for one in cell) for cell in line) for line in (head, *rows)
    ]
    body = " \\\\\n".join(lines[1:])
    return (
        f"\\begin{{tabular}}{{l{'r' * (len(head) - 1)}}}\n\\toprule\n{lines[0]} \\\\\n\\midrule\n{body} \\\\\n"
        "\\bottomrule\n\\end{tabular}\n"
    )


def as_csv(runs: SweepRuns, columns: Sequence[str]) -> str:
    """Comma-separated values in SI with all digits, units in the names; errors have columns of their own."""
    wanted = {"run", "status", *runs.varied, *columns, *(f"{name}_error" for name in columns)}
    kept = [name for name in runs.table.column_names if name in wanted]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(kept)
    for row in runs.table.select(kept).to_pylist():
        writer.writerow(["" if row[name] is None else row[name] for name in kept])
    return text.getvalue()


def _cells(runs: SweepRuns, columns: Sequence[str]) -> tuple[list[str], list[list[str]]]:
    head, cells = ["run"], [runs.column("run")]
    for name in runs.varied:
        head.append(in_words(name))
        cells.append([_plain(one) for one in runs.column(name)])
    for number in map(runs.number, columns):
        shown = readable(number.unit, float(np.abs(number.known).max(initial=0.0)))
        errors = np.full(number.values.size, np.nan) if number.errors is None else number.errors
        head.append(f"{number.name} [{shown.name}]" if shown.name else number.name)
        cells.append([_said(*pair, shown.scale) for pair in zip(number.values, errors, strict=True)])
    return head, [list(row) for row in zip(*cells, strict=True)]


def _plain(item: Any) -> str:
    return f"{item:.{DIGITS}g}" if isinstance(item, float) else str(item)


def _said(value: float, error: float, scale: float) -> str:
    if not np.isfinite(value):
        return ""
    if not 0.0 < error < math.inf:
        return f"{scale * value:.{DIGITS}g}"
    digits = min(max(0, 1 - math.floor(math.log10(scale * error))), 9)
    return f"{scale * value:.{digits}f} ± {scale * error:.1g}"
