"""Laws for a cylinder in a cylindrical bore that touch along a line of length L."""

import math
from abc import ABC, abstractmethod
from typing import ClassVar

from user_forces.expressions.scalar import is_number, log, maximum, sqrt
from user_forces.journal import JournalBearing
from user_forces.normal.hysteresis import Hysteresis, exact_damping_factor
from user_forces.normal.law import LoadError
from user_forces.values.units import Metres, Pascals
from user_forces.values.value import Positive, Restitution, value

SMALLEST = 1e-14  # of z - 1: at the largest depth, where the root is 1


@value
class CylinderLaw(Hysteresis, ABC):
    """F = L p(depth) (1 + chi rate / w), p the load per length of two parallel cylinders, one in the other.

    chi is the exact damping factor unless a law says otherwise, so a free impact delivers e.

    Arguments:
        bearing: radii R2 of the bore, R1 of the journal, and clearance dR = R2 - R1 [m].
        length: L of the contact, along the axis [m], > 0.
        effective_modulus: E* [Pa], 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2; see
            `user_forces.effective_modulus`.
        restitution: e [-], > 0 and <= 1.
        rest_velocity: smallest w [m/s], > 0; see `Hysteresis`.
    """

    bearing: JournalBearing
    length: Metres[Positive]
    effective_modulus: Pascals[Positive]
    restitution: Restitution

    def factor(self, restitution: float) -> float:
        """chi is the exact damping factor, see there."""
        return exact_damping_factor(restitution)

    def check(self, depth: float) -> None:
        """Raise LoadError if this depth [m] is outside the law's range."""
        if is_number(depth) and depth > self.largest_depth:
            raise LoadError(
                f"{type(self).__name__}: depth = {depth:.6g} m is outside its range; allowed: up to "
                f"{self.largest_depth:.6g} m at a clearance of {self.bearing.clearance:.6g} m. Use a longer "
                "bearing, or a law with a wider range."
            )


@value
class LogarithmicLaw(CylinderLaw):
    """Laws that give the depth for a load p = F/L, as depth = p H (ln(A/p) + c), H = 1/(pi E*).

    Depth rises with load only up to p = A exp(c - 1), at the depth H A exp(c - 1): larger depths have no load
    and are refused. The load for a depth is p = depth / (H y), where y >= 1 is the root of
    y - ln y = z, z = ln(H A / depth) + c, that is y = -W(-exp(-z)) with Lambert's lower branch W.
    """

    offset: ClassVar[float]  # c [-]

    @property
    @abstractmethod
    def scale(self) -> float:
        """A [N/m], the load per length at which the logarithm is zero."""

    @property
    def line_compliance(self) -> float:
        """H [m^2/N]."""
        return 1.0 / (math.pi * self.effective_modulus)

    @property
    def largest_depth(self) -> float:
        """Depth [m] at which the load stops to rise."""
        return self.line_compliance * self.scale * math.exp(self.offset - 1.0)

    def depth_of(self, force: float) -> float:
        """The law as published: depth [m] under a force [N] > 0 at rest."""
        p = force / self.length
        return p * self.line_compliance * (math.log(self.scale / p) + self.offset)

    def elastic_force(self, depth: float) -> float:
        """L p [N]."""
        self.check(depth)
        return self.length / self.line_compliance * depth / self._ratio(depth)

    def elastic_energy(self, depth: float) -> float:
        """Integral of the force, L depth^2 (2 y - 1) / (4 H y^2) [J]."""
        self.check(depth)
        y = self._ratio(depth)
        return self.length / (4.0 * self.line_compliance) * depth * depth * (2.0 - 1.0 / y) / y

    def _ratio(self, depth: float) -> float:
        """y of this depth, by three Newton steps from a guess that is right at z = 1 and within 14 % beyond."""
        excess = math.log(self.line_compliance * self.scale) + self.offset - 1.0 - log(depth)
        excess = maximum(excess, SMALLEST)  # z - 1 >= 0
        y = 1.0 + sqrt(2.0 * excess) + excess
        for _ in range(3):
            y = (log(y) + excess) / (1.0 - 1.0 / y)
        return y
