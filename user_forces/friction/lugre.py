"""The LuGre friction of Canudas de Wit, Olsson, Astrom and Lischinsky."""

import math
from typing import ClassVar

from user_forces.friction.law import TwoCoefficients
from user_forces.kernel import kernel, sign
from user_forces.values.units import MetresPerSecond, PerMetre, SecondsPerMetre
from user_forces.values.value import NonNegative, Positive, value


@value
class LuGre(TwoCoefficients):
    """F_t = -F_n (s0 z + s1 dz/dt + s2 slip), with the deflection z [m] of bristles between the surfaces:

        dz/dt = slip - s0 abs(slip) z / g,   g = mu_d + (mu_s - mu_d) exp(-(slip/v_S)^2)

    The form that is proportional to the normal force. It sticks: below mu_s F_n a loaded pin rests on its
    bristles, deflected by z = F_t / (s0 F_n). In steady slip it is g F_n and the viscous part. Bristles are
    straight, z = 0, at an impact. z moves with the system: it is advanced with the mean slip of each step,
    exactly for constant slip, inside the solver's iteration; of second order. Steps follow the swings of what
    sticks, see `swing_time`: longer ones lose the stick-slip that shakes a rising support. The force can return
    the energy that is in the bristles, s0 z^2 F_n / 2; to be passive altogether, s1 abs(slip) < 4 g.

    Arguments:
        static_coefficient: mu_s [-], >= mu_d.
        sliding_coefficient: mu_d [-], > 0.
        stribeck_speed: v_S [m/s], > 0.
        bristle_stiffness: s0 [1/m], > 0.
        bristle_damping: s1 [s/m], >= 0.
        viscosity: s2 [s/m], >= 0.

    Source: Canudas de Wit, Olsson, Astrom and Lischinsky, IEEE Trans. Autom. Control 40 (1995) 419-425.
    """

    TITLE: ClassVar[str] = "LuGre"

    sliding_coefficient: Positive
    stribeck_speed: MetresPerSecond[Positive] = 1e-2
    bristle_stiffness: PerMetre[Positive] = 1e5
    bristle_damping: SecondsPerMetre[NonNegative] = 10.0
    viscosity: SecondsPerMetre[NonNegative] = 0.0

    def largest_deflection(self, slip: float) -> float:
        """Size [m] of the deflection in steady slip, g / s0."""
        return steady_deflection(
            slip,
            self.static_coefficient,
            self.sliding_coefficient,
            self.stribeck_speed,
            self.bristle_stiffness,
        )

    @staticmethod
    @kernel
    def rate(
        deflection: float,
        slip: float,
        static_coefficient: float,
        sliding_coefficient: float,
        stribeck_speed: float,
        bristle_stiffness: float,
    ) -> float:
        """dz/dt [m/s]."""
        size = steady_deflection(
            slip, static_coefficient, sliding_coefficient, stribeck_speed, bristle_stiffness
        )
        return slip - abs(slip) / size * deflection

    @staticmethod
    @kernel
    def advance(
        deflection: float,
        slip: float,
        step: float,
        static_coefficient: float,
        sliding_coefficient: float,
        stribeck_speed: float,
        bristle_stiffness: float,
    ) -> float:
        """z [m] after a step [s] at a slip [m/s]: nears the steady value as exp(-abs(slip) step s0/g)."""
        size = steady_deflection(
            slip, static_coefficient, sliding_coefficient, stribeck_speed, bristle_stiffness
        )
        steady = sign(slip) * size
        return steady + (deflection - steady) * math.exp(-abs(slip) * step / size)

    def swing_time(self, mass: float, normal_force: float) -> float:
        """The shorter of sqrt(m / (s0 F_n)) and 4 m / (s1 F_n) [s]; infinite without a normal force [N].

        Bristles hold a mass [kg] as a spring. Damped by more than twice the critical damping, they stop it in
        less time than a swing takes.
        """
        if normal_force <= 0.0:
            return math.inf
        swing = math.sqrt(mass / (self.bristle_stiffness * normal_force))
        damping = self.bristle_damping * normal_force
        return min(swing, 4.0 * mass / damping) if damping > 0.0 else swing

    @staticmethod
    @kernel
    def force(
        slip: float,
        normal_force: float,
        deflection: float,
        static_coefficient: float,
        sliding_coefficient: float,
        stribeck_speed: float,
        bristle_stiffness: float,
        bristle_damping: float,
        viscosity: float,
    ) -> float:
        """Tangential force [N] for a slip [m/s], a normal force [N] >= 0 and a deflection z [m]."""
        size = steady_deflection(
            slip, static_coefficient, sliding_coefficient, stribeck_speed, bristle_stiffness
        )
        bristles = (bristle_stiffness - bristle_damping * abs(slip) / size) * deflection
        return -normal_force * (bristles + (bristle_damping + viscosity) * slip)


@kernel
def steady_deflection(
    slip: float,
    static_coefficient: float,
    sliding_coefficient: float,
    stribeck_speed: float,
    bristle_stiffness: float,
) -> float:
    """Size [m] of the deflection of `LuGre` in steady slip [m/s], g / s0."""
    ratio = slip / stribeck_speed
    extra = (static_coefficient - sliding_coefficient) * math.exp(-ratio * ratio)
    return (sliding_coefficient + extra) / bristle_stiffness
