"""Zhiying and Qishao's damped Hertz contact."""

import math

from user_forces.normal.power_law import PowerLaw
from user_forces.values.value import value


@value
class ZhiyingQishao(PowerLaw):
    """F = K depth^n (1 + chi rate / w), chi = 3 (1 - e^2) exp(2 (1 - e)) / 4.

    For e > 0.5.
    Delivers 0.217, 0.327, 0.483, 0.680, 0.896
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.

    Arguments: those of `PowerLaw`; restitution from 0 to 1.

    Source: Zhiying and Qishao, J. Dyn. Control 4 (2006) 294-298.
    """

    def factor(self, restitution: float) -> float:
        """chi = 3 (1 - e^2) exp(2 (1 - e)) / 4."""
        return 0.75 * (1.0 - restitution**2) * math.exp(2.0 * (1.0 - restitution))
