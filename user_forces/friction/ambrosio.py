"""Ambrosio's corrected Coulomb friction."""

from __future__ import annotations

from pydantic import model_validator

from user_forces.expressions.scalar import magnitude, maximum, minimum
from user_forces.friction.law import FrictionLaw, against
from user_forces.values.units import MetresPerSecond
from user_forces.values.value import Coefficient, NonNegative, Positive, value


@value
class Ambrosio(FrictionLaw):
    """F_t = -mu_d c_d F_n sign(slip), with c_d rising from 0 at v_s to 1 at v_d.

        c_d = 0                            abs(slip) <= v_s
              (abs(slip) - v_s)/(v_d - v_s)   v_s < abs(slip) < v_d
              1                            abs(slip) >= v_d

    There is no force at all below v_s, so the law never sticks: a loaded pin creeps at v_s or less.
    The ramp damps like a dashpot of mu_d F_n / (v_d - v_s); steps longer than mass over that are coarse.

    Arguments:
        sliding_coefficient: mu_d [-], >= 0 and <= 5.
        static_speed: v_s [m/s], >= 0.
        dynamic_speed: v_d [m/s], > v_s.

    Source: Ambrosio, Virtual Nonlinear Multibody Systems, NATO Science 103 (2003) 57-81; Eq. 7 and 8 of
    "Dynamic Analysis of Hydraulic Support with Single Clearance".
    """

    sliding_coefficient: Coefficient
    static_speed: MetresPerSecond[NonNegative] = 1e-4
    dynamic_speed: MetresPerSecond[Positive] = 1e-2

    @model_validator(mode="after")
    def _ramp_has_a_width(self) -> Ambrosio:
        if self.dynamic_speed <= self.static_speed:
            raise ValueError(
                f"dynamic_speed = {self.dynamic_speed} m/s: allowed: > static_speed = {self.static_speed} m/s"
            )
        return self

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        """Tangential force [N] for a slip [m/s] and a normal force [N] >= 0."""
        ramp = (magnitude(slip) - self.static_speed) / (self.dynamic_speed - self.static_speed)
        c_d = minimum(1.0, maximum(0.0, ramp))  # Eq. 8
        return against(slip, self.sliding_coefficient * c_d * normal_force)  # Eq. 7
