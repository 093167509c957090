"""What fuzzing has found, one test each."""

from __future__ import annotations

import dataclasses
from decimal import Decimal
from typing import Any

import numpy as np
import pytest

from support_exudyn import ImpactStand, Linkage, Scenario, SolverSettings, reference_support
from support_exudyn.model.actuators import ActuatorModel, PartModel
from support_exudyn.model.linkage import Body, Part
from tests.cases.law_cases import BEARING, LENGTH, MODULUS
from tests.sound import sound
from user_forces import Goldsmith, Hertz, InputError, Value
from user_forces.normal.part import PartOf

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


def test_a_length_whose_square_is_zero_is_refused() -> None:
    with pytest.raises(InputError, match=r"Goldsmith\.reference_length = 1e-260"):
        Goldsmith(
            bearing=BEARING, length=LENGTH, effective_modulus=MODULUS, restitution=0.5, reference_length=1e-260
        )


@pytest.mark.parametrize("factor", ["2", None, True, 1e308, 1e-308, float("nan")])
def test_a_factor_by_which_nothing_can_be_refined_is_refused(factor: Any) -> None:
    scene = Scenario(machine=ImpactStand(bore_mass=1.0, journal_mass=1.0, speed=0.1), duration=0.1)
    with pytest.raises(InputError, match=r"^factor = .*allowed: > 0"):
        scene.refined(factor)


# --- data ---


def _nested(levels: int) -> dict[str, Any]:
    data: dict[str, Any] = Hertz(stiffness=1e9).to_data()
    for _ in range(levels):
        data = {"type": "PartOf", "law": data, "share": 0.5}
    return data


def test_data_that_are_nested_too_deep_are_refused() -> None:
    with pytest.raises(InputError, match="nested too deep; allowed: 32 levels"):
        Value.from_data(_nested(10_000))


def test_data_that_contain_themselves_are_refused() -> None:
    data: dict[str, Any] = {"type": "ClearancePin"}
    data["contact"] = data
    with pytest.raises(InputError, match="nested too deep"):
        Value.from_data(data)


def test_parts_of_parts_come_back_as_long_as_they_can_be_made() -> None:
    law = Value.from_data(_nested(4))
    sound(law)
    with pytest.raises(InputError, match=r"part of a part.*allowed: up to 4"):
        PartOf(law=law, share=0.5)


def test_a_body_cannot_be_called_type_which_data_could_not_keep() -> None:
    with pytest.raises(InputError, match=r"^Linkage\.bodies: 'type': cannot be used as a name"):
        Linkage(bodies={"type": Body(mass=1.0, inertia=1.0, **BALL)})


@pytest.mark.parametrize("kind", [ActuatorModel, PartModel])
def test_of_a_class_that_only_groups_others_nothing_can_be_made(kind: type[Value]) -> None:
    with pytest.raises(InputError, match=rf"^{kind.__name__}: is a kind of values; allowed: "):
        kind()


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


# --- files ---
