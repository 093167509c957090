"""Gonthier, McPhee, Lange and Piedboeuf's damped Hertz contact."""

from user_forces.normal.power_law import PowerLaw
from user_forces.values.value import Restitution, value


@value
class Gonthier(PowerLaw):
    """F = K depth^n (1 + chi rate / w), chi = (1 - e^2) / e.

    For low e, where it is nearly exact; within 0.033 everywhere.
    Delivers 0.101, 0.304, 0.488, 0.670, 0.876
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.

    Arguments: those of `PowerLaw`; restitution > 0 and <= 1.

    Source: Gonthier, McPhee, Lange and Piedboeuf, Multibody Syst. Dyn. 11 (2004) 209-233.
    """

    restitution: Restitution

    def factor(self, restitution: float) -> float:
        """chi = (1 - e^2) / e."""
        return (1.0 - restitution**2) / restitution
