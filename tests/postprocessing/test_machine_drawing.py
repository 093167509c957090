"""The drawing of a machine from its side."""

from __future__ import annotations

import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from support_exudyn import ClearancePin, CubicStep, CylinderAndRod, OwnBody, Scenario
from support_exudyn.files.machines.read import shipped
from support_exudyn.machines.free_impact import ImpactStand
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.machine import MARK, machine_drawing
from support_exudyn.postprocessing.figures.outlines import shapes
from support_exudyn.postprocessing.look.looks import look
from tests import figure_checks
from tests.cases.run_cases import loose_slider_crank, loose_support, paper_contact, slider_crank, support

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


def rings(drawing: Figure) -> list[Circle]:
    """The rings of marked pins, in the order of the pins."""
    return [
        patch
        for patch in drawing.axes[0].patches
        if isinstance(patch, Circle)
        and to_hex(patch.get_edgecolor()) == MARK.lower()
        and patch.get_linewidth() == 2.0
    ]


@pytest.mark.parametrize("name", SCENES)
def test_a_machine_is_drawn_whole_and_fits_a_page(name: str) -> None:
    scenario = SCENES[name]
    drawing = machine_drawing(scenario)
    assert 25.4 * drawing.get_figwidth() <= 180.0
    assert 25.4 * drawing.get_figheight() <= 220.0
    with style.look():
        assert not figure_checks.cut_off(drawing)
        words = [text for text, _ in figure_checks.texts(drawing)]
    assert "forward" in words
    assert len(rings(drawing)) == len(scenario.clearance_pins)
    axes = drawing.axes[0]
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    wide, tall = drawing.get_size_inches()
    assert (right - left) / wide == pytest.approx((high - low) / tall)  # as long as it is high
    for shape in shapes(look(scenario)) if "crank" not in name else ():
        a, b, c, d = shape.outline.bounds
        assert left < a < c < right
        assert low < b < d < high
