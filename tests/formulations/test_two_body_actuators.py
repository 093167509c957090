"""Actuators as cylinder and rod: a static balance, impulses, the energy balance."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import (
    CubicStep,
    Drive,
    Held,
    OilColumn,
    Result,
    UniformSpeed,
    bore_area,
    cylinders_and_rods,
    reference_support,
    simulate,
)
from tests.cases.run_cases import support

G = 9.81
RISE = CubicStep(start=0.05, end=0.45, stroke=0.1)
OIL = OilColumn(bore_area=bore_area(0.25, number=2), oil_length=0.5, bulk_modulus=1.5e9)
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


# --- energy ---


@pytest.mark.parametrize(
    ("oil", "drive"), [(None, RISE), (OIL, replace(RISE, stroke=-0.1))], ids=["rigid", "oil"]
)
def test_energy_adds_up_with_second_order(oil: OilColumn | None, drive: Drive) -> None:
    coarse, fine = (
        simulate(support(actuators=cylinders_and_rods(oil), drive=drive, duration=0.5, step=step))
        for step in ((2.5e-4, 1.25e-4) if oil else (1e-3, 5e-4))
    )
    # measured 2e-7 of a work of 5 kJ with rigid actuators, 1e-6 with oil, which vibrates
    assert fine.energy_error < 3e-6 * np.abs(fine["energy.work"]).max()
    assert fine.energy_error < 0.35 * coarse.energy_error


def test_the_impulse_of_a_sudden_start_passes_through_rod_and_cylinder() -> None:
    speed = 0.25
    drive = UniformSpeed(stroke=0.1, start=0.05, end=0.45)
    result = simulate(support(actuators=cylinders_and_rods(), drive=drive, duration=0.5))
    first, last = result.impulses
    for impulse in (first, last):
        assert sorted(impulse.actuators) == sorted(NAMES)
    # from rest: an impulse through actuators that move at v does work of impulse times v/2; rounding
    assert first.energy == pytest.approx(0.5 * speed * sum(first.actuators.values()), rel=1e-9)
    # the step after a jump is known by its end only: 1e-4 J of 5 kJ have been seen, of first order in the step
    assert result.energy_error < 1e-6 * result["energy.work"].max()
    # with two bodies more is to be set in motion than with massless actuators and rods on the canopy
    plain = simulate(replace(result.scenario, actuators={}))
    assert plain.impulses[0].energy != pytest.approx(first.energy, rel=1e-4)
