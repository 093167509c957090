"""Numbers that studies report, with their errors: from runs, in tables, in sentences and in summary.json."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from studies.common.rise import Crest, Measure, Versus, WholeNumber
from studies.common.runs import halvings
from support_exudyn import Result
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.postprocessing.shown_numbers import rounded

DIGITS = 5  # of a number in a sentence
NUMBERS, LONGEST = "numbers", 400  # the table of all numbers, and its most rows in a chapter


@dataclass(frozen=True)
class Number:
    """A number that a study reports.

    name, case: what, and of which run. value, unit. numerical_error: as accuracies estimate it, of three runs,
    see `simulation.estimate`; 0 for a closed form. paper: the printed value, None if there is none. witness:
    the value by the other formulation, see `studies.common.witness`; None if there is none.
    """

    name: str
    case: str
    value: float
    unit: str
    numerical_error: float
    paper: float | None = None
    witness: float | None = None


Found = Mapping[tuple[str, str], Number]  # numbers by name and case
Measured = Measure | Versus | WholeNumber
Measures = Mapping[str, tuple[str, Measured]]  # unit and measure, by name


def by_case(numbers: Iterable[Number]) -> dict[tuple[str, str], Number]:
    """Numbers by name and case."""
    return {(number.name, number.case): number for number in numbers}


# --- from runs ---


def measured_all(
    results: Mapping[str, Result],
    measures: Measures | Callable[[Result], Measures],
    ideal_of: Callable[[str], str] = str,
    papers: Mapping[tuple[str, str], float] | None = None,
) -> list[Number]:
    """Every measure of every run.

    Arguments:
        results: runs by case.
        measures: alike for all runs, or by the run.
        ideal_of: the case with the ideal pin that a case is compared with, for measures of both.
        papers: printed values by name and case.
    """
    numbers = []
    for case, run in results.items():
        for name, (unit, measure) in (measures(run) if callable(measures) else measures).items():
            value, error = with_error(measure, run, results.get(ideal_of(case)))
            numbers.append(Number(name, case, value, unit, error, (papers or {}).get((name, case))))
    return numbers


def with_error(measure: Measured, run: Result, ideal: Result | None = None) -> tuple[float, float]:
    """Value and error of a number of a run: errors of the steps and of the records add up.

    The error of a count is how far its coarser ones are away, for counts do not converge. Differences of a run
    from itself are 0, ratios 1, without any error. ideal: the run with the ideal pin, for measures of both.
    """
    if isinstance(measure, WholeNumber):
        counts = [measure.get(one) for one in halvings(run)]
        return float(counts[-1]), float(max(abs(counts[-1] - one) for one in counts))
    if isinstance(measure, Versus):
        assert ideal is not None
        get, error = measure.get, error_of_records(lambda n: measure.get(thinned(run, n), thinned(ideal, n)))
        here = run.estimate(lambda finer: get(finer, finer if run is ideal else ideal))
        if run is not ideal:
            error += ideal.estimate(lambda finer: get(run, finer)).error + measure.missed(run, ideal)
        return here.value, error + (0.0 if run is ideal and here.value in (0.0, 1.0) else here.error)
    found = run.estimate(measure)
    if isinstance(measure, Crest):
        return found.value, found.error + measure.missed(run)
    return found.value, found.error + error_of_records(lambda n: measure(thinned(run, n)))


@dataclass(frozen=True)
class Thinned:
    """The records of a run that are left if only every so many of them are taken."""

    run: Result
    every: int

    @property
    def time(self) -> npt.NDArray[np.float64]:
        """Times of the records that are left [s]."""
        return self.run.time[:: self.every]

    def __getitem__(self, name: str) -> npt.NDArray[np.float64]:
        return self.run[name][:: self.every]

    def __getattr__(self, name: str) -> Any:
        return getattr(self.run, name)


def thinned(run: Result, every: int) -> Result:
    """A run as if only every so many of its records had been taken."""
    return cast(Result, Thinned(run, every))


def error_of_records(of_every: Callable[[int], float]) -> float:
    """How far a number may be from that of records without gaps, by those of fewer records.

    Of half as many the whole distance counts, and half that of a quarter and of a fifth: shaking in step with
    the records is seen by one of them. Of 460 means and spreads of forces with corners, from 3 to 120 times a
    second, 98 % are covered; a test draws others.

    of_every: the number of every so many records.
    """
    found = of_every(1)
    return max(weight * abs(of_every(every) - found) for every, weight in ((2, 1.0), (4, 0.5), (5, 0.5)))


# --- in tables and sentences ---


def cell(number: Number | None, scale: float = 1.0) -> str:
    """A number in a table with its error; empty without a number. scale: to another unit."""
    return "" if number is None else rounded(scale * number.value, scale * number.numerical_error)


def printed(number: Number | None) -> str:
    """The value that the paper prints for a number, if any."""
    return "" if number is None or number.paper is None else f"{number.paper:.9g}"


def witnessed(number: Number) -> tuple[str, str]:
    """The value by the witness, with the digits that the error of the number leaves, and the difference.

    Both are empty if there is no witness.
    """
    if number.witness is None:
        return "", ""
    shown = rounded(number.witness, number.numerical_error).partition(" ± ")[0]
    return shown, f"{number.value - number.witness:+.2g}"


def number_table(numbers: Sequence[Number]) -> Sheet:
    """The table of all numbers; columns that no number fills are left out."""
    header = ("quantity", "case", "unit", "value", "printed", "witness", "difference")
    rows = [(n.name.replace("_", " "), n.case, n.unit, cell(n), printed(n), *witnessed(n)) for n in numbers]
    filled = [column for column in range(len(header)) if any(row[column] for row in rows)]
    return Sheet(
        "", tuple(header[n] for n in filled), tuple(tuple(row[n] for n in filled) for row in rows), left=3
    )


def stated(number: Number, scale: float = 1.0, unit: str | None = None, most: int = DIGITS) -> str:
    """A number in a sentence: value, error and unit, in at most so many digits; scale: to another unit."""
    text = rounded(scale * number.value, scale * number.numerical_error, most)
    shown = number.unit if unit is None else unit
    return text if shown == "1" else f"{text} {shown.replace('^2', '²')}"


def short(number: Number, scale: float = 1.0, unit: str | None = None) -> str:
    """A number in a sentence, in three digits."""
    return stated(number, scale, unit, 3)


def against(number: Number, other: Number) -> str:
    """How much a number is above or below another, in per cent of the other, to its error.

    What both errors leave open is stated so: "the same within 0.6 %".
    """
    ratio = number.value / other.value
    change = 100.0 * (ratio - 1.0)
    error = 100.0 * (number.numerical_error + abs(ratio) * other.numerical_error) / abs(other.value)
    if error >= abs(change):
        most = abs(change) + error
        return f"the same within {_two_digits(most)} %" if most else "the same"
    first = -math.floor(math.log10(abs(change)))  # decimals up to its first digit
    right = -math.ceil(math.log10(error)) if error else first + 1  # up to the last that the error leaves
    return f"{change:+.{max(0, first, min(right, first + 1))}f} %"


def percent(share: float) -> str:
    """A share in per cent."""
    return f"{_two_digits(100.0 * share)} %" if share >= 1e-5 else "less than 0.001 %"


def _two_digits(value: float) -> str:
    return f"{value:.{max(0, 1 - math.floor(math.log10(value)))}f}"


def off(number: Number) -> float:
    """The relative distance of a number from the one printed or known beside it."""
    assert number.paper is not None
    return abs(number.value / number.paper - 1.0)
