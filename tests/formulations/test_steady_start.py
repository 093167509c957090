"""A drive that moves from the start on: velocities at time zero are those of the closed form."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import (
    Body,
    ClearancePin,
    LinearActuator,
    Linkage,
    Machine,
    Result,
    Scenario,
    SolverSettings,
    Steady,
    ravn_slider_crank,
    reference_support,
    simulate,
)
from support_exudyn.model.linkage import GROUND, pinned
from tests.cases.run_cases import CRANK_SPEED, SLIDER_PIN, paper_contact, slider_crank, slider_crank_contact
from tests.cases.run_cases import support as support_scenario
from user_forces import value

ANGLES = (0.7, -1.3)
WITH_CLEARANCE = {SLIDER_PIN: ClearancePin(contact=slider_crank_contact())}


def turning(start_angle: float, rate: float, **changes: object) -> Result:
    """20 steps of Ravn's slider-crank from an angle [rad] at a speed [rad/s]."""
    machine = replace(ravn_slider_crank(), start_angle=start_angle)
    return simulate(slider_crank(4e-5, machine=machine, drive=Steady(rate=rate), **changes))


@pytest.mark.parametrize("start_angle", ANGLES)
@pytest.mark.parametrize("rate", [CRANK_SPEED, -CRANK_SPEED])
@pytest.mark.parametrize("with_clearance", [False, True])
def test_a_crank_at_speed_starts_with_the_velocities_of_the_closed_form(
    start_angle: float, rate: float, with_clearance: bool
) -> None:
    result = turning(start_angle, rate, pins=WITH_CLEARANCE if with_clearance else {})
    machine = result.scenario.machine
    r, length, a = machine.crank_length, machine.rod_length, start_angle
    s, c = math.sin(a), math.cos(a)
    slider = machine.slider_speed(a, rate)
    # angle b of the rod by sin(b) = -(r/l) sin(a)
    rod = -r / length * c * rate / math.sqrt(1.0 - (r / length * s) ** 2)
    expected = {
        "crank.angular_velocity": rate,
        "crank.velocity_x": -0.5 * r * s * rate,
        "crank.velocity_y": 0.5 * r * c * rate,
        "rod.angular_velocity": rod,
        # its centre is in the middle between crank pin and slider
        "rod.velocity_x": 0.5 * (slider - r * s * rate),
        "rod.velocity_y": 0.5 * r * c * rate,
        "slider.velocity_x": slider,
        "slider.velocity_y": 0.0,
        "slider.angular_velocity": 0.0,
    }
    for name, speed in expected.items():
        # rounding of 524 rad/s
        assert result[name][0] == pytest.approx(speed, abs=1e-12), name


@pytest.mark.parametrize("start_angle", ANGLES)
def test_the_motion_goes_on_as_the_closed_form_says(start_angle: float) -> None:
    result = turning(start_angle, CRANK_SPEED)
    machine = result.scenario.machine
    angle = start_angle + CRANK_SPEED * result.time
    speed = np.array([machine.slider_speed(a, CRANK_SPEED) for a in angle])
    # of up to 28 m/s; generalised alpha at this step: 1e-6 m/s
    np.testing.assert_allclose(result["slider.velocity_x"], speed, atol=3e-6)
    # nothing is given by an impulse at the start
    assert result.impulses == ()
    force = np.array([-machine.slider_mass * machine.slider_acceleration(a, CRANK_SPEED) for a in angle])
    # of up to 2.7 kN; with velocities that do not fit, forces of the order of speed over step, 1e6 N
    np.testing.assert_allclose(result[f"pin.{SLIDER_PIN}.force_x"], force, atol=0.1)


def test_a_slider_with_clearance_flies_on() -> None:
    result = turning(0.7, CRANK_SPEED, pins=WITH_CLEARANCE)
    assert result.onsets[SLIDER_PIN] == ()
    # nothing pushes it until the journal has crossed its clearance; rounding of 20 steps
    np.testing.assert_allclose(
        result["slider.velocity_x"], result.scenario.machine.slider_speed(0.7, CRANK_SPEED), rtol=1e-13
    )


@pytest.mark.parametrize("rate", [0.25, -0.05])
@pytest.mark.parametrize("with_clearance", [False, True])
def test_actuators_at_speed_start_with_the_velocities_of_the_closed_form(
    rate: float, with_clearance: bool
) -> None:
    pins = {"rear_base": ClearancePin(contact=paper_contact(1.5, 0.0))} if with_clearance else {}
    result = simulate(support_scenario(drive=Steady(rate=rate), duration=1e-3, pins=pins))
    machine, small = reference_support(), 1e-5
    lower, upper = machine.extended(-small), machine.extended(small)
    assert lower is not None
    assert upper is not None
    slope = (upper.rear_link - lower.rear_link) / (2 * small)
    # central difference over 0.02 mm: 1e-9
    assert result["rear_link.angular_velocity"][0] == pytest.approx(slope * rate, rel=1e-8)
    tip = (upper.tip[0] - lower.tip[0]) / (2 * small), (upper.tip[1] - lower.tip[1]) / (2 * small)
    # tip and canopy are one body; its points move by the same central difference
    canopy = result["canopy.angular_velocity"][0]
    moved = (
        result["canopy.velocity_x"][0] - canopy * (result["tip.y"][0] - result["canopy.y"][0]),
        result["canopy.velocity_y"][0] + canopy * (result["tip.x"][0] - result["canopy.x"][0]),
    )
    assert moved == pytest.approx((tip[0] * rate, tip[1] * rate), rel=1e-7)
    assert result.impulses == ()


@value
class Lifted(Machine):
    """A bar on a pivot that an actuator from the ground holds up."""

    def linkage(self) -> Linkage:
        bar = Body(mass=20.0, inertia=2.0, centre=(0.6, 0.1))
        jack = LinearActuator(foot=GROUND, head="bar", foot_point=(0.7, -1.0), head_point=(1.0, 0.0))
        return Linkage(
            bodies={"bar": bar}, pins={"pivot": pinned(GROUND, "bar", (0.0, 0.0))}, actuators={"jack": jack}
        )


@pytest.mark.parametrize("formulation", ["exudyn", "compiled"])
def test_an_actuator_pushes_with_what_the_bar_asks_for(formulation: str) -> None:
    result = simulate(
        Scenario(
            machine=Lifted(),
            drive=Steady(rate=0.2),
            duration=1.0,
            record_period=0.01,
            formulation=formulation,
            solver=SolverSettings(tolerance=1e-9),
        )
    )
    out, about = math.hypot(0.7, 1.0), 2.0 + 20.0 * 0.37
    length = math.hypot(0.3, 1.0) + 0.2 * result.time
    # the law of cosines in the triangle of pivot, foot and head: its angle at the pivot
    angle = np.arccos((1.0 + out**2 - length**2) / (2.0 * out))
    turn = angle - angle[0]
    arm = out * np.sin(angle) / length  # of the force about the pivot: how the length grows with the turn
    bend = (out * np.cos(angle) - arm**2) / length
    spin, acceleration = 0.2 / arm, -bend * 0.2**2 / arm**3
    weight = 20.0 * 9.81 * (0.6 * np.cos(turn) - 0.1 * np.sin(turn))
    # joints hold it; the engine's rates and forces are of second order in steps of 0.5 ms
    rates, forces = (1e-11, 1e-10) if formulation == "compiled" else (1e-6, 1e-6)
    np.testing.assert_allclose(result["bar.angle"], turn, atol=1e-12)
    np.testing.assert_allclose(result["bar.angular_velocity"], spin, rtol=rates)
    np.testing.assert_allclose(result["jack.force"], (about * acceleration + weight) / arm, rtol=forces)
