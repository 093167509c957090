"""Pereira, Ramalho and Ambrosio's internal cylinder contact."""

from __future__ import annotations

import math
from functools import cached_property

from pydantic import model_validator

from user_forces.expressions.scalar import power
from user_forces.normal.cylinder import CylinderLaw
from user_forces.values.value import value

SMALLEST_MM, BRANCH_MM, LARGEST_MM = 0.005, 0.34954, 10.0  # of the clearance dR


@value
class Pereira(CylinderLaw):
    """F = (0.965 dR + 0.0965) / dR L E* depth^n (1 + chi rate / w), chi = 3 (1 - e^2) / 4,

    in mm, N and N/mm^2, with n = Y dR^-0.005 and

        Y = 1.51 ln(1000 dR)^-0.151    0.005   <= dR < 0.34954 mm
            0.0151 dR + 1.151          0.34954 <= dR <= 10 mm

    An explicit fit to `Johnson`, whose range it inherits: depth < 4 dR / exp(2). For clearances of 0.35 to 2 mm
    and depths of dR/1000 to dR/10 its force is within 12 % of Johnson's. Clearances outside 0.005 to 10 mm
    are refused. Delivers what `LankaraniNikravesh` does: 0.913 for 0.9, 0.725 for 0.5.

    Arguments: those of `CylinderLaw`.

    Source: Pereira, Ramalho and Ambrosio, Nonlinear Dyn. 63 (2011) 681-697; Multibody Syst. Dyn. 35 (2015)
    277-298. Both branches of Y meet within 5e-8, which settles how they are to be read.
    """

    @model_validator(mode="after")
    def _clearance_is_in_range(self) -> Pereira:
        clearance_mm = 1e3 * self.bearing.clearance
        if not SMALLEST_MM <= clearance_mm <= LARGEST_MM:
            raise ValueError(
                f"bearing.clearance = {self.bearing.clearance} m: allowed for this law: from "
                f"{SMALLEST_MM / 1e3} to {LARGEST_MM / 1e3} m"
            )
        return self

    def factor(self, restitution: float) -> float:
        """chi = 3 (1 - e^2) / 4."""
        return 0.75 * (1.0 - restitution**2)

    @cached_property
    def exponent(self) -> float:
        """n [-]."""
        gap_mm = 1e3 * self.bearing.clearance
        y = 1.51 * math.log(1e3 * gap_mm) ** -0.151 if gap_mm < BRANCH_MM else 0.0151 * gap_mm + 1.151
        return float(y * gap_mm**-0.005)

    @cached_property
    def stiffness(self) -> float:
        """K of F_el = K depth^n, depth in m [N/m^n]."""
        gap_mm = 1e3 * self.bearing.clearance
        per_mm = (0.965 * gap_mm + 0.0965) / gap_mm * 1e3 * self.length * 1e-6 * self.effective_modulus
        return float(per_mm * 1e3**self.exponent)

    @property
    def largest_depth(self) -> float:
        """The largest depth is that of Johnson's law, 4 dR / exp(2) [m]."""
        return 4.0 * self.bearing.clearance / math.exp(2.0)

    def elastic_force(self, depth: float) -> float:
        """K depth^n [N]."""
        self.check(depth)
        return self.stiffness * power(depth, self.exponent)

    def elastic_energy(self, depth: float) -> float:
        """K depth^(n+1) / (n+1) [J]."""
        self.check(depth)
        return self.stiffness / (self.exponent + 1.0) * power(depth, self.exponent + 1.0)
