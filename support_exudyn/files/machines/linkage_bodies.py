"""Bodies of linkages in files: points, mass, and where the drawing puts them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from support_exudyn.files.machines.parts import PartData, check_known
from support_exudyn.model.linkage import GROUND, Body, Part, bar, lumped, turned_moments
from support_exudyn.model.plane_geometry import direction, distance, minus, plus, rotated
from user_forces.values.units import Kilograms, KilogramSquareMetres, Metres
from user_forces.values.value import InputError, NonNegative, Positive, Value, Vector2, value


@value
class LinkageBodyData(Value):
    """A body of a linkage.

    A body with a `bar` of a given `length`, or with `points`, has a frame of its own, and the drawing says
    roughly where it lies. Any other body is as it is drawn: its points, centre and parts are those of the
    drawing.

    Arguments:
        mass: [kg], > 0; may be left out if there are parts.
        bar: two points of it, by whose line its angle is measured: it is a uniform bar from the first to the
            second unless centre or parts say otherwise.
        length: of the bar [m], > 0; as drawn if nothing is said.
        points: of it, [x, y] [m] in its own frame, which begins at the first point of the bar and has x along
            the bar; without a bar it is any frame.
        centre: centre of mass [m], in the same frame.
        inertia: about the centre of mass [kg m^2], >= 0 (0: a point mass); without centre and parts that of a
            uniform bar.
        parts: of which it is made, in the same frame, in place of mass, centre and inertia.
    """

    mass: Kilograms[Positive] | None = None
    bar: tuple[str, str] | None = None
    length: Metres[Positive] | None = None
    points: Metres[Mapping[str, Vector2]] = field(default_factory=dict)
    centre: Metres[Vector2] | None = None
    inertia: KilogramSquareMetres[NonNegative] | None = None
    parts: tuple[PartData, ...] = ()


@dataclass(frozen=True)
class DrawnBody:
    """A body at its place in the drawing.

    Arguments:
        name: of it. points: its own, in its frame [m]; None: those of the drawing.
        origin, angle: of its frame in the drawing [m], [rad].
        line: angle of the line by which it is measured, in its frame [rad].
        part: mass, centre and inertia, in its frame. assumed: what was assumed of it, in a sentence, or "".
    """

    name: str
    points: Mapping[str, Vector2] | None
    origin: Vector2
    angle: float
    line: float
    part: Part
    assumed: str = ""

    def place(self, point: str, drawn: Mapping[str, Vector2], where: str) -> Vector2:
        """Where a point of this name lies, if the body is as in the drawing [m].

        where: what asks, in the file. Raises InputError if the body has no such point.
        """
        known = drawn if self.points is None else self.points
        what = "drawing_mm" if self.points is None else f"bodies.{self.name}, which has a frame of its own,"
        check_known(where, point, known, f"{what} has no such point")
        return plus(self.origin, rotated(known[point], self.angle))

    def body(self) -> Body:
        """The body in the drawing."""
        part, moments = self.part, self.part.moments
        return Body(
            mass=part.mass,
            inertia=part.inertia,
            centre=plus(self.origin, rotated(part.centre, self.angle)),
            angle=self.angle + self.line,
            moments=None if moments is None else turned_moments(moments, self.angle),
        )


def drawn_body(name: str, data: LinkageBodyData, drawn: Mapping[str, Vector2]) -> DrawnBody:
    """A body of this name, laid where the drawing has it. Raises InputError that names the key."""
    where = f"bodies.{name}"
    if name == GROUND:
        raise InputError(f"{where}: the name of what does not move; allowed: any other")
    points = _own_points(where, data, drawn)
    origin, angle = ((0.0, 0.0), 0.0) if points is None else _pose(where, points, drawn)
    known = drawn if points is None else points
    line = 0.0 if data.bar is None else direction(*(known[end] for end in data.bar))
    part, assumed = _mass(name, data, known)
    if part.inertia <= 0.0 and data.inertia is None:
        raise InputError(
            f"{where}.inertia_kg_m2: missing; its parts are points in one place; allowed: >= 0, 0 for a point "
            "mass"
        )
    return DrawnBody(name, points, origin, angle, line, part, assumed)


def _own_points(
    where: str, data: LinkageBodyData, drawn: Mapping[str, Vector2]
) -> Mapping[str, Vector2] | None:
    """The points of a body in a frame of its own [m]; None if it is as drawn."""
    if data.length is not None and data.bar is None:
        raise InputError(f"{where}.length_mm: is of a bar; allowed: with bar = [point, point]")
    if data.bar is None:
        return dict(data.points) or None
    first, second = data.bar
    for end in data.bar:
        check_known(f"{where}.bar", end, drawn, "drawing_mm has no such point")
    if first == second or distance(drawn[first], drawn[second]) == 0.0:
        raise InputError(f"{where}.bar = {list(data.bar)}: allowed: two points at different places")
    if data.length is None and not data.points:
        return None
    ends = {first: (0.0, 0.0), second: (data.length or distance(drawn[first], drawn[second]), 0.0)}
    for end in data.bar:
        if end in data.points:
            raise InputError(
                f"{where}.points_mm.{end}: is an end of the bar, which says where it is; leave it out"
            )
    return {**ends, **data.points}


def _pose(where: str, points: Mapping[str, Vector2], drawn: Mapping[str, Vector2]) -> tuple[Vector2, float]:
    """Origin [m] and angle [rad] of a body's frame for which its points are nearest to those of the drawing."""
    common = [name for name in points if name in drawn]
    if len({points[name] for name in common}) < 2 or len({drawn[name] for name in common}) < 2:
        raise InputError(
            f"{where}: drawing_mm has {', '.join(common) or 'none'} of its points; allowed: two or more at "
            "different places, which say how it lies"
        )
    own, seen = (np.array([of[name] for name in common]) for of in (points, drawn))
    a, b = own - own.mean(axis=0), seen - seen.mean(axis=0)
    angle = math.atan2(float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()), float((a * b).sum()))
    x, y = own.mean(axis=0).tolist()
    mx, my = seen.mean(axis=0).tolist()
    return minus((mx, my), rotated((x, y), angle)), angle


def _mass(name: str, data: LinkageBodyData, known: Mapping[str, Vector2]) -> tuple[Part, str]:
    """Mass, centre and inertia of a body in its frame, and what was assumed."""
    where = f"bodies.{name}"
    if data.parts:
        for key in ("mass", "centre", "inertia"):
            if getattr(data, key) is not None:
                raise InputError(f"{where}.{key}: parts say it too; allowed: one of them")
        return lumped(one.part(known, f"{where}.parts[{n}]") for n, one in enumerate(data.parts)), ""
    if data.mass is None:
        raise InputError(f"{where}.mass_kg: missing; allowed: > 0, or parts: [[{where}.parts]]")
    if data.centre is None:
        if data.bar is None:
            raise InputError(f"{where}.centre_mm: missing; allowed: [x, y], or bar = [point, point]")
        found, said = bar(data.mass, *(known[end] for end in data.bar)), "uniform bar"
        if data.inertia is None:
            return found, f"{name}: its {data.mass:.10g} kg are a {said} from {' to '.join(data.bar)}"
        assumed = f"{name}: its centre of mass is in the middle of {' and '.join(data.bar)}"
        return replace(found, inertia=data.inertia, moments=None), assumed
    if data.inertia is None:
        raise InputError(f"{where}.inertia_kg_m2: missing; it goes with centre_mm; allowed: > 0")
    return Part(mass=data.mass, centre=data.centre, inertia=data.inertia), ""
