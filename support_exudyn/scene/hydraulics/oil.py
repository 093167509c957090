"""Oil in a chamber: pressure, what the oil carries along, the energy that it stores. Pressures are above p_a.

liquid volume:  W exp(-p/B) (LOG),  W - p V_ref/B (LINEAR)
pressure p:     liquid volume + V_air (p_a/(p + p_a))^(1/n) = V
"""

import math

from support_exudyn.model.hydraulics.elements import ATMOSPHERE, air_volume
from support_exudyn.scene.compilation import compiled, inlined
from support_exudyn.scene.hydraulics.records import LOG, Records

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


@compiled
def fill_chamber(chambers: Records, c: int) -> float:
    """Write pressure [Pa] and cavity [m^3] of a chamber, by its oil and volume; its pressure if nothing boiled.

    And the weight, how much a volume of its oil counts as without pressure, over it, and the enthalpy, how much
    energy its oil carries along per volume without pressure [J/m^3]: B (1 - exp(-p/B)), or p.
    No number where no room or no oil is left, see `fill.empty_legs`.
    """
    chamber = chambers[c]
    law, oil, volume, span, modulus = chamber.law, chamber.oil, chamber.volume, chamber.span, chamber.modulus
    chamber.cavity = 0.0
    if not (volume > 0.0 and oil > 0.0):
        p = math.nan
    elif chamber.air > 0.0:
        p = pressure_with_air(law, oil, volume, span, modulus, chamber.air, chamber.air_exponent)
    else:
        p = liquid_pressure(law, oil, volume, span, modulus)
    chamber.pressure = p
    if p < chamber.vapour:
        chamber.pressure = chamber.vapour
        liquid = liquid_volume(law, oil, chamber.vapour, span, modulus)
        chamber.cavity = volume - liquid - air_volume(chamber.air, chamber.air_exponent, chamber.vapour)
    if law == LOG:
        chamber.weight = oil / volume
        if chamber.air > 0.0 or chamber.cavity > 0.0:
            chamber.weight = math.exp(chamber.pressure / modulus)
        chamber.enthalpy = modulus * (1.0 - 1.0 / chamber.weight)
    else:
        chamber.enthalpy = chamber.pressure
    return float(p)


@compiled
def stored_in(chambers: Records, c: int) -> float:
    """Energy [J] stored in a chamber: in its liquid, its air, and in the cavity, which has been pulled open."""
    chamber = chambers[c]
    pressure, modulus, exponent = chamber.pressure, chamber.modulus, chamber.air_exponent
    if chamber.law == LOG:
        strain = pressure / modulus
        total = chamber.oil * modulus * (-math.expm1(-strain) - strain * math.exp(-strain))
    else:
        total = 0.5 * pressure * pressure * chamber.span / modulus
    if chamber.air > 0.0:
        absolute = pressure + ATMOSPHERE
        volume = air_volume(chamber.air, exponent, pressure)
        if abs(exponent - 1.0) < 1e-9:
            total += ATMOSPHERE * chamber.air * math.log(absolute / ATMOSPHERE)
        else:
            total += (absolute * volume - ATMOSPHERE * chamber.air) / (exponent - 1.0)
        total += ATMOSPHERE * (volume - chamber.air)
    return float(total - pressure * chamber.cavity)
