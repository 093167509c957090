"""Files of four-column supports: what they are read into, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from support_exudyn import RigidActuator, cylinders_and_rods, load_support, reference_support
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


def written(folder: Path, old: str = "", new: str = "") -> Path:
    """A data file with one thing changed."""
    assert old in FILE
    path = folder / "machine.toml"
    path.write_text(FILE.replace(old, new, 1) if old else FILE, encoding="utf-8")
    return path


@pytest.mark.parametrize("name", PIVOTS)
def test_reference_support_has_the_published_pivots(name: str) -> None:
    # one rounding from mm to m
    assert getattr(reference_support(), name) == pytest.approx(PIVOTS[name], abs=1e-15)


@pytest.mark.parametrize("body", PARTS)
def test_reference_support_has_the_published_parts(body: str) -> None:
    got, expected = lumped(reference_support().parts[body]), lumped(PARTS[body])
    # rounding
    assert got.mass == pytest.approx(expected.mass, rel=1e-15)
    assert got.inertia == pytest.approx(expected.inertia, rel=1e-13)
    assert got.centre == pytest.approx(expected.centre, abs=1e-15)


def test_a_file_is_read_into_metres_and_kilograms(tmp_path: Path) -> None:
    machine = load_support(written(tmp_path))
    # one rounding from mm to m
    assert machine.tip == pytest.approx((3.219, 2.417), abs=1e-15)
    assert machine.start_hinge_height == 1.8
    assert machine.start() == support().start()


def test_a_part_between_pivots_is_a_bar(tmp_path: Path) -> None:
    (part,) = load_support(written(tmp_path)).parts["rear_link"]
    # rounding
    assert part.centre == pytest.approx((-0.287, 0.731), abs=1e-15)
    assert part.inertia == pytest.approx(500.0 * (0.574**2 + 0.862**2) / 12.0, rel=1e-14)


def test_a_part_with_a_length_is_a_bar_about_its_centre(tmp_path: Path) -> None:
    part = load_support(written(tmp_path)).parts["canopy"][0]
    assert part.centre == (1.369, 2.317)
    # rounding
    assert part.inertia == pytest.approx(3000.0 * 3.3**2 / 12.0, rel=1e-14)


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
    assert sorted(columns) == ["front_column", "rear_column"]
    for column in columns.values():
        assert (column.cylinder_mass, column.rod_mass, column.drive) == (300.0, 200.0, RigidActuator())
        # one rounding from mm to m
        assert (column.cylinder_centre, column.rod_centre) == pytest.approx((0.45, 0.45), rel=1e-15)
        assert column.cylinder_inertia == pytest.approx(300.0 * 0.81 / 12.0, rel=1e-14)
        assert column.rod_inertia == pytest.approx(200.0 * 0.81 / 12.0, rel=1e-14)


def test_rods_have_the_mass_that_they_have_on_the_canopy() -> None:
    canopy = {part.name: part.mass for part in reference_support().parts["canopy"]}
    for name, column in cylinders_and_rods().items():
        assert canopy[f"{name}_rods"] == column.rod_mass


def test_columns_are_read_from_a_file(tmp_path: Path) -> None:
    path = written(tmp_path, 'name = "a support"', 'name = "a support"')
    assert cylinders_and_rods(path=path) == {}
    path.write_text(FILE + COLUMN, encoding="utf-8")
    (column,) = cylinders_and_rods(path=path).values()
    assert column.rod_centre == pytest.approx(0.4, rel=1e-15)
    assert load_support(path).tail_hinge is None
