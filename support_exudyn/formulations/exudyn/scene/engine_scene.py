"""The model of a scenario in the engine as the solver sees it, be it in the plane or in space."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import exudyn
import numpy as np

from support_exudyn.formulations.exudyn.scene.driven_parts import DrivenParts
from support_exudyn.formulations.exudyn.scene.engine_legs import EngineLegs
from support_exudyn.formulations.exudyn.scene.joint_friction import JointFriction
from support_exudyn.formulations.exudyn.scene.load_item import LoadItem
from support_exudyn.mechanics.constraints import Constraint
from support_exudyn.mechanics.kinetics import Instant, joint_impulses, rates
from support_exudyn.mechanics.trajectory import Impulse, Series
from support_exudyn.scenario.scenario import Scenario
from user_forces.connector.contact_connector import ContactConnector
from user_forces.contact import ContactForce

INITIAL = exudyn.ConfigurationType.Initial
CURRENT = exudyn.ConfigurationType.Current


@dataclass(frozen=True)
class BodyItem:
    """A moving body in the engine: its data, node, object and first coordinate."""

    body: Any
    node: Any
    object: Any
    first: int


class EngineScene(ABC):
    """The model of one scenario, assembled and ready for the solver.

    scenario: what is modelled. container: owns the system, and must live as long as it. mbs: the system.
    bodies: all that move, each an item with its data as `body`. clearance_pins: everything that may make
    contact and part. frictions: of ideal joints. loads: what acts by the motion, compliant pins, too.
    weights: loads of the engine, by body. driven: rigid actuators and cranks, by the drive that they follow.
    legs: the actuators on oil.
    """

    scenario: Scenario
    container: Any
    mbs: Any
    bodies: Mapping[str, BodyItem]
    clearance_joints: Mapping[str, ContactConnector]
    frictions: Mapping[str, JointFriction]
    loads: Mapping[str, LoadItem]
    weights: Mapping[str, Any]
    driven: tuple[DrivenParts, ...]
    legs: EngineLegs

    @property
    def repeats(self) -> bool:
        """Whether constraints of the model repeat each other."""
        return False

    def release(self) -> None:
        """Let go of the engine's model: what its user functions know would never be freed."""
        mbs: Any = self.mbs
        mbs.SetPreStepUserFunction(0)
        mbs.SetPostNewtonUserFunction(0)
        mbs.SetPostStepUserFunction(0)
        self.container.Reset()

    def drive_to(self, t: float) -> None:
        """Set every actuator, crank and valve to where it is at time t [s]."""
        for parts in self.driven:
            parts.move_to(t)
        self.legs.follow(t)

    @property
    @abstractmethod
    def held(self) -> Sequence[Constraint]:
        """What holds the bodies; clearance joints and actuators on oil are free."""

    @property
    @abstractmethod
    def closed(self) -> Sequence[Constraint]:
        """What would hold them if all pins were ideal and all actuators rigid."""

    @abstractmethod
    def instant(self, held: Sequence[Constraint], state: Any = CURRENT) -> Instant:
        """Masses and some constraints in a state of the engine."""

    @abstractmethod
    def set_velocities(self, velocities: Series, state: Any = CURRENT) -> None:
        """Give the bodies velocities, see `Motion.velocities`."""

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

    @abstractmethod
    def reset_memory(self) -> None:
        """Give every clearance pin the memory that belongs to the initial state of the bodies."""

    def recorded_contacts(self) -> Mapping[str, Any]:
        """Whose onsets and largest forces are reported, by name."""
        return self.clearance_joints

    def refresh_memory(self, rest: float = 0.0) -> None:
        """Tell every clearance pin that velocities have jumped; contacts that go on go on.

        rest: by which positions have moved on with the rates before [s].
        """
        for pin in self.clearance_joints.values():
            state = pin.observe(CURRENT)
            depth = self.depth_after(pin, state, rest)
            pin.jumped(pin.kept._replace(depth=depth, rate=state.rate, slip=state.slip))

    def depth_after(self, pin: ContactConnector, state: ContactForce, rest: float) -> float:
        """Depth of a pin [m] that the engine would find in a state, a rest of a step [s] after the last."""
        del pin, rest
        return state.depth

    @abstractmethod
    def spins(self) -> dict[str, float]:
        """Angular velocity of every body [rad/s]."""

    @abstractmethod
    def coordinate_masses(self) -> Series:
        """A mass for each of the engine's coordinates [kg], [kg m^2], by which accelerations are weighed."""


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
