"""A finished run at its records, from which channels are computed, in the plane and in space."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

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
from support_exudyn.model.spatial_linkage import SpatialLinkage
from user_forces.contact_state import Onset


@dataclass(frozen=True)
class Trajectory:
    """A run at its n records, from which channels are computed. Arrays have shape (n, ...).

    linkage: the mechanism, in the plane (d = 2) or in space (d = 3). gravity: (d,) [m/s^2]. time: [s]. motion:
    of all bodies. acceleration: rates of `Motion.velocities` (n, freedoms). sections: contacts of clearance
    joints, corners in guides and blocks; several along a bearing. work: of drives so far, damping_loss,
    friction_loss: so far (n,) [J].

    Forces of joints, by name. pins: of ideal pins and of all bearings, of the first body on the second (n, d)
    [N]. pin_moments: of bearings about their middle (n, 3) [N m]. slides: force and moment of guides (n, 2), in
    space their magnitudes. actuators: force (n,) [N] that pushes the ends apart. cranks: moment of the drive on
    the crank (n,) [N m]. gears: moment on the second body (n,) [N m]. friction_moments: of ideal pins with
    friction, on the second body (n,) [N m]. friction_forces: of ideal guides with friction, on the body along
    the guide (n,) [N].

    loads: which act on the machine besides its weight, and those of compliant pins. legs: hydraulic, and the
    pump.
    """

    linkage: Linkage | SpatialLinkage
    gravity: Sequence[float]
    time: Series
    motion: Any
    acceleration: Series
    work: Series
    damping_loss: Series
    friction_loss: Series
    sections: Mapping[str, Sequence[ContactSeries]] = field(default_factory=dict)
    pins: Mapping[str, Series] = field(default_factory=dict)
    pin_moments: Mapping[str, Series] = field(default_factory=dict)
    slides: Mapping[str, Series] = field(default_factory=dict)
    actuators: Mapping[str, Series] = field(default_factory=dict)
    cranks: Mapping[str, Series] = field(default_factory=dict)
    gears: Mapping[str, Series] = field(default_factory=dict)
    friction_moments: Mapping[str, Series] = field(default_factory=dict)
    friction_forces: Mapping[str, Series] = field(default_factory=dict)
    loads: Mapping[str, LoadSeries] = field(default_factory=dict)
    legs: Mapping[str, LegSeries] = field(default_factory=dict)

    @property
    def in_space(self) -> bool:
        """Whether the run is one in space."""
        return isinstance(self.linkage, SpatialLinkage)

    def contacts_of(self, place: str) -> Sequence[ContactSeries]:
        """Contacts of a contact place of the plane, section by section; a pin has those of all its bearings."""
        bearings = self.linkage.parts_of_pin(place) if isinstance(self.linkage, SpatialLinkage) else {}
        return [one for name in bearings or [place] for one in self.sections.get(name, ())]

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
class Outcome:
    """A finished run of a formulation.

    trajectory: at the records. onsets: for each clearance pin the beginnings of contact. largest_force: for
    each clearance pin the largest force [N] at any time. largest_force_time: when that is [s]; in the Exudyn
    formulation the end of the step that has it. impulses: where the speed of rigid actuators or cranks jumped.
    counts: what the solver did. oil_events: what happened in each hydraulic leg with elements. statistics: of
    all channels that the scenario asks for, from every step.
    """

    trajectory: Trajectory
    onsets: Mapping[str, tuple[Onset, ...]]
    largest_force: Mapping[str, float]
    largest_force_time: Mapping[str, float]
    impulses: tuple[Impulse, ...]
    counts: Counts
    oil_events: Mapping[str, tuple[OilEvent, ...]] = field(default_factory=dict)
    statistics: TimeStatistics | None = None
