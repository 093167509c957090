"""The compiled formulation against others: closed forms, conservation laws, scipy, published numbers."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from support_exudyn import (
    Body,
    ClearancePin,
    IdealPin,
    LinearActuator,
    Linkage,
    Machine,
    Result,
    Scenario,
    SolverSettings,
    Steady,
    simulate,
)
from support_exudyn.model.guides import ClearanceGuide
from support_exudyn.model.linkage import GROUND, pinned
from tests.analytic import delivered_restitution
from tests.cases.guide_cases import FreePair, pair_by_scipy, slider_crank, slider_crank_by_scipy, start_of
from tests.cases.run_cases import Pair
from tests.formulations import test_guide_clearance as guides
from tests.formulations import test_momentum as momentum
from tests.formulations import test_pin_friction as rubbing
from tests.formulations import test_slots_and_gears as slots
from tests.formulations import test_springs as springs
from tests.formulations import test_two_loose_pins as loose
from tests.linkage_cases import CrankRocker
from tests.roof_cases import MASS, TOP, DeadLoad, elastic_block, thrown
from tests.roof_cases import STIFFNESS as HARD
from user_forces import (
    Ambrosio,
    Frictionless,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    value,
)


def compiled(scenario: Scenario, tolerance: float = 1e-9) -> Result:
    solver = SolverSettings(tolerance=tolerance)
    return simulate(replace(scenario, formulation="compiled", solver=solver))


# --- two free bodies ---


@pytest.mark.parametrize("restitution", [0.3, 0.7, 0.9])
def test_restitution_is_the_closed_form_of_the_law(restitution: float) -> None:
    law = LankaraniNikravesh(stiffness=1e6, restitution=restitution)
    machine = Pair(
        one=Body(mass=3.0, inertia=0.02, centre=(0.0, 0.0)),
        two=Body(mass=2.0, inertia=0.01, centre=(0.0, 0.0), velocity=(0.2, 0.0)),
        one_point=(0.0, 0.0),
        two_point=(0.0, 0.0),
    )
    contact = JournalContact(bearing=JournalBearing(bore_radius=0.02, clearance=0.001), normal=law)
    pins = {"pin": ClearancePin(contact=contact)}
    result = compiled(Scenario(machine=machine, pins=pins, duration=0.032, gravity=(0.0, 0.0)))
    (onset,) = result.onsets["pin"]
    assert onset.time == pytest.approx(5e-3, rel=1e-12)  # a straight flight, met to rounding
    assert onset.speed == pytest.approx(0.2, rel=1e-12)
    rebound = result["one.velocity_x"][-1] - result["two.velocity_x"][-1]
    assert rebound / 0.2 == pytest.approx(delivered_restitution(law.damping_factor), abs=1e-8)
    assert onset.separation_velocity == pytest.approx(rebound, rel=1e-8)


@pytest.mark.parametrize("bore", ["first", "second"])
@pytest.mark.parametrize("turn", [0.0, 3.0])
def test_momentum_and_energy_are_kept(bore: Literal["first", "second"], turn: float) -> None:
    one, two = momentum.ONE, replace(momentum.TWO, angle=momentum.TWO.angle + turn)
    result = compiled(
        Scenario(
            machine=Pair(one=one, two=two, one_point=(0.2, 0.25), two_point=(0.2, 0.25)),
            pins={"pin": ClearancePin(contact=momentum.contact(0.3), bore=bore)},
            duration=0.03,
            gravity=(0.0, 0.0),
        )
    )
    assert len(result.onsets["pin"]) >= 3
    assert result["energy.friction_loss"][-1] > 0.0
    linear, angular = momentum.momenta(result, one, two)
    np.testing.assert_allclose(linear, np.broadcast_to(linear[0], linear.shape), atol=1e-12)  # rounding
    # errors of steps; a force pair that does not act at one point gives 1e-3
    np.testing.assert_allclose(angular, angular[0], atol=1e-8)
    assert result.energy_error < 1e-7 * result.dissipated


# --- one body ---


def test_a_spring_throws_a_ram_back_after_half_a_period() -> None:
    result = compiled(replace(thrown(0.01, 1e-3), record_period=1e-3))
    w, t = math.sqrt(HARD / MASS), result.time - 0.01
    swing = np.sin(w * np.clip(t, 0.0, math.pi / w))
    # no load has its landings met: steps grow small there
    np.testing.assert_allclose(result["roof.force"], HARD / w * swing, atol=1e-5 * HARD / w)
    assert result["ram.velocity_y"][-1] == pytest.approx(-1.0, abs=1e-6)
    assert result["roof.gap"][-1] == pytest.approx(t[-1] - math.pi / w, abs=1e-6)
    assert result.energy_error < 1e-3  # of 500 J


def test_a_load_of_ones_own_is_followed() -> None:
    load = DeadLoad(body="ram", point=TOP, vector=(7.0, -300.0))
    result = compiled(replace(thrown(0.01, 1e-3), loads={"weight": load}, record_period=1e-2))
    expected = TOP[1] + result.time - 0.5 * 0.3 * result.time**2
    np.testing.assert_allclose(result["ram.y"], expected, atol=1e-13)  # a parabola is met to rounding
    np.testing.assert_allclose(result["guide.force"], 7.0, rtol=1e-12)


def test_a_block_that_waits_is_an_elastic_impact() -> None:
    block = elastic_block(body="ram", point=TOP, mass=MASS / 4.0, height=0.01, stiffness=HARD)
    result = compiled(replace(thrown(0.01, 1e-4), loads={"block": block}))
    # 250 kg meet 1 t that comes at 1 m/s
    assert result["ram.velocity_y"][-1] == pytest.approx(0.6, abs=1e-6)
    assert result["block.velocity_y"][-1] == pytest.approx(1.6, abs=1e-6)


@value
class Swing(Machine):
    """A bar of 1 m and 10 kg on a pivot, let go level."""

    def linkage(self) -> Linkage:
        bar = Body(mass=10.0, inertia=1.0, centre=(0.5, 0.0))
        return Linkage(bodies={"bar": bar}, pins={"pivot": pinned(GROUND, "bar", (0.0, 0.0))})


def test_a_pendulum_is_that_of_an_equation_of_its_own() -> None:
    about, arm = 1.0 + 10.0 * 0.25, 10.0 * 9.81 * 0.5

    def slope(t: float, state: np.ndarray) -> np.ndarray:
        return np.array([state[1], -arm * np.cos(state[0]) / about])

    result = compiled(Scenario(machine=Swing(), duration=3.0, record_period=0.01), 1e-11)
    known = solve_ivp(
        slope, (0.0, 3.0), [0.0, 0.0], method="DOP853", rtol=1e-12, atol=1e-13, t_eval=result.time
    ).y
    np.testing.assert_allclose(result["bar.angle"], known[0], atol=1e-8)
    np.testing.assert_allclose(result["bar.angular_velocity"], known[1], atol=1e-7)
    # projection keeps the pivot, and nothing of the energy is lost to it
    assert result.energy_error < 1e-7
    along = 10.0 * (-9.81 * np.sin(known[0]) + 0.5 * known[1] ** 2)
    across = 10.0 * 9.81 * np.cos(known[0]) * (1.0 - 10.0 * 0.25 / about)
    np.testing.assert_allclose(result["pin.pivot.force"], np.hypot(along, across), rtol=1e-6)


def test_a_wheel_with_friction_in_its_pin_is_slowed_down_by_mu_n_r() -> None:
    result = compiled(Scenario(machine=rubbing.Wheel(), pins={"pivot": rubbing.RUBBING}, duration=1.0))
    moment = rubbing.MU * rubbing.MASS * rubbing.G * rubbing.RADIUS
    expected = 8.0 - moment / rubbing.INERTIA * result.time
    np.testing.assert_allclose(result["wheel.angular_velocity"], expected, atol=1e-9)
    np.testing.assert_allclose(result["pin.pivot.friction_moment"], -moment, rtol=1e-10)
    lost = 0.5 * rubbing.INERTIA * (64.0 - expected**2)
    np.testing.assert_allclose(result["energy.friction_loss"], lost, atol=1e-7)


def test_a_wheel_that_creeps_is_slowed_down_by_the_ramp_of_the_law() -> None:
    law = Ambrosio(sliding_coefficient=rubbing.MU, static_speed=0.0, dynamic_speed=1.0)
    pins = {"pivot": IdealPin(friction=law, radius=rubbing.RADIUS)}
    result = compiled(Scenario(machine=rubbing.Wheel(), pins=pins, duration=1.0), 1e-11)
    decay = rubbing.MU * rubbing.MASS * rubbing.G * rubbing.RADIUS**2 / rubbing.INERTIA
    np.testing.assert_allclose(result["wheel.angular_velocity"], 8.0 * np.exp(-decay * result.time), rtol=1e-9)


# --- linkages ---


def test_a_pin_in_a_slot_moves_as_its_equation() -> None:
    result = compiled(Scenario(machine=slots.ScotchYoke(), drive=Steady(rate=slots.SPEED), duration=0.3))
    angle = 0.4 + slots.SPEED * result.time
    away = slots.RADIUS * np.cos(angle) - slots.RADIUS * math.cos(0.4)
    np.testing.assert_allclose(result["yoke.x"] - result["yoke.x"][0], away, atol=1e-12)  # held by joints
    acceleration = -slots.RADIUS * slots.SPEED**2 * np.cos(angle)
    np.testing.assert_allclose(result["slot.force"], slots.YOKE * np.abs(acceleration), atol=1e-8)


def test_gears_turn_in_proportion() -> None:
    result = compiled(Scenario(machine=slots.GearPair(), drive=Steady(rate=slots.SPEED), duration=0.3))
    turned = result["pinion.angle"] - result["pinion.angle"][0]
    np.testing.assert_allclose(turned, slots.RATIO * slots.SPEED * result.time, atol=1e-11)
    # the pinion's weight beside its axis
    moment = slots.G * 0.05 * np.cos(turned)
    np.testing.assert_allclose(result["mesh.moment"], moment, atol=1e-9)
    np.testing.assert_allclose(result["wheel.moment"], slots.RATIO * moment, atol=1e-9)


def test_a_free_crank_rocker_moves_as_published() -> None:
    result = compiled(Scenario(machine=springs.FREE, duration=2.0, record_period=0.1), 1e-11)
    for t, known in springs.PUBLISHED.items():
        channels = ("crank.angle", "crank.angular_velocity", "rocker.angle")
        found = [result[name][round(10.0 * t)] for name in channels]
        assert found == pytest.approx(known, rel=1e-9)  # its last digit


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_two_loose_pins_impact_as_by_scipy(friction: float) -> None:
    contact = JournalContact(
        bearing=JournalBearing(bore_radius=loose.BORE, clearance=loose.CLEARANCE),
        normal=LankaraniNikravesh(stiffness=loose.STIFFNESS, restitution=loose.RESTITUTION, rest_velocity=1e-9),
        friction=Ambrosio(sliding_coefficient=friction) if friction else Frictionless(),
    )
    scene = Scenario(
        machine=CrankRocker(angle=loose.START, driven=True),
        pins={"A": ClearancePin(contact=contact), "B": ClearancePin(contact=contact, bore="second")},
        drive=Steady(rate=loose.SPEED),
        duration=0.006,
    )
    known, found = loose.Equations(friction).impacts(0.006), compiled(scene, 1e-10)
    assert sum(map(len, known.values())) >= 5
    for pin, impacts in known.items():
        ours = [(one.time, one.speed) for one in found.onsets[pin]]
        assert len(ours) == len(impacts)
        # each impact multiplies the errors of those before
        np.testing.assert_allclose(ours, impacts, rtol=1e-6)


@pytest.mark.parametrize("sliding", [0.0, 0.01])
def test_a_slider_between_walls_moves_as_by_scipy(sliding: float) -> None:
    friction = Ambrosio(sliding_coefficient=sliding) if sliding else Frictionless()
    other = slider_crank_by_scipy(1e9, friction if isinstance(friction, Ambrosio) else None)
    state = other.run((0.0, 0.0, 0.0), (150.0, -75.0, 0.0), 0.01)
    # the block's tilt hangs on how corners hit one after the other
    result = compiled(slider_crank(1e9, 0.01, friction), 1e-11)
    guides.check_onsets(result, other.touches, 1e-9)
    bodies = ("crank", "rod", "slider")
    found = [result[f"{n}.{what}"][-1] for what in ("angle", "angular_velocity") for n in bodies]
    np.testing.assert_allclose(found, state, rtol=1e-7, atol=1e-7)


@pytest.mark.parametrize(
    ("machine", "guide"),
    [
        (FreePair(), guides.IN_BLOCK),
        (FreePair(turns=True), guides.AS_PIN),
        (FreePair(grounded=True), guides.IN_BLOCK),
    ],
)
def test_a_slot_that_moves_and_turns_is_as_by_scipy(machine: FreePair, guide: ClearanceGuide) -> None:
    result = compiled(guides.pair(machine, guide, 0.0045), 1e-10)
    other = pair_by_scipy(machine, guide, guides.GRAVITY)
    state = other.run(*start_of(machine.linkage()), 0.0045, rtol=1e-9)
    assert sum(map(len, result.onsets.values())) >= 2
    guides.check_onsets(result, other.touches, 1e-8)
    np.testing.assert_allclose(guides.end(result), state, rtol=1e-6, atol=1e-7)


# --- a bar on a driven actuator, in one coordinate ---


@value
class Lifted(Machine):
    """A bar on a pivot that an actuator from the ground holds up."""

    def linkage(self) -> Linkage:
        bar = Body(mass=20.0, inertia=2.0, centre=(0.6, 0.1))
        return Linkage(
            bodies={"bar": bar},
            pins={"pivot": pinned(GROUND, "bar", (0.0, 0.0))},
            actuators={
                "jack": LinearActuator(foot=GROUND, head="bar", foot_point=(0.7, -1.0), head_point=(1.0, 0.0))
            },
        )


def test_an_actuator_pushes_with_what_the_bar_asks_for() -> None:
    result = compiled(Scenario(machine=Lifted(), drive=Steady(rate=0.2), duration=1.0, record_period=0.01))
    out, about = math.hypot(0.7, 1.0), 2.0 + 20.0 * 0.37
    length = math.hypot(0.3, 1.0) + 0.2 * result.time
    # the law of cosines in the triangle of pivot, foot and head: its angle at the pivot
    angle = np.arccos((1.0 + out**2 - length**2) / (2.0 * out))
    turn = angle - angle[0]
    np.testing.assert_allclose(result["bar.angle"], turn, atol=1e-12)  # joints hold it
    arm = out * np.sin(angle) / length  # of the force about the pivot: how the length grows with the turn
    bend = (out * np.cos(angle) - arm**2) / length
    spin, acceleration = 0.2 / arm, -bend * 0.2**2 / arm**3
    np.testing.assert_allclose(result["bar.angular_velocity"], spin, rtol=1e-11)
    weight = 20.0 * 9.81 * (0.6 * np.cos(turn) - 0.1 * np.sin(turn))
    np.testing.assert_allclose(result["jack.force"], (about * acceleration + weight) / arm, rtol=1e-10)


def test_joints_are_closed_at_every_record() -> None:
    result = compiled(Scenario(machine=CrankRocker(angle=0.3, speed=10.0), duration=2.0), 1e-9)
    linkage = result.scenario.linkage
    for name, pin in linkage.pins.items():
        apart = np.zeros((result.time.size, 2))
        for body, point, sign in ((pin.first, pin.first_point, -1.0), (pin.second, pin.second_point, 1.0)):
            if body == GROUND:
                apart += sign * np.array(point)
                continue
            start = linkage.bodies[body]
            turn = result[f"{body}.angle"] - start.angle
            x, y = np.array(point) - np.array(start.centre)
            apart[:, 0] += sign * (result[f"{body}.x"] + np.cos(turn) * x - np.sin(turn) * y)
            apart[:, 1] += sign * (result[f"{body}.y"] + np.sin(turn) * x + np.cos(turn) * y)
        # within rounding; the rounds that close them end there, or with the error of a coarser step
        assert np.abs(apart).max() < 3e-13, name
