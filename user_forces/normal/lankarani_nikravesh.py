"""Lankarani and Nikravesh's damped Hertz contact."""

from user_forces.normal.power_law import PowerLaw
from user_forces.values.value import value


@value
class LankaraniNikravesh(PowerLaw):
    """F = K depth^n (1 + chi rate / w), chi = 3 (1 - e^2) / 4.

    For e > 0.8: derived for small losses. The law of the paper on the hydraulic support.
    Delivers 0.665, 0.684, 0.725, 0.796, 0.913
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.

    Arguments: those of `PowerLaw`; restitution from 0 to 1.

    Source: Lankarani and Nikravesh, J. Mech. Des. 112 (1990) 369-376; Eq. 4 of "Dynamic Analysis of Hydraulic
    Support with Single Clearance", with D = chi K depth^n / v0.
    """

    def factor(self, restitution: float) -> float:
        """chi = 3 (1 - e^2) / 4."""
        return 0.75 * (1.0 - restitution**2)
