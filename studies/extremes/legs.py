"""Machines on hydraulic legs, drawn with all their elements; and whether a leg's oil is conserved."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from studies.extremes.drawn import Draw, Point, Span
from studies.extremes.supports import leg_heads, pressing_roof, settings
from support_exudyn import (
    Body,
    CheckValve,
    ClosedInlet,
    CubicStep,
    Drive,
    EndStops,
    Held,
    HydraulicCylinder,
    IdealPin,
    Inlet,
    Line,
    LinearActuator,
    Linkage,
    Machine,
    OilColumn,
    Poppet,
    PumpStation,
    RampedOpening,
    Reciprocating,
    Result,
    Scenario,
    SealFriction,
    SecondStage,
    Slide,
    SuddenOpening,
    TrappedAir,
    UniformSpeed,
    YieldValve,
    reference_support,
)
from support_exudyn.files.machines import shipped
from support_exudyn.formulations.registry import FormulationName
from support_exudyn.mechanics.hydraulic_legs import static_loads
from support_exudyn.model.hydraulics.elements import ATMOSPHERE
from support_exudyn.model.linkage import GROUND, pinned
from user_forces.values.value import value

Leg = OilColumn | HydraulicCylinder
LEAST = 1e4  # [N], the least load that a leg is made for
BOILING, NO_BOILING = -99e3, -101e3  # gauge pressures [Pa] at which oil boils, and that no oil reaches
DURATION, RECORDS = 0.06, 60  # [s] of a run, and its records
START, END = 0.1 * DURATION, 0.6 * DURATION  # [s] between which valves are open and drives move
STEP = 2e-4  # [s] where steps are chosen
FORMULATIONS: tuple[FormulationName, ...] = ("compiled", "exudyn")
MASS = 16e3  # [kg] of the mass on an upright leg

# --- elements of legs ---

LITRES = Span(1e-5, 1e-2, (3e-3, 3e-2))  # [m^3]
FLOWS = Span(1e-5, 1e-1, (3e-3, 3e-2))  # [m^3/s]
DROPS = Span(1e5, 1e7, (1e5, 1e6))  # [Pa]
DAMPINGS = Span(1.0, 1e6, (1e3, 1e5))  # [N s/m]
ROD_LENGTHS = Span(0.01, 1.0, (0.2, 0.5))  # [m]
STROKE_ENDS = Span(1e-5, 0.2, (1e-4, 0.1))  # [m]
LINE = {"volume": LITRES, "nominal_flow": FLOWS, "nominal_drop": Span(1e4, 1e7, (3e5, 3e6))}
POPPET = {
    "mass": Span(0.01, 10.0, (0.1, 1.0)),
    "stiffness": Span(1e4, 1e8, (1e5, 1e6)),
    "damping": Span(1.0, 1e4, (60.0, 600.0)),
}
# shares of the pressure, of the opening pressure, of the load, of the chamber and of the bore's area
OPENING, CLOSING = Span(0.3, 10.0, (1.05, 3.0)), Span(0.3, 1.0, (0.8, 0.95), even=True)
RATED_FLOW, OVERPRESSURE = Span(1e-6, 1e-1, (1e-3, 2e-2)), Span(1e4, 1e7, (1e6, 1e7))  # [m^3/s], [Pa]
COULOMB, STATIC = Span(1e-3, 1.0, (5e-3, 0.1)), Span(1.0, 3.0, (1.0, 1.5), even=True)
STRIBECK_SPEED, TRANSITION = Span(1e-3, 0.1, (5e-3, 5e-2)), Span(1e-3, 0.5, (0.05, 0.5))  # [m/s], share of it
AIR = Span(1e-5, 0.3, (1e-3, 3e-2))
STAGE_AREA, STAGE_LENGTH = Span(0.3, 0.9, (0.4, 0.8), even=True), Span(0.01, 0.9, (0.1, 0.5))
STOP = {"stiffness": Span(1e7, 1e11, (1e8, 3e9)), "damping": Span(0.01, 10.0, (0.05, 1.0))}
SETTING = Span(0.2, 5.0, (0.9, 1.2))
PUMP_FLOW, PUMP_RANGE, PUMP_LINE = (
    Span(1e-5, 1e-1, (2e-3, 2e-2)), Span(1e-3, 0.9, (0.05, 0.3)), Span(1e-4, 0.1, (5e-3, 5e-2)),
)  # fmt: skip


def drawn_leg(of: Draw, load: float, length: float) -> Leg:
    """A leg that carries a load [N] on a length [m]: a column, or a cylinder, as most that are pulled."""
    cylinder = of.chance(0.9 if load < 0.0 else 0.5)
    load = max(LEAST, abs(load))
    pressure = of.log(2e5, 3e7)
    area, oil_length = load / pressure, length * of.log(0.01, 0.9)
    column = OilColumn(bore_area=area, oil_length=oil_length, bulk_modulus=of.log(3e7, 2e10))
    leg: Leg = _cylinder(of, column, pressure) if cylinder else column
    return with_elements(of, leg, load)


def _cylinder(of: Draw, column: OilColumn, pressure: float) -> HydraulicCylinder:
    tank = pressure * of.even(0.0, 0.5) if of.chance(0.5) else 0.0
    check = CheckValve(
        pilot_ratio=of.log(0.5, 10.0),
        pilot_range=pressure * of.log(1e-3, 1.0),
        cracking_pressure=pressure * of.log(1e-3, 0.3),
    )
    rod: dict[str, Any] = {
        "rod_side_area": column.bore_area * of.even(0.05, 0.9),
        "rod_side_length": of.size(ROD_LENGTHS),
        "system_pressure": tank + pressure * of.log(0.5, 10.0),
    }
    sizes: dict[str, Any] = of.sizes({
        "nominal_flow": FLOWS, "nominal_drop": DROPS, "hose_volume": LITRES, "rod_side_hose_volume": LITRES,
        "damping": DAMPINGS,
    })  # fmt: skip
    return HydraulicCylinder(
        **rod,
        **sizes,
        bore_area=column.bore_area,
        oil_length=column.oil_length,
        bulk_modulus=column.bulk_modulus,
        tank_pressure=tank,
        inlet=_inlet(of),
        check_valve=of.maybe(0.4, lambda: check),
        rod_relief=of.maybe(0.3, lambda: _valve(of, pressure, with_poppet=False)),
    )


def _inlet(of: Draw) -> Inlet:
    extent, kind = of.even(-1.0, 1.0), of.even(0.0, 1.0)
    if kind < 0.2:
        return ClosedInlet()
    if kind < 0.6:
        return SuddenOpening(start=START, end=END, extent=extent)
    return RampedOpening(start=START, end=END, ramp=of.log(1e-4, 0.5 * (END - START)), extent=extent)


def _valve(of: Draw, pressure: float, with_poppet: bool = True) -> YieldValve:
    opening = pressure * of.size(OPENING)
    valve = YieldValve(
        opening_pressure=opening, rated_flow=of.size(RATED_FLOW), rated_overpressure=of.size(OVERPRESSURE)
    )
    kind = of.even(0.0, 1.0)
    if kind < 0.35:
        return replace(valve, closing_pressure=opening * of.size(CLOSING))
    if kind < 0.7 and with_poppet:
        return replace(valve, poppet=Poppet(**of.sizes(POPPET)))
    return valve


def _stops(of: Draw) -> EndStops:
    """Ends of a stroke; in every fifth that need not be sensible there is next to no room."""
    if of.chance(0.0 if of.sensible else 0.2):
        lowest, highest = 0.0, 1e-9
    else:
        lowest, highest = -of.size(STROKE_ENDS), of.size(STROKE_ENDS)
    return EndStops(lowest=lowest, highest=highest, **of.sizes(STOP))


def _stage(of: Draw, leg: Leg, length: float) -> SecondStage:
    area = leg.bore_area * of.size(STAGE_AREA)
    oil_length, stops = of.size(STAGE_LENGTH) * length, _stops(of)
    oil = of.sizes({
        "tube_mass": Span(1.0, 1e3, (20.0, 200.0)), "nominal_flow": FLOWS, "nominal_drop": DROPS,
    })  # fmt: skip
    rod_side_area = leg.bore_area * of.even(0.0, 0.2)
    rest = of.sizes({
        "rod_side_length": ROD_LENGTHS, "damping": DAMPINGS, "release": Span(1e-4, 1e-2, (1e-3, 1e-2)),
    })  # fmt: skip
    return SecondStage(
        bore_area=area, oil_length=oil_length, stops=stops, rod_side_area=rod_side_area, **oil, **rest
    )


def _air(of: Draw, leg: Leg, pressure: float) -> TrappedAir:
    """Air that takes up to a third of the chamber."""
    exponent = of.even(1.0, 1.4)
    volume = of.size(AIR) * leg.bore_area * leg.oil_length
    return TrappedAir(volume=volume * (1.0 + pressure / ATMOSPHERE) ** (1.0 / exponent), exponent=exponent)


def _seals(of: Draw, load: float) -> SealFriction:
    coulomb, speed = load * of.size(COULOMB), of.size(STRIBECK_SPEED)
    static, transition = coulomb * of.size(STATIC), speed * of.size(TRANSITION)
    return SealFriction(coulomb=coulomb, static=static, stribeck_speed=speed, transition_speed=transition)


def with_elements(of: Draw, leg: Leg, load: float) -> Leg:
    """The leg with those elements that are drawn, at least one; load: that it carries at the start [N]."""
    pressure = load / leg.bore_area
    line = Line(**of.sizes(LINE))
    boils = pressure * of.even(-0.5, 0.9) if of.chance(0.0 if of.sensible else 0.2) else BOILING
    stage = of.maybe(0.2, lambda: _stage(of, leg, 1.6))
    made = replace(
        leg,
        yield_valve=of.maybe(0.5, lambda: _valve(of, pressure)),
        vapour_pressure=of.maybe(0.6, lambda: max(boils, NO_BOILING)),
        trapped_air=of.maybe(0.35, lambda: _air(of, leg, pressure)),
        line=of.maybe(0.35, lambda: line),
        seal_friction=of.maybe(0.3, lambda: _seals(of, load)),
        end_stops=_stops(of) if stage is not None or of.chance(0.4) else None,
        second_stage=stage,
        setting_pressure=of.maybe(0.25, lambda: pressure * of.size(SETTING)),
    )
    return made if made.elements else replace(made, vapour_pressure=BOILING)


def drawn_pump(of: Draw, pressure: float) -> PumpStation:
    """A pump that holds a pressure [Pa], mostly too small unless it is to be sensible."""
    flow, pressure_range = of.size(PUMP_FLOW), pressure * of.size(PUMP_RANGE)
    volume, modulus = of.size(PUMP_LINE), of.log(1e8, 2e9)
    return PumpStation(
        flow=flow, pressure=pressure, pressure_range=pressure_range, line_volume=volume, bulk_modulus=modulus
    )


def drawn_drive(of: Draw) -> Drive:
    """A drive that lets oil into columns."""
    stroke = of.log(1e-5, 0.02) * (1.0 if of.chance(0.5) else -1.0)
    period = of.log(0.01, 0.1)
    return of.pick((
        Held(),
        CubicStep(start=START, end=END, stroke=stroke),
        UniformSpeed(start=START, end=END, stroke=stroke),
        Reciprocating(stroke=abs(stroke), period=period),
    ))  # fmt: skip


# --- machines on legs ---


@value
class Upright(Machine):
    """A mass on an upright guide and a leg."""

    def linkage(self) -> Linkage:
        """The mass at 1.6 m over the foot."""
        place = (0.0, 1.6)
        leg = LinearActuator(foot=GROUND, head="mass", foot_point=(0.0, 0.0), head_point=place)
        return Linkage(
            bodies={"mass": Body(mass=MASS, inertia=1.0, centre=place)},
            actuators={"leg": leg},
            slides={"guide": Slide(body="mass", point=place, direction=0.5 * math.pi)},
        )


@value
class CrankOnLeg(Machine):
    """A slider-crank whose crank a leg holds up and swings."""

    def linkage(self) -> Linkage:
        """Crank of 0.5 m, rod of 1.2 m, a leg from the ground to the crank's end."""
        end = (0.4, 0.3)
        slider = (end[0] + math.sqrt(1.2**2 - end[1] ** 2), 0.0)
        leg = LinearActuator(foot=GROUND, head="crank", foot_point=(0.5, -0.7), head_point=end)
        return Linkage(
            bodies={
                "crank": Body(mass=300.0, inertia=10.0, centre=(0.2, 0.15)),
                "rod": Body(mass=200.0, inertia=25.0, centre=(0.5 * (end[0] + slider[0]), 0.5 * end[1])),
                "slider": Body(mass=140.0, inertia=10.0, centre=slider),
            },
            pins={
                "main": pinned(GROUND, "crank", (0.0, 0.0)),
                "crank_pin": pinned("crank", "rod", end),
                "slider_pin": pinned("slider", "rod", slider),
            },
            actuators={"leg": leg},
            slides={"guide": Slide(body="slider", point=slider)},
        )


MACHINES: Mapping[str, tuple[Callable[[], Machine], str]] = {  # and the pin that gets clearance in some scenes
    "upright mass": (Upright, ""),
    "reference support": (reference_support, "rear_base"),
    "two-leg shield": (lambda: shipped("two_leg_shield").machine, "rear_base"),
    "slider-crank on a leg": (CrankOnLeg, "slider_pin"),
}


@cache
def loads_of(name: str) -> dict[str, tuple[float, float]]:
    """The load of every actuator of a machine at the start [N], < 0 if it is pulled, and its length [m]."""
    linkage = MACHINES[name][0]().linkage()
    loads = static_loads(linkage, (0.0, -9.81))
    return {leg: (load, linkage.actuators[leg].start_length) for leg, load in loads.items()}


def on_legs(point: Point, i: int, of: Draw) -> Scenario:
    """A machine on drawn legs: machines take turns, and both formulations; each on columns, cylinders or both.

    Columns are driven, and cylinders have a pump in some scenes. A pin may have clearance, and a roof presses
    the canopy in the end with a share of the legs' load.
    """
    name = [*MACHINES][i % len(MACHINES)]
    make, pin = MACHINES[name]
    machine, loads = make(), loads_of(name)
    legs: dict[str, Leg] = {leg: drawn_leg(of, *carried) for leg, carried in loads.items()}
    cylinders = [leg for leg in legs.values() if isinstance(leg, HydraulicCylinder)]
    pumped = bool(cylinders) and of.chance(0.4)
    pump = drawn_pump(of, cylinders[0].system_pressure) if pumped else None
    drive = drawn_drive(of) if len(cylinders) < len(legs) else Held()
    loose = of.chance(0.4)
    roof = {}
    share = of.log(0.1, 10.0**1.5) if of.chance(0.5) else 0.0
    if share > 0.0 and "canopy" in machine.linkage().bodies:
        force = share * sum(abs(load) for load, _ in loads.values())
        roof = {"roof": pressing_roof(machine, leg_heads(machine), 1e-3, 1e8, force, (0.0, 0.9 * DURATION))}
    return Scenario(
        machine=machine,
        pins={pin: point.pin if loose else IdealPin()} if pin else {},
        actuators=legs,
        pump=pump,
        drive=drive,
        loads=roof,
        duration=DURATION,
        step=STEP,
        record_period=DURATION / RECORDS,
        solver=settings(point),
        formulation=FORMULATIONS[i // len(MACHINES) % 2],
    )


def oil_open(result: Result) -> float:
    """By how much the oil of a leg does not add up at worst, as a share of it; nan where none is counted.

    The oil of a leg is that of the start, and that from inlets or its drive, less that through valves.
    """
    shares: list[float] = []
    for name, model in result.scenario.legs.items():
        if f"{name}.oil" not in result.channels:
            continue
        oil = result[f"{name}.oil"]
        if isinstance(model, HydraulicCylinder):
            inlet = result[f"{name}.let_in"]
        else:
            assert isinstance(model, OilColumn)  # the only other leg
            drive = result.scenario.drive_of(name)
            inlet = model.bore_area * np.array([drive.extension(t) for t in result.time.tolist()])
        valves = [f"{name}.{way}" for way in ("yielded", "relieved") if f"{name}.{way}" in result.channels]
        lost: Any = sum(result[way] - result[way][0] for way in valves)
        shares.append(float(np.abs(oil - oil[0] - (inlet - inlet[0]) + lost).max() / oil[0]))
    return max(shares, default=math.nan)
