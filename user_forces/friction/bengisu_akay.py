"""Bengisu and Akay's friction."""

from user_forces.expressions.scalar import exp, magnitude, maximum, where
from user_forces.friction.law import TwoCoefficients, against
from user_forces.values.units import MetresPerSecond, SecondsPerMetre
from user_forces.values.value import Positive, value


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

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        """Tangential force [N] for a slip [m/s] and a normal force [N] >= 0."""
        beyond = magnitude(slip) - self.static_speed
        rising = self.static_coefficient * (1.0 - (beyond / self.static_speed) * (beyond / self.static_speed))
        difference = self.static_coefficient - self.sliding_coefficient
        falling = self.sliding_coefficient + difference * exp(-self.decay * maximum(beyond, 0.0))
        return against(slip, where(beyond < 0.0, rising, falling) * normal_force)
