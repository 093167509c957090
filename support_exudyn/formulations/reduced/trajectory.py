"""From the records of a run to a Trajectory, for all of them at once."""

from __future__ import annotations

import numpy as np

from support_exudyn.formulations.compiled import on_arrays
from support_exudyn.formulations.reduced import layout
from support_exudyn.formulations.reduced.drive import Drive, Matrix, Vector
from support_exudyn.formulations.reduced.equations import law_at
from support_exudyn.formulations.reduced.free_motion import accelerations
from support_exudyn.formulations.reduced.models import Model
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.channels import Part
from support_exudyn.mechanics.contact_history import RelativeMotion, acting, journal_arm, series
from support_exudyn.mechanics.contact_state import PinMemory
from support_exudyn.mechanics.joint_forces import JointForces, PinForce, open_joint_forces
from support_exudyn.mechanics.trajectory import ContactSeries, Trajectory
from support_exudyn.model.pins import ClearancePin
from support_exudyn.scenario.recorded_channels import needs
from support_exudyn.scenario.scenario import Scenario

_law_at, _accelerations = on_arrays(law_at), on_arrays(accelerations)


def trajectory(scenario: Scenario, model: Model, p: list[float], rows: Matrix) -> Trajectory:
    """The run at its records; forces of joints only if a channel needs them.

    Arguments:
        p: parameters.
        rows: of the records, see `layout`.
    """
    linkage = scenario.linkage
    pin = scenario.clearance_pins.get(model.PIN)
    contact = free = None
    if pin is not None:
        contact, free = _contact(p, pin, rows)
    bodies = model.bodies(scenario.machine, linkage, p, rows, free)
    # turns are from the machine's own start posture, in which no journal is out of the middle
    own = scenario.machine.linkage().bodies
    turned = [body.angle - own[name].angle for name, body in linkage.bodies.items()]
    if any(turned):
        bodies.position[:, 2::3] -= turned
    motion = BodyMotion(linkage, bodies.position, bodies.velocity, bodies.acceleration)
    joints = JointForces()
    if Part.JOINTS in needs(scenario):
        if pin is not None and contact is not None:
            known = acting(motion, linkage.pins[model.PIN], pin, contact)
        else:
            assert bodies.pin_force is not None
            known = PinForce(np.column_stack(bodies.pin_force), _place(motion, model.PIN))
        joints = open_joint_forces(motion, scenario.gravity, bodies.columns, {model.PIN: known})
    losses = rows[layout.STATE_ROW + layout.DAMPING_LOSS : layout.STATE_ROW + layout.WORK]
    return Trajectory(
        time=rows[layout.TIME],
        position=motion.position,
        velocity=motion.velocity,
        acceleration=motion.acceleration,
        ideal_pins={name: force for name, force in joints.pins.items() if name not in scenario.clearance_pins},
        contacts={model.PIN: contact} if contact else {},
        columns=bodies.columns,
        cranks=joints.cranks,
        slides=joints.slides,
        oil_energy=np.zeros(rows.shape[1]),
        work=rows[layout.STATE_ROW + layout.WORK],
        damping_loss=losses[0],
        friction_loss=losses[1],
    )


def _contact(p: list[float], pin: ClearancePin, rows: Matrix) -> tuple[ContactSeries, Matrix]:
    """The contact, and accelerations of the free coordinates with the force of the bore on the journal."""
    state = rows[layout.STATE_ROW : layout.STATE_ROW + layout.STATES]
    drive = Drive(*rows[layout.EXTENSION : layout.ACCELERATION + 1])
    at, law = _law_at(p, drive, state, 1.0)
    count = rows.shape[1]
    moving = RelativeMotion(*(np.broadcast_to(getattr(at, name), (count,)) for name in RelativeMotion._fields))
    found = series(pin, moving, _memories(rows))
    contact = np.zeros((layout.CONTACT, count))
    contact[layout.FORCE_X], contact[layout.FORCE_Y] = found.force_x, found.force_y
    contact[layout.FRICTION] = found.friction_force
    contact[layout.JOURNAL_ARM] = journal_arm(pin, found.depth)
    contact[layout.OFFSET_X], contact[layout.OFFSET_Y] = moving.x, moving.y
    first, second = _accelerations(at, law, contact)
    return found, np.array([first, second, found.force_x, found.force_y])


def _memories(rows: Matrix) -> Vector:
    """The pin's memory as PinMemory's fields, shape (n, 9)."""
    memory = rows[layout.MEMORY_ROW : layout.MEMORY_ROW + layout.MEMORY]
    still = np.zeros(rows.shape[1])
    named = {
        "in_contact": memory[layout.TOUCHING],
        "approach_speed": memory[layout.TOUCH_SPEED],
        "mobility_xx": memory[layout.MOBILITY_XX],
        "mobility_xy": memory[layout.MOBILITY_XY],
        "mobility_yy": memory[layout.MOBILITY_YY],
    }
    return np.column_stack([named.get(name, still) for name in PinMemory._fields])


def _place(motion: BodyMotion, name: str) -> Vector:
    """Where an ideal pin is."""
    place = motion.linkage.pins[name]
    return motion.point(place.second, place.second_point).position
