"""Flores, Machado, Silva and Martins's damped Hertz contact."""

from user_forces.normal.power_law import PowerLaw
from user_forces.values.value import Restitution, value


@value
class Flores(PowerLaw):
    """F = K depth^n (1 + chi rate / w), chi = 8 (1 - e) / (5 e).

    For any e; a little too much damping everywhere.
    Delivers 0.069, 0.256, 0.470, 0.683, 0.894
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.

    Arguments: those of `PowerLaw`; restitution > 0 and <= 1.

    Source: Flores, Machado, Silva and Martins, Multibody Syst. Dyn. 25 (2011) 357-375.
    """

    restitution: Restitution

    def factor(self, restitution: float) -> float:
        """chi = 8 (1 - e) / (5 e)."""
        return 8.0 * (1.0 - restitution) / (5.0 * restitution)
