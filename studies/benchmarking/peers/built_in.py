"""The engine's own contact in the bare scene under equal steps, and our connector in its place.

Both make the same steps: what differs is who computes the force, the engine in C++ or the connector's
function in Python. The connector is that of the formulation on the engine, with its events left out.
"""

from typing import Any, Literal

import exudyn
import numpy as np

from studies.benchmarking.peers.bare_scene import BareScene, bare_scene
from studies.benchmarking.peers.peer_run import PeerRun, add_ball, contact_forces, pin_sensors
from studies.benchmarking.peers.stock import Watch, fixed_steps, solved
from support_exudyn.formulations.redundant.scene.scene_builder import build
from support_exudyn.scenario.scenario import Scenario
from user_forces.connector.contact_connector import FIRST
from user_forces.friction.laws import Frictionless
from user_forces.values.value import InputError

UNDAMPED = 1e30  # impact velocity [m/s] against which every rate is nothing
ASIDE = 1e-12  # of the bore from its journal, so that the engine's own contact has a normal [m]
Evaluator = Literal["built_in", "python"]


def run_built_in(
    scenario: Scenario, step: float, *, contact: Evaluator = "built_in", sensors: bool = True
) -> PeerRun:
    """Run with generalised alpha.

    Arguments:
        scenario: see `plain_support`, without friction; its own step and solver are not used.
        step: length of all steps [s].
        contact: what gives the force: the engine's own contact, or our connector's function in Python.
        sensors: let sensors write position and velocity of the pin at every step, from which force and
            impacts follow; without them only the time of the solver is known, and the run is cheaper.

    Raises InputError if the scenario is not covered, RuntimeError if the solver gives up.
    """
    scene = bare_scene(scenario, aside=ASIDE)
    if not isinstance(scene.contact.friction, Frictionless):
        raise InputError("friction: the engine's own contact has another law; allowed here: Frictionless")
    if contact == "python":
        return _ours(scenario, step, sensors)
    add_ball(scene.mbs, scene.contact, scene.journal, scene.bore)
    return _run(scene, step, sensors)


def _run(scene: BareScene, step: float, sensors: bool, connector: Any = None) -> PeerRun:
    """Assemble and solve; of our connector the initial impact velocity is noted after each step."""
    placed = pin_sensors(scene.mbs, scene.journal, scene.bore) if sensors else ()
    scene.mbs.Assemble()
    watch, closed = Watch(scene, step), False
    before_step = watch.before_step
    if connector is not None:
        scene.container.drive_to(0.0)
        scene.container.start_moving()
        scene.container.reset_memory()
        connector.act_without_memory(UNDAMPED)

        def before_step(mbs: Any, t: float) -> bool:
            nonlocal closed
            depth, rate = connector.user_function.last[FIRST : FIRST + 2]  # with what the last step ended
            if (depth > 0.0) != closed:
                closed = not closed
                connector.act_without_memory(rate if closed else UNDAMPED)
            return watch.before_step(mbs, t)

    scene.mbs.SetPreStepUserFunction(before_step)
    settings = fixed_steps(scene.scenario.duration, step)
    settings.solution.sensors.writePeriod = 0.5 * step
    settings.timeIntegration.discontinuous.useRecommendedStepSize = False  # else it stops at the first contact
    took = solved(exudyn.MainSolverImplicitSecondOrder(), scene.mbs, settings)
    return _sensed(scene, placed, took) if placed else watch.run(took)


def _sensed(scene: BareScene, sensors: tuple[Any, ...], took: float) -> PeerRun:
    """Depth, rate and force at all steps, from what the sensors wrote."""
    journal, bore, journal_speed, bore_speed = (scene.mbs.GetSensorStoredData(sensor) for sensor in sensors)
    away, moving = journal[:, 1:3] - bore[:, 1:3], journal_speed[:, 1:3] - bore_speed[:, 1:3]
    eccentricity = np.hypot(*away.T)
    depth = eccentricity - scene.contact.bearing.clearance
    rate = (away * moving).sum(axis=1) / np.maximum(eccentricity, 1e-300)
    return PeerRun(journal[:, 0], contact_forces(scene.contact, depth, rate), depth, rate, took)


def _ours(scenario: Scenario, step: float, sensors: bool) -> PeerRun:
    """Run with our connector in a scene that the formulation on the engine made.

    As the built-in contact does, it pushes whenever there is depth; the speed is that at the end of the step
    in which the surfaces met, which itself is undamped.
    """
    ours = build(scenario)
    ((_, pin),) = ours.clearance_joints.items()
    scene = BareScene(
        scenario=scenario,
        container=ours,
        mbs=ours.mbs,
        nodes={name: item.node for name, item in ours.bodies.items()},
        actuators=[(item.object, item.actuator.start_length) for item in ours.rigid_actuators.values()],
        contact=pin.contact,
        bore=pin.item.bore_marker,
        journal=pin.item.journal_marker,
    )
    return _run(scene, step, sensors, pin)
