"""Springs and dampers between two points, and between the turns of two bodies."""

import math
from collections.abc import Mapping
from typing import ClassVar

from pydantic import model_validator
from typing_extensions import Self

from support_exudyn.model.loads.load import COINCIDE, LinkLoad, LoadChannel, MomentLoad
from user_forces.kernel import kernel
from user_forces.values.units import (
    Metres,
    NewtonMetreSecondsPerRadian,
    NewtonMetresPerRadian,
    NewtonSecondsPerMetre,
    NewtonsPerMetre,
    Radians,
)
from user_forces.values.value import NonNegative, Real, value


@value
class SpringDamper(LinkLoad):
    """A spring and a damper side by side, along the line between points of two bodies.

        F = -k (l - l0) - c dl/dt

    l is the distance of both points, in the plane that of their shadows on it; a positive F pushes them apart.
    The spring pulls as well as it pushes. Where the points meet in the course of a run the line has no
    direction, and the run is refused.

    Arguments: those of `LinkLoad`, and
        stiffness: k [N/m], >= 0.
        free_length: l0 at which the spring carries nothing [m], >= 0.
        damping: c [N s/m], >= 0.
    """

    stiffness: NewtonsPerMetre[NonNegative] = 0.0
    free_length: Metres[NonNegative] = 0.0
    damping: NewtonSecondsPerMetre[NonNegative] = 0.0

    @model_validator(mode="after")
    def _has_a_direction(self) -> Self:
        if self.start_length <= COINCIDE:
            raise ValueError(
                f"other_point = {self.other_point} m: is the point of the other end, so that the spring has no "
                f"direction; allowed: > {COINCIDE:g} m from it in the start posture, in the plane"
            )
        if self.stiffness == 0.0 and self.damping == 0.0:
            raise ValueError("stiffness = 0 N/m, damping = 0 N s/m: allowed: one of them > 0")
        return self

    @property
    def start_length(self) -> float:
        """Distance of its ends in the start posture [m], in the plane."""
        return math.dist(self.point, self.other_point)

    @staticmethod
    @kernel
    def action(
        t: float,
        x: float,
        y: float,
        vx: float,
        vy: float,
        z: float,
        vz: float,
        stiffness: float,
        free_length: float,
        damping: float,
    ) -> tuple[float, ...]:
        """The force, the spring's k (l - l0)^2/2 and the damper's loss c (dl/dt)^2; see `ActingLoad`."""
        length = math.hypot(math.hypot(x, y), z)
        if length == 0.0:  # without a direction there is no force
            length = math.nan
        stretch, rate = length - free_length, (x * vx + y * vy + z * vz) / length
        push = -stiffness * stretch - damping * rate
        share, stored = push / length, 0.5 * stiffness * stretch * stretch
        return share * x, share * y, share * z, stored, 0.0, damping * rate * rate, push, length

    channels: ClassVar[Mapping[str, LoadChannel]] = {
        "force": LoadChannel("N", "pushes its ends apart if positive"),
        "length": LoadChannel("m", "distance of its ends"),
    }

    @property
    def steepness(self) -> tuple[float, ...]:
        """k [N/m], in whatever direction it comes to stand."""
        return self.stiffness, self.stiffness, self.stiffness


@value
class TorsionSpring(MomentLoad):
    """A spring and a damper that act by a moment on how a body turns against another.

        M = -k (a - a0) - c da/dt

    a is the turn of the body against the other since the start posture, and M acts on the body.

    Arguments:
        body, other: see `MomentLoad`.
        stiffness: k [N m/rad], >= 0.
        free_turn: a0 at which the spring carries nothing [rad]; 0: it is slack in the start posture.
        damping: c [N m s/rad], >= 0.
    """

    stiffness: NewtonMetresPerRadian[NonNegative] = 0.0
    free_turn: Radians[Real] = 0.0
    damping: NewtonMetreSecondsPerRadian[NonNegative] = 0.0

    @model_validator(mode="after")
    def _does_something(self) -> Self:
        if self.stiffness == 0.0 and self.damping == 0.0:
            raise ValueError("stiffness = 0 N m/rad, damping = 0 N m s/rad: allowed: one of them > 0")
        return self

    @staticmethod
    @kernel
    def action(
        t: float, turn: float, spin: float, stiffness: float, free_turn: float, damping: float
    ) -> tuple[float, ...]:
        """M, the spring's k (a - a0)^2/2 and the damper's loss c (da/dt)^2; see `ActingLoad`."""
        twist = turn - free_turn
        moment = -stiffness * twist - damping * spin
        return moment, 0.5 * stiffness * twist * twist, 0.0, damping * spin * spin, moment, turn

    channels: ClassVar[Mapping[str, LoadChannel]] = {
        "moment": LoadChannel("N m", "on the body, positive anticlockwise"),
        "angle": LoadChannel("rad", "turn of the body against the other since the start posture"),
    }

    @property
    def steepness(self) -> tuple[float, ...]:
        """k [N m/rad]."""
        return (self.stiffness,)
