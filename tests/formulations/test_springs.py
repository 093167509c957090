"""Springs, dampers and torques between bodies: published numbers, closed forms, energy, momentum, refusals."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from studies.common.paper_machine import oil_columns
from support_exudyn import (
    AppliedTorque,
    Body,
    HarmonicCourse,
    Held,
    Linkage,
    Machine,
    PinPlace,
    Scenario,
    SolverSettings,
    SpringDamper,
    TableCourse,
    TorsionSpring,
    reference_support,
    simulate,
)
from support_exudyn.scenario.timescales import timescales
from tests.linkage_cases import CrankRocker
from user_forces.values.value import Vector2, value

MASS, INERTIA = 3.0, 0.2
ROCKER = CrankRocker(angle=0.3, speed=10.0)
SPRING = SpringDamper(
    body="rocker", point=ROCKER.middle("rocker"), other="crank", other_point=ROCKER.middle("crank"),
    stiffness=3000.0, free_length=0.30, damping=40.0,
)  # fmt: skip
TORQUE = AppliedTorque(body="rocker", full_torque=6.0)
FREE = replace(ROCKER, springs={"spring": SPRING, "torque": TORQUE})
# crank [rad], its rate [rad/s], rocker [rad] at times [s], of another program
PUBLISHED = {
    0.1: (-0.21787379508, -13.007088574, 1.6177682373),
    0.5: (-0.95903261389, 17.913487530, 1.9662625131),
    2.0: (-0.97038891299, 11.547594255, 1.9706463045),
}


@value
class Loose(Machine):
    """Two bodies that nothing holds but loads, or one on a pin at the ground."""

    pinned: bool = False
    velocity: Vector2 = (0.0, 0.0)
    spin: float = 0.0

    def linkage(self) -> Linkage:
        """Bodies a metre apart."""
        one = Body(mass=MASS, inertia=INERTIA, centre=(1.0, 0.0), velocity=self.velocity, spin=self.spin)
        if self.pinned:
            place = PinPlace(first="ground", second="one", first_point=(1.0, 0.0), second_point=(1.0, 0.0))
            return Linkage(bodies={"one": one}, pins={"pin": place})
        other = Body(mass=2.0 * MASS, inertia=0.7, centre=(0.0, 0.0))
        return Linkage(bodies={"one": one, "other": other})


def free(machine: Machine, **given: object) -> Scenario:
    usual = {"duration": 0.5, "step": 1e-4, "record_period": 1e-2, "gravity": (0.0, 0.0)}
    return Scenario(machine=machine, **(usual | given))  # type: ignore[arg-type]


def crank_rocker(duration: float, **settings: object) -> dict[float, np.ndarray]:
    """The crank's angle and rate and the rocker's angle at the published times."""
    result = simulate(Scenario(machine=FREE, duration=duration, record_period=0.1, **settings))
    channels = ("crank.angle", "crank.angular_velocity", "rocker.angle")
    rows = np.array([result[name] for name in channels]).T
    return {t: rows[round(10 * t)] for t in PUBLISHED if t <= duration}


def test_a_free_crank_rocker_moves_as_published() -> None:
    # the usual tolerance of Newton's method leaves 8e-8
    engine = SolverSettings(newton_tolerance=1e-11)
    coarse, fine = (crank_rocker(0.5, step=step, solver=engine) for step in (2e-4, 1e-4))
    for t, row in fine.items():  # second order in the step, which is taken out
        assert (4.0 * row - coarse[t]) / 3.0 == pytest.approx(PUBLISHED[t], rel=1e-6)
    compiled = crank_rocker(2.0, formulation="compiled", solver=SolverSettings(tolerance=1e-11))
    for t, row in compiled.items():
        assert row == pytest.approx(PUBLISHED[t], rel=1e-9)  # its last digit


def test_energies_of_a_free_crank_rocker_add_up() -> None:
    result = simulate(Scenario(machine=FREE, duration=0.5, step=1e-4))
    length, force = result["spring.length"], result["spring.force"]
    assert length[0] == pytest.approx(SPRING.start_length, rel=1e-12)
    assert result["energy.elastic"] == pytest.approx(1500.0 * (length - 0.3) ** 2, rel=1e-12)
    assert force == pytest.approx(-3000.0 * (length - 0.3) - 40.0 * np.gradient(length, result.time), abs=2.0)
    assert result["torque.moment"] == pytest.approx(6.0)
    turned = result["rocker.angle"] - result["rocker.angle"][0]
    assert result["energy.work"] == pytest.approx(6.0 * turned, abs=1e-4)
    assert np.all(np.diff(result["energy.damping_loss"]) >= 0.0)
    turnover = np.ptp(result["energy.kinetic"])
    assert result.energy_error < 1e-4 * turnover


def test_records_know_the_forces_of_springs() -> None:
    # accelerations of records follow from forces, those of the integrator from velocities
    result = simulate(Scenario(machine=FREE, duration=0.1, step=1e-4))
    slope = np.gradient(result["crank.angular_velocity"], result.time)[5:-5]
    acceleration = result["crank.angular_acceleration"]
    assert acceleration[5:-5] == pytest.approx(slope, abs=2e-3 * np.abs(acceleration).max())


def test_a_torsional_pendulum_swings_as_its_closed_form() -> None:
    spring = TorsionSpring(body="one", stiffness=300.0, free_turn=0.4, damping=0.8)
    scene = free(Loose(pinned=True, spin=2.0), loads={"spring": spring}, step=5e-5)
    result = simulate(scene)
    slow, fast = 0.5 * 0.8 / INERTIA, math.sqrt(300.0 / INERTIA)
    damped = math.sqrt(fast**2 - slow**2)
    cosine, sine = -0.4, (2.0 - 0.4 * slow) / damped
    t = result.time
    turn = 0.4 + np.exp(-slow * t) * (cosine * np.cos(damped * t) + sine * np.sin(damped * t))
    assert result["spring.angle"] == pytest.approx(turn, abs=2e-5)
    moment = -300.0 * (turn - 0.4) - 0.8 * result["one.angular_velocity"]
    assert result["spring.moment"] == pytest.approx(moment, abs=1e-2)
    assert result["energy.elastic"] == pytest.approx(150.0 * (turn - 0.4) ** 2, abs=2e-3)
    assert np.abs(result["energy.balance"]).max() < 1e-4 * result["energy.elastic"].max()
    assert timescales(scene).resting == pytest.approx(1.0 / fast, rel=1e-12)


def test_what_acts_between_two_bodies_leaves_their_momentum_alone() -> None:
    loads = {
        "spring": SpringDamper(
            body="one", point=(1.1, 0.2), other="other", other_point=(-0.1, 0.1), stiffness=500.0,
            free_length=0.7, damping=2.0,
        ),
        "coil": TorsionSpring(body="other", other="one", stiffness=20.0, free_turn=0.5, damping=0.1),
        "motor": AppliedTorque(body="one", other="other", full_torque=5.0, start=0.1, end=0.3),
    }  # fmt: skip
    result = simulate(free(Loose(velocity=(0.3, 0.5), spin=3.0), loads=loads))
    masses, inertias = {"one": MASS, "other": 2.0 * MASS}, {"one": INERTIA, "other": 0.7}
    for axis, start in (("x", 0.3), ("y", 0.5)):
        total = sum(mass * result[f"{name}.velocity_{axis}"] for name, mass in masses.items())
        assert total == pytest.approx(MASS * start, rel=1e-9)
    spun = sum(inertias[name] * result[f"{name}.angular_velocity"] for name in masses)
    for name, mass in masses.items():
        spun = spun + mass * (
            result[f"{name}.x"] * result[f"{name}.velocity_y"]
            - result[f"{name}.y"] * result[f"{name}.velocity_x"]
        )
    assert np.ptp(spun) < 1e-6 * np.abs(spun).max()
    assert np.ptp(result["one.angular_velocity"]) > 1.0


def test_courses_give_their_impulse() -> None:
    # a turn of a table and of a sine, which the body's spin adds up; undamped steps are a trapezoidal rule
    undamped = SolverSettings(spectral_radius=1.0)
    table = TableCourse(times=(0.1, 0.2, 0.4), shares=(0.0, 1.0, -0.5), between="linear")
    turned = simulate(
        free(
            Loose(pinned=True),
            loads={"m": AppliedTorque(body="one", full_torque=4.0, course=table)},
            solver=undamped,
        )
    )
    gained = 4.0 * (0.05 + 0.05) / INERTIA
    assert turned["one.angular_velocity"][40] == pytest.approx(gained, rel=1e-9)
    assert turned["m.moment"][[0, 10, 15, 20, 30, 50]] == pytest.approx([0.0, 0.0, 2.0, 4.0, 1.0, -2.0])
    sine = HarmonicCourse(period=0.4, phase=0.3, mean=0.5)
    scene = free(Loose(pinned=True), loads={"m": AppliedTorque(body="one", full_torque=4.0, course=sine)})
    rate = 2.0 * math.pi / 0.4
    known = 4.0 / INERTIA * (0.5 * 0.5 + (math.cos(0.3) - math.cos(rate * 0.5 + 0.3)) / rate)
    result = simulate(scene)
    assert result["one.angular_velocity"][-1] == pytest.approx(known, rel=1e-6)
    assert timescales(scene).drive == pytest.approx(0.4 / (2.0 * math.pi), rel=1e-12)


def test_a_support_settles_with_a_spring_between_two_bodies() -> None:
    shield = reference_support().linkage().bodies["shield"].centre
    tip = reference_support().linkage().points["tip"].point
    spring = SpringDamper(body="canopy", point=tip, other="shield", other_point=shield, stiffness=2e5)
    scene = Scenario(
        machine=reference_support(),
        actuators=oil_columns(),
        drive=Held(),
        loads={"spring": spring},
        start="settled",
        duration=0.02,
    )
    result = simulate(scene)
    for body in ("canopy", "shield"):
        assert np.abs(result[f"{body}.angular_velocity"]).max() < 1e-8
    assert result["spring.force"][0] == pytest.approx(-2e5 * result["spring.length"][0], rel=1e-9)
