"""Laws whose elastic force is K depth^n."""

from abc import ABC
from typing import Annotated

from pydantic import Field

from user_forces.expressions.scalar import power
from user_forces.normal.hysteresis import Hysteresis
from user_forces.normal.law import NormalLaw
from user_forces.values.units import NewtonsPerMetreToN
from user_forces.values.value import InputError, Positive, Real, value


@value
class ElasticPower(NormalLaw, ABC):
    """The elastic part F_el = K depth^n.

    Arguments:
        stiffness: K [N/m^n], > 0; see `user_forces.materials`.
        exponent: n [-], 1.5 for metals, from 1 to 3.
    """

    stiffness: NewtonsPerMetreToN[Positive]
    exponent: Annotated[Real, Field(ge=1, le=3)] = 1.5

    def elastic_force(self, depth: float) -> float:
        """K depth^n [N]."""
        return self.stiffness * power(depth, self.exponent)

    def elastic_energy(self, depth: float) -> float:
        """K depth^(n+1) / (n+1) [J]."""
        return self.stiffness / (self.exponent + 1.0) * power(depth, self.exponent + 1.0)

    def resting_depth(self, force: float) -> float:
        """The depth (F/K)^(1/n) [m] under a force F [N] >= 0."""
        if not force >= 0.0:
            raise InputError(f"{type(self).__name__}: force = {force} N: allowed: >= 0")
        return float((force / self.stiffness) ** (1.0 / self.exponent))

    def turning_depth(self, energy: float) -> float:
        """The depth ((n+1) E / K)^(1/(n+1)) [m] for an energy E [J] >= 0."""
        if not energy >= 0.0:
            raise InputError(f"{type(self).__name__}: energy = {energy} J: allowed: >= 0")
        return float(((self.exponent + 1.0) * energy / self.stiffness) ** (1.0 / (self.exponent + 1.0)))


@value
class PowerLaw(ElasticPower, Hysteresis, ABC):
    """F = K depth^n (1 + chi rate / w); what chi is, is the law.

    Arguments:
        stiffness: K [N/m^n], > 0; see `user_forces.materials`.
        restitution: e that is asked for [-].
        exponent: n [-], 1.5 for metals, from 1 to 3.
        rest_velocity: smallest w [m/s], > 0; see `Hysteresis`.
    """
