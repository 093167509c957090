"""Anagnostopoulos's linear spring and dashpot, the dashpot made from a restitution."""

import math
from dataclasses import field
from functools import cached_property
from typing import Annotated

from pydantic import Field

from user_forces.normal.kelvin_voigt import cut_dashpot_restitution
from user_forces.normal.power_law import ElasticPower
from user_forces.values.units import Kilograms
from user_forces.values.value import InputError, Positive, Real, Restitution, value


@value
class Anagnostopoulos(ElasticPower):
    """F = K depth + c rate, c = 2 zeta sqrt(K m), zeta = -ln e / sqrt(pi^2 + ln(e)^2).

    A half swing of the oscillator returns e v0, but its last part
    is tension. Where tension is cut, as here, the surfaces part earlier and faster:
    Delivers 0.253, 0.397, 0.550, 0.718, 0.902
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.
    The force jumps to c v0 at the impact.

    Arguments:
        stiffness: K [N/m], > 0.
        restitution: e [-], > 0 and <= 1.
        mass: m that moves as the depth does [kg], > 0; None: a scenario takes the joint's effective mass.

    Source: Anagnostopoulos, Earthquake Eng. Struct. Dyn. 16 (1988) 443-456.
    """

    restitution: Restitution
    mass: Kilograms[Positive] | None = None
    exponent: Annotated[Real, Field(ge=1, le=1)] = field(default=1.0)

    @cached_property
    def damping_ratio(self) -> float:
        """zeta [-]."""
        decrement = math.log(self.restitution)
        return -decrement / math.hypot(math.pi, decrement)

    @property
    def delivered_restitution(self) -> float:
        """Restitution [-] that a free impact delivers, tension cut."""
        return cut_dashpot_restitution(self.damping_ratio)

    @cached_property
    def damping(self) -> float:
        """c [N s/m]. Raises InputError without a mass."""
        if self.mass is None:
            raise InputError("Anagnostopoulos.mass: missing; allowed: > 0 kg, or a joint of a scenario")
        return 2.0 * self.damping_ratio * math.sqrt(self.stiffness * self.mass)

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        """Normal force [N] at depth [m] > 0, rate [m/s]."""
        return self.stiffness * depth + self.damping * rate
