"""A linkage: bodies, pins, linear actuators, cranks, slides and gears."""

from __future__ import annotations

import math
import sys
from collections.abc import Collection, Iterable, Mapping
from dataclasses import field, replace
from functools import cached_property
from typing import Annotated

from pydantic import Field, model_validator

from user_forces.values.names import nearest
from user_forces.values.units import (
    Kilograms,
    KilogramSquareMetres,
    Metres,
    MetresPerSecond,
    Radians,
    RadiansPerSecond,
)
from user_forces.values.value import NonNegative, Positive, Real, Value, Vector2, value

GROUND = "ground"
Moments = tuple[Real, Real, Real]
Side = tuple[str, Vector2]  # a body with a point of it [m], start posture
Sides = tuple[Side, Side]
ROUNDING = 1e-9


@value
class Part(Value):
    """A rigid part of a body.

    Arguments:
        mass: [kg], > 0.
        centre: centre of mass [m].
        inertia: about the centre of mass [kg m^2], >= 0 (0: a point mass).
        moments: integrals of x^2, y^2 and x y over its mass [kg m^2], from its centre; the first two add up to
            the inertia. Only the spatial model asks. None: the inertia in equal halves, as of a disc.
        name: by which a machine knows it where a scenario models it otherwise.
    """

    mass: Kilograms[Positive]
    centre: Metres[Vector2]
    # of a bar between two points that rounding has separated the inertia is tiny
    inertia: KilogramSquareMetres[Annotated[Real, Field(ge=0)]] = 0.0
    name: str = ""
    moments: KilogramSquareMetres[Moments] | None = None

    @model_validator(mode="after")
    def _moments_fit(self) -> Part:
        check_moments(self.moments, self.inertia)
        return self

    @property
    def second_moments(self) -> Moments:
        """`moments`, or what stands for them."""
        return self.moments or (0.5 * self.inertia, 0.5 * self.inertia, 0.0)


def check_moments(moments: Moments | None, inertia: float) -> None:
    """Raise ValueError unless second moments are those of a body in the plane with this inertia."""
    if moments is None:
        return
    xx, yy, xy = moments
    margin = ROUNDING * inertia + sys.float_info.min  # half of the smallest number is 0
    if abs(xx + yy - inertia) > margin or min(xx, yy) < -margin or xy * xy > xx * yy + margin * inertia:
        raise ValueError(
            f"moments = {moments}: allowed: xx and yy >= 0 that add up to the inertia, {inertia} kg m^2, and "
            "xy^2 <= xx yy"
        )


def bar(mass: float, a: Vector2, b: Vector2) -> Part:
    """A uniform slender bar from a to b: centre in the middle, inertia m l^2 / 12."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    return Part(
        mass=mass,
        centre=((a[0] + b[0]) / 2, (a[1] + b[1]) / 2),
        inertia=mass * math.hypot(dx, dy) ** 2 / 12,
        moments=(mass * dx * dx / 12, mass * dy * dy / 12, mass * dx * dy / 12),
    )


def lumped(parts: Iterable[Part]) -> Part:
    """Several parts fixed to each other, as one: total mass, common centre, Steiner's theorem."""
    parts = tuple(parts)
    mass = sum(p.mass for p in parts)
    x = sum(p.mass * p.centre[0] for p in parts) / mass
    y = sum(p.mass * p.centre[1] for p in parts) / mass
    inertia = sum(p.inertia + p.mass * ((p.centre[0] - x) ** 2 + (p.centre[1] - y) ** 2) for p in parts)
    xx = sum(p.second_moments[0] + p.mass * (p.centre[0] - x) ** 2 for p in parts)
    yy = sum(p.second_moments[1] + p.mass * (p.centre[1] - y) ** 2 for p in parts)
    xy = sum(p.second_moments[2] + p.mass * (p.centre[0] - x) * (p.centre[1] - y) for p in parts)
    return Part(mass=mass, centre=(x, y), inertia=inertia, moments=(xx, yy, xy))


def turned_moments(moments: Moments, angle: float) -> Moments:
    """Second moments of a body that has turned by an angle [rad]."""
    xx, yy, xy = moments
    c, s = math.cos(angle), math.sin(angle)
    cross = 2.0 * c * s * xy
    return (
        c * c * xx + s * s * yy - cross,
        s * s * xx + c * c * yy + cross,
        c * s * (xx - yy) + (c * c - s * s) * xy,
    )


@value
class Body(Value):
    """A moving rigid body at the start.

    Arguments:
        mass: [kg], > 0.
        inertia: about the centre of mass [kg m^2], >= 0 (0: a point mass, whose joints determine its turn).
        centre: centre of mass [m].
        angle: orientation [rad] of the line by which the machine measures this body.
        velocity: of the centre of mass [m/s].
        spin: angular velocity [rad/s].
        moments: integrals of x^2, y^2 and x y over its mass, as of a `Part`, in the start posture.
    """

    mass: Kilograms[Positive]
    inertia: KilogramSquareMetres[NonNegative]
    centre: Metres[Vector2]
    angle: Radians[Real] = 0.0
    velocity: MetresPerSecond[Vector2] = (0.0, 0.0)
    spin: RadiansPerSecond[Real] = 0.0
    moments: KilogramSquareMetres[Moments] | None = None

    @model_validator(mode="after")
    def _moments_fit(self) -> Body:
        check_moments(self.moments, self.inertia)
        return self


@value
class PinPlace(Value):
    """A place where two bodies are pinned together; whether ideally or loosely is the scenario's choice.

    Arguments:
        first, second: names of the bodies, one of them may be "ground". Pin forces are reported as
            the force of the first on the second.
        first_point: the pin's centre on the first body [m], start posture.
        second_point: the same on the second body; the same point unless the start is eccentric.
    """

    first: str
    second: str
    first_point: Metres[Vector2]
    second_point: Metres[Vector2]

    @property
    def sides(self) -> Sides:
        """Both bodies, each with its point."""
        return (self.first, self.first_point), (self.second, self.second_point)


def pinned(first: str, second: str, point: Vector2) -> PinPlace:
    """A pin whose centres coincide at the start."""
    return PinPlace(first=first, second=second, first_point=point, second_point=point)


@value
class LinearActuator(Value):
    """A linear actuator: a strut of prescribed length between two bodies; mining machines call it a column.

    Arguments:
        foot, head: names of the bodies, one of them may be "ground".
        foot_point, head_point: its ends [m], start posture.
        driven: whether it follows a drive; one that does not keeps its length, or its oil.
    """

    foot: str
    head: str
    foot_point: Metres[Vector2]
    head_point: Metres[Vector2]
    driven: Annotated[bool, Field(strict=True)] = True

    @property
    def sides(self) -> Sides:
        """Both bodies, each with its point: foot, then head."""
        return (self.foot, self.foot_point), (self.head, self.head_point)

    @property
    def start_length(self) -> float:
        """Distance of its ends at the start [m]."""
        return math.dist(self.foot_point, self.head_point)


@value
class Crank(Value):
    """A body whose angle is driven, against the ground. Its pivot is an ideal pin of the linkage.

    Arguments:
        body: name of the body.
    """

    body: str


@value
class Slide(Value):
    """A straight guide: a point of a body stays on a line of another.

    Arguments:
        body: name of the body.
        point: the point, start posture [m].
        direction: of the line [rad], from +x, start posture.
        against: name of the body that carries the line, which moves and turns with it; or "ground".
        turns: whether the body may turn about the point, as a pin does in a slot; a block does not.
        ends: of the line, start posture [m]; None: not known. A pin does not leave its slot at an end.
    """

    body: str
    point: Metres[Vector2]
    direction: Radians[Real] = 0.0
    against: str = GROUND
    turns: Annotated[bool, Field(strict=True)] = False
    ends: tuple[Vector2, Vector2] | None = None

    @property
    def sides(self) -> Sides:
        """Both bodies, each with its point: the guided one, then that which carries the line."""
        return (self.body, self.point), (self.against, self.point)

    @property
    def length(self) -> float:
        """Distance of the ends of the line [m]; infinite where they are not known."""
        return math.inf if self.ends is None else math.dist(*self.ends)

    @property
    def conditions(self) -> int:
        """How many conditions it puts on the motion: one across the line, and one on the angle of a block."""
        return 1 if self.turns else 2


@value
class Gear(Value):
    """A pair of gears, or a belt or parallel crank: the second body turns in proportion to the first.

        turn of the second body = ratio * turn of the first, both from the start on and against the carrier

    That is Willis' equation. The gear acts on both wheels by moments, see `Linkage.pitch_radius`.

    Arguments:
        first, second: names of the bodies, which pins or guides hold in their places.
        ratio: [-], not 0; negative for gears that mesh outside, 1 for equal angles.
        carrier: name of the body that carries both axes, or "ground"; None: a linkage takes the body on which
            its pins hold both wheels.
    """

    first: str
    second: str
    ratio: Real = 1.0
    carrier: str | None = None

    @model_validator(mode="after")
    def _turns_both(self) -> Gear:
        if self.ratio == 0.0:
            raise ValueError("ratio = 0: allowed: any other number")
        return self


@value
class TracePoint(Value):
    """A point of a body whose path is recorded.

    Arguments:
        body: name of the body.
        point: where it is at the start [m].
    """

    body: str
    point: Metres[Vector2]


def check_bodies(used: Iterable[tuple[str, str]], bodies: Collection[str]) -> None:
    """Raise ValueError unless bodies that are used, each with where, are known or the ground."""
    for where, body in used:
        if body != GROUND and body not in bodies:
            raise ValueError(f"{where} = {body!r}: no such body; {nearest(body, (GROUND, *bodies))}")


@value
class Linkage(Value):
    """A planar mechanism in its start posture; x forward, y up, SI.

    Arguments:
        bodies: moving bodies by name.
        pins: pins by name.
        actuators: driven actuators and struts by name.
        points: traced points by name.
        cranks: driven cranks by name.
        slides: straight guides by name.
        gears: pairs of bodies that turn in proportion, by name.
    """

    bodies: Mapping[str, Body]
    pins: Mapping[str, PinPlace] = field(default_factory=dict)
    actuators: Mapping[str, LinearActuator] = field(default_factory=dict)
    points: Mapping[str, TracePoint] = field(default_factory=dict)
    cranks: Mapping[str, Crank] = field(default_factory=dict)
    slides: Mapping[str, Slide] = field(default_factory=dict)
    gears: Mapping[str, Gear] = field(default_factory=dict)

    @property
    def farthest(self) -> float:
        """The largest coordinate of a centre or pin [m]: by its rounding all places are rounded."""
        points = [point for pin in self.pins.values() for _, point in pin.sides]
        return max(
            abs(x) for place in (*(body.centre for body in self.bodies.values()), *points) for x in place
        )

    @cached_property
    def joints(self) -> dict[tuple[str, str], Sides]:
        """What joins two bodies at points: pins, actuators and slides, by field and name."""
        found: dict[tuple[str, str], Sides] = {("pins", name): one.sides for name, one in self.pins.items()}
        found |= {("actuators", name): one.sides for name, one in self.actuators.items()}
        return found | {("slides", name): one.sides for name, one in self.slides.items()}

    @property
    def driven(self) -> tuple[str, ...]:
        """Names of all parts that follow a drive: actuators, then cranks."""
        return *(name for name, actuator in self.actuators.items() if actuator.driven), *self.cranks

    @model_validator(mode="after")
    def _names_are_known(self) -> Linkage:
        if GROUND in self.bodies:
            raise ValueError(f"bodies.{GROUND}: the name of what does not move; call the body otherwise")
        wheels = {("gears", name): (one.first, one.second) for name, one in self.gears.items()}
        pairs = {joint: (one, other) for joint, ((one, _), (other, _)) in self.joints.items()} | wheels
        used = [
            (f"{part}.{name}" + ".against" * (part == "slides" and n == 1), body)
            for (part, name), pair in pairs.items()
            for n, body in enumerate(pair)
        ]
        used += [(f"points.{name}", one.body) for name, one in self.points.items()]
        used += [(f"gears.{k}.carrier", g.carrier) for k, g in self.gears.items() if g.carrier is not None]
        moving = [(f"cranks.{name}", one.body) for name, one in self.cranks.items()]
        moving += [(f"slides.{name}", one.body) for name, one in self.slides.items()]
        moving += [(f"gears.{name}", wheel) for (_, name), pair in wheels.items() for wheel in pair]
        for where, body in moving:
            if body not in self.bodies:
                raise ValueError(f"{where} = {body!r}: no such moving body; {nearest(body, self.bodies)}")
        check_bodies(used, self.bodies)
        for (part, name), (one, other) in pairs.items():
            if one == other and part != "actuators":
                raise ValueError(f"{part}.{name} = {one!r} twice: allowed: two different bodies")
        for name, gear in self.gears.items():
            if gear.carrier in (gear.first, gear.second):
                raise ValueError(f"gears.{name}.carrier = {gear.carrier!r}: is a wheel; allowed: another body")
        found = {name: replace(one, carrier=self._carrier(name, one)) for name, one in self.gears.items()}
        object.__setattr__(self, "gears", found)
        return self

    def _axes(self, gear: Gear) -> dict[str, float]:
        """The bodies on which pins or guides hold both wheels, each with the distance of the axes [m]."""
        ends = [sides for (part, _), sides in self.joints.items() if part != "actuators"]
        held = {}
        for wheel in (gear.first, gear.second):
            groups = [{wheel_end} for pair in ends for wheel_end in pair if wheel_end[0] == wheel]
            for group in groups:  # pins in one place have one axis
                while more := {end for pair in ends if group & {*pair} for end in pair} - group:
                    group |= more
            held[wheel] = {body: point for group in groups for body, point in group if body != wheel}
        first, second = held.values()
        return {
            body: math.dist(second[body], point)
            for body, point in first.items()
            if body in second and body not in held and second[body] != point
        }

    def _carrier(self, name: str, gear: Gear) -> str:
        """The body against which a gear turns. Raises ValueError if its joints do not say it."""
        if gear.carrier is not None:
            return gear.carrier
        axes = self._axes(gear)
        if gear.ratio == 1.0 or GROUND in axes:
            return GROUND
        if len(axes) != 1:
            raise ValueError(
                f"gears.{name}: {'several bodies carry' if axes else 'no body carries'} the axes of both "
                f"{gear.first} and {gear.second}, so their turns have no reference; allowed: carrier = one of "
                f"{', '.join(axes or (GROUND, *self.bodies))}"
            )
        return next(iter(axes))

    def pitch_radius(self, gear: Gear) -> float | None:
        """The pitch radius of a gear's second wheel [m]; None of a belt, or where no pins give the axes.

        The tooth force is the gear's moment over this radius, along the pitch line, and over the cosine of the
        pressure angle along the line of action.
        """
        distance = self._axes(gear).get(gear.carrier or GROUND)
        return None if distance is None or gear.ratio == 1.0 else distance / abs(1.0 - gear.ratio)
