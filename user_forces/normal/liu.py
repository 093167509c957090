"""Liu, Zhang and Yang's conforming contact."""

import math

from user_forces.expressions.scalar import log, sqrt, where
from user_forces.normal.cylinder import CylinderLaw
from user_forces.values.value import value


@value
class Liu(CylinderLaw):
    """F_el = pi/2 depth E* L sqrt(depth / (2 (dR + depth))).

    An elastic foundation over the arc of contact: explicit, and for any load; the range ends where the depth
    reaches the journal's radius. Made for conforming contact (small clearance, high load); at light loads it
    is far softer than the laws of line contact, 0.24 of Johnson's force at a depth of dR/100.

    Arguments: those of `CylinderLaw`. Delivers the restitution asked for.

    Source: Liu, Zhang and Yang, Mech. Mach. Theory 42 (2007) 183-197.
    """

    @property
    def largest_depth(self) -> float:
        """The journal's radius [m]."""
        return self.bearing.journal_radius

    def elastic_force(self, depth: float) -> float:
        """F_el [N] of the class's formula."""
        self.check(depth)
        share = depth / (2.0 * (self.bearing.clearance + depth))
        return self._stiffness * depth * sqrt(share)

    def elastic_energy(self, depth: float) -> float:
        """Integral of the force [J]: with x = depth/dR, the integral of x^1.5 / sqrt(1 + x) over x is
        sqrt(x (1 + x)) (2 x - 3)/4 + 3/4 arsinh(sqrt(x)), for small x its series.
        """
        self.check(depth)
        c = self.bearing.clearance
        x = depth / c
        root = sqrt(x)
        closed = root * sqrt(1.0 + x) * (2.0 * x - 3.0) / 4.0 + 0.75 * log(root + sqrt(1.0 + x))
        terms = 1 / 7 - x * (1 / 12 - x * (5 / 88 - x * (35 / 832 - x * (21 / 640))))
        # both are right within 1e-11 at x = 0.02; below, the closed form loses its digits
        integral = where(x < 0.02, root * x * x * (0.4 - x * terms), closed)
        return self._stiffness * c * c / math.sqrt(2.0) * integral

    @property
    def _stiffness(self) -> float:
        return 0.5 * math.pi * self.effective_modulus * self.length
