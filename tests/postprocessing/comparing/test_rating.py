"""The objective rating: numbers of another program, and what must hold for any curve."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from support_exudyn.postprocessing.comparing.rating import iso_rating, warped
from tests.often import often

LONG, SHORT = np.arange(0.0, 0.2, 1e-4), np.arange(0.0, 0.1, 1e-4)


def gauss(centre: float, width: float) -> np.ndarray:
    found: np.ndarray = np.exp(-(((SHORT - centre) / width) ** 2))
    return found


# objective-rating-metrics 1.3 (TU Graz): overall, corridor, phase, magnitude, slope
CASES = {
    "a sine that is larger and late": (
        LONG,
        np.sin(40.0 * LONG),
        1.1 * np.sin(40.0 * (LONG - 0.004)),
        (0.851888641521, 0.725618249759, 0.9, 0.958206708089, 0.95),
    ),
    "a pulse that is lower, wider and late": (
        SHORT,
        gauss(0.03, 0.01),
        0.8 * gauss(0.036, 0.013) - 0.1 * gauss(0.07, 0.01),
        (0.733896691005, 0.721557168392, 0.7, 0.784583430621, 0.74178568762),
    ),
    "a pulse that is higher and early": (
        SHORT,
        gauss(0.05, 0.01),
        1.3 * gauss(0.042, 0.012),
        (0.72620812782, 0.679954905722, 0.6, 0.835944267144, 0.835186560513),
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_scores_are_those_of_another_program(case: str) -> None:
    time, reference, other, expected = CASES[case]
    assert iso_rating(time, reference, other)[:5] == pytest.approx(expected, abs=1e-9)


def test_a_curve_is_like_itself() -> None:
    found = iso_rating(LONG, np.sin(40.0 * LONG), np.sin(40.0 * LONG))
    assert found[:5] == (1.0, 1.0, 1.0, 1.0, 1.0)


@settings(max_examples=often(30))
@given(
    values=arrays(np.float64, (2, 9), elements=st.floats(-9.0, 9.0)),
    window=st.integers(0, 9),
)
def test_warping_is_the_best_of_all_paths(values: np.ndarray, window: int) -> None:
    one, other = warped(values[0], values[1], window)
    # by the textbook's recursion
    costs = np.full((10, 10), math.inf)
    costs[0, 0] = 0.0
    for i in range(9):
        for j in range(max(0, i - window), min(9, i + window + 1)):
            before = min(costs[i, j + 1], costs[i + 1, j], costs[i, j])
            costs[i + 1, j + 1] = before + (values[0, i] - values[1, j]) ** 2
    assert ((one - other) ** 2).sum() == pytest.approx(costs[9, 9], abs=1e-9)
    assert (one[0], other[-1]) == (values[0, 0], values[1, -1])


@pytest.mark.parametrize(
    ("time", "reference", "said"),
    [
        (LONG, np.ones(LONG.size), "constant"),
        (SHORT * 100.0, SHORT, "they have 9.99"),
        (SHORT, np.full(SHORT.size, np.nan), "they have 0"),
    ],
)
def test_what_has_no_rating_says_why(time: np.ndarray, reference: np.ndarray, said: str) -> None:
    found = iso_rating(time, reference, time)
    assert math.isnan(found.overall)
    assert said in found.not_told["overall"]
