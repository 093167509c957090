"""From a planar linkage and its lateral dimensions to the same machine in space.

Symmetric about the plane z = 0. What the plane lumps from two (front links, actuators) is two again, called
NAME_left (z < 0) and NAME_right, each with half the mass, stiffness and piston area. A body of a pair is held
along z and against tilting by its first pin; in its others it may shift along the pin. Actuators stand on
spherical ends, also those in two bodies, whose rod may slide and turn in its cylinder.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import field, fields
from typing import Literal

from support_exudyn.model.linkage import Linkage
from support_exudyn.model.spatial_linkage import (
    Bearing,
    SpatialActuator,
    SpatialBody,
    SpatialLinkage,
    SpatialPoint,
)
from user_forces.values.units import Metres
from user_forces.values.value import InputError, NonNegative, Positive, Value, Vector2, Vector3, value


@value
class Width(Value):
    """Lateral dimensions of a machine that is symmetric about its plane.

    Arguments:
        spreads: by body, the radius of gyration about the plane of symmetry [m] (of a body of uniform width b:
            b / sqrt(12)); of a body that there are two of, about the plane of each. 0 where none is given.
        pairs: by body, half the distance [m] of the two that it stands for in the plane.
        actuators: by actuator, half the distance [m] of the two that it stands for.
        lengths: by pin, its length [m]; of a pin of a pair, of each. 0 where none is given.
        points: by traced point, half the distance [m] of two more of it, left and right.
    """

    spreads: Mapping[str, Metres[NonNegative]] = field(default_factory=dict)
    pairs: Mapping[str, Metres[Positive]] = field(default_factory=dict)
    actuators: Mapping[str, Metres[Positive]] = field(default_factory=dict)
    lengths: Mapping[str, Metres[Positive]] = field(default_factory=dict)
    points: Mapping[str, Metres[Positive]] = field(default_factory=dict)

    def scaled(self, factor: float) -> Width:
        """The dimensions of the machine, larger by a factor."""
        return Width(
            **{
                one.name: {name: factor * length for name, length in getattr(self, one.name).items()}
                for one in fields(self)
            }
        )


FILE_KEYS = {  # by field of `Width`: the table in a machine's file
    "spreads": "width_mm.bodies",
    "pairs": "width_mm.pairs",
    "actuators": "width_mm.columns",
    "lengths": "width_mm.pins",
    "points": "width_mm.points",
}
LEFT, RIGHT = "left", "right"
SIDES = {LEFT: -1.0, RIGHT: 1.0}
Copy = tuple[str, float, float]  # suffix of its name, z [m], share


def lift(linkage: Linkage, width: Width) -> SpatialLinkage:
    """The machine in space.

    Raises InputError if the linkage has cranks, or guides other than those of actuators, or a body has no
    width.
    """
    pairs = pairs_of(linkage, width)
    _check(linkage, width, pairs)
    bodies, actuators, points = {}, {}, {}
    for name, body in linkage.bodies.items():
        xx, yy, xy = body.moments or (0.5 * body.inertia, 0.5 * body.inertia, 0.0)
        zz = body.mass * width.spreads[name] ** 2
        for side, z, share in copies(pairs.get(name)):
            bodies[name + side] = SpatialBody(
                mass=share * body.mass,
                inertia=(share * (yy + zz), share * (xx + zz), share * body.inertia, 0.0, 0.0, -share * xy),
                centre=at(body.centre, z),
                angle=body.angle,
                velocity=at(body.velocity, 0.0),
                spin=(0.0, 0.0, body.spin),
            )
    for name, actuator in linkage.actuators.items():
        for side, z, share in copies(width.actuators.get(name)):
            actuators[name + side] = SpatialActuator(
                foot=actuator.foot + side * (actuator.foot in pairs),
                head=actuator.head + side * (actuator.head in pairs),
                foot_point=at(actuator.foot_point, z),
                head_point=at(actuator.head_point, z),
                actuator=name,
                share=share,
            )
    for name, traced in linkage.points.items():
        places = [("", 0.0, 1.0), *(copies(width.points[name]) if name in width.points else [])]
        for side, z, _ in places:
            points[name + side] = SpatialPoint(body=traced.body, point=at(traced.point, z))
    bearings = {name: one for pin in linkage.pins for name, one in _bearings(linkage, width, pairs, pin)}
    for name, slide in linkage.slides.items():  # the rod of an actuator in its cylinder
        axis = (math.cos(slide.direction), math.sin(slide.direction), 0.0)
        for side, z, share in copies(pairs[slide.body]):
            bearings[name + side] = Bearing(
                first=slide.against + side,
                second=slide.body + side,
                first_point=at(slide.point, z),
                second_point=at(slide.point, z),
                first_axis=axis,
                second_axis=axis,
                holds=frozenset({"tilt"}),
                pin=name,
                share=share,
                is_guide=True,
            )
    return SpatialLinkage(bodies=bodies, bearings=bearings, actuators=actuators, points=points)


def pairs_of(linkage: Linkage, width: Width) -> dict[str, float]:
    """Half the distance of all bodies that there are two of: those that are named, and those of actuators."""
    found = dict(width.pairs)
    for slide in linkage.slides.values():
        for name, actuator in linkage.actuators.items():
            if name in width.actuators and {actuator.foot, actuator.head} == {slide.against, slide.body}:
                found[slide.against] = found[slide.body] = width.actuators[name]
    return found


def copies(half_distance: float | None) -> list[Copy]:
    """One in the middle, or two at both sides."""
    if half_distance is None:
        return [("", 0.0, 1.0)]
    return [(f"_{side}", sign * half_distance, 0.5) for side, sign in SIDES.items()]


def _check(linkage: Linkage, width: Width, pairs: Mapping[str, float]) -> None:
    for name in linkage.cranks:
        raise InputError(f"cranks.{name}: not covered in space; allowed: pins and actuators")
    for name in linkage.gears:
        raise InputError(f"gears.{name}: not covered in space; allowed: none")
    for name, slide in linkage.slides.items():
        if slide.body not in pairs or slide.against not in pairs:
            raise InputError(f"slides.{name}: not covered in space; allowed: guides of actuators in two bodies")
    for name in linkage.bodies:
        if width.spreads.get(name, 0.0) <= 0.0:
            raise InputError(
                f"width.spreads.{name}: missing; in a machine's file: {FILE_KEYS['spreads']}.{name}; allowed: "
                "> 0, without which nothing resists its roll"
            )
    for name, actuator in linkage.actuators.items():
        for body in (actuator.foot, actuator.head):
            if body in width.pairs and name not in width.actuators:
                raise InputError(
                    f"actuators.{name} on {body}, which is a pair: not covered; allowed: single bodies"
                )
    for name, traced in linkage.points.items():
        if traced.body in width.pairs:
            raise InputError(
                f"points.{name} on {traced.body}, which is a pair: not covered; allowed: single bodies"
            )


def at(point: Vector2, z: float) -> Vector3:
    """A point of the plane, beside it [m]."""
    return point[0], point[1], z


def _bearings(
    linkage: Linkage, width: Width, pairs: Mapping[str, float], name: str
) -> Iterator[tuple[str, Bearing]]:
    """The bearings of a pin, one or two; pairs: of `pairs_of`."""
    place = linkage.pins[name]
    paired = [body for body in (place.first, place.second) if body in pairs]
    distances = {pairs[body] for body in paired}
    if len(distances) > 1:
        raise InputError(
            f"pins.{name}: joins pairs {' and '.join(paired)} at different distances; allowed: one"
        )
    in_actuators = {body for slide in linkage.slides.values() for body in (slide.against, slide.body)}
    # the first pin of a body of a pair holds it sideways
    first_pins = {body: key for key, pin in reversed(list(linkage.pins.items())) for body, _ in pin.sides}
    holds: frozenset[Literal["tilt", "along", "turn"]] = frozenset({"tilt", "along"})
    if in_actuators & {*paired}:
        holds = frozenset({"along"})
    elif any(first_pins[body] != name for body in paired):
        holds = frozenset()
    for side, z, share in copies(distances.pop() if paired else None):
        yield (
            name + side,
            Bearing(
                first=place.first + side * (place.first in paired),
                second=place.second + side * (place.second in paired),
                first_point=at(place.first_point, z),
                second_point=at(place.second_point, z),
                length=width.lengths.get(name, 0.0),
                holds=holds,
                pin=name,
                share=share,
            ),
        )
