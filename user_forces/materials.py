"""Elastic data of materials, and the stiffness coefficient K of laws F = K depth^1.5 that follows from them."""

import math
from typing import Annotated

from pydantic import Field

from user_forces.journal import JournalBearing
from user_forces.values.units import KilogramsPerCubicMetre, Pascals
from user_forces.values.value import Positive, Real, Value, value


@value
class Material(Value):
    """An isotropic linear elastic material.

    Arguments:
        name: what it is called, for reports.
        elastic_modulus: E [Pa], > 0.
        poisson_ratio: nu [-], from 0 to 0.5.
        density: rho [kg/m^3], > 0.
        yield_strength: in tension [Pa], > 0; None: not known, and no pressure is held against it.
    """

    name: str
    elastic_modulus: Pascals[Positive]
    poisson_ratio: Annotated[Real, Field(ge=0, le=0.5)]
    density: KilogramsPerCubicMetre[Positive]
    yield_strength: Pascals[Positive] | None = None

    @property
    def compliance(self) -> float:
        """h = (1 - nu^2) / (pi E) [1/Pa].

        Eq. 6 of "Dynamic Analysis of Hydraulic Support with Single Clearance".
        """
        return (1.0 - self.poisson_ratio**2) / (math.pi * self.elastic_modulus)


# Table 1 of the same paper: the parts of the support, and the pin. It tells no yield strength. Here the parts
# have that of S355 plates of 16 to 40 mm (EN 10025-2), the pin that of tempered 35CrMo (GB/T 3077).
STEEL = Material(
    name="steel", elastic_modulus=2.07e11, poisson_ratio=0.29, density=7801.0, yield_strength=3.45e8
)
STEEL_35CRMO = Material(
    name="35CrMo", elastic_modulus=2.06e11, poisson_ratio=0.3, density=7850.0, yield_strength=8.35e8
)


def effective_modulus(one: Material, other: Material) -> float:
    """E* [Pa] of two bodies in contact, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

    Source: Johnson, Contact Mechanics (1985), Eq. 4.21.
    """
    return 1.0 / (math.pi * (one.compliance + other.compliance))


def external_contact_stiffness(
    bearing: JournalBearing, bore_material: Material, journal_material: Material
) -> float:
    """Hertz stiffness K of two spheres that touch from outside: the paper's choice for a pin in its bore.

        K = 4 / (3 pi (h1 + h2)) sqrt(R1 R2 / (R1 + R2))

    with journal radius R1, bore radius R2 and h = (1 - nu^2) / (pi E). Two spheres touch in a point, a pin in
    its bore along its length: a steel pin of 128 mm in a bore of 131 mm, 700 mm long, is pressed in by 0.153 mm
    under 51.4 kN with this K, and by 0.002 mm with `line_contact`. It serves to repeat published results.

    Arguments:
        bearing: radii of bore and journal [m].
        bore_material, journal_material: elastic data; exchanging them changes nothing.

    Returns:
        K [N/m^1.5], for the exponent 1.5.

    Source: Eq. 5 and 6 of "Dynamic Analysis of Hydraulic Support with Single Clearance". With Table 1
    and a bore radius of 65.5 mm it gives Table 2.
    """
    r1, r2 = bearing.journal_radius, bearing.bore_radius
    return _sphere_stiffness(bore_material, journal_material, r1 * r2 / (r1 + r2))


def internal_contact_stiffness(
    bearing: JournalBearing, bore_material: Material, journal_material: Material
) -> float:
    """Hertz stiffness K of a sphere in a hollow sphere, which it touches from inside.

        K = 4 / (3 pi (h1 + h2)) sqrt(R1 R2 / (R2 - R1))

    The form that the literature on clearance joints uses for a pin in its bore, which it is not: the pin of
    `external_contact_stiffness` is pressed in by 0.035 mm, 18 times as deep as along its length. It grows
    without bound as the clearance R2 - R1 goes to zero. Symbols, arguments and result: as there.

    Source: Johnson, Contact Mechanics (1985), Eq. 4.23, with the relative curvature 1/R1 - 1/R2.
    """
    r1, r2 = bearing.journal_radius, bearing.bore_radius
    return _sphere_stiffness(bore_material, journal_material, r1 * r2 / bearing.clearance)


def plane_contact_stiffness(radius: float, wall_material: Material, body_material: Material) -> float:
    """Hertz stiffness K of a sphere on a plane, such as a rounded corner of a block on a wall.

        K = 4 / (3 pi (h1 + h2)) sqrt(R)

    Arguments:
        radius: R of the sphere [m].
        wall_material, body_material: elastic data; exchanging them changes nothing.

    Returns:
        K [N/m^1.5], for the exponent 1.5.

    Source: Johnson, Contact Mechanics (1985), Eq. 4.23, with the relative curvature 1/R.
    """
    return _sphere_stiffness(wall_material, body_material, radius)


def _sphere_stiffness(one: Material, other: Material, relative_radius: float) -> float:
    return 4.0 / (3.0 * math.pi * (one.compliance + other.compliance)) * math.sqrt(relative_radius)
