"""Safaeifar and Farshidianfar's damped Hertz contact."""

from user_forces.normal.power_law import PowerLaw
from user_forces.values.value import Restitution, value


@value
class SafaeifarFarshidianfar(PowerLaw):
    """F = K depth^n (1 + chi rate / w), chi = 5 (1 - e) / (4 e).

    For e < 0.4.
    Delivers 0.089, 0.314, 0.536, 0.735, 0.915
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.

    Arguments: those of `PowerLaw`; restitution > 0 and <= 1.

    Source: Safaeifar and Farshidianfar, Multibody Syst. Dyn. 50 (2020) 233-257.
    """

    restitution: Restitution

    def factor(self, restitution: float) -> float:
        """chi = 5 (1 - e) / (4 e)."""
        return 1.25 * (1.0 - restitution) / restitution
