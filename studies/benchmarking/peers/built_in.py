"""The engine's own contact in the bare scene with the bare solver, and our connector in its place.

A ball in a hollow ball is a journal in a bore. Its Hunt-Crossley factor 3 (1 - e)/2 equals Lankarani and
Nikravesh's 3 (1 - e^2)/4 if its restitution is set to 1 - (1 - e^2)/2. It notes the approach speed at the end
of the step that noticed the contact, and it has no normal at the centre, so it starts beside it.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

import exudyn
import numpy as np
from exudyn.itemInterface import (
    NodeGenericData,
    ObjectContactSphereSphere,
    SensorMarker,
)

from studies.benchmarking.peers.bare_scene import BareScene, bare_scene, loose_contact
from studies.benchmarking.peers.lookout import Lookout
from studies.benchmarking.peers.peer_run import PeerRun
from studies.benchmarking.peers.stock import Watch, contact_forces, contact_numbers, fixed_steps, solve
from support_exudyn.formulations.redundant.clearance.python_force import PythonForce
from support_exudyn.formulations.redundant.scene.scene_builder import build
from support_exudyn.scenario.scenario import Scenario
from user_forces.friction.frictionless import Frictionless
from user_forces.values.value import InputError

ASIDE = 1e-12  # of the bore from the journal, so that there is a normal [m]
ITERATION_TOLERANCE = (
    1e3  # of the engine's discontinuous iteration; with its default, 1, it stops at the first contact
)
UNDAMPED = 1e30  # touch speed [m/s] against which every rate is nothing
SMALLEST_STEP = 1e-13  # [s]; with the engine's default the first contact stops it
Evaluator = Literal["built_in", "python", "symbolic"]
Control = Literal["fixed", "adaptive"]
BeforeStep = Callable[[Any, float], bool]


@dataclass
class Fitted:
    """A scene with its contact, the function to call before every step, and how often Python gave the force."""

    scene: BareScene
    before_step: BeforeStep
    calls: Callable[[], int]
    assembled: Callable[[], None] = lambda: None  # to be called once it is


def run_built_in(
    scenario: Scenario,
    step: float,
    *,
    control: Control = "fixed",
    contact: Evaluator = "built_in",
    newton_tolerance: float = 1e-8,
    contractivity: float = 0.5,
    watch_steps: bool = True,
) -> PeerRun:
    """Run with generalised alpha.

    Arguments:
        scenario: HydraulicSupport with rigid columns or SliderCrank, one loose pin without friction, start
            "concentric"; its own step and solver are not used.
        step: length of all steps, or of the largest [s]; a whole number of them should make a record period.
        control: "fixed": equal steps; "adaptive": the engine cuts steps where its contact recommends it, and
            lengthens them again (only for "built_in").
        contact: what gives the force: the engine's own contact, or our connector by one of its backends.
        newton_tolerance, contractivity: of Newton's method; the engine's defaults are 1e-8 and 0.5.
        watch_steps: let sensors write position and velocity of the pin at every step, from which onsets and the
            largest force follow; without them only records are known, and the run is cheaper.

    Raises InputError if the scenario is not covered, RuntimeError if the solver gives up.
    """
    began = time.perf_counter()
    _, law, _ = loose_contact(scenario)
    if not isinstance(law.friction, Frictionless):
        raise InputError("friction: the engine's own contact has another law; allowed here: Frictionless")
    if control == "adaptive" and contact != "built_in":
        raise InputError(f"contact = {contact!r}: allowed with control = 'adaptive': 'built_in'")
    fitted = FITTERS[contact](scenario, step)
    scene = fitted.scene
    sensors = _add_sensors(scene, step) if watch_steps else ()
    scene.mbs.Assemble()
    fitted.assembled()
    watch = Watch(scene, step) if control == "fixed" else WatchTimes(scene, step)

    def before_step(mbs: Any, t: float) -> bool:
        watch.before_step(mbs, t)
        return fitted.before_step(mbs, t)

    scene.mbs.SetPreStepUserFunction(before_step if fitted.before_step is not nothing else watch.before_step)
    settings = fixed_steps(scenario.duration, step)
    settings.timeIntegration.newton.relativeTolerance = newton_tolerance
    settings.timeIntegration.newton.modifiedNewtonContractivity = contractivity
    settings.solution.sensors.writePeriod = 0.5 * step if control == "fixed" else SMALLEST_STEP
    _set_control(settings, control)
    solver, took = solve(scene, settings)
    _fill(watch, scene, sensors, step)
    return watch.run(began, took, solver, fitted.calls())


def nothing(mbs: Any, t: float) -> bool:
    """Before a step there is nothing to do."""
    return True


def _set_control(settings: Any, control: Control) -> None:
    integration = settings.timeIntegration
    integration.discontinuous.useRecommendedStepSize = control == "adaptive"
    if control == "adaptive":
        integration.adaptiveStep = True
        integration.adaptiveStepRecoverySteps = 2
        integration.minimumStepSize = SMALLEST_STEP
        integration.newton.useModifiedNewton = False  # else it stops at the first contact
        integration.discontinuous.maxIterations = 1
        integration.discontinuous.ignoreMaxIterations = False
        integration.discontinuous.iterationTolerance = ITERATION_TOLERANCE


class WatchTimes(Watch):
    """The same where steps differ: a state is kept at the first step's end at or after each record's time."""

    def before_step(self, mbs: Any, t: float) -> bool:
        """Record when a record's time has come; then drive to the end of the step, at t."""
        if self.now() >= len(self.rows) * self.scene.scenario.record_period - 1e-12:
            self.record()
        self.scene.drive_to(t)
        return True

    def now(self) -> float:
        """Time at the end of the last step [s]."""
        return float(self.scene.mbs.systemData.GetTime())


def _add_sensors(scene: BareScene, step: float) -> tuple[Any, ...]:
    """Position and velocity of journal and bore at every step."""
    output = exudyn.OutputVariableType
    return tuple(
        scene.mbs.AddSensor(
            SensorMarker(markerNumber=marker, outputVariableType=what, storeInternal=True, writeToFile=False)
        )
        for what in (output.Position, output.Velocity)
        for marker in (scene.journal, scene.bore)
    )


def _fill(watch: Watch, scene: BareScene, sensors: tuple[Any, ...], step: float) -> None:
    """Depth, rate and force at all steps, from what the sensors wrote."""
    if not sensors:
        watch.times = [scene.scenario.duration]
        watch.depths = watch.rates = [0.0]
        return
    journal, bore, journal_speed, bore_speed = (scene.mbs.GetSensorStoredData(sensor) for sensor in sensors)
    apart, moving = journal[:, 1:3] - bore[:, 1:3], journal_speed[:, 1:3] - bore_speed[:, 1:3]
    eccentricity = np.hypot(*apart.T)
    depth = eccentricity - scene.contact.bearing.clearance
    rate = (apart * moving).sum(axis=1) / np.maximum(eccentricity, 1e-300)
    force = contact_forces(scene.contact, depth, rate)
    watch.largest = float(force.max())
    watch.times, watch.depths, watch.rates = journal[:, 0].tolist(), depth.tolist(), rate.tolist()
    at = np.searchsorted(journal[:, 0], np.array([row[0] for row in watch.rows]) - 1e-12)
    watch.rows = [(row[0], float(force[n]), *row[2:]) for row, n in zip(watch.rows, at.tolist(), strict=True)]
    watch.force = float(force[-1])


# --- what gives the force ---


def _fit_built_in(scenario: Scenario, step: float) -> Fitted:
    """The engine's ball in a hollow ball."""
    scene = bare_scene(scenario, aside=ASIDE)
    law = scene.contact.normal
    contact_numbers(scene.contact)
    restitution, bearing = law.restitution, scene.contact.bearing  # type: ignore[attr-defined]
    node = scene.mbs.AddNode(NodeGenericData(initialCoordinates=[0.1, 0, 0, 0], numberOfDataCoordinates=4))
    scene.mbs.AddObject(
        ObjectContactSphereSphere(
            markerNumbers=[scene.journal, scene.bore],
            nodeNumber=node,
            spheresRadii=[bearing.journal_radius, bearing.bore_radius],
            isHollowSphere1=True,
            contactStiffness=law.stiffness,  # type: ignore[attr-defined]
            contactStiffnessExponent=1.5,
            restitutionCoefficient=1.0 - 0.5 * (1.0 - restitution**2),
            impactModel=1,
            minimumImpactVelocity=contact_numbers(scene.contact)[2],
        )
    )
    return Fitted(scene, nothing, lambda: 0)


def _fit_ours(backend: Literal["python", "symbolic"], scenario: Scenario, step: float) -> Fitted:
    """Our connector: the `LoosePin` of a scene that `redundant.scene.scene.build` made.

    As the built-in contact does, it pushes whenever there is depth; the speed is that at the end of the step in
    which the surfaces met, which itself is undamped.
    """
    ours = build(replace(scenario, solver=replace(scenario.solver, backend=backend)))
    ((name, pin),) = ours.loose_pins.items()
    scene = BareScene(
        scenario=scenario,
        linkage=ours.linkage,
        contact=pin.contact,
        container=ours,
        mbs=ours.mbs,
        nodes={name: item.node for name, item in ours.bodies.items()},
        columns=[(item.object, item.column.start_length) for item in ours.rigid_columns.values()],
        cranks=[item.object for item in ours.cranks.values()],
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

        def before_step(mbs: Any, t: float) -> bool:
            note(*force.last)  # which the last step ended with
            return True

        return Fitted(scene, before_step, lambda: pin.calls, assembled)
    lookout = Lookout(ours.pin_motion(name), pin.contact.bearing.clearance)

    def look(mbs: Any, t: float) -> bool:
        if t >= lookout.next:
            note(*lookout.look(t - step, step))
        return True

    return Fitted(scene, look, lambda: pin.calls, assembled)


FITTERS: dict[Evaluator, Callable[[Scenario, float], Fitted]] = {
    "built_in": _fit_built_in,
    "python": lambda scenario, step: _fit_ours("python", scenario, step),
    "symbolic": lambda scenario, step: _fit_ours("symbolic", scenario, step),
}
