"""Laws with a dashpot in parallel with the spring."""

from __future__ import annotations

import math
from dataclasses import field
from functools import cached_property
from typing import Annotated, ClassVar

from pydantic import Field

from user_forces.kernel import kernel, smooth_step
from user_forces.normal.power_laws import ElasticPower
from user_forces.values.units import Kilograms, Metres, NewtonSecondsPerMetre
from user_forces.values.value import InputError, NonNegative, Positive, Real, Restitution, value


@value
class KelvinVoigt(ElasticPower):
    """F = K depth + c rate.

    The force jumps to c v0 at the impact, and near the separation the law asks for tension, which is cut: the
    surfaces part when spring and dashpot balance. Restitution is no input. Of two free bodies with reduced
    mass m a central impact delivers, with zeta = c / (2 sqrt(K m)) and the tension cut,

        e = exp(-2 zeta arccos(zeta) / sqrt(1 - zeta^2))     zeta < 1
            exp(-2 zeta arcosh(zeta) / sqrt(zeta^2 - 1))     zeta > 1

    Arguments:
        stiffness: K [N/m], > 0.
        damping: c [N s/m], >= 0.

    Source: Voigt, Ann. Phys. 283 (1892) 671-693; with a cut tension Schwager and Poeschel, Granular Matter 9
    (2007) 465-469.
    """

    damping: NewtonSecondsPerMetre[NonNegative]
    exponent: Annotated[Real, Field(ge=1, le=1)] = field(default=1.0)

    @staticmethod
    @kernel
    def force(depth: float, rate: float, impact_velocity: float, stiffness: float, damping: float) -> float:
        """K depth + c rate [N]."""
        return stiffness * depth + damping * rate

    def delivered_restitution(self, mass: float) -> float:
        """Restitution [-] of a free impact of this reduced mass [kg] > 0, tension cut."""
        return cut_dashpot_restitution(self.damping / (2.0 * math.sqrt(self.stiffness * mass)))


def cut_dashpot_restitution(damping_ratio: float) -> float:
    """Restitution of a linear spring and dashpot that part as soon as they would pull.

        e = exp(-2 zeta arccos(zeta) / sqrt(1 - zeta^2))     zeta < 1
            exp(-2)                                          zeta = 1
            exp(-2 zeta arcosh(zeta) / sqrt(zeta^2 - 1))     zeta > 1

    K x + c v of the free oscillation with x = 0, v = v0 at the start falls to zero when its phase is
    2 arccos(zeta), and the speed is -v0 times the decay till then.

    Arguments:
        damping_ratio: zeta [-] >= 0.
    """
    zeta = damping_ratio
    if abs(zeta - 1.0) < 1e-9:
        return math.exp(-2.0)
    if zeta < 1.0:
        return math.exp(-2.0 * zeta * math.acos(zeta) / math.sqrt(1.0 - zeta * zeta))
    return math.exp(-2.0 * zeta * math.acosh(zeta) / math.sqrt(zeta * zeta - 1.0))


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

    @staticmethod
    @kernel
    def force(depth: float, rate: float, impact_velocity: float, stiffness: float, damping: float) -> float:
        """K depth + c rate [N]."""
        return stiffness * depth + damping * rate


@value
class AdamsImpact(ElasticPower):
    """F = K depth^n + c rate, c = c_max s^2 (3 - 2 s), s = depth / d_max from 0 to 1.

    The cubic STEP lets the damping grow with depth, so the force does not jump at the impact. Restitution is no
    input: it depends on the depth that is reached, so on speed and mass, and there is no closed form.
    Near the separation the law may ask for tension, which is cut. A loaded contact is damped by c at its depth.

    Arguments:
        stiffness: K [N/m^n], > 0; 1e5 N/mm^1.5 is common for steel on steel.
        exponent: n [-], 1.5, from 1 to 3.
        full_damping: c_max [N s/m], >= 0; 50 N s/mm is common.
        full_damping_depth: d_max [m], > 0; 0.1 mm is common.

    Source: MSC Adams, function builder: IMPACT and STEP. (ADAMS multiplies by the rate of the distance, which
    is minus the rate of depth.)
    """

    TITLE: ClassVar[str] = "ADAMS IMPACT"

    full_damping: NewtonSecondsPerMetre[NonNegative]
    full_damping_depth: Metres[Positive]

    @staticmethod
    @kernel
    def force(
        depth: float,
        rate: float,
        impact_velocity: float,
        stiffness: float,
        exponent: float,
        full_damping: float,
        full_damping_depth: float,
    ) -> float:
        """K depth^n + c rate [N]."""
        damping = full_damping * smooth_step(depth / full_damping_depth)
        return float(stiffness * depth**exponent + damping * rate)
