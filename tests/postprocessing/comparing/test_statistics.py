"""The stationary bootstrap against closed forms and another program; how often its intervals hold the truth."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import signal

from support_exudyn.postprocessing.comparing.bootstrap import block_length, long_run_variance, resampled
from support_exudyn.postprocessing.comparing.statistics import IMPACTS, STATISTICS, compared_statistics
from user_forces import InputError

NORMAL_95 = 1.6448536269514722  # quantile of the normal distribution


def process(count: int, memory: float, random: np.random.Generator, mean: float = 0.5) -> np.ndarray:
    """x(n) = memory x(n - 1) + noise, scaled to the standard deviation 1, about a mean."""
    noise = math.sqrt(1.0 - memory**2) * random.normal(size=count + 500)
    found: np.ndarray = mean + signal.lfilter([1.0], [1.0, -memory], noise)[500:]
    return found


def truths(mean: float = 0.5) -> dict[str, float]:
    return {"mean": mean, "rms": math.hypot(mean, 1.0), "spread": 1.0, "quantile_95": mean + NORMAL_95}


@pytest.mark.parametrize(("memory", "expected"), [(0.0, 1.1141416677449838), (0.9, 43.2265594687869)])
def test_block_lengths_are_those_of_another_program(memory: float, expected: float) -> None:
    # arch 8.0.0, optimal_block_length, of the same samples
    noise = np.random.default_rng(1).normal(size=1000)
    assert block_length(signal.lfilter([1.0], [1.0, -memory], noise)) == pytest.approx(expected, rel=1e-9)


def test_block_lengths_have_bounds() -> None:
    assert block_length(np.ones(50)) == 1.0
    wave = np.sin(np.arange(400.0))
    assert block_length(wave) <= 60.0  # 3 sqrt(400)
    assert block_length(np.arange(30.0)) <= 10.0


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


def test_blocks_are_as_long_as_asked() -> None:
    at = resampled(100_000, 25.0, np.random.default_rng(2))
    ends = np.count_nonzero(np.diff(at) % at.size != 1) + 1
    assert at.size / ends == pytest.approx(25.0, rel=0.05)


def test_the_same_process_is_equal_and_another_is_not() -> None:
    random = np.random.default_rng(0)
    time = 1e-3 * np.arange(4000)
    first, second = process(4000, 0.6, random), process(4000, 0.6, random)
    found = compared_statistics(time, first, time, second)
    assert set(found) == set(STATISTICS)
    assert all(one.equal for one in found.values())
    moved = compared_statistics(time, first, time, second + 3.0 * found["mean"].tellable)
    assert moved["mean"].equal is False
    assert moved["spread"].equal is True
    assert moved["mean"].difference.value == pytest.approx(
        found["mean"].difference.value + 3.0 * found["mean"].tellable
    )
    wider = compared_statistics(time, first, time, 1.5 * second)
    assert wider["spread"].equal is False


def test_the_seed_determines_all() -> None:
    random = np.random.default_rng(6)
    time, values = np.arange(300.0), process(300, 0.3, random)
    one, same, other = (compared_statistics(time, values, time, values[::-1], seed=seed) for seed in (1, 1, 2))
    assert one == same
    assert one["mean"].difference.low != other["mean"].difference.low
    assert one["mean"].difference.low == pytest.approx(other["mean"].difference.low, rel=0.2)


def test_of_many_statistics_each_interval_is_wider() -> None:
    time, values = np.arange(500.0), process(500, 0.3, np.random.default_rng(8))
    one, many = (compared_statistics(time, values, time, -values, among=among)["mean"] for among in (1, 20))
    assert many.confidence == pytest.approx(0.95 ** (1 / 20))
    assert 1.4 < many.tellable / one.tellable < 2.0  # of a normal distribution 1.53


def test_impacts_per_second() -> None:
    random = np.random.default_rng(9)
    time = np.arange(0.0, 10.0, 1e-2)
    first, second, twice = (np.sort(random.uniform(0.0, 10.0, n)) for n in (400, 400, 800))
    found = compared_statistics(time, time, time, time, first_impacts=first, second_impacts=second)[IMPACTS]
    assert found.first.value == pytest.approx(40.0, rel=0.01)
    assert found.equal
    # a Poisson process of 400 events is known to 5 %
    assert found.first.high - found.first.value == pytest.approx(1.96 * 2.0, rel=0.25)
    assert (
        compared_statistics(time, time, time, time, first_impacts=first, second_impacts=twice)[IMPACTS].equal
        is False
    )


def test_curves_that_do_not_vary() -> None:
    time = np.arange(100.0)
    same = compared_statistics(time, np.full(100, 0.1), time, np.full(100, 0.1))
    assert all(one.equal for one in same.values())
    other = compared_statistics(time, np.full(100, 0.1), time, np.full(100, 0.2))
    assert other["mean"].equal is False
    assert other["spread"].equal is True


def test_too_short_curves_have_no_interval() -> None:
    time = np.arange(60.0)
    found = compared_statistics(time, np.sin(time / 9.0), time, np.cos(time / 9.0))["mean"]
    assert found.equal is None
    assert math.isnan(found.tellable)
    assert "independent pieces" in found.not_told
    assert found.difference.value == pytest.approx((np.cos(time / 9.0) - np.sin(time / 9.0)).mean())


@pytest.mark.parametrize(("apart", "noise", "equal"), [(0.0, 1.0, True), (0.5, 1.0, False), (5.0, 0.0, False)])
def test_a_course_that_both_follow_does_not_hide_a_difference(apart: float, noise: float, equal: bool) -> None:
    """Of two strokes of 500 mm the one of which lies higher; blocks of a ramp alone would tell 200 mm."""
    random, time = np.random.default_rng(0), np.linspace(0.0, 2.0, 2001)
    x = np.clip(time - 0.3, 0.0, 1.0)
    first, second = (500.0 * x * x * (3.0 - 2.0 * x) + noise * random.normal(size=time.size) for _ in range(2))
    found = compared_statistics(time, first, time, second + apart)["mean"]
    assert found.equal is equal
    assert found.difference.low <= apart <= found.difference.high
    assert found.tellable < 0.1


def test_a_confidence_that_is_none_is_refused() -> None:
    for confidence, among in ((1.0, 1), (0.0, 1), (0.95, 0)):
        with pytest.raises(InputError, match="between 0 and 1"):
            compared_statistics(
                np.arange(9.0), np.zeros(9), np.arange(9.0), np.zeros(9), confidence=confidence, among=among
            )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("count", "memory", "least"), [(300, 0.5, 88.0), (1000, 0.5, 90.0), (1000, 0.9, 85.0), (4000, 0.9, 89.0)]
)
def test_intervals_hold_the_truth_as_often_as_measured(count: int, memory: float, least: float) -> None:
    random, tries, time = np.random.default_rng(count), 200, np.arange(float(count))
    held = dict.fromkeys(STATISTICS, 0)
    equal = dict.fromkeys(STATISTICS, 0)
    told = 0
    for n in range(tries):
        first, second = process(count, memory, random), process(count, memory, random)
        found = compared_statistics(time, first, time, second, seed=n)
        if found["mean"].not_told:
            continue
        told += 1
        for name, truth in truths().items():
            held[name] += found[name].first.low <= truth <= found[name].first.high
            equal[name] += bool(found[name].equal)
    assert told > 0.8 * tries
    assert min(held.values()) >= least / 100.0 * told, held
    assert min(equal.values()) >= least / 100.0 * told, equal
