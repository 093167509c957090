"""Threlfall's friction."""

import math

from user_forces.expressions.scalar import exp, magnitude, where
from user_forces.friction.law import FrictionLaw, against
from user_forces.values.units import MetresPerSecond
from user_forces.values.value import Coefficient, Positive, value

FULL = 1.0 - math.exp(-3.0)


@value
class Threlfall(FrictionLaw):
    """F_t = -mu F_n (1 - exp(-3 abs(slip)/v_r)) sign(slip) up to v_r, -(1 - exp(-3)) mu F_n sign(slip) beyond.

    The factor beyond v_r is printed as 0.95; 1 - exp(-3) = 0.9502 makes the force continuous. mu itself is
    never reached. It does not stick: a loaded pin creeps.

    Arguments:
        sliding_coefficient: mu [-], >= 0 and <= 5.
        dynamic_speed: v_r [m/s], > 0.

    Source: Threlfall, Mech. Mach. Theory 13 (1978) 475-483.
    """

    sliding_coefficient: Coefficient
    dynamic_speed: MetresPerSecond[Positive] = 1e-2

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        """Tangential force [N] for a slip [m/s] and a normal force [N] >= 0."""
        ratio = magnitude(slip) / self.dynamic_speed
        share = where(ratio < 1.0, 1.0 - exp(-3.0 * ratio), FULL)
        return against(slip, self.sliding_coefficient * share * normal_force)
