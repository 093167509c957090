from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Mapping
from dataclasses import field
from typing import Annotated, Literal

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


def test_an_unknown_field_is_named_with_value_and_known_fields() -> None:
    with pytest.raises(
        InputError, match=r"^Ball\.size = 3\.0: unknown field; the fields are radius, centre, colour$"
    ):
        Ball(radius=1.0, size=3.0)


def test_a_missing_field_is_named() -> None:
    with pytest.raises(InputError, match=r"^Ball\.radius: missing; it has no default$"):
        Ball()


def test_a_wrong_choice_is_named_with_value_and_choices() -> None:
    with pytest.raises(InputError, match=r"^Ball\.colour = 'blue': .*'red' or 'green'"):
        Ball(radius=1.0, colour="blue")


def test_a_wrong_part_of_a_vector_is_named_with_its_place() -> None:
    with pytest.raises(InputError, match=r"^Ball\.centre\.1 = nan: "):
        Ball(radius=1.0, centre=(0.0, math.nan))


def test_a_vector_of_three_is_refused() -> None:
    with pytest.raises(InputError, match=r"^Ball\.centre"):
        Ball(radius=1.0, centre=(0.0, 1.0, 2.0))


def test_a_wrong_type_of_value_is_named() -> None:
    with pytest.raises(InputError, match=r"^Box\.lid = 3\.0: "):
        Box(lid=3.0)


def test_every_wrong_field_gets_a_line() -> None:
    with pytest.raises(InputError) as caught:
        Ball(radius=-1.0, colour="blue", size=3.0)
    named = [line.split(" = ")[0] for line in str(caught.value).splitlines()]
    assert sorted(named) == ["Ball.colour", "Ball.radius", "Ball.size"]


def test_a_long_input_is_shortened_in_the_message() -> None:
    with pytest.raises(InputError) as caught:
        Ball(radius="x" * 1000)
    assert len(str(caught.value)) < 300


def test_fields_are_given_by_name_only() -> None:
    with pytest.raises(InputError):
        Ball(1.0)


def test_input_error_is_a_value_error() -> None:
    assert issubclass(InputError, ValueError)


def test_fields_cannot_be_changed() -> None:
    ball = Ball(radius=1.0)
    with pytest.raises(dataclasses.FrozenInstanceError):
        ball.radius = 2.0  # type: ignore[misc]


def test_a_changed_copy_is_checked_too() -> None:
    with pytest.raises(InputError, match=r"Ball\.radius = -2\.0"):
        dataclasses.replace(Ball(radius=1.0), radius=-2.0)


def test_values_with_equal_fields_are_equal() -> None:
    assert Ball(radius=1) == Ball(radius=1.0)
    assert Ball(radius=1.0) != Ball(radius=2.0)


@given(box=boxes)
def test_json_brings_nested_values_back(box: Box) -> None:
    assert Value.from_data(json.loads(json.dumps(box.to_data()))) == box


@given(box=boxes)
def test_data_written_is_plain_and_names_its_type(box: Box) -> None:
    def plain(item: object) -> bool:
        if isinstance(item, dict):
            return all(type(k) is str and plain(v) for k, v in item.items())
        if isinstance(item, list):
            return all(plain(v) for v in item)
        return item is None or type(item) in (str, int, float, bool)

    data = box.to_data()
    assert plain(data)
    assert (data["type"], data["lid"]["type"]) == ("Box", "Ball")


def test_a_law_inside_a_contact_comes_back_as_what_it_was() -> None:
    one = contact(sliding_coefficient=0.3)
    two = Value.from_data(json.loads(json.dumps(one.to_data())))
    assert two == one
    assert type(two.friction) is type(one.friction)


def test_data_of_an_unknown_type_is_refused() -> None:
    with pytest.raises(InputError, match=r"type = 'Cube': not a known type; allowed: .*CubicStep"):
        Value.from_data({"type": "Cube", "radius": 1.0})


def test_data_without_a_type_is_refused() -> None:
    with pytest.raises(InputError, match="type = None: not a known type"):
        Value.from_data({"radius": 1.0})


def test_data_that_do_not_fit_are_refused() -> None:
    data = contact().to_data()
    data["bearing"]["clearance"] = -1.0
    with pytest.raises(InputError, match=r"JournalBearing\.clearance = -1\.0: .*allowed: > 0"):
        Value.from_data(data)


def test_data_of_an_abstract_type_are_refused() -> None:
    with pytest.raises(InputError):
        Value.from_data({"type": Drive.__name__})


def test_a_check_over_several_fields_is_a_sentence() -> None:
    with pytest.raises(InputError, match=r"^JournalBearing: clearance = 2\.0 m: .*allowed: > 0 and < 1\.0"):
        JournalBearing(bore_radius=1.0, clearance=2.0)


@pytest.mark.parametrize("data", [{"type": ["a"]}, [1], {}, "text", {"type": "NoSuchType"}])
def test_data_that_are_no_value_are_refused(data: object) -> None:
    with pytest.raises(InputError, match="not a known type"):
        Value.from_data(data)


@pytest.mark.parametrize("wrong", ["0.05", True, b"1"])
def test_text_and_truth_are_no_numbers(wrong: object) -> None:
    with pytest.raises(InputError, match=r"bore_radius = .*number; allowed: > 0"):
        JournalBearing(bore_radius=wrong, clearance=0.001)
