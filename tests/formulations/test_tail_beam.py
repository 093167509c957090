"""The tail beam as a body of its own on a jack, against the one that is fixed to the shield beam."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from studies.common.paper_machine import JACK, oil_columns
from support_exudyn import (
    ClearancePin,
    CubicStep,
    Held,
    Lumped,
    OwnBody,
    Result,
    SolverSettings,
    UniformSpeed,
    cylinders_and_rods,
    reference_support,
    simulate,
)
from support_exudyn.model.plane_geometry import moved
from support_exudyn.postprocessing.pytest_plugin import AssertClose, SimulateCached
from tests.cases.run_cases import FORCE, loose_support, paper_contact, support

G = 9.81
RISE = CubicStep(start=0.05, end=0.45, stroke=0.1)
RIGID = {"tail_beam": OwnBody()}
SOFT = {"tail_beam": OwnBody(jack=JACK)}


@pytest.fixture(scope="module")
def lumped(simulate_cached: SimulateCached) -> Result:
    return simulate_cached(support(drive=RISE, duration=0.5))


def test_a_lumped_part_is_what_is_there_by_default() -> None:
    assert support(parts={"tail_beam": Lumped()}).linkage == support().linkage


def test_a_rigid_jack_holds_the_tail_beam_as_if_it_were_fixed(
    lumped: Result, assert_close: AssertClose
) -> None:
    own = simulate(replace(lumped.scenario, parts=RIGID))
    assert_close(own, lumped, "1e-9 mm", channels=["tip.*"])  # rounding
    assert_close(own, lumped, "1e-12 rad", channels=["rear_link.angle"])
    np.testing.assert_allclose(np.ptp(own["tail_beam.angle"] - own["shield.angle"]), 0.0, atol=1e-12)
    off = np.abs(own[FORCE] - lumped[FORCE])
    # Newton's tolerance of 1e-8; in the steps after the drive's breaks, where joint forces overshoot, 5e-6
    assert np.median(off) < 1e-7 * lumped[FORCE].max()
    assert off.max() < 2e-5 * lumped[FORCE].max()
    for energy in ("kinetic", "potential", "work"):
        np.testing.assert_allclose(own[f"energy.{energy}"], lumped[f"energy.{energy}"], atol=1e-4)  # of 5 kJ


def test_a_rigid_jack_holds_it_through_impacts_too() -> None:
    scenario = loose_support(drive=RISE, duration=0.15)
    one, other = simulate(scenario), simulate(replace(scenario, parts=RIGID))
    # impacts multiply what Newton's tolerance leaves; of 0.44 MN
    np.testing.assert_allclose(other["tip.y"], one["tip.y"], atol=1e-8)
    np.testing.assert_allclose(other[FORCE], one[FORCE], atol=1e-4 * one[FORCE].max())


@pytest.mark.parametrize("parts", [RIGID, SOFT], ids=["rigid", "oil"])
def test_the_jack_carries_the_weight_about_the_hinge(parts: dict[str, OwnBody]) -> None:
    still = simulate(support(parts=parts, drive=Held(), duration=0.1))
    machine = reference_support()
    assert machine.tail_hinge is not None
    assert machine.tail_jack_foot is not None
    assert machine.tail_jack_head is not None
    start = machine.start()
    (tail,) = (part for part in machine.parts["shield"] if part.name == "tail_beam")
    hinge, foot, head, centre = (
        np.array(moved(point, machine.rear_shield, start.rear_shield, start.shield))
        for point in (machine.tail_hinge, machine.tail_jack_foot, machine.tail_jack_head, tail.centre)
    )
    u = (head - foot) / math.dist(head, foot)
    arm = head - hinge
    lever = arm[0] * u[1] - arm[1] * u[0]
    push = tail.mass * G * (centre - hinge)[0] / lever
    # Newton's tolerance of 1e-8
    np.testing.assert_allclose(still["tail_jack.force"], push, rtol=1e-7)
    pin = np.array([still["pin.shield_tail.force_x"][-1], still["pin.shield_tail.force_y"][-1]])
    np.testing.assert_allclose(pin, [0.0, tail.mass * G] - push * u, rtol=1e-6)
    # and stays where it is; rounding
    np.testing.assert_allclose(still["tail_beam.angle"], still["tail_beam.angle"][0], atol=1e-12)
    np.testing.assert_allclose(still["tip.y"], still["tip.y"][0], atol=1e-12)


def test_stiffer_jacks_tend_to_the_fixed_tail_beam_with_order_one() -> None:
    def off(stiffer: float) -> float:
        jack = replace(JACK, bulk_modulus=stiffer * JACK.bulk_modulus)
        parts = {"tail_beam": OwnBody(jack=jack)}
        soft = simulate(support(drive=RISE, duration=0.4, step=2.5e-4, parts=parts))
        turned = soft["tail_beam.angle"] - soft["shield.angle"]
        late = soft.time > 0.25  # the vibration of the start has died out
        return float(np.abs(turned - turned[0])[late].max())

    # compliance is what turns it: ten times stiffer, ten times less; 10 % for what still vibrates
    assert off(20.0) / off(200.0) == pytest.approx(10.0, rel=0.1)


def test_a_soft_jack_is_as_in_the_compiled_formulation(assert_close: AssertClose) -> None:
    scene = {"drive": RISE, "duration": 0.15, "actuators": oil_columns(), "parts": SOFT}
    compiled = simulate(loose_support(formulation="compiled", **scene))
    redundant = simulate(loose_support(step=1e-4, **scene))
    # measured 2e-7 m and 4e-7 rad: the Exudyn formulation's errors of impacts and steps
    assert_close(compiled, redundant, "0.002 mm", channels=["tip.y"])
    assert_close(compiled, redundant, "4e-6 rad", channels=["tail_beam.angle"])
    largest = compiled["tail_jack.force"].max()
    # measured 4e-5
    np.testing.assert_allclose(compiled["tail_jack.force"], redundant["tail_jack.force"], atol=3e-4 * largest)
    assert compiled.energy_error < 1e-4 * compiled.dissipated  # interpolation within the last steps


def test_energy_adds_up_with_all_that_there_is() -> None:
    hinge = ClearancePin(contact=paper_contact(1.0, 0.25))
    actuators = cylinders_and_rods(oil_columns()["front_column"])
    scenario = support(
        drive=RISE,
        duration=0.15,
        actuators=actuators,
        parts=SOFT,
        pins={"shield_tail": hinge},
        solver=SolverSettings(impact_steps=128),
    )
    result = simulate(scenario)
    assert len(result.onsets["shield_tail"]) > 1
    # impacts make three cushions of oil vibrate, which generalised alpha damps a little, with second order
    assert result.energy_error < 4e-3 * result.dissipated
    assert simulate(scenario.refined()).energy_error < 0.35 * result.energy_error


def test_a_rigid_jack_takes_part_in_the_impulse_of_a_sudden_start() -> None:
    drive = UniformSpeed(stroke=0.05, start=0.05, end=0.25)
    scenario = support(drive=drive, duration=0.1)
    (one,), (other,) = simulate(scenario).impulses, simulate(replace(scenario, parts=RIGID)).impulses
    assert sorted(other.actuators) == ["front_column", "rear_column", "tail_jack"]
    # the same masses are set in motion; rounding
    for name, impulse in one.actuators.items():
        assert other.actuators[name] == pytest.approx(impulse, rel=1e-9)
    assert other.energy == pytest.approx(one.energy, rel=1e-9)


def test_a_struck_tail_beam_on_oil_is_free() -> None:
    drive = UniformSpeed(stroke=0.05, start=0.05, end=0.25)
    (impulse,) = simulate(support(drive=drive, duration=0.1, parts=SOFT)).impulses
    assert sorted(impulse.actuators) == ["front_column", "rear_column"]
