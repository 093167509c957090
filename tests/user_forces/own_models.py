"""Models with clearance joints as users write them, and their energy."""

from __future__ import annotations

from typing import Any

import exudyn
import numpy as np
from exudyn.utilities import RigidBodyInertia

OUTPUT = exudyn.OutputVariableType
ORIGIN = [0.0, 0.0, 0.0]
GRAVITY = 9.81  # [m/s^2]
PIN = [1, 1, 0, 0, 0, 0]


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
    made.solution.sensors.writePeriod = 0.0  # every step
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


def follow_energy(mbs: Any, joints: list[Any], energy: Any) -> tuple[list[float], list[float]]:
    """Energy with what is stored and lost, and what is lost, after each step of the run to come: lists [J]."""
    balance: list[float] = []
    lost, power, before = [0.0], [0.0], [0.0]

    def after(mbs: Any, t: float) -> bool:
        stored = now = 0.0
        for joint in joints:
            memory, force, law = joint.kept, joint.force, joint.contact.normal
            if memory.in_contact and force.depth > 0.0:
                stored += law.elastic_energy(force.depth)
                now += (force.normal_force - law.elastic_force(force.depth)) * force.rate
                now -= force.friction_force * force.slip
        lost.append(lost[-1] + 0.5 * (t - before[0]) * (now + power[0]))
        power[0], before[0] = now, t
        balance.append(energy(mbs) + stored + lost[-1])
        return True

    mbs.SetPostStepUserFunction(after)
    return balance, lost


def kinetic(mbs: Any, bodies: Any) -> float:
    """Kinetic energy [J] of bodies: number, mass, inertia about all axes."""
    total = 0.0
    for body, mass, inertia in bodies:
        v, w = output(mbs, body, OUTPUT.Velocity), output(mbs, body, OUTPUT.AngularVelocity)
        total += 0.5 * mass * v @ v + 0.5 * inertia * w @ w
    return float(total)
