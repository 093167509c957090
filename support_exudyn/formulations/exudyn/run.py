"""The Exudyn formulation: Exudyn's rigid bodies with constraints, generalised alpha, located impacts.

It covers every scenario but friction in pins whose forces rigid bodies do not determine, and is the reference
for the others.
"""

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from support_exudyn.formulations.exudyn.scene.engine_scene import EngineScene
from support_exudyn.formulations.exudyn.scene.record_forces import (
    FOLLOWING,
    Applied,
    Following,
    JointForces,
    following,
    with_causes,
)
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
from support_exudyn.mechanics.channels import DataNeeds
from support_exudyn.mechanics.joint_friction import friction_series
from support_exudyn.mechanics.trajectory import LegSeries, Outcome, Series, Trajectory
from support_exudyn.scenario.recorded_channels import needs
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.contract import Progress
from user_forces.connector.contact_connector import ContactConnector
from user_forces.values.value import InputError

EDGES = {"left": 0, "right": -1}  # of bearings in space: the first and the last section
AnyScene = TypeVar("AnyScene", bound=EngineScene)
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
    if scenario.dimensions == 3:
        return _run(build_in_space(scenario), progress, _outcome_in_space)
    return _run(build(scenario), progress, _outcome)


def _run(scene: AnyScene, progress: Progress, outcome: Callable[[AnyScene, Progress], Outcome]) -> Outcome:
    try:
        if scene.scenario.start == "settled":
            find_static_equilibrium(scene)
        return outcome(scene, progress)
    finally:
        scene.release()


def _outcome(scene: Scene, progress: Progress) -> Outcome:
    needed = with_causes(needs(scene.scenario))
    recorder = Recorder(scene, needed, lambda history: trajectory(scene, history, needed))
    solving = SolverRun(scene, recorder, progress)
    counts = solving.go()
    return Outcome(
        trajectory=trajectory(scene, recorder.history(), needed),
        onsets={name: tuple(pin.onsets) for name, pin in scene.clearance_joints.items()},
        largest_force={name: pin.largest_force for name, pin in scene.clearance_joints.items()},
        largest_force_time={name: pin.largest_force_time for name, pin in scene.clearance_joints.items()},
        impulses=tuple(solving.impulses),
        counts=counts,
        oil_events=scene.legs.events,
        statistics=recorder.finished(),
    )


def _outcome_in_space(scene: SpatialScene, progress: Progress) -> Outcome:
    """Run a model in space. Raises SimulationError if it cannot be finished."""
    recorder = Recorder(scene, needs(scene.scenario), lambda history: SpatialObservation(scene, history))
    solving = SolverRun(scene, recorder, progress)
    counts = solving.go()
    groups = scene.sections.items()
    edges = {
        f"{name}.{side}": group[n] for name, group in groups for side, n in EDGES.items() if len(group) > 1
    }
    single: dict[str, ContactConnector] = {
        **edges,
        **{name: face.contact for name, face in scene.faces.items()},
    }
    return Outcome(
        trajectory=SpatialObservation(scene, recorder.history()),
        onsets={name: tuple(group[0].whole.onsets) for name, group in groups}
        | {name: tuple(pin.onsets) for name, pin in single.items()},
        largest_force={name: group[0].whole.largest_force for name, group in groups}
        | {name: pin.largest_force for name, pin in single.items()},
        largest_force_time={name: group[0].whole.largest_force_time for name, group in groups}
        | {name: pin.largest_force_time for name, pin in single.items()},
        impulses=tuple(solving.impulses),
        counts=counts,
        oil_events=scene.legs.events,
        statistics=recorder.finished(),
    )


def trajectory(scene: Scene, history: History, needed: DataNeeds) -> Trajectory:
    """What the records say, in the order of the linkage; what is not needed is left out."""
    order = np.concatenate([np.arange(item.first, item.first + 3) for item in scene.bodies.values()])

    def ordered(series: Series, part: DataNeeds) -> Series:
        return series[:, order] if part in needed else series

    position, velocity = (
        ordered(history.position, DataNeeds.POSITION),
        ordered(history.velocity, DataNeeds.VELOCITY),
    )
    motion = BodyMotion(scene.linkage, position, velocity, np.zeros_like(velocity))
    legs: dict[str, LegSeries] = {}
    if scene.legs.names and DataNeeds.OIL in needed:
        lengths = {name: motion.lengthening(scene.linkage.actuators[name]) for name in scene.legs.names}
        legs = scene.legs.series(history.time, lengths, history.legs)
    compliant_actuators = {name: one.force for name, one in legs.items() if name in scene.linkage.actuators}
    contacts = {
        name: scene.places[name].series(motion, history.memory[:, n])
        for n, name in enumerate(scene.clearance_joints)
        if DataNeeds.CONTACTS in needed
    }
    loads = {
        name: load_series(load, name, motion, history.time)
        for name, load in scene.scenario.elements.items()
        if DataNeeds.LOADS in needed
    }
    found = Following(velocity[:, :0], JointForces(), {}, {})
    if needed & FOLLOWING:
        applied = Applied(contacts, compliant_actuators, loads)
        found = following(scene, motion, history.time, applied, history.deflection)
    return Trajectory(
        time=history.time,
        position=position,
        velocity=velocity,
        acceleration=found.acceleration,
        ideal_pins=found.joints.pins,
        contacts=contacts,
        **friction_series(scene.scenario, found.frictions),
        actuators={**found.actuators, **compliant_actuators},
        cranks=found.joints.cranks,
        slides=found.joints.slides,
        gears=found.joints.gears,
        oil_energy=sum((one.energy for one in legs.values()), np.zeros_like(history.time)),
        work=history.work,
        damping_loss=history.damping_loss,
        friction_loss=history.friction_loss,
        loads=loads,
        legs=legs,
    )
