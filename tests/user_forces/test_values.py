from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Mapping
from dataclasses import field
from typing import Annotated, Any, Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import Field

from support_exudyn import Drive
from tests.cases.machine_cases import contact
from user_forces import InputError, JournalBearing, Value, value


@value
class Ball(Value):
    radius: Annotated[float, Field(gt=0, le=10)]
    centre: tuple[float, float] = (0.0, 0.0)
    colour: Literal["red", "green"] = "red"


@value
class Box(Value):
    lid: Ball
    balls: Mapping[str, Ball] = field(default_factory=dict)
    row: tuple[Ball, ...] = ()
    count: int = 0
    label: str | None = None


numbers = st.floats(allow_nan=False, allow_infinity=False)
balls = st.builds(
    Ball,
    radius=st.floats(0, 10, exclude_min=True),
    centre=st.tuples(numbers, numbers),
    colour=st.sampled_from(["red", "green"]),
)
boxes = st.builds(
    Box,
    lid=balls,
    balls=st.dictionaries(st.text("abc._- 1", max_size=5), balls, max_size=3),
    row=st.lists(balls, max_size=3).map(tuple),
    count=st.integers(-(10**6), 10**6),
    label=st.none() | st.text(max_size=10),
)


@pytest.mark.parametrize(
    ("wrong", "shown"),
    [
        (-1.0, r"-1\.0"),
        (0.0, r"0\.0"),
        (11.0, r"11\.0"),
        (math.nan, "nan"),
        (math.inf, "inf"),
        ("large", "'large'"),
        (None, "None"),
        ([1.0], r"\[1\.0\]"),
    ],
)
def test_a_wrong_number_is_named_with_value_and_allowed_range(wrong: object, shown: str) -> None:
    with pytest.raises(InputError, match=rf"^Ball\.radius = {shown}: .*allowed: > 0 and <= 10$"):
        Ball(radius=wrong)


def test_every_wrong_field_gets_a_line() -> None:
    with pytest.raises(InputError) as caught:
        Ball(radius=-1.0, colour="blue", size=3.0)
    named = [line.split(" = ")[0] for line in str(caught.value).splitlines()]
    assert sorted(named) == ["Ball.colour", "Ball.radius", "Ball.size"]


def test_fields_cannot_be_changed() -> None:
    ball = Ball(radius=1.0)
    with pytest.raises(dataclasses.FrozenInstanceError):
        ball.radius = 2.0  # type: ignore[misc]


def test_a_changed_copy_is_checked_too() -> None:
    with pytest.raises(InputError, match=r"Ball\.radius = -2\.0"):
        dataclasses.replace(Ball(radius=1.0), radius=-2.0)


@given(box=boxes)
def test_json_brings_nested_values_back(box: Box) -> None:
    assert Value.from_data(json.loads(json.dumps(box.to_data()))) == box


def test_a_law_inside_a_contact_comes_back_as_what_it_was() -> None:
    one = contact(sliding_coefficient=0.3)
    two = Value.from_data(json.loads(json.dumps(one.to_data())))
    assert two == one
    assert type(two.friction) is type(one.friction)


@pytest.mark.parametrize("wrong", ["0.05", True, b"1"])
def test_text_and_truth_are_no_numbers(wrong: object) -> None:
    with pytest.raises(InputError, match=r"bore_radius = .*number; allowed: > 0"):
        JournalBearing(bore_radius=wrong, clearance=0.001)


@pytest.mark.parametrize(
    ("kind", "fields", "said"),
    [
        (Ball, {"radius": 1.0, "size": 3.0}, r"Ball\.size = 3\.0: unknown field; allowed: radius,"),
        (Ball, {}, r"Ball\.radius: missing; it has no default$"),
        (Ball, {"radius": 1.0, "colour": "blue"}, r"Ball\.colour = 'blue': .*'red' or 'green'"),
        (Ball, {"radius": 1.0, "centre": (0.0, math.nan)}, r"Ball\.centre\.1 = nan: "),
        (Ball, {"radius": 1.0, "centre": (0.0, 1.0, 2.0)}, r"Ball\.centre"),
        (Box, {"lid": 3.0}, r"Box\.lid = 3\.0: "),
        (JournalBearing, {"bore_radius": 1.0, "clearance": 2.0}, "JournalBearing: clearance = 2.*allowed: > 0"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named_with_its_place(kind: type[Any], fields: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=rf"^{said}"):
        kind(**fields)


@pytest.mark.parametrize(
    ("data", "said"),
    [
        *((data, "not a known type") for data in ({"type": ["a"]}, [1], {}, "text", {"radius": 1.0})),
        (
            {"type": "CubcStep", "radius": 1.0},
            r"type = 'CubcStep': not a known type; .*did you mean 'CubicStep'",
        ),
        ({"type": Drive.__name__}, "not a known type"),
        (
            {"type": "JournalBearing", "bore_radius": 1.0, "clearance": -1.0},
            r"JournalBearing\.clearance = -1\.0: .*allowed: > 0",
        ),
    ],
)
def test_data_that_are_no_value_are_refused(data: Any, said: str) -> None:
    with pytest.raises(InputError, match=said):
        Value.from_data(data)
