"""The drawing of a machine from its side."""

from __future__ import annotations

import pytest

from support_exudyn import ClearancePin, CubicStep, CylinderAndRod, OwnBody, Scenario
from support_exudyn.files.machines.read import shipped
from support_exudyn.machines.free_impact import ImpactStand
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.linkage_drawing import machine_drawing
from tests import figure_checks
from tests.cases.run_cases import loose_slider_crank, loose_support, paper_contact, slider_crank, support
from user_forces import InputError

COLUMN = CylinderAndRod(
    cylinder_mass=300.0, cylinder_centre=0.45, cylinder_inertia=20.0,
    rod_mass=200.0, rod_centre=0.45, rod_inertia=14.0,
)  # fmt: skip
LOOSE = ClearancePin(contact=paper_contact(1.5, 0.25))


def of_file(name: str, *pins: str) -> Scenario:
    machine = shipped(name).machine
    return Scenario(machine=machine, drive=CubicStep(stroke=0.1), pins=dict.fromkeys(pins, LOOSE), duration=5.0)


SCENES = {
    "support": loose_support(),
    "support, ideal": support(),
    "zf18000": of_file("zf18000", "shield_canopy"),
    "two legs": of_file("two_leg_shield", "rear_shield", "shield_canopy"),
    "columns in two bodies": loose_support(actuators={"front_column": COLUMN, "rear_column": COLUMN}),
    "tail beam, in space": loose_support(parts={"tail_beam": OwnBody()}, dimensions=3),
    "slider-crank": loose_slider_crank(0.1),
    "slider-crank, ideal": slider_crank(0.1),
    "stand": Scenario(
        machine=ImpactStand(bore_mass=3.0, journal_mass=2.0, speed=0.1), pins={"pin": LOOSE}, duration=0.1
    ),
}


@pytest.mark.parametrize("name", SCENES)
def test_a_machine_is_drawn_whole_with_a_ring_for_each_clearance_pin(name: str) -> None:
    scenario = SCENES[name]
    drawing = machine_drawing(scenario)
    with style.look():
        assert not figure_checks.cut_off(drawing)
    (axes,) = drawing.axes
    assert axes.get_aspect() == 1.0
    rings = [line for line in axes.get_lines() if line.get_markersize() == 12]
    assert len(rings) == len(scenario.clearance_pins)
    for ring, pin in zip(rings, scenario.clearance_pins, strict=True):
        place = scenario.linkage.pins[pin].second_point
        if "crank" not in name:  # which is turned
            assert [1e-3 * float(ring.get_data()[n][0]) for n in (0, 1)] == pytest.approx(place)
        clearance = scenario.clearance_pins[pin].contact.bearing.clearance
        assert str(ring.get_label()).endswith(f"c = {1e3 * clearance:.4g} mm")


def test_a_marked_pin_has_to_be_one_of_the_machine() -> None:
    with pytest.raises(InputError, match=r"knee.*no such pin; allowed: .*rear_base"):
        machine_drawing(support(), marked=("knee",))
