"""Files of four-column supports: what they are read into, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from support_exudyn import RigidActuator, cylinders_and_rods, load_machine, reference_support
from support_exudyn.model.linkage import lumped
from tests.cases.machine_cases import PARTS, PIVOTS, PIVOTS_MM, support

PIVOT_LINES = "\n".join(f"{name} = [{x}, {y}]" for name, (x, y) in PIVOTS_MM.items())
FILE = f"""
kind = "four_column_support"
name = "a support"
start_hinge_height_mm = 1800

[pivots_mm]
{PIVOT_LINES}

[[parts.rear_link]]
mass_kg = 500
between = ["rear_base", "rear_shield"]

[[parts.front_link]]
mass_kg = 400
between = ["front_base", "front_shield"]

[[parts.shield]]
mass_kg = 1500
between = ["rear_shield", "hinge"]

[[parts.canopy]]
mass_kg = 3000
centre_mm = [1369, 2317]
length_mm = 3300

[[parts.canopy]]
mass_kg = 200
centre_mm = [899, 2252]
"""


def written(folder: Path) -> Path:
    """The data file."""
    (folder / "machine.toml").write_text(FILE, encoding="utf-8")
    return folder / "machine.toml"


def test_reference_support_has_the_published_pivots_and_parts() -> None:
    for name, pivot in PIVOTS.items():  # one rounding from mm to m
        assert getattr(reference_support(), name) == pytest.approx(pivot, abs=1e-15)
    for body, parts in PARTS.items():  # rounding
        got, expected = lumped(reference_support().parts[body]), lumped(parts)
        assert got.mass == pytest.approx(expected.mass, rel=1e-15)
        assert got.inertia == pytest.approx(expected.inertia, rel=1e-13)
        assert got.centre == pytest.approx(expected.centre, abs=1e-15)


def test_a_file_is_read_into_metres_and_kilograms_and_its_parts_are_bars(tmp_path: Path) -> None:
    machine = load_machine(written(tmp_path)).machine
    # one rounding from mm to m
    assert machine.tip == pytest.approx((3.219, 2.417), abs=1e-15)
    assert machine.start_hinge_height == 1.8
    assert machine.start() == support().start()
    (between,), about = machine.parts["rear_link"], machine.parts["canopy"][0]
    # rounding
    assert between.centre == pytest.approx((-0.287, 0.731), abs=1e-15)
    assert between.inertia == pytest.approx(500.0 * (0.574**2 + 0.862**2) / 12.0, rel=1e-14)
    assert about.centre == (1.369, 2.317)
    assert about.inertia == pytest.approx(3000.0 * 3.3**2 / 12.0, rel=1e-14)


# --- columns with mass, and the tail beam ---

COLUMN = """
[columns.front_column]
cylinder_mass_kg = 300
cylinder_length_mm = 900
rod_mass_kg = 200
rod_length_mm = 800
"""


def test_columns_of_the_reference_support_are_uniform_bars() -> None:
    columns = cylinders_and_rods()
    canopy = {part.name: part.mass for part in reference_support().parts["canopy"]}
    assert sorted(columns) == ["front_column", "rear_column"]
    for name, column in columns.items():
        assert canopy[f"{name}_rods"] == column.rod_mass
        assert (column.cylinder_mass, column.rod_mass, column.drive) == (300.0, 200.0, RigidActuator())
        # one rounding from mm to m
        assert (column.cylinder_centre, column.rod_centre) == pytest.approx((0.45, 0.45), rel=1e-15)
        assert column.cylinder_inertia == pytest.approx(300.0 * 0.81 / 12.0, rel=1e-14)
        assert column.rod_inertia == pytest.approx(200.0 * 0.81 / 12.0, rel=1e-14)


def test_columns_are_read_from_a_file(tmp_path: Path) -> None:
    path = written(tmp_path)
    assert cylinders_and_rods(path=path) == {}
    path.write_text(FILE + COLUMN, encoding="utf-8")
    (column,) = cylinders_and_rods(path=path).values()
    assert column.rod_centre == pytest.approx(0.4, rel=1e-15)
    assert load_machine(path).machine.tail_hinge is None
