"""Drives: of its own for each part, through points, from the start on, and with jumps of the speed."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.optimize import root

from support_exudyn import (
    Body,
    ClearancePin,
    Crank,
    CubicStep,
    Drive,
    Held,
    LinearActuator,
    Linkage,
    Machine,
    Reciprocating,
    Result,
    Scenario,
    SimulationError,
    Slide,
    SolverSettings,
    Steady,
    TableDrive,
    UniformSpeed,
    ravn_slider_crank,
    reference_support,
    simulate,
)
from support_exudyn.files.machines.read import read_machine
from support_exudyn.model.linkage import GROUND, pinned
from support_exudyn.postprocessing import summary
from support_exudyn.postprocessing.pytest_plugin import SimulateCached
from support_exudyn.simulation import impulses
from support_exudyn.sweeps.measures import numbers as noted
from support_exudyn.sweeps.plan import Record
from tests.cases.run_cases import (
    CRANK_SPEED,
    SLIDER_PIN,
    loose_support,
    paper_contact,
    slider_crank,
    slider_crank_contact,
    support,
)
from tests.cases.run_cases import support as support_scenario
from tests.commands import test_scenario_commands
from tests.commands.test_scenario_commands import same
from user_forces import value

FRONT = CubicStep(stroke=0.12, start=0.05, end=0.45)
REAR = CubicStep(stroke=-0.03, start=0.15, end=0.35)


@pytest.fixture(scope="module")
def apart(simulate_cached: SimulateCached) -> Result:
    return simulate_cached(support(drive=FRONT, drives={"rear_column": REAR}, duration=0.5, step=1e-3))


def test_actuators_driven_apart_bring_the_support_where_their_lengths_say(apart: Result) -> None:
    machine = reference_support()
    start = machine.start()
    before = np.array(machine.column_lengths(start))
    turns = np.array([start.rear_link, start.canopy])
    for n in range(0, 501, 25):
        t = float(apart.time[n])
        wanted = before + np.array([FRONT.extension(t), REAR.extension(t)])

        def misfit(trial: np.ndarray, wanted: np.ndarray = wanted) -> np.ndarray:
            posture = machine.posture(*trial.tolist())
            assert posture is not None
            return np.array(machine.column_lengths(posture)) - wanted

        turns = root(misfit, turns, tol=1e-14).x
        posture = machine.posture(*turns.tolist())
        assert posture is not None
        # both solve the same closed loops: Newton's tolerance of 1e-8 on lengths of 3 m
        np.testing.assert_allclose([apart["tip.x"][n], apart["tip.y"][n]], posture.tip, atol=1e-8)
        turned = apart["rear_link.angle"][n] - apart["rear_link.angle"][0]
        assert turned == pytest.approx(posture.rear_link - start.rear_link, abs=1e-8)


def test_energy_adds_up_where_actuators_are_driven_apart(apart: Result) -> None:
    assert apart["energy.work"].max() > 500.0
    # Each by its own force and speed. At a break of one drive the force on the other, which moves, jumps, and
    # overshoots for some of the refined steps after it: 6e-5 at 1 ms, of first order in the step
    assert apart.energy_error < 1e-4 * apart["energy.work"].max()
    finer = simulate(apart.scenario.refined())
    assert finer.energy_error < 0.6 * apart.energy_error


def test_a_jump_of_one_actuator_strikes_the_other_too() -> None:
    drive = UniformSpeed(stroke=0.05, start=0.1, end=0.3)
    result = simulate(support(drives={"front_column": drive}, duration=0.2))
    (impulse,) = result.impulses
    # only the front column moves, and so only its impulse does work: the impulse times half the speed; rounding
    assert impulse.energy == pytest.approx(0.5 * 0.25 * impulse.actuators["front_column"], rel=1e-9)
    assert abs(impulse.actuators["rear_column"]) > 1.0
    np.testing.assert_allclose(result["rear_column.length"], result["rear_column.length"][0], atol=1e-11)
    # a step after the jump is known by its end only: second order of the step, of 40 J
    assert result.energy_error < 1e-3 * impulse.energy


# --- tables ---

STROKE = CubicStep(stroke=0.02, start=0.02, end=0.08)
BASE = replace(test_scenario_commands.BASE, drive=STROKE, duration=0.1, record_period=1e-3)


@pytest.mark.parametrize("formulation", ["exudyn", "compiled"])
@pytest.mark.parametrize(
    ("between", "drive"), [("smooth", STROKE), ("linear", UniformSpeed(stroke=0.02, start=0.02, end=0.08))]
)
def test_two_points_drive_as_what_they_stand_for_to_the_bit(
    between: str, drive: Drive, formulation: str
) -> None:
    points = TableDrive(times=(0.02, 0.08), extensions=(0.0, 0.02), between=between)
    one, other = (simulate(replace(BASE, drive=made, formulation=formulation)) for made in (points, drive))
    assert len(one.impulses) == (2 if between == "linear" else 0)
    same(one, other)


# --- cranks ---

TURN = Scenario(
    machine=ravn_slider_crank(), duration=0.01, step=2e-5, record_period=1e-4, channels=("crank.*", "pin.*")
)


@value
class Jumping(Held):
    """A crank that turns steadily from 2 ms on, when its speed jumps; silent: it does not tell that."""

    silent: bool = False

    def extension(self, t: float) -> float:
        return 300.0 * (t - 2e-3) if t > 2e-3 else 0.0

    def speed(self, t: float) -> float:
        return 300.0 if t > 2e-3 else 0.0

    def speed_jump(self, t: float) -> float:
        return 300.0 if t == 2e-3 and not self.silent else 0.0

    @property
    def breaks(self) -> tuple[float, ...]:
        return () if self.silent else (2e-3,)

    def span(self, duration: float) -> tuple[float, float]:
        return 0.0, 300.0 * duration


@pytest.mark.parametrize(
    "drive",
    [
        Steady(rate=300.0),
        UniformSpeed(stroke=1.0, start=2e-3, end=8e-3),
        Reciprocating(stroke=1.0, period=4e-3),
        Jumping(),
    ],
    ids=lambda item: type(item).__name__,
)
def test_a_crank_is_where_its_drive_says(drive: Drive) -> None:
    result = simulate(replace(TURN, drive=drive))
    start = TURN.linkage.bodies["crank"].angle
    wanted = start + np.array([drive.extension(t) for t in result.time.tolist()])
    # Newton's method ends at 1e-8 of the first residual; rounding of a few radians is 1e-15
    np.testing.assert_allclose(result["crank.angle"], wanted, rtol=0.0, atol=1e-11)


@pytest.mark.parametrize("step", [2e-5, 2e-6])
def test_a_jump_that_a_drive_does_not_tell_is_refused_at_any_step(step: float) -> None:
    # the work is off by 21 J however short steps are; at the longer one forces just after it by a third
    with pytest.raises(SimulationError, match=r"energy does not add up.*has to say so in its `breaks`"):
        simulate(replace(TURN, drive=Jumping(silent=True), step=step))


# --- a drive that moves from the start on ---


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


# --- jumps of the speed ---


FORMULATIONS = pytest.mark.parametrize("formulation", ["exudyn", "compiled"])


@cache
def sudden_rise(formulation: str) -> Result:
    return simulate(support(drive=UniformSpeed(), duration=3.5, step=5e-4, formulation=formulation))


@FORMULATIONS
def test_velocities_after_the_jump_are_the_closed_form_ones(formulation: str) -> None:
    machine, speed, small = reference_support(), 0.25, 1e-5
    at = 0.25e-3  # extension 1 ms after the jump [m]
    lower, upper = machine.extended(at - small), machine.extended(at + small)
    assert lower is not None
    assert upper is not None
    result = sudden_rise(formulation)
    # central difference over 0.02 mm: 1e-9; generalised alpha at this step: 1e-6
    close = 3e-6 if formulation == "exudyn" else 1e-7
    for body in ("rear_link", "canopy"):
        slope = (getattr(upper, body) - getattr(lower, body)) / (2 * small)
        assert result[f"{body}.angular_velocity"][3001] == pytest.approx(slope * speed, rel=close)


@FORMULATIONS
def test_the_impulse_gives_the_kinetic_energy(formulation: str) -> None:
    result = sudden_rise(formulation)
    (impulse,) = result.impulses
    assert impulse.time == 3.0
    # the bodies were at rest: an impulse through actuators that move at v does work of impulse times v/2
    work = sum(impulse.actuators.values()) * 0.25 / 2
    assert impulse.energy == pytest.approx(work, rel=1e-9)  # rounding
    # the support has moved by 0.25 mm of its stroke of 500 mm since
    assert result["energy.kinetic"][3001] == pytest.approx(impulse.energy, rel=1e-3)
    assert all(value > 0.0 for value in impulse.actuators.values())
    assert result.energy_error < 1e-6 * result["energy.work"][-1]  # second order in the step


@FORMULATIONS
def test_a_loose_pin_transmits_no_impulse(formulation: str) -> None:
    drive = UniformSpeed(stroke=0.5, start=0.0, end=2.0)
    (closed,), (free,) = (
        simulate(scene(drive=drive, duration=0.01, formulation=formulation)).impulses
        for scene in (support, loose_support)
    )
    # Bertrand's theorem: with fewer constraints the same speeds of the actuators take less energy
    assert free.energy < closed.energy
    assert free.energy == pytest.approx(0.5 * 0.25 * sum(free.actuators.values()), rel=1e-9)  # from rest


def test_a_crank_that_jumps_to_speed_gets_an_angular_impulse() -> None:
    # Ravn's crank, upright after a quarter turn backwards: the rod does not turn then
    machine = replace(ravn_slider_crank(), start_angle=-0.5 * math.pi)
    drive = UniformSpeed(stroke=1.0, start=0.0, end=0.1)
    result = simulate(slider_crank(1e-4, machine=machine, drive=drive))
    (impulse,) = result.impulses
    speed = 10.0  # [rad/s]
    # rod and slider move along x as fast as the crank pin
    inertia = 1e-4 + 0.3 * 0.025**2 + (0.21 + 0.14) * 0.05**2
    # rounding
    assert impulse.cranks == pytest.approx({"crank": inertia * speed}, rel=1e-12)
    assert impulse.energy == pytest.approx(0.5 * inertia * speed**2, rel=1e-12)
    assert impulse.actuators == {}
    # pins pass on the momentum of what they move; across it the guide keeps the rod from turning
    across = 0.5 * (0.35 + 0.14) * speed * 0.05 * 0.05 / math.sqrt(0.12**2 - 0.05**2)
    along = {"pin.slider_pin": 0.14 * 0.5, "pin.crank_pin": 0.35 * 0.5, "pin.main": 0.35 * 0.5 + 0.3 * 0.25}
    expected = {name: math.hypot(one, across) for name, one in along.items()}
    assert impulse.joints == pytest.approx(expected | {"guide": across}, rel=1e-9)
    # the crank has turned by a thousandth of a radian since, and the slider is faster by as much
    assert result["energy.kinetic"][-1] == pytest.approx(impulse.energy, rel=1e-3)
    # the work of the drive counts it
    assert result["energy.work"][-1] == pytest.approx(result["energy.kinetic"][-1], rel=1e-6)


@value
class RamAndWheel(Machine):
    """A ram of 3 kg lifted by an actuator, and beside it a wheel of 0.2 kg m^2 turned by a crank."""

    def linkage(self) -> Linkage:
        return Linkage(
            bodies={
                "ram": Body(mass=3.0, inertia=1.0, centre=(0.0, 1.0)),
                "wheel": Body(mass=5.0, inertia=0.2, centre=(2.0, 0.0)),
            },
            pins={"axle": pinned(GROUND, "wheel", (2.0, 0.0))},
            actuators={
                "jack": LinearActuator(foot=GROUND, head="ram", foot_point=(0.0, 0.0), head_point=(0.0, 1.0))
            },
            cranks={"motor": Crank(body="wheel")},
            slides={"guide": Slide(body="ram", point=(0.0, 1.0), direction=0.5 * math.pi)},
        )


def test_actuators_and_cranks_get_impulses_of_their_own() -> None:
    drive = UniformSpeed(stroke=0.4, start=0.0, end=0.1)  # 4 m/s and 4 rad/s
    result = simulate(Scenario(machine=RamAndWheel(), drive=drive, duration=0.01))
    (impulse,) = result.impulses
    # mass and inertia times speed, and half of that times the speed again; rounding
    assert impulse.actuators == pytest.approx({"jack": 12.0}, rel=1e-12)
    assert impulse.cranks == pytest.approx({"motor": 0.8}, rel=1e-12)
    assert impulse.energy == pytest.approx(24.0 + 1.6, rel=1e-12)
    # neither the wheel's axle nor the ram's guide is struck: their forces keep their peaks, the jack's has none
    assert impulse.joints == pytest.approx({"pin.axle": 0.0, "guide": 0.0}, abs=1e-12)
    assert list(impulses.struck(result, 0.0, math.inf)) == ["jack.force"]
    assert not list(impulses.struck(result, 1e-3, math.inf))  # after it
    # after it the actuator carries the weight of 3 kg, and nothing turns the wheel, or the ram in its guide
    np.testing.assert_allclose(result["jack.force"][1:], 3.0 * 9.81, rtol=1e-6)
    for name in ("motor.moment", "guide.moment", "guide.force"):
        np.testing.assert_allclose(result[name][1:], 0.0, atol=1e-6)
    np.testing.assert_allclose(result["pin.axle.force_y"][1:], 5.0 * 9.81, rtol=1e-6)


@pytest.mark.parametrize(("dimensions", "formulation"), [(2, "compiled"), (2, "exudyn"), (3, "exudyn")])
def test_a_force_without_limit_is_refused_and_its_impulse_printed(dimensions: int, formulation: str) -> None:
    # two-leg shield on rigid legs, ideal pins: a sudden start within the run, none after 0.2 s
    drive = UniformSpeed(stroke=0.1, start=0.1, end=1.0)
    scene = Scenario(machine=read_machine("two_leg_shield").machine, drive=drive, duration=0.3, step=1e-3)
    result = simulate(replace(scene, dimensions=dimensions, formulation=formulation), errors=True)
    numbers, later = result.numbers(), result.numbers(after=0.2)
    for force in ("pin.rear_base.force", "leg.force"):
        for word in ("largest", "std"):
            assert f"{force}.{word}" not in numbers
            with pytest.raises(KeyError, match=r"impulse, no finite peak; allowed: .*\.impulse_1"):
                _ = numbers[f"{force}.{word}"]
            assert f"{force}.{word}" in later  # nothing jumps there
        assert f"{force}.mean" in numbers
    # of the three ways to compute them, in N s
    for force, expected in (("pin.rear_base.force", 169.784), ("leg.force", 1031.087)):
        number = numbers[f"{force}.impulse_1"]
        assert (number.value, number.unit) == (pytest.approx(expected, rel=1e-5), "N s")
        assert number.error <= 1e-6 * expected
        (row,) = summary.channels_table(result, [force]).rows
        assert row[2::2][:2] == ("impulse", "impulse")
    asked = Record(numbers=("pin.rear_base.force.max_time", "pin.*.largest", "leg.force.largest"), after=0.0)
    assert all(name.endswith(".impulse_1") for name in noted(result, asked))
    assert noted(replace(result), replace(asked, after=0.2))["leg.force.largest"].value > 0.0
