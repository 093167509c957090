"""Friction laws without a state: the force follows from slip and normal force alone."""

from __future__ import annotations

import math
from dataclasses import field
from typing import ClassVar

from pydantic import model_validator

from user_forces.friction.law import FrictionLaw, TwoCoefficients, against
from user_forces.kernel import kernel, limited, smooth_step
from user_forces.values.units import MetresPerSecond, SecondsPerMetre
from user_forces.values.value import Coefficient, NonNegative, Positive, value

FULL = 1.0 - math.exp(-3.0)


@value
class Frictionless(FrictionLaw):
    """F_t = 0."""

    @staticmethod
    @kernel
    def force(slip: float, normal_force: float) -> float:
        """Zero [N], whatever the slip [m/s] and normal force [N]."""
        return 0.0


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

    sliding_coefficient: Coefficient = field(kw_only=False)
    static_speed: MetresPerSecond[NonNegative] = 1e-4
    dynamic_speed: MetresPerSecond[Positive] = 1e-2

    @model_validator(mode="after")
    def _ramp_has_a_width(self) -> Ambrosio:
        if self.dynamic_speed <= self.static_speed:
            raise ValueError(
                f"dynamic_speed = {self.dynamic_speed} m/s: allowed: > static_speed = {self.static_speed} m/s"
            )
        return self

    @staticmethod
    @kernel
    def force(
        slip: float,
        normal_force: float,
        sliding_coefficient: float,
        static_speed: float,
        dynamic_speed: float,
    ) -> float:
        """Tangential force [N] for a slip [m/s] and a normal force [N] >= 0."""
        ramp = (abs(slip) - static_speed) / (dynamic_speed - static_speed)
        c_d = limited(ramp, 0.0, 1.0)  # Eq. 8
        return against(slip, sliding_coefficient * c_d * normal_force)  # Eq. 7


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

    @staticmethod
    @kernel
    def force(slip: float, normal_force: float, sliding_coefficient: float, dynamic_speed: float) -> float:
        """Tangential force [N] for a slip [m/s] and a normal force [N] >= 0."""
        ratio = abs(slip) / dynamic_speed
        share = 1.0 - math.exp(-3.0 * ratio) if ratio < 1.0 else FULL
        return against(slip, sliding_coefficient * share * normal_force)


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

    @staticmethod
    @kernel
    def force(slip: float, normal_force: float, sliding_coefficient: float, dynamic_speed: float) -> float:
        """Tangential force [N] for a slip [m/s] and a normal force [N] >= 0."""
        share = smooth_step(abs(slip) / dynamic_speed)
        return against(slip, sliding_coefficient * share * normal_force)


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

    @staticmethod
    @kernel
    def force(
        slip: float,
        normal_force: float,
        static_coefficient: float,
        sliding_coefficient: float,
        stribeck_speed: float,
        tolerance_speed: float,
    ) -> float:
        """Tangential force [N] for a slip [m/s] and a normal force [N] >= 0."""
        ratio = abs(slip) / stribeck_speed
        extra = (static_coefficient - sliding_coefficient) * math.exp(-ratio * ratio)
        share = smooth_step(abs(slip) / tolerance_speed)
        return against(slip, (sliding_coefficient + extra) * share * normal_force)


@value
class BengisuAkay(TwoCoefficients):
    """F_t = -mu(abs(slip)) F_n sign(slip), rising to mu_s at v_0 and falling to mu_d beyond:

        mu(v) = mu_s (1 - (v - v_0)^2 / v_0^2)              v < v_0
                mu_d + (mu_s - mu_d) exp(-xi (v - v_0))     v >= v_0

    Continuous, with a kink at v_0. It does not stick: a loaded pin creeps.

    Arguments: those of `TwoCoefficients`, and
        static_speed: v_0 [m/s], > 0.
        decay: xi [s/m], > 0.

    Source: Bengisu and Akay, J. Sound Vib. 171 (1994) 557-570.
    """

    static_speed: MetresPerSecond[Positive] = 1e-3
    decay: SecondsPerMetre[Positive] = 100.0

    @staticmethod
    @kernel
    def force(
        slip: float,
        normal_force: float,
        static_coefficient: float,
        sliding_coefficient: float,
        static_speed: float,
        decay: float,
    ) -> float:
        """Tangential force [N] for a slip [m/s] and a normal force [N] >= 0."""
        beyond = abs(slip) - static_speed
        if beyond < 0.0:
            coefficient = static_coefficient * (1.0 - (beyond / static_speed) * (beyond / static_speed))
        else:
            difference = static_coefficient - sliding_coefficient
            coefficient = sliding_coefficient + difference * math.exp(-decay * beyond)
        return against(slip, coefficient * normal_force)


@value
class BrownMcPhee(TwoCoefficients):
    """F_t = -F_n (mu_d tanh(4 x) + (mu_s - mu_d) x / (x^2/4 + 3/4)^2), x = slip/v_t.

    Smooth everywhere. The second term has its largest value, 1, at x = 1, so the force is mu_s F_n at v_t
    within mu_d/1500. It does not stick: a loaded pin creeps. The published law adds a viscous term, which dry
    pins do not have.

    Arguments: those of `TwoCoefficients`, and
        transition_speed: v_t [m/s], > 0.

    Source: Brown and McPhee, J. Comput. Nonlinear Dyn. 11 (2016) 054502.
    """

    transition_speed: MetresPerSecond[Positive] = 1e-2

    @staticmethod
    @kernel
    def force(
        slip: float,
        normal_force: float,
        static_coefficient: float,
        sliding_coefficient: float,
        transition_speed: float,
    ) -> float:
        """Tangential force [N] for a slip [m/s] and a normal force [N] >= 0."""
        x = slip / transition_speed
        width = 0.25 * x * x + 0.75
        difference = static_coefficient - sliding_coefficient
        return -normal_force * (sliding_coefficient * math.tanh(4.0 * x) + difference * x / (width * width))
