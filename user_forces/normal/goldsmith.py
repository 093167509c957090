"""Goldsmith's line contact."""

import math
from typing import ClassVar

from user_forces.normal.cylinder import LogarithmicLaw
from user_forces.values.units import Metres
from user_forces.values.value import NonNegative, value


@value
class Goldsmith(LogarithmicLaw):
    """depth = p / (pi E*) (ln(pi E* dR l0^2 / (p R1 R2)) + 1), p = F/L.

    As printed (`DubowskyFreudenstein` with L^1 in place of L^3) the argument of the logarithm has a unit, so
    the depth depends on whether one computes in mm or in m: the unit is the length l0 here. In mm and with
    radii of some centimetres the printed law has no solution from loads of some 1e5 N/m on. With the mean
    diameter, our default, it agrees with `Esdu78035`. Valid for depth < dR l0^2 / (R1 R2).

    Arguments: those of `CylinderLaw`, and
        reference_length: l0 [m], > 0; 0 (the default) for 2 sqrt(R1 R2). 1e-3 repeats results in mm.
    Delivers the restitution asked for.

    Source: Goldsmith, Impact (1960); on the units Flores, Ambrosio, Claro and Lankarani, Proc. Inst. Mech.
    Eng. K 220 (2006) 21-34.
    """

    offset: ClassVar[float] = 1.0

    reference_length: Metres[NonNegative] = 0.0

    @property
    def scale(self) -> float:
        """pi E* dR l0^2 / (R1 R2) [N/m]."""
        product = self.bearing.journal_radius * self.bearing.bore_radius
        square = self.reference_length**2 if self.reference_length else 4.0 * product
        return math.pi * self.effective_modulus * self.bearing.clearance * square / product
