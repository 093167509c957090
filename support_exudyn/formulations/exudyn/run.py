"""The Exudyn formulation: Exudyn's rigid bodies with constraints, generalised alpha, located impacts.

It covers every scenario but friction in pins whose forces rigid bodies do not determine, and is the reference
for the others.
"""

import numpy as np

from support_exudyn.formulations.exudyn.scene.record_forces import applied_forces, following
from support_exudyn.formulations.exudyn.scene.scene import Scene
from support_exudyn.formulations.exudyn.scene.scene_builder import build
from support_exudyn.formulations.exudyn.scene.static_equilibrium import find_static_equilibrium
from support_exudyn.formulations.exudyn.solver.recorder import History, Recorder
from support_exudyn.formulations.exudyn.solver.solver import SolverRun
from support_exudyn.formulations.exudyn.space.observation import SpatialObservation
from support_exudyn.formulations.exudyn.space.scene import SpatialScene
from support_exudyn.formulations.exudyn.space.scene_builder import build as build_in_space
from support_exudyn.machines.check.freedoms import FIELDS, repeated
from support_exudyn.mechanics.acting_loads import load_series
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.channels import FOLLOWING, DataNeeds, with_causes
from support_exudyn.mechanics.joint_friction import friction_series
from support_exudyn.mechanics.observed_run import ObservedRun, Outcome, Trajectory
from support_exudyn.mechanics.reactions import joint_forces
from support_exudyn.mechanics.trajectory import LegSeries, Series
from support_exudyn.scenario.recorded_channels import needs
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.contract import Progress
from user_forces.values.value import InputError

Model = Scene | SpatialScene


def model(scenario: Scenario) -> Model:
    """The engine's model of a scenario at its start, before any settling, whatever its formulation is.

    Who asks for it releases it, see `EngineScene.release`.
    """
    return build_in_space(scenario) if scenario.dimensions == 3 else build(scenario)


def check(scenario: Scenario) -> None:
    """Raise InputError if pins have friction whose forces rigid bodies do not determine."""
    still = np.zeros(3 * len(scenario.linkage.bodies))
    for one in repeated(scenario.held, still) if scenario.friction_laws else ():
        parts = [f"{FIELDS.get(kind, kind)}.{name}" for kind, name in one.parts]
        if rough := [name for name in parts if name in scenario.friction_laws]:
            raise InputError(
                f"{rough[0]}.friction: not covered by formulation = 'exudyn', for {one.said()}, and "
                "the engine takes any forces that fit; allowed: formulation = 'compiled', which takes the "
                "least, or a bushing in one of them"
            )


def run(scenario: Scenario, progress: Progress) -> Outcome:
    """Run a scenario. Raises SimulationError if it cannot be finished."""
    scene, needed = model(scenario), with_causes(needs(scenario))

    def observed(history: History) -> ObservedRun:
        if isinstance(scene, SpatialScene):
            return SpatialObservation(scene, history)
        return trajectory(scene, history, needed)

    try:
        if scenario.start == "settled":
            find_static_equilibrium(scene)
        recorder = Recorder(scene, needed, observed)
        solving = SolverRun(scene, recorder, progress)
        counts = solving.go()
        contacts = scene.recorded_contacts()
        return Outcome(
            trajectory=observed(recorder.history()),
            onsets={name: tuple(one.onsets) for name, one in contacts.items()},
            largest_force={name: one.largest_force for name, one in contacts.items()},
            largest_force_time={name: one.largest_force_time for name, one in contacts.items()},
            impulses=tuple(solving.impulses),
            counts=counts,
            oil_events=scene.legs.events,
            statistics=recorder.finished(),
        )
    finally:
        scene.release()


def trajectory(scene: Scene, history: History, needed: DataNeeds) -> Trajectory:
    """What the records say; what is not needed is left out."""
    scenario, linkage = scene.scenario, scene.linkage
    motion, time = BodyMotion(linkage, history.position, history.velocity), history.time
    legs: dict[str, LegSeries] = {}
    if scene.legs.names and DataNeeds.OIL in needed:
        lengths = {name: motion.lengthening(linkage.actuators[name]) for name in scene.legs.names}
        legs = scene.legs.series(time, lengths, history.legs)
    actuators = {name: one.force for name, one in legs.items() if name in linkage.actuators}
    places = enumerate(scene.clearance_joints) if DataNeeds.CONTACTS in needed else ()
    contacts = {name: scene.places[name].series(motion, history.memory[:, n]) for n, name in places}
    acting = scenario.elements.items() if DataNeeds.LOADS in needed else ()
    loads = {name: load_series(load, name, motion, time) for name, load in acting}
    acceleration, held = history.velocity[:, :0], joint_forces((), history.velocity)
    frictions: dict[str, Series] = {}
    if needed & FOLLOWING:
        applied = applied_forces(scene, motion, contacts, actuators, loads)
        acceleration, multipliers, frictions = following(scene, motion, time, applied, history.deflection)
        held = joint_forces(scenario.held.kinetics.constraints, multipliers)
    return Trajectory(
        linkage=linkage,
        gravity=scenario.gravity,
        time=time,
        position=history.position,
        velocity=history.velocity,
        acceleration=acceleration,
        ideal_pins=held["pins"],
        contacts=contacts,
        **friction_series(scenario, frictions),
        actuators={**held["actuators"], **actuators},
        cranks=held["cranks"],
        slides=held["slides"],
        gears=held["gears"],
        work=history.work,
        damping_loss=history.damping_loss,
        friction_loss=history.friction_loss,
        loads=loads,
        legs=legs,
    )
