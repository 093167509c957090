"""When a run to an accuracy goes on, stops and gives up; runs whose errors are told stand in for real ones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import count
from types import MappingProxyType
from typing import Any

import numpy as np
import pytest

from support_exudyn import Failure, Held, Scenario, SimulationError
from support_exudyn.mechanics.trajectory import Counts
from support_exudyn.scene.contract import silent
from support_exudyn.simulation import to_accuracy
from tests.cases.run_cases import loose_support

GOAL = 1e-3


@dataclass(frozen=True)
class Told:
    """A result whose number and error are given."""

    number: int
    worst_error: float
    scenario: Scenario
    wall_time: float = 1.0
    goal: float | None = None
    coarser: Any = None
    counts: Counts = field(default_factory=Counts)
    channels: tuple[str, ...] = ("number",)

    def __getitem__(self, name: str) -> np.ndarray:
        return np.array([getattr(self, name)])


def run(
    monkeypatch: pytest.MonkeyPatch,
    errors: Sequence[float],
    same: Sequence[int] = (),
    failing: Mapping[int, Failure] = MappingProxyType({}),
) -> tuple[Told, int]:
    """The result that is chosen, and how many runs were made, if the third, fourth ... have these errors.

    same: numbers of the runs that are the same as the one before. failing: of those that end like this.
    """
    numbers = count()
    known = [float("inf"), float("inf"), *errors, *[errors[-1]] * 10]
    made = []

    def once(scenario: Scenario, progress: object) -> Told:
        number = next(numbers)
        made.append(number)
        if number in failing:
            raise SimulationError(failing[number])
        while number in same:
            number -= 1
        return Told(number, known[number], scenario)

    monkeypatch.setattr(to_accuracy, "single_run", once)
    scenario = loose_support(drive=Held(), duration=0.05, accuracy=GOAL, formulation="compiled")
    found: Any = to_accuracy.run_to_accuracy(scenario, silent)
    assert found.wall_time == len([number for number in made if number not in failing])
    return found, len(made)


@pytest.mark.parametrize(
    ("errors", "chosen", "runs"),
    [
        ([0.9 * GOAL], 2, 3),  # met at once
        ([8e-3, 4e-3, 0.5 * GOAL], 4, 5),  # met later
        ([8e-3, 7e-3, 6e-3, GOAL], 4, 5),  # twice in a row hardly smaller: given up
        ([8e-3, 7e-3, 4e-3, 3.9e-3, GOAL], 6, 7),  # hardly smaller twice, but not in a row
        ([4e-3, 5e-3, 6e-3], 2, 5),  # rounding makes it worse: the best is kept
        ([8e-3, 5e-3, 9e-3, 9e-3], 3, 6),
    ],
)
def test_it_goes_on_while_it_helps_and_keeps_the_best(
    monkeypatch: pytest.MonkeyPatch, errors: list[float], chosen: int, runs: int
) -> None:
    found, made = run(monkeypatch, errors)
    assert (found.number, made) == (chosen, runs)
    # the two before it are kept, and no more
    assert (found.coarser.number, found.coarser.coarser.number) == (chosen - 1, chosen - 2)
    assert found.coarser.coarser.coarser is None


@pytest.mark.parametrize(
    ("same", "chosen", "runs"),
    [
        ((), (2, 1, 0), 3),
        ((1, 2), (4, 3, 0), 5),  # steps follow the tolerance from the fourth run on
        ((2,), (3, 1, 0), 4),
        (range(1, 20), (0, 0), to_accuracy.MOST_RUNS),  # they never do
    ],
)
def test_runs_that_are_the_same_to_the_bit_tell_nothing(
    monkeypatch: pytest.MonkeyPatch, same: Sequence[int], chosen: tuple[int, ...], runs: int
) -> None:
    found, made = run(monkeypatch, [0.5 * GOAL], same)
    assert made == runs
    ladder = []
    while found is not None:
        ladder.append(found.number)
        found = found.coarser
    assert tuple(ladder) == chosen


COARSE = Failure("energy does not add up", "Take a smaller step.", 0.01, finer=True)
COARSER = replace(COARSE, time=0.02)
ENDED = Failure("a law gave no number", "Mend the law.", 0.01)


@pytest.mark.parametrize(
    ("failing", "chosen", "runs"),
    [
        ({0: COARSE}, (3, 2, 1), 4),  # its steps were too long: it does not count
        ({0: COARSE, 1: COARSE}, (4, 3, 2), 5),
        ({1: COARSE}, (4, 3, 2), 5),  # three in a row are wanted
        ({3: COARSE}, (2, 1, 0), 4),  # there is a result before it: it stands
        ({3: ENDED}, (2, 1, 0), 4),
    ],
)
def test_a_run_whose_steps_were_too_long_does_not_count(
    monkeypatch: pytest.MonkeyPatch, failing: dict[int, Failure], chosen: tuple[int, ...], runs: int
) -> None:
    errors = [8e-3, 0.5 * GOAL] if 3 in failing else [0.5 * GOAL]
    found, made = run(monkeypatch, errors, failing=failing)
    assert made == runs
    assert (found.number, found.coarser.number, found.coarser.coarser.number) == chosen


@pytest.mark.parametrize(
    ("failing", "told"),
    [
        ({0: ENDED}, ENDED),  # shorter steps do not help it
        ({0: COARSE, 1: ENDED}, COARSE),  # the first trouble is told
        ({0: COARSE, 3: COARSER, 6: COARSER}, COARSE),  # never three in a row
        (dict.fromkeys(range(20), COARSE), COARSE),
    ],
)
def test_where_no_three_runs_end_the_first_failure_is_told(
    monkeypatch: pytest.MonkeyPatch, failing: dict[int, Failure], told: Failure
) -> None:
    with pytest.raises(SimulationError) as caught:
        run(monkeypatch, [0.5 * GOAL], failing=failing)
    assert caught.value.failure == told
