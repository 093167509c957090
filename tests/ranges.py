"""Ranges of numbers for hypothesis."""

from __future__ import annotations

from hypothesis import strategies as st

from user_forces.values.value import LARGEST


def from_zero(high: float) -> st.SearchStrategy[float]:
    """Numbers from 0 to this as values take them: 0, or not next to it."""
    return st.just(0.0) | st.floats(1.0 / LARGEST, high)
