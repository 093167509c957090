"""Numbers that studies report, with their errors: from runs, in tables, in sentences and in summary.json."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import cast

import numpy as np
import numpy.typing as npt

from studies.common.rise import Crest, Versus
from studies.common.runs import halvings
from support_exudyn import Result
from support_exudyn.postprocessing.page.pieces import Sheet

DIGITS = 5  # of a number in a sentence
MOST_DIGITS = 6  # of a number in a table: where its error is smaller, all that are shown are right
NUMBERS, LONGEST = "numbers", 400  # the table of all numbers, and its most rows in a chapter
Found = Mapping[tuple[str, str], "Number"]  # numbers by name and case


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


Measure = Callable[[Result], float]


def measured(
    name: str, case: str, unit: str, result: Result, measure: Measure, paper: float | None = None
) -> Number:
    """A number of a run with errors: that of its steps, and that of its records."""
    found = result.estimate(measure, unit)
    if isinstance(measure, Crest):
        of_records = measure.missed(result)
    else:
        of_records = error_of_records(lambda every: measure(cast(Result, Thinned(result, every))))
    return Number(name, case, found.value, unit, found.error + of_records, paper)


@dataclass(frozen=True)
class Thinned:
    """A run as if only every so many of its records had been taken."""

    run: Result
    every: int

    @property
    def time(self) -> npt.NDArray[np.float64]:
        """Times of the records that are left [s]."""
        return self.run.time[:: self.every]

    def __getitem__(self, name: str) -> npt.NDArray[np.float64]:
        return self.run[name][:: self.every]

    def __getattr__(self, name: str) -> object:
        return getattr(self.run, name)


def error_of_records(thinned: Callable[[int], float]) -> float:
    """How far a number may be from that of records without gaps, by those of fewer records.

    Of half as many the whole distance counts, and half that of a quarter and of a fifth: shaking in step with
    the records is seen by one of them. Of 460 means and spreads of forces with corners, from 3 to 120 times a
    second, 98 % are covered; a test draws others.

    thinned: the number of every so many records.
    """
    found = thinned(1)
    return max(weight * abs(thinned(every) - found) for every, weight in ((2, 1.0), (4, 0.5), (5, 0.5)))


Measures = Mapping[str, tuple[str, Measure | Versus]]  # unit and measure, by name


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
            paper = (papers or {}).get((name, case))
            if not isinstance(measure, Versus):
                numbers.append(measured(name, case, unit, run, measure, paper))
                continue
            ideal = results[ideal_of(case)]
            number = compared(name, case, unit, run, ideal, measure.get, paper)
            error = number.numerical_error + (0.0 if run is ideal else measure.missed(run, ideal))
            numbers.append(replace(number, numerical_error=error))
    return numbers


def counted(name: str, case: str, result: Result, count: Callable[[Result], int]) -> Number:
    """A count of a run; its error is how far its coarser ones are away, for counts do not converge."""
    found = [count(run) for run in halvings(result)]
    return Number(name, case, float(found[-1]), "1", float(max(abs(found[-1] - one) for one in found)))


def compared(
    name: str,
    case: str,
    unit: str,
    run: Result,
    other: Result,
    measure: Callable[[Result, Result], float],
    paper: float | None = None,
) -> Number:
    """A number of a run beside another one, with the same records; the errors of both add up.

    The differences of a run from itself are 0, the ratios 1, without any error.
    """
    here = run.estimate(lambda finer: measure(finer, finer if run is other else other), unit)
    error = 0.0 if run is other and here.value in (0.0, 1.0) else here.error
    if run is not other:
        error += other.estimate(lambda finer: measure(run, finer), unit).error
    error += error_of_records(lambda n: measure(cast(Result, Thinned(run, n)), cast(Result, Thinned(other, n))))
    return Number(name, case, here.value, unit, error, paper)


# --- in tables and sentences ---


def rounded(value: float, error: float, most: int = MOST_DIGITS) -> str:
    """A number with its error, both to two digits of the error, at most `most` digits of the number.

    An error below the last of these digits is not printed: all printed digits are right.
    """
    if error == 0.0 or not math.isfinite(error):
        return f"{value:.9g}" if most == MOST_DIGITS else f"{value:.{most}g}"
    if value.is_integer() and error.is_integer() and abs(value) + error < 1e6:
        return f"{value:.0f} ± {error:.0f}"  # counts
    last = most - 1 - math.floor(math.log10(max(abs(value), error)))
    if error < 0.5 * 10.0**-last:
        return _plain(value, last)
    digits = min(last, 1 - math.floor(math.log10(error)))
    return f"{_plain(value, digits)} ± {_plain(error, digits)}"


def _plain(value: float, digits: int) -> str:
    """A number with so many decimals; below 0 that many zeros end it. Small numbers have a power of ten."""
    if digits > 8:
        return f"{value:.{max(0, digits + math.floor(math.log10(abs(value))))}e}" if value else "0"
    return f"{round(value, digits):.{max(0, digits)}f}"


def cell(number: Number | None, scale: float = 1.0) -> str:
    """A number in a table with its error, see `rounded`; empty without a number. scale: to another unit."""
    return "" if number is None else rounded(scale * number.value, scale * number.numerical_error)


def printed(number: Number | None) -> str:
    """The value that the paper prints for a number, if any."""
    return "" if number is None or number.paper is None else f"{number.paper:.9g}"


def by_case(numbers: Iterable[Number]) -> dict[tuple[str, str], Number]:
    """Numbers by name and case."""
    return {(number.name, number.case): number for number in numbers}


def said(number: Number, scale: float = 1.0, unit: str | None = None, most: int = DIGITS) -> str:
    """A number in a sentence: value, error and unit, in at most so many digits; scale: to another unit."""
    text = rounded(scale * number.value, scale * number.numerical_error, most)
    shown = number.unit if unit is None else unit
    return text if shown == "1" else f"{text} {shown.replace('^2', '²')}"


def short(number: Number, scale: float = 1.0, unit: str | None = None) -> str:
    """A number in a sentence, in three digits."""
    return said(number, scale, unit, 3)


def number_table(numbers: Sequence[Number]) -> Sheet:
    """The table of all numbers; columns that no number fills are left out."""
    columns: dict[str, Callable[[Number], str]] = {
        "quantity": lambda one: one.name.replace("_", " "),
        "case": lambda one: one.case,
        "unit": lambda one: one.unit,
        "value": cell,
        "printed": printed,
        "witness": witnessed,
        "difference": difference,
    }
    filled = {name: tuple(get(one) for one in numbers) for name, get in columns.items()}
    shown = {name: cells for name, cells in filled.items() if any(cells)}
    return Sheet("", tuple(shown), tuple(zip(*shown.values(), strict=True)), left=3)


def witnessed(number: Number) -> str:
    """The value by the witness, with the digits that the error of the number leaves; empty if there is none."""
    if number.witness is None:
        return ""
    return rounded(number.witness, number.numerical_error).partition(" ± ")[0]


def difference(number: Number) -> str:
    """By how much the number is above the witness, to two digits; empty if there is no witness."""
    return "" if number.witness is None else f"{number.value - number.witness:+.2g}"


def against(number: Number, other: Number) -> str:
    """How much a number is above or below another, in per cent of the other, to its error.

    What both errors leave open is said so: "no more than 0.6 % off".
    """
    ratio = number.value / other.value
    change = 100.0 * (ratio - 1.0)
    error = 100.0 * (number.numerical_error + abs(ratio) * other.numerical_error) / abs(other.value)
    if error >= abs(change):
        most = abs(change) + error
        return f"the same within {_two_digits(most)} %" if most else "the same"
    first = -math.floor(math.log10(abs(change)))  # decimals up to its first digit
    right = -math.ceil(math.log10(error)) if error else first + 1  # up to the last that the error leaves
    digits = max(0, first, min(right, first + 1))
    return f"{change:+.{digits}f} %"


def _two_digits(value: float) -> str:
    return f"{value:.{max(0, 1 - math.floor(math.log10(value)))}f}"


def off(number: Number) -> float:
    """The relative distance of a number from the one printed or known beside it."""
    assert number.paper is not None
    return abs(number.value / number.paper - 1.0)


def percent(share: float) -> str:
    """A share in per cent."""
    return f"{_two_digits(100.0 * share)} %" if share >= 1e-5 else "less than 0.001 %"
