"""Coulomb's friction, made continuous by a cubic STEP."""

from typing import ClassVar

from user_forces.expressions.scalar import magnitude, step
from user_forces.friction.law import FrictionLaw, against
from user_forces.values.units import MetresPerSecond
from user_forces.values.value import Coefficient, Positive, value


@value
class CubicCoulomb(FrictionLaw):
    """F_t = -mu F_n s^2 (3 - 2 s) sign(slip), s = abs(slip)/v_d from 0 to 1.

    The STEP function of multibody programs, here from rest to v_d: quadratic at rest, smooth at v_d. It does
    not stick: a loaded pin creeps.

    Arguments:
        sliding_coefficient: mu [-], >= 0 and <= 5.
        dynamic_speed: v_d [m/s], > 0.

    Source: MSC Adams, function builder, STEP; regularised Coulomb friction as in Marques, Flores, Claro and
    Lankarani, Nonlinear Dyn. 86 (2016) 1407-1443.
    """

    TITLE: ClassVar[str] = "Coulomb, cubic STEP"

    sliding_coefficient: Coefficient
    dynamic_speed: MetresPerSecond[Positive] = 1e-2

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        """Tangential force [N] for a slip [m/s] and a normal force [N] >= 0."""
        share = step(magnitude(slip) / self.dynamic_speed)
        return against(slip, self.sliding_coefficient * share * normal_force)
