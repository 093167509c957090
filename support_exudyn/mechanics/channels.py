"""Channels by name: unit, meaning, what of a run they need, and how they follow from it.

They are known before a run, so that nothing is kept or computed that nobody asks for.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from enum import Flag, auto
from fnmatch import fnmatchcase
from functools import cached_property
from typing import Any

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.trajectory import ContactSeries, CylinderSeries, Series, Trajectory
from support_exudyn.model.linkage import Body, Linkage
from support_exudyn.model.loads.load import Load, Observed
from support_exudyn.model.pins import ClearancePin
from user_forces.values.value import Vector2


class Part(Flag):
    """Parts of a Trajectory.

    JOINTS: forces of ideal pins, cranks, guides and rigid columns; CONTACTS: loose pins; OIL: columns of oil;
    INTEGRALS: work and losses so far, which have to be followed at every step; LOADS: what presses on it.
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


EVERYTHING = ~Part.NOTHING
MOTION = Part.POSITION | Part.VELOCITY
CONTACT = MOTION | Part.CONTACTS
OIL = MOTION | Part.OIL
LOADED = MOTION | Part.LOADS
ALL_CHANNELS = ("*",)  # the pattern that asks for everything


@dataclass(frozen=True)
class Seen:
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
        """Of all bodies."""
        return BodyMotion(self.linkage, self.run.position, self.run.velocity, self.run.acceleration)

    def path(self, name: str) -> Series:
        """Where a traced point is (n, 2) [m]."""
        if name not in self._paths:
            point = self.linkage.points[name]
            self._paths[name] = self.motion.place(point.body, point.point)
        return self._paths[name]

    def span(self, name: str) -> Series:
        """From foot to head of a column (n, 2) [m]."""
        if name not in self._paths:
            column = self.linkage.columns[name]
            foot = self.motion.place(column.foot, column.foot_point)
            self._paths[name] = self.motion.place(column.head, column.head_point) - foot
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
        """Of weight [J], zero in the start posture."""
        found = np.zeros_like(self.run.time)
        gx, gy = self.gravity
        for n, body in enumerate(self.linkage.bodies.values()):
            i = 3 * n
            found -= body.mass * (gx * self.run.position[:, i] + gy * self.run.position[:, i + 1])
        return found

    @cached_property
    def stored(self) -> Series:
        """In contacts, oil and loads [J]."""
        found = self.run.oil_energy + sum(contact.stored for contact in self.run.contacts.values())
        return found + sum(load.stored for load in self.run.loads.values())

    @cached_property
    def balance(self) -> Series:
        """Gain minus work plus loss [J]."""
        total = self.kinetic + self.potential + self.stored
        balance: Series = total - total[0] + (self.run.damping_loss + self.run.friction_loss) - self.run.work
        return balance


@dataclass(frozen=True)
class Recipe:
    """A channel before its run: unit, meaning, the parts it needs, and its values (n,) from what was seen."""

    unit: str
    meaning: str
    needs: Part
    values: Callable[[Any], Series]


Recipes = dict[str, Recipe]


def recipes(
    linkage: Linkage,
    loose: Mapping[str, ClearancePin],
    oil: Collection[str],
    rubbing: Collection[str] = (),
    loads: Mapping[str, Load] | None = None,
    cylinders: Collection[str] = (),
) -> Recipes:
    """All channels of a linkage with these loose pins, columns of oil, ideal pins with friction, and loads.

    cylinders: which of the columns of oil have a valve and pressures.
    """
    loads = loads or {}
    found = {"time": Recipe("s", "time", Part.NOTHING, lambda seen: seen.run.time)}
    for n, (name, body) in enumerate(linkage.bodies.items()):
        found |= _of_body(name, body, 3 * n)
    for name in linkage.points:
        found |= _of_point(name)
    for name in linkage.columns:
        found |= _of_column(name, name in oil)
        if name in cylinders:
            found |= _of_cylinder(name)
    for name in linkage.cranks:
        found |= _of_crank(name)
    for name in linkage.slides:
        found |= _of_slide(name)
    for name in linkage.pins:
        found |= _of_loose_pin(name, loose[name]) if name in loose else _of_ideal_pin(name)
        if name in rubbing:
            found |= _of_friction(name)
    for name, load in loads.items():
        found |= _of_load(name, load)
    return found | _of_energy(_stored(bool(loose), bool(oil), bool(loads)), bool(loads), bool(cylinders))


def chosen(names: Iterable[str], patterns: Iterable[str]) -> list[str]:
    """Time, and the names that a pattern matches, in their order."""
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


def _of_body(name: str, body: Body, i: int) -> Recipes:
    cx, cy = body.centre
    velocity, acceleration = Part.VELOCITY, Part.ACCELERATION
    return {
        f"{name}.x": Recipe(
            "m", "centre of mass, forward", Part.POSITION, lambda seen: cx + seen.run.position[:, i]
        ),
        f"{name}.y": Recipe(
            "m", "centre of mass, up", Part.POSITION, lambda seen: cy + seen.run.position[:, i + 1]
        ),
        f"{name}.velocity_x": Recipe(
            "m/s", "velocity of the centre of mass, forward", velocity, lambda seen: seen.run.velocity[:, i]
        ),
        f"{name}.velocity_y": Recipe(
            "m/s", "velocity of the centre of mass, up", velocity, lambda seen: seen.run.velocity[:, i + 1]
        ),
        f"{name}.angle": Recipe(
            "rad",
            "orientation from +x",
            Part.POSITION,
            lambda seen: body.angle + seen.run.position[:, i + 2],
        ),
        f"{name}.angular_velocity": Recipe(
            "rad/s", "angular velocity", velocity, lambda seen: seen.run.velocity[:, i + 2]
        ),
        f"{name}.angular_acceleration": Recipe(
            "rad/s^2", "angular acceleration", acceleration, lambda seen: seen.run.acceleration[:, i + 2]
        ),
    }


def _of_point(name: str) -> Recipes:
    return {
        f"{name}.x": Recipe("m", "position, forward", Part.POSITION, lambda seen: seen.path(name)[:, 0]),
        f"{name}.y": Recipe("m", "position, up", Part.POSITION, lambda seen: seen.path(name)[:, 1]),
    }


def _of_column(name: str, oil: bool) -> Recipes:
    def angle(seen: Seen) -> Series:
        dx, dy = seen.span(name).T
        direction: Series = np.arctan2(dy, dx)
        return direction

    def length(seen: Seen) -> Series:
        distance: Series = np.hypot(*seen.span(name).T)
        return distance

    return {
        f"{name}.angle": Recipe("rad", "direction from foot to head, from +x", Part.POSITION, angle),
        f"{name}.length": Recipe("m", "distance of its ends", Part.POSITION, length),
        f"{name}.force": Recipe(
            "N",
            "pushes its ends apart if positive",
            OIL if oil else Part.JOINTS,
            lambda seen: seen.run.columns[name],
        ),
    }


def _of_cylinder(name: str) -> Recipes:
    def said(what: str, unit: str, meaning: str, values: Callable[[CylinderSeries], Series]) -> Recipes:
        return {f"{name}.{what}": Recipe(unit, meaning, OIL, lambda seen: values(seen.run.cylinders[name]))}

    found = said("pressure", "Pa", "of the piston side", lambda c: c.pressure)
    found |= said("rod_pressure", "Pa", "of the rod side", lambda c: c.rod_pressure)
    found |= said("opening", "1", "of the valve; positive: pump to the piston side", lambda c: c.opening)
    found |= said("flow", "m^3/s", "into the piston side", lambda c: c.flow)
    found |= said("rod_flow", "m^3/s", "into the rod side", lambda c: c.rod_flow)
    return found


def _of_crank(name: str) -> Recipes:
    moment = Recipe("N m", "of the drive on the crank", Part.JOINTS, lambda seen: seen.run.cranks[name])
    return {f"{name}.moment": moment}


def _of_slide(name: str) -> Recipes:
    joints = Part.JOINTS
    return {
        f"{name}.force": Recipe(
            "N", "magnitude of the guide's force, across it", joints, lambda seen: seen.run.slides[name][:, 0]
        ),
        f"{name}.moment": Recipe(
            "N m", "magnitude of the guide's moment", joints, lambda seen: seen.run.slides[name][:, 1]
        ),
    }


def _forces(name: str, needs: Part, force: Callable[[Seen], tuple[Series, Series]]) -> Recipes:
    """Of a pin; force: of the first body on the second, x and y (n,) [N]."""

    def magnitude(seen: Seen) -> Series:
        size: Series = np.hypot(*force(seen))
        return size

    x, y = "force of the first body on the second, forward", "force of the first body on the second, up"
    return {
        f"pin.{name}.force": Recipe("N", "magnitude of the pin force", needs, magnitude),
        f"pin.{name}.force_x": Recipe("N", x, needs, lambda seen: force(seen)[0]),
        f"pin.{name}.force_y": Recipe("N", y, needs, lambda seen: force(seen)[1]),
    }


def _of_ideal_pin(name: str) -> Recipes:
    def force(seen: Seen) -> tuple[Series, Series]:
        fx, fy = seen.run.ideal_pins[name].T
        return fx, fy

    return _forces(name, Part.JOINTS, force)


def _of_friction(name: str) -> Recipes:
    return {
        f"pin.{name}.friction_moment": Recipe(
            "N m",
            "of friction on the second body",
            MOTION | Part.JOINTS,
            lambda seen: seen.run.friction_moments[name],
        )
    }


def _of_loose_pin(name: str, pin: ClearancePin) -> Recipes:
    sign = 1.0 if pin.bore == "first" else -1.0  # contacts know the force on the journal

    def force(seen: Seen) -> tuple[Series, Series]:
        contact = seen.run.contacts[name]
        return sign * contact.force_x, sign * contact.force_y

    def said(what: str, unit: str, meaning: str, values: Callable[[ContactSeries], Series]) -> Recipes:
        recipe = Recipe(unit, meaning, CONTACT, lambda seen: values(seen.run.contacts[name]))
        return {f"pin.{name}.{what}": recipe}

    found = _forces(name, CONTACT, force)
    found |= said("normal_force", "N", "normal contact force", lambda c: c.normal_force)
    found |= said(
        "friction_force", "N", "on the journal, along t (n turned by +90 degrees)", lambda c: c.friction_force
    )
    found |= said("depth", "m", "depth; negative: gap", lambda c: c.depth)
    found |= said("slip", "m/s", "slip of the journal's surface, along t", lambda c: c.slip)
    found |= said(
        "approach_speed", "m/s", "touch speed that the laws are told; 0 apart", lambda c: c.approach_speed
    )
    found |= said(
        "eccentricity_x", "m", "journal's centre from the bore's, forward", lambda c: c.eccentricity_x
    )
    found |= said("eccentricity_y", "m", "journal's centre from the bore's, up", lambda c: c.eccentricity_y)
    if pin.contact.friction.has_state:
        found |= said("deflection", "m", "state of the friction law", _deflection)
    return found


def _deflection(contact: ContactSeries) -> Series:
    assert contact.deflection is not None  # the law has a state
    return contact.deflection


def _of_load(name: str, load: Load) -> Recipes:
    def said(what: str, channel: Observed) -> Recipe:
        return Recipe(channel.unit, channel.meaning, LOADED, lambda seen: seen.run.loads[name].observed[what])

    return {f"{name}.{what}": said(what, channel) for what, channel in load.channels.items()}


def _stored(loose: bool, oil: bool, loaded: bool) -> Part:
    """What the elastic energy needs."""
    found = Part.NOTHING
    for there, part in ((loose, CONTACT), (oil, OIL), (loaded, LOADED)):
        found |= part if there else Part.NOTHING
    return found


def _of_energy(stored: Part, loaded: bool, pumped: bool) -> Recipes:
    movers = ["the drive" if not loaded else "the drives"] + ["pumps"] * pumped + ["what moves loads"] * loaded
    lost = "damping" + " and valves" * pumped
    places = "contacts, oil and loads" if loaded else "contacts and oil"
    integrals = Part.INTEGRALS
    balance = MOTION | stored | integrals
    return {
        "energy.kinetic": Recipe("J", "kinetic energy of all bodies", Part.VELOCITY, lambda seen: seen.kinetic),
        "energy.potential": Recipe(
            "J", "of weight, zero in the machine's start posture", Part.POSITION, lambda seen: seen.potential
        ),
        "energy.elastic": Recipe("J", f"stored in {places}", stored, lambda seen: seen.stored),
        "energy.damping_loss": Recipe(
            "J",
            f"dissipated by {lost} in {places} so far",
            integrals,
            lambda seen: seen.run.damping_loss,
        ),
        "energy.friction_loss": Recipe(
            "J", "dissipated by friction so far", integrals, lambda seen: seen.run.friction_loss
        ),
        "energy.work": Recipe(
            "J",
            f"work of {' and of '.join(movers)} so far",
            integrals,
            lambda seen: seen.run.work,
        ),
        "energy.balance": Recipe(
            "J", "gain minus work plus loss; zero if computed exactly", balance, lambda seen: seen.balance
        ),
    }
