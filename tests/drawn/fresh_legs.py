"""Hydraulic legs as they are in supports, with elements drawn: valves, hoses, air, seals, cavities, stages.

Sizes are those of catalogues: what a leg of this load has, not what it might stand.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from support_exudyn import (
    CheckValve,
    EndStops,
    HydraulicCylinder,
    Line,
    OilColumn,
    Poppet,
    PumpStation,
    SealFriction,
    SecondStage,
    TrappedAir,
    YieldValve,
)
from support_exudyn.model.hydraulics.elements import ATMOSPHERE

Leg = OilColumn | HydraulicCylinder
BOILING = -99e3  # [Pa]
STEEL = 7.8e3  # [kg/m^3]


def between(random: np.random.Generator, low: float, high: float) -> float:
    """Draw a value, evenly by its logarithm."""
    return float(low * (high / low) ** random.uniform())


def with_elements(random: np.random.Generator, leg: Leg, load: float) -> Leg:
    """The leg with elements drawn, at least one; load: that it carries at the start [N]."""
    pressure = load / leg.bore_area
    drawn: dict[str, tuple[float, Callable[[], object]]] = {
        "yield_valve": (0.6, lambda: _valve(random, pressure)),
        "vapour_pressure": (0.6, lambda: BOILING),
        "trapped_air": (0.4, lambda: _air(random, leg, pressure)),
        "line": (0.5, lambda: hose(random)),
        "seal_friction": (0.3, lambda: _seals(random, load)),
        "end_stops": (0.3, lambda: _stops(random)),
        "setting_pressure": (0.2, lambda: pressure * float(random.uniform(0.9, 1.2))),
    }
    found: dict[str, object] = {
        name: make() if random.uniform() < share else None for name, (share, make) in drawn.items()
    }
    if isinstance(leg, HydraulicCylinder):
        found["check_valve"] = CheckValve(pilot_ratio=4.0) if random.uniform() < 0.5 else None
        found["rod_relief"] = _valve(random, 5.0 * pressure) if random.uniform() < 0.3 else None
    if random.uniform() < 0.2:
        found |= {"end_stops": _stops(random), "second_stage": _stage(random, leg)}
    made = replace(leg, **found)  # type: ignore[arg-type]
    return made if made.elements else replace(leg, vapour_pressure=BOILING)


def hose(random: np.random.Generator) -> Line:
    """Draw a hose of 3 to 30 l that takes 0.3 to 3 MPa at 200 l/min."""
    return Line(
        volume=between(random, 3e-3, 3e-2),
        nominal_flow=200e-3 / 60.0,
        nominal_drop=between(random, 3e5, 3e6),
    )


def pump(random: np.random.Generator, pressure: float) -> PumpStation:
    """A station that holds a pressure [Pa], for legs of this size."""
    return PumpStation(
        flow=between(random, 2e-3, 2e-2),
        pressure=pressure,
        pressure_range=pressure * float(random.uniform(0.05, 0.3)),
        line_volume=between(random, 5e-3, 5e-2),
    )


def _valve(random: np.random.Generator, pressure: float) -> YieldValve:
    opening = pressure * float(random.uniform(1.05, 3.0))
    valve = YieldValve(
        opening_pressure=opening,
        rated_flow=between(random, 1e-3, 2e-2),
        rated_overpressure=opening * float(random.uniform(0.05, 0.2)),
    )
    kind = random.uniform()
    if kind < 0.3:
        return replace(valve, closing_pressure=opening * float(random.uniform(0.8, 0.95)))
    if kind < 0.6:
        mass, stiffness = between(random, 0.1, 1.0), between(random, 1e5, 1e6)
        damping = float(random.uniform(0.1, 1.0)) * 2.0 * float(np.sqrt(mass * stiffness))
        return replace(valve, poppet=Poppet(mass=mass, stiffness=stiffness, damping=damping))
    return valve


def _air(random: np.random.Generator, leg: Leg, pressure: float) -> TrappedAir:
    """Air that takes 0.1 to 3 % of the chamber at the start."""
    exponent = float(random.uniform(1.0, 1.4))
    volume = between(random, 1e-3, 3e-2) * leg.bore_area * leg.oil_length
    return TrappedAir(volume=volume * (1.0 + pressure / ATMOSPHERE) ** (1.0 / exponent), exponent=exponent)


def _seals(random: np.random.Generator, load: float) -> SealFriction:
    coulomb = load * between(random, 5e-3, 0.1)
    return SealFriction(
        coulomb=coulomb,
        static=coulomb * float(random.uniform(1.0, 1.5)),
        stribeck_speed=between(random, 5e-3, 5e-2),
        transition_speed=between(random, 5e-4, 5e-3),
    )


def _stops(random: np.random.Generator) -> EndStops:
    """Ends of a stroke, often near enough to be met."""
    return EndStops(
        lowest=-between(random, 1e-4, 0.1),
        highest=between(random, 1e-4, 0.1),
        stiffness=between(random, 1e8, 3e9),
        damping=float(random.uniform(0.05, 1.0)),
    )


def _stage(random: np.random.Generator, leg: Leg) -> SecondStage:
    bore = leg.bore_area * float(random.uniform(0.4, 0.8))
    return SecondStage(
        bore_area=bore,
        oil_length=float(random.uniform(0.2, 0.8)),
        stops=EndStops(lowest=-0.2, highest=0.2, stiffness=between(random, 1e8, 3e9)),
        tube_mass=STEEL * 0.2 * bore,  # a metre of its wall
        nominal_flow=between(random, 3e-3, 3e-2),
        nominal_drop=between(random, 1e5, 1e6),
        rod_side_area=0.1 * bore,
        rod_side_length=0.3,
        damping=between(random, 1e3, 1e5),
    )
