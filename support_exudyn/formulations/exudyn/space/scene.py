"""The model of a scenario in space, ready for the solver; `scene_builder` makes it."""

from collections.abc import Sequence
from dataclasses import dataclass, field
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
from support_exudyn.formulations.exudyn.space.block_face import BlockFace
from support_exudyn.formulations.exudyn.space.section_pin import SectionPin
from support_exudyn.formulations.exudyn.space.sections import ends
from support_exudyn.mechanics.body_motion import COORDINATES, SpatialMotion, parameter_rates
from support_exudyn.mechanics.constraints import Constraint, constraints_in_space
from support_exudyn.mechanics.kinetics import Instant, bearing_rate
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.spatial_linkage import BearingEnd, SpatialLinkage
from support_exudyn.scenario.scenario import Scenario
from user_forces.connector.contact_connector import ContactConnector
from user_forces.contact import ContactForce
from user_forces.contact_state import InverseMass
from user_forces.values.value import Vector3


@dataclass(frozen=True)
class SpatialScene(EngineScene):
    """The model of one scenario in space, assembled and ready for the solver.

    rows: the constraints that are in the model. all_rows: those and the ones that repeat them.
    """

    scenario: Scenario
    linkage: SpatialLinkage
    container: Any  # owns the system: must live as long as it
    mbs: Any
    bodies: dict[str, BodyItem]
    rows: Sequence[Constraint]
    all_rows: Sequence[Constraint]
    clearance_joints: dict[str, ContactConnector]
    sections: dict[str, list[SectionPin]]  # of every clearance bearing
    rigid_actuators: dict[str, HeldItem]
    legs: EngineLegs
    driven: tuple[DrivenParts, ...]  # all actuators, by the drive that they follow
    frictions: dict[str, JointFriction] = field(default_factory=dict)  # of ideal pins: nor these
    loads: dict[str, LoadItem] = field(default_factory=dict)
    weights: dict[str, Any] = field(default_factory=dict)  # loads of the engine, by body
    faces: dict[str, BlockFace] = field(default_factory=dict)  # of falling blocks

    @property
    def gravity(self) -> Vector3:
        """Acceleration [m/s^2]."""
        return (*self.scenario.gravity, 0.0)

    def coordinate_masses(self) -> Series:
        """See `EngineScene`."""
        found = np.zeros(COORDINATES * len(self.bodies))
        for item in self.bodies.values():
            found[item.first : item.first + 3] = item.body.mass
            # the spin is twice the rate of the Euler parameters
            found[item.first + 3 : item.first + COORDINATES] = 4.0 * sum(item.body.inertia[:3]) / 3.0
        return found

    def spins(self) -> dict[str, float]:
        """See `EngineScene`."""
        motion = self.motion()
        return {name: float(np.linalg.norm(motion.spin(name))) for name in self.bodies}

    @cached_property
    def order(self) -> Series:
        """Places of the bodies' coordinates, in the order of the linkage, in the engine's vector."""
        return np.concatenate([np.arange(b.first, b.first + COORDINATES) for b in self.bodies.values()])

    def motion(self, state: Any = CURRENT) -> SpatialMotion:
        """The motion of all bodies in a state of the engine."""
        data = self.mbs.systemData
        position, velocity = data.GetODE2Coordinates(state), data.GetODE2Coordinates_t(state)
        return SpatialMotion(self.linkage, position[None, self.order], velocity[None, self.order])

    @property
    def held(self) -> Sequence[Constraint]:
        """See `EngineScene`: those in the model, and the ones that repeat them."""
        return self.all_rows

    @property
    def closed(self) -> Sequence[Constraint]:
        """See `EngineScene`."""
        return constraints_in_space(self.linkage, (), self.linkage.actuators)

    def instant(self, held: Sequence[Constraint], state: Any = CURRENT) -> Instant:
        """See `EngineScene`."""
        return Instant(self.motion(state), held)

    def inverse_mass(self, name: str, state: Any = CURRENT) -> InverseMass:
        """How the middle of a bearing's journal answers impulses, in its bore's axes, for its pin's law.

        A bearing of a pair has a share of its pin's force and energy, so the steps of the pin's law go by the
        mass over that share. Other contacts are open.
        """
        instant = self.instant(self.rows, state)
        answers = instant.answers(bearing_rate(self.motion(state), *self.ends_of(name)))
        return InverseMass.of(self.linkage.bearings[name].share * answers)

    def face_mass(self, name: str, state: Any = CURRENT) -> InverseMass:
        """How the point at a block's face answers impulses, in the face's axes; other contacts are open."""
        rate = self.faces[name].rate(self.motion(state))
        return InverseMass.of(self.instant(self.rows, state).answers(rate))

    def ends_of(self, name: str) -> tuple[BearingEnd, BearingEnd]:
        """Bore and journal of a clearance bearing."""
        bearing = self.linkage.bearings[name]
        return ends(bearing, self.scenario.clearance_pins[bearing.pin].bore)

    def set_velocities(self, velocity: Series, state: Any = CURRENT) -> None:
        """Give the bodies velocities v and omega, (6 bodies,)."""
        data = self.mbs.systemData
        position, rates = data.GetODE2Coordinates(state), data.GetODE2Coordinates_t(state)
        for item, (v, spin) in zip(self.bodies.values(), velocity.reshape(-1, 2, 3), strict=True):
            p = position[item.first + 3 : item.first + COORDINATES] + np.array([1.0, 0.0, 0.0, 0.0])
            rates[item.first : item.first + 3] = v
            rates[item.first + 3 : item.first + COORDINATES] = parameter_rates(p, spin)
        data.SetODE2Coordinates_t(rates, state)

    def depth_after(self, pin: ContactConnector, state: ContactForce, rest: float) -> float:
        """See `EngineScene`.

        To the engine a section that is tilted is less deep than it is, by tilt^2/24 of its way. With the true
        depth a journal that has just landed would be a little before its impact again, and stay there.
        """
        del state
        return pin.kept.depth + rest * pin.kept.rate

    def recorded_contacts(self) -> dict[str, Any]:
        """See `EngineScene`: bearings as a whole, both their edges, and faces of blocks."""
        found: dict[str, Any] = {name: group[0].whole for name, group in self.sections.items()}
        for name, group in self.sections.items():
            if len(group) > 1:
                found |= {f"{name}.left": group[0], f"{name}.right": group[-1]}
        return found | {name: face.contact for name, face in self.faces.items()}

    def reset_memory(self) -> None:
        """See `EngineScene`."""
        for name, face in self.faces.items():
            face.contact.start(self.face_mass(name, INITIAL))
        for name, group in self.sections.items():
            inverse_mass = self.inverse_mass(name, INITIAL)
            for pin in group:
                pin.start(inverse_mass)
