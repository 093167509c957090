"""Elastic data of the materials in contact."""

from __future__ import annotations

import math
from typing import Annotated

from pydantic import Field

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
    """

    name: str
    elastic_modulus: Pascals[Positive]
    poisson_ratio: Annotated[Real, Field(ge=0, le=0.5)]
    density: KilogramsPerCubicMetre[Positive]

    @property
    def compliance(self) -> float:
        """h = (1 - nu^2) / (pi E) [1/Pa].

        Eq. 6 of "Dynamic Analysis of Hydraulic Support with Single Clearance".
        """
        return (1.0 - self.poisson_ratio**2) / (math.pi * self.elastic_modulus)


# Table 1 of the same paper: the parts of the support, and the pin.
STEEL = Material(name="steel", elastic_modulus=2.07e11, poisson_ratio=0.29, density=7801.0)
STEEL_35CRMO = Material(name="35CrMo", elastic_modulus=2.06e11, poisson_ratio=0.3, density=7850.0)


def effective_modulus(one: Material, other: Material) -> float:
    """E* [Pa] of two bodies in contact, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

    Source: Johnson, Contact Mechanics (1985), Eq. 4.21.
    """
    return 1.0 / (math.pi * (one.compliance + other.compliance))
