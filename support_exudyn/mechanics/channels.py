"""Channels by name: unit, meaning, what of a run they need, and how they follow from it.

They are known before a run, so that nothing is kept or computed that nobody asks for.
"""

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from enum import Flag, auto
from fnmatch import fnmatchcase
from functools import cached_property
from typing import Any

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.trajectory import LoadSeries, Series, Trajectory
from support_exudyn.model.linkage import Linkage
from user_forces.values.value import Vector2


class DataNeeds(Flag):
    """Parts of a Trajectory.

    JOINTS: forces of ideal pins, cranks, guides and rigid actuators; CONTACTS: pins with clearance and others
    whose force follows from the motion; OIL: columns of oil; INTEGRALS: work and losses so far, which have to
    be followed at every step; LOADS: what presses on it.
    """

    NOTHING = 0
    POSITION = auto()
    VELOCITY = auto()
    ACCELERATION = auto()
    JOINTS = auto()
    CONTACTS = auto()
    OIL = auto()
    INTEGRALS = auto()
    LOADS = auto()


EVERYTHING = ~DataNeeds.NOTHING
MOTION = DataNeeds.POSITION | DataNeeds.VELOCITY
CONTACT = MOTION | DataNeeds.CONTACTS
OIL = MOTION | DataNeeds.OIL
LOADED = MOTION | DataNeeds.LOADS
ALL_CHANNELS = ("*",)  # the pattern that asks for everything


@dataclass(frozen=True)
class EvaluationContext:
    """A run at its records, from which channels are computed.

    Arguments:
        linkage: the mechanism.
        gravity: [m/s^2].
        run: with the parts that the channels need.
    """

    linkage: Linkage
    gravity: Vector2
    run: Trajectory
    _paths: dict[str, Series] = field(default_factory=dict, repr=False, compare=False)

    @cached_property
    def motion(self) -> BodyMotion:
        """The motion of all bodies."""
        return BodyMotion(self.linkage, self.run.position, self.run.velocity, self.run.acceleration)

    @property
    def acting(self) -> Mapping[str, LoadSeries]:
        """What acts by the motion, loads and those of compliant pins, by name."""
        return self.run.loads

    def path(self, name: str) -> Series:
        """The path of a traced point (n, 2) [m]."""
        if name not in self._paths:
            point = self.linkage.points[name]
            self._paths[name] = self.motion.place(point.body, point.point)
        return self._paths[name]

    def span(self, name: str) -> Series:
        """The vector from foot to head of an actuator (n, 2) [m]."""
        if name not in self._paths:
            actuator = self.linkage.actuators[name]
            foot = self.motion.place(actuator.foot, actuator.foot_point)
            self._paths[name] = self.motion.place(actuator.head, actuator.head_point) - foot
        return self._paths[name]

    @cached_property
    def kinetic(self) -> Series:
        """Kinetic energy [J]."""
        found = np.zeros_like(self.run.time)
        for n, body in enumerate(self.linkage.bodies.values()):
            vx, vy, spin = self.run.velocity[:, 3 * n : 3 * n + 3].T
            found += 0.5 * body.mass * (vx**2 + vy**2) + 0.5 * body.inertia * spin**2
        return found

    @cached_property
    def potential(self) -> Series:
        """Potential energy of weight (n,) [J], zero in the start posture."""
        found = np.zeros_like(self.run.time)
        gx, gy = self.gravity
        for n, body in enumerate(self.linkage.bodies.values()):
            i = 3 * n
            found -= body.mass * (gx * self.run.position[:, i] + gy * self.run.position[:, i + 1])
        return found

    @cached_property
    def stored(self) -> Series:
        """Energy stored in contacts, oil, loads and compliant pins (n,) [J]."""
        run = self.run
        found = run.oil_energy + sum(contact.stored for contact in run.contacts.values())
        return found + sum(load.stored for load in run.loads.values())

    @cached_property
    def balance(self) -> Series:
        """Gain of energy minus work plus loss (n,) [J]."""
        total = self.kinetic + self.potential + self.stored
        balance: Series = total - total[0] + (self.run.damping_loss + self.run.friction_loss) - self.run.work
        return balance


@dataclass(frozen=True)
class ChannelDefinition:
    """A channel before its run: unit, meaning, the parts it needs, and its values (n,) from what was seen."""

    unit: str
    meaning: str
    needs: DataNeeds
    values: Callable[[Any], Series]


ChannelDefinitions = dict[str, ChannelDefinition]


def chosen(names: Iterable[str], patterns: Iterable[str]) -> list[str]:
    """Time, and the names that a pattern matches, in their order."""
    if patterns == ALL_CHANNELS:
        return list(names)
    return [name for name in names if name == "time" or any(fnmatchcase(name, p) for p in patterns)]


def check_patterns(names: Collection[str], patterns: Iterable[str]) -> None:
    """Raise ValueError for a pattern that matches none of the names."""
    for pattern in patterns:
        if not any(fnmatchcase(name, pattern) for name in names):
            near = get_close_matches(pattern, names, 3, 0.4) or list(names)[1:4]
            raise ValueError(
                f"channels = {pattern!r}: matches no channel; allowed: names of channels, or patterns of them "
                f"such as 'pin.*', among them {', '.join(near)}"
            )
