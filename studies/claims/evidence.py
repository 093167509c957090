"""What a claim is judged by: measures of runs with their numerical error, and comparisons that know it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

Verdict = bool | None  # None: the numerical error leaves it open


@dataclass(frozen=True)
class Measured:
    """A number and its numerical error, both finite, in the same unit."""

    value: float
    error: float = 0.0

    def __add__(self, other: Measured) -> Measured:
        return Measured(self.value + other.value, self.error + other.error)

    def __sub__(self, other: Measured) -> Measured:
        return Measured(self.value - other.value, self.error + other.error)

    def times(self, factor: float) -> Measured:
        """Product with a known factor."""
        return Measured(factor * self.value, abs(factor) * self.error)

    def over(self, other: Measured) -> Measured:
        """Quotient; the error to first order."""
        ratio = self.value / other.value
        return Measured(ratio, (self.error + abs(ratio) * other.error) / abs(other.value))

    def above(self, limit: Measured | float) -> Verdict:
        """Whether it is larger than a number; None if the errors overlap."""
        gap = self - (limit if isinstance(limit, Measured) else Measured(limit))
        if abs(gap.value) <= gap.error:
            return None
        return gap.value > 0.0

    def below(self, limit: Measured | float) -> Verdict:
        """Whether it is smaller than a number; None if the errors overlap."""
        larger = self.above(limit)
        return None if larger is None else not larger

    def format(self, digits: int = 4) -> str:
        """To so many significant digits, fewer if the error does not leave them."""
        size = max(abs(self.value), self.error)
        if size == 0.0:
            return "0"
        places = max(0, digits - 1 - math.floor(math.log10(size)))
        if self.error > 0.0:
            places = min(places, -math.floor(math.log10(self.error)))  # below 0: tens, hundreds
        text = f"{round(self.value, places):.{max(0, places)}f}"
        return text.lstrip("-") if float(text) == 0.0 else text


@dataclass(frozen=True)
class Evidence:
    """All measures of one machine: by case (`CASES` in `plausible_runs`), then by name."""

    measures: Mapping[str, Mapping[str, Measured]]

    def __getitem__(self, place: tuple[str, str]) -> Measured:
        case, name = place
        return self.measures[case][name]

    def row(self, name: str, cases: Iterable[str]) -> list[Measured]:
        """One measure over several cases."""
        return [self[case, name] for case in cases]


@dataclass(frozen=True)
class NotedEvidence(Evidence):
    """Evidence that notes what it is asked for: measures by name, then by case."""

    asked: dict[str, dict[str, Measured]] = field(default_factory=dict)

    def __getitem__(self, place: tuple[str, str]) -> Measured:
        case, name = place
        found = self.asked.setdefault(name, {})[case] = super().__getitem__(place)
        return found

    def describe(self, of_all: Sequence[str]) -> str:
        """What was asked for, in words; cases are named unless they are those of `of_all`."""
        texts = []
        for name, row in self.asked.items():
            named = (f"{m.format(5)} ({case})" for case, m in row.items())
            values = (m.format(5) for m in row.values()) if [*row] == [*of_all] else named
            what = " ".join(IN_WORDS.get(word, word) for word in name.split("_"))
            texts.append(f"{what} {', '.join(values)} {unit(name)}".rstrip())
        return "; ".join(texts)

    @property
    def largest_error(self) -> float | None:
        """Largest numerical error of what was asked for, as a share of its value; None if nothing was."""
        every_one = [m for row in self.asked.values() for m in row.values()]
        return max((m.error / abs(m.value) if m.value else math.inf for m in every_one), default=None)


IN_WORDS = {"rms": "RMS fluctuation of", "likeness": "correlation of trends of", "std": "standard deviation of"}
UNITS = {"force": "N", "speed": "deg/s", "acceleration": "deg/s^2", "impulse": "N s", "tip": "mm"}


def unit(name: str) -> str:
    """The unit of a measure, by its name; empty for a correlation."""
    if name.startswith("likeness"):
        return ""
    return next((unit for word, unit in UNITS.items() if word in name.split("_")), "deg")


def every(verdicts: Iterable[Verdict]) -> Verdict:
    """Whether all are true: false if one is, open if one is open and none false."""
    found = list(verdicts)
    if any(v is False for v in found):
        return False
    return None if any(v is None for v in found) else True


def some(verdicts: Iterable[Verdict]) -> Verdict:
    """Whether one is true at least."""
    none = every(opposite(v) for v in verdicts)
    return opposite(none)


def opposite(verdict: Verdict) -> Verdict:
    """The contrary; what is open stays open."""
    return None if verdict is None else not verdict


def rising(row: list[Measured]) -> Verdict:
    """Whether each is larger than the one before."""
    return every(after.above(before) for before, after in pairwise(row))


def within(row: list[Measured], share: float, of: Measured | None = None) -> Verdict:
    """Whether the largest and the smallest differ by less than a share of the first, or of `of`."""
    scale = of or row[0]
    span = max(row, key=lambda m: m.value) - min(row, key=lambda m: m.value)
    return span.below(Measured(abs(scale.value), scale.error).times(share))
