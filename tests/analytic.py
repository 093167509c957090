"""Closed forms to test against, each with its source. Nothing here is taken from the code under test."""

from __future__ import annotations

import math

from scipy.special import lambertw


def adams_step(x: float, x0: float, h0: float, x1: float, h1: float) -> float:
    """The cubic STEP function of multibody programs, h0 before x0 and h1 after x1.

    Source: MSC Adams function builder, STEP: h0 + (h1 - h0) d^2 (3 - 2 d), d = (x - x0)/(x1 - x0).
    """
    if x <= x0:
        return h0
    if x >= x1:
        return h1
    d = (x - x0) / (x1 - x0)
    return h0 + (h1 - h0) * d**2 * (3.0 - 2.0 * d)


def delivered_restitution(damping: float) -> float:
    """Restitution of a free two-body impact with F = K depth^n (1 + damping rate / initial impact velocity).

    With u = rate/v0 the motion obeys m v0^2 u du = -K depth^n (1 + damping u) d(depth). Depth is the same
    at impact (u = 1) and at separation (u = -e), so the integral of u/(1 + damping u) from -e to 1 is zero:
    damping (1 + e) = ln((1 + damping)/(1 - damping e)). Lambert's W0 solves it for e. Exponent,
    stiffness, masses and speed have dropped out.

    Source: derived here; compare Alves, Peixinho, da Silva, Flores and Lankarani, Mech. Mach. Theory 85
    (2015) 172-188, on what such laws deliver.
    """
    if damping == 0.0:
        return 1.0
    argument = -(1.0 + damping) * math.exp(-(1.0 + damping))
    return (1.0 + float(lambertw(argument).real)) / damping


def sphere_stiffness(
    modulus_1: float, poisson_1: float, modulus_2: float, poisson_2: float, radius: float
) -> float:
    """Hertz: K = 4/3 E* sqrt(R), 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, for the relative radius R.

    Source: Johnson, Contact Mechanics (1985), Eq. 4.23.
    """
    effective = 1.0 / ((1.0 - poisson_1**2) / modulus_1 + (1.0 - poisson_2**2) / modulus_2)
    return 4.0 / 3.0 * effective * math.sqrt(radius)


def fall_through(gap: float, speed: float, gravity: float) -> tuple[float, float]:
    """Time to close a gap in free fall, and the speed then: v^2 = v0^2 + 2 g gap (Torricelli)."""
    final = math.sqrt(speed**2 + 2.0 * gravity * gap)
    return 2.0 * gap / (speed + final), final
