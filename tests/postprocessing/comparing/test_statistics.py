"""Intervals of statistics against closed forms and drawn series; the shift in time by correlation."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import signal, stats

from support_exudyn.postprocessing.comparing.measures import STATISTICS, compared_statistics
from support_exudyn.postprocessing.comparing.shift import time_shift
from user_forces import InputError

SECOND = np.arange(0.0, 1.0, 1e-3)


def process(count: int, memory: float, random: np.random.Generator, mean: float = 0.5) -> np.ndarray:
    """x(n) = memory x(n - 1) + noise, scaled to the standard deviation 1, about a mean."""
    noise = math.sqrt(1.0 - memory**2) * random.normal(size=count + 500)
    found: np.ndarray = mean + signal.lfilter([1.0], [1.0, -memory], noise)[500:]
    return found


def test_the_same_process_is_equal_and_another_is_not() -> None:
    random = np.random.default_rng(0)
    first, second = process(4000, 0.6, random), process(4000, 0.6, random)
    found = compared_statistics(first, second)
    assert all(one.equal for one in found.values())
    by = 3.0 * found["mean"].half
    moved = compared_statistics(first, second + by)
    assert moved["mean"].equal is False
    assert moved["mean"].difference == pytest.approx(found["mean"].difference + by)
    assert compared_statistics(first, 1.5 * second)["rms"].equal is False
    many = compared_statistics(first, second, among=20)["mean"]
    # of many statistics each interval is wider
    alone, together = stats.t.ppf(0.5 + 0.5 * 0.95 ** np.array([1.0, 1.0 / 20.0]), 9)
    assert many.half / found["mean"].half == pytest.approx(together / alone)


def test_the_interval_of_a_mean_is_that_of_the_blocks() -> None:
    first, second = np.random.default_rng(2).normal(size=(2, 500))
    blocks = (second - first).reshape(10, 50).mean(axis=1)
    known = stats.ttest_1samp(blocks, 0.0).confidence_interval(0.95)
    found = compared_statistics(first, second)["mean"]
    assert (found.difference - found.half, found.difference + found.half) == pytest.approx(known)


def test_curves_that_do_not_vary_that_are_too_short_or_not_known() -> None:
    same = compared_statistics(np.full(100, 0.1), np.full(100, 0.1))
    assert all(one.equal for one in same.values())
    assert compared_statistics(np.full(100, 0.1), np.full(100, 0.2))["mean"].equal is False
    short = np.arange(60.0)
    gaps = np.where(short < 11.0, math.nan, np.cos(short))
    found = compared_statistics(np.sin(short), gaps)["mean"]
    assert found.equal is None
    assert found.difference == pytest.approx((np.cos(short) - np.sin(short))[11:].mean())
    assert compared_statistics(short[:1], short[:1]) == {}


@pytest.mark.parametrize(("apart", "noise", "equal"), [(0.0, 1.0, True), (0.5, 1.0, False), (5.0, 0.0, False)])
def test_a_course_that_both_follow_does_not_hide_a_difference(apart: float, noise: float, equal: bool) -> None:
    """Of two strokes of 500 mm one lies higher; blocks of a ramp alone would allow 200 mm."""
    random, time = np.random.default_rng(0), np.linspace(0.0, 2.0, 2001)
    x = np.clip(time - 0.3, 0.0, 1.0)
    first, second = (500.0 * x * x * (3.0 - 2.0 * x) + noise * random.normal(size=time.size) for _ in range(2))
    found = compared_statistics(first, second + apart)["mean"]
    assert found.equal is equal
    assert abs(found.difference - apart) <= found.half < 0.1


@pytest.mark.slow
@pytest.mark.parametrize(
    ("count", "memory", "least"), [(300, 0.5, 88.0), (1000, 0.5, 90.0), (1000, 0.9, 85.0), (4000, 0.9, 89.0)]
)
def test_intervals_hold_the_truth_as_often_as_measured(count: int, memory: float, least: float) -> None:
    random = np.random.default_rng(count)
    found = [
        compared_statistics(process(count, memory, random), process(count, memory, random)) for _ in range(200)
    ]
    for name in STATISTICS:
        assert sum(bool(one[name].equal) for one in found) >= least / 100.0 * len(found), name


# --- the shift in time ---


def bump(time: np.ndarray) -> np.ndarray:
    found: np.ndarray = np.exp(-(((time - 0.5) / 0.05) ** 2)) + 0.3 * np.sin(7.0 * time) * np.exp(-time)
    return found


@pytest.mark.parametrize("lag", [0.0, 0.01234, -0.1111, 250.0])
def test_a_shift_between_samples_is_determined(lag: float) -> None:
    later = SECOND + round(lag, 2)
    found = time_shift(SECOND, bump(SECOND), later, 5.0 + 3.0 * bump(later - lag))
    assert found.shift == pytest.approx(lag, abs=1e-8)
    assert found.correlation == pytest.approx(1.0)
    assert found.is_sure


@pytest.mark.parametrize(("noise", "least"), [(0.01, 2.5e-4), (0.2, 6e-3)])
def test_noise_moves_a_shift_by_a_little(noise: float, least: float) -> None:
    random = np.random.default_rng(7)
    noises = noise * random.normal(size=(25, 2, SECOND.size))
    found = [
        time_shift(SECOND, bump(SECOND) + mine, SECOND, bump(SECOND - 0.0123) + its).shift
        for mine, its in noises
    ]
    assert math.sqrt(np.mean((np.array(found) - 0.0123) ** 2)) < least


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (np.sin(60.0 * SECOND), np.sin(60.0 * (SECOND - 0.003))),  # repeats itself
        tuple(np.random.default_rng(5).normal(size=(2, SECOND.size))),  # not alike
    ],
)
def test_a_shift_that_is_not_sure(first: np.ndarray, second: np.ndarray) -> None:
    assert not time_shift(SECOND, first, SECOND, second).is_sure


def test_what_has_no_shift_is_refused() -> None:
    with pytest.raises(InputError, match="not all equal"):
        time_shift(SECOND, bump(SECOND), SECOND, np.zeros(SECOND.size))
