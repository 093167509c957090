"""Extremes: a pull counts like a push, and what lies between records is part of the error."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn.mechanics.extremes import TOWARDS, largest, missed


def test_a_pull_counts_like_a_push() -> None:
    assert largest(np.array([30.0, -101.0, 40.0])) == 101.0


@given(
    period=st.floats(0.01, 0.3),
    phase=st.floats(0.0, 1.0),
    sign=st.sampled_from([1.0, -1.0]),
    extreme=st.sampled_from(["largest", "max"]),
)
def test_what_a_swing_has_between_its_records_is_covered(
    period: float, phase: float, sign: float, extreme: str
) -> None:
    time = np.arange(0.0, 6.0, period) + phase * period
    values = 5.0 + 2.0 * np.cos(time)
    top, context = 7.0, float(values.max())
    if 0 < values.argmax() < values.size - 1:
        word = "min" if sign < 0.0 and extreme == "max" else extreme
        assert top - context <= missed(word, sign * values, time) + 1e-9
        assert missed(word, sign * values, time) <= 2.0 * period**2  # a parabola's share, no more


def test_what_is_no_extreme_misses_nothing() -> None:
    time = np.arange(5.0)
    assert missed("mean", np.array([0.0, 1.0, 5.0, 2.0, 0.0]), time) == 0.0
    assert set(TOWARDS) == {"largest", "min", "max"}


def test_a_jump_is_no_parabola() -> None:
    time = np.arange(6.0)
    values = np.array([1.0, 1.0, 9.5, 9.0, 8.5, 8.0])  # 10 just after 1 s
    assert missed("largest", values, time, (1.0,)) == 0.5
    assert missed("largest", values, time) == pytest.approx(9.0 / 8.0)
    before = np.array([8.0, 9.0, 9.5, 1.0, 1.0, 1.0])  # the record at the break holds what was before it
    assert missed("largest", before, time, (2.0,)) == 0.0


def test_an_extreme_at_an_end_is_a_record() -> None:
    assert missed("max", np.array([1.0, 2.0, 3.0]), np.arange(3.0)) == 0.0
    assert math.isfinite(missed("min", np.array([4.0]), np.zeros(1)))
