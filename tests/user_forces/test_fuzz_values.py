"""Whatever is given for a value is taken and comes back, or is refused in a sentence."""

from __future__ import annotations

from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from tests import strategies as some
from tests.sound import sound, taken_or_refused
from user_forces import Value


@given(data=st.data())
@some.tried("constructors")
def test_a_value_that_can_be_made_is_sound(data: st.DataObject) -> None:
    kind = data.draw(st.sampled_from(some.kinds()))
    fields = data.draw(some.arguments(kind))
    made = taken_or_refused(lambda: kind(**fields))
    if made is not None:
        sound(made)


@given(data=some.mutated(some.seed_trees, some.scraps | some.oddities))
@some.tried("data")
def test_data_that_were_valid_once_are_taken_or_refused(data: Any) -> None:
    made = taken_or_refused(lambda: Value.from_data(data))
    if made is not None:
        sound(made)


@given(data=some.scraps | some.oddities | st.dictionaries(some.names, some.scraps | some.oddities))
@some.tried("raw data")
def test_data_that_are_none_are_refused(data: Any) -> None:
    made = taken_or_refused(lambda: Value.from_data(data))
    if made is not None:
        sound(made)
