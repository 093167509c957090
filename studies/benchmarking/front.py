"""Cost and errors of runs, and which of them nobody beats."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from studies.benchmarking.measures import times_the_goal


@dataclass(frozen=True)
class Row:
    """A run.

    scene, family, label: what was run and how. seconds: wall time, the least if it was timed more than once.
    steps: accepted. calls: of contact forces in Python. errors: by the names of `measures.GOALS`; none if it
    failed, and failure says why. scatter: by how much its wall times differ [s]; nan if it was timed once.
    """

    scene: str
    family: str
    label: str
    seconds: float
    steps: int
    calls: int
    errors: dict[str, float] = field(default_factory=dict)
    failure: str = ""
    scatter: float = math.nan

    @property
    def overall(self) -> float:
        """The worst error in units of the goal."""
        return times_the_goal(self.errors) if self.errors else float("inf")


def front(rows: Sequence[Row]) -> list[Row]:
    """The rows than which no other is both faster and more accurate, the fastest first."""
    best, least = [], float("inf")
    for row in sorted(rows, key=lambda row: (row.seconds, row.overall)):
        if row.overall < least:
            best.append(row)
            least = row.overall
    return best


def cheapest(rows: Sequence[Row], most: float = 1.0) -> Row | None:
    """The fastest row whose errors are within the goal, or so many times it; None if there is none."""
    good = [row for row in rows if row.overall <= most]
    return min(good, key=lambda row: row.seconds) if good else None
