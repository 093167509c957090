"""What machines look like that say no more of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import ClearancePin, HydraulicSupport, Scenario, TwoLegShield
from support_exudyn.machines.free_impact import ImpactStand
from support_exudyn.postprocessing.look.looks import look, look_of
from support_exudyn.postprocessing.look.poses import planar_pins
from support_exudyn.postprocessing.look.shapes import Look
from user_forces import Frictionless, JournalBearing, JournalContact, LankaraniNikravesh

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
