"""A run in the engine at its records, in the plane and in space: motion, contacts, accelerations, joint forces.

Accelerations and joint forces follow from the motion, see `mechanics.reactions`.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from support_exudyn.formulations.exudyn.scene.engine_scene import EngineScene
from support_exudyn.formulations.exudyn.solver.recorder import History
from support_exudyn.mechanics.acting_loads import add_load, load_series
from support_exudyn.mechanics.body_motion import cross
from support_exudyn.mechanics.channels import FOLLOWING, DataNeeds
from support_exudyn.mechanics.constraints import joints_held
from support_exudyn.mechanics.joint_friction import friction_series
from support_exudyn.mechanics.kinetics import weight_of
from support_exudyn.mechanics.observed_run import Trajectory
from support_exudyn.mechanics.reactions import (
    accelerations_of,
    bearing_load,
    equations,
    joint_forces,
    push,
    push_apart,
)
from support_exudyn.mechanics.trajectory import ContactSeries, LegSeries, LoadSeries, Series
from support_exudyn.model.linkage import Linkage

# Friction of a joint depends on its force, and that on friction, by its coefficient times radius over lever.
FRICTION_ROUNDS, SETTLED = 30, 1e-13
Sections = Mapping[str, Sequence[ContactSeries]]


def trajectory(scene: EngineScene, history: History, needed: DataNeeds) -> Trajectory:
    """What the records say; what is not needed is left out."""
    scenario, linkage, time = scene.scenario, scene.linkage, history.time
    motion: Any = scene.motion(history.position, history.velocity)
    legs: dict[str, LegSeries] = {}
    if scene.legs.names and DataNeeds.OIL in needed:
        lengths = {name: motion.lengthening(linkage.actuators[name]) for name in scene.legs.names}
        legs = scene.legs.series(time, lengths, history.legs)
    actuators = {name: one.force for name, one in legs.items() if name in linkage.actuators}
    memories = iter(np.moveaxis(history.memory, 1, 0))
    sections = {
        name: [place.series(motion, memory) for place, memory in zip(contact.places, memories, strict=False)]
        for name, contact in (scene.contacts.items() if DataNeeds.CONTACTS in needed else ())
    }
    acting = scenario.elements.items() if DataNeeds.LOADS in needed else ()
    loads = {name: load_series(load, name, motion, time) for name, load in acting}
    acceleration, multipliers = history.velocity[:, :0], np.zeros((len(time), 0))
    frictions: dict[str, Series] = {}
    held: dict[str, Any] = {"actuators": actuators}
    if needed & FOLLOWING:
        applied = applied_forces(scene, motion, sections, actuators, loads)
        acceleration, multipliers, frictions = following(scene, motion, time, applied, history.deflection)
        held = _held(scene, motion, sections, multipliers)
        held["actuators"] = {**held["actuators"], **actuators}
    return Trajectory(
        linkage=linkage,
        gravity=scene.gravity,
        time=time,
        motion=motion,
        acceleration=acceleration,
        sections=sections,
        **held,
        **friction_series(scenario.friction_joints, frictions),
        work=history.work,
        damping_loss=history.damping_loss,
        friction_loss=history.friction_loss,
        loads=loads,
        legs=legs,
    )


def following(
    scene: EngineScene, motion: Any, time: Series, forces: Series, deflections: Series
) -> tuple[Series, Series, dict[str, Series]]:
    """Accelerations (n, freedoms), multipliers of all that is held (n, rows), friction (n,) [N] by "pins.NAME".

    Arguments:
        time: of the records (n,) [s].
        forces: applied to all coordinates (n, freedoms), see `applied_forces`.
        deflections: states of the friction laws of ideal joints (n, f).
    """
    scenario, held = scene.scenario, scene.held
    drives = [scenario.drive_of(row.name) for row in held if row.part in ("actuators", "cranks")]
    driven = np.array(accelerations_of(drives, time, scenario.duration)).reshape(-1, len(time)).T
    all_bodies = equations(motion, held, driven)
    acceleration, multipliers = all_bodies.solve(forces)
    frictions: dict[str, Series] = {}
    rows = joints_held(held) if scene.frictions else {}
    for _ in range(FRICTION_ROUNDS if scene.frictions else 0):
        last, rubbed = multipliers, forces.copy()
        for (name, item), deflection in zip(scene.frictions.items(), deflections.T, strict=True):
            carried = multipliers[:, rows[item.joint.owner]]
            frictions[name] = item.joint.forces(motion, carried, deflection)
            item.joint.apply(rubbed, motion, carried, frictions[name])
        acceleration, multipliers = all_bodies.solve(rubbed)
        if np.abs(multipliers - last).max() <= SETTLED * np.abs(multipliers).max():
            break
    return acceleration, multipliers, frictions


def applied_forces(
    scene: EngineScene,
    motion: Any,
    sections: Sections,
    actuators: Mapping[str, Series],
    loads: Mapping[str, LoadSeries],
) -> Series:
    """Forces on all coordinates (n, freedoms) but those of friction in ideal joints.

    Arguments:
        motion: of all bodies.
        sections: of all contacts. actuators: on oil, that push their ends apart (n,) [N]. loads: as their
            actions give them. All by name.
    """
    forces = weight_of(motion, scene.gravity)
    for name, contacts in sections.items():
        for place, contact in zip(scene.contacts[name].places, contacts, strict=True):
            force, point = place.push(motion, contact)
            push(forces, motion, place.journal, force, point)
            push(forces, motion, place.bore, -force, point)
    for name, apart in actuators.items():
        push_apart(forces, motion, scene.linkage.actuators[name], apart)
    for name, loaded in loads.items():
        add_load(forces, motion, name, scene.scenario.elements[name], loaded)
    return forces


def _held(scene: EngineScene, motion: Any, sections: Sections, multipliers: Series) -> dict[str, Any]:
    """Forces of all joints as fields of a `Trajectory`, from the multipliers of all that is held (n, rows)."""
    linkage, held = scene.linkage, scene.held
    if isinstance(linkage, Linkage):
        return {**joint_forces(held, multipliers)}
    found: dict[str, Any] = {"pins": {}, "pin_moments": {}, "slides": {}, "actuators": {}}
    for row, force in zip(held, multipliers.T, strict=True):
        if row.part == "actuators":
            found["actuators"][row.name] = -force
    for name, bearing in linkage.bearings.items():
        force, moment = bearing_load(motion, held, multipliers, name)
        middle = motion.place(bearing.second, bearing.second_point)
        places = scene.contacts[name].places if name in sections else ()
        for place, contact in zip(places, sections.get(name, ()), strict=True):
            pushed, point = place.push(motion, contact)
            pushed = pushed if place.journal == bearing.second else -pushed
            force, moment = force + pushed, moment + cross(point - middle, pushed)
        found["pins"][name], found["pin_moments"][name] = force, moment
        found["slides"][name] = np.array([np.linalg.norm(load, axis=1) for load in (force, moment)]).T
    return found
