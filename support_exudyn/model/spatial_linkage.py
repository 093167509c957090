"""What the engine needs to know of a machine in space: bodies, bearings, actuators in their start posture."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import field
from typing import Annotated, Literal, NamedTuple

from pydantic import Field, model_validator

from support_exudyn.model.linkage import ROUNDING, check_bodies
from user_forces.values.value import NonNegative, Positive, Real, Share, Value, Vector3, value

UP: Vector3 = (0.0, 1.0, 0.0)
ACROSS: Vector3 = (0.0, 0.0, 1.0)
Inertia = tuple[Real, Real, Real, Real, Real, Real]


@value
class SpatialBody(Value):
    """A moving rigid body at the start, its own axes parallel to those of the ground.

    Arguments:
        mass: [kg], > 0.
        inertia: about the centre of mass [kg m^2]: xx, yy, zz, yz, xz, xy, the products with their sign as in
            the tensor (xy = -integral of x y dm).
        centre: centre of mass [m].
        angle: orientation about z [rad] of the line by which the machine measures this body.
        velocity: of the centre of mass [m/s].
        spin: angular velocity [rad/s].
    """

    mass: Positive
    inertia: Inertia
    centre: Vector3
    angle: Real = 0.0
    velocity: Vector3 = (0.0, 0.0, 0.0)
    spin: Vector3 = (0.0, 0.0, 0.0)

    @model_validator(mode="after")
    def _inertia_is_one(self) -> SpatialBody:
        xx, yy, zz, yz, xz, xy = self.inertia
        minors = (
            xx,
            xx * yy - xy * xy,
            xx * (yy * zz - yz * yz) - xy * (xy * zz - xz * yz) + xz * (xy * yz - xz * yy),
        )
        if min(minors) <= 0.0:
            raise ValueError(f"inertia = {self.inertia}: allowed: positive definite")
        return self


@value
class Bearing(Value):
    """A place where a journal sits in a bore, or both are ideally pinned.

    Arguments:
        first, second: names of the bodies, one of them may be "ground".
        first_point, second_point: middle of the bearing on each body [m]; the same point unless the start is
            eccentric.
        first_axis, second_axis: direction of the bore and of the journal, unit vectors; the same unless the
            start is tilted.
        length: of the bearing along its axis [m], >= 0.
        holds: what an ideal pin holds here besides the two directions across its axis: "tilt" of the axes
            against each other, and shift "along" them. Of one with clearance only "along" is held. A bearing
            that holds "tilt" alone is a guide: the second body slides along it; with "turn" it does not turn
            about its axis either.
        pin: name of the planar pin that this is, or is a part of.
        share: of the planar pin's contact stiffness that is here.
        is_guide: whether it is reported as a guide and not as a pin.
    """

    first: str
    second: str
    first_point: Vector3
    second_point: Vector3
    first_axis: Vector3 = ACROSS
    second_axis: Vector3 = ACROSS
    length: NonNegative = 0.0
    holds: frozenset[Literal["tilt", "along", "turn"]] = frozenset({"tilt", "along"})
    pin: str
    share: Share = 1.0
    is_guide: Annotated[bool, Field(strict=True)] = False

    @model_validator(mode="after")
    def _can_be(self) -> Bearing:
        if self.first == self.second:
            raise ValueError(f"first, second = {self.first!r} twice: allowed: two different bodies")
        for name in ("first_axis", "second_axis"):
            axis = getattr(self, name)
            if abs(math.hypot(*axis) - 1.0) > ROUNDING:
                raise ValueError(f"{name} = {axis}: allowed: vectors of length 1")
        return self

    @property
    def misfit(self) -> str:
        """The misfit of both bodies at the start, which no ideal pin may have, in words; empty: none."""
        apart = math.dist(self.first_point, self.second_point)
        if apart > ROUNDING:
            return f"its points on both bodies are {apart:.3g} m apart"
        turned = math.dist(self.first_axis, self.second_axis)
        return f"its axes on both bodies are tilted by {turned:.3g} rad" if turned > ROUNDING else ""


class BearingEnd(NamedTuple):
    """Bore or journal of a bearing: its body, its middle [m] and its axis, start posture."""

    body: str
    point: Vector3
    axis: Vector3

    def centre(self, place: float) -> Vector3:
        """Centre of a section at a place along the axis [m]."""
        (x, y, z), (u, v, w) = self.point, self.axis
        return x + place * u, y + place * v, z + place * w


@value
class SpatialActuator(Value):
    """A strut of prescribed length with spherical ends.

    Arguments:
        foot, head: names of the bodies, one of them may be "ground".
        foot_point, head_point: its ends [m], start posture.
        actuator: name of the planar actuator that this is a part of.
        share: of the planar actuator's piston area that is here.
    """

    foot: str
    head: str
    foot_point: Vector3
    head_point: Vector3
    actuator: str
    share: Share = 1.0

    @property
    def start_length(self) -> float:
        """Distance of its ends at the start [m]."""
        return math.dist(self.foot_point, self.head_point)


@value
class SpatialPoint(Value):
    """A point of a body whose path is recorded.

    Arguments:
        body: name of the body.
        point: where it is at the start [m].
    """

    body: str
    point: Vector3


@value
class SpatialLinkage(Value):
    """A mechanism in space in its start posture; x forward, y up, z to the right of who looks forward; SI.

    Arguments:
        bodies, bearings, actuators, points: by name.
    """

    bodies: Mapping[str, SpatialBody]
    bearings: Mapping[str, Bearing] = field(default_factory=dict)
    actuators: Mapping[str, SpatialActuator] = field(default_factory=dict)
    points: Mapping[str, SpatialPoint] = field(default_factory=dict)

    @model_validator(mode="after")
    def _names_are_known(self) -> SpatialLinkage:
        used = [(f"bearings.{k}", b) for k, p in self.bearings.items() for b in (p.first, p.second)]
        used += [(f"actuators.{k}", b) for k, c in self.actuators.items() for b in (c.foot, c.head)]
        used += [(f"points.{k}", p.body) for k, p in self.points.items()]
        check_bodies(used, self.bodies)
        return self

    def parts_of_actuator(self, actuator: str) -> tuple[str, ...]:
        """Names of the actuators that make up a planar one."""
        return tuple(name for name, one in self.actuators.items() if one.actuator == actuator)

    def parts_of_pin(self, pin: str) -> dict[str, Bearing]:
        """The bearings that make up a planar pin, by name."""
        return {name: bearing for name, bearing in self.bearings.items() if bearing.pin == pin}
