"""What follows at the records of a plane run in the engine from its motion: accelerations, and joint forces."""

from collections.abc import Mapping

import numpy as np

from support_exudyn.formulations.exudyn.scene.scene import Scene
from support_exudyn.mechanics.acting_loads import add_load
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.constraints import joints_held
from support_exudyn.mechanics.drive_acceleration import accelerations_of
from support_exudyn.mechanics.kinetics import weight_of
from support_exudyn.mechanics.reactions import equations, push, push_apart
from support_exudyn.mechanics.trajectory import ContactSeries, LoadSeries, Series

# Friction of a joint depends on its force, and that on friction, by its coefficient times radius over lever.
FRICTION_ROUNDS, SETTLED = 30, 1e-13


def following(
    scene: Scene, motion: BodyMotion, time: Series, forces: Series, deflections: Series
) -> tuple[Series, Series, dict[str, Series]]:
    """Accelerations (n, 3 b), multipliers of all that is held (n, rows), friction (n,) [N] by "pins.NAME".

    Arguments:
        time: of the records (n,) [s].
        forces: applied to all coordinates (n, 3 b), see `applied_forces`.
        deflections: states of the friction laws of ideal joints (n, f).
    """
    scenario, held = scene.scenario, scene.scenario.held.kinetics.constraints
    drives = [scenario.drive_of(name) for name in (*scene.rigid_actuators, *scene.cranks)]
    driven = np.array(accelerations_of(drives, time, scenario.duration)).reshape(-1, len(time)).T
    all_bodies, rows = equations(motion, held, driven), joints_held(held)
    acceleration, multipliers = all_bodies.solve(forces)
    frictions: dict[str, Series] = {}
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
    scene: Scene,
    motion: BodyMotion,
    contacts: Mapping[str, ContactSeries],
    actuators: Mapping[str, Series],
    loads: Mapping[str, LoadSeries],
) -> Series:
    """Forces on all coordinates (n, 3 b) but those of friction in ideal joints.

    Arguments:
        motion: of all bodies.
        contacts: of clearance joints and blocks. actuators: on oil, that push their ends apart (n,) [N]. loads:
            as their actions give them. All by name.
    """
    scenario = scene.scenario
    forces = weight_of(motion, scenario.gravity)
    for name, contact in contacts.items():
        place = scenario.contact_places[name]
        force, point = place.push(motion, contact)
        push(forces, motion, place.journal, force, point)
        push(forces, motion, place.bore, -force, point)
    for name, apart in actuators.items():
        push_apart(forces, motion, scene.linkage.actuators[name], apart)
    for name, loaded in loads.items():
        add_load(forces, motion, name, scenario.elements[name], loaded)
    return forces
