"""What others computed, and how far ours is from it: the cases of cases.toml, and rows of numbers."""

import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from importlib.resources import files
from typing import Any

from studies.common.numbers import Number
from support_exudyn import Result

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib


@dataclass(frozen=True)
class OutsideCase:
    """A case: title, program and source of its numbers, its scene, and how far off ours may be.

    allowed: relative, unless it is absolute. numbers: as cases.toml has them, with what holds for all.
    """

    name: str
    title: str
    program: str
    source: str
    scene: str
    allowed: float
    absolute: bool
    numbers: Sequence[Mapping[str, Any]]


@dataclass(frozen=True)
class ComparedNumber:
    """A number of a case beside ours.

    what, unit. theirs, their_error: of the source. ours, our_error: as runs of twice the steps tell it.
    allowed: by how much ours may be off, in the unit.
    """

    case: str
    what: str
    unit: str
    theirs: float
    their_error: float
    ours: float
    our_error: float
    allowed: float

    @property
    def off(self) -> float:
        """The distance of both, in the unit."""
        return abs(self.ours - self.theirs)

    @property
    def met(self) -> bool:
        """Whether that is as asked; what the source's digits leave open does not count."""
        return self.off <= self.allowed + self.their_digits

    @property
    def their_digits(self) -> float:
        """Their error, if it is one of digits."""
        return self.their_error if self.their_error < self.allowed else 0.0

    def number(self) -> Number:
        """The number as summary.json has it: ours, beside that of the source."""
        return Number(self.what, self.case, self.ours, self.unit, self.our_error, self.theirs)


COMMON = ("channel", "unit", "impact", "what", "largest", "error")  # of a case, which hold for all its numbers


def cases() -> list[OutsideCase]:
    """All cases, in their order."""
    text = files("studies.outside").joinpath("cases.toml").read_text(encoding="utf-8")
    found = []
    for name, table in tomllib.loads(text, parse_float=Decimal).items():
        common = {key: table[key] for key in COMMON if key in table}
        found.append(
            OutsideCase(
                name,
                table["title"],
                table["program"],
                table["source"],
                table["scene"],
                float(table["allowed"]),
                table.get("absolute", False),
                [common | number for number in table["numbers"]],
            )
        )
    return found


def compared(case: OutsideCase, fine: Result, coarse: Result) -> list[ComparedNumber]:
    """All numbers of a case beside those of a run, and of one of twice the steps."""
    found = []
    for number in case.numbers:
        what, measure = _measure(number)
        theirs, ours = float(number["value"]), measure(fine)
        found.append(
            ComparedNumber(
                case.name,
                what,
                str(number["unit"]),
                theirs,
                float(number["error"]) if "error" in number else _last_digit(number["value"]),
                ours,
                abs(ours - measure(coarse)),
                case.allowed if case.absolute else case.allowed * abs(theirs),
            )
        )
    return found


def _last_digit(written: Decimal) -> float:
    """Half of the last digit of a number."""
    exponent = written.as_tuple().exponent
    assert isinstance(exponent, int)  # what is written is finite
    return 0.5 * 10.0**exponent


def _measure(number: Mapping[str, Any]) -> tuple[str, Callable[[Result], float]]:
    """What a number is called, and how it is read off a run."""
    if "largest" in number:
        pin = number["largest"]
        return f"largest force of {pin}", lambda run: float(run.largest_force[pin])
    if "impact" in number:
        place, n, what = number["impact"], int(number["n"]), number["what"]
        return f"{place}, impact {n}: {what}", lambda run: float(getattr(run.onsets[place][n - 1], what))
    channel, at = number["channel"], float(number["at"])

    def recorded(run: Result) -> float:
        return float(run[channel][round(at / (run.time[1] - run.time[0]))])

    return f"{channel} at {at:g} s", recorded
