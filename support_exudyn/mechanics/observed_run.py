"""A finished run at its records, from which channels are computed: one interface in the plane and in space."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion, Motion
from support_exudyn.mechanics.kinetics import kinetic_energy
from support_exudyn.mechanics.time_statistics import TimeStatistics
from support_exudyn.mechanics.trajectory import (
    ContactSeries,
    Counts,
    Impulse,
    LegSeries,
    LoadSeries,
    OilEvent,
    Series,
)
from support_exudyn.model.linkage import Linkage
from user_forces.contact_state import Onset
from user_forces.values.value import Vector2


class ObservedRun(ABC):
    """A run at its n records. Arrays have shape (n, ...); forces in a pin are of the first body on the second.

    gravity: (2,) or (3,) [m/s^2]. time: [s]. acceleration: rates of `Motion.velocities` of all bodies
    (n, freedoms). work: of drives so far, damping_loss,
    friction_loss: so far (n,) [J]. By name: loads, which act on the machine besides its weight, and those of
    compliant pins; hydraulic legs, and the pump.
    """

    gravity: Sequence[float]
    time: Series
    acceleration: Series
    work: Series
    damping_loss: Series
    friction_loss: Series
    loads: Mapping[str, LoadSeries]
    legs: Mapping[str, LegSeries]

    @property
    @abstractmethod
    def motion(self) -> Motion:
        """The motion of all bodies."""

    @property
    @abstractmethod
    def sections(self) -> Mapping[str, Sequence[ContactSeries]]:
        """Contacts of clearance joints, corners in guides and blocks by name; several along a bearing."""

    @abstractmethod
    def contacts_of(self, place: str) -> Sequence[ContactSeries]:
        """Contacts of a contact place of the plane, section by section."""

    @abstractmethod
    def pin_force(self, name: str) -> Series:
        """Force in a pin, or in a bearing (n, d) [N]."""

    @abstractmethod
    def guide_force(self, name: str) -> Series:
        """Magnitudes of force and moment in an ideal guide (n, 2) [N], [N m]."""

    @abstractmethod
    def actuator_force(self, name: str) -> Series:
        """Force that pushes the ends of an actuator apart (n,) [N]."""

    @cached_property
    def _paths(self) -> dict[str, Series]:
        return {}

    def path(self, name: str) -> Series:
        """The path of a traced point (n, d) [m]."""
        if name not in self._paths:
            point = self.motion.linkage.points[name]
            self._paths[name] = self.motion.place(point.body, point.point)
        return self._paths[name]

    def span(self, name: str) -> Series:
        """The vector from foot to head of an actuator (n, d) [m]."""
        if name not in self._paths:
            self._paths[name] = self.motion.span(self.motion.linkage.actuators[name])
        return self._paths[name]

    @cached_property
    def kinetic(self) -> Series:
        """Kinetic energy (n,) [J]."""
        return kinetic_energy(self.motion)

    @cached_property
    def potential(self) -> Series:
        """Potential energy of weight (n,) [J], zero in the start posture."""
        found = np.zeros_like(self.time)
        for name, body in self.motion.linkage.bodies.items():
            found -= body.mass * (self.motion.centre(name)[0] * np.asarray(self.gravity)).sum(axis=1)
        return found

    @cached_property
    def stored(self) -> Series:
        """Energy stored in contacts, oil, loads and compliant pins (n,) [J]."""
        contacts = [contact for sections in self.sections.values() for contact in sections]
        compliant: list[Any] = [*contacts, *self.loads.values()]
        oil = sum((leg.energy for leg in self.legs.values()), np.zeros_like(self.time))
        return np.asarray(oil + sum(one.stored for one in compliant))

    @cached_property
    def balance(self) -> Series:
        """Gain of energy minus work plus loss (n,) [J]."""
        total = self.kinetic + self.potential + self.stored
        balance: Series = total - total[0] + (self.damping_loss + self.friction_loss) - self.work
        return balance


@dataclass(frozen=True)
class Trajectory(ObservedRun):
    """A run of a linkage with b bodies in the plane.

    linkage: the mechanism. position, velocity, acceleration (n, 3 b): x, y, turn of each body in the order of
    `Linkage.bodies`, positions from those at the start. ideal_pins: forces (n, 2) [N], by name.
    friction_moments: of ideal pins with friction, on the second body (n,) [N m]. friction_forces: of ideal
    guides with friction, on the body along the guide (n,) [N]. contacts: clearance joints and blocks by name.
    actuators: force (n,) [N] that pushes the ends apart. cranks: moment of the drive on the crank (n,) [N m].
    slides: magnitude of force across and of moment (n, 2). loads, legs: by name.
    gears: moment on the second body (n,) [N m]. The others: see `ObservedRun`.
    """

    linkage: Linkage
    gravity: Vector2
    time: Series
    position: Series
    velocity: Series
    acceleration: Series
    ideal_pins: Mapping[str, Series]
    contacts: Mapping[str, ContactSeries]
    actuators: Mapping[str, Series]
    cranks: Mapping[str, Series]
    slides: Mapping[str, Series]
    work: Series
    damping_loss: Series
    friction_loss: Series
    friction_moments: Mapping[str, Series] = field(default_factory=dict)
    friction_forces: Mapping[str, Series] = field(default_factory=dict)
    loads: Mapping[str, LoadSeries] = field(default_factory=dict)
    legs: Mapping[str, LegSeries] = field(default_factory=dict)
    gears: Mapping[str, Series] = field(default_factory=dict)

    @cached_property
    def motion(self) -> BodyMotion:
        """See `ObservedRun`."""
        return BodyMotion(self.linkage, self.position, self.velocity)

    @cached_property
    def sections(self) -> Mapping[str, Sequence[ContactSeries]]:
        """See `ObservedRun`: each contact is one section."""
        return {name: (contact,) for name, contact in self.contacts.items()}

    def contacts_of(self, place: str) -> Sequence[ContactSeries]:
        """See `ObservedRun`."""
        return self.sections[place]

    def pin_force(self, name: str) -> Series:
        """See `ObservedRun`."""
        return self.ideal_pins[name]

    def guide_force(self, name: str) -> Series:
        """See `ObservedRun`."""
        return self.slides[name]

    def actuator_force(self, name: str) -> Series:
        """See `ObservedRun`."""
        return self.actuators[name]


@dataclass(frozen=True)
class Outcome:
    """A finished run of a formulation.

    trajectory: at the records. onsets: for each clearance pin the beginnings of contact. largest_force: for
    each clearance pin the largest force [N] at any time. largest_force_time: when that is [s]; in the Exudyn
    formulation the end of the step that has it. impulses: where the speed of rigid actuators or cranks jumped.
    counts: what the solver did. oil_events: what happened in each hydraulic leg with elements. statistics: of
    all channels that the scenario asks for, from every step.
    """

    trajectory: ObservedRun
    onsets: Mapping[str, tuple[Onset, ...]]
    largest_force: Mapping[str, float]
    largest_force_time: Mapping[str, float]
    impulses: tuple[Impulse, ...]
    counts: Counts
    oil_events: Mapping[str, tuple[OilEvent, ...]] = field(default_factory=dict)
    statistics: TimeStatistics | None = None
