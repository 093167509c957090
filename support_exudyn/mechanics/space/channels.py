"""Channels of a run in space by name, see `mechanics.channels`.

Names are those of the plane where they mean the same. A pin or actuator that there are two of has the channels
of each, and under the planar name the force of both, and the mean of lengths and angles.
"""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any, Protocol

import numpy as np

from support_exudyn.mechanics.acting_loads import load_channels
from support_exudyn.mechanics.block_contact import block_channels
from support_exudyn.mechanics.channels import (
    CONTACT,
    MOTION,
    OIL,
    ChannelDefinition,
    ChannelDefinitions,
    DataNeeds,
)
from support_exudyn.mechanics.space.determined import UNDETERMINED, Loads
from support_exudyn.mechanics.space.motion import SpatialMotion
from support_exudyn.mechanics.trajectory import ContactSeries, LoadSeries, Series
from support_exudyn.model.loads.load import ActingLoad
from support_exudyn.model.spatial_linkage import SpatialBody, SpatialLinkage

REACTION = CONTACT | OIL  # they and accelerations follow from the motion and what is applied
AXES = ("x", "y", "z")
TOWARDS = ("forward", "up", "to the right")


class SectionContext(Protocol):
    """A section of a clearance bearing over time."""

    @property
    def eccentricity(self) -> tuple[Series, Series]:
        """The journal's centre from the bore's, along both axes across (n,) [m]."""

    @property
    def contact(self) -> ContactSeries:
        """Depths and forces of its contact."""


class SpatialContext(Protocol):
    """A run in space at its records, shape (n, ...), from which channels are computed."""

    @property
    def motion(self) -> SpatialMotion:
        """The motion of all bodies."""

    @property
    def accelerations(self) -> Series:
        """Accelerations of the centres and rates of the spins of all bodies (n, b, 6) [m/s^2], [rad/s^2]."""

    @property
    def sections(self) -> Mapping[str, Sequence[SectionContext]]:
        """The sections of every clearance bearing."""

    @property
    def loads(self) -> Mapping[str, tuple[Series, Series]]:
        """Force and moment in every bearing, of the first body on the second (n, 3) [N], [N m]."""

    def actuator_force(self, name: str) -> Series:
        """The force that pushes an actuator's ends apart (n,) [N]."""

    @property
    def acting(self) -> Mapping[str, LoadSeries]:
        """What acts on the machine besides its weight."""

    @property
    def faces(self) -> Mapping[str, ContactSeries]:
        """The contacts of falling blocks."""

    def span(self, actuator: str) -> tuple[Series, Series]:
        """The vector from foot to head of an actuator (n, 3) [m], and its rate."""


def channel_definitions(
    linkage: SpatialLinkage,
    with_clearance: Collection[str],
    oil: Collection[str],
    acting: Mapping[str, ActingLoad] = MappingProxyType({}),
    blocks: Collection[str] = (),
) -> ChannelDefinitions:
    """All channels of a linkage in which these planar pins are with clearance, and these actuators on oil.

    acting: what acts on it besides its weight, by name. blocks: names of those that fall on it.
    The meaning of loads that rigid bodies do not determine says so.
    """
    loads = Loads(linkage, with_clearance, oil)
    found: ChannelDefinitions = {
        "time": ChannelDefinition("s", "time", DataNeeds.NOTHING, lambda context: context.time)
    }
    for n, (name, body) in enumerate(linkage.bodies.items()):
        found |= _of_body(name, body, n)
    for name in linkage.points:
        found |= _of_point(name)
    for name, actuator in linkage.actuators.items():
        found |= _said(_of_actuator(name, actuator.actuator in oil), ".force", loads.actuators([name]))
    for whole in dict.fromkeys(actuator.actuator for actuator in linkage.actuators.values()):
        parts = linkage.parts_of_actuator(whole)
        if parts != (whole,):
            found |= _said(_of_pair(whole, parts, found), ".force", loads.actuators(parts))
    for name, bearing in linkage.bearings.items():
        channels = _of_guide(name) if bearing.is_guide else _of_bearing(name, bearing.pin in with_clearance)
        channels = _said(channels, ".force", loads.forces([name]))
        found |= _said(channels, ".moment", loads.moment(name))
    for pin in dict.fromkeys(b.pin for b in linkage.bearings.values() if not b.is_guide):
        parts = tuple(linkage.parts_of_pin(pin))
        if parts != (pin,):
            together = _forces(f"pin.{pin}", REACTION, _sum_of_bearings(parts))
            found |= _said(together, ".force", loads.forces(parts))
    for name, load in acting.items():
        found |= load_channels(name, load)
    for name in blocks:
        found |= block_channels(name, lambda context: context.faces)
    return found | _of_energy(bool(acting))


def _said(channels: ChannelDefinitions, what: str, determined: bool) -> ChannelDefinitions:
    """Channels, those whose names go on with `what` marked if rigid bodies do not determine them."""
    if determined:
        return channels
    return {
        name: replace(one, meaning=one.meaning + UNDETERMINED) if what in name else one
        for name, one in channels.items()
    }


def _of_body(name: str, body: SpatialBody, n: int) -> ChannelDefinitions:
    found: ChannelDefinitions = {}
    for k, (axis, towards) in enumerate(zip(AXES, TOWARDS, strict=True)):
        found |= {
            f"{name}.{axis}": _definition(
                "m", f"centre of mass, {towards}", DataNeeds.POSITION, _place_of(n, k, body.centre[k])
            ),
            f"{name}.velocity_{axis}": _definition(
                "m/s", f"velocity of the centre of mass, {towards}", MOTION, _entry("velocity", n, k)
            ),
        }
    turned = DataNeeds.POSITION
    return found | {
        f"{name}.angle": _definition(
            "rad", "orientation about z from +x", turned, lambda context: body.angle + _turn(context, n, 1, 0)
        ),
        f"{name}.roll": _definition(
            "rad", "turn about x, the right side down", turned, lambda context: _turn(context, n, 2, 1)
        ),
        f"{name}.yaw": _definition(
            "rad", "turn about y, to the left", turned, lambda context: _turn(context, n, 0, 2)
        ),
        f"{name}.angular_velocity": _definition(
            "rad/s", "angular velocity about z", MOTION, _entry("spin", n, 2)
        ),
        f"{name}.angular_velocity_x": _definition(
            "rad/s", "angular velocity about x", MOTION, _entry("spin", n, 0)
        ),
        f"{name}.angular_velocity_y": _definition(
            "rad/s", "angular velocity about y", MOTION, _entry("spin", n, 1)
        ),
        f"{name}.angular_acceleration": _definition(
            "rad/s^2", "angular acceleration about z", REACTION, lambda context: context.accelerations[:, n, 5]
        ),
    }


def _definition(
    unit: str, meaning: str, needs: DataNeeds, values: Callable[[SpatialContext], Series]
) -> ChannelDefinition:
    return ChannelDefinition(unit, meaning, needs, values)


def _place_of(n: int, k: int, start: float) -> Callable[[SpatialContext], Series]:
    return lambda context: start + context.motion.displacement[:, n, k]


def _entry(what: str, n: int, k: int) -> Callable[[SpatialContext], Series]:
    return lambda context: np.asarray(getattr(context.motion, what)[:, n, k])


def _turn(context: SpatialContext, n: int, row: int, column: int) -> Series:
    """Angle by which an axis of the body has turned towards another of the ground (n,) [rad]."""
    turn = context.motion.turn[:, n]
    return np.asarray(np.unwrap(np.arctan2(turn[:, row, column], turn[:, column, column])))


def _of_point(name: str) -> ChannelDefinitions:
    def path(k: int) -> Callable[[SpatialContext], Series]:
        def place(context: SpatialContext) -> Series:
            point = context.motion.linkage.points[name]
            return context.motion.point(point.body, point.point).position[:, k]

        return place

    return {
        f"{name}.{axis}": _definition("m", f"position, {towards}", DataNeeds.POSITION, path(k))
        for k, (axis, towards) in enumerate(zip(AXES, TOWARDS, strict=True))
    }


def _of_actuator(name: str, oil: bool) -> ChannelDefinitions:
    def angle(context: SpatialContext) -> Series:
        apart, _ = context.span(name)
        return np.asarray(np.arctan2(apart[:, 1], apart[:, 0]))

    def length(context: SpatialContext) -> Series:
        return np.asarray(np.linalg.norm(context.span(name)[0], axis=1))

    return {
        f"{name}.angle": _definition(
            "rad", "direction from foot to head in the plane, from +x", DataNeeds.POSITION, angle
        ),
        f"{name}.length": _definition("m", "distance of its ends", DataNeeds.POSITION, length),
        f"{name}.force": _definition(
            "N",
            "pushes its ends apart if positive",
            OIL if oil else REACTION,
            lambda context: context.actuator_force(name),
        ),
    }


def _of_pair(whole: str, parts: Iterable[str], known: ChannelDefinitions) -> ChannelDefinitions:
    """The channels of a pair of actuators, from those of each."""

    def together(what: str, unite: Callable[..., Series], said: str) -> ChannelDefinitions:
        each = [known[f"{part}.{what}"] for part in parts]
        return {
            f"{whole}.{what}": ChannelDefinition(
                each[0].unit,
                said,
                each[0].needs,
                lambda context: unite([one.values(context) for one in each], axis=0),
            )
        }

    return (
        together("angle", np.mean, "direction from foot to head, mean of both")
        | together("length", np.mean, "distance of its ends, mean of both")
        | together("force", np.sum, "pushes its ends apart if positive, both together")
    )


def _sum_of_bearings(parts: Iterable[str]) -> Callable[[SpatialContext], Series]:
    def force(context: SpatialContext) -> Series:
        return np.asarray(np.sum([context.loads[part][0] for part in parts], axis=0))

    return force


def _forces(prefix: str, needs: DataNeeds, force: Callable[[SpatialContext], Series]) -> ChannelDefinitions:
    """The channels of a pin's force; force: of the first body on the second (n, 3) [N]."""
    found = {
        f"{prefix}.force": _definition(
            "N", "magnitude of the pin force", needs, lambda context: np.linalg.norm(force(context), axis=1)
        )
    }
    for k, (axis, towards) in enumerate(zip(AXES, TOWARDS, strict=True)):
        found[f"{prefix}.force_{axis}"] = _definition(
            "N", f"force of the first body on the second, {towards}", needs, _component(force, k)
        )
    return found


def _of_guide(name: str) -> ChannelDefinitions:
    def magnitude(which: int) -> Callable[[SpatialContext], Series]:
        return lambda context: np.asarray(np.linalg.norm(context.loads[name][which], axis=1))

    return {
        f"{name}.force": _definition("N", "magnitude of the guide's force, across it", REACTION, magnitude(0)),
        f"{name}.moment": _definition("N m", "magnitude of the guide's moment", REACTION, magnitude(1)),
    }


def _component(vector: Callable[[SpatialContext], Series], k: int) -> Callable[[SpatialContext], Series]:
    return lambda context: vector(context)[:, k]


def _of_bearing(name: str, with_clearance: bool) -> ChannelDefinitions:
    prefix = f"pin.{name}"
    found = _forces(prefix, REACTION, lambda context: context.loads[name][0])
    for k, axis in enumerate(AXES[:2]):
        found[f"{prefix}.moment_{axis}"] = _definition(
            "N m",
            f"of the first body on the second about {axis} through the middle of the bearing",
            REACTION,
            _component(lambda context: context.loads[name][1], k),
        )
    return found | _of_clearance(name) if with_clearance else found


def _of_clearance(name: str) -> ChannelDefinitions:
    prefix = f"pin.{name}"

    def said(
        what: str,
        unit: str,
        meaning: str,
        values: Callable[[Sequence[SectionContext]], Series],
        needs: DataNeeds = CONTACT,
    ) -> ChannelDefinitions:
        return {
            f"{prefix}.{what}": _definition(
                unit, meaning, needs, lambda context: values(context.sections[name])
            )
        }

    found = said("normal_force", "N", "normal contact forces of all sections", _sum("normal_force"))
    found |= said("friction_force", "N", "friction of all sections, on the journal", _sum("friction_force"))
    found |= said("slip", "m/s", "slip of the journal's surface, along t, mean of the sections", _mean_slip)
    found |= said(
        "impact_velocity",
        "m/s",
        "impact velocity that the laws are told, largest of the sections; 0 apart",
        _speed,
    )
    found |= said("depth", "m", "depth where it is largest; negative: gap", _deepest)
    for place, edge, side in ((0, "left", "at the left edge"), (-1, "right", "at the right edge")):
        found |= said(f"{edge}_depth", "m", f"depth {side}; negative: gap", _of_section("depth", place))
        found |= said(
            f"{edge}_eccentricity_x",
            "m",
            f"journal's centre from the bore's {side}, first axis across",
            _x(place),
        )
        found |= said(
            f"{edge}_eccentricity_y",
            "m",
            f"journal's centre from the bore's {side}, second axis across",
            _y(place),
        )
    found |= said("eccentricity_x", "m", "journal's middle from the bore's, first axis across", _middle(_x))
    found |= said("eccentricity_y", "m", "journal's middle from the bore's, second axis across", _middle(_y))
    return found


def _sum(what: str) -> Callable[[Sequence[SectionContext]], Series]:
    return lambda sections: np.asarray(np.sum([getattr(s.contact, what) for s in sections], axis=0))


def _mean_slip(sections: Sequence[SectionContext]) -> Series:
    return np.asarray(np.mean([s.contact.slip for s in sections], axis=0))


def _speed(sections: Sequence[SectionContext]) -> Series:
    return np.asarray(np.max([s.contact.impact_velocity for s in sections], axis=0))


def _deepest(sections: Sequence[SectionContext]) -> Series:
    return np.asarray(np.max([s.contact.depth for s in sections], axis=0))


def _of_section(what: str, place: int) -> Callable[[Sequence[SectionContext]], Series]:
    return lambda sections: np.asarray(getattr(sections[place].contact, what))


def _x(place: int) -> Callable[[Sequence[SectionContext]], Series]:
    return lambda sections: sections[place].eccentricity[0]


def _y(place: int) -> Callable[[Sequence[SectionContext]], Series]:
    return lambda sections: sections[place].eccentricity[1]


def _middle(
    axis: Callable[[int], Callable[[Sequence[SectionContext]], Series]],
) -> Callable[[Sequence[SectionContext]], Series]:
    """The journal is straight: its middle is between its edges."""
    return lambda sections: 0.5 * (axis(0)(sections) + axis(-1)(sections))


def _of_energy(loaded: bool) -> ChannelDefinitions:
    integrals = DataNeeds.INTEGRALS
    stored = CONTACT | OIL
    places = "contacts, oil and loads" if loaded else "contacts and oil"
    movers = "drives and of what moves loads" if loaded else "drive"

    def known(what: str) -> Callable[[SpatialContext], Series]:
        return lambda context: np.asarray(getattr(context, what))

    table: dict[str, tuple[str, DataNeeds, Any]] = {
        "kinetic": ("kinetic energy of all bodies", MOTION, known("kinetic")),
        "potential": ("of weight, zero in the machine's start posture", DataNeeds.POSITION, known("potential")),
        "elastic": (f"stored in {places}", stored, known("stored")),
        "damping_loss": (f"dissipated by damping in {places} so far", integrals, known("damping_loss")),
        "friction_loss": ("dissipated by friction so far", integrals, known("friction_loss")),
        "work": (f"work of the {movers} so far", integrals, known("work")),
        "balance": (
            "gain minus work plus loss; zero if computed exactly",
            stored | integrals,
            known("balance"),
        ),
    }
    return {f"energy.{name}": ChannelDefinition("J", *parts) for name, parts in table.items()}
