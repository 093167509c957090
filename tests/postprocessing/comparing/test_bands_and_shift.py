"""Spectrum in bands by Parseval's theorem, and the shift in time by correlation, against what is known."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import signal

from support_exudyn.postprocessing.comparing.bands import band_rms, octaves
from support_exudyn.postprocessing.comparing.correlation import lagged_correlations
from support_exudyn.postprocessing.comparing.shift import time_shift
from user_forces import InputError

SECOND = np.arange(0.0, 1.0, 1e-3)


def test_tones_lie_in_their_bands() -> None:
    curve = 5.0 + 3.0 * np.sin(2.0 * np.pi * 20.0 * SECOND) + 0.4 * np.cos(2.0 * np.pi * 250.0 * SECOND)
    found = band_rms(SECOND, curve, [10.0, 100.0])
    np.testing.assert_allclose(found.edges, [0.0, 10.0, 100.0, 500.0])
    # the straight line that is taken off leaves a little of itself in all bands
    assert found.rms[1] == pytest.approx(3.0 / math.sqrt(2.0), rel=2e-3)
    assert found.rms[2] == pytest.approx(0.4 / math.sqrt(2.0), rel=2e-2)
    assert found.rms[0] < 0.1


def test_a_line_has_no_frequency() -> None:
    found = band_rms(SECOND, 7.0 * SECOND + 1.0)
    assert found.line == pytest.approx(7.0 * SECOND.std())
    assert found.rms.max() < 1e-12


@given(
    values=arrays(np.float64, st.integers(4, 40), elements=st.floats(-100.0, 100.0)),
    edges=st.lists(st.floats(1.0, 499.0), max_size=5, unique=True),
)
def test_squares_add_up_to_the_variance(values: np.ndarray, edges: list[float]) -> None:
    found = band_rms(SECOND[: values.size], values, sorted(edges))
    assert found.total == pytest.approx(values.std(), rel=1e-9, abs=1e-9)
    assert found.rms.size == found.edges.size - 1


def test_white_noise_fills_bands_by_their_width() -> None:
    noise = np.random.default_rng(4).normal(size=200_000)
    found = band_rms(1e-3 * np.arange(noise.size), noise, [100.0, 200.0, 400.0])
    np.testing.assert_allclose(found.rms**2, [0.2, 0.2, 0.4, 0.2], rtol=0.02)
    # Welch's estimate of the same
    frequency, density = signal.welch(noise, 1e3, nperseg=4096)
    inside = (frequency >= 200.0) & (frequency < 400.0)
    assert found.rms[2] ** 2 == pytest.approx(density[inside].sum() * frequency[1], rel=0.02)


def test_octaves_are_those_of_the_standard() -> None:
    np.testing.assert_allclose(octaves(10.0, 100.0), 1000.0 / math.sqrt(2.0) / 2.0 ** np.array([6, 5, 4, 3]))


def test_bad_edges_are_refused() -> None:
    for edges in ([20.0, 10.0], [-1.0], [math.nan], [600.0]):
        with pytest.raises(InputError, match="increasing"):
            band_rms(SECOND, SECOND, edges)
    with pytest.raises(InputError, match="at least 4"):
        band_rms(SECOND[:3], SECOND[:3])


@given(lag=st.integers(-6, 6), first=arrays(np.float64, 12, elements=st.floats(-9.0, 9.0)))
def test_correlations_are_those_of_numpy(lag: int, first: np.ndarray) -> None:
    second = np.random.default_rng(2).normal(size=15)
    found = lagged_correlations(first, second, np.array([lag]))[0]
    pairs = [(first[i], second[i + lag]) for i in range(12) if 0 <= i + lag < 15]
    one, other = np.array(pairs).T
    if np.isnan(found) or one.std() < 1e-4:
        assert one.std() < 1e-3
    else:
        assert found == pytest.approx(np.corrcoef(one, other)[0, 1], abs=1e-6)


def bump(time: np.ndarray) -> np.ndarray:
    found: np.ndarray = np.exp(-(((time - 0.5) / 0.05) ** 2)) + 0.3 * np.sin(7.0 * time) * np.exp(-time)
    return found


@pytest.mark.parametrize("lag", [0.0, 0.01234, -0.1111, 250.0])
def test_a_shift_between_samples_is_found(lag: float) -> None:
    found = time_shift(
        SECOND, bump(SECOND), SECOND + round(lag, 2), 5.0 - 3.0 * -bump(SECOND + round(lag, 2) - lag)
    )
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


def test_curves_that_repeat_themselves_have_no_sure_shift() -> None:
    found = time_shift(SECOND, np.sin(60.0 * SECOND), SECOND, np.sin(60.0 * (SECOND - 0.003)))
    assert found.next_best > 0.9
    assert not found.is_sure


def test_curves_that_are_not_alike_have_no_sure_shift() -> None:
    noise = np.random.default_rng(5).normal(size=(2, SECOND.size))
    assert not time_shift(SECOND, noise[0], SECOND, noise[1]).is_sure


def test_a_shift_at_its_limit_is_not_sure() -> None:
    found = time_shift(SECOND, bump(SECOND), SECOND, bump(SECOND - 0.05), most=0.02)
    assert found.at_limit
    assert not found.is_sure


def test_what_has_no_shift_is_refused() -> None:
    with pytest.raises(InputError, match="not all equal"):
        time_shift(SECOND, bump(SECOND), SECOND, np.zeros(SECOND.size))
    with pytest.raises(InputError, match="at no shift so small"):
        time_shift(SECOND, bump(SECOND), SECOND + 9.0, bump(SECOND), most=1.0)
