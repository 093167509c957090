"""Clearance joints in users' own Exudyn models: yardsticks, closed forms, conserved quantities, stock solver."""

from __future__ import annotations

import math
from typing import Any

import exudyn
import numpy as np
import pytest
from exudyn.itemInterface import MarkerBodyPosition
from exudyn.utilities import InertiaCuboid, RigidBodyInertia
from scipy.integrate import solve_ivp

from user_forces import (
    Ambrosio,
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

OUTPUT = exudyn.OutputVariableType
ORIGIN = [0.0, 0.0, 0.0]
PIN = [1, 1, 0, 0, 0, 0]
TURNING = 5000.0 * math.pi / 30.0  # [rad/s]


def model() -> tuple[Any, Any]:
    """An empty system and its ground."""
    mbs = exudyn.SystemContainer().AddSystem()
    return mbs, mbs.CreateGround()


def rigid(mbs: Any, mass: float, inertia: float, at: Any, planar: bool = True, **state: Any) -> Any:
    """A rigid body with the same inertia about all axes."""
    tensor = np.diag([inertia] * 3)
    of = RigidBodyInertia(mass=mass, inertiaTensor=tensor)
    return mbs.CreateRigidBody(inertia=of, referencePosition=at, create2D=planar, **state)


def settings(end: float, step: float, **changes: Any) -> Any:
    """Settings for the stock solver, as the documentation recommends them."""
    made = exudyn.SimulationSettings()
    made.solution.file.write = False
    integration = made.timeIntegration
    integration.endTime, integration.numberOfSteps = end, round(end / step)
    integration.minimumStepSize = 1e-13
    integration.newton.absoluteTolerance = 1e-6
    for name, given in changes.items():
        setattr(integration, name, given)
    return made


def output(mbs: Any, body: Any, kind: Any, place: Any = ORIGIN) -> np.ndarray:
    """An output variable of a body in the final state."""
    return np.asarray(mbs.GetObjectOutputBody(body, kind, place, exudyn.ConfigurationType.Current))


# --- yardsticks ---


def slider_crank() -> tuple[Any, ClearanceJoint]:
    """The slider-crank of Ravn and of Flores and co-workers, driven at 5000 rpm."""
    mbs, ground = model()
    tip = 0.05 * TURNING
    crank = rigid(mbs, 0.30, 1e-4, [0.025, 0, 0], initialVelocity=[0, 0.5 * tip, 0],
                  initialAngularVelocity=[0, 0, TURNING])  # fmt: skip
    rod = rigid(mbs, 0.21, 2.5e-4, [0.11, 0, 0], initialVelocity=[0, 0.5 * tip, 0],
                initialAngularVelocity=[0, 0, -tip / 0.12])  # fmt: skip
    slider = rigid(mbs, 0.14, 1e-4, [0.17, 0, 0])
    mbs.CreateGenericJoint(
        itemNumbers=[ground, crank], position=[0, 0, 0], constrainedAxes=[1, 1, 0, 0, 0, 1],
        offsetUserFunction=lambda mbs, t, item, given: [0, 0, 0, 0, 0, TURNING * t],
    )  # fmt: skip
    mbs.CreateGenericJoint(itemNumbers=[crank, rod], position=[0.05, 0, 0], constrainedAxes=PIN)
    mbs.CreateGenericJoint(itemNumbers=[ground, slider], position=[0.17, 0, 0], constrainedAxes=[0, 1, 0, 0, 0, 1])
    law = LankaraniNikravesh(stiffness=6.610198e10, restitution=0.9)
    joint = ClearanceJoint(
        mbs, bore=(slider, ORIGIN), journal=(rod, [0.06, 0, 0]), bore_radius=0.01, clearance=0.0005,
        normal=law, impact_steps=512,
    )  # fmt: skip
    mbs.Assemble()
    return mbs, joint


# onset [us] and approach [m/s] of an independent solution with two degrees of freedom, DOP853 with located events
ONSETS = ((227.286, 4.385783), (637.056, 2.756949), (749.700, 1.826699), (1085.947, 1.101851), (1205.816, 0.823801))


def test_the_slider_crank_hits_as_its_independent_solution() -> None:
    mbs, joint = slider_crank()
    mbs.SolveDynamic(settings(1.25e-3, 1e-6))
    times, speeds = zip(*((onset.time, onset.speed) for onset in joint.impacts), strict=True)
    assert 1e6 * np.array(times) == pytest.approx([onset for onset, _ in ONSETS], abs=0.006)
    assert speeds == pytest.approx([speed for _, speed in ONSETS], rel=5e-5)
    assert joint.largest_force == pytest.approx(4.59e4, rel=1e-3)
    assert math.degrees(TURNING * joint.largest_force_time) == pytest.approx(7.55, abs=0.02)


@friction_law
def smooth(slip, normal_force, coefficient: float, ramp: float = 0.05):  # type: ignore[no-untyped-def]
    """F_t = -mu F_n v / (|v| + v_s)."""
    return -coefficient * normal_force * slip / (abs(slip) + ramp)


# --- a pendulum, by an integration of its own ---

BORE, GAP, STIFFNESS, RESTITUTION, FRICTION = 0.02, 5e-4, 1e9, 0.8, 0.2
MASS, INERTIA, ARM, GRAVITY = 2.0, 0.03, 0.2, 9.81  # of the pendulum; its journal is ARM from the centre of mass


def pendulum_rates(t: float, y: np.ndarray, speed: float) -> np.ndarray:
    """Rates of centre of mass and angle, and of their velocities; speed: of the impact, 0 in free flight."""
    _, _, angle, vx, vy, turning = y
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
    """Times [s] and speeds [m/s] of the first impacts of a pendulum released level, its journal in the middle."""

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
