"""Several runs side by side: their numbers with errors as a table, their channels in one figure."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from support_exudyn.postprocessing.figures import overlay, style
from support_exudyn.postprocessing.html import html_table
from support_exudyn.postprocessing.shown_numbers import numbers, shown, side_by_side
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.recorded_run import library
from support_exudyn.simulation.result import Result
from user_forces.values.names import Named
from user_forces.values.value import InputError, short

if TYPE_CHECKING:
    import pandas as pd

FEWEST = 2


@dataclass(frozen=True, repr=False)
class RunsSideBySide:
    """Runs side by side.

    Arguments:
        runs: by name.
        after, until: times between which numbers are taken and channels drawn [s].
    """

    runs: Mapping[str, Result]
    after: float = 0.0
    until: float = math.inf

    @cached_property
    def numbers(self) -> Mapping[str, Mapping[str, Estimate]]:
        """Numbers that any run has, by name, of each run that has it; an error that is not known is NaN."""
        return _by_name(self._of_runs)

    def rows(self) -> list[tuple[str, ...]]:
        """A row for each printed number: name, unit in which it is read best, and value ± error of each run."""
        found_of = [*self._of_runs.values()]
        printed = dict(
            zip(self.runs, shown([*self.runs.values()], found_of, self.after, self.until), strict=True)
        )
        return [
            (name, *side_by_side([found.get(run) for run in self.runs]))
            for name, found in _by_name(printed).items()
        ]

    @cached_property
    def _of_runs(self) -> Mapping[str, Mapping[str, Estimate]]:
        """Numbers by run."""
        return {run: numbers(result, self.after, self.until) for run, result in self.runs.items()}

    def to_pandas(self) -> pd.DataFrame:
        """A row for each number, in SI: `unit`, and of each run its value and `NAME error`.

        Raises InputError if pandas is not installed.
        """
        pandas = library("pandas", "to_pandas")
        table = {}
        for name, found in self.numbers.items():
            row: dict[str, object] = {"unit": next(iter(found.values())).unit}
            for run, number in found.items():
                row |= {run: number.value, f"{run} error": number.error}
            table[name] = row
        return pandas.DataFrame.from_dict(table, orient="index")

    def plot(self, *channels: str, difference: bool = False) -> Figure:
        """Channels of the runs over time, one upon another.

        Arguments:
            channels: names, or patterns of them as in a shell; the forces of all pins if none are given.
            difference: draw what differs from the first run.

        Raises InputError as `figures.overlay.overlay` does.
        """
        draw = overlay.difference if difference else overlay.overlay
        with style.look():
            return draw(self.runs, channels or ("pin.*.force",), self.after, self.until)

    def __str__(self) -> str:
        """The table as text."""
        rows = [("number", "unit", *self.runs), *self.rows()]
        widths = [max(len(row[n]) for row in rows) for n in range(len(rows[0]))]
        lines = ("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in rows)
        return "\n".join([self.note, *(line.rstrip() for line in lines)])

    __repr__ = __str__

    def _repr_html_(self) -> str:
        """The table of the numbers, for notebooks."""
        header = ("number", "unit", *(f">{name}" for name in self.runs))
        return html_table(self.note, header, self.rows())

    @property
    def note(self) -> str:
        """What is said of the numbers' errors."""
        unknown = [name for name, run in self.runs.items() if run.coarser is None]
        said = "± estimated numerical error; where none is told, it is below the last digit"
        if not unknown:
            return said
        return f"errors of {', '.join(unknown)} not known, for no accuracy was asked; of others {said}"


def _by_name(of_runs: Mapping[str, Mapping[str, Estimate]]) -> Named[dict[str, Estimate]]:
    """Numbers of runs by number, then by run."""
    found: Named[dict[str, Estimate]] = Named(what="number")
    for run, found_of_run in of_runs.items():
        for name, number in found_of_run.items():
            found.setdefault(name, {})[run] = number
    return found


def compare(
    *runs: Result | str | Path, after: float = 0.0, until: float = math.inf, **named: Result | str | Path
) -> RunsSideBySide:
    """Runs side by side.

        compare(ideal=first, clearance=second).plot("pin.rear_base.force")

    Arguments:
        runs: results, or files of them; called "run 1" and so on, or as their files.
        after, until: times between which numbers are taken and channels drawn [s].
        named: further ones, called as their arguments.

    Raises InputError if there are fewer than two, if one is no run, or if two have one name; OSError if there
    is no such file.
    """
    found: dict[str, Result] = {}
    for name, run in [*((_name(n, run), run) for n, run in enumerate(runs, 1)), *named.items()]:
        if isinstance(run, (str, Path)):
            run = Result.load(run)
        if not isinstance(run, Result):
            raise InputError(f"{name} = {short(run)}: allowed: results of `simulate`, or files of them")
        if name in found:
            raise InputError(f"{name}: two runs have this name; allowed: names of their own, compare(NAME=RUN)")
        found[name] = run
    if len(found) < FEWEST:
        raise InputError(f"runs: {len(found)} given; allowed: {FEWEST} or more")
    return RunsSideBySide(found, after, until)


def _name(number: int, run: object) -> str:
    return Path(run).stem if isinstance(run, (str, Path)) else f"run {number}"
