"""Stiffness coefficient K of a law F = K depth^1.5, from radii and materials."""

from __future__ import annotations

import math

from user_forces.journal import JournalBearing
from user_forces.materials import Material


def external_contact_stiffness(
    bearing: JournalBearing, bore_material: Material, journal_material: Material
) -> float:
    """Hertz stiffness of two spheres that touch from outside, used here for a journal in a bore.

        K = 4 / (3 pi (h1 + h2)) sqrt(R1 R2 / (R1 + R2))

    with journal radius R1, bore radius R2 and h = (1 - nu^2) / (pi E). A journal inside a bore is an
    internal contact (`internal_contact_stiffness`), 8 to 16 times stiffer at clearances of 0.5 to 2 mm; this
    is the form the paper uses, so published results can be repeated with it.

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
    """Hertz stiffness of a sphere that touches a hollow sphere from inside.

        K = 4 / (3 pi (h1 + h2)) sqrt(R1 R2 / (R2 - R1))

    with journal radius R1, bore radius R2 and h = (1 - nu^2) / (pi E). The form used for journal bearings in
    the literature on clearance joints. It grows without bound as the clearance R2 - R1 goes to zero.

    Arguments:
        bearing: radii of bore and journal [m].
        bore_material, journal_material: elastic data; exchanging them changes nothing.

    Returns:
        K [N/m^1.5], for the exponent 1.5.

    Source: Johnson, Contact Mechanics (1985), Eq. 4.23, with the relative curvature 1/R1 - 1/R2.
    """
    r1, r2 = bearing.journal_radius, bearing.bore_radius
    return _sphere_stiffness(bore_material, journal_material, r1 * r2 / bearing.clearance)


def _sphere_stiffness(one: Material, other: Material, relative_radius: float) -> float:
    return 4.0 / (3.0 * math.pi * (one.compliance + other.compliance)) * math.sqrt(relative_radius)
