"""Roots between two places: the same as scipy's, to the bit."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from tests.often import often
from user_forces.expressions.roots import bracketed_root

SHAPES: dict[str, Callable[[float], float]] = {
    "line": lambda x: x,
    "cubic": lambda x: x**3,
    "root": lambda x: math.copysign(abs(x) ** 0.5, x),
    "bend": lambda x: math.expm1(5.0 * x),
    "step": lambda x: math.copysign(1.0, x),
    "wave": lambda x: x + 0.3 * math.sin(20.0 * x),
    "flat": lambda x: x**21,
}
near = st.floats(1e-6, 10.0)


@pytest.mark.parametrize("shape", SHAPES)
@given(place=st.floats(-5.0, 5.0), below=near, above=near, xtol=st.sampled_from([1e-18, 2e-12, 1e-3]))
@settings(max_examples=often(100))
def test_a_root_is_that_of_scipy_to_the_bit(
    shape: str, place: float, below: float, above: float, xtol: float
) -> None:
    def tried(method: Callable[..., float]) -> tuple[float | None, list[float]]:
        """The root, None if a method gives up, and all places at which it asks."""
        places = []

        def function(x: float) -> float:
            places.append(x)
            return SHAPES[shape](x - place)

        try:
            return method(function, place - below, place + above, xtol=xtol), places
        except RuntimeError:
            return None, places

    assert tried(bracketed_root) == tried(brentq)


def test_an_end_may_be_the_root() -> None:
    assert bracketed_root(lambda x: x, 0.0, 1.0) == bracketed_root(lambda x: x, -1.0, 0.0) == 0.0


def test_what_has_no_root_between_is_refused() -> None:
    with pytest.raises(ValueError, match="signs"):
        bracketed_root(lambda x: x * x + 1.0, -1.0, 1.0)
    with pytest.raises(ValueError, match="no number at 0"):
        bracketed_root(lambda x: math.nan if abs(x) < 0.5 else x, -1.0, 1.0)
    with pytest.raises(RuntimeError, match="no root after 100 steps"):
        bracketed_root(lambda x: math.copysign(1.0, x), -1e300, 1e-300, xtol=1e-310)
