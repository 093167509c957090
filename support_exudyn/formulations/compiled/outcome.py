"""What a finished run says: motion and forces at the records."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from support_exudyn.mechanics.acting_loads import load_series
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.channels import DataNeeds
from support_exudyn.mechanics.joint_friction import friction_series
from support_exudyn.mechanics.observed_run import Trajectory
from support_exudyn.mechanics.reactions import joint_forces
from support_exudyn.mechanics.trajectory import ContactSeries, OilEvent, Series
from support_exudyn.scene.arrays import CONTACT_NUMBERS, CONTACT_PARTS, LOSSES, Matrix
from support_exudyn.scene.hydraulics.series import leg_series
from support_exudyn.scene.setup import Model
from user_forces.contact import Contact


def record_sizes(model: Model) -> list[int]:
    """How many numbers a record has, see `recording.write_record`, by its parts."""
    scene = model.scene
    contacts, courses = CONTACT_NUMBERS * scene.contacts.size, 2 * scene.courses.size
    return [1, model.states, 3 * scene.bodies.size, scene.rows.size, contacts, courses, scene.rubbing.size]


class _Records:
    """The parts of all records, shape (n, ...)."""

    def __init__(self, model: Model, rows: Matrix) -> None:
        scene, count = model.scene, 3 * model.scene.bodies.size
        parts = np.split(rows, np.cumsum(record_sizes(model))[:-1], axis=1)
        self.time = rows[:, 0].copy()
        self.state, self.acceleration, self._held, contacts, courses, self.friction = parts[1:]
        self.position, self.velocity = self.state[:, :count], self.state[:, count : 2 * count]
        self._order = model.order
        self.contacts = contacts.reshape(len(rows), scene.contacts.size, CONTACT_NUMBERS)
        self.courses = courses.reshape(len(rows), scene.courses.size, 2)

    @property
    def held(self) -> Matrix:
        """What joints carry, as the linkage has them."""
        return self._held[:, self._order]


def trajectory(
    model: Model, rows: Matrix, oil_events: Mapping[str, tuple[OilEvent, ...]], needed: DataNeeds
) -> Trajectory:
    """The run at its records, as far as it is needed."""
    scenario, linkage, found = model.scenario, model.scenario.linkage, _Records(model, rows)
    motion = BodyMotion(linkage, found.position, found.velocity)
    still = np.zeros_like(found.time)
    course = {name: n for n, name in enumerate((*model.drives, *model.valves))}

    def driven(name: str, which: int) -> Series:
        return found.courses[:, course[name], which] if name in course else still

    legs = leg_series(model.legs, found.time, _told(model, motion, driven), found.state, oil_events)
    joined = DataNeeds.JOINTS in needed
    held = joint_forces(scenario.held.kinetics.constraints, found.held) if joined else {}
    actuators = {name: one.force for name, one in legs.items() if name in linkage.actuators}
    sections = {
        name: [_contact(model, found, n, place.contact)]
        for n, (name, place) in enumerate(scenario.contact_places.items())
        if DataNeeds.CONTACTS in needed
    }
    loads = {
        name: load_series(load, name, motion, found.time)
        for name, load in scenario.elements.items()
        if DataNeeds.LOADS in needed
    }
    losses, joints = found.state[:, -LOSSES:], scenario.friction_joints
    return Trajectory(
        linkage=linkage,
        gravity=scenario.gravity,
        time=found.time,
        motion=motion,
        acceleration=found.acceleration,
        sections=sections,
        **friction_series(joints, dict(zip(joints, found.friction.T, strict=True))),
        **{**held, "actuators": {**held.get("actuators", {}), **actuators}},
        work=losses[:, 2],
        damping_loss=losses[:, 0],
        friction_loss=losses[:, 1],
        loads=loads,
        legs=legs,
    )


def _told(
    model: Model, motion: BodyMotion, driven: Callable[[str, int], Series]
) -> dict[str, dict[str, Series]]:
    """What the records of legs are told at the records of the run."""
    found = {}
    for record, name in zip(model.legs.records, model.legs.names, strict=True):
        length, rate = motion.lengthening(model.scenario.linkage.actuators[name])
        value, speed = driven(name, 0), driven(name, 1)
        still = np.zeros_like(value)
        by_drive = bool(record["driven"])
        found[name] = {
            "length": length,
            "rate": rate,
            "inflow": value if by_drive else still,
            "inflow_rate": speed if by_drive else still,
            "opening": still if by_drive else value,
        }
    return found


def _contact(model: Model, found: _Records, n: int, contact: Contact) -> ContactSeries:
    """A contact at the records, as it stood in the scene."""
    state = int(model.scene.contacts[n]["state"])
    deflection = found.state[:, state] if state >= 0 else None
    parts = dict(zip(CONTACT_PARTS, np.ascontiguousarray(found.contacts[:, n].T), strict=True))
    return ContactSeries(contact, **parts, deflection=deflection)
