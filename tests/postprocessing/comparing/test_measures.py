"""Measures of two curves against closed forms, scipy and what must not change them; curves that have none."""

from __future__ import annotations

import math
import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import integrate, stats

from support_exudyn.postprocessing.comparing.measures import CurveMeasures, curve_measures
from user_forces import InputError

PERIOD = np.linspace(0.0, 2.0 * np.pi, 20_001)
curves = arrays(np.float64, 12, elements=st.floats(-1e3, 1e3).map(lambda x: round(x, 3)))
steps = arrays(np.float64, 12, elements=st.floats(0.01, 10.0))


def numbers(found: CurveMeasures) -> dict[str, float]:
    return {name: item for name, item in found._asdict().items() if isinstance(item, float)}


@pytest.mark.parametrize("factor", [0.5, 1.0, 1.1])
@pytest.mark.parametrize("lag", [0.0, 1e-7, 0.2, np.pi])
def test_a_sine_that_is_larger_and_lags(factor: float, lag: float) -> None:
    found = curve_measures(PERIOD, np.sin(PERIOD), factor * np.sin(PERIOD - lag))
    assert found.magnitude_error == pytest.approx(factor - 1.0, abs=1e-9)
    # a period's mean of r c is cos(lag) / 2; a lag of 1e-7 is told, which arccos would lose
    assert found.phase_error == pytest.approx(lag / np.pi, rel=1e-6, abs=1e-12)
    assert found.combined_error == pytest.approx(math.hypot(factor - 1.0, lag / np.pi), abs=1e-9)
    # mean of d^2, doubled: 1 + factor^2 - 2 factor cos(lag)
    apart = (1.0 - factor) ** 2 + 4.0 * factor * math.sin(lag / 2.0) ** 2
    assert found.rms == pytest.approx(math.sqrt(apart / 2.0), rel=1e-6, abs=1e-12)
    assert found.rms_of_range == pytest.approx(found.rms / 2.0)
    assert found.r_squared == pytest.approx(1.0 - apart, abs=1e-9)
    assert found.spread_other == pytest.approx(factor / math.sqrt(2.0))
    assert abs(found.peak_other.value) == pytest.approx(factor, rel=1e-6)
    assert (found.times, found.left_out, found.not_told) == (PERIOD.size, 0, {})


def test_signs_and_times() -> None:
    time = np.array([0.0, 1.0, 2.0, 4.0])
    found = curve_measures(time, np.array([0.0, -5.0, 3.0, 0.0]), np.array([1.0, -8.0, 3.0, 0.0]))
    assert (found.largest, found.largest_time, found.largest_of_range) == (-3.0, 1.0, 3.0 / 8.0)
    assert found.peak_reference == (-5.0, 1.0)
    assert found.peak_other == (-8.0, 1.0)
    # trapezoids over unequal intervals: d = 1, -3, 0, 0
    assert found.mean_difference == pytest.approx((-1.0 - 1.5 + 0.0) / 4.0)


@given(reference=curves, other=curves, gaps=steps)
def test_integrals_are_trapezoids(reference: np.ndarray, other: np.ndarray, gaps: np.ndarray) -> None:
    time = np.cumsum(gaps)
    found = curve_measures(time, reference, other)

    def mean(values: np.ndarray) -> float:
        return float(integrate.trapezoid(values, time) / (time[-1] - time[0]))

    close = {"rel": 1e-9, "abs": 1e-9}
    assert found.mean_other == pytest.approx(mean(other), **close)
    assert found.rms == pytest.approx(math.sqrt(mean((other - reference) ** 2)), **close)
    # its parts add up: rms^2 = mean^2 + spread^2
    assert found.rms == pytest.approx(math.hypot(found.mean_difference, found.spread_difference), **close)
    if found.spread_reference > 1e-6:
        spread = mean((reference - mean(reference)) ** 2)
        assert found.r_squared == pytest.approx(1.0 - found.rms**2 / spread, rel=1e-6)
    assert abs(found.largest) == np.abs(other - reference).max()
    assert found.largest == (other - reference)[np.abs(other - reference).argmax()]


def test_of_even_samples_the_coefficient_of_determination_is_that_of_a_regression() -> None:
    random = np.random.default_rng(0)
    other = random.normal(size=20_000)
    reference = 3.0 * other + random.normal(size=other.size)
    line = stats.linregress(other, reference)
    found = curve_measures(np.arange(other.size, dtype=float), reference, line.slope * other + line.intercept)
    assert found.r_squared == pytest.approx(line.rvalue**2, abs=1e-4)


@given(reference=curves, other=curves, gaps=steps, power=st.integers(-1000, 900))
def test_no_unit_changes_what_has_none(
    reference: np.ndarray, other: np.ndarray, gaps: np.ndarray, power: int
) -> None:
    time = np.cumsum(gaps)
    one, scaled = (curve_measures(time, np.ldexp(reference, n), np.ldexp(other, n)) for n in (0, power))
    for name in ("largest_of_range", "rms_of_range", "r_squared", "magnitude_error", "phase_error"):
        np.testing.assert_allclose(getattr(scaled, name), getattr(one, name), rtol=1e-12)
    assert dict(scaled.not_told) == dict(one.not_told)


@given(reference=curves, other=curves, gaps=steps)
def test_bounds(reference: np.ndarray, other: np.ndarray, gaps: np.ndarray) -> None:
    found = curve_measures(np.cumsum(gaps), reference, other)
    assert not found.phase_error < 0.0
    assert not found.phase_error > 1.0
    assert not found.r_squared > 1.0
    assert not found.magnitude_error < -1.0
    missing = {name for name, number in numbers(found).items() if math.isnan(number)}
    assert missing == set(found.not_told)


@pytest.mark.parametrize(
    ("time", "reference", "other", "missing"),
    [
        ([0, 1, 2], [3, 3, 3], [1, 2, 3], {"largest_of_range", "rms_of_range", "r_squared"}),
        (
            [0, 1],
            [0, 0],
            [1, 2],
            {
                "largest_of_range",
                "rms_of_range",
                "r_squared",
                "magnitude_error",
                "phase_error",
                "combined_error",
            },
        ),
        ([0, 1], [1, 2], [0, 0], {"phase_error", "combined_error"}),
        ([0, 1], [1, 2], [2, 4], set()),
        ([5], [1], [3], None),
        ([0, 1, 2, 3], [1, np.nan, 2, 2], [1, 1, np.inf, 2], None),
        ([0, 1], [np.nan, 1], [1, np.nan], "all"),
        ([], [], [], "all"),
    ],
)
def test_what_has_no_value_says_why(
    time: list[float], reference: list[float], other: list[float], missing: set[str] | str | None
) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = curve_measures(*(np.array(one, dtype=float) for one in (time, reference, other)))
    absent = {name for name, number in numbers(found).items() if math.isnan(number)}
    if missing == "all":
        assert absent | {"peak_reference", "peak_other"} == set(found.not_told)
        assert found.times == 0
        return
    assert absent == set(found.not_told)
    if missing is None:  # known at single times: what is no integral is told
        assert not {"largest", "largest_time"} & absent
        assert {"rms", "mean_reference", "spread_other", "phase_error"} <= absent
    else:
        assert absent == missing


def test_what_is_not_known_is_left_out() -> None:
    time = np.array([0.0, 1.0, 2.0, 3.0, 4.0])
    other = np.array([1.0, 1.0, np.nan, 3.0, 3.0])
    found = curve_measures(time, np.zeros(5), other)
    assert (found.times, found.left_out) == (4, 1)
    assert found.mean_other == 2.0  # of the intervals 0 to 1 and 3 to 4
    assert found.spread_other == 1.0


def test_curves_of_other_lengths_are_refused() -> None:
    with pytest.raises(InputError, match=r"shapes \[\(3,\), \(3,\), \(2,\)\]"):
        curve_measures(np.arange(3.0), np.zeros(3), np.zeros(2))
    with pytest.raises(InputError, match="do not increase"):
        curve_measures(np.array([0.0, 0.0]), np.zeros(2), np.zeros(2))
