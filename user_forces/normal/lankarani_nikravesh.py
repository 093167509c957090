"""Lankarani and Nikravesh's damped Hertz contact."""

from __future__ import annotations

import math
from typing import Annotated

from pydantic import Field

from user_forces.normal.law import NormalLaw
from user_forces.values import Fraction, Positive, Real, value


@value
class LankaraniNikravesh(NormalLaw):
    """F = K depth^n (1 + chi rate / v0), chi = 3 (1 - e^2) / 4.

    v0 is the approach speed at zero depth, not smaller than `approach_speed_floor`: chi / v0 grows
    without bound as v0 goes to zero, so a contact that is closed very softly (or that is closed at the
    start) is damped as if it had been closed at the floor.

    Restitution: the factor was derived for energy losses that are small. What a free impact delivers
    is larger than what was asked: 0.913 for 0.9, 0.796 for 0.7, 0.725 for 0.5.

    Arguments:
        stiffness: K [N/m^n], > 0.
        restitution: e [-], from 0 to 1; the law is meant for e > 0.8.
        exponent: n [-], 1.5 for metals, from 1 to 3.
        approach_speed_floor: smallest v0 [m/s] the damping is computed with, > 0.

    Source: Lankarani and Nikravesh, J. Mech. Des. 112 (1990) 369-376; Eq. 4 of "Dynamic Analysis of
    Hydraulic Support with Single Clearance", with D = chi K depth^n / v0.
    """

    stiffness: Positive
    restitution: Fraction
    exponent: Annotated[Real, Field(ge=1, le=3)] = 1.5
    approach_speed_floor: Positive = 1e-3

    @property
    def damping_factor(self) -> float:
        """chi [-]."""
        return 0.75 * (1.0 - self.restitution**2)

    def __call__(self, depth: float, rate: float, approach_speed: float) -> float:
        """Normal force [N] at depth [m] > 0, rate [m/s], approach speed [m/s] >= 0."""
        v0 = approach_speed if approach_speed > self.approach_speed_floor else self.approach_speed_floor
        return self.stiffness * math.pow(depth, self.exponent) * (1.0 + self.damping_factor * rate / v0)

    def elastic_force(self, depth: float) -> float:
        """K depth^n [N]."""
        return self.stiffness * math.pow(depth, self.exponent)

    def elastic_energy(self, depth: float) -> float:
        """K depth^(n+1) / (n+1) [J]."""
        return self.stiffness * math.pow(depth, self.exponent + 1.0) / (self.exponent + 1.0)

    def resting_depth(self, force: float) -> float:
        """(F/K)^(1/n) [m]."""
        return math.pow(force / self.stiffness, 1.0 / self.exponent)
