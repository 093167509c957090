"""The model of a scenario in the engine, ready for the solver; `scene_builder` makes it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from support_exudyn.formulations.exudyn.scene.driven_parts import DrivenParts
from support_exudyn.formulations.exudyn.scene.engine_legs import EngineLegs
from support_exudyn.formulations.exudyn.scene.engine_scene import (
    CURRENT,
    INITIAL,
    EngineScene,
)
from support_exudyn.formulations.exudyn.scene.joint_friction import JointFriction
from support_exudyn.formulations.exudyn.scene.load_item import LoadItem
from support_exudyn.mechanics.body_coordinates import ActuatorItem, BodyItem, CrankItem, IdealItem, SlideItem
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.closing import repeated_count
from support_exudyn.mechanics.contact_places import ContactPlace
from support_exudyn.mechanics.kinetics import Kinetics, Matrix
from support_exudyn.mechanics.trajectory import Impulse
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
    ideal_pins: dict[str, IdealItem]
    frictions: dict[str, JointFriction]  # of ideal pins and guides, "pins.NAME" and "guides.NAME"
    clearance_joints: dict[str, ContactConnector]
    rigid_actuators: dict[str, ActuatorItem]
    legs: EngineLegs
    cranks: dict[str, CrankItem]
    slides: dict[str, SlideItem]
    gears: tuple[str, ...]
    loads: dict[str, LoadItem]
    weights: dict[str, Any]  # loads of the engine, by body; none without gravity
    driven: tuple[DrivenParts, ...]  # rigid actuators and cranks, by the drive that they follow

    @cached_property
    def kinetics(self) -> Kinetics:
        """Masses and constraints as matrices; clearance pins and oil columns are free."""
        held = self.scenario.guided_linkage
        return Kinetics(held, self.bodies, tuple(self.ideal_pins), tuple(self.rigid_actuators))

    @cached_property
    def closed_kinetics(self) -> Kinetics:
        """Masses and constraints as matrices with all pins ideal and all actuators rigid."""
        return Kinetics(self.linkage, self.bodies, tuple(self.linkage.pins), tuple(self.linkage.actuators))

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

    def start_moving(self) -> None:
        """Give the bodies the velocities that the drive has at the start, with ideal pins."""
        if all(drive.initial_speed == 0.0 for drive in self.scenario.drives_in_use):
            return
        closed = self.closed_kinetics
        data = self.mbs.systemData
        position, velocity = data.GetODE2Coordinates(INITIAL), data.GetODE2Coordinates_t(INITIAL)
        rates = closed.rates(lambda name: self.scenario.drive_of(name).initial_speed)
        missing = rates - closed.rows(position) @ velocity
        change, _ = closed.respond(position, np.zeros_like(velocity), missing)
        data.SetODE2Coordinates_t(velocity + change, INITIAL)

    def jump(self, time: float) -> Impulse | None:
        """See `EngineScene`."""
        data, kinetics = self.mbs.systemData, self.kinetics
        jump = kinetics.rates(lambda name: self.scenario.drive_of(name).speed_jump(time))
        if not jump.any():
            return None
        position, before = data.GetODE2Coordinates(), data.GetODE2Coordinates_t()
        mass = kinetics.mass()
        change, impulses = kinetics.respond(position, np.zeros_like(before), jump)
        after = before + change
        data.SetODE2Coordinates_t(after)
        driven = (-impulses[kinetics.driven()]).tolist()
        return Impulse(
            time,
            dict(zip(self.rigid_actuators, driven, strict=False)),
            float(0.5 * (mass * after) @ after - 0.5 * (mass * before) @ before),
            dict(zip(self.cranks, driven[len(self.rigid_actuators) :], strict=True)),
            kinetics.joint_impulses(impulses),
        )

    def align(self, time: float) -> float:
        """See `EngineScene`."""
        data, kinetics = self.mbs.systemData, self.kinetics
        position, before = data.GetODE2Coordinates(), data.GetODE2Coordinates_t()
        rates = kinetics.rates(lambda name: self.scenario.drive_of(name).speed(time))
        missing = rates - kinetics.rows(position) @ before
        change, impulses = kinetics.respond(position, np.zeros_like(before), missing)
        data.SetODE2Coordinates_t(before + change)
        return -float(impulses @ rates)

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
        still = np.zeros((1, velocity.size))
        motion = BodyMotion(self.linkage, still, velocity[None], still)
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
