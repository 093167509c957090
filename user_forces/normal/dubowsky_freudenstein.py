"""Dubowsky and Freudenstein's line contact."""

import math
from typing import ClassVar

from user_forces.normal.cylinder import LogarithmicLaw
from user_forces.values.value import value


@value
class DubowskyFreudenstein(LogarithmicLaw):
    """depth = p / (pi E*) (ln(pi E* L^3 dR / (F R1 R2)) + 1), p = F/L.

    L is the length of the bearing: with L = 2 sqrt(R1 R2) this is `Esdu78035`. Valid for
    p < pi E* dR L^2 / (R1 R2), that is depth < dR L^2 / (R1 R2).

    Arguments: those of `CylinderLaw`. Delivers the restitution asked for.

    Source: Dubowsky and Freudenstein, J. Eng. Ind. 93 (1971) 305-309. Often printed with L to the power m;
    only m = 3 makes the argument of the logarithm a number. See `Goldsmith` for m = 1.
    """

    offset: ClassVar[float] = 1.0

    @property
    def scale(self) -> float:
        """pi E* dR L^2 / (R1 R2) [N/m]."""
        r1, r2 = self.bearing.journal_radius, self.bearing.bore_radius
        return math.pi * self.effective_modulus * self.bearing.clearance * self.length**2 / (r1 * r2)
