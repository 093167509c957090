"""Oil in a chamber: pressure, what it carries along, and the energy that it stores. Pressures are above p_a.

liquid volume:  W exp(-p/B) (LOG),  W - p V_ref/B (LINEAR)
pressure p:     liquid volume + V_air (p_a/(p + p_a))^(1/n) = V
"""

import math

from support_exudyn.model.hydraulics.elements import ATMOSPHERE
from support_exudyn.scene.compilation import compiled, inlined
from support_exudyn.scene.hydraulics.records import LOG

ROUNDS = 60  # of Newton's method, which has found the pressure after some six
FOUND = 1e-14  # share of the pressure that it changes no more by


@inlined
def liquid_pressure(law: int, oil: float, volume: float, reference: float, modulus: float) -> float:
    """The pressure [Pa] of oil that fills a volume [m^3] without air."""
    if law == LOG:
        return modulus * math.log(oil / volume)
    return modulus * (oil - volume) / reference


@inlined
def liquid_volume(law: int, oil: float, pressure: float, reference: float, modulus: float) -> float:
    """The volume [m^3] of the liquid at a pressure [Pa]."""
    if law == LOG:
        return oil * math.exp(-pressure / modulus)
    return oil - pressure * reference / modulus


@compiled
def air_volume(air: float, exponent: float, pressure: float) -> float:
    """The volume [m^3] of trapped air at a pressure [Pa]."""
    if air == 0.0:
        return 0.0
    return float(air * (ATMOSPHERE / (pressure + ATMOSPHERE)) ** (1.0 / exponent))


@compiled
def pressure_with_air(
    law: int, oil: float, volume: float, reference: float, modulus: float, air: float, exponent: float
) -> float:
    """The pressure [Pa] of oil and air that fill a volume [m^3], by Newton's method from below.

    What is left of the volume is a convex function of the pressure that falls, so that it never overshoots.
    """
    alone = ATMOSPHERE * (air / volume) ** exponent - ATMOSPHERE
    p = max(liquid_pressure(law, oil, volume, reference, modulus), alone)
    for _ in range(ROUNDS):
        of_air = air_volume(air, exponent, p)
        left = liquid_volume(law, oil, p, reference, modulus) + of_air - volume
        falls = of_air / (exponent * (p + ATMOSPHERE))
        falls += oil * math.exp(-p / modulus) / modulus if law == LOG else reference / modulus
        step = left / falls
        p += step
        if not abs(step) > FOUND * (abs(p) + ATMOSPHERE):
            break
    return float(p)


@inlined
def fill_chamber(
    law: int,
    oil: float,
    volume: float,
    reference: float,
    modulus: float,
    air: float,
    exponent: float,
    lowest: float,
) -> tuple[float, float, float]:
    """Pressure of a chamber if nothing boiled, its pressure [Pa], and the volume of its cavity [m^3].

    No number where no room or no oil is left, see `fill.empty_legs`.

    Arguments:
        law, oil, reference, modulus, air, exponent: see `stored_in`. volume: of the chamber [m^3].
        lowest: pressure at which the oil boils [Pa]; -inf: oil pulls.
    """
    if not (volume > 0.0 and oil > 0.0):
        return math.nan, math.nan, 0.0
    if air > 0.0:
        p = pressure_with_air(law, oil, volume, reference, modulus, air, exponent)
    else:
        p = liquid_pressure(law, oil, volume, reference, modulus)
    if not p < lowest:
        return p, p, 0.0
    liquid = liquid_volume(law, oil, lowest, reference, modulus)
    return p, lowest, volume - liquid - air_volume(air, exponent, lowest)


@inlined
def weight(law: int, pressure: float, modulus: float) -> float:
    """What a volume of oil under pressure [Pa] counts as without pressure, over it."""
    return math.exp(pressure / modulus) if law == LOG else 1.0


@inlined
def enthalpy(law: int, pressure: float, modulus: float) -> float:
    """What oil under pressure [Pa] carries along [J/m^3], per volume without: B (1 - exp(-p/B)), or p."""
    return -modulus * math.expm1(-pressure / modulus) if law == LOG else pressure


@compiled
def stored_in(
    law: int,
    oil: float,
    pressure: float,
    reference: float,
    modulus: float,
    air: float,
    exponent: float,
    cavity: float,
) -> float:
    """Energy [J] stored in a chamber: in its liquid, its air, and in the cavity, which has been pulled open.

    Arguments:
        law: of the oil. oil: as its volume without pressure [m^3]. pressure: in the chamber [Pa].
        reference: volume V_ref of a linear law [m^3]. modulus: B of the oil [Pa].
        air: volume of trapped air without pressure [m^3]. exponent: of its change.
        cavity: volume of the vapour [m^3].
    """
    if law == LOG:
        strain = pressure / modulus
        total = oil * modulus * (-math.expm1(-strain) - strain * math.exp(-strain))
    else:
        total = 0.5 * pressure * pressure * reference / modulus
    if air > 0.0:
        absolute = pressure + ATMOSPHERE
        volume = air_volume(air, exponent, pressure)
        if abs(exponent - 1.0) < 1e-9:
            total += ATMOSPHERE * air * math.log(absolute / ATMOSPHERE)
        else:
            total += (absolute * volume - ATMOSPHERE * air) / (exponent - 1.0)
        total += ATMOSPHERE * (volume - air)
    return float(total - pressure * cavity)
