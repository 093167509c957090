"""What machines look like, and where bodies and pins are at the records of a run."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from studies.common.paper_machine import clearance_rise
from support_exudyn import (
    ClearancePin,
    CubicStep,
    CylinderAndRod,
    HydraulicSupport,
    OwnBody,
    Scenario,
    TwoLegShield,
    reference_support,
)
from support_exudyn.machines.four_column_support import PIVOTS
from support_exudyn.machines.free_impact import ImpactStand
from support_exudyn.postprocessing.look.looks import look, look_of
from support_exudyn.postprocessing.look.poses import PlacedPin, placed_pins, planar_pins, turned
from support_exudyn.postprocessing.look.shapes import Look, Role
from tests.cases.run_cases import PIN, loose_support, paper_contact
from tests.often import often
from user_forces import Frictionless, InputError, JournalBearing, JournalContact, LankaraniNikravesh

RISE = 0.5  # [m]
COLUMN = CylinderAndRod(
    cylinder_mass=300.0,
    cylinder_centre=0.45,
    cylinder_inertia=20.0,
    rod_mass=200.0,
    rod_centre=0.45,
    rod_inertia=14.0,
)
PLAIN = Scenario(machine=reference_support(), drive=CubicStep(stroke=RISE), duration=5.0)
HEAVY = replace(PLAIN, actuators={"front_column": COLUMN, "rear_column": COLUMN})
SCENES = {
    "ideal pins": PLAIN,
    "clearance pin": clearance_rise(1.5, 0.25, 1e-3),
    "no widths": replace(PLAIN, machine=replace(reference_support(), width=None)),
    "in space": replace(PLAIN, dimensions=3),
    "columns in two bodies": HEAVY,
    "columns in two bodies, in space": replace(HEAVY, dimensions=3),
    "tail beam of its own": replace(PLAIN, parts={"tail_beam": OwnBody()}),
    "tail beam of its own, in space": replace(PLAIN, parts={"tail_beam": OwnBody()}, dimensions=3),
}


@pytest.fixture(params=SCENES)
def scene(request: pytest.FixtureRequest) -> Scenario:
    return SCENES[request.param]


def test_pins_are_where_the_machine_has_them(scene: Scenario) -> None:
    shown = look(scene)
    for name in ("rear_base", "front_base", "rear_shield", "front_shield", "shield_canopy"):
        pins = [shape for shape in shown.shapes if shape.name.startswith(f"pin_{name}")]
        assert pins
        for pin in pins:
            assert pin.role is Role.PIN
            # its middle is that of its box, to rounding
            middle = pin.mesh.bounds.mean(axis=0)[:2]
            assert middle == pytest.approx(scene.linkage.pins[name].second_point, abs=1e-9)


@pytest.mark.parametrize("name", ["in space", "columns in two bodies, in space"])
def test_left_and_right_are_on_the_sides_that_the_machine_has_them(name: str) -> None:
    shown, space = look(SCENES[name]), SCENES[name].space
    sided = [shape for shape in shown.shapes if shape.body.endswith(("_left", "_right"))]
    assert {"front_link_left", "front_link_right"} <= {shape.body for shape in sided}
    for shape in sided:
        beside = space.bodies[shape.body].centre[2]
        assert (shape.mesh.bounds[:, 2].mean() > 0.0) == (beside > 0.0), shape.name
    for strut in (shape.strut for shape in shown.shapes if shape.strut):
        assert (strut.foot_point[2] > 0.0) == strut.name.endswith("_right")  # as of bodies
    assert space.bodies["front_link_left"].centre[2] < 0.0 < space.bodies["front_link_right"].centre[2]


# --- rods ---


# --- any size ---


SHIFT = st.tuples(st.floats(-0.08, 0.08), st.floats(-0.08, 0.08))


@settings(deadline=None, max_examples=often(15))
@given(shifts=st.fixed_dictionaries(dict.fromkeys(PIVOTS, SHIFT)))
def test_other_pivots_give_closed_surfaces_too(shifts: dict[str, tuple[float, float]]) -> None:
    try:
        machine = reference_support()
        pivots: dict[str, Any] = {
            name: (getattr(machine, name)[0] + x, getattr(machine, name)[1] + y)
            for name, (x, y) in shifts.items()
        }
        scenario = Scenario(machine=replace(machine, **pivots), drive=CubicStep(stroke=0.1), duration=5.0)
    except (InputError, ValueError):  # links that do not reach each other
        assume(False)
    for shape in look(scenario).shapes:
        assert shape.mesh.is_watertight, shape.name
        assert shape.mesh.volume > 0.0, shape.name
        assert np.isfinite(shape.mesh.vertices).all(), shape.name


BEARING = JournalBearing(bore_radius=0.3, clearance=0.03)
LAW = LankaraniNikravesh(stiffness=1e9, restitution=0.7)
STAND = Scenario(
    machine=ImpactStand(bore_mass=3.0, journal_mass=2.0, speed=0.1),
    pins={"pin": ClearancePin(contact=JournalContact(bearing=BEARING, normal=LAW, friction=Frictionless()))},
    duration=0.1,
)


def test_a_journal_fits_its_bore() -> None:
    shapes = {shape.name: shape for shape in look(STAND).shapes}
    pin = shapes["pin_pin"]
    assert pin.body == "journal"
    # a polygon of 32 corners that makes contact its circle
    assert pin.mesh.bounds[1, 0] == pytest.approx(BEARING.journal_radius, rel=1e-9)
    place = STAND.linkage.pins["pin"]
    away = np.linalg.norm(shapes["bore"].mesh.vertices[:, :2] - np.array(place.first_point), axis=1)
    assert away.min() == pytest.approx(BEARING.bore_radius, rel=1e-9)  # corners of the bore are on its circle
    assert planar_pins(STAND)["pin"].bore.body == "bore"
    other = replace(STAND, pins={"pin": replace(STAND.clearance_pins["pin"], bore="second")})
    assert planar_pins(other)["pin"].bore.body == "journal"
    assert {s.name: s for s in look(other).shapes}["pin_pin"].body == "bore"


def test_a_class_of_ones_own_registers_its_look() -> None:
    class Own:
        """A machine that looks like nothing; no value, so that other tests do not find it."""

    nothing = Look((), 0.0)
    assert look_of.dispatch(Own) is look_of.dispatch(ImpactStand)
    look_of.register(Own, lambda machine, scenario: nothing)
    assert look_of.dispatch(Own)(None, STAND) is nothing
    assert look_of.dispatch(ImpactStand) is not look_of.dispatch(Own)
    assert look_of.dispatch(HydraulicSupport) is look_of.dispatch(TwoLegShield)


def pins_of(scenario: Scenario) -> dict[str, PlacedPin]:
    return {pin.name: pin for pin in placed_pins(scenario)}


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize(("bore", "journal"), [("first", "second"), ("second", "first")])
def test_the_bore_is_on_the_body_that_the_scenario_says(dimensions: int, bore: str, journal: str) -> None:
    with_clearance = ClearancePin(contact=paper_contact(1.5, 0.0), bore=bore, eccentricity=(0.0, -0.0015))
    scenario = replace(loose_support(dimensions=dimensions), pins={PIN: with_clearance})
    pin = pins_of(scenario)[PIN]
    place = scenario.linkage.pins[PIN]
    assert pin.bore.body == getattr(place, bore)
    assert pin.journal.body == getattr(place, journal)
    assert pin.bore.point[:2] == pytest.approx(getattr(place, f"{bore}_point"))
    assert pin.journal.point[:2] == pytest.approx(getattr(place, f"{journal}_point"))
    # the journal starts at the bottom of its bore; rounding of places of some metres
    apart = [pin.journal.point[k] - pin.bore.point[k] for k in range(2)]
    assert apart == pytest.approx([0.0, -0.0015], abs=1e-12)


small = st.floats(-0.5, 0.5)


# rounding: a few units of the last place of numbers about 1
@given(st.floats(-1.2, 1.2), small, small, small)
def test_rotations_are_found_from_the_angles_of_the_channels(z: float, a: float, b: float, c: float) -> None:
    asked = (Rotation.from_rotvec([a, b, c]) * Rotation.from_rotvec([0.0, 0.0, z])).as_matrix()[None]

    def context(row: int, column: int) -> np.ndarray:
        return np.arctan2(asked[:, row, column], asked[:, column, column])

    found = turned(context(1, 0), context(2, 1), context(0, 2))
    assert found == pytest.approx(asked, abs=1e-13)
