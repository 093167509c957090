"""What follows at the records of a Exudyn run from its motion: accelerations, and forces of what is held."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from support_exudyn.formulations.exudyn.scene.scene import Scene
from support_exudyn.mechanics.acting_loads import add_load
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.channels import MOTION, DataNeeds
from support_exudyn.mechanics.drive_acceleration import accelerations_of
from support_exudyn.mechanics.reactions import HeldJoints, direction, equations, push, weight_of
from support_exudyn.mechanics.trajectory import ContactSeries, LoadSeries, Series

FOLLOWING = DataNeeds.ACCELERATION | DataNeeds.JOINTS
APPLIED = DataNeeds.CONTACTS | DataNeeds.OIL | DataNeeds.LOADS
# Friction of a joint depends on its force, and that on friction, by its coefficient times radius over lever.
FRICTION_ROUNDS, SETTLED = 30, 1e-13


def with_causes(needed: DataNeeds) -> DataNeeds:
    """What has to be known for parts of a trajectory: also what accelerations and reactions follow from."""
    return needed | MOTION | APPLIED if needed & FOLLOWING else needed


@dataclass(frozen=True)
class Applied:
    """Forces that follow from the motion by themselves, by the names of what gives them.

    contacts: of clearance pins. actuators: that push their ends apart (n,) [N]. loads: as their
    actions give them.
    """

    contacts: Mapping[str, ContactSeries]
    actuators: Mapping[str, Series]
    loads: Mapping[str, LoadSeries]


@dataclass
class JointForces:
    """Forces of joints at all records, in the units of `Trajectory`.

    pins: of the first body on the second (n, 2). cranks (n,). slides: magnitudes of force and moment (n, 2).
    gears: moment on the second body (n,).
    """

    pins: dict[str, Series] = field(default_factory=dict)
    cranks: dict[str, Series] = field(default_factory=dict)
    slides: dict[str, Series] = field(default_factory=dict)
    gears: dict[str, Series] = field(default_factory=dict)


@dataclass(frozen=True)
class Following:
    """Accelerations (n, 3 b), forces of joints, of rigid actuators (n,) and of friction (n,), "pins.NAME"."""

    acceleration: Series
    joints: JointForces
    actuators: Mapping[str, Series]
    frictions: Mapping[str, Series]


def following(
    scene: Scene, motion: BodyMotion, time: Series, applied: Applied, deflections: Series
) -> Following:
    """Accelerations and reactions at the records [s], from positions, velocities and friction states (n, f)."""
    scenario, linkage = scene.scenario, scene.linkage
    held = HeldJoints(
        [linkage.pins[name] for name in scene.ideal_pins],
        [linkage.actuators[name] for name in scene.rigid_actuators],
        [linkage.cranks[name] for name in scene.cranks],
        [linkage.slides[name] for name in scene.slides],
        [linkage.gears[name] for name in scene.gears],
    )
    drives = [scenario.drive_of(name) for name in (*scene.rigid_actuators, *scene.cranks)]
    driven = accelerations_of(drives, time, scenario.duration)
    all_bodies = equations(motion, held, np.array(driven).reshape(-1, len(time)).T)
    forces = _applied_forces(scene, motion, applied)
    acceleration, reactions = all_bodies.solve(forces)
    rows = {("pins", name): slice(2 * n, 2 * n + 2) for n, name in enumerate(scene.ideal_pins)}
    rows |= {("slides", name): rows for name, rows in zip(scene.slides, held.guided, strict=True)}
    frictions: dict[str, Series] = {}
    for _ in range(FRICTION_ROUNDS if scene.frictions else 0):
        last, rubbed = reactions, forces.copy()
        for (name, item), deflection in zip(scene.frictions.items(), deflections.T, strict=True):
            carried = reactions[:, rows[item.joint.owner]]
            frictions[name] = item.joint.forces(motion, carried, deflection)
            item.joint.apply(rubbed, motion, carried, frictions[name])
        acceleration, reactions = all_bodies.solve(rubbed)
        if np.abs(reactions - last).max() <= SETTLED * np.abs(reactions).max():
            break
    joints = JointForces(
        # rows of pins are second minus first, so that what holds them acts on the second reversed
        pins={name: -reactions[:, 2 * n : 2 * n + 2] for n, name in enumerate(scene.ideal_pins)},
        slides={
            name: _force_and_moment(reactions[:, rows])
            for name, rows in zip(scene.slides, held.guided, strict=True)
        },
        # what holds the second body turns it against its row
        gears=dict(zip(scene.gears, -reactions[:, held.geared].T, strict=True)),
    )
    pushed = dict(zip((*scene.rigid_actuators, *scene.cranks), -reactions[:, held.driven].T, strict=True))
    joints.cranks |= {name: pushed.pop(name) for name in scene.cranks}
    return Following(acceleration, joints, pushed, frictions)


def _force_and_moment(multipliers: Series) -> Series:
    """Sizes of a guide's force across and of its moment (n, 2), which is 0 where the body may turn."""
    found = np.zeros((len(multipliers), 2))
    found[:, : multipliers.shape[1]] = np.abs(multipliers)
    return found


def _applied_forces(scene: Scene, motion: BodyMotion, applied: Applied) -> Series:
    """Forces on all coordinates (n, 3 b) but those of friction in ideal joints."""
    scenario, linkage = scene.scenario, scene.linkage
    forces = weight_of(motion, scenario.gravity)
    for name, contact in applied.contacts.items():
        first, second, known = scenario.contact_places[name].push(motion, contact)
        push(forces, motion, second, known.force, known.point)
        push(forces, motion, first, -known.force, known.point)
    for name, force in applied.actuators.items():
        actuator = linkage.actuators[name]
        apart = force[:, None] * direction(motion, actuator)
        push(forces, motion, actuator.head, apart, motion.place(actuator.head, actuator.head_point))
        push(forces, motion, actuator.foot, -apart, motion.place(actuator.foot, actuator.foot_point))
    for name, loaded in applied.loads.items():
        add_load(forces, motion, name, scenario.elements[name], loaded)
    return forces
