"""A block of rock that falls on a machine."""

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import Annotated

import numpy as np
from pydantic import Field

from support_exudyn.model.linkage import Body, Linkage, Slide
from support_exudyn.model.loads.load import Load, LoadChannel, LoadedPoint, Powers
from user_forces.expressions.scalar import maximum, power
from user_forces.normal.hysteresis import exact_damping_factor
from user_forces.normal.law import Impact
from user_forces.normal.power_law import ElasticPower
from user_forces.values.units import (
    Kilograms,
    KilogramsPerCubicMetre,
    Metres,
    MetresPerSecond,
    MetresPerSecondSquared,
    NewtonsPerMetreToN,
)
from user_forces.values.value import InputError, NonNegative, Positive, Real, Restitution, Vector2, value

STEPS_APART = 4  # after a separation that are as short as those of the impact, as in those of clearance pins
RESTING = 4.0  # a block with no more energy than so many times what its weight stores is at rest
QUIET = 1e-4  # or with no more than this share of what it fell with


@value
class FallingBlock(Load):
    """A block that falls on a point of a body, upright on a guide, bounces and comes to rest on it.

        depth = way up of the point - way up of the block - height,   where it is > 0
        F = K depth^n max(0, 1 + chi rate / v0),   rate = d depth/dt
        v0 = sqrt(speed^2 + 2 g height),   chi (1 + e) = ln((1 + chi)/(1 - chi e))

    The force pushes the point down and the block up and never pulls; there is no friction along the face. The
    law is that of `user_forces.Exact`, with the damping made for the speed v0 of the first impact on something
    that stands still: without weight that one gives back the restitution e, whatever the masses. Weight takes
    a little of it, the more the softer the impact is (0.49 for 0.50 where the force is a hundred times the
    weight). What comes later is slower and is damped less: its restitution is nearer to 1, for chi v/v0 then
    stands in place of chi.

    The block starts at t = 0 and strikes at sqrt(2 height/g) if it starts at rest and the point stands still; a
    `speed` makes it strike sooner. It is a body of the machine with the load's name, so that channels such as
    NAME.y (of its centre) and NAME.velocity_y tell its motion. Planar redundant formulation only.

    Steps are shortened for its impacts as for those of clearance pins, see `SolverSettings.impact_steps`.

    Arguments:
        body, point: what it falls on, see `Load`.
        mass: of the block [kg], > 0.
        height: of its underside over the point in the start posture [m], >= 0; height and speed not both 0.
        stiffness: K [N/m^n], > 0.
        restitution: e of the first impact [-], > 0 and <= 1.
        exponent: n [-], from 1 to 3; 1.5 for round faces, 1 for a cushion.
        speed: with which it starts downward [m/s], >= 0.
        density: by which its size is told from its mass [kg/m^3], > 0; it changes nothing but the picture.
        gravity: g [m/s^2], >= 0, that of the scenario, which is told so that the law knows v0.
    """

    mass: Kilograms[Positive]
    height: Metres[NonNegative]
    stiffness: NewtonsPerMetreToN[Positive]
    restitution: Restitution
    exponent: Annotated[Real, Field(ge=1, le=3)] = 1.5
    speed: MetresPerSecond[NonNegative] = 0.0
    density: KilogramsPerCubicMetre[Positive] = 2600.0
    gravity: MetresPerSecondSquared[NonNegative] = 9.81

    def misfit(self, dimensions: int) -> str:
        """Its guide is in the plane."""
        return "falls in the plane; allowed: dimensions = 2" if dimensions == 3 else ""

    def check(self, gravity: Vector2) -> None:
        """Raise InputError unless gravity [m/s^2] is that which its law was made for, and it does fall."""
        if gravity != (0.0, -self.gravity):
            raise InputError(
                f"gravity = {self.gravity} m/s^2: allowed: that of the scenario, which is {gravity}, and pulls "
                "straight down"
            )
        if self.first_speed <= 0.0:
            raise InputError(
                f"height = {self.height} m, speed = {self.speed} m/s: allowed: one of them > 0, and gravity "
                "> 0 "
                "if the speed is 0, so that it strikes"
            )

    # --- what it is ---

    @property
    def side(self) -> float:
        """Side of a cube of the block's mass and density [m]."""
        return float(np.cbrt(self.mass / self.density))

    @property
    def first_speed(self) -> float:
        """v0 [m/s]."""
        return math.sqrt(self.speed**2 + 2.0 * self.gravity * self.height)

    @cached_property
    def damping(self) -> float:
        """chi/v0 [s/m]."""
        return exact_damping_factor(self.restitution) / self.first_speed

    @cached_property
    def _elastic(self) -> ElasticPower:
        from user_forces.normal.hertz import Hertz

        return Hertz(stiffness=self.stiffness, exponent=self.exponent)

    @cached_property
    def impact_time(self) -> float:
        """Duration [s] of an undamped first impact on something that stands still."""
        return self._elastic.impact_time(Impact(self.first_speed, self.mass))

    def joined(self, linkage: Linkage, name: str) -> Linkage:
        """The linkage with the block and its upright guide, NAME_guide."""
        x, y = self.point
        side = self.side
        centre = (x, y + self.height + 0.5 * side)
        block = Body(
            mass=self.mass, inertia=self.mass * side**2 / 6.0, centre=centre, velocity=(0.0, -self.speed)
        )
        guide = Slide(body=name, point=centre, direction=0.5 * math.pi)
        return replace(
            linkage,
            bodies={**linkage.bodies, name: block},
            slides={**linkage.slides, f"{name}_guide": guide},
        )

    def against(self, name: str) -> str:
        """The opposite force acts on the block."""
        return name

    # --- its force ---

    def force(self, at: LoadedPoint) -> Vector2:
        """Force on the point: nothing forward, and down [N]."""
        return 0.0, -self._push(at)

    def _push(self, at: LoadedPoint) -> float:
        """F [N]."""
        return self._elastic_push(at) * maximum(0.0, 1.0 + self.damping * at.vy)

    def _elastic_push(self, at: LoadedPoint) -> float:
        """K depth^n [N]."""
        return self.stiffness * power(maximum(0.0, at.y - self.height), self.exponent)

    def stored(self, at: LoadedPoint) -> float:
        """K depth^(n+1)/(n+1) [J]."""
        return self._elastic_push(at) * maximum(0.0, at.y - self.height) / (self.exponent + 1.0)

    def powers(self, at: LoadedPoint) -> Powers:
        """Powers [W]: nothing moves the block but gravity; (F - K depth^n) rate is lost."""
        return Powers(0.0, (self._push(at) - self._elastic_push(at)) * at.vy)

    @property
    def channels(self) -> Mapping[str, LoadChannel]:
        """The channels are the block's force and its gap."""
        return {
            "force": LoadChannel("N", "of the block, downward"),
            "gap": LoadChannel("m", "between block and point; negative: depth"),
        }

    def observed(self, at: LoadedPoint) -> Mapping[str, float]:
        """Force [N] and gap [m]."""
        return {"force": self._push(at), "gap": self.height - at.y}

    # --- how finely it is to be followed ---

    @property
    def steepness(self) -> Vector2:
        """Steepness [N/m]: none along the face, n K depth^(n-1) against it at the first impact's depth."""
        deepest = self._elastic.turning_depth(0.5 * self.mass * self.first_speed**2)
        return 0.0, self.exponent * self.stiffness * deepest ** (self.exponent - 1.0)

    @property
    def impacts_machine(self) -> bool:
        """The block strikes."""
        return True

    def longest_step(self, at: LoadedPoint, number: int) -> float:
        """Half the way to an impact, then so many in an impact [s]; any step away from it and at rest."""
        short = self.impact_time / number
        gap, closing = self.height - at.y, at.vy
        if gap > 0.0:
            if closing > 0.0:
                return max(short, 0.5 * gap / closing)
            return short if gap < -STEPS_APART * short * closing else math.inf
        weight = self._elastic.elastic_energy(max(1e-12, self._elastic.resting_depth(self.mass * self.gravity)))
        quiet = max(RESTING * weight, QUIET * 0.5 * self.mass * self.first_speed**2)
        return short if self.stored(at) + 0.5 * self.mass * closing * closing > quiet else math.inf
