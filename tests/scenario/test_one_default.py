"""What a file leaves out is what Python leaves out: no default has two sources."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Any

import pytest

import user_forces
from studies.common.paper_machine import bearing
from support_exudyn import ClearancePin, Scenario, reference_support
from support_exudyn.files import parsed, read_value, scenario_of, table_of, toml_text
from support_exudyn.files.scenarios.short_joints import ShortPin, simple_laws
from support_exudyn.files.toml.shapes import GroupShape, field_shapes
from support_exudyn.model.pins import USUAL_RESTITUTION
from tests import strategies as some
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    InputError,
    JournalContact,
    NormalLaw,
    Value,
    external_contact_stiffness,
)

OUR_SIMPLE_LAWS = [law for law in simple_laws() if hasattr(user_forces, law)]  # without those of other tests
TOP = 'machine = "reference"\nduration_s = 5\n'
WITH_CLEARANCE = "[pins.rear_base]\nclearance_mm = 1.5\nbore_radius_mm = 65.5\n"
some.kinds()  # imports all modules: not while something is drawn


def read(text: str) -> Scenario:
    return scenario_of(parsed(text, "a.toml"), "a.toml", Path())


def defaults(cls: type[Value]) -> dict[str, Any]:
    """Of its fields that have one."""
    found = some.fields_of(cls).items()
    return {name: info.get_default(call_default_factory=True) for name, info in found if not info.is_required()}


@pytest.mark.parametrize("law", OUR_SIMPLE_LAWS)
def test_a_pin_in_short_is_what_python_makes_of_the_same_inputs(law: str) -> None:
    kind: Any = GroupShape((NormalLaw,)).kinds[law]
    said = {
        "stiffness": external_contact_stiffness(bearing(1.5), STEEL, STEEL_35CRMO),
        "restitution": USUAL_RESTITUTION,
    }
    normal = kind(**{name: item for name, item in said.items() if name in some.fields_of(kind)})
    pin = ClearancePin(contact=JournalContact(bearing=bearing(1.5), normal=normal))
    expected = Scenario(machine=reference_support(), duration=5.0, pins={"rear_base": pin})
    stiffness = 'stiffness = "paper"' if "stiffness" in some.fields_of(kind) else ""
    assert read(f'{TOP}{WITH_CLEARANCE}law = "{law}"\n{stiffness}') == expected


def test_a_simple_pin_in_python_has_the_defaults_of_files() -> None:
    ours = {name: one.default for name, one in inspect.signature(ClearancePin.simple).parameters.items()}
    files = defaults(ShortPin)
    assert (ours.pop("bore_material"), ours.pop("journal_material")) == (STEEL, STEEL_35CRMO)
    said = {name: one for name, one in ours.items() if one is not inspect.Parameter.empty}
    assert said == {name: files[name] for name in said}


@pytest.mark.parametrize("kind", some.kinds(), ids=lambda cls: cls.__name__)
def test_a_class_of_which_a_file_says_the_least_is_pythons(kind: type[Value]) -> None:
    examples = some.examples_of(kind)
    needed = [name for name, info in some.fields_of(kind).items() if info.is_required()]
    for example in examples:
        try:
            least = kind(**{name: getattr(example, name) for name in needed})
            full = table_of(least, says_type=False)
        except InputError:
            continue  # which needs more, or is not for files
        keys = {key: item for key, item in full.items() if _field(kind, key) in needed}
        assert read_value(kind, parsed(toml_text(keys), "a.toml"), "a.toml") == least


def _field(kind: type[Value], key: str) -> str:
    return next(one.name for one in field_shapes(kind).values() if key in (one.name, *one.keys))
