"""Coulomb's friction with the Stribeck effect."""

from user_forces.expressions.scalar import exp, magnitude, step
from user_forces.friction.law import TwoCoefficients, against
from user_forces.values.units import MetresPerSecond
from user_forces.values.value import Positive, value


@value
class Stribeck(TwoCoefficients):
    """F_t = -(mu_d + (mu_s - mu_d) exp(-(slip/v_S)^2)) s^2 (3 - 2 s) F_n sign(slip), s = abs(slip)/v_t to 1.

    The force falls from mu_s to mu_d as the slip passes v_S; the cubic STEP up to v_t makes it continuous at
    rest. It does not stick: a loaded pin creeps.

    Arguments: those of `TwoCoefficients`, and
        stribeck_speed: v_S [m/s], > 0.
        tolerance_speed: v_t [m/s], > 0; well below v_S, else mu_s is not reached.

    Source: Stribeck, Z. VDI 46 (1902) 1341-1348; with the Gaussian of Armstrong-Helouvry, Dupont and
    Canudas de Wit, Automatica 30 (1994) 1083-1138.
    """

    stribeck_speed: MetresPerSecond[Positive] = 1e-2
    tolerance_speed: MetresPerSecond[Positive] = 1e-3

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        """Tangential force [N] for a slip [m/s] and a normal force [N] >= 0."""
        speed = magnitude(slip)
        ratio = speed / self.stribeck_speed
        extra = (self.static_coefficient - self.sliding_coefficient) * exp(-ratio * ratio)
        share = step(speed / self.tolerance_speed)
        return against(slip, (self.sliding_coefficient + extra) * share * normal_force)
