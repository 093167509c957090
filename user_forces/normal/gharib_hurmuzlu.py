"""Gharib and Hurmuzlu's contact for low restitution."""

from user_forces.normal.power_law import PowerLaw
from user_forces.values.value import Restitution, value


@value
class GharibHurmuzlu(PowerLaw):
    """F = K depth^n (1 + chi rate / w), chi = 1 / e.

    For e to 0. It is the largest chi with which the surfaces part with e v0 at all; for e = 1 it still damps.
    Delivers 0.100, 0.282, 0.411, 0.501, 0.567
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.

    Arguments: those of `PowerLaw`; restitution > 0 and <= 1.

    Source: Gharib and Hurmuzlu, J. Appl. Mech. 79 (2012) 064506.
    """

    restitution: Restitution

    def factor(self, restitution: float) -> float:
        """chi = 1 / e."""
        return 1.0 / restitution
