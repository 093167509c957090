"""Errors from the distances of three runs, on results whose numbers follow a known law."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import (
    Held,
    Onset,
    Result,
)
from support_exudyn.formulations.registry import FORMULATIONS
from support_exudyn.simulation.estimate import (
    ALIKE,
    CHOSEN,
    FASTEST,
    FIRST_ORDER,
    OWN,
    SAFETY_OF_WORST,
    SLOWEST,
    SLOWEST_OWN,
    Estimate,
)
from support_exudyn.simulation.reported_numbers import ONSETS, ROUNDING, measures
from tests.cases.run_cases import FORCE, PIN, loose_support
from tests.compiled_runs import simulate_compiled
from user_forces import InputError

SAFETY = FORMULATIONS["compiled"].safety  # which is what runs here
CLEARANCE = 1.5e-3  # [m], of the clearance pin
ROUND_OFF = 1e-15  # of a number; distances of two lose as much in the absolute
rates = st.floats(FASTEST, SLOWEST)
shares = st.floats(-6.0, -1.0).map(lambda x: 10.0**x)
signs = st.sampled_from([-1.0, 1.0])


@cache
def exact() -> Result:
    """A short fall with three impacts; it stands for the exact one, which it says by its tolerance.

    Without statistics from every step: these are of its channels, which are changed here.
    """
    run = simulate_compiled(loose_support(drive=Held(), duration=0.08, record_period=1e-3), 1e-6)
    return replace(with_tolerance(run, 1e-13), statistics=None)


def with_tolerance(run: Result, tolerance: float) -> Result:
    """The same that says that its steps were chosen by another tolerance."""
    scenario = replace(run.scenario, solver=replace(run.scenario.solver, tolerance=tolerance))
    return replace(run, scenario=scenario)


def scaled(factor: float) -> Result:
    """The same with every number so many times as large, but time."""
    run = exact()
    channels = {
        name: channel if name == "time" else replace(channel, values=factor * channel.values)
        for name, channel in run.channels.items()
    }
    onsets = {
        pin: tuple(Onset(*(factor * number for number in onset)) for onset in row)
        for pin, row in run.onsets.items()
    }
    largest = {pin: factor * force for pin, force in run.largest_force.items()}
    return replace(run, channels=channels, onsets=onsets, largest_force=largest)


def three(a: Result, b: Result, c: Result, goal: float = 1e-3) -> Result:
    """Three runs as a run to an accuracy leaves them: c the finest."""
    return replace(c, coarser=replace(b, coarser=a), goal=goal)


def falling(share: float, r: float) -> Result:
    """Numbers off by a share of what they tend to, and r times that, and r times that."""
    return three(*(scaled(1.0 + share * r**n) for n in range(3)))


def without(run: Result, number: int) -> Result:
    """With only so many impacts."""
    return replace(run, onsets={PIN: run.onsets[PIN][:number]})


def with_force(run: Result, factor: float) -> Result:
    """With the clearance pin's force alone so many times as large."""
    channel = run.channels[FORCE]
    return replace(run, channels={**run.channels, FORCE: replace(channel, values=factor * channel.values)})


def whatever_the_steps(run: Result, name: str) -> float:
    """What is part of an error whatever the steps: rounding of forces, what a time may miss."""
    kind = measures(run, 0.0, math.inf)[name]
    return kind.missed(run) + kind.rounding


# --- numbers that fall as they should ---


NUMBERS = (*(f"{FORCE}.{word}" for word in ("mean", "std", "largest")), f"pin.{PIN}.onset_2.speed")


@given(share=shares, sign=signs, r=rates)
def test_an_estimate_is_so_many_times_the_true_error(share: float, sign: float, r: float) -> None:
    run, right = falling(sign * share, r), three(exact(), exact(), exact()).numbers()
    wrong, told = share * r**2, run.numbers()
    lost = 100.0 * ROUND_OFF / (wrong * (1.0 - r)) + 1e-12
    for name in NUMBERS:
        true = wrong * abs(right[name].value)
        found = told[name].error - whatever_the_steps(run, name)
        assert SAFETY * true * (1.0 - lost) <= found * (1.0 + 1e-12), name
        # what no estimate is below is added: rounding of the largest value
        assert found <= SAFETY * true * (1.0 + lost) + 1.1 * ROUNDING * right[f"{FORCE}.largest"].value, name


# --- numbers that do not ---


def test_two_runs_that_agree_by_chance_are_not_taken_as_exact() -> None:
    r = 0.4
    last = falling(1e-2, r)
    middle, first = last.coarser, last.coarser.coarser  # type: ignore[union-attr]
    assert middle is not None
    assert first is not None
    middle = with_force(middle, (1.0 + 1e-2 * r**2) / (1.0 + 1e-2 * r))
    run = three(first, middle, last)
    # one number of many: the median of all knows better
    assert run.fall == pytest.approx(r, rel=1e-9)
    before = 1e-2 * (1.0 - r**2) * exact().window(FORCE).mean
    # 1e-10 of it is added; steps are chosen by a tolerance here
    expected = SAFETY * CHOSEN * before * r / (1.0 - r)
    assert run.numbers()[f"{FORCE}.mean"].error == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("own", [0.05, 0.4, 0.9])
def test_a_number_that_falls_slower_than_others_has_a_larger_error(own: float) -> None:
    r, share = 0.25, 1e-3
    forces = (1.0 + share, 1.0 + share * own, 1.0 + share * own**2)
    runs = [with_force(scaled(1.0 + share * r**n), k / (1.0 + share * r**n)) for n, k in enumerate(forces)]
    run = three(*runs)
    assert run.fall == pytest.approx(r, rel=1e-9)  # of most
    # rates are believed in part and to a limit; faster ones than most are not
    taken = max(r, min(OWN * own, SLOWEST_OWN))
    distance = share * (1.0 - own) * max(own, CHOSEN) * float(exact()[FORCE].max())
    least = ALIKE * share * r * (1.0 - r) * float(exact()[FORCE].max())
    name = f"{FORCE}.largest"
    told = run.numbers()[name].error - whatever_the_steps(run, name)
    assert told == pytest.approx(SAFETY * max(distance, least) * taken / (1.0 - taken), rel=5e-3)


def test_a_touch_is_not_known_better_than_a_step_may_be() -> None:
    run = with_tolerance(exact(), 1e-5)
    for n, impact in enumerate(run.onsets[PIN][:ONSETS]):
        found, name = three(run, run, run).numbers(), f"pin.{PIN}.onset_{n + 1}"
        assert found[f"{name}.time"].error == pytest.approx(1e-5 * CLEARANCE / impact.speed)
        assert found[f"{name}.speed"].error == pytest.approx(1e-5 * impact.speed)
    # steps that are given follow nothing else
    given = replace(run, scenario=replace(run.scenario, formulation="exudyn"))
    assert three(given, given, given).numbers()[f"pin.{PIN}.onset_1.speed"].error < 1e-6 * impact.speed


@pytest.mark.parametrize("fewer", [0, 1])
def test_a_touch_that_a_coarser_run_misses_has_no_error_that_is_known(fewer: int) -> None:
    runs = [exact(), exact(), exact()]
    runs[fewer] = without(runs[fewer], 1)
    found = three(*runs).numbers()
    assert math.isfinite(found[f"pin.{PIN}.onset_1.speed"].error)
    for field in ("time", "speed"):
        assert found[f"pin.{PIN}.onset_2.{field}"].error == math.inf
        assert math.isfinite(found[f"pin.{PIN}.onset_2.{field}"].value)
    # it does not disturb what is known of the others
    assert math.isfinite(three(*runs).worst_error)


# --- what an accuracy is of ---


@pytest.mark.parametrize("r", [0.25, 0.5])
def test_the_worst_error_is_that_of_forces_and_paths(r: float) -> None:
    share = 1e-4
    run = falling(share, r)
    path = np.array([exact()["tip.x"], exact()["tip.y"]])
    extent = max(float(np.hypot(*np.ptp(path, axis=1))), 1.5e-3)
    # the tip is 4 m from the origin and moves by millimetres, so that a share of its place is the worst
    # its distance from the run before, which is not believed to fall faster than by half
    last = share * (1.0 - r) * max(r, FIRST_ORDER) * np.hypot(*path).max() / extent
    # extent and clearance are those of the finest run, off by that share itself
    assert run.worst_error == pytest.approx(SAFETY_OF_WORST * last, rel=1e-3)
    goal = run.worst_error
    assert replace(run, goal=goal).met
    assert not replace(run, goal=0.99 * goal).met


# --- which numbers there are ---


@pytest.mark.parametrize("window", [(1.0, math.inf), (0.05, 0.02), (math.nan, math.inf)])
def test_times_beside_the_run_are_refused(window: tuple[float, float]) -> None:
    with pytest.raises(InputError, match=r"after = .* s, until = .* s: .*allowed: .* from 0 to 0\.08 s"):
        falling(1e-3, 0.25).numbers(*window)


def test_a_run_without_an_accuracy_says_what_to_do() -> None:
    run = exact()
    advice = r"nothing to estimate errors by; allowed: runs with an accuracy, .*accuracy='standard'"
    for ask in (
        run.numbers,
        lambda: run.estimate(lambda r: 1.0),
        lambda: run.worst_error,
    ):
        with pytest.raises(InputError, match=advice):
            ask()
    assert not run.met


# --- numbers that are next to nothing ---


def with_channel(run: Result, name: str, values: np.ndarray) -> Result:
    """The same with other values of a channel."""
    return replace(run, channels={**run.channels, name: replace(run.channels[name], values=values)})


def test_a_force_that_is_rounding_of_others_is_not_told_from_zero() -> None:
    noise = 1e-13 * exact()[FORCE].max() * np.random.default_rng(2).normal(size=exact().time.size)
    run = with_channel(exact(), "front_column.force", noise)
    found = three(run, run, run).numbers()
    for word in ("mean", "std", "largest", "min", "max"):
        number = found[f"front_column.force.{word}"]
        assert abs(number.value) <= number.error <= 2e-12 * exact()[FORCE].max()


# --- printed to the first digit of the error ---


@pytest.mark.parametrize(
    ("value", "error", "told"),
    [
        (176827.717, 2e3, "177000 ± 2000 N"),
        (52093.3357, 1.2, "52093 ± 1 N"),
        (51486.4246123, 7e-6, "51486.424612 ± 7e-06 N"),
        (3.00986, 9.6e-4, "3.010 ± 0.001 N"),
        (0.0, 0.5, "0.0 ± 0.5 N"),
        (12.5, 0.0, "12.5 ± 0 N"),
        (12.5, math.nan, "12.5 ± nan N"),
        (1.5, 400.0, "0 ± 400 N"),
        (1.0, 1e-20, "1.00000000000 ± 1e-20 N"),
    ],
)
def test_no_digit_is_printed_that_the_error_does_not_leave(value: float, error: float, told: str) -> None:
    assert str(Estimate(value, error, "N")) == told
