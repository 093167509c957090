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
from support_exudyn.postprocessing.result_table import ResultTable
from support_exudyn.postprocessing.shown_numbers import numbers, shown, side_by_side
from support_exudyn.simulation.estimate import Estimate
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
    def _of_runs(self) -> list[dict[str, Estimate]]:
        """Numbers of each run."""
        return [numbers(result, self.after, self.until) for result in self.runs.values()]

    @cached_property
    def numbers(self) -> Mapping[str, Mapping[str, Estimate]]:
        """Numbers that any run has, by name, of each run that has it; an error that is not known is NaN."""
        names = dict.fromkeys(name for found in self._of_runs for name in found)
        pairs = [*zip(self.runs, self._of_runs, strict=True)]
        return Named({n: {run: found[n] for run, found in pairs if n in found} for n in names}, "number")

    @cached_property
    def printed(self) -> list[dict[str, Estimate]]:
        """The numbers of each run that `rows` and the printed table contain, as `shown` chooses them."""
        return shown([*self.runs.values()], self._of_runs, self.after, self.until)

    def rows(self) -> list[tuple[str, ...]]:
        """A row for each printed number: name, unit in which it is read best, and value ± error of each run."""
        names = dict.fromkeys(name for found in self.printed for name in found)
        return [(name, *side_by_side([found.get(name) for found in self.printed])) for name in names]

    def to_pandas(self) -> pd.DataFrame:
        """A row for each number, in SI: `unit`, and of each run its value and `NAME error`."""
        import pandas  # it takes a third of a second

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

    def table(self) -> ResultTable:
        """The printed numbers; its title says what is known of their errors."""
        unknown = [name for name, run in self.runs.items() if run.coarser is None]
        title = "± estimated numerical error; a number without it has one below the last digit"
        if unknown:
            title = f"errors of {', '.join(unknown)} not known, for no accuracy was asked; of others {title}"
        return ResultTable(title, ("number", "unit", *(f">{name}" for name in self.runs)), self.rows())

    def __str__(self) -> str:
        return self.table().text()

    __repr__ = __str__

    def _repr_html_(self) -> str:
        """The table of the numbers, for notebooks."""
        return self.table().html()


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
    names = [Path(run).stem if isinstance(run, (str, Path)) else f"run {n}" for n, run in enumerate(runs, 1)]
    for name, run in [*zip(names, runs, strict=True), *named.items()]:
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
