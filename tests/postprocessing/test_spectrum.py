"""Spectra of signals whose amplitudes and frequencies are known, and against scipy's."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import fft

from support_exudyn import Result
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.spectrum import equally_spaced, force_spectrum, spectrum
from tests import figure_checks, synthetic
from tests.cases.run_cases import FORCE, support

SPACING = 1e-3  # [s]
TIME = np.arange(4000) * SPACING


def tone(frequency: float, amplitude: float) -> np.ndarray:
    return amplitude * np.sin(2.0 * np.pi * frequency * TIME + 0.3)


def run(values: np.ndarray, time: np.ndarray = TIME) -> Result:
    return synthetic.result(support(), time, {FORCE: (values, "N")})


@given(frequency=st.integers(5, 490), amplitude=st.floats(1e-3, 1e6))
def test_a_tone_has_its_amplitude_at_its_frequency(frequency: int, amplitude: float) -> None:
    found = spectrum(TIME, tone(float(frequency), amplitude))
    highest = int(np.argmax(found.amplitude))
    assert found.frequency[highest] == pytest.approx(frequency)
    # frequencies of whole numbers lie on a bin; the trend of a piece is up to half a percent of it
    assert found.amplitude[highest] == pytest.approx(amplitude, rel=5e-3)


def test_one_piece_is_the_fourier_transform_of_what_the_window_leaves() -> None:
    values = tone(40.0, 2.0) + np.random.default_rng(2).normal(size=TIME.size)
    found = spectrum(TIME, values, segments=1)
    slope, level = np.polyfit(TIME, values, 1)
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(TIME.size) / TIME.size)
    transformed = fft.rfft(window * (values - slope * TIME - level))
    expected = 2.0 * np.abs(transformed) / window.sum()
    # two ways to fit a straight line and to sum; the ends of the range, which have no mirror, are not compared
    assert found.amplitude[1:-1] == pytest.approx(expected[1:-1], rel=1e-6, abs=1e-9)
    assert found.averaged == 1


def test_records_off_the_grid_are_interpolated_and_a_last_one_left_out() -> None:
    values, spacing, resampled = equally_spaced(np.append(TIME, TIME[-1] + 0.3e-3), np.append(TIME, 7.0))
    assert (spacing, resampled) == (pytest.approx(SPACING), False)
    assert values == pytest.approx(TIME)
    uneven = np.sort(np.append(TIME, 1.2345))  # a record at a break
    values, spacing, resampled = equally_spaced(uneven, 3.0 * uneven)
    assert resampled
    assert values == pytest.approx(3.0 * (np.arange(values.size) * spacing))


def test_the_figure_shows_amplitudes_with_units_and_the_highest_peak() -> None:
    drawing = force_spectrum(run(5e3 + tone(64.0, 3e3)))
    axes = drawing.axes[0]
    curve = axes.lines[0]
    n = int(np.argmax(curve.get_ydata()))
    assert curve.get_xdata()[n] == pytest.approx(64.0)
    assert curve.get_ydata()[n] == pytest.approx(3.0, rel=5e-3)  # as above
    assert curve.get_color() == style.IDEAL
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("frequency [Hz]", "amplitude [kN]")
    legend = axes.get_legend()
    assert legend is not None
    assert legend.get_texts()[0].get_text().startswith("A: 64 ± 0.5 Hz, 3")
    assert "aliasing" in figure_checks.words_below(drawing)
    assert "500 Hz" in figure_checks.words_below(drawing)
