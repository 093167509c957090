"""Drives: of its own for each part, through points, and from the start on."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import root

from support_exudyn import (
    Body,
    ClearancePin,
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
    SolverSettings,
    Steady,
    TableDrive,
    UniformSpeed,
    ravn_slider_crank,
    reference_support,
    simulate,
)
from support_exudyn.model.linkage import GROUND, pinned
from support_exudyn.postprocessing.pytest_plugin import SimulateCached
from tests.cases.run_cases import (
    CRANK_SPEED,
    SLIDER_PIN,
    slider_crank,
    slider_crank_contact,
    support,
)
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
