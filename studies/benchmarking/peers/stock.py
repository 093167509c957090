"""The stock recipe: the contact as a Python user function, fixed steps, nothing located.

As users of Exudyn write a pin with clearance: the engine's rigid-body connector calls a function of plain
floats, the initial impact velocity is noted at the end of the step in which the surfaces met, and generalised
alpha makes equal steps.
"""

import math
import time
from collections.abc import Callable
from typing import Any

import exudyn
import numpy as np
from exudyn.itemInterface import NodeGenericData, ObjectConnectorRigidBodySpringDamper

from studies.benchmarking.peers.bare_scene import BareScene, bare_scene, ideal_scene
from studies.benchmarking.peers.peer_run import PeerRun, contact_numbers, impacts, undisturbed
from support_exudyn.scenario.scenario import Scenario
from user_forces.contact import JournalContact
from user_forces.friction.laws import Ambrosio, Frictionless
from user_forces.values.value import InputError

SPECTRAL_RADIUS = 0.5
Force = Callable[..., list[float]]


class Watch:
    """Depth, rate and force at the ends of steps, states at the records."""

    def __init__(self, scene: BareScene, step: float) -> None:
        self.scene = scene
        self.step = step
        self.every = max(1, round(scene.scenario.recorded_every / step))
        self.count = 0
        self.force = 0.0  # at the end of the last step [N]
        self.times: list[float] = []
        self.depths: list[float] = []
        self.rates: list[float] = []
        self.largest = 0.0
        self.rows: list[tuple[float, float, Any, Any]] = []

    def before_step(self, mbs: Any, t: float) -> bool:
        """Record what is there every so many steps; then drive to the end of the step, at t."""
        if self.count % self.every == 0:
            self.record()
        self.count += 1
        self.scene.drive_to(t)
        return True

    def record(self) -> None:
        """Keep the state at the end of the last step."""
        data = self.scene.mbs.systemData
        self.rows.append((self.now(), self.force, data.GetODE2Coordinates(), data.GetODE2Coordinates_tt()))

    def now(self) -> float:
        """Time at the end of the last step [s]."""
        return self.count * self.step

    def run(self, took: float, solver: Any, calls: int) -> PeerRun:
        """The outcome, once the solver has finished."""
        if self.now() > self.rows[-1][0] + 0.5 * self.step:
            self.record()
        times, forces, positions, accelerations = (np.array(column) for column in zip(*self.rows, strict=True))
        x, y = self.scene.traced(positions)
        return PeerRun(
            time=times,
            force=forces,
            angular_acceleration=accelerations[:, self.scene.first(self.scene.link) + 2],
            x=x,
            y=y,
            onsets=impacts(self.times, self.depths, self.rates),
            largest_force=self.largest,
            solve_time=took,
            steps=len(self.times),
            user_function_calls=calls,
            newton_iterations=int(solver.it.newtonStepsCount),
        )


class StockContact:
    """Force of the bore on the journal in plain floats, and what it remembers."""

    def __init__(self, watch: Watch, contact: JournalContact) -> None:
        self.watch = watch
        self.speed = 0.0  # of approach, 0 while apart [m/s]
        self.calls = 0
        self.bore_radius, self.clearance = contact.bearing.bore_radius, contact.bearing.clearance
        self.numbers = contact_numbers(contact)
        friction = contact.friction
        if not isinstance(friction, (Ambrosio, Frictionless)):
            raise InputError(f"friction = {friction}: allowed here: Ambrosio, Frictionless")
        self.friction = friction if isinstance(friction, Ambrosio) else None

    def smooth(self) -> Force:
        """The connector's force without friction."""
        stiffness, factor, floor = self.numbers
        clearance = self.clearance

        def force(  # type: ignore[no-untyped-def]
            mbs, t, item, displacement, rotation, velocity, angular_velocity, *unused
        ) -> list[float]:
            self.calls += 1
            x, y = displacement[0], displacement[1]
            eccentricity = math.hypot(x, y)
            depth = eccentricity - clearance
            if depth <= 0.0:
                return [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
            rate = (x * velocity[0] + y * velocity[1]) / eccentricity
            speed = max(self.speed or rate, floor)
            normal = stiffness * depth * math.sqrt(depth) * (1.0 + factor * rate / speed)
            share = max(0.0, normal) / eccentricity
            return [share * x, share * y, 0.0, 0.0, 0.0, 0.0]

        return force

    def rough(self, friction: Ambrosio) -> Force:
        """The connector's force with friction: the journal turns in a bore that does not."""
        stiffness, factor, floor = self.numbers
        clearance, bore_radius = self.clearance, self.bore_radius
        static, ramp = friction.static_speed, friction.dynamic_speed - friction.static_speed
        coefficient = friction.sliding_coefficient

        def force(  # type: ignore[no-untyped-def]
            mbs, t, item, displacement, rotation, velocity, angular_velocity, *unused
        ) -> list[float]:
            self.calls += 1
            x, y = displacement[0], displacement[1]
            eccentricity = math.hypot(x, y)
            depth = eccentricity - clearance
            if depth <= 0.0:
                return [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
            nx, ny = x / eccentricity, y / eccentricity
            vx, vy = velocity[0], velocity[1]
            rate = nx * vx + ny * vy
            speed = max(self.speed or rate, floor)
            normal = max(0.0, stiffness * depth * math.sqrt(depth) * (1.0 + factor * rate / speed))
            arm = bore_radius + 0.5 * depth - eccentricity
            slip = nx * vy - ny * vx + arm * angular_velocity[2]
            share = coefficient * min(1.0, max(0.0, (abs(slip) - static) / ramp))
            sliding = -math.copysign(share * normal, slip)
            return [normal * nx + sliding * ny, normal * ny - sliding * nx, 0.0, 0.0, 0.0, -arm * sliding]

        return force

    def after_newton(self, force: Force) -> Force:
        """The post-Newton function: note the initial impact velocity once a step."""
        watch, clearance = self.watch, self.clearance

        def note(  # type: ignore[no-untyped-def]
            mbs, t, item, data, displacement, rotation, velocity, angular_velocity, *unused
        ) -> list[float]:
            x, y = displacement[0], displacement[1]
            eccentricity = math.hypot(x, y)
            depth = eccentricity - clearance
            rate = (x * velocity[0] + y * velocity[1]) / (eccentricity or 1.0)
            watch.times.append(t)
            watch.depths.append(depth)
            watch.rates.append(rate)
            watch.force = 0.0
            if depth > 0.0:
                if self.speed == 0.0:
                    self.speed = rate
                found = force(mbs, t, item, displacement, rotation, velocity, angular_velocity)
                watch.force = math.hypot(found[0], found[1])
                watch.largest = max(watch.largest, watch.force)
            else:
                self.speed = 0.0
            return [0.0, -1.0, 0.0]

        return note


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
        scenario: HydraulicSupport with rigid actuators or SliderCrank, one clearance pin, start "concentric";
            its own step and solver are not used.
        step: length of all steps [s]; a whole number of them should make a record period.

    Raises InputError if the scenario is not covered, RuntimeError if the solver gives up.
    """
    scene = bare_scene(scenario)
    watch = Watch(scene, step)
    contact = StockContact(watch, scene.contact)
    force = contact.smooth() if contact.friction is None else contact.rough(contact.friction)
    node = scene.mbs.AddNode(NodeGenericData(initialCoordinates=[0.0], numberOfDataCoordinates=1))
    scene.mbs.AddObject(
        ObjectConnectorRigidBodySpringDamper(
            markerNumbers=[scene.bore, scene.journal],
            nodeNumber=node,
            springForceTorqueUserFunction=force,
            postNewtonStepUserFunction=contact.after_newton(force),
        )
    )
    scene.mbs.Assemble()
    scene.mbs.SetPreStepUserFunction(watch.before_step)
    solver: Any = exudyn.MainSolverImplicitSecondOrder()
    took = solved(solver, scene.mbs, fixed_steps(scenario.duration, step))
    return watch.run(took, solver, contact.calls)


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
    turn = scene.first(body) + 2
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
