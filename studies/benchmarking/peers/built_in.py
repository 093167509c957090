"""The engine's own contact in the bare scene with the bare solver, and our connector in its place."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

import exudyn
import numpy as np
from support_exudyn.formulations.redundant.clearance.pin_motion import PinMotion
from support_exudyn.formulations.redundant.clearance.python_force import PythonForce

from studies.benchmarking.peers.bare_scene import BareScene, bare_scene, clearance_contact
from studies.benchmarking.peers.peer_run import ASIDE, PeerRun, PinSeries, add_ball, pin_sensors
from studies.benchmarking.peers.stock import Watch, fixed_steps, solved
from support_exudyn.formulations.redundant.scene.scene_builder import build
from support_exudyn.scenario.scenario import Scenario
from user_forces.friction.laws import Frictionless
from user_forces.values.value import InputError

UNDAMPED = 1e30  # impact velocity [m/s] against which every rate is nothing
WAY = 0.25  # of the way to an impact or separation may be gone before the next look
STRONGER = 4.0  # than it was since the last look the acceleration may become before the next
SMALLEST = 1e-300  # [m/s], only so that nothing is divided by zero
WEAKEST = 100.0  # acceleration that is always allowed for [m/s^2]
Evaluator = Literal["built_in", "python", "symbolic"]


@dataclass
class Fitted:
    """A scene with its contact, what is done before every step, how often Python gave the force, and its start.

    before_step: is told the time at the end of the coming step [s]. assembled: to be called once the scene is.
    """

    scene: BareScene
    before_step: Callable[[float], None] | None = None
    calls: Callable[[], int] = lambda: 0
    assembled: Callable[[], None] = lambda: None


def run_built_in(
    scenario: Scenario, step: float, *, contact: Evaluator = "built_in", step_callbacks: bool = True
) -> PeerRun:
    """Run with generalised alpha.

    Arguments:
        scenario: HydraulicSupport with rigid actuators or SliderCrank, one clearance pin without friction,
            start "concentric"; its own step and solver are not used.
        step: length of all steps [s]; a whole number of them should make a record period.
        contact: what gives the force: the engine's own contact, or our connector by one of its backends.
        watch_steps: let sensors write position and velocity of the pin at every step, from which onsets and the
            largest force follow; without them only records are known, and the run is cheaper.

    Raises InputError if the scenario is not covered, RuntimeError if the solver gives up.
    """
    _, law, _ = clearance_contact(scenario)
    if not isinstance(law.friction, Frictionless):
        raise InputError("friction: the engine's own contact has another law; allowed here: Frictionless")
    fitted = _ball(scenario) if contact == "built_in" else _ours(contact, scenario, step)
    scene = fitted.scene
    sensors = pin_sensors(scene.mbs, scene.journal, scene.bore) if step_callbacks else ()
    scene.mbs.Assemble()
    fitted.assembled()
    watch = Watch(scene, step)
    more = fitted.before_step

    def before_step(mbs: Any, t: float) -> bool:
        watch.before_step(mbs, t)
        if more is not None:
            more(t)
        return True

    scene.mbs.SetPreStepUserFunction(watch.before_step if more is None else before_step)
    settings = fixed_steps(scenario.duration, step)
    settings.solution.sensors.writePeriod = 0.5 * step
    settings.timeIntegration.discontinuous.useRecommendedStepSize = False  # else it stops at the first contact
    solver: Any = exudyn.MainSolverImplicitSecondOrder()
    took = solved(solver, scene.mbs, settings)
    _fill(watch, scene, sensors)
    return watch.run(took, solver, fitted.calls())


def _fill(watch: Watch, scene: BareScene, sensors: tuple[Any, ...]) -> None:
    """Depth, rate and force at all steps, from what the sensors wrote."""
    if not sensors:
        watch.times = [scene.scenario.duration]
        watch.depths = watch.rates = [0.0]
        return
    pin = PinSeries.read(scene.mbs, scene.contact, sensors)
    watch.largest = float(pin.force.max())
    watch.times, watch.depths, watch.rates = pin.time.tolist(), pin.depth.tolist(), pin.rate.tolist()
    at = np.searchsorted(pin.time, np.array([row[0] for row in watch.rows]) - 1e-12)
    watch.rows = [
        (row[0], float(pin.force[n]), *row[2:]) for row, n in zip(watch.rows, at.tolist(), strict=True)
    ]
    watch.force = float(pin.force[-1])


# --- what gives the force ---


def _ball(scenario: Scenario) -> Fitted:
    """The engine's ball in a hollow ball."""
    scene = bare_scene(scenario, aside=ASIDE)
    add_ball(scene.mbs, scene.contact, scene.journal, scene.bore)
    return Fitted(scene)


def _ours(backend: Literal["python", "symbolic"], scenario: Scenario, step: float) -> Fitted:
    """Our connector: the `ClearanceJoint` of a scene that `redundant.scene.scene.build` made.

    As the built-in contact does, it pushes whenever there is depth; the speed is that at the end of the step in
    which the surfaces met, which itself is undamped.
    """
    ours = build(replace(scenario, solver=replace(scenario.solver, backend=backend)))
    ((name, pin),) = ours.clearance_joints.items()
    scene = BareScene(
        scenario=scenario,
        linkage=ours.linkage,
        container=ours,
        mbs=ours.mbs,
        nodes={name: item.node for name, item in ours.bodies.items()},
        actuators=[(item.object, item.actuator.start_length) for item in ours.rigid_actuators.values()],
        cranks=[item.object for item in ours.cranks.values()],
        contact=pin.contact,
        bore=pin.connector.bore_marker,
        journal=pin.connector.journal_marker,
        link=ours.linkage.pins[name].second,
    )
    closed = False

    def note(depth: float, rate: float) -> None:
        nonlocal closed
        if (depth > 0.0) != closed:
            closed = not closed
            pin.plainly(rate if closed else UNDAMPED)

    def assembled() -> None:
        ours.drive_to(0.0)
        ours.start_moving()
        ours.reset_memory()
        pin.plainly(UNDAMPED)

    force = pin.engine_force
    if isinstance(force, PythonForce):
        # with what the last step ended
        return Fitted(scene, lambda t: note(*force.last), lambda: pin.calls, assembled)
    event_watch = _Lookout(ours.pin_motion(name), pin.contact.bearing.clearance)

    def look(t: float) -> None:
        if t >= event_watch.next:
            note(*event_watch.look(t - step, step))

    return Fitted(scene, look, lambda: pin.calls, assembled)


class _Lookout:
    """Looks at a pin, seldom while its surfaces are far from meeting or separation; clearance in m."""

    def __init__(self, motion: PinMotion, clearance: float) -> None:
        self._motion = motion
        self._clearance = clearance
        self._last = (0.0, 0.0, 0.0)  # time of the last look [s], velocity then [m/s]
        self.next = 0.0  # time of the next look [s]

    def look(self, now: float, step: float) -> tuple[float, float]:
        """Depth [m] and rate [m/s] at this time [s]; steps are so long [s]."""
        (bx, by, bvx, bvy, _, _), (x, y, vx, vy, _, _) = self._motion.now()
        x, y, vx, vy = x - bx, y - by, vx - bvx, vy - bvy
        eccentricity = math.hypot(x, y)
        depth = eccentricity - self._clearance
        last, last_vx, last_vy = self._last
        since = max(now - last, step)
        rate = (x * vx + y * vy) / (eccentricity or 1.0)
        strong = max(WEAKEST, STRONGER * math.hypot(vx - last_vx, vy - last_vy) / since)
        strong += (vx * vx + vy * vy) / self._clearance  # of the depth: what circles goes outwards
        way, towards = WAY * abs(depth), rate if depth < 0.0 else -rate
        # the time for that way from this speed at that acceleration, at most twice that since the last look
        wait = 2.0 * way / max(SMALLEST, towards + math.sqrt(towards * towards + 2.0 * strong * way))
        self.next = now + min(wait, 2.0 * since)
        self._last = now, vx, vy
        return depth, rate
