"""Scenario files: what people write in short, what a program writes in full, and what is said of mistakes."""

from __future__ import annotations

from dataclasses import replace
from importlib import resources
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from studies.common.paper_machine import bearing, clearance_rise
from support_exudyn import (
    CubicStep,
    IdealPin,
    OilColumn,
    Scenario,
    UniformSpeed,
    cylinders_and_rods,
)
from support_exudyn.files import (
    parsed,
    read_drives,
    read_scenario,
    scenario_of,
    scenario_text,
)
from support_exudyn.files.machines.read import read_machine
from tests import strategies as some
from user_forces import (
    STEEL,
    CubicCoulomb,
    Hertz,
    InputError,
    internal_contact_stiffness,
)

TOP = 'machine = "reference"\nduration_s = 5\n'
WITH_CLEARANCE = "[pins.rear_base]\nclearance_mm = 1.5\nbore_radius_mm = 65.5\n"
some.kinds()  # imports all modules: not while something is drawn
EXAMPLES = resources.files("support_exudyn.files.examples")


def scenario(text: str, folder: Path = Path()) -> Scenario:
    return scenario_of(parsed(text, "a.toml"), "a.toml", folder)


# --- in short ---


def test_the_papers_rise_in_short_is_that_of_the_studies() -> None:
    with resources.as_file(EXAMPLES / "rise.toml") as path:
        found = read_scenario(path)
    expected = clearance_rise(1.5, 0.25, 5e-4)
    assert found.accuracy == "draft"
    assert (
        replace(
            found,
            solver=expected.solver,
            step=expected.step,
            accuracy=None,
            record_period=expected.record_period,
        )
        == expected
    )


def test_stiffness_of_materials_inside() -> None:
    text = (
        'law = "Hertz"\nstiffness = "internal"\nbore_material = "steel"\n'
        'journal_material = {name = "soft", elastic_modulus_GPa = 207, poisson_ratio = 0.29, '
        "density_kg_per_m3 = 7801}"
    )
    found = scenario(TOP + WITH_CLEARANCE + text).clearance_pins["rear_base"]
    assert found.contact.normal == Hertz(stiffness=internal_contact_stiffness(bearing(1.5), STEEL, STEEL))


@pytest.mark.parametrize(
    ("said", "rest"),
    [
        ("rest_velocity_mm_per_s = 3", 0.003),
        # as earlier versions had it
        ('damping_speed = {type = "ImpactVelocity"}', 0.001),
        ('damping_speed = {type = "ImpactVelocity", floor_mm_per_s = 2}', 0.002),
    ],
)
def test_rest_velocity_bore_and_eccentricity(said: str, rest: float) -> None:
    found = scenario(
        TOP + WITH_CLEARANCE + 'bore = "second"\neccentricity_mm = [0, -1]\n' + said
    ).clearance_pins["rear_base"]
    assert (found.bore, found.eccentricity) == ("second", (0.0, -0.001))
    assert found.contact.normal.rest_velocity == rest  # type: ignore[attr-defined]


def test_an_ideal_pin() -> None:
    text = TOP + "[pins.rear_base]\nideal = true\nradius_mm = 60\n"
    text += '[pins.rear_base.friction]\ntype = "CubicCoulomb"\nsliding_coefficient = 0.1'
    rubbing = IdealPin(friction=CubicCoulomb(sliding_coefficient=0.1), radius=0.06)
    assert scenario(text).pins == {"rear_base": rubbing}


@pytest.mark.parametrize(("mode", "kind"), [(1, UniformSpeed), (2, CubicStep)])
def test_drive_modes_of_the_paper(mode: int, kind: type) -> None:
    assert scenario(TOP + f"drive = {{mode = {mode}}}").drive == kind()
    text = TOP + f"[drive]\nmode = {mode}\nstroke_mm = -100\nstart_s = 1\nend_ms = 2500"
    assert scenario(text).drive == kind(stroke=-0.1, start=1.0, end=2.5)


def test_the_machines_file_says_its_stroke_and_bores() -> None:
    data = read_machine("zf18000")
    found = scenario('machine = "zf18000"\nduration_s = 5\ndrive.mode = 2\npins.rear_base.clearance_mm = 1')
    assert found.drive == CubicStep(stroke=data.stroke)
    assert found.drive != CubicStep()
    pin = found.clearance_pins["rear_base"]
    assert pin.contact.bearing.bore_radius == data.bore_radii["rear_base"] != 0.0655


def test_drives_apart() -> None:
    found = scenario(
        TOP
        + "[drives.front_column]\nmode = 1\n[actuators.front_column]\n"
        + 'type = "OilColumn"\nbore_area_mm2 = 1e5\noil_length_mm = 500\nbulk_modulus_GPa = 1.5'
    )
    assert found.drives == {"front_column": UniformSpeed()}
    assert found.actuators == {"front_column": OilColumn(bore_area=0.1, oil_length=0.5, bulk_modulus=1.5e9)}


def test_one_table_drives_several_actuators() -> None:
    with resources.as_file(EXAMPLES / "columns_apart.toml") as path:
        found = read_scenario(path)
        assert found.drives == read_drives(path.with_name("columns_apart.csv"))


def test_actuators_of_two_bodies_take_their_masses_from_the_machine() -> None:
    found = scenario(TOP + '[actuators.front_column]\ntype = "CylinderAndRod"\nrod_mass_kg = 300')
    expected = replace(cylinders_and_rods()["front_column"], rod_mass=300.0)
    assert found.actuators == {"front_column": expected}


# --- in full ---


@given(st.data())
@some.tried("files of scenarios")
def test_scenarios_are_read_as_they_were_written(data: st.DataObject) -> None:
    written = data.draw(some.values(Scenario))
    found = scenario(scenario_text(written))
    assert found == written
    for name in ("pins", "actuators", "parts", "drives", "loads"):  # the order of forces in a sum
        assert list(getattr(found, name)) == list(getattr(written, name))


# --- what is said of mistakes ---


def test_a_bore_that_nobody_gives_is_asked_for(tmp_path: Path) -> None:
    text = (resources.files("support_exudyn.files.machines") / "reference.toml").read_text("utf-8")
    text = text.partition("[bore_radius_mm]")[0]  # which is the last table
    (tmp_path / "mine.toml").write_text(text, encoding="utf-8")
    with pytest.raises(
        InputError, match=r"^a.toml: pins.front_base: bore_radius_mm: missing, and the machine's"
    ):
        scenario('machine = "mine.toml"\nduration_s = 1\n[pins.front_base]\nclearance_mm = 1', tmp_path)


def test_angles_of_a_crank_are_taken(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("time_s,crank_deg,other_mm\n0,0,0\n1,180,10\n")
    text = 'machine = "slider_crank"\nduration_s = 1\ndrive = {table = "a.csv", column = "crank"}'
    assert scenario(text, tmp_path).drive.extension(1.0) == 3.141592653589793
