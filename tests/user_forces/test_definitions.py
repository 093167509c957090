"""Classes of one's own say what they lack where they are defined; names that are not there say what is."""

from __future__ import annotations

import copy
import pickle
from typing import ClassVar

import pytest

import support_exudyn
import support_exudyn.sweeps
from support_exudyn import CubicStep, Drive, InputError, Machine, NormalLaw, machine, value
from user_forces import Hertz, Value
from user_forces.values.names import Named, UnknownNameError


def test_a_law_says_at_its_definition_what_it_lacks() -> None:
    with pytest.raises(InputError, match=r"class Damper: lacks force, a method \(Normal force \[N\], positive"):

        @value
        class Damper(NormalLaw):
            damping: float

            @staticmethod
            def elastic(depth: float, damping: float) -> float:
                return damping * depth


def test_a_law_says_at_its_definition_which_method_is_of_no_use() -> None:
    with pytest.raises(InputError, match=r"class Doubled: elastic_force: follows .* static method `elastic`"):

        class Doubled(Hertz):
            def elastic_force(self, depth: float) -> float:
                return 2.0 * depth


def test_a_drive_says_at_its_definition_that_a_property_is_missing() -> None:
    with pytest.raises(InputError, match=r"lacks breaks, a property \(Times \[s\].*; span, a method"):

        @value
        class Half(Drive):
            def extension(self, t: float) -> float:
                return 0.0

            def speed(self, t: float) -> float:
                return 0.0


def test_a_machine_without_value_says_so_when_it_is_made() -> None:
    class Rocker(Machine):
        length: float

        def linkage(self) -> support_exudyn.Linkage:
            raise NotImplementedError

    with pytest.raises(InputError, match=r"the line @value before `class Rocker`"):
        Rocker(length=1.0)  # type: ignore[call-arg]


def test_a_field_without_value_is_not_left_out_silently() -> None:
    class Softer(Hertz):
        share: float = 0.5

    class Named2(Hertz):
        TITLE: ClassVar[str] = "Hertz, by another name"

    with pytest.raises(InputError, match=r"the line @value before `class Softer`"):
        Softer(stiffness=1e9)
    assert Named2(stiffness=1e9).stiffness == 1e9


def test_a_wrong_field_and_a_wrong_name_are_told_with_those_that_look_like_them() -> None:
    with pytest.raises(InputError, match=r"strok = 1: unknown field; did you mean 'stroke' or"):
        CubicStep(strok=1)  # type: ignore[call-arg]
    linkage = machine("slider_crank").linkage()
    with pytest.raises(KeyError) as caught:
        linkage.pins["slidr_pin"]
    assert str(caught.value) == "'slidr_pin': no such name in Linkage.pins; did you mean 'slider_pin'?"
    with pytest.raises(UnknownNameError, match=r"no such class of values; did you mean 'Hertz'"):
        Value.of_name("Herz")


def test_a_named_table_is_a_dictionary() -> None:
    table = Named({"first": 1, "second": 2, "third": 3, "fourth": 4}, "place")
    assert table == dict(table) == copy.copy(table) == pickle.loads(pickle.dumps(table))
    assert pickle.loads(pickle.dumps(table)).what == "place"
    assert table.get("fifth") is None
    with pytest.raises(KeyError, match=r"^'xyz': no such place; there are 'first', 'second', 'third' and 1 m"):
        table["xyz"]
    with pytest.raises(KeyError, match="there are none"):
        Named()["x"]
