"""All forces of a tree at chosen instants of a run, and what follows from them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from support_exudyn.formulations.contract import Failure, SimulationError
from support_exudyn.formulations.tree.branches import Matrix
from support_exudyn.formulations.tree.drive_pieces import extension, speed
from support_exudyn.formulations.tree.dynamics import PointForce, Posture, accelerations
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.contact_history import acting, contact_series, ends, of_depth
from support_exudyn.mechanics.oil_column import FilledColumn, OilSeries
from support_exudyn.mechanics.trajectory import ContactSeries
from support_exudyn.model.linkage import PinPlace
from support_exudyn.model.pins import ClearancePin
from user_forces.contact import SHALLOWEST
from user_forces.lawful import UNLAWFUL, LawError, look
from user_forces.values.value import Vector2


@dataclass(frozen=True)
class Instants:
    """Where and how the run is looked at.

    time (m,) [s]. posture: at these times. cubic: of the drives of all columns (m, c, 5), see `loads`.
    memories: of loose pins, by name (m, fields of PinMemory).
    """

    time: Matrix
    posture: Posture
    cubic: Matrix
    memories: Mapping[str, Matrix]


@dataclass(frozen=True)
class Observation:
    """What is to be seen at some instants.

    Arguments:
        at: the instants.
        loose: loose pins, by name.
        filled: columns, by name.
        gravity: [m/s^2].
    """

    at: Instants
    loose: Mapping[str, ClearancePin]
    filled: Mapping[str, FilledColumn]
    gravity: Vector2

    @cached_property
    def motion(self) -> BodyMotion:
        """Of all bodies; accelerations are left out."""
        return self.at.posture.motion()

    @cached_property
    def contacts(self) -> dict[str, ContactSeries]:
        """Loose pins by name."""
        return {
            name: contact_series(self.motion, self._place(name), pin, self.at.memories[name])
            for name, pin in self.loose.items()
        }

    @cached_property
    def columns(self) -> dict[str, OilSeries]:
        """Columns by name."""
        return {name: self._column(n, filled) for n, (name, filled) in enumerate(self.filled.items())}

    @cached_property
    def pin_forces(self) -> dict[str, PointForce]:
        """Forces of loose pins, of the first body on the second, where they act."""
        found = {}
        for name, pin in self.loose.items():
            place = self._place(name)
            push = acting(self.motion, place, pin, self.contacts[name])
            found[name] = PointForce(place.first, place.second, push.force, push.point)
        return found

    def accelerations(self) -> Matrix:
        """q'' [rad/s^2] by the equations of motion, shape (m, n)."""
        return accelerations(self.at.posture, self.gravity, [*self.pin_forces.values(), *self._column_forces()])

    def powers(self) -> Matrix:
        """Of the drive, of damping and of friction [W], shape (3, m)."""
        total = np.zeros((3, len(self.at.time)))
        for column in self.columns.values():
            total[0] += column.work
            total[1] += column.loss
        for name, contact in self.contacts.items():
            bore, journal = ends(self.motion, self._place(name), self.loose[name])
            offset, relative = journal.position - bore.position, journal.velocity - bore.velocity
            away = np.maximum(np.linalg.norm(offset, axis=1), SHALLOWEST)
            rate = np.einsum("mx,mx->m", offset, relative) / away
            pressed = (self.at.memories[name][:, 0] > 0.5) & (contact.depth > 0.0)
            law = self.loose[name].contact.normal
            elastic = of_depth(law.elastic_force, np.maximum(contact.depth, SHALLOWEST))
            lost = np.where(pressed, (contact.normal_force - elastic) * rate, 0.0)
            rubbed = contact.friction_force * contact.slip
            total[1] += lost
            total[2] -= rubbed
            odd = pressed & ~((lost >= 0.0) & (rubbed <= 0.0) & (elastic >= 0.0))
            for n in np.flatnonzero(odd).tolist():
                seen = (
                    contact.depth,
                    rate,
                    contact.slip,
                    contact.normal_force,
                    contact.friction_force,
                    elastic,
                )
                self._look(name, n, *(float(values[n]) for values in seen))
        return total

    def _look(self, name: str, n: int, *seen: float) -> None:
        """Raise SimulationError if what a pin's laws gave at an instant cannot be a force, see `look`."""
        depth, rate, slip, normal, friction, elastic = seen
        try:
            look(self.loose[name].contact, depth, rate, slip, normal, friction, elastic, name)
        except LawError as error:
            failure = Failure(str(error), UNLAWFUL, float(self.at.time[n]))
            raise SimulationError(failure) from error

    def _place(self, name: str) -> PinPlace:
        return self.motion.linkage.pins[name]

    def _column(self, number: int, filled: FilledColumn) -> OilSeries:
        cubic = self.at.cubic[:, number]
        let_in = extension(cubic, self.at.time), speed(cubic, self.at.time)
        return filled.series(self.motion, *let_in)

    def _column_forces(self) -> list[PointForce]:
        found = []
        for name, filled in self.filled.items():
            foot, head = (end.position for end in filled.ends(self.motion))
            along = (head - foot) / np.linalg.norm(head - foot, axis=1)[:, None]
            force = self.columns[name].force[:, None] * along
            found.append(PointForce(filled.column.foot, filled.column.head, force, head))
        return found
