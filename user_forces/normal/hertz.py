"""Hertz's elastic contact."""

from user_forces.normal.power_law import ElasticPower
from user_forces.values.value import value


@value
class Hertz(ElasticPower):
    """F = K depth^n: no damping, restitution 1.

    Arguments:
        stiffness: K [N/m^n], > 0; see `user_forces.materials`.
        exponent: n [-], 1.5 for two spheres, from 1 to 3.

    Source: Hertz, J. reine angew. Math. 92 (1882) 156-171; Johnson, Contact Mechanics (1985), Eq. 4.23.
    """

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        """Normal force [N] at depth [m] > 0; rate and impact have no influence."""
        return self.elastic_force(depth)
