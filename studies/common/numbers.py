"""Numbers that studies report, with their errors: from runs, in tables, in sentences and in summary.json."""

import json
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import cast

import numpy as np
import numpy.typing as npt

from studies.common.rise import Crest
from studies.common.runs import halvings
from support_exudyn import Result
from support_exudyn.files.whole_file import whole_file
from support_exudyn.simulation.provenance import versions

DIGITS = 5  # of a number in a sentence
MOST_DIGITS = 6  # of a number in a table: where its error is smaller, all that are shown are right
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


def measured_all(results: Mapping[str, Result], measures: Mapping[str, tuple[str, Measure]]) -> list[Number]:
    """Every measure of every run; measures: unit and measure, by name."""
    return [
        measured(name, case, unit, result, measure)
        for case, result in results.items()
        for name, (unit, measure) in measures.items()
    ]


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
    """A number of a run beside another one, with the same records; the errors of both add up."""
    here = run.estimate(lambda finer: measure(finer, other), unit)
    there = other.estimate(lambda finer: measure(run, finer), unit)
    error = here.error if run is other else here.error + there.error
    error += error_of_records(lambda n: measure(cast(Result, Thinned(run, n)), cast(Result, Thinned(other, n))))
    return Number(name, case, here.value, unit, error, paper)


def write_summary(
    out: Path, study: str, numbers: Sequence[Number], wall_s: float, counts: Mapping[str, int] | None = None
) -> Path:
    """Write DIR/summary.json: study, versions, wall time, counts of the study's own, and all numbers."""
    summary = {
        "study": study,
        "versions": versions(),
        "wall_s": round(wall_s, 3),
        **(counts or {}),
        "numbers": [asdict(number) for number in numbers],
    }
    path = out / "summary.json"
    with whole_file(path) as temporary:
        temporary.write_text(json.dumps(summary, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    return path


# --- in tables and sentences ---


def rounded(value: float, error: float) -> str:
    """A number with its error, both to two digits of the error, at most six of the number; counts as such.

    Where the error is below the sixth digit it is not said: all digits are right.
    """
    if error == 0.0 or not math.isfinite(error):
        return f"{value:.9g}"
    if value.is_integer() and error.is_integer() and abs(value) + error < 1e6:
        return f"{value:.0f} ± {error:.0f}"
    most = MOST_DIGITS - 1 - math.floor(math.log10(max(abs(value), error)))
    if error < 0.5 * 10.0**-most:
        return _plain(value, most)
    digits = min(most, 1 - math.floor(math.log10(error)))
    return f"{_plain(value, digits)} ± {_plain(error, digits)}"


def _plain(value: float, digits: int) -> str:
    """A number with so many decimals; below 0 that many zeros end it. Small ones with a power of ten."""
    if digits > 8:
        return f"{value:.{max(0, digits + math.floor(math.log10(abs(value))))}e}" if value else "0"
    return f"{round(value, digits):.{max(0, digits)}f}"


def cell(number: Number | None) -> str:
    """A number in a table with its error, see `rounded`; nothing if there is none."""
    return "" if number is None else rounded(number.value, number.numerical_error)


def printed(number: Number | None) -> str:
    """What the paper prints beside a number, if anything."""
    return "" if number is None or number.paper is None else f"{number.paper:.9g}"


def by_case(numbers: Iterable[Number]) -> dict[tuple[str, str], Number]:
    """Numbers by name and case."""
    return {(number.name, number.case): number for number in numbers}


def said(number: Number, scale: float = 1.0, unit: str | None = None) -> str:
    """Value and unit in five digits, with the error if it shows in them; in another unit if its scale is given.

    Tables have all digits.
    """
    shown = number.unit if unit is None else unit
    value, error = scale * number.value, scale * number.numerical_error
    size = max(abs(value), error)
    last = 10.0 ** (math.floor(math.log10(size)) - DIGITS + 1) if size > 0.0 else 0.0
    text = f"{value:.{max(0, -round(math.log10(last)))}f}" if error < last else rounded(value, error)
    if error == 0.0 and "." in text:
        text = text.rstrip("0").rstrip(".")  # counts and closed forms
    return text if shown == "1" else f"{text} {shown.replace('^2', '²')}"


def short(number: Number, scale: float = 1.0, unit: str | None = None) -> str:
    """A number in three digits, with its error as a share of it where that is not below 0.001 %."""
    value = scale * number.value
    share = number.numerical_error / abs(number.value) if number.value else 0.0
    digits = max(0, 2 - math.floor(math.log10(abs(value)))) if value else 0
    shown = number.unit if unit is None else unit
    text = f"{value:.{digits}f} {shown.replace('^2', '²')}"
    return f"{text} ± {percent(share)}" if share >= 1e-5 else text


def in_tile(number: Number, scale: float, unit: str) -> str:
    """A number in three digits, with its error however small it is: "52.7 kN ± less than 0.001 %"."""
    text, _, error = short(number, scale, unit).partition(" ± ")
    return f"{text} ± {error or percent(0.0)}"


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
