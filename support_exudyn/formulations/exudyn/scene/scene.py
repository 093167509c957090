"""The model of a scenario in the engine, ready for the solver; `scene_builder` makes it."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from support_exudyn.formulations.exudyn.scene.driven_parts import DrivenParts, HeldItem
from support_exudyn.formulations.exudyn.scene.engine_legs import EngineLegs
from support_exudyn.formulations.exudyn.scene.engine_scene import (
    CURRENT,
    INITIAL,
    BodyItem,
    EngineScene,
)
from support_exudyn.formulations.exudyn.scene.joint_friction import JointFriction
from support_exudyn.formulations.exudyn.scene.load_item import LoadItem
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.closing import repeated_count
from support_exudyn.mechanics.constraints import Constraint, constraints_of
from support_exudyn.mechanics.contact_places import ContactPlace
from support_exudyn.mechanics.kinetics import Instant, Kinetics, Matrix, kinetics_of
from support_exudyn.model.linkage import GROUND, Linkage
from support_exudyn.scenario.scenario import Scenario
from user_forces.connector.contact_connector import ContactConnector
from user_forces.contact_state import InverseMass

FRICTION_ROUNDS = 4  # each with an error smaller by the coefficient of friction times radius over lever


@dataclass(frozen=True)
class Scene(EngineScene):
    """The model of one scenario, assembled and ready for the solver."""

    scenario: Scenario
    linkage: Linkage
    container: Any  # owns the system: must live as long as it
    mbs: Any
    bodies: dict[str, BodyItem]
    ideal_pins: dict[str, HeldItem]
    frictions: dict[str, JointFriction]  # of ideal pins and guides, "pins.NAME" and "guides.NAME"
    clearance_joints: dict[str, ContactConnector]
    rigid_actuators: dict[str, HeldItem]
    legs: EngineLegs
    cranks: dict[str, HeldItem]
    slides: dict[str, HeldItem]
    gears: tuple[str, ...]
    loads: dict[str, LoadItem]
    weights: dict[str, Any]  # loads of the engine, by body; none without gravity
    driven: tuple[DrivenParts, ...]  # rigid actuators and cranks, by the drive that they follow

    @cached_property
    def kinetics(self) -> Kinetics:
        """Masses and constraints as matrices; clearance pins and oil columns are free."""
        held = self.scenario.guided_linkage
        return kinetics_of(held, self.ideal_pins, self.rigid_actuators)

    @property
    def held(self) -> Sequence[Constraint]:
        """See `EngineScene`."""
        return self.kinetics.constraints

    @property
    def closed(self) -> Sequence[Constraint]:
        """See `EngineScene`."""
        return constraints_of(self.linkage)

    @property
    def repeats(self) -> bool:
        """See `EngineScene`."""
        return repeated_count(self.scenario.held)[0] > 0

    def inverse_mass(self, name: str, state: Any = CURRENT) -> InverseMass:
        """How a contact's journal answers impulses, in the axes of its bore, with other contacts open."""
        position = self.mbs.systemData.GetODE2Coordinates(state)
        rate = self.places[name].rate(self.kinetics, position)
        angle = self.bore_angle(name, position)
        axes = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        return InverseMass.of(axes.T @ self.kinetics.inverse_mass(position, rate) @ axes)

    def bore_angle(self, name: str, position: Any) -> float:
        """Angle [rad] of the axes of a bore or a slot."""
        place = self.places[name]
        return place.axes(self.linkage) + self._turn(place.bore, position)

    @property
    def places(self) -> Mapping[str, ContactPlace]:
        """Where bodies may make contact, by name."""
        return self.scenario.contact_places

    def _turn(self, body: str, coordinates: Any) -> float:
        """Rotation [rad] of a body since the start posture, or its rate, from the vector of all."""
        return 0.0 if body == GROUND else float(coordinates[self.bodies[body].first + 2])

    def instant(self, held: Sequence[Constraint], state: Any = CURRENT) -> Instant:
        """See `EngineScene`."""
        data = self.mbs.systemData
        position, velocity = data.GetODE2Coordinates(state), data.GetODE2Coordinates_t(state)
        return Instant(BodyMotion(self.linkage, position[None], velocity[None]), held, self.kinetics.size)

    def set_velocities(self, velocities: Matrix, state: Any = CURRENT) -> None:
        """See `EngineScene`."""
        self.mbs.systemData.SetODE2Coordinates_t(velocities, state)

    def spins(self) -> dict[str, float]:
        """See `EngineScene`."""
        velocity = self.mbs.systemData.GetODE2Coordinates_t()
        return {name: float(velocity[item.first + 2]) for name, item in self.bodies.items()}

    def coordinate_masses(self) -> Matrix:
        """See `EngineScene`."""
        return self.kinetics.mass()

    def multiplier_of(self, friction: JointFriction) -> int:
        """The first multiplier of a joint with friction."""
        kind, name = friction.joint.owner
        return int(self.ideal_pins[name].first if kind == "pins" else self.slides[name].first)

    def start_rubbing(self) -> None:
        """Let friction of ideal joints know about their forces at the start, if anything moves then.

        The solver's first accelerations follow from forces of friction, which follow from those of the pins:
        without, the first step would be taken with none. Forces of clearance pins and oil are left out of it.
        """
        data = self.mbs.systemData
        position, velocity = data.GetODE2Coordinates(INITIAL), data.GetODE2Coordinates_t(INITIAL)
        if not self.frictions or not velocity.any():
            return
        kinetics, small = self.kinetics, 1e-6 / np.abs(velocity).max()
        later, earlier = (kinetics.rows(position + h * velocity) for h in (small, -small))
        turning = (earlier - later) @ velocity / (2.0 * small)  # accelerations that the constraints ask for
        owners = kinetics.owners()
        motion = BodyMotion(self.linkage, np.zeros((1, velocity.size)), velocity[None])
        for friction in self.frictions.values():
            friction.start(motion)
        force = kinetics.weight(self.scenario.gravity)
        multipliers = data.GetAECoordinates(INITIAL)
        for _ in range(FRICTION_ROUNDS):
            _, reactions = kinetics.respond(position, force, turning)
            total = kinetics.weight(self.scenario.gravity)[None]
            for friction in self.frictions.values():
                row = owners.index(friction.joint.owner)
                friction.guess(total, motion, reactions[row : row + friction.joint.conditions], multipliers)
            force = total[0]
        data.SetAECoordinates(multipliers, INITIAL)

    def reset_memory(self) -> None:
        """See `EngineScene`."""
        for name, pin in self.clearance_joints.items():
            pin.start(self.inverse_mass(name, INITIAL))
