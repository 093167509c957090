"""The model of a scenario in the engine, ready for the solver, in the plane or in space."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import exudyn
import numpy as np

from support_exudyn.formulations.exudyn.scene.driven_parts import DrivenPart
from support_exudyn.formulations.exudyn.scene.engine_legs import EngineLegs
from support_exudyn.formulations.exudyn.scene.joint_builder import BodyItem
from support_exudyn.formulations.exudyn.scene.joint_friction import JointFriction
from support_exudyn.formulations.exudyn.scene.load_item import LoadItem
from support_exudyn.formulations.exudyn.scene.section_pin import SectionPin
from support_exudyn.formulations.exudyn.scene.sections import SectionPlace
from support_exudyn.mechanics.body_motion import (
    COORDINATES,
    UNTURNED,
    BodyMotion,
    Motion,
    SpatialMotion,
    parameter_rates,
)
from support_exudyn.mechanics.closing import repeated_count
from support_exudyn.mechanics.constraints import Constraint, constraints_in_space, constraints_of, turning
from support_exudyn.mechanics.contact_places import ContactPlace, contact_rate
from support_exudyn.mechanics.kinetics import Instant, Matrix, joint_impulses, rates, weight_of
from support_exudyn.mechanics.trajectory import Impulse, Series
from support_exudyn.model.linkage import Linkage
from support_exudyn.model.spatial_linkage import SpatialLinkage
from support_exudyn.scenario.scenario import Scenario
from user_forces.connector.contact_connector import ContactConnector
from user_forces.contact_state import InverseMass

INITIAL = exudyn.ConfigurationType.Initial
CURRENT = exudyn.ConfigurationType.Current
FRICTION_ROUNDS = 4  # each with an error smaller by the coefficient of friction times radius over lever


@dataclass(frozen=True)
class SceneContact:
    """A pin, a corner in a guide, a block's face, or a bearing of several sections.

    middle: the place as a whole. axes: those of the bore in the start posture, in columns (3, 3). share: of the
    pin's contact that is here. places, pins: of the sections; one in the plane.
    """

    middle: ContactPlace | SectionPlace
    axes: Matrix
    share: float
    places: Sequence[ContactPlace | SectionPlace]
    pins: Sequence[ContactConnector]

    @property
    def whole(self) -> Any:
        """What has the onsets and the largest force of all sections together."""
        pin = self.pins[0]
        return pin.whole if isinstance(pin, SectionPin) else pin


@dataclass(frozen=True, repr=False)  # the engine's objects cannot be shown once they are released
class EngineScene:
    """The model of one scenario, assembled and ready for the solver.

    scenario: what is modelled. linkage: its bodies and joints. container: owns the system, and must live as
    long as it. mbs: the system. bodies: all that move. rows: constraints that are in the model. held: those
    and the ones that repeat them; clearance joints and actuators on oil are free. size: length [m] by which
    turns count where constraints repeat each other. contacts: what may make contact and part. frictions: of
    ideal joints, "pins.NAME" and "guides.NAME". loads: what acts by the motion, compliant pins, too. driven:
    rigid actuators and cranks that follow drives. legs: the actuators on oil.
    """

    scenario: Scenario
    linkage: Linkage | SpatialLinkage
    container: Any
    mbs: Any
    bodies: Mapping[str, BodyItem]
    rows: Sequence[Constraint]
    held: Sequence[Constraint]
    size: float
    contacts: dict[str, SceneContact]
    frictions: Mapping[str, JointFriction]
    loads: Mapping[str, LoadItem]
    driven: Sequence[DrivenPart]
    legs: EngineLegs

    @cached_property
    def clearance_joints(self) -> Mapping[str, ContactConnector]:
        """The connectors of all contacts, NAME[n] of the sections of a bearing."""
        return {
            f"{name}[{n}]" if isinstance(pin, SectionPin) else name: pin
            for name, contact in self.contacts.items()
            for n, pin in enumerate(contact.pins)
        }

    @cached_property
    def repeats(self) -> bool:
        """Whether constraints of the model repeat each other; in space those that do are left out."""
        return isinstance(self.linkage, Linkage) and repeated_count(self.scenario.held)[0] > 0

    @property
    def gravity(self) -> Sequence[float]:
        """Acceleration [m/s^2], (2,) or (3,)."""
        gravity = self.scenario.gravity
        return gravity if isinstance(self.linkage, Linkage) else (*gravity, 0.0)

    def release(self) -> None:
        """Let go of the engine's model: what its user functions know would never be freed."""
        mbs: Any = self.mbs
        mbs.SetPreStepUserFunction(0)
        mbs.SetPostNewtonUserFunction(0)
        mbs.SetPostStepUserFunction(0)
        self.container.Reset()

    def drive_to(self, t: float) -> None:
        """Set every actuator, crank and valve to where it is at time t [s]."""
        for part in self.driven:
            part.move_to(t)
        self.legs.follow(t)

    def motion(self, position: Series, velocity: Series) -> Motion:
        """The motion of all bodies from coordinates of the engine and their rates (n, coordinates)."""
        if isinstance(self.linkage, Linkage):
            return BodyMotion(self.linkage, position, velocity)
        return SpatialMotion(self.linkage, position, velocity)

    def instant(self, held: Sequence[Constraint], state: Any = CURRENT) -> Instant:
        """Masses and some constraints in a state of the engine."""
        data = self.mbs.systemData
        motion = self.motion(data.GetODE2Coordinates(state)[None], data.GetODE2Coordinates_t(state)[None])
        return Instant(motion, held, self.size)

    def inverse_mass(self, name: str, state: Any = CURRENT) -> InverseMass:
        """How the middle of a contact's journal answers impulses, in the axes of its bore, for its pin's law.

        A bearing of a pair has a share of its pin's force and energy, so the steps of the pin's law go by the
        mass over that share. Other contacts are open.
        """
        contact, instant = self.contacts[name], self.instant(self.rows, state)
        answers = instant.answers(contact_rate(instant.motion, contact.middle, contact.axes))
        return InverseMass.of(contact.share * answers)

    def set_velocities(self, velocities: Series, state: Any = CURRENT) -> None:
        """Give the bodies velocities, see `Motion.velocities`."""
        data = self.mbs.systemData
        if isinstance(self.linkage, SpatialLinkage):  # from angular velocities to rates of Euler parameters
            position, of_bodies = data.GetODE2Coordinates(state), velocities.reshape(-1, 2, 3)
            velocities = data.GetODE2Coordinates_t(state)
            for item, (v, spin) in zip(self.bodies.values(), of_bodies, strict=True):
                p = position[item.first + 3 : item.first + COORDINATES] + UNTURNED
                velocities[item.first : item.first + 3] = v
                velocities[item.first + 3 : item.first + COORDINATES] = parameter_rates(p, spin)
        data.SetODE2Coordinates_t(velocities, state)

    def start_moving(self) -> None:
        """Give the bodies the velocities that the drives have at the start, with ideal pins."""
        wanted = rates(self.closed, lambda name: self.scenario.drive_of(name).initial_speed)
        if wanted.any():
            closed = self.instant(self.closed, INITIAL)
            before = closed.motion.velocities[0]
            change, _ = closed.respond(np.zeros_like(before), wanted - closed.rows @ before)
            self.set_velocities(before + change, INITIAL)

    def jump(self, time: float) -> Impulse | None:
        """Give the bodies the velocities that belong to drives whose speed has jumped at a break [s].

        With rigid actuators the bodies' velocities jump too, see `kinetics`. Clearance pins and oil columns
        transmit no impulse: their force is finite. None if all that jumps is compliant.
        """
        wanted = rates(self.held, lambda name: self.scenario.drive_of(name).speed_jump(time))
        if not wanted.any():
            return None
        instant = self.instant(self.held)
        before, mass = instant.motion.velocities[0], instant.mass
        change, impulses = instant.respond(np.zeros_like(before), wanted)
        after = before + change
        self.set_velocities(after)
        driven: dict[str, dict[str, float]] = {"actuators": {}, "cranks": {}}
        for constraint, impulse in zip(self.held, (-impulses).tolist(), strict=True):
            if constraint.part in driven:
                driven[constraint.part][constraint.name] = impulse
        energy = float(0.5 * after @ mass @ after - 0.5 * before @ mass @ before)
        joints = joint_impulses(self.held, impulses)
        return Impulse(time, driven["actuators"], energy, driven["cranks"], joints)

    def align(self, time: float) -> float:
        """Give the bodies velocities that the constraints have at a time [s]; work of the drives in it [J].

        Constraints of index 3 hold positions: velocities at the end of a long step are off by second order in
        it. A short step that follows would make up for it within itself, by accelerations a thousand times too
        large.
        """
        wanted = rates(self.held, lambda name: self.scenario.drive_of(name).speed(time))
        instant = self.instant(self.held)
        before = instant.motion.velocities[0]
        change, impulses = instant.respond(np.zeros_like(before), wanted - instant.rows @ before)
        self.set_velocities(before + change)
        return -float(impulses @ wanted)

    @property
    def closed(self) -> Sequence[Constraint]:
        """What would hold the bodies if all pins were ideal and all actuators rigid."""
        if isinstance(self.linkage, Linkage):
            return constraints_of(self.linkage)
        return constraints_in_space(self.linkage, (), self.linkage.actuators)

    def start_rubbing(self) -> None:
        """Let friction of ideal joints know about their forces at the start, if anything moves then.

        The solver's first accelerations follow from forces of friction, which follow from those of the pins:
        without, the first step would be taken with none. Forces of clearance pins and oil are left out of it.
        """
        instant = self.instant(self.held, INITIAL)
        motion: Any = instant.motion
        if not self.frictions or not motion.velocity.any():
            return
        data, wanted = self.mbs.systemData, -turning(motion, self.held)[0]
        owners = [(constraint.part, constraint.name) for constraint in self.held]
        for friction in self.frictions.values():
            friction.start(motion)
        weight = weight_of(motion, self.gravity)
        forces, multipliers = weight, data.GetAECoordinates(INITIAL)
        for _ in range(FRICTION_ROUNDS):
            _, reactions = instant.respond(forces[0], wanted)
            forces = weight.copy()
            for friction in self.frictions.values():
                row = owners.index(friction.joint.owner)
                friction.guess(forces, motion, reactions[row : row + friction.joint.conditions], multipliers)
        data.SetAECoordinates(multipliers, INITIAL)

    def reset_memory(self) -> None:
        """Give every contact the memory that belongs to the initial state of the bodies."""
        for name, contact in self.contacts.items():
            inverse_mass = self.inverse_mass(name, INITIAL)
            for pin in contact.pins:
                pin.start(inverse_mass)

    def refresh_memory(self, rest: float = 0.0) -> None:
        """Tell every contact that velocities have jumped; contacts that go on go on.

        rest: by which positions have moved on with the rates before [s].

        To the engine a section that is tilted is less deep than it is, by tilt^2/24 of its way. With the depth
        that the engine finds a journal that has just landed would be a little before its impact again, and stay
        there.
        """
        for pin in self.clearance_joints.values():
            state, kept = pin.observe(CURRENT), pin.kept
            depth = kept.depth + rest * kept.rate if isinstance(pin, SectionPin) else state.depth
            pin.jumped(kept._replace(depth=depth, rate=state.rate, slip=state.slip))

    def recorded_contacts(self) -> dict[str, Any]:
        """Whose onsets and largest forces are reported, by name: contacts as a whole, and edges of bearings."""
        found: dict[str, Any] = {name: contact.whole for name, contact in self.contacts.items()}
        for name, contact in self.contacts.items():
            if len(contact.pins) > 1:
                found |= {f"{name}.left": contact.pins[0], f"{name}.right": contact.pins[-1]}
        return found

    def spins(self) -> dict[str, float]:
        """Angular velocity of every body [rad/s]; in space its size."""
        motion = self.instant(()).motion
        spins = {name: motion.spin(name)[0] for name in self.bodies}
        return {name: float(np.linalg.norm(spin) if spin.size > 1 else spin) for name, spin in spins.items()}

    def coordinate_masses(self) -> Series:
        """A mass for each of the engine's coordinates [kg], [kg m^2], by which accelerations are weighed."""
        found: list[float] = []
        for item in self.bodies.values():
            body = item.body
            if isinstance(self.linkage, Linkage):
                found += body.mass, body.mass, body.inertia
            else:  # the spin is twice the rate of the Euler parameters
                found += 3 * [body.mass] + 4 * [4.0 * sum(body.inertia[:3]) / 3.0]
        return np.array(found)


def slide(scene: EngineScene, rest: float) -> None:
    """Move on by a time [s] that is not worth a step, by the rates that the last one has ended with.

    Positions are then off by third order in it, and velocities and pressures by second. See
    `time_grid`.
    """
    data = scene.mbs.systemData
    velocity, acceleration = data.GetODE2Coordinates_t(), data.GetODE2Coordinates_tt()
    data.SetODE2Coordinates(data.GetODE2Coordinates() + rest * (velocity + 0.5 * rest * acceleration))
    data.SetODE2Coordinates_t(velocity + rest * acceleration)
    scene.legs.slide(rest)
    scene.legs.refresh()
    scene.refresh_memory(rest)
