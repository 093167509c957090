"""An estimate is printed to the first digit of its error."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn.simulation.estimate import Estimate


@pytest.mark.parametrize(
    ("value", "error", "told"),
    [
        (176827.717, 2e3, "177000 ± 2000 N"),
        (52093.3357, 1.2, "52093 ± 1 N"),
        (51486.4246123, 7e-6, "51486.424612 ± 7e-06 N"),
        (3.00986, 9.6e-4, "3.010 ± 0.001 N"),
        (0.0, 0.5, "0.0 ± 0.5 N"),
        (12.5, 0.0, "12.5 ± 0 N"),
        (12.5, math.nan, "12.5 ± nan N"),
        (1.5, 400.0, "0 ± 400 N"),
        (1.0, 1e-20, "1.00000000000 ± 1e-20 N"),
    ],
)
def test_no_digit_is_printed_that_the_error_does_not_leave(value: float, error: float, told: str) -> None:
    assert str(Estimate(value, error, "N")) == told


@given(value=st.floats(-1e9, 1e9), error=st.floats(1e-9, 1e6))
def test_what_is_printed_is_within_the_error(value: float, error: float) -> None:
    number, _, rest = str(Estimate(value, error, "N")).partition(" ± ")
    most = max(error, abs(value) * 1e-11)
    assert abs(float(number) - value) <= 0.51 * 10.0 ** math.ceil(math.log10(1.05 * most))
    assert float(rest.split()[0]) == pytest.approx(error, rel=0.51)
