"""A run in space at its records: motion, contacts, reactions, energies, each computed when it is asked for."""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from support_exudyn.formulations.exudyn.solver.recorder import History
from support_exudyn.formulations.exudyn.space.block_face import BlockFace
from support_exudyn.formulations.exudyn.space.scene import SpatialScene
from support_exudyn.formulations.exudyn.space.section_pin import SectionPin
from support_exudyn.formulations.exudyn.space.sections import SectionMotion, section_motion
from support_exudyn.mechanics.acting_loads import add_load, load_series
from support_exudyn.mechanics.contact_history import RelativeMotion, journal_arm, series
from support_exudyn.mechanics.drive_acceleration import accelerations_of
from support_exudyn.mechanics.space.accelerations import accelerations
from support_exudyn.mechanics.space.constraints import TURNS, Constraint, direction_of
from support_exudyn.mechanics.space.kinetics import inertias, weight
from support_exudyn.mechanics.space.motion import SpatialMotion, cross, motion_of
from support_exudyn.mechanics.space.reactions import inertia_forces, reactions
from support_exudyn.mechanics.trajectory import ContactSeries, LegSeries, LoadSeries, Series
from support_exudyn.model.linkage import GROUND
from user_forces.friction.laws import Frictionless


@dataclass(frozen=True)
class SectionSeries:
    """A section of a clearance bearing over time.

    motion: of its journal. contact: depths and forces in the axes of the bore. force: of the bore on the
    journal (n, 3) [N], ground's axes. point: where it acts (n, 3) [m].
    """

    motion: SectionMotion
    contact: ContactSeries
    force: Series
    point: Series

    @property
    def eccentricity(self) -> tuple[Series, Series]:
        """The journal's centre from the bore's, along both axes across (n,) [m]."""
        return self.motion.x, self.motion.y


@dataclass(frozen=True)
class SpatialObservation:
    """A finished run.

    Arguments:
        scene: that has been run.
        history: its records.
    """

    scene: SpatialScene
    history: History

    @property
    def time(self) -> Series:
        """The time of the records [s]."""
        return self.history.time

    @cached_property
    def motion(self) -> SpatialMotion:
        """The motion of all bodies; velocities are zero if they have not been kept."""
        order, history = self.scene.order, self.history
        position = history.position[:, order]
        velocity = history.velocity[:, order] if history.velocity.shape[1] else np.zeros_like(position)
        return motion_of(self.scene.linkage, position, velocity)

    @cached_property
    def sections(self) -> dict[str, list[SectionSeries]]:
        """The sections of every clearance bearing."""
        memories = iter(np.moveaxis(self.history.memory, 1, 0))
        return {
            name: [self._section(pin, memory) for pin, memory in zip(group, memories, strict=False)]
            for name, group in self.scene.sections.items()
        }

    @cached_property
    def faces(self) -> dict[str, ContactSeries]:
        """The contacts of all falling blocks; forces on the machine, in the ground's axes."""
        first = sum(map(len, self.scene.sections.values()))
        memories = np.moveaxis(self.history.memory, 1, 0)[first:]
        return {
            name: self._face(face, memory)
            for (name, face), memory in zip(self.scene.faces.items(), memories, strict=False)
        }

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

    def contacts_of(self, pin: str) -> list[ContactSeries]:
        """The contacts of all sections of the bearings that make up a clearance pin."""
        bearings = self.scene.linkage.bearings
        groups = [group for name, group in self.sections.items() if bearings[name].pin == pin]
        return [section.contact for group in groups for section in group]

    def _section(self, pin: SectionPin, memory: Series) -> SectionSeries:
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
        return SectionSeries(moving, contact, force, moving.centre + arm[:, None] * outward)

    @cached_property
    def acting(self) -> dict[str, LoadSeries]:
        """What acts on the machine besides its weight, by name."""
        acting = self.scene.scenario.elements.items()
        return {name: load_series(load, name, self.motion, self.time) for name, load in acting}

    @cached_property
    def legs(self) -> dict[str, LegSeries]:
        """Every hydraulic leg over time, and the pump; none if their states are not recorded."""
        legs = self.scene.legs
        if self.history.legs.shape[1] < legs.states_count:
            return {}
        motion = {}
        for name in legs.names:
            apart, relative = self.span(name)
            length = np.linalg.norm(apart, axis=1)
            motion[name] = length, np.einsum("ni,ni->n", apart, relative) / length
        return legs.series(self.time, motion, self.history.legs)

    @property
    def oil(self) -> dict[str, LegSeries]:
        """Every actuator on oil over time."""
        return {name: self.legs[name] for name in self.scene.legs.names if name in self.legs}

    def span(self, actuator: str) -> tuple[Series, Series]:
        """The vector from foot to head of an actuator, and its rate, (n, 3) each."""
        strut = self.scene.linkage.actuators[actuator]
        foot = self.motion.point(strut.foot, strut.foot_point)
        head = self.motion.point(strut.head, strut.head_point)
        return head.position - foot.position, head.velocity - foot.velocity

    @cached_property
    def accelerations(self) -> Series:
        """Accelerations of centres and rates of spins of all bodies, (n, b, 6) [m/s^2], [rad/s^2]."""
        scenario = self.scene.scenario
        driven = np.zeros((self.motion.count, len(self.scene.rows)))
        places = [n for n, row in enumerate(self.scene.rows) if row.kind == "actuator"]
        drives = [scenario.drive_of(self.scene.rows[n].name) for n in places]
        for place, rates in zip(places, accelerations_of(drives, self.time, scenario.duration), strict=True):
            driven[:, place] = rates
        turning = inertia_forces(self.motion, np.zeros_like(self._applied))
        return accelerations(self.motion, self.scene.rows, driven, self._applied - turning)

    @cached_property
    def held(self) -> dict[Constraint, Series]:
        """Force of everything that is held, (n,) each; see `reactions`."""
        left = inertia_forces(self.motion, self.accelerations) - self._applied
        rows = self.scene.all_rows
        return dict(zip(rows, reactions(self.motion, rows, left).T, strict=True))

    @cached_property
    def _applied(self) -> Series:
        """Weights and forces of oil, clearance bearings and loads on all bodies, (n, b, 6)."""
        weights = weight(self.scene.linkage, self.scene.gravity).reshape(1, -1, 6)
        forces = np.tile(weights, (self.motion.count, 1, 1))
        for name, oil in self.oil.items():
            actuator = self.scene.linkage.actuators[name]
            along, _ = self.span(name)
            push = oil.force[:, None] * along / np.linalg.norm(along, axis=1)[:, None]
            self._push(
                forces, actuator.head, push, self.motion.point(actuator.head, actuator.head_point).position
            )
            self._push(
                forces, actuator.foot, -push, self.motion.point(actuator.foot, actuator.foot_point).position
            )
        for name, group in self.sections.items():
            bore, journal = self.scene.ends_of(name)
            for section in group:
                self._push(forces, journal.body, section.force, section.point)
                self._push(forces, bore.body, -section.force, section.point)
        for name, contact in self.faces.items():
            push = np.column_stack([contact.force_x, contact.force_y, np.zeros(self.motion.count)])
            (block, *_), (body, place, _) = self.scene.faces[name].ends
            point = self.motion.point(body, place).position
            self._push(forces, body, push, point)
            self._push(forces, block, -push, point)
        for name, load in self.scene.scenario.elements.items():
            add_load(forces, self.motion, name, load, self.acting[name])
        return forces

    def _push(self, forces: Series, body: str, force: Series, point: Series) -> None:
        """Add a force on a body (n, 3) at points (n, 3) to the forces on all bodies."""
        if body == GROUND:
            return
        n = self.motion.index(body)
        centre = np.array(self.scene.linkage.bodies[body].centre) + self.motion.displacement[:, n]
        forces[:, n, :3] += force
        forces[:, n, 3:] += cross(point - centre, force)

    def actuator_force(self, name: str) -> Series:
        """Force that pushes an actuator's ends apart (n,) [N]."""
        return self.legs[name].force if name in self.legs else self.held[Constraint(name, "actuator")]

    def bearing_load(self, name: str) -> tuple[Series, Series]:
        """Force of the first body on the second [N], moment about the bearing's middle [N m], (n, 3) each."""
        bearing = self.scene.linkage.bearings[name]
        force, moment = np.zeros((2, self.motion.count, 3))
        middle = self.motion.point(bearing.second, bearing.second_point).position
        for row, value in self.held.items() if self._is_held(name) else ():
            if row.name == name:
                part = moment if row.kind in TURNS else force
                part += value[:, None] * direction_of(self.motion, bearing, row.kind)
        sign = 1.0 if name in self.sections and self.scene.ends_of(name)[1].body == bearing.second else -1.0
        for section in self.sections.get(name, ()):
            force += sign * section.force
            moment += cross(section.point - middle, sign * section.force)
        return force, moment

    def _is_held(self, name: str) -> bool:
        return any(row.name == name for row in self.scene.all_rows)

    @cached_property
    def loads(self) -> dict[str, tuple[Series, Series]]:
        """Force and moment in every bearing, see `bearing_load`."""
        return {name: self.bearing_load(name) for name in self.scene.linkage.bearings}

    # --- energy ---

    @cached_property
    def kinetic(self) -> Series:
        """Kinetic energy [J]."""
        motion = self.motion
        mass = np.array([body.mass for body in motion.linkage.bodies.values()])
        spinning = np.einsum("nbi,nbij,nbj->n", motion.spin, inertias(motion), motion.spin)
        return np.asarray(0.5 * (np.einsum("b,nbi,nbi->n", mass, motion.velocity, motion.velocity) + spinning))

    @cached_property
    def potential(self) -> Series:
        """Potential energy of weight [J], zero in the start posture."""
        forces = weight(self.scene.linkage, self.scene.gravity).reshape(-1, 6)[:, :3]
        return np.asarray(-np.einsum("bi,nbi->n", forces, self.motion.displacement))

    @cached_property
    def stored(self) -> Series:
        """Energy stored in contacts, oil and loads [J]."""
        found = np.zeros_like(self.time)
        for energy in (one.energy for one in self.legs.values()):
            found = found + energy
        for load in self.acting.values():
            found = found + load.stored
        for face in self.faces.values():
            found = found + face.stored
        for group in self.sections.values():
            for section in group:
                found = found + section.contact.stored
        return found

    @property
    def damping_loss(self) -> Series:
        """Energy dissipated by damping so far (n,) [J]."""
        return self.history.damping_loss

    @property
    def friction_loss(self) -> Series:
        """Energy dissipated by friction so far (n,) [J]."""
        return self.history.friction_loss

    @property
    def work(self) -> Series:
        """Work of the drives so far (n,) [J]."""
        return self.history.work

    @cached_property
    def balance(self) -> Series:
        """Gain minus work plus loss (n,) [J]."""
        total = self.kinetic + self.potential + self.stored
        found: Series = total - total[0] + (self.damping_loss + self.friction_loss) - self.work
        return found
