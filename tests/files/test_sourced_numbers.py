"""Numbers of machine and scenario files that say range and source, and those that say them wrongly."""

from __future__ import annotations

from decimal import Decimal
from importlib import resources
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from jsonschema import Draft7Validator, Draft202012Validator

from support_exudyn.files import ScenarioFile, scenario_file_of, scenario_schema
from support_exudyn.files.machines import SHIPPED, machine_schema, read_machine
from support_exudyn.files.machines.read import _of_text
from support_exudyn.files.toml.text import parsed, toml_text
from tests.files.test_schemas import plain
from user_forces.values.sourced import SourcedNumber

VALIDATORS = [kind(machine_schema()) for kind in (Draft202012Validator, Draft7Validator)]
PLAIN = {  # the files that come with the package, with numbers alone
    name: parsed((resources.files("support_exudyn.files.machines") / f"{name}.toml").read_text("utf-8"), name)
    for name in SHIPPED
}


def bare(item: Any) -> Any:
    """A table of a file whose numbers say neither range nor source."""
    if isinstance(item, dict):
        return item["value"] if "value" in item else {key: bare(one) for key, one in item.items()}
    return list(map(bare, item)) if isinstance(item, list) else item


def clothed(item: Any, key: str, draw: st.DrawFn, found: dict[str, SourcedNumber]) -> Any:
    """The table, some of whose numbers say a range, a source, or both, and are put into `found`."""
    if isinstance(item, dict):
        return {name: clothed(one, f"{key}.{name}", draw, found) for name, one in item.items()}
    if isinstance(item, list):
        return [clothed(one, f"{key}.{n}", draw, found) for n, one in enumerate(item)]
    if not isinstance(item, (int, Decimal)) or key.endswith(".count") or draw(st.booleans()):
        return item  # a count has no range
    table: dict[str, Any] = {"value": item}
    if draw(st.booleans()):
        shares = st.decimals("0.1", "1", places=3)
        ends = sorted((Decimal(item) * draw(shares), Decimal(item) / draw(shares)))
        table |= {"from": ends[0], "to": ends[1]}
    if draw(st.booleans()):
        table["source"] = draw(st.sampled_from(["a drawing", "assumed"]))
    found[key[1:]] = SourcedNumber(Decimal(item), table.get("from"), table.get("to"), table.get("source", ""))
    return table


@given(data=st.data(), name=st.sampled_from(SHIPPED))
def test_numbers_with_range_and_source_make_the_same_machine(data: st.DataObject, name: str) -> None:
    expected: dict[str, SourcedNumber] = {}
    table = clothed(bare(PLAIN[name]), "", data.draw, expected)
    found, was = _of_text(toml_text(table)), read_machine(name)
    assert found.machine == was.machine
    assert (found.bore_radii, found.actuators, found.stroke) == (was.bore_radii, was.actuators, was.stroke)
    assert dict(found.sourced) == expected
    for validator in VALIDATORS:
        assert not list(validator.iter_errors(plain(table)))


SCENE = """
machine = "reference"
duration_s = 1
accuracy = 1e-3
gravity_m_per_s2 = [0.1, -9.81]
solver.impact_steps = 512
drive = { mode = 1, stroke_mm = 40, start_s = 0.1, end_s = 0.9 }
pins.rear_base = { clearance_mm = 1.5, stiffness_N_per_m_to_n = 1e10, friction = 0.2, bore_radius_mm = 65.5 }

[actuators.rear_column]
type = "OilColumn"
bore_area_mm2 = 98174.77
oil_length_mm = 500
bulk_modulus_MPa = 1960
"""


def scene(text: str) -> ScenarioFile:
    return scenario_file_of(parsed(text, "a.toml"), "a.toml", Path())


@pytest.mark.parametrize(
    ("key", "number", "low", "high"),
    [
        ("duration_s", "1", "0.95", "2"),
        ("solver.impact_steps", "512", "128", "1024"),
        ("drive.stroke_mm", "40", "30", "50"),
        ("pins.rear_base.stiffness_N_per_m_to_n", "1e10", "1e9", "1e11"),
        ("pins.rear_base.friction", "0.2", "0", "0.3"),  # may be a table of another kind, a law
        ("actuators.rear_column.oil_length_mm", "500", "300", "800"),
    ],
)
def test_numbers_of_scenarios_may_say_range_and_source(key: str, number: str, low: str, high: str) -> None:
    last = "[" if key.endswith(".0") else f"{key.rpartition('.')[2]} = "
    assert SCENE.count(last + number) == 1
    table = f'{{ value = {number}, from = {low}, to = {high}, source = "a drawing" }}'
    text = SCENE.replace(last + number, last + table)
    found = scene(text)
    assert found.scenario == scene(SCENE).scenario
    assert found.sourced == {key: SourcedNumber(Decimal(number), Decimal(low), Decimal(high), "a drawing")}
    assert scene(SCENE).sourced == {}
    assert not list(Draft202012Validator(scenario_schema()).iter_errors(plain(parsed(text, ""))))
