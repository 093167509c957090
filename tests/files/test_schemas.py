"""The JSON Schema of scenario files takes what the reader takes, and refuses what can be seen without a run."""

from __future__ import annotations

from decimal import Decimal
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from support_exudyn import Scenario
from support_exudyn.files import load_toml, parsed, scenario_of, scenario_schema, scenario_text
from support_exudyn.files.own_modules import OURS
from tests import strategies as some
from user_forces.values.sourced import SourcedNumber
from user_forces.values.value import Value

SHORT = """
machine = "reference"
duration_s = 5
step_ms = 0.5
[pins.rear_base]
clearance_mm = 1.5
bore_radius_mm = 65.5
friction = {type = "CubicCoulomb", sliding_coefficient = 0.2}
[actuators.front_column]
type = "CylinderAndRod"
rod_mass_kg = 300
drive = {type = "OilColumn", bore_area_mm2 = 1e5, oil_length_mm = 500, bulk_modulus_GPa = 1.5}
[drives.rear_column]
mode = 1
stroke_mm = 100
[drive]
table = "columns_apart.csv"
column = "front_column"
[loads.roof]
type = "Roof"
body = "canopy"
point_mm = [0, 0]
stiffness_kN_per_mm = 10
descent = {mode = 2, stroke_mm = 5, start_s = 0, end_s = 1}
"""
FOLDER = Path(__file__).parents[2] / "support_exudyn" / "files" / "examples"

some.kinds()  # imports all modules: not while something is drawn
VALIDATOR = Draft202012Validator(scenario_schema())
TOP = 'machine = "reference"\nduration_s = 5\n'
WITH_CLEARANCE = "[pins.rear_base]\nclearance_mm = 1.5\nbore_radius_mm = 65.5\n"


def plain(item: Any) -> Any:
    """As JSON has it."""
    if isinstance(item, dict):
        return {key: plain(one) for key, one in item.items()}
    if isinstance(item, list):
        return [plain(one) for one in item]
    return float(item) if isinstance(item, Decimal) else item


def faults(text: str) -> list[str]:
    return [error.message for error in VALIDATOR.iter_errors(plain(parsed(text, "a")))]


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.toml")), ids=lambda path: path.name)
def test_examples_are_taken(path: Path) -> None:
    assert not list(VALIDATOR.iter_errors(plain(load_toml(path))))


@pytest.mark.parametrize("seed", [one for one in some.seeds() if isinstance(one, Scenario)])
def test_scenarios_in_full_are_taken(seed: Scenario) -> None:
    assert faults(scenario_text(seed, name="a", errors=True)) == []


@pytest.mark.parametrize(
    "text",
    [
        SHORT,
        TOP + WITH_CLEARANCE + 'law = "Flores"\nstiffness = "internal"\nbore_material = "steel"',
        TOP + WITH_CLEARANCE + "stiffness_N_per_m_to_n = 1e10",
        TOP + "pins.rear_base.ideal = true",
        TOP + '[drives]\ntable = "columns_apart.csv"\nbetween = "linear"',
    ],
)
def test_short_forms_are_taken(text: str) -> None:
    scenario_of(parsed(text, "a"), "a", FOLDER)
    assert faults(text) == []


def test_every_field_of_every_class_is_described() -> None:
    bare = [
        f"{name}.{key}"
        for name, table in scenario_schema()["$defs"].items()
        if name == SourcedNumber.__name__
        or Value.of_name(name).__module__.startswith(OURS)  # others are of other tests in this process
        for key, one in table["properties"].items()
        if key != "type" and not one.get("description")
    ]
    assert bare == []
