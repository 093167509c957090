"""Carvalho and Martins's damped Hertz contact."""

from user_forces.normal.power_law import PowerLaw
from user_forces.values.value import value


@value
class CarvalhoMartins(PowerLaw):
    """F = K depth^n (1 + chi rate / w), chi = 3 (1 - e) (11 - e) / (2 (1 + 9 e)).

    For e > 1/3, where it is right within 0.003; an approximation of the exact law.
    Delivers 0.129, 0.304, 0.500, 0.700, 0.900
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.

    Arguments: those of `PowerLaw`; restitution from 0 to 1.

    Source: Carvalho and Martins, Mech. Mach. Theory 139 (2019) 174-194.
    """

    def factor(self, restitution: float) -> float:
        """chi = 3 (1 - e) (11 - e) / (2 (1 + 9 e))."""
        return 1.5 * (1.0 - restitution) * (11.0 - restitution) / (1.0 + 9.0 * restitution)
