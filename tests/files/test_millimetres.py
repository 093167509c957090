"""Lengths in messages, in mm."""

from __future__ import annotations

import pytest

from support_exudyn.files.toml.reading import in_millimetres


@pytest.mark.parametrize(
    ("said", "told"),
    [
        (
            "column extension = 5.0 m: allowed: up to 1.285 m",
            "column extension = 5000 mm: allowed: up to 1285 mm",
        ),
        ("allowed: 0.9798 to 3.2365 m", "allowed: 979.8 to 3236.5 mm"),
        ("-1e-05 m", "-0.01 mm"),
        ("eccentricity of a = (0.0, -0.003) m: no", "eccentricity of a = (0, -3) mm: no"),
        ("0.5 m/s", "500 mm/s"),
        ("2.0 m^2, 3.0 m**2, 1.0 N m, 4 months, x1 m", "2.0 m^2, 3.0 m**2, 1.0 N m, 4 months, x1 m"),
        ("step = 3.0 s", "step = 3.0 s"),
    ],
)
def test_lengths_are_told_in_mm_and_nothing_else(said: str, told: str) -> None:
    assert in_millimetres(said) == told
