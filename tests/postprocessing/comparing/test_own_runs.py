"""Two runs of a scene at two accuracies are never told different; a changed scene is."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from itertools import combinations

import numpy as np
import pytest

from support_exudyn import CubicStep, Result, Scenario, machine, simple_scenario, simulate
from support_exudyn.mechanics.contact_state import Onset
from support_exudyn.postprocessing.comparing.found_impacts import impacts_of_force
from support_exudyn.postprocessing.comparing.parting import parting_of_impacts, parting_of_runs
from support_exudyn.postprocessing.comparing.statistics import compared_statistics
from support_exudyn.postprocessing.comparing.with_errors import (
    DOUBT,
    BesideErrors,
    beside_errors,
    curve_errors,
    numbers_beside_errors,
)
from tests.cases.run_cases import FORCE, PIN, loose_slider_crank, loose_support
from tests.drawn.fresh_scenes import MACHINES, fresh

FINE = 1e-4  # an accuracy beyond "standard", whose tolerance is that of "draft" where steps are chosen by one
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


def point_by_point(first: Result, second: Result, end: float) -> Iterator[tuple[float, str, float]]:
    """By how many times both errors channels differ up to a time, at worst, and when that is."""
    names = [name for name in first.channels if name in second.channels and name != "time"]
    mine, its = curve_errors(first, names), curve_errors(second, names)
    before = first.time < end
    for name in names:
        error = (mine[name] + its[name])[before]
        apart = np.abs(second[name] - first[name])[before]
        assert not np.isnan(error).any()
        times = np.divide(apart, error, out=np.where(apart > 0.0, np.inf, 0.0), where=error > 0.0)
        yield float(times.max()), name, float(first.time[times.argmax()])


def told_equal(first: Result, second: Result) -> tuple[int, int]:
    """How many numbers and curves were compared; asserts that none is told different."""
    parting = parting_of_runs(first, second)
    assert parting.time >= min(first.horizon, second.horizon), parting
    numbers = numbers_beside_errors(first, second)
    assert [(name, str(one)) for name, one in numbers.items() if one.different] == []
    curves = list(point_by_point(first, second, parting.time))
    assert [one for one in curves if one[0] > DOUBT] == []
    return len(numbers), len(curves)


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


@pytest.mark.parametrize("number", range(6))
def test_accuracies_of_drawn_scenes_are_told_equal(number: int) -> None:
    runs = [simulate(drawn(number), accuracy=accuracy) for accuracy in ("draft", FINE, "reference")]
    for first, second in combinations(runs, 2):
        assert min(told_equal(first, second)) > 0


@pytest.mark.slow
def test_accuracies_of_many_drawn_scenes_are_told_equal() -> None:
    numbers = curves = scenes = 0
    kinds = [kind for kind in MACHINES if kind != "hydraulic legs"]
    drawn_scenes = [fresh(SEED + 1, number, kinds[number % len(kinds)]) for number in range(63)]
    legs = [fresh(SEED + 1, number, "hydraulic legs") for number in range(63, 69)]
    # the engine's formulation takes a minute for some of them
    legs = [replace(leg, scenario=replace(leg.scenario, formulation="auto")) for leg in legs]
    for scene in (*drawn_scenes, *legs):
        if scene.kind == "space":
            continue
        runs = [simulate(scene.scenario, accuracy=accuracy) for accuracy in ("draft", "standard")]
        if runs[0].scenario.formulation == "compiled":
            runs.append(simulate(scene.scenario, accuracy="reference"))
        for first, second in combinations(runs, 2):
            one, other = told_equal(first, second)
            numbers, curves = numbers + one, curves + other
        scenes += 1
    assert scenes > 50
    assert numbers > 5000
    assert curves > 8000


def test_five_pins_are_equal_up_to_the_horizon_and_in_statistics_after_it() -> None:
    first, second = parted()
    parting = parting_of_runs(first, second)
    assert parting.time == min(first.horizon, second.horizon) < 0.8 * first.time[-1]  # rounding moves it
    assert "horizon" in parting.because
    assert parting.impacts > 20
    assert parting.growth > 1.5  # measured 3.2
    told_equal(first, second)
    forces = [name for name in first.channels if name.endswith(".force")]
    after = first.time > parting.time
    # beyond the horizon they are not the same point by point
    apart = max(float(np.abs(second[name] - first[name])[after].max()) for name in forces)
    assert apart > 1e4
    for name in forces:
        impacts = [[onset.time for onset in run.onsets.get(name[4:-6], ())] for run in (first, second)]
        found = compared_statistics(
            first.time[after],
            first[name][after],
            second.time[after],
            second[name][after],
            first_impacts=impacts[0],
            second_impacts=impacts[1],
            among=5 * len(forces),
        )
        assert [one for one in found.values() if one.equal is False] == [], name


def test_without_errors_they_part_near_the_horizon() -> None:
    first, second = parted()
    found = parting_of_impacts(first.onsets, second.onsets)
    true = min(first.horizon, second.horizon)
    assert 0.5 * true < found.time < 3.0 * true
    bare = replace(first, coarser=None, goal=None)
    assert parting_of_runs(bare, replace(second, coarser=None, goal=None)) == found
    # one that has errors brings its horizon
    assert parting_of_runs(bare, second).time == min(found.time, second.horizon)


@pytest.mark.slow
def test_a_crank_parts_near_its_horizon() -> None:
    first, second = (
        simulate(loose_slider_crank(0.05), accuracy=accuracy) for accuracy in ("draft", "reference")
    )
    true = min(first.horizon, second.horizon)
    assert parting_of_runs(first, second).time == true
    assert 0.5 * true < parting_of_impacts(first.onsets, second.onsets).time < 2.0 * true
    told_equal(first, second)


def test_a_clearance_that_is_larger_by_a_thousandth_is_told() -> None:
    first, _ = parted()
    other = simulate(five_pins(1.001), accuracy=FINE)
    parting = parting_of_runs(first, other)
    assert parting.impacts == 0
    assert "times both errors" in parting.because
    worst = max(point_by_point(first, other, min(first.horizon, other.horizon)))
    assert worst[0] > 100.0 * DOUBT


def with_factor(run: Result, factor: float) -> Result:
    """The run, and all that its errors are estimated by, with another force of the pin."""
    channel = run.channels[FORCE]
    channels = {**run.channels, FORCE: replace(channel, values=factor * channel.values)}
    coarser = run.coarser and with_factor(run.coarser, factor)
    return replace(run, channels=channels, coarser=coarser, statistics=None)  # which then are of the channels


def test_a_factor_on_a_force_is_told() -> None:
    run = simulate(loose_support(1.0, 0.25, duration=0.1), accuracy=1e-4)
    changed = with_factor(run, 1.001)
    told = {name: times for times, name, _ in point_by_point(run, changed, math.inf)}
    assert told.pop(FORCE) > DOUBT
    assert set(told.values()) == {0.0}
    assert numbers_beside_errors(run, changed)[f"{FORCE}.mean"].different


def with_impacts(run: Result, change: Callable[[tuple[Onset, ...]], tuple[Onset, ...]]) -> Result:
    """The run, and all that its errors are estimated by, with other impacts of the pin."""
    coarser = run.coarser and with_impacts(run.coarser, change)
    return replace(run, onsets={**run.onsets, PIN: change(run.onsets[PIN])}, coarser=coarser)


def test_an_impact_that_is_lost_or_late_is_told() -> None:
    run = simulate(loose_support(1.5, duration=0.19), accuracy="draft")
    third = run.onsets[PIN][2]
    lost = parting_of_runs(run, with_impacts(run, lambda onsets: (*onsets[:2], *onsets[3:])))
    assert lost.time == third.time
    assert "one has an impact at 0.0721 m/s that the other lacks" in lost.because

    def late(by: float) -> float:
        def moved(onsets: tuple[Onset, ...]) -> tuple[Onset, ...]:
            return (*onsets[:2], onsets[2]._replace(time=onsets[2].time + by), *onsets[3:])

        return parting_of_runs(run, with_impacts(run, moved)).time

    error = run.numbers()[f"pin.{PIN}.onset_3.time"].error
    assert late(100.0 * error) == third.time
    assert late(0.5 * error) == math.inf


def test_impacts_found_in_a_force_are_those_of_the_run() -> None:
    run = simulate(loose_support(1.5, duration=0.19, record_period=2e-4), accuracy="draft")
    found, known = impacts_of_force(run.time, run[FORCE]), run.onsets[PIN]
    assert len(found) == len(known) > 5
    np.testing.assert_allclose([one.time for one in found], [one.time for one in known], atol=4e-4)
    assert parting_of_impacts({PIN: known}, {PIN: found}, resolution=4e-4).time == math.inf


def test_errors_cover_what_lies_beyond_the_horizon() -> None:
    first, _ = parted()
    errors = curve_errors(first, [FORCE])[FORCE]
    np.testing.assert_array_equal(np.isinf(errors), first.time >= first.horizon)
    assert (errors > 0.0).all()
    bare = replace(first, coarser=None, goal=None)
    assert np.isnan(curve_errors(bare, [FORCE])[FORCE]).all()


@pytest.mark.parametrize(
    ("difference", "error", "within", "different", "said"),
    [
        (1.0, 2.0, True, False, "within both errors"),
        (-2.0, 2.0, True, False, "within both errors"),
        (-6.2, 2.0, False, False, "larger: 3.1 times"),
        (25.0, 2.0, False, True, "larger: 12 times"),
        (0.0, 0.0, True, False, "within both errors"),
        (1e-9, 0.0, False, True, "larger, and no errors"),
        (1.0, math.nan, None, None, "errors not known"),
        (1.0, math.inf, None, None, "errors not known"),
    ],
)
def test_differences_in_words(
    difference: float, error: float, within: bool | None, different: bool | None, said: str
) -> None:
    found = BesideErrors(difference, error)
    assert (found.within, found.different, str(found)) == (within, different, said)


def test_errors_add_up() -> None:
    assert beside_errors(3.0, 5.0, 0.5, 0.25) == (2.0, 0.75)
