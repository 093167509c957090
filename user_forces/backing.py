"""How much pin and link give besides the contact of their surfaces: stiffnesses in series with it."""

import math
from collections.abc import Iterable

from user_forces.materials import Material


def pin_stiffness(radius: float, length: float, material: Material) -> float:
    """Stiffness [N/m] of a pin that is held at both ends of its bore, by bending and shear.

        1/k = L^3 / (720 E I) + L / (12 kappa G A)

    The mean deflection of a clamped beam over the load, which is spread evenly over its length. kappa is
    Cowper's shear factor of the circle, 6 (1 + nu) / (7 + 6 nu).

    Arguments:
        radius: of the pin [m], > 0.
        length: L of the bore, along the axis [m], > 0.
        material: of the pin.

    Source: Timoshenko and Gere, Mechanics of Materials (1972); Cowper, J. Appl. Mech. 33 (1966) 335-340.
    """
    nu, modulus = material.poisson_ratio, material.elastic_modulus
    area, moment = math.pi * radius**2, 0.25 * math.pi * radius**4
    factor = 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu)
    bending = length**3 / (720.0 * modulus * moment)
    shear = length / (12.0 * factor * 0.5 * modulus / (1.0 + nu) * area)
    return 1.0 / (bending + shear)


def bar_stiffness(mass: float, length: float, material: Material) -> float:
    """Stiffness E A / l [N/m] of a link along its axis, A = m / (rho l) its mean section.

    Arguments:
        mass: m of the link [kg], > 0.
        length: l between its pins [m], > 0.
        material: of the link.
    """
    return material.elastic_modulus * mass / (material.density * length**2)


def in_series(stiffnesses: Iterable[float]) -> float:
    """Stiffness [N/m] of springs one behind the other; infinite for none."""
    give = sum(1.0 / one for one in stiffnesses)
    return 1.0 / give if give > 0.0 else math.inf
