"""Two runs of a scene at two accuracies are never told different; a changed scene is."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from itertools import combinations

import numpy as np
import pytest

from support_exudyn import CubicStep, Result, Scenario, machine, simple_scenario, simulate
from support_exudyn.postprocessing.comparing.compared_channel import compared
from support_exudyn.postprocessing.comparing.compared_file import recorded_columns
from tests.cases.run_cases import FORCE, loose_support

FINE = 1e-4  # an accuracy beyond "standard", whose tolerance is that of "draft" where steps are chosen by one
DOUBT = 10.0  # times both errors, up to which estimates may be too small
SEED = 20261124


def five_pins(clearance_mm: float = 1.0, duration: float = 0.5) -> Scenario:
    """The five pins of the examples, which hit harder and longer: they part within the run."""
    pins = machine("reference").linkage().pins
    return simple_scenario(
        "reference",
        pins={name: {"clearance_mm": clearance_mm, "restitution": 0.9} for name in pins},
        drive=CubicStep(stroke=0.002, start=0.0, end=0.16),
        duration_s=duration,
        record_period_s=2e-4,
    )


@cache
def parted() -> tuple[Result, Result]:
    """The same at two accuracies."""
    return simulate(five_pins(), accuracy="draft"), simulate(five_pins(), accuracy=FINE)


def over_errors(first: Result, second: Result) -> dict[str, float]:
    """By how many times both errors channels differ before the horizon, at worst, by name."""
    mine, its = (recorded_columns(run) for run in (first, second))
    end = min(first.horizon, second.horizon)
    names = [name for name in mine if name in its]
    apart = {name: compared(name, mine[name], its[name], horizon=end).over_errors for name in names}
    assert not np.isnan(list(apart.values())).any()
    return apart


def of_numbers(first: Result, second: Result) -> dict[str, float]:
    """By how many times both errors the numbers of two runs differ, by name."""
    mine, its = first.numbers(), second.numbers()
    return {
        name: abs(its[name].value - one.value) / (one.error + its[name].error or math.nan)
        for name, one in mine.items()
        if name in its
    }


def check_equal(first: Result, second: Result) -> None:
    """Assert that no number and no curve differs."""
    for apart in (of_numbers(first, second), over_errors(first, second)):
        assert apart
        assert {name: times for name, times in apart.items() if times > DOUBT} == {}


def drawn(number: int) -> Scenario:
    """A support with a clearance, friction, start and drive of its own, of laws that others compile too."""
    random = np.random.default_rng([SEED, number])
    duration = float(random.uniform(0.05, 0.2))
    return loose_support(
        clearance_mm=float(10.0 ** random.uniform(-0.7, 0.5)),
        sliding_coefficient=0.0 if number % 2 else float(random.uniform(0.05, 0.3)),
        duration=duration,
        start=("concentric", "settled")[number % 3 == 0],
        drive=CubicStep(stroke=float(random.uniform(0.0, 0.03)), start=0.0, end=duration),
    )


@pytest.mark.parametrize("number", range(3))
def test_accuracies_of_drawn_scenes_are_told_equal(number: int) -> None:
    runs = [simulate(drawn(number), accuracy=accuracy) for accuracy in ("draft", FINE, "reference")]
    for first, second in combinations(runs, 2):
        check_equal(first, second)


def test_five_pins_are_equal_up_to_the_horizon_and_differ_after_it() -> None:
    first, second = parted()
    end = min(first.horizon, second.horizon)
    assert end < 0.8 * first.time[-1]  # rounding moves it
    check_equal(first, second)
    forces = [name for name in first.channels if name.endswith(".force")]
    after = first.time > end
    # beyond the horizon they are not the same point by point
    apart = max(float(np.abs(second[name] - first[name])[after].max()) for name in forces)
    assert apart > 1e4


def test_a_clearance_that_is_larger_by_a_thousandth_is_told() -> None:
    first, _ = parted()
    other = simulate(five_pins(1.001), accuracy=FINE)
    assert max(over_errors(first, other).values()) > 100.0 * DOUBT


def test_errors_cover_what_lies_beyond_the_horizon() -> None:
    first, _ = parted()
    errors = recorded_columns(first, [FORCE])[FORCE].errors
    np.testing.assert_array_equal(np.isinf(errors), first.time >= first.horizon)
    assert (errors > 0.0).all()
    bare = replace(first, coarser=None, goal=None)
    assert np.isnan(recorded_columns(bare, [FORCE])[FORCE].errors).all()
