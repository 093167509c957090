"""Pins with clearance: any pin may be one, a run starts anywhere in the bore, and small ones tend to ideal."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from studies.common.paper_machine import oil_columns
from support_exudyn import (
    ClearancePin,
    CubicStep,
    Held,
    Result,
    Scenario,
    SolverSettings,
    reference_support,
    simulate,
)
from tests.cases.run_cases import FORCE, PIN, paper_contact, support
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    Exact,
    JournalBearing,
    JournalContact,
    internal_contact_stiffness,
)

CLEARANCE = 1.5e-3  # [m]
DEPTH = f"pin.{PIN}.depth"


def eccentric(x: float, y: float, bore: str = "first", **changes: Any) -> Scenario:
    """The held support with its clearance journal there [m] at the start."""
    pin = ClearancePin(contact=paper_contact(1e3 * CLEARANCE, 0.0), bore=bore, eccentricity=(x, y))
    return support(**{"pins": {PIN: pin}, "drive": Held(), "duration": 0.03} | changes)


def sense(bore: str) -> float:
    """Which way the journal goes in its bore as the support falls: down, or up if the bore falls."""
    return -1.0 if bore == "first" else 1.0


BORES = pytest.mark.parametrize("bore", ["first", "second"])


@BORES
def test_a_journal_pressed_in_starts_with_the_force_of_its_law(bore: str) -> None:
    deep = 1e-4
    scenario = eccentric(0.0, sense(bore) * (CLEARANCE + deep), bore)
    normal = scenario.clearance_pins[PIN].contact.normal
    result = simulate(scenario)
    assert result[DEPTH][0] == pytest.approx(deep, abs=1e-12)  # rounding of coordinates
    # 1.5 times the rounding of the depth, relative
    assert result[FORCE][0] == pytest.approx(normal.elastic_force(deep), rel=1e-7)
    # 1 J of the contact is set free by steps that follow it: 7e-5 J, where the step of 0.5 ms left 0.06 J
    assert result.energy_error < 5e-4
    assert result["energy.elastic"][0] == pytest.approx(normal.elastic_energy(deep), rel=1e-7)


@pytest.mark.parametrize(("bore", "over"), [("first", 1e-4), ("second", 0.0)])
def test_the_compiled_formulation_and_space_start_and_go_on_alike(bore: str, over: float) -> None:
    # pressed in on the side from which it flies across the bore, or free
    place = (0.0, -sense(bore) * (CLEARANCE + over)) if over else (1e-3, -5e-4)
    scenario = eccentric(*place, bore, actuators=oil_columns())
    flat = simulate(scenario)
    compiled = simulate(replace(scenario, formulation="compiled"))
    space = simulate(replace(scenario, dimensions=3))
    assert len(flat.onsets[PIN]) >= 1
    for other, close in ((compiled, 1e-5), (space, 1e-7)):
        assert other[FORCE][0] == pytest.approx(flat[FORCE][0], rel=1e-7, abs=1e-6)  # rounding of the depth
        first, theirs = flat.onsets[PIN][0], other.onsets[PIN][0]
        # 14 ms of flight by both methods; measured 7e-7 s and 5e-6 of the speed compiled, else 1e-10
        assert theirs.time == pytest.approx(first.time, abs=0.2 * close)
        assert theirs.speed == pytest.approx(first.speed, rel=10.0 * close)
        assert other.energy_error < 5e-3
        # at rest at the start, in the same place
        for name in ("tip.x", "tip.y", f"pin.{PIN}.eccentricity_x", f"pin.{PIN}.eccentricity_y"):
            assert other[name][0] == pytest.approx(flat[name][0], abs=1e-11)


@BORES
@pytest.mark.parametrize("gap", [0.0, 9e-13])
def test_a_journal_put_on_its_bore_within_rounding_has_no_impact_in_either_formulation(
    bore: str, gap: float
) -> None:
    scenario = eccentric(0.0, sense(bore) * (CLEARANCE - gap), bore, duration=0.01)
    engine, compiled = (simulate(replace(scenario, formulation=name)) for name in ("exudyn", "compiled"))
    assert engine.onsets[PIN] == compiled.onsets[PIN] == ()
    assert compiled.largest_force[PIN] == pytest.approx(engine.largest_force[PIN], rel=1e-3)  # measured: 2e-4


@BORES
@pytest.mark.parametrize("gap", [0.0, 9e-13])
def test_a_journal_put_on_its_bore_leaves_it_at_once_if_it_falls_away(bore: str, gap: float) -> None:
    scenario = eccentric(0.0, sense(bore) * (gap - CLEARANCE), bore, duration=0.03)
    engine, compiled = (simulate(replace(scenario, formulation=name)) for name in ("exudyn", "compiled"))
    theirs, first = engine.onsets[PIN][0], compiled.onsets[PIN][0]
    assert first.time == pytest.approx(theirs.time, abs=1e-7)
    assert first.speed == pytest.approx(theirs.speed, rel=1e-6)
    assert compiled[FORCE][compiled["time"] < first.time].max() < 1e-12  # a depth of 1e-18 m by rounding


# --- any pin ---

PINS = tuple(reference_support().linkage().pins)


@pytest.mark.parametrize("name", PINS)
@pytest.mark.parametrize("bore", ["first", "second"])
def test_a_tight_loose_pin_carries_what_the_ideal_one_does(name: str, bore: str) -> None:
    ideal = simulate(support(duration=0.01, drive=Held()))
    pin = ClearancePin(contact=paper_contact(0.01, 0.0), bore=bore)
    with_clearance = simulate(support(duration=0.01, drive=Held(), pins={name: pin}, start="settled"))
    for part in ("force_x", "force_y"):
        # the posture moves by 0.01 mm and the depth of 0.1 to 0.2 mm, of lengths of 400 mm and more
        scale = ideal[f"pin.{name}.force"][0]
        assert with_clearance[f"pin.{name}.{part}"][0] == pytest.approx(
            ideal[f"pin.{name}.{part}"][0], abs=5e-3 * scale
        )


# --- a pin that shrinks to a micrometre ---


CLEARANCES = np.array([1e-3, 1e-4, 1e-5, 1e-6])  # [m]
RISE = {"drive": CubicStep(start=0.0, end=2.0), "duration": 1.0, "step": 1e-3}


def rise(clearance: float) -> Result:
    """From static equilibrium; little restitution, so that the start of the drive leaves no vibration."""
    bearing = JournalBearing(bore_radius=0.0655, clearance=clearance)
    law = Exact(stiffness=internal_contact_stiffness(bearing, STEEL, STEEL_35CRMO), restitution=0.1)
    pin = ClearancePin(contact=JournalContact(bearing=bearing, normal=law))
    return simulate(support(pins={PIN: pin}, start="settled", solver=SolverSettings(impact_steps=64), **RISE))


@pytest.fixture(scope="module")
def ideal() -> Result:
    return simulate(support(**RISE))


@pytest.fixture(scope="module")
def with_clearance() -> list[Result]:
    return [rise(clearance) for clearance in CLEARANCES]


def eccentricity(with_clearance: list[Result]) -> np.ndarray:
    """Mean distance of the journal's centre from the bore's [m]: clearance and depth of contact."""
    depth = np.array([result[f"pin.{PIN}.depth"].mean() for result in with_clearance])
    return CLEARANCES + depth


def orders(errors: np.ndarray, size: np.ndarray) -> np.ndarray:
    return np.diff(np.log(errors)) / np.diff(np.log(size))


def _rms(result: Result, ideal: Result, inside: np.ndarray) -> float:
    apart = [(result[f"{FORCE}_{axis}"] - ideal[f"{FORCE}_{axis}"])[inside] for axis in "xy"]
    return float(np.sqrt(np.mean(apart[0] ** 2 + apart[1] ** 2)))


def test_depth_shrinks_with_the_cube_root_of_the_clearance(with_clearance: list[Result]) -> None:
    # internal contact: K ~ c^-1/2 and depth = (F/K)^(2/3), so depth ~ c^(1/3); R1 = R2 - c bends it by c/R2
    depth = eccentricity(with_clearance) - CLEARANCES
    np.testing.assert_allclose(orders(depth, CLEARANCES), 1.0 / 3.0, atol=0.01)


def test_force_tends_to_that_of_the_ideal_pin_with_first_order(
    ideal: Result, with_clearance: list[Result]
) -> None:
    inside = ideal.time > 0.1  # behind the jump of the drive's acceleration
    errors = np.array([_rms(result, ideal, inside) for result in with_clearance])
    # linear in where the journal stands; the depth is not the same throughout, hence the margin
    np.testing.assert_allclose(orders(errors, eccentricity(with_clearance)), 1.0, atol=0.02)
    assert errors[-1] < 2e-5 * ideal[FORCE].max()  # 1 um
