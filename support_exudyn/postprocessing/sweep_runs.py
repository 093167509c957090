"""The table of a sweep: what varied, numbers with their errors and units, and its runs as text."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from support_exudyn.files.series.units import split_title
from support_exudyn.postprocessing.figures.units import DisplayUnit, readable
from support_exudyn.postprocessing.shown_numbers import DIGITS, rounded
from user_forces.values.value import InputError, short

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa

WALL_TIME = "wall_time_s"


@dataclass(frozen=True)
class SweepNumber:
    """A number of the runs.

    column: of the table. name: without unit. values: of each run (n,) in SI, NaN where it has none. errors: of
    these (n,), None if the runs have none.
    """

    column: str
    name: str
    unit: str
    values: np.ndarray
    errors: np.ndarray | None

    @property
    def display(self) -> DisplayUnit:
        """The unit in which its values are read best."""
        return readable(self.unit, float(np.abs(self.known).max(initial=0.0)))

    @property
    def title(self) -> str:
        """Its name with this unit."""
        return f"{self.name} [{self.display.name}]" if self.display.name else self.name

    @property
    def rows(self) -> np.ndarray:
        """Indexes of the runs that have it."""
        return np.flatnonzero(~np.isnan(self.values))

    @property
    def known(self) -> np.ndarray:
        """Its values, of the runs that have it."""
        known: np.ndarray = self.values[self.rows]
        return known


class SweepRuns:
    """The runs of a sweep; table: as `read_table` gives it."""

    def __init__(self, table: pa.Table) -> None:
        self.table = table

    def column(self, name: str) -> list[Any]:
        """A column of the table."""
        items: list[Any] = self.table.column(name).to_pylist()
        return items

    def _about(self, name: str) -> dict[str, str]:
        """Unit and meaning of a column."""
        found = self.table.schema.field(name).metadata or {}
        return {key.decode(): text.decode() for key, text in found.items()}

    @cached_property
    def varied(self) -> list[str]:
        """The names of the columns of what was varied."""
        return [name for name in self.table.column_names if self._about(name).get("meaning") == "varied"]

    @cached_property
    def numbers(self) -> dict[str, str]:
        """The columns of numbers by their names without units; the time that runs took is none of these."""
        from support_exudyn.sweeps.table import amount  # and pyarrow

        first = self.table.column_names.index(WALL_TIME)
        columns = [name for name in self.table.column_names[first + 1 :] if not name.endswith("_error")]
        units = {name: self._about(name).get("unit", "") for name in columns}
        return {name.removesuffix(amount("", unit)) if unit else name: name for name, unit in units.items()}

    def number(self, name: str) -> SweepNumber:
        """A number by its name, with its unit or without. Raises InputError if there is none."""
        names = {column: one for one, column in self.numbers.items()}
        column = self.numbers.get(name, name)
        if column not in names and column != WALL_TIME:
            near = get_close_matches(name, self.numbers, 5, 0.4)
            raise InputError(f"{short(name)}: no such number; allowed: {some(near or list(self.numbers))}")
        errors = f"{column}_error"
        known = self._floats(errors) if errors in self.table.column_names else None
        unit = self._about(column).get("unit", "")
        return SweepNumber(column, names.get(column, column), unit, self._floats(column), known)

    def _floats(self, column: str) -> np.ndarray:
        return np.array([np.nan if one is None else one for one in self.column(column)], dtype=float)

    def input(self, name: str, besides: str | None = None) -> str:
        """The column of something that varied, by its name with its unit or without, besides another.

        Raises InputError if there is none.
        """
        allowed = [one for one in self.varied if one != besides]
        begun = [one for one in allowed if one.startswith(f"{name}_")]
        if name in allowed or len(begun) == 1:
            return name if name in allowed else begun[0]
        near = get_close_matches(name, allowed, 5, 0.4)
        raise InputError(f"{short(name)}: no such column; allowed: {some(near or allowed)}")

    @property
    def usual_input(self) -> str | None:
        """What a number is drawn over where nothing is named: the only input; None if there are several."""
        several = [name for name in self.varied if len(set(map(str, self.column(name)))) > 1]
        return several[0] if len(several) == 1 else None


def in_words(name: str) -> str:
    """A key of a file with its unit as text: "pins.hinge.clearance_mm" as "pins.hinge.clearance [mm]"."""
    bare_name, unit, _ = split_title(name)
    return f"{bare_name} [{unit.replace('**', '^').replace('*', ' ')}]" if unit else name


def some(names: list[str]) -> str:
    """The first of some names, and how many more there are."""
    return ", ".join(names[:8]) + (f" and {len(names) - 8} more" if len(names) > 8 else "") or "none"


# --- for a text ---


def as_frame(runs: SweepRuns, columns: Sequence[str]) -> pd.DataFrame:
    """Texts: run, what varied, and numbers with their errors where they are known, in units that read best.

    columns: of the sweep's table.
    """
    import pandas  # it takes a third of a second

    cells = {"run": runs.column("run")}
    for name in runs.varied:
        items = runs.column(name)
        cells[in_words(name)] = [f"{one:.{DIGITS}g}" if isinstance(one, float) else str(one) for one in items]
    for number in map(runs.number, columns):
        errors = np.full(number.values.size, np.nan) if number.errors is None else number.errors
        scale, pairs = number.display.scale, zip(number.values.tolist(), errors.tolist(), strict=True)
        cells[number.title] = [
            "" if math.isnan(one) else rounded(scale * one, scale * off) for one, off in pairs
        ]
    return pandas.DataFrame(cells)


def as_markdown(runs: SweepRuns, columns: Sequence[str]) -> str:
    """A table of Markdown; columns as of `as_frame`."""
    frame = as_frame(runs, columns)
    lines = [[*frame.columns], ["---", *["---:"] * (frame.shape[1] - 1)], *frame.to_numpy().tolist()]
    return "\n".join(f"| {' | '.join(cell.replace('|', '/') for cell in line)} |" for line in lines) + "\n"


def as_latex(runs: SweepRuns, columns: Sequence[str]) -> str:
    """A tabular of LaTeX with the rules of booktabs; columns as of `as_frame`."""
    frame = as_frame(runs, columns)
    text: str = frame.to_latex(index=False, escape=True, column_format="l" + "r" * (frame.shape[1] - 1))
    return text.replace("±", r"$\pm$").replace("µ", r"$\mu$").replace("²", "$^2$")


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
