"""Clearance joints in users' own Exudyn models against yardsticks, closed forms and the stock solver."""

from __future__ import annotations

import math
from typing import Any

import exudyn
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.user_forces.own_models import GRAVITY, ORIGIN, OUTPUT, model, output, rigid, settings
from user_forces import (
    ClearanceGuide,
    ClearanceJoint,
    Exact,
    Hertz,
    InputError,
    LankaraniNikravesh,
    LuGre,
    friction_law,
    solve_located,
)

# --- yardsticks ---


@friction_law
def smooth(slip, normal_force, coefficient: float, ramp: float = 0.05):  # type: ignore[no-untyped-def]
    """F_t = -mu F_n v / (|v| + v_s)."""
    return -coefficient * normal_force * slip / (abs(slip) + ramp)


# --- a pendulum, by an integration of its own ---

BORE, GAP, STIFFNESS, RESTITUTION, FRICTION = 0.02, 5e-4, 1e9, 0.8, 0.2
MASS, INERTIA, ARM = 2.0, 0.03, 0.2  # of the pendulum; its journal is ARM from the centre of mass


def pendulum_rates(t: float, y: np.ndarray, speed: float) -> np.ndarray:
    """Rates of centre of mass and angle, and of their velocities; speed: of the impact, 0 in free flight."""
    vx, vy, turning = y[3:]
    ex, ey, rx, ry = eccentricity(y)
    force, moment = np.array([0.0, -MASS * GRAVITY]), 0.0
    if speed > 0.0:
        size = math.hypot(ex, ey)
        n = np.array([ex, ey]) / size
        t_ = np.array([-n[1], n[0]])
        depth = max(size - GAP, 0.0)
        v = np.array([vx - turning * ry, vy + turning * rx])
        normal = STIFFNESS * depth**1.5 * (1.0 + 0.75 * (1.0 - RESTITUTION**2) * (v @ n) / max(speed, 0.01))
        arm = BORE + 0.5 * depth - size
        slip = v @ t_ + turning * arm
        tangential = -FRICTION * max(normal, 0.0) * slip / (abs(slip) + 0.05)
        contact = -max(normal, 0.0) * n + tangential * t_
        force = force + contact
        moment = rx * contact[1] - ry * contact[0] + arm * tangential
    return np.array([vx, vy, turning, *(force / MASS), moment / INERTIA])


def eccentricity(y: np.ndarray) -> tuple[float, float, float, float]:
    """Place of the journal's centre in the bore at the origin, and relative to the centre of mass [m]."""
    rx, ry = -ARM * math.cos(y[2]), -ARM * math.sin(y[2])
    return y[0] + rx, y[1] + ry, rx, ry


def pendulum_impacts(count: int) -> list[tuple[float, float]]:
    """Times [s] and speeds [m/s] of the first impacts of a pendulum released level from the middle."""

    def reach(t: float, y: np.ndarray, speed: float) -> float:
        return math.hypot(*eccentricity(y)[:2]) - GAP

    reach.terminal = True  # type: ignore[attr-defined]
    t, y, impacts = 0.0, np.array([ARM, 0.0, 0.0, 0.0, 0.0, 0.0]), []
    while len(impacts) < count:
        for speed in (0.0, None):
            reach.direction = 1.0 if speed == 0.0 else -1.0  # type: ignore[attr-defined]
            if speed is None:
                ex, ey, rx, ry = eccentricity(y)
                v = np.array([y[3] - y[5] * ry, y[4] + y[5] * rx])
                speed = float(v @ [ex, ey]) / math.hypot(ex, ey)
                impacts.append((t, speed))
            part = solve_ivp(
                pendulum_rates, (t, t + 1.0), y, "DOP853", events=reach, args=(speed,), rtol=1e-12, atol=1e-14,
                first_step=1e-7,
            )  # fmt: skip
            t, y = float(part.t_events[0][0]), part.y_events[0][0]
    return impacts


@pytest.mark.parametrize("planar", [True, False])
def test_a_pendulum_hits_as_its_own_integration(planar: bool) -> None:
    mbs, ground = model()
    body = rigid(mbs, MASS, INERTIA, [ARM, 0, 0], planar, gravity=[0, -GRAVITY, 0])
    joint = ClearanceJoint(
        mbs, bore=(ground, ORIGIN), journal=(body, [-ARM, 0, 0]), bore_radius=BORE, clearance=GAP,
        normal=LankaraniNikravesh(stiffness=STIFFNESS, restitution=RESTITUTION),
        friction=smooth(coefficient=FRICTION), impact_steps=512,
    )  # fmt: skip
    mbs.Assemble()
    expected = pendulum_impacts(4)
    mbs.SolveDynamic(settings(expected[-1][0] + 1e-4, 1e-5))
    times, speeds = zip(*expected, strict=True)
    assert [onset.time for onset in joint.impacts] == pytest.approx(times, abs=2e-6)
    assert [onset.speed for onset in joint.impacts] == pytest.approx(speeds, rel=2e-4)


# --- guides, friction with a state ---


@pytest.mark.parametrize("planar", [True, False])
@pytest.mark.parametrize("angle", [0.0, 0.7])
def test_a_pin_rebounds_between_the_walls_of_a_guide(planar: bool, angle: float) -> None:
    c, s = math.cos(angle), math.sin(angle)
    mbs, ground = model()
    # a smooth pin may spin as it likes: it has turned by half a radian at the second wall
    pin = rigid(mbs, 1.0, 0.01, [0, 0, 0], planar, initialVelocity=[c - 0.4 * s, s + 0.4 * c, 0],
                initialAngularVelocity=[0, 0, 40.0])  # fmt: skip
    joint = ClearanceGuide(
        mbs, slot=(ground, ORIGIN), pin=(pin, ORIGIN), direction=[c, s, 0], clearance=1e-3, pin_radius=0.01,
        normal=Exact(stiffness=1e10, restitution=0.5), impact_steps=256,
    )  # fmt: skip
    mbs.Assemble()
    mbs.SolveDynamic(settings(0.015, 1e-4))
    first, second = joint.impacts
    assert (first.time, first.speed) == pytest.approx((0.0025, 0.4), rel=1e-7)
    assert first.separation_velocity == pytest.approx(0.2, rel=1e-3)
    assert second.time == pytest.approx(first.separation_time + 2e-3 / first.separation_velocity, rel=1e-6)
    along, across = np.array([[c, s, 0.0], [-s, c, 0.0]]) @ output(mbs, pin, OUTPUT.Velocity)
    assert (along, across) == pytest.approx((1.0, 0.1), rel=2e-3)


def test_bristles_hold_a_pin_that_is_pressed_on_a_wall() -> None:
    pull, press = 2.0, 10.0
    mbs, ground = model()
    pin = rigid(mbs, 1.0, 0.01, [0, 0, 0], gravity=[pull, -press, 0])
    mbs.CreateGenericJoint(itemNumbers=[ground, pin], position=ORIGIN, constrainedAxes=[0, 0, 0, 0, 0, 1])
    joint = ClearanceGuide(
        mbs, slot=(ground, ORIGIN), pin=(pin, ORIGIN), direction=[1, 0, 0], clearance=1e-6,
        normal=Exact(stiffness=1e7, restitution=0.1),
        friction=LuGre(static_coefficient=0.4, sliding_coefficient=0.3, bristle_damping=100.0),
    )  # fmt: skip
    mbs.Assemble()
    mbs.SolveDynamic(settings(0.05, 1e-3))
    assert abs(output(mbs, pin, OUTPUT.Velocity)[0]) < 1e-6
    assert joint.kept.deflection == pytest.approx(pull / (1e5 * press), rel=1e-3)  # F_t / (s0 F_n)


@pytest.mark.parametrize("axis", [(0.0, 0.0, 1.0), (1.0, 0.0, 0.0)])
def test_a_journal_in_space_is_free_along_the_axis(axis: tuple[float, ...]) -> None:
    along, across = np.array(axis), np.roll(axis, 1)
    mbs, ground = model()
    body = rigid(mbs, 1.0, 0.01, [0, 0, 0], False, initialVelocity=0.2 * across + 3.0 * along)
    joint = ClearanceJoint(
        mbs, bore=(ground, ORIGIN), journal=(body, ORIGIN), bore_radius=0.02, clearance=1e-3, axis=axis,
        normal=Exact(stiffness=1e9, restitution=0.5),
    )  # fmt: skip
    mbs.Assemble()
    mbs.SolveDynamic(settings(0.01, 1e-4))
    assert joint.impacts[0].time == pytest.approx(0.005, abs=1e-9)
    assert joint.impacts[0].separation_velocity == pytest.approx(0.1, rel=1e-3)
    assert output(mbs, body, OUTPUT.Velocity) == pytest.approx(3.0 * along - 0.1 * across, rel=1e-3, abs=1e-9)


# --- the stock solver and `solve_located` ---


def falling(stiffness: float = 1e7, height: float = 0.0, **given: Any) -> tuple[Any, ClearanceJoint]:
    """A body that falls in a soft bore from a height [m] over its middle, and its joint."""
    mbs, ground = model()
    body = rigid(mbs, 2.0, 0.01, [0, height, 0], gravity=[0, -GRAVITY, 0])
    law = LankaraniNikravesh(stiffness=stiffness, restitution=0.9)
    given = {"bore_radius": 0.02, "clearance": 5e-4, "normal": law} | given
    joint = ClearanceJoint(mbs, bore=(ground, ORIGIN), journal=(body, ORIGIN), **given)
    mbs.Assemble()
    return mbs, joint


def test_fixed_steps_approach_the_located_run() -> None:
    mbs, joint = falling(impact_steps=512)
    located = solve_located(mbs, settings(0.08, 1e-4), estimates_error=False).joints[0]
    assert located.impacts[0].time == pytest.approx(math.sqrt(2 * 5e-4 / GRAVITY), abs=1e-8)
    times = np.array([onset.time for onset in located.impacts])
    off = []
    for step in (5e-5, 3.125e-6):
        mbs, joint = falling()
        mbs.SolveDynamic(settings(0.08, step, adaptiveStep=False))
        off.append(np.abs(times - [onset.time for onset in joint.impacts]))
        assert joint.largest_force == pytest.approx(located.largest_force, rel=5e-5)
    assert len(times) == 3
    assert off[0].max() < 5e-6
    assert (off[1] < 0.3 * off[0]).all()


def test_a_journal_that_is_pressed_at_the_start_makes_no_impact() -> None:
    forces = []
    for solve in (solve_located, lambda mbs, given: mbs.SolveDynamic(given)):
        mbs, joint = falling(1e9, -5e-4 - 1e-9)
        solve(mbs, settings(0.02, 1e-4))
        assert joint.impacts == ()
        forces.append(joint.largest_force)
    assert forces[0] == pytest.approx(forces[1], rel=1e-3)
    assert 1.9 < forces[0] / (2.0 * GRAVITY) < 2.5  # 2.5 without damping


def test_a_second_run_starts_afresh() -> None:
    mbs, joint = falling()
    runs = []
    for _ in range(2):
        mbs.SolveDynamic(settings(0.02, 1e-4))
        runs.append((joint.impacts, joint.largest_force, joint.largest_force_time))
    assert len(runs[0][0]) == 1
    assert runs[1] == runs[0]


def test_sensors_record_force_and_state_of_the_contact() -> None:
    mbs, joint = falling(impact_steps=64)
    force = mbs.AddSensor(sensor("Object", objectNumber=joint.connector, outputVariableType=OUTPUT.ForceLocal))
    state = mbs.AddSensor(sensor("Node", nodeNumber=joint.node, outputVariableType=OUTPUT.Coordinates))
    mbs.Assemble()
    mbs.SolveDynamic(settings(0.02, 1e-4))
    forces, states = (mbs.GetSensorStoredData(number) for number in (force, state))
    pressed = np.abs(forces[:, 1:]).max()
    assert 0.95 * joint.largest_force < pressed <= joint.largest_force
    closed = states[:, 1] > 0.0
    assert closed.any()
    assert not closed[0]
    assert states[closed, 2] == pytest.approx(joint.impacts[0].speed)  # impact velocity [m/s]
    assert states[1, 3] < 0.0 < states[:, 3].max()  # indentation [m]


def sensor(kind: str, **given: Any) -> Any:
    """A sensor that keeps its data."""
    return getattr(exudyn.itemInterface, f"Sensor{kind}")(storeInternal=True, writeToFile=False, **given)


# --- pictures and messages ---


def test_a_ground_that_is_turned_keeps_the_axis() -> None:
    mbs = exudyn.SystemContainer().AddSystem()
    turned = exudyn.utilities.RotationMatrixX(0.5 * math.pi)
    ground = mbs.AddObject(exudyn.itemInterface.ObjectGround(referenceRotation=turned))
    body = rigid(mbs, 1.0, 0.01, [0, 0, 0], False, initialVelocity=[0, 0.2, 0])
    joint = ClearanceJoint(
        mbs, bore=(ground, ORIGIN), journal=(body, ORIGIN), bore_radius=0.02, clearance=1e-3,
        normal=Exact(stiffness=1e9, restitution=0.5),
    )  # fmt: skip
    mbs.Assemble()
    mbs.SolveDynamic(settings(0.006, 1e-4))
    assert joint.impacts[0].time == pytest.approx(0.005, abs=1e-9)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"bore_radius": -0.02}, r"bore_radius = -0.02: allowed: > 0"),
        ({"clearance": 0.02}, r"clearance = 0.02 m: .* allowed: > 0 and < 0.02 m"),
        ({"normal": Hertz}, r"normal = <class .*Hertz'>: Input should be a value of class NormalLaw"),
        ({"friction": 0.1}, r"friction = 0.1: Input should be a value of class FrictionLaw"),
        ({"axis": [0, 0, 0]}, r"axis = \[0, 0, 0\]: allowed: three numbers, not all zero"),
        ({"axis": "z"}, r"axis = 'z': allowed: three numbers"),
        ({"impact_steps": 1.5}, r"impact_steps = 1.5: allowed: a whole number from 2"),
        ({"bore": None}, r"bore = None: allowed: \(body number, \[x, y, z\]\)"),
        ({"bore": (0, [0, 0])}, r"bore: centre = \[0, 0\]: allowed: three numbers \[m\]"),
        ({"journal": ("x", ORIGIN)}, r"journal = \('x', .*\): allowed: the number of a body"),
        ({"journal": (2, ORIGIN)}, r"journal = \(2, .*\): is a MassPoint; allowed: a rigid body"),
        ({"journal": (0, ORIGIN)}, r"journal = \(0, .*\): allowed: another body than that of the bore"),
    ],
)  # fmt: skip
def test_wrong_arguments_are_named_and_leave_the_model_alone(given: dict[str, Any], message: str) -> None:
    mbs, ground = model()
    body = rigid(mbs, 1.0, 0.01, [0, 0, 0])
    mbs.CreateMassPoint(mass=1.0)
    before = str(mbs)
    right = {"bore": (ground, ORIGIN), "journal": (body, ORIGIN), "bore_radius": 0.02, "clearance": 1e-3}
    with pytest.raises(InputError, match=message):
        ClearanceJoint(mbs, **{"normal": Hertz(stiffness=1e9), **right, **given})
    assert str(mbs) == before
    with pytest.raises(InputError, match=r"direction = .*: allowed: three numbers, not along the axis"):
        ClearanceGuide(mbs, slot=(ground, ORIGIN), pin=(body, ORIGIN), direction=[0, 0, 1], clearance=1e-3,
                       normal=Hertz(stiffness=1e9))  # fmt: skip
