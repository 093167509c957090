"""Herbert and McWhannell's damped Hertz contact."""

from user_forces.normal.power_law import PowerLaw
from user_forces.values.value import value


@value
class HerbertMcWhannell(PowerLaw):
    """F = K depth^n (1 + chi rate / w), chi = 6 (1 - e) / ((2 e - 1)^2 + 3).

    For e near 1.
    Delivers 0.491, 0.520, 0.594, 0.723, 0.901
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.

    Arguments: those of `PowerLaw`; restitution from 0 to 1.

    Source: Herbert and McWhannell, J. Eng. Ind. 99 (1977) 513-518.
    """

    def factor(self, restitution: float) -> float:
        """chi = 6 (1 - e) / ((2 e - 1)^2 + 3)."""
        return 6.0 * (1.0 - restitution) / ((2.0 * restitution - 1.0) ** 2 + 3.0)
