"""Radzimovsky's line contact."""

from typing import Annotated, ClassVar

from pydantic import Field

from user_forces.normal.cylinder import LogarithmicLaw
from user_forces.values.value import Real, value


@value
class Radzimovsky(LogarithmicLaw):
    """depth = p / (pi E*) (2/3 + ln(4 R1 / b) + ln(4 R2 / b)), b = k sqrt(p R1 R2 / (E* dR)), p = F/L.

    Multibody papers print k = 1.60 and radii. In its origin 1.60 belongs to diameters and to the full width of
    the contact, which is k = 4/sqrt(pi) = 2.26 with radii; Hertz's half width is k = 1.13. The depth differs
    by 4 to 9 % between them. Valid for p < (16/k^2) exp(-1/3) E* dR: for k = 1.60, depth < 1.43 dR.

    Arguments: those of `CylinderLaw`, and
        width_factor: k [-], 1.60 by default, from 1 to 2.5.
    Delivers the restitution asked for.

    Source: Radzimovsky, Univ. Illinois Eng. Exp. Station Bulletin 408 (1953); as printed by Pereira, Ramalho
    and Ambrosio, Nonlinear Dyn. 63 (2011) 681-697.
    """

    offset: ClassVar[float] = 2.0 / 3.0

    width_factor: Annotated[Real, Field(ge=1, le=2.5)] = 1.6

    @property
    def scale(self) -> float:
        """16 E* dR / k^2 [N/m]."""
        return 16.0 * self.effective_modulus * self.bearing.clearance / self.width_factor**2
