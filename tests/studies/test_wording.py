"""Numbers in sentences."""

from __future__ import annotations

import pytest

from studies.common.numbers import Number, against, percent, said


def number(value: float, error: float, unit: str = "N") -> Number:
    return Number("force", "case", value, unit, error)


@pytest.mark.parametrize(
    ("value", "error", "shown"),
    [
        (51503.8323, 0.0088, "51504 N"),  # the error is below the fifth digit
        (62032.0, 255.0, "62032 ± 255 N"),
        (0.015271, 0.000097, "0.015271 ± 0.000097 N"),
        (-3.690176, 0.000066, "-3.6902 N"),
        (0.0, 0.0, "0 N"),
        (0.0004, 0.0011, "0.0004 ± 0.0011 N"),
        (0.5, 0.0, "0.5 N"),
    ],
)
def test_a_number_is_said_in_five_digits_or_with_its_error(value: float, error: float, shown: str) -> None:
    assert said(number(value, error)) == shown


def test_units() -> None:
    assert said(number(51503.8323, 0.0088), 1e-3, "kN") == "51.504 kN"
    assert said(number(12.0, 0.0, "1")) == "12"
    assert said(number(17.211, 0.1, "deg/s^2")) == "17.21 ± 0.10 deg/s²"


def test_shares() -> None:
    assert against(number(102.7, 0.0), number(100.0, 0.0)) == "+2.7 %"
    assert against(number(404.0, 0.0), number(100.0, 0.0)) == "+304 %"
    assert percent(0.0123) == "1.2 %"
    assert percent(1e-8) == "less than 0.001 %"
