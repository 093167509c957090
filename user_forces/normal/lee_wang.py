"""Lee and Wang's damped Hertz contact."""

from user_forces.normal.power_law import PowerLaw
from user_forces.values.value import value


@value
class LeeWang(PowerLaw):
    """F = K depth^n (1 + chi rate / w), chi = 3 (1 - e) / 4.

    Half of what the first order in 1 - e asks for, so it loses too little energy at any e < 1.
    Delivers 0.687, 0.739, 0.799, 0.869, 0.952
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.

    Arguments: those of `PowerLaw`; restitution from 0 to 1.

    Source: Lee and Wang, J. Mech. Transm. Autom. Des. 105 (1983) 534-540.
    """

    def factor(self, restitution: float) -> float:
        """chi = 3 (1 - e) / 4."""
        return 0.75 * (1.0 - restitution)
