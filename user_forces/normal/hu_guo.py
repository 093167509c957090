"""Hu and Guo's damped Hertz contact."""

from user_forces.normal.power_law import PowerLaw
from user_forces.values.value import Restitution, value


@value
class HuGuo(PowerLaw):
    """F = K depth^n (1 + chi rate / w), chi = 3 (1 - e) / (2 e).

    For any e.
    Delivers 0.074, 0.271, 0.488, 0.697, 0.900
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.

    Arguments: those of `PowerLaw`; restitution > 0 and <= 1.

    Source: Hu and Guo, Multibody Syst. Dyn. 35 (2015) 131-151.
    """

    restitution: Restitution

    def factor(self, restitution: float) -> float:
        """chi = 3 (1 - e) / (2 e)."""
        return 1.5 * (1.0 - restitution) / restitution
