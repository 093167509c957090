"""The engine's own contact in the bare scene under equal steps, and ours in its place.

All make the same steps: what differs is who computes the force, the engine in C++, the user function of our
connector alone, or a `ClearanceJoint`, which also follows impacts, the largest force and how long steps might
be.
"""

from typing import Any, Literal

import exudyn
import numpy as np

from studies.benchmarking.peers.bare_scene import BareScene, bare_scene
from studies.benchmarking.peers.peer_run import PeerRun, add_ball, contact_forces, pin_sensors
from studies.benchmarking.peers.stock import Watch, fixed_steps, solved
from support_exudyn.scenario.scenario import Scenario
from user_forces import ClearanceJoint
from user_forces.connector.bodies import mount
from user_forces.connector.contact_connector import FIRST
from user_forces.connector.item import JointItem
from user_forces.friction.laws import Frictionless
from user_forces.values.value import InputError

ASIDE = 1e-12  # of the bore from its journal, so that the engine's own contact has a normal [m]
UNDAMPED = 1e30  # impact velocity [m/s] against which every rate is nothing
Evaluator = Literal["built_in", "function", "joint"]


class _Function:
    """The user function of our connector without the bookkeeping of a joint.

    As the built-in contact does, it pushes whenever there is depth; the impact velocity is that at the end of
    the step in which the surfaces met, which itself is undamped.
    """

    def __init__(self, scene: BareScene) -> None:
        bore, journal = (mount(scene.mbs, end, (0.0, 0.0, 1.0)) for end in scene.ends)
        item = JointItem(scene.mbs, scene.contact, bore, journal, 0.0)
        self.clearance = scene.contact.bearing.clearance
        self.force = item.own_force()
        self.force.closed, self.force.speed = True, UNDAMPED

    def before_step(self) -> None:
        """Note the impact velocity, with what the last step ended."""
        depth, rate, *_ = self.force.last[FIRST:]
        if depth <= 0.0:
            self.force.speed = UNDAMPED
        elif self.force.speed == UNDAMPED:
            self.force.speed = rate


def run_built_in(
    scenario: Scenario, step: float, *, contact: Evaluator = "built_in", sensors: bool = True
) -> PeerRun:
    """Run with generalised alpha.

    Arguments:
        scenario: see `plain_support`, without friction; its own step and solver are not used.
        step: length of all steps [s].
        contact: what gives the force.
        sensors: let sensors write position and velocity of the pin at every step, from which force and
            impacts follow; without them only the time of the solver is known, and the run is cheaper.

    Raises InputError if the scenario is not covered, RuntimeError if the solver gives up.
    """
    scene = bare_scene(scenario, aside=ASIDE)
    law = scene.contact
    if not isinstance(law.friction, Frictionless):
        raise InputError("friction: the engine's own contact has another law; allowed here: Frictionless")
    if contact == "built_in":
        add_ball(scene.mbs, law, scene.journal, scene.bore)
    function = _Function(scene) if contact == "function" else None
    if contact == "joint":
        bore, journal = scene.ends
        bearing = law.bearing
        sizes = {"bore_radius": bearing.bore_radius, "clearance": bearing.clearance}
        ClearanceJoint(scene.mbs, bore=bore, journal=journal, normal=law.normal, **sizes)
    placed = pin_sensors(scene.mbs, scene.journal, scene.bore) if sensors else ()
    scene.mbs.Assemble()
    watch = Watch(scene, step)

    def before_step(mbs: Any, t: float) -> bool:
        if function is not None:
            function.before_step()
        return watch.before_step(mbs, t)

    scene.mbs.SetPreStepUserFunction(before_step)
    settings = fixed_steps(scenario.duration, step)
    settings.solution.sensors.writePeriod = 0.5 * step
    settings.timeIntegration.discontinuous.useRecommendedStepSize = False  # else it stops at the first contact
    scene.mbs.sys["simulationSettings"] = settings  # where `ClearanceJoint` reads that steps are fixed
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
