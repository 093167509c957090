"""Scenario files of any content: a scenario, or a line that names the file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hypothesis import example, given
from hypothesis import strategies as st

from support_exudyn import Scenario
from support_exudyn.files import parsed, scenario_of, scenario_text, table_of
from tests import strategies as some
from user_forces import InputError

some.kinds()  # imports all modules: not while something is drawn
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
LONG = tuple(scenario_text(one) for one in some.seeds() if isinstance(one, Scenario))
TREES = (parsed(SHORT, "a"), *(parsed(text, "a") for text in LONG))


def taken_or_refused(table: dict[str, Any]) -> None:
    try:
        found = scenario_of(table, "a.toml", FOLDER)
    except InputError as error:
        for line in str(error).splitlines():
            if "a.toml: " not in line and "columns_apart.csv: " not in line and ".toml: " not in line:
                raise
        return
    assert scenario_of(table_of(found), "a.toml", FOLDER) == found


@given(table=some.mutated(some.one_of(TREES)))
@example(table=dict(TREES[0]))
@some.tried("scenario tree")
def test_any_table_is_a_scenario_or_refused(table: Any) -> None:
    if isinstance(table, dict):  # of a tree that was replaced as a whole TOML knows nothing
        taken_or_refused(table)


@given(text=some.mangled(some.one_of((SHORT, *LONG))) | st.text(max_size=40))
@some.tried("scenario text")
def test_any_text_is_a_scenario_or_refused(text: str) -> None:
    try:
        table = parsed(text, "a.toml")
    except InputError as error:
        if not str(error).startswith("a.toml: "):
            raise
        return
    taken_or_refused(table)
