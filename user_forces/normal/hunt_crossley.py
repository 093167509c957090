"""Hunt and Crossley's damped Hertz contact."""

from user_forces.normal.power_law import PowerLaw
from user_forces.values.value import value


@value
class HuntCrossley(PowerLaw):
    """F = K depth^n (1 + chi rate / w), chi = 3 (1 - e) / 2.

    First order in 1 - e: for e near 1.
    Delivers 0.516, 0.581, 0.663, 0.768, 0.909
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.

    Arguments: those of `PowerLaw`; restitution from 0 to 1.

    Source: Hunt and Crossley, J. Appl. Mech. 42 (1975) 440-445.
    """

    def factor(self, restitution: float) -> float:
        """chi = 3 (1 - e) / 2."""
        return 1.5 * (1.0 - restitution)
