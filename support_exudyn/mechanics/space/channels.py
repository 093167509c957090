"""Channels of a run in space by name, see `mechanics.channels`.

Names are those of the plane where they mean the same. A pin or column that there are two of has the channels of
each, and under the planar name the force of both, and the mean of lengths and angles.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from support_exudyn.mechanics.channels import CONTACT, MOTION, OIL, Part, Recipe, Recipes
from support_exudyn.mechanics.space.determined import UNDETERMINED, Loads
from support_exudyn.mechanics.space.motion import SpatialMotion
from support_exudyn.mechanics.trajectory import ContactSeries, Series
from support_exudyn.model.spatial_linkage import SpatialBody, SpatialLinkage

REACTION = CONTACT | OIL  # they and accelerations follow from the motion and what is applied
AXES = ("x", "y", "z")
TOWARDS = ("forward", "up", "to the right")


class SectionSeries(Protocol):
    """A section of a clearance bearing over time."""

    @property
    def eccentricity(self) -> tuple[Series, Series]:
        """The journal's centre from the bore's, along both axes across (n,) [m]."""

    @property
    def contact(self) -> ContactSeries:
        """Depths and forces of its contact."""


class Observation(Protocol):
    """A run in space at its records, shape (n, ...), from which channels are computed."""

    @property
    def motion(self) -> SpatialMotion:
        """The motion of all bodies."""

    @property
    def accelerations(self) -> Series:
        """Accelerations of the centres and rates of the spins of all bodies (n, b, 6) [m/s^2], [rad/s^2]."""

    @property
    def sections(self) -> Mapping[str, Sequence[SectionSeries]]:
        """The sections of every clearance bearing."""

    @property
    def loads(self) -> Mapping[str, tuple[Series, Series]]:
        """Force and moment in every bearing, of the first body on the second (n, 3) [N], [N m]."""

    def column_force(self, name: str) -> Series:
        """The force that pushes a column's ends apart (n,) [N]."""

    def span(self, column: str) -> tuple[Series, Series]:
        """The vector from foot to head of a column (n, 3) [m], and its rate."""


def recipes(linkage: SpatialLinkage, loose: Collection[str], oil: Collection[str]) -> Recipes:
    """All channels of a linkage in which these planar pins are loose and these planar columns on oil.

    The meaning of loads that rigid bodies do not determine says so.
    """
    loads = Loads(linkage, loose, oil)
    found: Recipes = {"time": Recipe("s", "time", Part.NOTHING, lambda seen: seen.time)}
    for n, (name, body) in enumerate(linkage.bodies.items()):
        found |= _of_body(name, body, n)
    for name in linkage.points:
        found |= _of_point(name)
    for name, column in linkage.columns.items():
        found |= _said(_of_column(name, column.column in oil), ".force", loads.columns([name]))
    for whole in dict.fromkeys(column.column for column in linkage.columns.values()):
        parts = linkage.parts_of_column(whole)
        if parts != (whole,):
            found |= _said(_of_pair(whole, parts, found), ".force", loads.columns(parts))
    for name, bearing in linkage.bearings.items():
        channels = _of_guide(name) if bearing.is_guide else _of_bearing(name, bearing.pin in loose)
        channels = _said(channels, ".force", loads.forces([name]))
        found |= _said(channels, ".moment", loads.moment(name))
    for pin in dict.fromkeys(b.pin for b in linkage.bearings.values() if not b.is_guide):
        parts = tuple(linkage.parts_of_pin(pin))
        if parts != (pin,):
            together = _forces(f"pin.{pin}", REACTION, _sum_of_bearings(parts))
            found |= _said(together, ".force", loads.forces(parts))
    return found | _of_energy()


def _said(channels: Recipes, what: str, determined: bool) -> Recipes:
    """Channels, those whose names go on with `what` marked if rigid bodies do not determine them."""
    if determined:
        return channels
    return {
        name: replace(one, meaning=one.meaning + UNDETERMINED) if what in name else one
        for name, one in channels.items()
    }


def _of_body(name: str, body: SpatialBody, n: int) -> Recipes:
    found: Recipes = {}
    for k, (axis, towards) in enumerate(zip(AXES, TOWARDS, strict=True)):
        found |= {
            f"{name}.{axis}": _recipe(
                "m", f"centre of mass, {towards}", Part.POSITION, _place_of(n, k, body.centre[k])
            ),
            f"{name}.velocity_{axis}": _recipe(
                "m/s", f"velocity of the centre of mass, {towards}", MOTION, _entry("velocity", n, k)
            ),
        }
    turned = Part.POSITION
    return found | {
        f"{name}.angle": _recipe(
            "rad", "orientation about z from +x", turned, lambda seen: body.angle + _turn(seen, n, 1, 0)
        ),
        f"{name}.roll": _recipe(
            "rad", "turn about x, the right side down", turned, lambda seen: _turn(seen, n, 2, 1)
        ),
        f"{name}.yaw": _recipe("rad", "turn about y, to the left", turned, lambda seen: _turn(seen, n, 0, 2)),
        f"{name}.angular_velocity": _recipe("rad/s", "angular velocity about z", MOTION, _entry("spin", n, 2)),
        f"{name}.angular_velocity_x": _recipe(
            "rad/s", "angular velocity about x", MOTION, _entry("spin", n, 0)
        ),
        f"{name}.angular_velocity_y": _recipe(
            "rad/s", "angular velocity about y", MOTION, _entry("spin", n, 1)
        ),
        f"{name}.angular_acceleration": _recipe(
            "rad/s^2", "angular acceleration about z", REACTION, lambda seen: seen.accelerations[:, n, 5]
        ),
    }


def _recipe(unit: str, meaning: str, needs: Part, values: Callable[[Observation], Series]) -> Recipe:
    return Recipe(unit, meaning, needs, values)


def _place_of(n: int, k: int, start: float) -> Callable[[Observation], Series]:
    return lambda seen: start + seen.motion.displacement[:, n, k]


def _entry(what: str, n: int, k: int) -> Callable[[Observation], Series]:
    return lambda seen: np.asarray(getattr(seen.motion, what)[:, n, k])


def _turn(seen: Observation, n: int, row: int, column: int) -> Series:
    """Angle by which an axis of the body has turned towards another of the ground (n,) [rad]."""
    turn = seen.motion.turn[:, n]
    return np.asarray(np.unwrap(np.arctan2(turn[:, row, column], turn[:, column, column])))


def _of_point(name: str) -> Recipes:
    def path(k: int) -> Callable[[Observation], Series]:
        def place(seen: Observation) -> Series:
            point = seen.motion.linkage.points[name]
            return seen.motion.point(point.body, point.point).position[:, k]

        return place

    return {
        f"{name}.{axis}": _recipe("m", f"position, {towards}", Part.POSITION, path(k))
        for k, (axis, towards) in enumerate(zip(AXES, TOWARDS, strict=True))
    }


def _of_column(name: str, oil: bool) -> Recipes:
    def angle(seen: Observation) -> Series:
        apart, _ = seen.span(name)
        return np.asarray(np.arctan2(apart[:, 1], apart[:, 0]))

    def length(seen: Observation) -> Series:
        return np.asarray(np.linalg.norm(seen.span(name)[0], axis=1))

    return {
        f"{name}.angle": _recipe(
            "rad", "direction from foot to head in the plane, from +x", Part.POSITION, angle
        ),
        f"{name}.length": _recipe("m", "distance of its ends", Part.POSITION, length),
        f"{name}.force": _recipe(
            "N",
            "pushes its ends apart if positive",
            OIL if oil else REACTION,
            lambda seen: seen.column_force(name),
        ),
    }


def _of_pair(whole: str, parts: Iterable[str], known: Recipes) -> Recipes:
    """The channels of a pair of columns, from those of each."""

    def together(what: str, unite: Callable[..., Series], said: str) -> Recipes:
        each = [known[f"{part}.{what}"] for part in parts]
        return {
            f"{whole}.{what}": Recipe(
                each[0].unit,
                said,
                each[0].needs,
                lambda seen: unite([one.values(seen) for one in each], axis=0),
            )
        }

    return (
        together("angle", np.mean, "direction from foot to head, mean of both")
        | together("length", np.mean, "distance of its ends, mean of both")
        | together("force", np.sum, "pushes its ends apart if positive, both together")
    )


def _sum_of_bearings(parts: Iterable[str]) -> Callable[[Observation], Series]:
    def force(seen: Observation) -> Series:
        return np.asarray(np.sum([seen.loads[part][0] for part in parts], axis=0))

    return force


def _forces(prefix: str, needs: Part, force: Callable[[Observation], Series]) -> Recipes:
    """The channels of a pin's force; force: of the first body on the second (n, 3) [N]."""
    found = {
        f"{prefix}.force": _recipe(
            "N", "magnitude of the pin force", needs, lambda seen: np.linalg.norm(force(seen), axis=1)
        )
    }
    for k, (axis, towards) in enumerate(zip(AXES, TOWARDS, strict=True)):
        found[f"{prefix}.force_{axis}"] = _recipe(
            "N", f"force of the first body on the second, {towards}", needs, _component(force, k)
        )
    return found


def _of_guide(name: str) -> Recipes:
    def magnitude(which: int) -> Callable[[Observation], Series]:
        return lambda seen: np.asarray(np.linalg.norm(seen.loads[name][which], axis=1))

    return {
        f"{name}.force": _recipe("N", "magnitude of the guide's force, across it", REACTION, magnitude(0)),
        f"{name}.moment": _recipe("N m", "magnitude of the guide's moment", REACTION, magnitude(1)),
    }


def _component(vector: Callable[[Observation], Series], k: int) -> Callable[[Observation], Series]:
    return lambda seen: vector(seen)[:, k]


def _of_bearing(name: str, loose: bool) -> Recipes:
    prefix = f"pin.{name}"
    found = _forces(prefix, REACTION, lambda seen: seen.loads[name][0])
    for k, axis in enumerate(AXES[:2]):
        found[f"{prefix}.moment_{axis}"] = _recipe(
            "N m",
            f"of the first body on the second about {axis} through the middle of the bearing",
            REACTION,
            _component(lambda seen: seen.loads[name][1], k),
        )
    return found | _of_loose(name) if loose else found


def _of_loose(name: str) -> Recipes:
    prefix = f"pin.{name}"

    def said(
        what: str,
        unit: str,
        meaning: str,
        values: Callable[[Sequence[SectionSeries]], Series],
        needs: Part = CONTACT,
    ) -> Recipes:
        return {f"{prefix}.{what}": _recipe(unit, meaning, needs, lambda seen: values(seen.sections[name]))}

    found = said("normal_force", "N", "normal contact forces of all sections", _sum("normal_force"))
    found |= said("friction_force", "N", "friction of all sections, on the journal", _sum("friction_force"))
    found |= said("slip", "m/s", "slip of the journal's surface, along t, mean of the sections", _mean_slip)
    found |= said(
        "approach_speed", "m/s", "touch speed that the laws are told, largest of the sections; 0 apart", _speed
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


def _sum(what: str) -> Callable[[Sequence[SectionSeries]], Series]:
    return lambda sections: np.asarray(np.sum([getattr(s.contact, what) for s in sections], axis=0))


def _mean_slip(sections: Sequence[SectionSeries]) -> Series:
    return np.asarray(np.mean([s.contact.slip for s in sections], axis=0))


def _speed(sections: Sequence[SectionSeries]) -> Series:
    return np.asarray(np.max([s.contact.approach_speed for s in sections], axis=0))


def _deepest(sections: Sequence[SectionSeries]) -> Series:
    return np.asarray(np.max([s.contact.depth for s in sections], axis=0))


def _of_section(what: str, place: int) -> Callable[[Sequence[SectionSeries]], Series]:
    return lambda sections: np.asarray(getattr(sections[place].contact, what))


def _x(place: int) -> Callable[[Sequence[SectionSeries]], Series]:
    return lambda sections: sections[place].eccentricity[0]


def _y(place: int) -> Callable[[Sequence[SectionSeries]], Series]:
    return lambda sections: sections[place].eccentricity[1]


def _middle(
    axis: Callable[[int], Callable[[Sequence[SectionSeries]], Series]],
) -> Callable[[Sequence[SectionSeries]], Series]:
    """The journal is straight: its middle is between its edges."""
    return lambda sections: 0.5 * (axis(0)(sections) + axis(-1)(sections))


def _of_energy() -> Recipes:
    integrals = Part.INTEGRALS
    stored = CONTACT | OIL

    def known(what: str) -> Callable[[Observation], Series]:
        return lambda seen: np.asarray(getattr(seen, what))

    table: dict[str, tuple[str, Part, Any]] = {
        "kinetic": ("kinetic energy of all bodies", MOTION, known("kinetic")),
        "potential": ("of weight, zero in the machine's start posture", Part.POSITION, known("potential")),
        "elastic": ("stored in contacts and oil", stored, known("stored")),
        "damping_loss": ("dissipated by damping in contacts and oil so far", integrals, known("damping_loss")),
        "friction_loss": ("dissipated by friction so far", integrals, known("friction_loss")),
        "work": ("work of the drive so far", integrals, known("work")),
        "balance": (
            "gain minus work plus loss; zero if computed exactly",
            stored | integrals,
            known("balance"),
        ),
    }
    return {f"energy.{name}": Recipe("J", *parts) for name, parts in table.items()}
