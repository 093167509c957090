"""What a claim is judged by: measures of runs with numerical errors, and relations that know them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

Verdict = bool | None  # None: the numerical error leaves it open


@dataclass(frozen=True)
class Measured:
    """A number and its numerical error, both finite, in the same unit."""

    value: float
    error: float = 0.0

    def __sub__(self, other: Measured) -> Measured:
        return Measured(self.value - other.value, self.error + other.error)

    def times(self, factor: float) -> Measured:
        """Product with a known factor."""
        return Measured(factor * self.value, abs(factor) * self.error)

    def above(self, limit: Measured | float) -> Verdict:
        """Whether it is larger than a number; None if the errors overlap."""
        gap = self - (limit if isinstance(limit, Measured) else Measured(limit))
        return None if abs(gap.value) <= gap.error else gap.value > 0.0


Evidence = Mapping[str, Mapping[str, Measured]]  # all measures of a machine, by case and by name


def every(verdicts: Iterable[Verdict]) -> Verdict:
    """Whether all are true: false if one is, open if one is open and none false."""
    kinds = set(verdicts)
    return False if False in kinds else None if None in kinds else True


def opposite(verdict: Verdict) -> Verdict:
    """The contrary; what is open stays open."""
    return None if verdict is None else not verdict


# --- relations among the values of a measure over cases ---

Row = Sequence[Measured]
Relation = Callable[[Row, float, Measured | None], Verdict]  # row, threshold, and what it is a share of


def _limit(at: float, of: Measured | None) -> Measured:
    """A threshold, or that share of another number."""
    return Measured(at) if of is None else Measured(abs(of.value), of.error).times(at)


def rising(row: Row) -> Verdict:
    """Whether each value is larger than the one before."""
    return every(after.above(before) for before, after in pairwise(row))


def within(row: Row, at: float, of: Measured | None = None) -> Verdict:
    """Whether the largest and the smallest differ by less than a share of the first, or of another number."""
    span = max(row, key=lambda m: m.value) - min(row, key=lambda m: m.value)
    return _limit(at, of or row[0]).above(span)


def least_inside(row: Row) -> Verdict:
    """Whether a value between the first and the last is smaller than both."""
    first, *inner, last = row
    return opposite(every(opposite(every([first.above(m), last.above(m)])) for m in inner))


def jump(row: Row, at: float) -> Verdict:
    """Whether both values of the second half are above those of the first half, times `at`."""
    half = len(row) // 2
    return every(large.above(small.times(at)) for large in row[half:] for small in row[:half])


RELATIONS: dict[str, Relation] = {
    "above": lambda row, at, of: every(m.above(_limit(at, of)) for m in row),
    "below": lambda row, at, of: every(_limit(at, of).above(m) for m in row),
    "rising": lambda row, at, of: rising(row),
    "falling": lambda row, at, of: rising(row[::-1]),
    "not rising": lambda row, at, of: opposite(rising(row)),
    "within": within,
    "apart": lambda row, at, of: opposite(within(row, at, of)),
    "least inside": lambda row, at, of: least_inside(row),
    "jump": lambda row, at, of: jump(row, at),
}
