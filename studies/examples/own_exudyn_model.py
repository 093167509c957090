"""A clearance joint in an Exudyn model of one's own

A slider-crank at 5000 rpm is solved twice: with Exudyn's joint between rod and slider, and with a clearance of
0.5 mm there. One line differs. The picture shows the force of both joints, and the path of the journal's centre
in its bore. Only Exudyn and `user_forces` take part.
"""

import math
from typing import Any

import exudyn
import numpy as np
from exudyn.itemInterface import SensorObject
from exudyn.utilities import RigidBodyInertia
from matplotlib import pyplot as plt
from matplotlib.patches import Circle

from user_forces import Ambrosio, ClearanceJoint, LankaraniNikravesh

RATE = 5000 * math.pi / 30  # of the crank [rad/s]
PIN, SLIDE, DRIVE = [1, 1, 0, 0, 0, 0], [0, 1, 0, 0, 0, 1], [1, 1, 0, 0, 0, 1]
SIZES: dict[str, Any] = {"bore_radius": 0.01, "clearance": 5e-4}  # [m]
STEEL, FRICTION = LankaraniNikravesh(stiffness=6.61e10, restitution=0.9), Ambrosio(sliding_coefficient=0.03)


def angle(mbs: Any, t: float, *_: Any) -> list[float]:
    """The crank's angle [rad] behind five axes that stay in place."""
    return [0, 0, 0, 0, 0, RATE * t]


def solve(has_clearance: bool) -> tuple[Any, Any, Any]:
    """The joint between rod and slider, its force [N] and its displacement [m] over time."""
    mbs = exudyn.SystemContainer().AddSystem()

    def body(mass: float, inertia: float, x: float, vy: float, spin: float) -> Any:
        of, start = RigidBodyInertia(mass, np.diag([inertia] * 3)), {"initialVelocity": [0, vy, 0]}
        start |= {"referencePosition": [x, 0, 0], "initialAngularVelocity": [0, 0, spin]}
        return mbs.CreateRigidBody(inertia=of, create2D=True, **start)

    ground, tip = mbs.CreateGround(), 0.05 * RATE  # [m/s]
    crank = body(0.30, 1e-4, 0.025, tip / 2, RATE)
    rod = body(0.21, 2.5e-4, 0.11, tip / 2, -tip / 0.12)
    slider = body(0.14, 1e-4, 0.17, 0, 0)
    mbs.CreateGenericJoint("drive", [ground, crank], [0, 0, 0], constrainedAxes=DRIVE, offsetUserFunction=angle)
    mbs.CreateGenericJoint("crank pin", [crank, rod], [0.05, 0, 0], constrainedAxes=PIN)
    mbs.CreateGenericJoint("guide", [ground, slider], [0.17, 0, 0], constrainedAxes=SLIDE)
    if has_clearance:
        ends: dict[str, Any] = {"bore": (slider, [0, 0, 0]), "journal": (rod, [0.06, 0, 0])}
        joint: Any = ClearanceJoint(mbs, **ends, **SIZES, normal=STEEL, friction=FRICTION)
    else:
        joint = mbs.CreateGenericJoint("pin", [slider, rod], [0.17, 0, 0], constrainedAxes=PIN)
    kept = {"objectNumber": getattr(joint, "connector", joint), "storeInternal": True, "writeToFile": False}
    kinds = exudyn.OutputVariableType.ForceLocal, exudyn.OutputVariableType.DisplacementLocal
    sensors = [mbs.AddSensor(SensorObject(outputVariableType=kind, **kept)) for kind in kinds]
    mbs.Assemble()
    settings = exudyn.SimulationSettings()
    settings.solution.file.write, settings.solution.sensors.writePeriod = False, 0  # every step
    settings.timeIntegration.endTime, settings.timeIntegration.numberOfSteps = 0.012, 1200
    settings.timeIntegration.newton.absoluteTolerance = 1e-6
    mbs.SolveDynamic(settings)
    return joint, *(mbs.GetSensorStoredData(sensor) for sensor in sensors)


(_, ideal, _), (joint, force, path) = solve(False), solve(True)
print(f"largest force {1e-3 * joint.largest_force:.1f} kN, impacts {len(joint.impacts)}")
print(f"the first after {1e6 * joint.impacts[0].time:.1f} us with {joint.impacts[0].speed:.4f} m/s")
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained", width_ratios=(2, 1))
for series, label in ((force, "clearance 0.5 mm"), (ideal, "Exudyn's joint")):
    left.plot(1e3 * series[:, 0], 1e-3 * np.hypot(series[:, 1], series[:, 2]), linewidth=0.9, label=label)
left.set(xlabel="time [ms]", ylabel="force of the joint [kN]")
left.legend()
right.add_patch(Circle((0, 0), 0.5, fill=False, linestyle="--"))
right.plot(1e3 * path[:, 1], 1e3 * path[:, 2], linewidth=0.8)
right.set(xlabel="journal's centre, x [mm]", ylabel="y [mm]", aspect="equal")
figure.savefig("own_exudyn_model.png", dpi=120)
