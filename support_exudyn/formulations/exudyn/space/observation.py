"""A run in space at its records: motion, contacts, reactions, energies, each computed when it is asked for."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from support_exudyn.formulations.exudyn.solver.recorder import History
from support_exudyn.formulations.exudyn.space.block_face import BlockFace
from support_exudyn.formulations.exudyn.space.scene import SpatialScene
from support_exudyn.formulations.exudyn.space.section_pin import SectionPin
from support_exudyn.formulations.exudyn.space.sections import section_motion
from support_exudyn.mechanics.acting_loads import add_load, load_series
from support_exudyn.mechanics.body_motion import SpatialMotion, cross
from support_exudyn.mechanics.contact_places import RelativeMotion, journal_arm, series
from support_exudyn.mechanics.drive_acceleration import accelerations_of
from support_exudyn.mechanics.kinetics import weight_of
from support_exudyn.mechanics.observed_run import ObservedRun
from support_exudyn.mechanics.reactions import bearing_load, equations, push, push_apart
from support_exudyn.mechanics.trajectory import ContactSeries, LegSeries, LoadSeries, Series
from user_forces.friction.laws import Frictionless


@dataclass(frozen=True)
class SectionForce:
    """A section of a clearance bearing over time.

    contact: depths and forces in the axes of the bore. force: of the bore on the journal (n, 3) [N], ground's
    axes. point: where it acts (n, 3) [m].
    """

    contact: ContactSeries
    force: Series
    point: Series


class SpatialObservation(ObservedRun):
    """A finished run. scene: that has been run. history: its records."""

    def __init__(self, scene: SpatialScene, history: History) -> None:
        self.scene, self.history = scene, history
        self.gravity, self.time = scene.gravity, history.time
        self.work = history.work
        self.damping_loss, self.friction_loss = history.damping_loss, history.friction_loss

    @cached_property
    def motion(self) -> SpatialMotion:
        """See `ObservedRun`; velocities are zero if they have not been kept."""
        order, history = self.scene.order, self.history
        position = history.position[:, order]
        velocity = history.velocity[:, order] if history.velocity.shape[1] else np.zeros_like(position)
        return SpatialMotion(self.scene.linkage, position, velocity)

    # --- contacts ---

    @cached_property
    def section_forces(self) -> Mapping[str, Sequence[SectionForce]]:
        """The sections of every clearance bearing."""
        memories = iter(np.moveaxis(self.history.memory, 1, 0))
        return {
            name: [self._section(pin, memory) for pin, memory in zip(group, memories, strict=False)]
            for name, group in self.scene.sections.items()
        }

    @cached_property
    def sections(self) -> Mapping[str, Sequence[ContactSeries]]:
        """See `ObservedRun`; of bearings in the axes of the bore, of blocks in the ground's."""
        bearings = {name: [one.contact for one in group] for name, group in self.section_forces.items()}
        memories = np.moveaxis(self.history.memory, 1, 0)[sum(map(len, self.scene.sections.values())) :]
        faces = zip(self.scene.faces.items(), memories, strict=False)
        return {**bearings, **{name: [self._face(face, memory)] for (name, face), memory in faces}}

    def contacts_of(self, place: str) -> Sequence[ContactSeries]:
        """See `ObservedRun`: a pin has the sections of all its bearings."""
        bearings = self.scene.linkage.bearings
        names = [name for name in self.scene.sections if bearings[name].pin == place]
        return [contact for name in names or [place] for contact in self.sections.get(name, ())]

    def _face(self, face: BlockFace, memory: Series) -> ContactSeries:
        (first, reference, _), (second, point, _) = face.ends
        bore, journal = self.motion.point(first, reference), self.motion.point(second, point)
        c, s = math.cos(face.block.slope), math.sin(face.block.slope)
        across, still = np.array([-s, c, 0.0]), np.zeros(self.motion.count)
        y = (journal.position - bore.position) @ across
        rate = (journal.velocity - bore.velocity) @ across
        moving = RelativeMotion(still, y, still, rate, still, still)
        found = series(face.block.contact, moving, memory)
        return replace(found, force_x=-s * found.force_y, force_y=c * found.force_y)

    def _section(self, pin: SectionPin, memory: Series) -> SectionForce:
        bore, journal = pin.ends
        moving = section_motion(self.motion, bore, journal, pin.section.place, pin.item.at, pin.slides)
        relative = RelativeMotion(
            moving.x, moving.y, moving.vx, moving.vy, moving.bore_spin, moving.journal_spin
        )
        contact = series(pin.contact, relative, memory)
        away = np.linalg.norm(moving.displacement, axis=1)
        outward = moving.displacement / np.where(away > 0.0, away, 1.0)[:, None]
        if isinstance(pin.contact.friction, Frictionless):
            force = -contact.normal_force[:, None] * outward
        else:
            plane = np.column_stack([contact.force_x, contact.force_y, np.zeros(self.motion.count)])
            force = np.einsum("nij,nj->ni", moving.axes, plane)
        arm = journal_arm(pin.contact, contact.depth)
        return SectionForce(contact, force, moving.centre + arm[:, None] * outward)

    # --- loads and oil ---

    @cached_property
    def loads(self) -> Mapping[str, LoadSeries]:  # type: ignore[override]
        """See `ObservedRun`."""
        acting = self.scene.scenario.elements.items()
        return {name: load_series(load, name, self.motion, self.time) for name, load in acting}

    @cached_property
    def legs(self) -> Mapping[str, LegSeries]:  # type: ignore[override]
        """See `ObservedRun`; none if their states are not recorded."""
        legs, actuators = self.scene.legs, self.scene.linkage.actuators
        if self.history.legs.shape[1] < legs.states_count:
            return {}
        motion = {name: self.motion.lengthening(actuators[name]) for name in legs.names}
        return legs.series(self.time, motion, self.history.legs)

    # --- accelerations and reactions ---

    @cached_property
    def _solved(self) -> tuple[Series, Series]:
        """Accelerations (n, 6 b) and multipliers of all that is held (n, rows), see `reactions`."""
        scene, scenario = self.scene, self.scene.scenario
        drives = [
            scenario.drive_of(constraint.name) for constraint in scene.all_rows if constraint.kind == "actuator"
        ]
        driven = np.array(accelerations_of(drives, self.time, scenario.duration))
        system = equations(self.motion, scene.all_rows, driven.reshape(-1, len(self.time)).T)
        return system.solve(self._applied)

    @cached_property
    def acceleration(self) -> Series:  # type: ignore[override]
        """See `ObservedRun`."""
        return self._solved[0]

    @cached_property
    def _applied(self) -> Series:
        """Weights and forces of oil, clearance bearings and loads on all coordinates, (n, 6 b)."""
        forces, linkage = weight_of(self.motion, self.gravity), self.scene.linkage
        for name, leg in self.legs.items():
            if name in linkage.actuators:
                push_apart(forces, self.motion, linkage.actuators[name], leg.force)
        for name, group in self.section_forces.items():
            bore, journal = self.scene.ends_of(name)
            for section in group:
                push(forces, self.motion, journal.body, section.force, section.point)
                push(forces, self.motion, bore.body, -section.force, section.point)
        for name, face in self.scene.faces.items():
            (contact,) = self.sections[name]
            force = np.column_stack([contact.force_x, contact.force_y, np.zeros(self.motion.count)])
            (block, *_), (body, place, _) = face.ends
            point = self.motion.place(body, place)
            push(forces, self.motion, body, force, point)
            push(forces, self.motion, block, -force, point)
        for name, load in self.scene.scenario.elements.items():
            add_load(forces, self.motion, name, load, self.loads[name])
        return forces

    def actuator_force(self, name: str) -> Series:
        """See `ObservedRun`."""
        if name in self.legs:
            return self.legs[name].force
        rows = [constraint.kind == "actuator" and constraint.name == name for constraint in self.scene.all_rows]
        return -self._solved[1][:, rows.index(True)]

    @cached_property
    def _bearing_loads(self) -> dict[str, tuple[Series, Series]]:
        return {}

    def bearing_load(self, name: str) -> tuple[Series, Series]:
        """Force of the first body on the second [N], moment about the bearing's middle [N m], (n, 3) each."""
        if name not in self._bearing_loads:
            bearing, sections = self.scene.linkage.bearings[name], self.section_forces.get(name, ())
            force, moment = np.zeros((2, self.motion.count, 3))
            if any(constraint.name == name for constraint in self.scene.all_rows):
                force, moment = bearing_load(self.motion, self.scene.all_rows, self._solved[1], name)
            middle = self.motion.place(bearing.second, bearing.second_point)
            sign = 1.0 if sections and self.scene.ends_of(name)[1].body == bearing.second else -1.0
            for section in sections:
                force += sign * section.force
                moment += cross(section.point - middle, sign * section.force)
            self._bearing_loads[name] = force, moment
        return self._bearing_loads[name]

    def pin_force(self, name: str) -> Series:
        """See `ObservedRun`."""
        return self.bearing_load(name)[0]

    def guide_force(self, name: str) -> Series:
        """See `ObservedRun`."""
        return np.array([np.linalg.norm(load, axis=1) for load in self.bearing_load(name)]).T
