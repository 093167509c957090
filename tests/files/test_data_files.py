"""Values as tables of files: what is written is read to the bit, and what cannot be is told by file and key."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any, Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn.files import parsed, read_value, table_of, toml_text
from tests import strategies as some
from user_forces import InputError, JournalBearing, NormalLaw, Value
from user_forces.values.units import Metres, Seconds
from user_forces.values.value import Positive, Real, value


def read(cls: type[Value], text: str) -> Any:
    return read_value(cls, parsed(text, "a.toml"), "a.toml")


def refusal(cls: type[Value], text: str) -> str:
    with pytest.raises(InputError) as caught:
        read(cls, text)
    return str(caught.value)


def same(one: Value, other: Value) -> bool:
    """To the bit, also the signs of zeros, which are equal."""
    return json.dumps(one.to_data()) == json.dumps(other.to_data())


# --- there and back ---


@given(st.data())
@some.tried("files of values")
def test_values_of_every_class_are_read_as_they_were_written(data: st.DataObject) -> None:
    kind = data.draw(st.sampled_from(some.kinds()))
    written = data.draw(some.values(kind))
    try:
        text = toml_text(table_of(written))
    except InputError as error:
        if "UTF-8" in str(error):  # names of half a letter, which no text file can hold
            return
        raise
    assert same(read(type(written), text), written)


@value
class Sheave(Value):
    """A test's own class with one of everything.

    Arguments:
        radius: of the rim [m], > 0.
        lengths: of ropes [m].
        times: two of them [s].
        force: a number [m], or words.
        label: a name.
    """

    radius: Metres[Positive]
    lengths: Metres[Mapping[str, Real]] | None = None
    times: Seconds[tuple[Real, Real]] = (0.0, 1.0)
    force: Literal["none", "some"] | Metres[Real] = "none"
    grooves: tuple[int, ...] = ()
    tags: frozenset[str] = frozenset()
    law: NormalLaw | None = None
    whole: bool = False


@value
class Branch(Value):
    """A test's own class with fields of its own kind.

    Arguments:
        size: [m], > 0.
        first, rest: further branches.
    """

    size: Metres[Positive]
    first: Branch | None = None
    rest: tuple[Branch, ...] = ()


def test_a_class_may_have_fields_of_its_own_kind() -> None:
    tree = Branch(size=1.0, first=Branch(size=0.2), rest=(Branch(size=0.3),))
    assert read(Branch, toml_text(table_of(tree))) == tree
    assert refusal(Branch, "size_m = 1\nfirst.size_mm = -1") == "a.toml: first.size_mm = -1: allowed: > 0"
    said = "a.toml: rest[0].sze_mm: unknown key; did you mean 'size_mm'"
    assert refusal(Branch, "size_m = 1\nrest = [{sze_mm = 1}]").startswith(said)


def test_numbers_are_rounded_once() -> None:
    # 0.1 mm + rounding of 1e-3 would be 1.0000000000000002e-04 for some of them
    for written in ("0.1", "0.3", "65.5", "1.1", "0.7", "37.7"):
        bearing = read(JournalBearing, f"bore_radius_mm = 1e9\nclearance_mm = {written}")
        assert bearing.clearance == float(f"{written}e-3")
