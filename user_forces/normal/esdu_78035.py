"""The line contact of ESDU 78035."""

import math
from typing import ClassVar

from user_forces.normal.cylinder import LogarithmicLaw
from user_forces.values.value import value


@value
class Esdu78035(LogarithmicLaw):
    """depth = p / (pi E*) (ln(4 pi E* dR / p) + 1), p = F/L.

    Johnson's logarithm with another remote point, so the depth is larger, by 13 % at light and 30 % at heavy
    loads. Valid for p < 4 pi E* dR, that is depth < 4 dR.

    Arguments: those of `CylinderLaw`. Delivers the restitution asked for.

    Source: ESDU Tribology Series item 78035 (1978), in the form with h = (1 - nu^2)/(pi E):
    depth = p (h1 + h2) (ln(4 dR / (p (h1 + h2))) + 1).
    """

    TITLE: ClassVar[str] = "ESDU 78035"
    offset: ClassVar[float] = 1.0

    @property
    def scale(self) -> float:
        """4 pi E* dR [N/m]."""
        return 4.0 * math.pi * self.effective_modulus * self.bearing.clearance
