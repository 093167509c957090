"""What makes oil other than a linear spring: trapped air."""

from typing import ClassVar

from support_exudyn.model.hydraulics.sharing import Shared
from user_forces.values.units import CubicMetres
from user_forces.values.value import Positive, Value, value

ATMOSPHERE = 101325.0  # [Pa]; pressures of the program are those above it


@value
class TrappedAir(Shared, Value):
    """Air that stays in the chamber of a leg, and makes its oil softer the lower the pressure is.

        V_air = V0 (p_a / (p + p_a))^(1/n)

    p_a is the pressure of the atmosphere, p that above it. Together with a liquid of bulk modulus B the
    effective modulus is that of Merritt (Hydraulic Control Systems, Wiley 1967, section 2.2),

        1/B_e = 1/B + V_air / (V n (p + p_a))

    The air is not dissolved. Real oil dissolves it at some 10 MPa, and is then stiffer.

    Arguments:
        volume: V0, of the air at the pressure of the atmosphere, all legs of a pair together [m^3], > 0.
        exponent: n [-], > 0; 1: slow changes that keep the temperature, 1.4: fast ones.
    """

    extensive: ClassVar[tuple[str, ...]] = ("volume",)

    volume: CubicMetres[Positive]
    exponent: Positive = 1.4

    def at(self, pressure: float) -> float:
        """V_air [m^3] at a pressure [Pa], > -p_a."""
        volume: float = self.volume * (ATMOSPHERE / (pressure + ATMOSPHERE)) ** (1.0 / self.exponent)
        return volume
