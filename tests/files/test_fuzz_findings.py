"""What fuzzing has found, one test each."""

from __future__ import annotations

import dataclasses
from decimal import Decimal
from typing import Any

import numpy as np
import pytest

from support_exudyn import SolverSettings, reference_support
from support_exudyn.model.linkage import Part
from user_forces import Hertz, InputError, Value

BALL = {"centre": (0.0, 0.0)}


# --- numbers ---


@pytest.mark.parametrize(
    "wrong",
    [
        10**400,
        1e300,
        5e-324,
        Decimal("sNaN"),
        Decimal("1e400"),
        np.array([0.5]),
        np.bool_(True),
        np.complex64(1),
    ],
    ids=str,
)
def test_what_overflows_vanishes_or_only_looks_like_a_number_is_refused(wrong: object) -> None:
    with pytest.raises(InputError, match=r"^Part\.mass = .*Input should be .*number.*; allowed: > 0$"):
        Part(mass=wrong, **BALL)


@pytest.mark.parametrize("wrong", ["512", True, 512.5, 10**5000, 10**20], ids=range(5))
def test_what_is_no_whole_number_is_refused(wrong: object) -> None:
    with pytest.raises(InputError, match=r"^SolverSettings\.impact_steps = .*allowed: >= 16 and <= 10000$"):
        SolverSettings(impact_steps=wrong)


# --- data ---


def _nested(levels: int) -> dict[str, Any]:
    data: dict[str, Any] = Hertz(stiffness=1e9).to_data()
    for _ in range(levels):
        data = {"type": "PartOf", "law": data, "share": 0.5}
    return data


def test_data_that_are_nested_too_deep_are_refused() -> None:
    with pytest.raises(InputError, match="nested too deep; allowed: 32 levels"):
        Value.from_data(_nested(10_000))


# --- machines ---


def test_a_four_bar_that_closes_nowhere_is_refused_in_a_sentence() -> None:
    # stretched along a line: it closes in this posture only, and there by rounding does not
    line = {
        "rear_base": (0.0, 0.0),
        "rear_shield": (0.2, 0.0),
        "front_shield": (0.7, 0.0),
        "front_base": (1.3, 0.0),
    }
    with pytest.raises(InputError, match=r"the four-bar does not close within 60 degrees.*allowed: "):
        dataclasses.replace(reference_support(), **line)
