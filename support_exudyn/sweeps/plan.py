"""What a sweep runs, and what it notes of every run.

The points of a plan are all combinations of some values, lists side by side, or a Latin hypercube.
"""

import itertools
import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Context, Decimal
from pathlib import Path
from typing import Any, Literal, Protocol

from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import InputError

MOST = 1_000_000  # runs of a sweep
DIGITS = Context(prec=12)  # of numbers that are spread over a range: far finer than they are known
Point = dict[str, Any]  # what is varied, as the sweep's file writes it
Inputs = Mapping[str, Any]  # the same, to be read
Choices = Sequence[Any]


@dataclass(frozen=True)
class Range:
    """Numbers from one to another, evenly spread, or evenly in their logarithm.

    steps: how many in a grid or list.
    """

    low: Decimal
    high: Decimal
    steps: int = 0
    scale: Literal["linear", "log"] = "linear"

    def at(self, share: float) -> Decimal:
        """The number at a share of the way, 0 to 1, in twelve digits; the ends are exact."""
        if share in (0.0, 1.0):
            return self.high if share else self.low
        if self.scale == "log":
            low, high = math.log(self.low), math.log(self.high)
            return DIGITS.create_decimal_from_float(math.exp(low + share * (high - low))).normalize()
        return DIGITS.add(self.low, DIGITS.multiply(self.high - self.low, Decimal(share))).normalize()

    @property
    def values(self) -> list[Decimal]:
        """The numbers of the range, as many as there are steps."""
        return [self.at(n / (self.steps - 1)) for n in range(self.steps)]


class Distributed(Protocol):
    """Numbers of which some are more likely than others, see `distributions`."""

    def at(self, share: float) -> Decimal:
        """The number that a share of all is below, 0 to 1."""


Varied = Mapping[str, Range | Distributed | Choices]


def grid(varied: Varied) -> list[Point]:
    """All combinations; the last named varies fastest. Raises InputError if they are too many."""
    choices = {name: _listed(one) for name, one in varied.items()}
    _check_number(math.prod(len(one) for one in choices.values()))
    return [dict(zip(choices, point, strict=True)) for point in itertools.product(*choices.values())]


def side_by_side(varied: Varied) -> list[Point]:
    """The first of all lists, the second of all, and so on. Raises InputError if they differ in length."""
    choices = {name: _listed(one) for name, one in varied.items()}
    lengths = {name: len(one) for name, one in choices.items()}
    if len(set(lengths.values())) > 1:
        said = ", ".join(f"{name} has {length}" for name, length in lengths.items())
        raise InputError(f"vary: {said} values; allowed with method = 'list': as many in all")
    _check_number(max(lengths.values(), default=0))
    return [dict(zip(choices, point, strict=True)) for point in zip(*choices.values(), strict=True)]


def latin_hypercube(varied: Varied, samples: int, seed: int) -> list[Point]:
    """Points drawn so that each range, cut into as many equal parts as there are points, has one in each.

    Of a distribution the parts are equally likely. Of a list of choices each is drawn equally often, to within
    one. The same seed gives the same points.

    Arguments:
        varied: ranges or lists of choices, by name.
        samples: how many points, >= 1.
        seed: of the random numbers, >= 0.
    """
    _check_number(samples)
    if not varied:
        raise InputError("vary: is empty; allowed: at least one field to vary")
    from scipy.stats import qmc  # takes a second, and a grid has no use for it

    drawn = qmc.LatinHypercube(len(varied), seed=seed).random(samples)
    return [
        {
            name: _drawn(one, float(share), samples)
            for (name, one), share in zip(varied.items(), row, strict=True)
        }
        for row in drawn
    ]


def _drawn(one: Range | Distributed | Choices, share: float, samples: int) -> Any:
    if not isinstance(one, Sequence):
        return one.at(share)
    return one[int(share * samples) * len(one) // samples]  # by its part, so that all come up equally often


def _listed(one: Range | Distributed | Choices) -> list[Any]:
    if isinstance(one, Range):
        return one.values
    if isinstance(one, Sequence):
        return list(one)
    raise InputError("vary: a distribution has no steps; allowed with method = 'latin_hypercube'")


def _check_number(runs: int) -> None:
    if not 1 <= runs <= MOST:
        raise InputError(f"{runs} runs: allowed in a sweep: from 1 to {MOST}")


# --- the plan ---


@dataclass(frozen=True)
class Record:
    """What of every run stands in the table.

    numbers: names such as "pin.rear_base.force.mean", a channel and a statistic of it; patterns as in a shell;
    or those of `Result.numbers`. None: all of the latter. after, until: times between which statistics are
    taken [s].
    """

    numbers: tuple[str, ...] = ()
    after: float = 0.0
    until: float = math.inf

    @property
    def digest(self) -> str:
        """Identifies what is noted."""
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
    that says all this, if there is one; it is kept with the table. sampled: whether the points are drawn from
    distributions, so that percentiles of numbers mean something. store: where it is kept if no folder is said,
    beside its file; None of a plan without a file.
    """

    points: Sequence[Inputs]
    scenario: Callable[[Inputs], Scenario]
    record: Record = Record()
    errors: bool = False
    text: str = ""
    sampled: bool = False
    store: Path | None = None

    @property
    def run_names(self) -> list[str]:
        """Names of the runs by their numbers, such as "run_07"."""
        digits = len(str(len(self.points)))
        return [f"run_{n:0{digits}}" for n in range(1, len(self.points) + 1)]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of what is varied."""
        return tuple(self.points[0]) if self.points else ()
