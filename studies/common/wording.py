"""Numbers in sentences."""

from __future__ import annotations

import math
from collections.abc import Iterable

from studies.common.study import Number, rounded

QUICK = "This is the quick form: its steps are coarser than those of the full one, and its errors larger."
THRICE = (
    "Every case is run at least three times, each with half the steps of the run before, impact steps "
    "included. Values are those of the shortest; the number behind ± is the error that accuracies estimate "
    "from how fast the distances of the last three runs fall. Statistics are those of the records, and how "
    "often these are taken is not among the errors."
)
DIGITS = 5  # of a number in a sentence


def how_sure(quick: bool) -> str:
    """How the numerical error is measured."""
    return f"{THRICE} {QUICK}" if quick else THRICE


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


def against(number: Number, other: Number) -> str:
    """How much a number is above or below another, in per cent of the other."""
    change = 100.0 * (number.value / other.value - 1.0)
    return f"{change:+.0f} %" if abs(change) >= 10.0 else f"{change:+.2g} %"


def percent(share: float) -> str:
    """A share in per cent."""
    return f"{100.0 * share:.2g} %" if share >= 1e-5 else "less than 0.001 %"
