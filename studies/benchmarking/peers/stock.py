"""The stock recipe: the contact as a Python user function, fixed steps, nothing located.

As users of Exudyn write a pin with clearance: the engine's rigid-body connector calls a function of plain
floats, the initial impact velocity is noted at the end of the step in which the surfaces met, and generalised
alpha makes equal steps.
"""

import math
import time
from typing import Any

import exudyn
import numpy as np
from exudyn.itemInterface import NodeGenericData, ObjectConnectorRigidBodySpringDamper

from studies.benchmarking.peers.bare_scene import BareScene, bare_scene, ideal_scene
from studies.benchmarking.peers.peer_run import PeerRun, undisturbed
from studies.benchmarking.peers.plain_support import JournalForce, journal_force
from support_exudyn.scenario.scenario import Scenario

SPECTRAL_RADIUS = 0.5


class Watch:
    """What is noted of the contact at the ends of all steps, and the drive before each of them."""

    def __init__(self, scene: BareScene, step: float) -> None:
        self.scene = scene
        self.step = step
        self.count = 0
        self.times, self.depths, self.rates, self.forces = (
            [0.0],
            [-scene.contact.bearing.clearance],
            [0.0],
            [0.0],
        )

    def before_step(self, mbs: Any, t: float) -> bool:
        """Drive to the end of the step, at t."""
        self.count += 1
        self.scene.drive_to(t)
        return True

    def run(self, took: float) -> PeerRun:
        """The outcome of a run that took so long [s]."""
        series = (self.times, self.forces, self.depths, self.rates)
        t, force, depth, rate = (np.array(each) for each in series)
        return PeerRun(t, force, depth, rate, took)


class StockContact:
    """The connector's two user functions, and the initial impact velocity that they remember."""

    def __init__(self, watch: Watch, force: JournalForce, clearance: float) -> None:
        self.watch = watch
        self.on_journal = force
        self.clearance = clearance
        self.speed = 0.0  # of approach, 0 in free flight [m/s]

    def force(  # type: ignore[no-untyped-def]
        self, mbs, t, item, displacement, rotation, velocity, angular_velocity, *unused
    ) -> list[float]:
        """Force and moment of the connector: those of the journal on the bore."""
        fx, fy, moment = self.on_journal(
            displacement[0], displacement[1], velocity[0], velocity[1], angular_velocity[2], self.speed
        )
        return [-fx, -fy, 0.0, 0.0, 0.0, -moment]

    def after_newton(  # type: ignore[no-untyped-def]
        self, mbs, t, item, data, displacement, rotation, velocity, angular_velocity, *unused
    ) -> list[float]:
        """The post-Newton function: note the initial impact velocity once a step."""
        x, y = displacement[0], displacement[1]
        eccentricity = math.hypot(x, y)
        depth = eccentricity - self.clearance
        rate = (x * velocity[0] + y * velocity[1]) / (eccentricity or 1.0)
        if depth > 0.0:
            self.speed = self.speed or rate
        else:
            self.speed = 0.0
        found = self.force(mbs, t, item, displacement, rotation, velocity, angular_velocity)
        watch = self.watch
        watch.times.append(t)
        watch.depths.append(depth)
        watch.rates.append(rate)
        watch.forces.append(math.hypot(found[0], found[1]))
        return [0.0, -1.0, 0.0]


def fixed_steps(duration: float, step: float) -> Any:
    """Settings of generalised alpha with equal steps [s]; everything else as the engine has it."""
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.endTime = duration
    settings.timeIntegration.numberOfSteps = round(duration / step)
    settings.timeIntegration.generalizedAlpha.spectralRadius = SPECTRAL_RADIUS
    settings.timeIntegration.newton.useModifiedNewton = True
    settings.timeIntegration.adaptiveStep = False
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    return settings


def solved(solver: Any, mbs: Any, settings: Any) -> float:
    """Solve; how long it took of the processor [s]. Raises RuntimeError if the solver did not finish."""
    began = time.process_time()
    with undisturbed():
        finished = solver.SolveSystem(mbs, settings)
    if not finished:
        raise RuntimeError(f"the solver gave up at t = {solver.it.currentTime} s")
    return time.process_time() - began


def run_stock(scenario: Scenario, step: float) -> PeerRun:
    """Run the stock recipe.

    Arguments:
        scenario: see `plain_support`; its own step and solver are not used.
        step: length of all steps [s].

    Raises InputError if the scenario is not covered, RuntimeError if the solver gives up.
    """
    scene = bare_scene(scenario)
    watch = Watch(scene, step)
    contact = StockContact(watch, journal_force(scene.contact), scene.contact.bearing.clearance)
    node = scene.mbs.AddNode(NodeGenericData(initialCoordinates=[0.0], numberOfDataCoordinates=1))
    scene.mbs.AddObject(
        ObjectConnectorRigidBodySpringDamper(
            markerNumbers=[scene.bore, scene.journal],
            nodeNumber=node,
            springForceTorqueUserFunction=contact.force,
            postNewtonStepUserFunction=contact.after_newton,
        )
    )
    scene.mbs.Assemble()
    scene.mbs.SetPreStepUserFunction(watch.before_step)
    settings = fixed_steps(scenario.duration, step)
    return watch.run(solved(exudyn.MainSolverImplicitSecondOrder(), scene.mbs, settings))


# --- ideal pins ---


def peak_acceleration(scenario: Scenario, step: float, body: str) -> float:
    """Largest angular acceleration of a body that the engine gives at the end of any step [rad/s^2].

    Users of Exudyn run ideal pins with equal steps, and a solver that is not told of the drive's jumps. The
    acceleration is the engine's own, of its integrator, not one that follows from the motion.

    Arguments:
        scenario: without clearance pins, of rigid actuators; its own step and solver are not used.
        step: length of all steps [s].
        body: its name.

    Raises InputError if the scenario is not covered, RuntimeError if the solver gives up.
    """
    scene = ideal_scene(scenario)
    scene.mbs.Assemble()
    turn = int(scene.mbs.systemData.GetNodeLTGODE2(scene.nodes[body])[0]) + 2
    found: list[float] = []

    def note() -> None:
        found.append(float(scene.mbs.systemData.GetODE2Coordinates_tt()[turn]))

    def before_step(mbs: Any, t: float) -> bool:
        note()
        scene.drive_to(t)
        return True

    scene.mbs.SetPreStepUserFunction(before_step)
    solved(exudyn.MainSolverImplicitSecondOrder(), scene.mbs, fixed_steps(scenario.duration, step))
    note()
    return float(np.abs(found).max())
