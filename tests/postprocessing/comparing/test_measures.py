"""Measures of two curves against closed forms and scipy, curves at common times, statistics, shifts in time."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import integrate, signal, stats

from support_exudyn.postprocessing.comparing.compared_channel import ComparedColumn, compared
from support_exudyn.postprocessing.comparing.measures import (
    STATISTICS,
    CurveMeasures,
    compared_statistics,
    curve_measures,
    interpolated,
    on_common_times,
    time_shift,
)
from user_forces import InputError

PERIOD = np.linspace(0.0, 2.0 * np.pi, 20_001)
FINE, COARSE = np.linspace(0.0, 1.0, 1001), np.linspace(-0.05, 0.95, 42)
NAN = math.nan
curves = arrays(np.float64, 12, elements=st.floats(-1e3, 1e3).map(lambda x: round(x, 3)))
steps = arrays(np.float64, 12, elements=st.floats(0.01, 10.0))


def missing(measures: CurveMeasures) -> set[str]:
    return {name for name, item in measures._asdict().items() if isinstance(item, float) and math.isnan(item)}


@pytest.mark.parametrize("factor", [0.5, 1.0, 1.1])
@pytest.mark.parametrize("lag", [0.0, 1e-7, 0.2, np.pi])
def test_a_sine_that_is_larger_and_lags(factor: float, lag: float) -> None:
    found = curve_measures(PERIOD, np.sin(PERIOD), factor * np.sin(PERIOD - lag))
    assert found.magnitude_error == pytest.approx(factor - 1.0, abs=1e-9)
    # a period's mean of r c is cos(lag) / 2; a lag of 1e-7 shows, which arccos would lose
    assert found.phase_error == pytest.approx(lag / np.pi, rel=1e-6, abs=1e-12)
    assert found.combined_error == pytest.approx(math.hypot(factor - 1.0, lag / np.pi), abs=1e-9)
    # mean of d^2, doubled: 1 + factor^2 - 2 factor cos(lag)
    apart = (1.0 - factor) ** 2 + 4.0 * factor * math.sin(lag / 2.0) ** 2
    assert found.rms == pytest.approx(math.sqrt(apart / 2.0), rel=1e-6, abs=1e-12)
    assert found.rms_of_range == pytest.approx(found.rms / 2.0)
    assert found.r_squared == pytest.approx(1.0 - apart, abs=1e-9)
    assert (found.times, missing(found)) == (PERIOD.size, set())


@given(reference=curves, other=curves, gaps=steps)
def test_integrals_are_trapezoids(reference: np.ndarray, other: np.ndarray, gaps: np.ndarray) -> None:
    time = np.cumsum(gaps)
    found = curve_measures(time, reference, other)

    def mean(values: np.ndarray) -> float:
        return float(integrate.trapezoid(values, time) / (time[-1] - time[0]))

    close = {"rel": 1e-9, "abs": 1e-9}
    assert found.mean_other == pytest.approx(mean(other), **close)
    assert found.rms == pytest.approx(math.sqrt(mean((other - reference) ** 2)), **close)
    spread = mean((reference - mean(reference)) ** 2)
    if spread > 1e-12:
        assert found.r_squared == pytest.approx(1.0 - found.rms**2 / spread, rel=1e-6)
    where = np.abs(other - reference).argmax()
    assert (found.largest, found.largest_time) == ((other - reference)[where], time[where])


OF_RANGE = {"rms_of_range", "r_squared"}
PHASE = {"phase_error", "combined_error"}


@pytest.mark.parametrize(
    ("time", "reference", "other", "absent"),
    [
        ([0, 1, 2], [3, 3, 3], [1, 2, 3], OF_RANGE),
        ([0, 1], [0, 0], [1, 2], OF_RANGE | PHASE | {"magnitude_error"}),
        ([0, 1], [1, 2], [0, 0], PHASE),
        ([0, 1], [1, 2], [2, 4], set()),
        # known at single times: no integral has a value
        ([5], [1], [3], {"rms", "mean_reference", "phase_error"}),
        ([0, 1, 2, 3], [1, NAN, 2, 2], [1, 1, np.inf, 2], {"rms", "mean_reference"}),
        ([0, 1], [NAN, 1], [1, NAN], {"largest", "largest_time", "rms"}),
        ([], [], [], {"largest", "largest_time", "rms"}),
    ],
)
def test_what_has_no_value_is_nan(
    time: list[float], reference: list[float], other: list[float], absent: set[str]
) -> None:
    found = curve_measures(*(np.array(one, dtype=float) for one in (time, reference, other)))
    if "rms" in absent:
        assert absent <= missing(found)
        assert ("largest" in absent) == math.isnan(found.largest)
    else:
        assert absent == missing(found)


@pytest.mark.parametrize(
    ("work", "said"),
    [
        (lambda: curve_measures(FINE[:3], FINE[:3], FINE[:2]), r"shapes \[\(3,\), \(3,\), \(2,\)\]"),
        (lambda: curve_measures(np.zeros(2), np.zeros(2), np.zeros(2)), "do not increase"),
        (lambda: on_common_times(FINE, FINE, FINE + 5.0, FINE), "s: none lies where both"),
        (lambda: on_common_times(FINE, FINE, FINE, FINE, 2.0, 3.0), "none lies .*between 2 and 3 s"),
        (lambda: on_common_times(FINE, FINE, FINE[:0], FINE[:0]), r"\(none\)"),
    ],
)
def test_what_cannot_be_compared_is_refused(work: object, said: str) -> None:
    with pytest.raises(InputError, match=said):
        work()  # type: ignore[operator]


# --- common times ---


def test_equal_times_are_used_as_they_are() -> None:
    one, other = np.random.default_rng(1).normal(size=(2, FINE.size))
    found = on_common_times(FINE, one, FINE + 3e-10, other)
    np.testing.assert_array_equal(found.reference, one)
    np.testing.assert_array_equal(found.other, other)
    assert not found.interpolation_error.any()


@pytest.mark.parametrize("swapped", [False, True])
def test_the_times_are_those_of_the_coarser(swapped: bool) -> None:
    fine, coarse = (FINE, np.cos(9.0 * FINE)), (COARSE, np.sin(9.0 * COARSE))
    found = on_common_times(*coarse, *fine) if swapped else on_common_times(*fine, *coarse)
    np.testing.assert_array_equal(found.time, COARSE[COARSE >= 0.0])
    mine, its = (found.other, found.reference) if swapped else (found.reference, found.other)
    np.testing.assert_array_equal(its, np.sin(9.0 * found.time))
    wrong = np.abs(mine - np.cos(9.0 * found.time))
    assert wrong.max() > 1e-6
    # a straight line errs by h^2 f''/8 = 1e-5 at most; f'' changes by 0.7 from record to record
    assert (wrong <= found.interpolation_error + 1e-6 * 0.729 / 8.0).all()
    assert found.interpolation_error.max() < 2e-5


@pytest.mark.parametrize(
    ("values", "at", "expected", "error"),
    [
        # of a jump of 8 per interval twice, half of the second difference
        ([0, 0, 0, 8, 8, 8], [2.5, 4.5], [4, 8], [1, 0]),
        ([0, NAN, 2, 3, 3, 3], [0.5, 2.0, 4.5], [NAN, 2, 3], [NAN, 0, 0]),
    ],
)
def test_the_error_of_interpolation(
    values: list[float], at: list[float], expected: list[float], error: list[float]
) -> None:
    found, wrong = interpolated(np.arange(6.0), np.array(values, dtype=float), np.array(at))
    np.testing.assert_allclose(found, expected)
    np.testing.assert_allclose(wrong, error)


# --- statistics ---

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
    drawn = ([process(count, memory, random) for _ in range(2)] for _ in range(200))
    found = [compared_statistics(*pair) for pair in drawn]
    for name in STATISTICS:
        assert sum(bool(each[name].equal) for each in found) >= least / 100.0 * len(found), name


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


# --- rows ---


def test_the_largest_difference_is_shown_and_the_record_beyond_its_error_decides() -> None:
    time = np.linspace(0.0, 1.0, 11)
    apart, errors = np.full(11, 1e-3), np.full(11, 2e-3)
    apart[7], errors[7] = 5e-3, 1e-2  # the largest, within its error
    errors[2] = 1e-5  # a hundred times its error
    reference = ComparedColumn("m", time, np.zeros(11), np.zeros(11))
    other = ComparedColumn("m", time, apart, errors)
    largest = next(row for row in compared("x", reference, other).rows if row.measure == "largest")
    assert (largest.time, largest.difference, largest.error) == (time[7], 5e-3, 1e-2)
    assert largest.verdict == "differs"
    assert f"at {time[2]:g} s" in largest.reason
