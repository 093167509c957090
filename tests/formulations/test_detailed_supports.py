"""Supports in more detail: the tail beam on its jack, actuators as cylinder and rod, the two-leg shield."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from studies.common.paper_machine import JACK
from support_exudyn import (
    CubicStep,
    Held,
    OwnBody,
    Result,
    Scenario,
    UniformSpeed,
    cylinders_and_rods,
    reference_support,
    simulate,
)
from support_exudyn.files.machines.read import read_machine
from support_exudyn.machines.check import check_machine
from support_exudyn.model.plane_geometry import moved
from support_exudyn.postprocessing.pytest_plugin import SimulateCached
from tests.cases.run_cases import support

G = 9.81
RISE = CubicStep(start=0.05, end=0.45, stroke=0.1)
RIGID = {"tail_beam": OwnBody()}
SOFT = {"tail_beam": OwnBody(jack=JACK)}


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


def test_a_rigid_jack_takes_part_in_the_impulse_of_a_sudden_start() -> None:
    scenario = support(drive=UniformSpeed(stroke=0.05, start=0.05, end=0.25), duration=0.1)
    (one,), (rigid,), (soft,) = (
        simulate(replace(scenario, parts=parts)).impulses for parts in ({}, RIGID, SOFT)
    )
    assert sorted(rigid.actuators) == ["front_column", "rear_column", "tail_jack"]
    assert sorted(soft.actuators) == ["front_column", "rear_column"]
    # the same masses are set in motion; rounding
    for name, impulse in one.actuators.items():
        assert rigid.actuators[name] == pytest.approx(impulse, rel=1e-9)
    assert rigid.energy == pytest.approx(one.energy, rel=1e-9)


# --- actuators as cylinder and rod ---


NAMES = ("front_column", "rear_column")


# --- statics ---


@pytest.fixture(scope="module")
def held() -> Result:
    return simulate(support(actuators=cylinders_and_rods(), drive=Held(), duration=0.01))


@pytest.mark.parametrize("name", NAMES)
def test_pins_and_guide_carry_what_a_static_balance_says(held: Result, name: str) -> None:
    machine = reference_support()
    start = machine.start()
    front = name == "front_column"
    foot = machine.front_foot if front else machine.rear_foot
    head = start.ends["front_head"] if front else start.ends["rear_head"]
    model = cylinders_and_rods()[name]
    length = math.dist(foot, head)
    u = np.subtract(head, foot) / length
    n = np.array([-u[1], u[0]])
    cylinder, rod = model.cylinder_mass * G, model.rod_mass * G
    push = held[f"{name}.force"][-1]
    # along the actuator: the rod hangs on the drive's force, the cylinder's weight goes down to the foot
    along_head, along_foot = push - rod * u[1], push + cylinder * u[1]
    # across it: both together are a beam on two supports
    on_head = n[1] * (cylinder * model.cylinder_centre + rod * (length - model.rod_centre)) / length
    on_foot = n[1] * (cylinder + rod) - on_head
    of_rod = along_head * u - on_head * n  # on the canopy
    of_ground = along_foot * u + on_foot * n  # on the cylinder

    def pin(end: str) -> np.ndarray:
        return np.array([held[f"pin.{name}_{end}.force_{axis}"][-1] for axis in "xy"])

    # Newton's tolerance of 1e-8 on 10 kN
    np.testing.assert_allclose(pin("head"), of_rod, atol=1e-3)
    np.testing.assert_allclose(pin("foot"), of_ground, atol=1e-3)
    # the guide's force, through the head, is what the head's pin leaves of the rod's weight across; its moment
    # what that weight has about the head
    assert held[f"{name}_guide.force"][-1] == pytest.approx(abs(rod * n[1] - on_head), abs=1e-3)
    assert held[f"{name}_guide.moment"][-1] == pytest.approx(rod * abs(n[1]) * model.rod_centre, abs=1e-3)


# --- the two-leg shield ---


DATA = read_machine("two_leg_shield")
MACHINE: Any = DATA.machine
SHIELD_RISE = Scenario(
    machine=MACHINE, drive=CubicStep(stroke=1.15, start=0.1, end=2.1), duration=2.4, step=1e-3
)


@pytest.fixture(scope="module")
def shield_rise(simulate_cached: SimulateCached) -> Result:
    return simulate_cached(SHIELD_RISE)


def test_the_canopy_keeps_level_while_the_leg_is_driven(shield_rise: Result) -> None:
    # the ram's curve is right to 1e-12 m; the solver closes joints within some 1e-12 m
    assert np.abs(shield_rise["canopy.angle"]).max() < 1e-10
    assert shield_rise["tip.y"][-1] - shield_rise["tip.y"][0] == pytest.approx(1.1919, abs=1e-4)
    assert np.ptp(shield_rise["tip.x"]) < 0.0125


@pytest.mark.parametrize("at", [0, -1])
def test_at_rest_forces_are_those_of_the_check(shield_rise: Result, at: int) -> None:
    station = check_machine(DATA, 1.15).ways[0].moved[at]
    for pin, force in station.forces.pins.items():
        got = np.array([shield_rise[f"pin.{pin}.force_x"][at], shield_rise[f"pin.{pin}.force_y"][at]])
        # the solver's tolerance, 1e-8 of 1e5 N, and what is left of the ramp's end
        assert got == pytest.approx(force, abs=1.0), pin
    for column, push in station.forces.actuators.items():
        assert shield_rise[f"{column}.force"][at] == pytest.approx(push, abs=1.0)
