"""The IMPACT function of ADAMS."""

from typing import ClassVar

from user_forces.expressions.scalar import step
from user_forces.normal.power_law import ElasticPower
from user_forces.values.units import Metres, NewtonSecondsPerMetre
from user_forces.values.value import NonNegative, Positive, value


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

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        """Normal force [N] at depth [m] > 0, rate [m/s]."""
        damping = self.full_damping * step(depth / self.full_damping_depth)
        return self.elastic_force(depth) + damping * rate
