"""Stiffness coefficient K of a law F = K depth^n."""

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
    internal contact, R1 R2 / (R2 - R1), and 8 to 16 times stiffer at clearances of 0.5 to 2 mm; this
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
    h1, h2 = journal_material.compliance, bore_material.compliance
    return 4.0 / (3.0 * math.pi * (h1 + h2)) * math.sqrt(r1 * r2 / (r1 + r2))
