"""The stationary bootstrap against closed forms and another program; the shift in time by correlation."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import signal

from support_exudyn.postprocessing.comparing.shift import time_shift
from support_exudyn.postprocessing.comparing.statistics import (
    IMPACTS,
    STATISTICS,
    block_length,
    compared_statistics,
    long_run_variance,
    resampled,
)
from user_forces import InputError

SECOND = np.arange(0.0, 1.0, 1e-3)


def process(count: int, memory: float, random: np.random.Generator, mean: float = 0.5) -> np.ndarray:
    """x(n) = memory x(n - 1) + noise, scaled to the standard deviation 1, about a mean."""
    noise = math.sqrt(1.0 - memory**2) * random.normal(size=count + 500)
    found: np.ndarray = mean + signal.lfilter([1.0], [1.0, -memory], noise)[500:]
    return found


def noisy(memory: float) -> np.ndarray:
    found: np.ndarray = signal.lfilter([1.0], [1.0, -memory], np.random.default_rng(1).normal(size=1000))
    return found


@pytest.mark.parametrize(
    ("values", "least", "most"),
    [
        # arch 8.0.0, optimal_block_length, of the same samples
        (noisy(0.0), 1.1141416677449838, 1.1141416677449838),
        (noisy(0.9), 43.2265594687869, 43.2265594687869),
        (np.ones(50), 1.0, 1.0),
        (np.sin(np.arange(400.0)), 1.0, 60.0),  # 3 sqrt(400)
        (np.arange(30.0), 1.0, 10.0),
    ],
)
def test_block_lengths(values: np.ndarray, least: float, most: float) -> None:
    assert least * (1.0 - 1e-9) <= block_length(values) <= most * (1.0 + 1e-9)


def test_the_long_run_variance_is_that_of_the_process() -> None:
    found = long_run_variance(process(200_000, 0.8, np.random.default_rng(3)))
    assert found == pytest.approx((1.0 + 0.8) / (1.0 - 0.8), rel=0.1)


def test_resampled_means_vary_as_politis_and_romano_say() -> None:
    random = np.random.default_rng(11)
    values, length = process(60, 0.7, random), 5.0
    n, lags = values.size, np.arange(1, values.size)
    centred = values - values.mean()
    around = np.array([centred @ np.roll(centred, -k) for k in range(n)]) / n  # autocovariance, around the end
    kept = 1.0 - 1.0 / length  # chance that a block goes on
    expected = (around[0] + 2.0 * ((1.0 - lags / n) * kept**lags * around[lags]).sum()) / n
    means = [values[resampled(n, length, random)].mean() for _ in range(8_000)]
    assert np.var(means) == pytest.approx(expected, rel=0.06)
    assert np.mean(means) == pytest.approx(values.mean(), abs=0.01)


def test_the_same_process_is_equal_and_another_is_not() -> None:
    random = np.random.default_rng(0)
    time = 1e-3 * np.arange(4000)
    first, second = process(4000, 0.6, random), process(4000, 0.6, random)
    found = compared_statistics(time, first, time, second)
    assert set(found) == set(STATISTICS)
    assert all(one.equal for one in found.values())
    moved = compared_statistics(time, first, time, second + 3.0 * found["mean"].tellable)
    assert (moved["mean"].equal, moved["spread"].equal) == (False, True)
    assert moved["mean"].difference == pytest.approx(found["mean"].difference + 3.0 * found["mean"].tellable)
    assert compared_statistics(time, first, time, 1.5 * second)["spread"].equal is False
    # of many statistics each interval is wider; the seed determines all
    many, same = (compared_statistics(time, first, time, second, among=20)["mean"] for _ in range(2))
    assert 1.4 < many.tellable / found["mean"].tellable < 2.0  # of a normal distribution 1.53
    assert many == same


def test_impacts_per_second() -> None:
    random = np.random.default_rng(9)
    time = np.arange(0.0, 10.0, 1e-2)
    first, second, twice = (np.sort(random.uniform(0.0, 10.0, n)).tolist() for n in (400, 400, 800))
    equal, other = (
        compared_statistics(time, time, time, time, impacts=(first, its))[IMPACTS] for its in (second, twice)
    )
    assert equal.first == pytest.approx(40.0, rel=0.01)
    assert (equal.equal, other.equal) == (True, False)
    # Poisson processes of 400 events are known to 5 % each
    assert equal.tellable == pytest.approx(math.sqrt(2.0) * 1.96 * 2.0, rel=0.25)


def test_curves_that_do_not_vary_and_curves_that_are_too_short() -> None:
    time, short = np.arange(100.0), np.arange(60.0)
    same = compared_statistics(time, np.full(100, 0.1), time, np.full(100, 0.1))
    assert all(one.equal for one in same.values())
    other = compared_statistics(time, np.full(100, 0.1), time, np.full(100, 0.2))
    assert (other["mean"].equal, other["spread"].equal) == (False, True)
    found = compared_statistics(short, np.sin(short / 9.0), short, np.cos(short / 9.0))["mean"]
    assert (found.equal, math.isnan(found.tellable)) == (None, True)
    assert "independent pieces" in found.not_told
    assert found.difference == pytest.approx((np.cos(short / 9.0) - np.sin(short / 9.0)).mean())


@pytest.mark.parametrize(("apart", "noise", "equal"), [(0.0, 1.0, True), (0.5, 1.0, False), (5.0, 0.0, False)])
def test_a_course_that_both_follow_does_not_hide_a_difference(apart: float, noise: float, equal: bool) -> None:
    """Of two strokes of 500 mm one lies higher; blocks of a ramp alone would allow 200 mm."""
    random, time = np.random.default_rng(0), np.linspace(0.0, 2.0, 2001)
    x = np.clip(time - 0.3, 0.0, 1.0)
    first, second = (500.0 * x * x * (3.0 - 2.0 * x) + noise * random.normal(size=time.size) for _ in range(2))
    found = compared_statistics(time, first, time, second + apart)["mean"]
    assert found.equal is equal
    assert found.low <= apart <= found.high
    assert found.tellable < 0.1


@pytest.mark.slow
@pytest.mark.parametrize(
    ("count", "memory", "least"), [(300, 0.5, 88.0), (1000, 0.5, 90.0), (1000, 0.9, 85.0), (4000, 0.9, 89.0)]
)
def test_intervals_hold_the_truth_as_often_as_measured(count: int, memory: float, least: float) -> None:
    random, time = np.random.default_rng(count), np.arange(float(count))
    found = [
        compared_statistics(time, process(count, memory, random), time, process(count, memory, random), seed=n)
        for n in range(200)
    ]
    known = [one for one in found if not one["mean"].not_told]
    assert len(known) > 160
    for name in STATISTICS:
        assert sum(bool(one[name].equal) for one in known) >= least / 100.0 * len(known), name


# --- the shift in time ---


def bump(time: np.ndarray) -> np.ndarray:
    found: np.ndarray = np.exp(-(((time - 0.5) / 0.05) ** 2)) + 0.3 * np.sin(7.0 * time) * np.exp(-time)
    return found


@pytest.mark.parametrize("lag", [0.0, 0.01234, -0.1111, 250.0])
def test_a_shift_between_samples_is_determined(lag: float) -> None:
    later = SECOND + round(lag, 2)
    found = time_shift(SECOND, bump(SECOND), later, 5.0 + 3.0 * bump(later - lag))
    assert found.shift == pytest.approx(lag, abs=1e-8)
    assert found.error < 1e-8
    assert found.correlation == pytest.approx(1.0)
    assert found.is_sure


@pytest.mark.parametrize("noise", [0.01, 0.2])
def test_the_error_is_that_of_repeated_noise(noise: float) -> None:
    random = np.random.default_rng(7)
    found = [
        time_shift(
            SECOND,
            bump(SECOND) + noise * random.normal(size=SECOND.size),
            SECOND,
            bump(SECOND - 0.0123) + noise * random.normal(size=SECOND.size),
        )
        for _ in range(25)
    ]
    standard = np.array([(one.shift - 0.0123) / one.error for one in found])
    assert 0.5 < standard.std() < 2.0  # measured over 60: 1.3 to 1.4
    assert abs(standard.mean()) < 0.8


@pytest.mark.parametrize(
    ("first", "second", "most"),
    [
        (np.sin(60.0 * SECOND), np.sin(60.0 * (SECOND - 0.003)), math.inf),  # repeats itself
        (*np.random.default_rng(5).normal(size=(2, SECOND.size)), math.inf),  # not alike
        (bump(SECOND), bump(SECOND - 0.05), 0.02),  # at its limit
    ],
)
def test_a_shift_that_is_not_sure(first: np.ndarray, second: np.ndarray, most: float) -> None:
    assert not time_shift(SECOND, first, SECOND, second, most=most).is_sure


def test_what_has_no_shift_is_refused() -> None:
    with pytest.raises(InputError, match="not all equal"):
        time_shift(SECOND, bump(SECOND), SECOND, np.zeros(SECOND.size))
    with pytest.raises(InputError, match="at no shift so small"):
        time_shift(SECOND, bump(SECOND), SECOND + 9.0, bump(SECOND), most=1.0)
