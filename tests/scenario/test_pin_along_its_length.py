"""A pin with clearance in its machine: its length, what pin and links give, how hard it is pressed."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from support_exudyn import ClearancePin, Scenario, ravn_slider_crank, reference_support, simple_scenario
from support_exudyn.scenario.pin_pressure import FIRST_YIELD, pressed_pin, statically_pressed
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    Exact,
    Flores,
    InputError,
    Johnson,
    JournalContact,
    Material,
    PinInBore,
    effective_modulus,
)
from user_forces.backing import pin_stiffness

LINK = math.hypot(574.0, 862.0) / 1e3  # rear link of the reference support, from its pivots [m]
LINK_STIFFNESS = 2.07e11 * 500.0 / (7801.0 * LINK**2)  # 500 kg of steel


def pin_of(**keys: object) -> ClearancePin:
    keys = {"clearance_mm": 1.5, **keys}
    found = simple_scenario("reference", duration_s=1, drive={"mode": 2}, pins={"rear_base": keys})
    return found.clearance_pins["rear_base"]


def law_of(**keys: object) -> PinInBore:
    law = pin_of(**keys).contact.normal
    assert isinstance(law, PinInBore)
    return law


def test_a_pin_of_which_nothing_is_said_touches_along_its_length() -> None:
    law = law_of()
    assert law.length == 0.7
    assert law.effective_modulus == effective_modulus(STEEL, STEEL_35CRMO)
    assert (law.damping, law.restitution, law.delivered_restitution) == ("Exact", 0.9, pytest.approx(0.9))
    give = 1.0 / pin_stiffness(0.064, 0.7, STEEL_35CRMO) + 1.0 / LINK_STIFFNESS
    assert law.backing_stiffness == pytest.approx(1.0 / give, rel=1e-12)
    assert 3e9 < 1.0 / give < 5e9  # the joint as a whole, reckoned by hand elsewhere


def test_what_is_said_is_taken() -> None:
    assert law_of(backing_stiffness="rigid").backing_stiffness is None
    assert law_of(backing_stiffness_kN_per_mm=4e3).backing_stiffness == 4e9
    assert law_of(length_mm=350).length == 0.35
    assert law_of(law="Flores").damping == "Flores"
    soft = {"name": "soft", "elastic_modulus_GPa": 100, "poisson_ratio": 0.3, "density_kg_per_m3": 8000}
    material = Material(name="soft", elastic_modulus=1e11, poisson_ratio=0.3, density=8000.0)
    assert law_of(journal_material=soft).effective_modulus == effective_modulus(STEEL, material)


def test_in_python_the_length_makes_the_choice() -> None:
    simple = ClearancePin.simple(clearance=0.0015, bore_radius=0.0655, length=0.7)
    assert isinstance(simple.contact.normal, PinInBore)
    assert simple.contact.normal.backing_stiffness == pin_stiffness(0.064, 0.7, STEEL_35CRMO)
    rigid = ClearancePin.simple(
        clearance=0.0015, bore_radius=0.0655, length=0.7, law=Flores, backing_stiffness=math.inf
    )
    assert rigid.contact.normal == replace(simple.contact.normal, backing_stiffness=None, damping="Flores")
    spheres = ClearancePin.simple(clearance=0.0015, bore_radius=0.0655)
    assert isinstance(spheres.contact.normal, Exact)


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ({"stiffness": "external"}, "stiffness"),
        (
            {"stiffness": "paper", "backing_stiffness": "rigid"},
            'backing_stiffness: is of stiffness = "cylinders"',
        ),
        ({"law": "Hertz", "stiffness": "cylinders"}, "law = Hertz: has a force of its own; allowed with"),
        ({"stiffness": "paper", "length_mm": -1}, "length_mm"),
        ({"length_mm": 7e5}, "length_mm = 7"),
    ],
)
def test_what_does_not_fit_is_told(keys: dict[str, object], told: str) -> None:
    with pytest.raises(InputError, match=told):
        pin_of(**keys)


def test_a_length_that_nobody_knows_is_asked_for() -> None:
    pins = {"slider_pin": {"clearance_mm": 0.5, "stiffness": "cylinders"}}
    with pytest.raises(InputError, match=r"length_mm: missing, .*\[width_mm.pins\]"):
        simple_scenario("slider_crank", duration_s=0.1, drive={"type": "Steady", "rate_rpm": 10}, pins=pins)
    with pytest.raises(InputError, match=r"length: missing"):
        ClearancePin.simple(clearance=0.0015, bore_radius=0.0655, stiffness="cylinders")


# --- pressure ---


def test_a_pin_tells_pressure_angle_depth_and_slope() -> None:
    support = reference_support()
    pin = pin_of()
    found = pressed_pin(support, "rear_base", pin, 51.4e3)
    assert found.line is not None
    assert math.degrees(found.line.half_angle) == pytest.approx(1.34, rel=0.01)
    assert found.line.peak_pressure == pytest.approx(30.8e6, rel=0.01)
    assert found.depth == pytest.approx(1.92e-6 + 51.4e3 / 3.14e9, rel=0.02)
    assert found.stiffness == pytest.approx(1.0 / (1.0 / 3.0e10 + 1.0 / 3.14e9), rel=0.02)
    assert found.yield_share == pytest.approx(found.line.peak_pressure / (FIRST_YIELD * 3.45e8))
    assert found.warning is None
    # the pressure is that of the pin, whatever law the run has
    paper = pressed_pin(support, "rear_base", pin_of(stiffness="paper"), 51.4e3)
    assert paper.line == found.line
    assert paper.depth == pytest.approx(153e-6, rel=0.01)
    assert paper.stiffness == pytest.approx(5.04e8, rel=0.01)


def test_without_a_length_or_a_law_that_holds_it_nothing_is_made_up() -> None:
    simple = ClearancePin.simple(clearance=0.0005, bore_radius=0.01)
    found = pressed_pin(ravn_slider_crank(), "slider_pin", simple, 1e3)
    assert found.line is None
    assert math.isnan(found.yield_share)
    assert found.depth > 0.0
    law = Johnson(bearing=simple.contact.bearing, length=0.01, effective_modulus=1e11, restitution=0.9)
    short = ClearancePin(contact=JournalContact(bearing=simple.contact.bearing, normal=law))
    beyond = pressed_pin(ravn_slider_crank(), "slider_pin", short, 1e8)
    assert math.isnan(beyond.depth)
    assert math.isnan(beyond.stiffness)
    assert beyond.warning is not None
    assert beyond.warning.startswith("slider_pin: its law does not hold 1e+05 kN; allowed: ")


def test_the_static_load_is_that_of_the_weight() -> None:
    scenario = Scenario(machine=reference_support(), duration=1.0, pins={"rear_base": pin_of()})
    (found,) = statically_pressed(scenario)
    assert found.name == "rear_base"
    assert found.force == pytest.approx(60.7e3, rel=0.05)
