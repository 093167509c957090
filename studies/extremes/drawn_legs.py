"""Hydraulic legs with all their elements, and pumps, drawn at their extremes."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from support_exudyn import (
    CheckValve,
    ClosedInlet,
    CubicStep,
    Drive,
    EndStops,
    Held,
    HydraulicCylinder,
    Inlet,
    Line,
    OilColumn,
    Poppet,
    PumpStation,
    RampedOpening,
    Reciprocating,
    SealFriction,
    SecondStage,
    SuddenOpening,
    TrappedAir,
    UniformSpeed,
    YieldValve,
)
from support_exudyn.model.hydraulics.elements import ATMOSPHERE

Leg = OilColumn | HydraulicCylinder
LEAST = 1e4  # [N] that a leg is made for
DURATION = 0.06  # [s] of a run
EVENTS = (0.1, 0.6)  # shares of it between which valves are open and drives move


class _Drawn:
    """Random numbers as they are drawn here."""

    def __init__(self, random: np.random.Generator) -> None:
        self.random = random

    def log(self, low: float, high: float) -> float:
        """A number whose logarithm is even between two."""
        return low * math.pow(high / low, self.even(0.0, 1.0))

    def even(self, low: float, high: float) -> float:
        """A number that is even between two."""
        return float(self.random.uniform(low, high))

    def chance(self, share: float) -> bool:
        """True in so large a share."""
        return self.even(0.0, 1.0) < share


def drawn_leg(random: np.random.Generator, load: float, length: float) -> Leg:
    """A leg that carries a load [N] on a length [m]: a column, or a cylinder, as most that are pulled."""
    of = _Drawn(random)
    cylinder = of.chance(0.9 if load < 0.0 else 0.5)
    load = max(LEAST, abs(load))
    pressure = of.log(2e5, 3e7)
    area, oil_length = load / pressure, length * of.log(0.01, 0.9)
    column = OilColumn(bore_area=area, oil_length=oil_length, bulk_modulus=of.log(3e7, 2e10))
    leg: Leg = _cylinder(of, column, pressure) if cylinder else column
    return _with_elements(of, leg, pressure, load)


def _cylinder(of: _Drawn, column: OilColumn, pressure: float) -> HydraulicCylinder:
    tank = pressure * of.even(0.0, 0.5) if of.chance(0.5) else 0.0
    check = CheckValve(
        pilot_ratio=of.log(0.5, 10.0),
        pilot_range=pressure * of.log(1e-3, 1.0),
        cracking_pressure=pressure * of.log(1e-3, 0.3),
    )
    return HydraulicCylinder(
        bore_area=column.bore_area,
        rod_side_area=column.bore_area * of.even(0.05, 0.9),
        oil_length=column.oil_length,
        rod_side_length=of.log(0.01, 1.0),
        bulk_modulus=column.bulk_modulus,
        system_pressure=tank + pressure * of.log(0.5, 10.0),
        nominal_flow=of.log(1e-5, 1e-1),
        nominal_drop=of.log(1e5, 1e7),
        tank_pressure=tank,
        hose_volume=of.log(1e-5, 1e-2),
        rod_side_hose_volume=of.log(1e-5, 1e-2),
        damping=of.log(1.0, 1e6),
        inlet=_inlet(of),
        check_valve=check if of.chance(0.4) else None,
        rod_relief=_valve(of, pressure, with_poppet=False) if of.chance(0.3) else None,
    )


def _inlet(of: _Drawn) -> Inlet:
    start, end = (share * DURATION for share in EVENTS)
    extent = of.even(-1.0, 1.0)
    kind = of.even(0.0, 1.0)
    if kind < 0.2:
        return ClosedInlet()
    if kind < 0.6:
        return SuddenOpening(start=start, end=end, extent=extent)
    return RampedOpening(start=start, end=end, ramp=of.log(1e-4, 0.5 * (end - start)), extent=extent)


def _valve(of: _Drawn, pressure: float, with_poppet: bool = True) -> YieldValve:
    opening = pressure * of.log(0.3, 10.0)
    valve = YieldValve(
        opening_pressure=opening, rated_flow=of.log(1e-6, 1e-1), rated_overpressure=of.log(1e4, 1e7)
    )
    kind = of.even(0.0, 1.0)
    if kind < 0.35:
        return replace(valve, closing_pressure=opening * of.even(0.3, 1.0))
    if kind < 0.7 and with_poppet:
        poppet = Poppet(mass=of.log(0.01, 10.0), stiffness=of.log(1e4, 1e8), damping=of.log(1.0, 1e4))
        return replace(valve, poppet=poppet)
    return valve


def _stops(of: _Drawn) -> EndStops:
    """Ends of a stroke, in every fifth of which there is next to no room."""
    tight = of.chance(0.2)
    return EndStops(
        lowest=0.0 if tight else -of.log(1e-5, 0.2),
        highest=1e-9 if tight else of.log(1e-5, 0.2),
        stiffness=of.log(1e7, 1e11),
        damping=of.log(0.01, 10.0),
    )


def _stage(of: _Drawn, leg: Leg, length: float) -> SecondStage:
    return SecondStage(
        bore_area=leg.bore_area * of.even(0.3, 0.9),
        oil_length=of.log(0.01, 0.9) * length,
        stops=_stops(of),
        tube_mass=of.log(1.0, 1e3),
        nominal_flow=of.log(1e-5, 1e-1),
        nominal_drop=of.log(1e5, 1e7),
        rod_side_area=leg.bore_area * of.even(0.0, 0.2),
        rod_side_length=of.log(0.01, 1.0),
        damping=of.log(1.0, 1e6),
        release=of.log(1e-4, 1e-2),
    )


def _air(of: _Drawn, leg: Leg, pressure: float) -> TrappedAir:
    """Air that takes up to a third of the chamber."""
    exponent = of.even(1.0, 1.4)
    volume = of.log(1e-5, 0.3) * leg.bore_area * leg.oil_length
    return TrappedAir(volume=volume * (1.0 + pressure / ATMOSPHERE) ** (1.0 / exponent), exponent=exponent)


def _seals(of: _Drawn, load: float) -> SealFriction:
    coulomb, speed = load * of.log(1e-3, 1.0), of.log(1e-3, 0.1)
    return SealFriction(
        coulomb=coulomb,
        static=coulomb * of.even(1.0, 3.0),
        stribeck_speed=speed,
        transition_speed=speed * of.log(1e-3, 0.5),
    )


def _with_elements(of: _Drawn, leg: Leg, pressure: float, load: float) -> Leg:
    """The leg with those elements that are drawn, at least one."""
    line = Line(volume=of.log(1e-5, 1e-2), nominal_flow=of.log(1e-5, 1e-1), nominal_drop=of.log(1e4, 1e7))
    boils = pressure * of.even(-0.5, 0.9) if of.chance(0.2) else -99e3  # the former: at once, or nearly
    stage = _stage(of, leg, 1.6) if of.chance(0.2) else None
    found = replace(
        leg,
        yield_valve=_valve(of, pressure) if of.chance(0.5) else None,
        vapour_pressure=max(boils, -101e3) if of.chance(0.6) else None,
        trapped_air=_air(of, leg, pressure) if of.chance(0.35) else None,
        line=line if of.chance(0.35) else None,
        seal_friction=_seals(of, load) if of.chance(0.3) else None,
        end_stops=_stops(of) if stage is not None or of.chance(0.4) else None,
        second_stage=stage,
        setting_pressure=pressure * of.log(0.2, 5.0) if of.chance(0.25) else None,
    )
    return found if found.elements else replace(found, vapour_pressure=-99e3)


def drawn_pump(random: np.random.Generator, pressure: float) -> PumpStation:
    """A pump that holds a pressure [Pa], mostly too small."""
    of = _Drawn(random)
    return PumpStation(
        flow=of.log(1e-5, 1e-1),
        pressure=pressure,
        pressure_range=pressure * of.log(1e-3, 0.9),
        line_volume=of.log(1e-4, 0.1),
        bulk_modulus=of.log(1e8, 2e9),
    )


def drawn_drive(random: np.random.Generator) -> Drive:
    """What lets oil into columns."""
    of = _Drawn(random)
    start, end = (share * DURATION for share in EVENTS)
    stroke = of.log(1e-5, 0.02) * (1.0 if of.chance(0.5) else -1.0)
    drives: Sequence[Drive] = (
        Held(),
        CubicStep(start=start, end=end, stroke=stroke),
        UniformSpeed(start=start, end=end, stroke=stroke),
        Reciprocating(stroke=abs(stroke), period=of.log(0.01, 0.1)),
    )
    return drives[int(random.integers(len(drives)))]
