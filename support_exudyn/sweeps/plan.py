"""What a sweep runs, and what it notes of every run."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import InputError

Inputs = Mapping[str, Any]  # what is varied, as the sweep's file writes it


@dataclass(frozen=True)
class Record:
    """What of every run stands in the table.

    numbers: names such as "pin.rear_base.force.mean", a channel and a statistic of it; patterns as in a shell;
    or those of `Result.numbers`. None: all of the latter. after, until: times between which statistics are
    taken [s]. keep_runs: whether every run is kept as a file, too.
    """

    numbers: tuple[str, ...] = ()
    after: float = 0.0
    until: float = math.inf
    keep_runs: bool = True

    @property
    def digest(self) -> str:
        """Tells apart what is noted, not whether runs are kept."""
        return json.dumps([self.numbers, self.after, self.until])

    def check(self, scenario: Scenario) -> None:
        """Raise InputError if a run of this scenario has no record between the times."""
        if not (self.after <= scenario.duration and self.after <= self.until):
            raise InputError(
                f"after_s = {self.after:g}, until_s = {self.until:g}: no record lies between; allowed: "
                f"times from 0 to the duration, {scenario.duration:g} s, the first before the second"
            )


@dataclass(frozen=True)
class Plan:
    """The runs of a sweep.

    points: what is varied, for each run, all with the same names. scenario: makes one from that; it raises
    InputError for what cannot be run, which is a row of the table with this reason. record: what is noted.
    errors: whether runs without an accuracy are made with estimated errors, see `simulate`. text: of the file
    that says all this, if there is one; it is kept with the table.
    """

    points: Sequence[Inputs]
    scenario: Callable[[Inputs], Scenario]
    record: Record = Record()
    errors: bool = False
    text: str = ""

    @property
    def names(self) -> tuple[str, ...]:
        """Of what is varied."""
        return tuple(self.points[0]) if self.points else ()
