"""What the engine holds for a scenario in the Exudyn formulation, counted in the engine itself."""

from dataclasses import dataclass
from typing import Any

from support_exudyn.formulations.contract import silent
from support_exudyn.formulations.redundant.run import check, model
from support_exudyn.formulations.redundant.solver.recorder import Recorder
from support_exudyn.formulations.redundant.solver.solver import SolverRun
from support_exudyn.scenario.recorded_channels import needs
from support_exudyn.scenario.scenario import Scenario

OF_BEARINGS = "GenericODE2"  # the engine's name
BODIES = ("RigidBody2D", "RigidBody")  # the engine's names, in the plane and in space


@dataclass(frozen=True)
class Inventory:
    """How many there are of each.

    coordinates: of all bodies, three each; in space seven, for they turn by Euler parameters. constraints:
    algebraic equations; in space one more for each body, which keeps its four parameters a rotation, and
    one without effect for each direction that a joint of the engine's leaves free. nodes: of bodies, and
    the fixed one of cranks. objects: bodies, connectors and the ground. connectors: objects between
    markers: ideal and clearance pins, actuators, cranks, guides, and what presses on the machine besides its
    weight; in space a clearance bearing has one between nodes, or if it is symbolic one for each section.
    user_functions: forces and the like that Python computes, as often as the solver asks, several times a
    step. callbacks: functions of Python that the engine calls at every step.
    """

    coordinates: int
    constraints: int
    bodies: int
    nodes: int
    objects: int
    connectors: int
    markers: int
    loads: int
    sensors: int
    user_functions: int
    callbacks: int


def inventory(scenario: Scenario) -> Inventory:
    """Build a scenario's model, ready to run, and count. Raises InputError if its settings do not fit."""
    check(scenario)
    scene = model(scenario)
    try:
        SolverRun(scene, Recorder(scene, needs(scenario)), silent).connect()
        return _count(scene.mbs)
    finally:
        scene.release()


def _count(mbs: Any) -> Inventory:
    data = mbs.systemData
    objects = [mbs.GetObject(n) for n in range(data.NumberOfObjects())]
    loads = [mbs.GetLoad(n) for n in range(data.NumberOfLoads())]
    called = (
        mbs.GetPreStepUserFunction(),
        mbs.GetPostNewtonUserFunction(),
        mbs.GetPostStepUserFunction(),
        mbs.GetPreNewtonResidualUserFunction(),
        mbs.GetSystemJacobianUserFunction(),
    )
    return Inventory(
        coordinates=int(data.ODE2Size()),
        constraints=int(data.AEsize()),
        bodies=sum(item["objectType"] in BODIES for item in objects),
        nodes=int(data.NumberOfNodes()),
        objects=len(objects),
        connectors=sum("markerNumbers" in item or item["objectType"] == OF_BEARINGS for item in objects),
        markers=int(data.NumberOfMarkers()),
        loads=len(loads),
        sensors=int(data.NumberOfSensors()),
        user_functions=sum(_is_python(part) for item in [*objects, *loads] for part in item.values()),
        callbacks=sum(function not in (0, None) for function in called),
    )


def _is_python(part: Any) -> bool:
    """Whether a parameter of an item is a user function that Python computes."""
    return isinstance(part, dict) and part.get("type") == "Python"
