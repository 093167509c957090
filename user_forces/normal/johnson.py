"""Johnson's line contact."""

import math
from typing import ClassVar

from user_forces.normal.cylinder import LogarithmicLaw
from user_forces.values.value import value


@value
class Johnson(LogarithmicLaw):
    """depth = p / (pi E*) (ln(4 pi E* dR / p) - 1), p = F/L.

    The compression between the contact and the centre of each body, under Hertz's pressure. Valid for
    p < 4 pi E* dR / exp(2), that is depth < 4 dR / exp(2) = 0.54 dR.

    Arguments: those of `CylinderLaw`. Delivers the restitution asked for.

    Source: Johnson, Contact Mechanics (1985), section 5.6, for both bodies; for bearings by Pereira, Ramalho
    and Ambrosio, Nonlinear Dyn. 63 (2011) 681-697. The logarithm was checked by integrating the strains.
    """

    offset: ClassVar[float] = -1.0

    @property
    def scale(self) -> float:
        """4 pi E* dR [N/m]."""
        return 4.0 * math.pi * self.effective_modulus * self.bearing.clearance
