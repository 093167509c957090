"""Laws for a cylinder in a cylindrical bore that touch along a line of length L."""

from __future__ import annotations

import math
from abc import ABC
from functools import cached_property
from typing import Annotated, ClassVar

from pydantic import Field, model_validator

from user_forces.journal import JournalBearing
from user_forces.kernel import kernel
from user_forces.normal.hysteresis import Hysteresis, exact_damping_factor
from user_forces.values.units import Metres, Pascals
from user_forces.values.value import NonNegative, Positive, Real, Restitution, value

SMALLEST = 1e-14  # of z - 1: at the largest depth, where the root is 1
SMALLEST_MM, BRANCH_MM, LARGEST_MM = 0.005, 0.34954, 10.0  # of the clearance dR, see `Pereira`


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

    @property
    def _range_note(self) -> str:
        gap = self.bearing.clearance
        return f" at a clearance of {gap:.6g} m. Use a longer bearing, or a law with a wider range."


@kernel
def load_ratio(depth: float, line_compliance: float, scale: float, offset: float) -> float:
    """The root y >= 1 of y - ln y = ln(H A / depth) + c, see `LogarithmicLaw`.

    Three Newton steps from a guess that is right at the largest depth and within 14 % elsewhere.
    """
    excess = math.log(line_compliance * scale) + offset - 1.0 - math.log(depth)
    excess = excess if excess > SMALLEST else SMALLEST
    y = 1.0 + math.sqrt(2.0 * excess) + excess
    for _ in range(3):
        y = (math.log(y) + excess) / (1.0 - 1.0 / y)
    return y


@value
class LogarithmicLaw(CylinderLaw, ABC):
    """Laws that give the depth for a load p = F/L, as depth = p H (ln(A/p) + c), H = 1/(pi E*).

    Depth rises with load only up to p = A exp(c - 1), at the depth H A exp(c - 1): larger depths have no load
    and are refused. The load for a depth is p = depth / (H y), where y >= 1 is the root of
    y - ln y = z, z = ln(H A / depth) + c, that is y = -W(-exp(-z)) with Lambert's lower branch W.
    """

    offset: ClassVar[float]  # c [-]

    @property
    def scale(self) -> float:
        """A [N/m], the load per length at which the logarithm is zero: 4 pi E* dR."""
        return 4.0 * math.pi * self.effective_modulus * self.bearing.clearance

    @property
    def line_compliance(self) -> float:
        """H [m^2/N]."""
        return 1.0 / (math.pi * self.effective_modulus)

    @property
    def largest_depth(self) -> float:
        """Depth [m] at which the load stops to rise."""
        return self.line_compliance * self.scale * math.exp(self.offset - 1.0)

    @staticmethod
    @kernel
    def elastic(depth: float, length: float, line_compliance: float, scale: float, offset: float) -> float:
        """L p [N]."""
        return length / line_compliance * depth / load_ratio(depth, line_compliance, scale, offset)

    @staticmethod
    @kernel
    def energy(depth: float, length: float, line_compliance: float, scale: float, offset: float) -> float:
        """Integral of the force, L depth^2 (2 y - 1) / (4 H y^2) [J]."""
        y = load_ratio(depth, line_compliance, scale, offset)
        return length / (4.0 * line_compliance) * depth * depth * (2.0 - 1.0 / y) / y


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

    @property
    def clearance(self) -> float:
        """dR [m]."""
        return self.bearing.clearance

    @property
    def foundation(self) -> float:
        """pi/2 E* L [N/m]."""
        return 0.5 * math.pi * self.effective_modulus * self.length

    @staticmethod
    @kernel
    def elastic(depth: float, foundation: float, clearance: float) -> float:
        """F_el [N] of the class's formula."""
        return foundation * depth * math.sqrt(depth / (2.0 * (clearance + depth)))

    @staticmethod
    @kernel
    def energy(depth: float, foundation: float, clearance: float) -> float:
        """Integral of the force [J]: with x = depth/dR, the integral of x^1.5 / sqrt(1 + x) over x is
        sqrt(x (1 + x)) (2 x - 3)/4 + 3/4 arsinh(sqrt(x)), for small x its series.
        """
        x = depth / clearance
        root = math.sqrt(x)
        if x < 0.02:  # both are right within 1e-11 at x = 0.02; below, the closed form loses its digits
            terms = 1 / 7 - x * (1 / 12 - x * (5 / 88 - x * (35 / 832 - x * (21 / 640))))
            integral = root * x * x * (0.4 - x * terms)
        else:
            integral = root * math.sqrt(1.0 + x) * (2.0 * x - 3.0) / 4.0
            integral += 0.75 * math.log(root + math.sqrt(1.0 + x))
        return foundation * clearance * clearance / math.sqrt(2.0) * integral


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

    @staticmethod
    @kernel
    def elastic(depth: float, stiffness: float, exponent: float) -> float:
        """K depth^n [N]."""
        return float(stiffness * depth**exponent)

    @staticmethod
    @kernel
    def energy(depth: float, stiffness: float, exponent: float) -> float:
        """K depth^(n+1) / (n+1) [J]."""
        return float(stiffness / (exponent + 1.0) * depth ** (exponent + 1.0))
