"""The model of a scenario in space, ready for the solver; `scene_builder` makes it."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
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
from support_exudyn.formulations.exudyn.space.block_face import BlockFace
from support_exudyn.formulations.exudyn.space.section_pin import SectionPin
from support_exudyn.formulations.exudyn.space.sections import ends
from support_exudyn.mechanics.body_coordinates import ActuatorItem
from support_exudyn.mechanics.space.constraints import (
    SHIFTS,
    BearingEnd,
    Constraint,
    all_rows,
    independent,
    matrix,
)
from support_exudyn.mechanics.space.kinetics import SpatialKinetics
from support_exudyn.mechanics.space.motion import COORDINATES, SpatialMotion, motion_of, parameter_rates
from support_exudyn.mechanics.space.reactions import reactions
from support_exudyn.mechanics.trajectory import Impulse, Series
from support_exudyn.model.spatial_linkage import SpatialBody, SpatialLinkage
from support_exudyn.scenario.scenario import Scenario
from user_forces.connector.contact_connector import ContactConnector
from user_forces.contact import ContactForce
from user_forces.contact_state import InverseMass
from user_forces.values.value import Vector3


@dataclass(frozen=True)
class SpatialBodyItem:
    """A moving body in the engine: its node, object and the first of its seven coordinates."""

    body: SpatialBody
    node: Any
    object: Any
    first: int


@dataclass(frozen=True)
class SpatialScene(EngineScene):
    """The model of one scenario in space, assembled and ready for the solver.

    rows: the constraints that are in the model. all_rows: those and the ones that repeat them.
    """

    scenario: Scenario
    linkage: SpatialLinkage
    container: Any  # owns the system: must live as long as it
    mbs: Any
    bodies: dict[str, SpatialBodyItem]
    rows: Sequence[Constraint]
    all_rows: Sequence[Constraint]
    clearance_joints: dict[str, ContactConnector]
    sections: dict[str, list[SectionPin]]  # of every clearance bearing
    rigid_actuators: dict[str, ActuatorItem]
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
        return {name: float(np.linalg.norm(motion.spin[0, n])) for n, name in enumerate(self.bodies)}

    @cached_property
    def order(self) -> Series:
        """Places of the bodies' coordinates, in the order of the linkage, in the engine's vector."""
        return np.concatenate([np.arange(b.first, b.first + COORDINATES) for b in self.bodies.values()])

    def motion(self, state: Any = CURRENT) -> SpatialMotion:
        """The motion of all bodies in a state of the engine."""
        data = self.mbs.systemData
        position, velocity = data.GetODE2Coordinates(state), data.GetODE2Coordinates_t(state)
        return motion_of(self.linkage, position[self.order], velocity[self.order])

    def kinetics(self, state: Any = CURRENT) -> SpatialKinetics:
        """Masses and the constraints of the model as matrices."""
        return SpatialKinetics(self.motion(state), self.rows)

    def inverse_mass(self, name: str, state: Any = CURRENT) -> InverseMass:
        """How the middle of a bearing's journal answers impulses, in its bore's axes, for its pin's law.

        A bearing of a pair has a share of its pin's force and energy, so the steps of the pin's law go by the
        mass over that share. Other contacts are open.
        """
        kinetics = self.kinetics(state)
        answers = kinetics.answers(kinetics.bearing_rate(*self.ends_of(name)))
        return InverseMass.of(self.linkage.bearings[name].share * answers)

    def face_mass(self, name: str, state: Any = CURRENT) -> InverseMass:
        """How the point at a block's face answers impulses, in the face's axes; other contacts are open."""
        kinetics = self.kinetics(state)
        return InverseMass.of(kinetics.answers(self.faces[name].rate(kinetics)))

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

    def start_moving(self) -> None:
        """Give the bodies the velocities that the drives have at the start, with ideal pins."""
        speeds = {name: self.scenario.drive_of(name).initial_speed for name in self.linkage.actuators}
        if not any(speeds.values()):
            return
        motion = self.motion(INITIAL)
        held = all_rows(self.linkage, (), list(self.linkage.actuators))
        closed = SpatialKinetics(motion, independent(held, matrix(motion, held)[0]))
        before = velocities(motion)
        wanted = rates(closed.rows, speeds) - matrix(motion, closed.rows)[0] @ before
        self.set_velocities(before + closed.respond(np.zeros_like(before), wanted)[0], INITIAL)

    def align(self, time: float) -> float:
        """See `EngineScene`."""
        kinetics = self.kinetics()
        before = velocities(kinetics.motion)
        speeds = {name: self.scenario.drive_of(name).speed(time) for name in self.rigid_actuators}
        wanted = rates(kinetics.rows, speeds)
        missing = wanted - matrix(kinetics.motion, kinetics.rows)[0] @ before
        change, impulses = kinetics.respond(np.zeros_like(before), missing)
        self.set_velocities(before + change)
        return -float(impulses @ wanted)

    def depth_after(self, pin: ContactConnector, state: ContactForce, rest: float) -> float:
        """See `EngineScene`.

        To the engine a section that is tilted is less deep than it is, by tilt^2/24 of its way. With the true
        depth a journal that has just landed would be a little before its impact again, and stay there.
        """
        del state
        return pin.kept.depth + rest * pin.kept.rate

    def jump(self, time: float) -> Impulse | None:
        """See `EngineScene`."""
        kinetics = self.kinetics()
        speeds = {name: self.scenario.drive_of(name).speed_jump(time) for name in self.rigid_actuators}
        if not any(speeds.values()):
            return None
        before = velocities(kinetics.motion)
        change, _ = kinetics.respond(np.zeros_like(before), rates(self.rows, speeds))
        after, mass = before + change, kinetics.mass()
        self.set_velocities(after)
        struck = reactions(kinetics.motion, self.all_rows, (mass @ change).reshape(1, -1, 6))[0]
        return Impulse(
            time,
            {
                row.name: float(i)
                for row, i in zip(self.all_rows, struck, strict=True)
                if row.kind == "actuator"
            },
            float(0.5 * after @ mass @ after - 0.5 * before @ mass @ before),
            {},
            self._joint_impulses(struck),
        )

    def _joint_impulses(self, struck: Series) -> dict[str, float]:
        """See `Impulse.joints`; struck: impulses of all rows [N s], [N m s]."""
        found: dict[str, float] = {}
        for row, impulse in zip(self.all_rows, struck.tolist(), strict=True):
            if row.kind in SHIFTS and self.linkage.bearings[row.name].pin not in self.scenario.clearance_pins:
                found[f"pin.{row.name}"] = math.hypot(found.get(f"pin.{row.name}", 0.0), impulse)
        return found

    def reset_memory(self) -> None:
        """See `EngineScene`."""
        for name, face in self.faces.items():
            face.contact.start(self.face_mass(name, INITIAL))
        for name, group in self.sections.items():
            inverse_mass = self.inverse_mass(name, INITIAL)
            for pin in group:
                pin.start(inverse_mass)


def rates(rows: Sequence[Constraint], speeds: Mapping[str, float]) -> Series:
    """Rates of all rows: of actuators as told [m/s], else 0."""
    return np.array([speeds[row.name] if row.kind == "actuator" else 0.0 for row in rows])


def velocities(motion: SpatialMotion) -> Series:
    """v and omega of all bodies at the first instant, (6 bodies,)."""
    return np.concatenate([motion.velocity[0], motion.spin[0]], axis=1).ravel()
