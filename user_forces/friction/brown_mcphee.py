"""Brown and McPhee's friction."""

from user_forces.expressions.scalar import tanh
from user_forces.friction.law import TwoCoefficients
from user_forces.values.units import MetresPerSecond
from user_forces.values.value import Positive, value


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

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        """Tangential force [N] for a slip [m/s] and a normal force [N] >= 0."""
        x = slip / self.transition_speed
        width = 0.25 * x * x + 0.75
        difference = self.static_coefficient - self.sliding_coefficient
        return -normal_force * (self.sliding_coefficient * tanh(4.0 * x) + difference * x / (width * width))
