"""Machines on hydraulic legs with all their elements, drawn at their extremes; and whether oil is conserved."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from typing import Any, TypeVar

import numpy as np

from studies.extremes.ranges import Point
from studies.extremes.scenes import logarithmic, pressing_roof, settings
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
from user_forces.values.value import Vector2, value

Leg = OilColumn | HydraulicCylinder
Span = tuple[float, float]
Made = TypeVar("Made")
LEAST = 1e4  # [N] that a leg is made for
DURATION, RECORDS = 0.06, 60  # [s] of a run, and its records
START, END = 0.1 * DURATION, 0.6 * DURATION  # valves are open and drives move in between [s]
STEP = 2e-4  # [s] where steps are chosen
FORMULATIONS: tuple[FormulationName, ...] = ("compiled", "exudyn")
MASS = 16e3  # [kg] of the upright one
LITRES, FLOWS, DROPS, DAMPINGS = (
    (1e-5, 1e-2),
    (1e-5, 1e-1),
    (1e5, 1e7),
    (1.0, 1e6),
)  # [m^3], [m^3/s], [Pa], [N s/m]


class Drawn:
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

    def maybe(self, share: float, make: Callable[[], Made]) -> Made | None:
        """An element in so large a share, else none."""
        return make() if self.chance(share) else None

    def make(
        self, kind: Callable[..., Made], *, scale: Mapping[str, float] | None = None, **spans: Span
    ) -> Made:
        """An element whose fields are drawn from these spans by `log`, some of them times a scale."""
        factors = scale or {}
        return kind(**{name: factors.get(name, 1.0) * self.log(*span) for name, span in spans.items()})


# --- elements of legs ---


def drawn_leg(random: np.random.Generator, load: float, length: float) -> Leg:
    """A leg that carries a load [N] on a length [m]: a column, or a cylinder, as most that are pulled."""
    of = Drawn(random)
    cylinder = of.chance(0.9 if load < 0.0 else 0.5)
    load = max(LEAST, abs(load))
    pressure = of.log(2e5, 3e7)
    area, oil_length = load / pressure, length * of.log(0.01, 0.9)
    column = OilColumn(bore_area=area, oil_length=oil_length, bulk_modulus=of.log(3e7, 2e10))
    leg: Leg = _cylinder(of, column, pressure) if cylinder else column
    return _with_elements(of, leg, pressure, load)


def _cylinder(of: Drawn, column: OilColumn, pressure: float) -> HydraulicCylinder:
    tank = pressure * of.even(0.0, 0.5) if of.chance(0.5) else 0.0
    ranges = {"pilot_range": (1e-3, 1.0), "cracking_pressure": (1e-3, 0.3)}
    by_pressure = dict.fromkeys(ranges, pressure)
    check = of.make(CheckValve, scale=by_pressure, pilot_ratio=(0.5, 10.0), **ranges)
    made: dict[str, Any] = {
        "rod_side_area": column.bore_area * of.even(0.05, 0.9),
        "rod_side_length": of.log(0.01, 1.0),
        "system_pressure": tank + pressure * of.log(0.5, 10.0),
    }
    spans = {
        "nominal_flow": FLOWS, "nominal_drop": DROPS, "hose_volume": LITRES, "rod_side_hose_volume": LITRES,
        "damping": DAMPINGS,
    }  # fmt: skip
    made |= {name: of.log(*span) for name, span in spans.items()}
    return HydraulicCylinder(
        **made,
        bore_area=column.bore_area,
        oil_length=column.oil_length,
        bulk_modulus=column.bulk_modulus,
        tank_pressure=tank,
        inlet=_inlet(of),
        check_valve=of.maybe(0.4, lambda: check),
        rod_relief=of.maybe(0.3, lambda: _valve(of, pressure, with_poppet=False)),
    )


def _inlet(of: Drawn) -> Inlet:
    extent, kind = of.even(-1.0, 1.0), of.even(0.0, 1.0)
    if kind < 0.2:
        return ClosedInlet()
    if kind < 0.6:
        return SuddenOpening(start=START, end=END, extent=extent)
    return RampedOpening(start=START, end=END, ramp=of.log(1e-4, 0.5 * (END - START)), extent=extent)


def _valve(of: Drawn, pressure: float, with_poppet: bool = True) -> YieldValve:
    opening = pressure * of.log(0.3, 10.0)
    valve = YieldValve(
        opening_pressure=opening, rated_flow=of.log(1e-6, 1e-1), rated_overpressure=of.log(1e4, 1e7)
    )
    kind = of.even(0.0, 1.0)
    if kind < 0.35:
        return replace(valve, closing_pressure=opening * of.even(0.3, 1.0))
    if kind < 0.7 and with_poppet:
        poppet = of.make(Poppet, mass=(0.01, 10.0), stiffness=(1e4, 1e8), damping=(1.0, 1e4))
        return replace(valve, poppet=poppet)
    return valve


def _stops(of: Drawn) -> EndStops:
    """Ends of a stroke, in every fifth of which there is next to no room."""
    if of.chance(0.2):
        lowest, highest = 0.0, 1e-9
    else:
        lowest, highest = -of.log(1e-5, 0.2), of.log(1e-5, 0.2)
    return EndStops(lowest=lowest, highest=highest, stiffness=of.log(1e7, 1e11), damping=of.log(0.01, 10.0))


def _stage(of: Drawn, leg: Leg, length: float) -> SecondStage:
    area = leg.bore_area * of.even(0.3, 0.9)
    oil_length, stops = of.log(0.01, 0.9) * length, _stops(of)
    oil: dict[str, Any] = {
        "tube_mass": of.log(1.0, 1e3),
        "nominal_flow": of.log(*FLOWS),
        "nominal_drop": of.log(*DROPS),
    }
    rod: dict[str, Any] = {
        "rod_side_area": leg.bore_area * of.even(0.0, 0.2),
        "rod_side_length": of.log(0.01, 1.0),
    }
    rest: dict[str, Any] = {"damping": of.log(*DAMPINGS), "release": of.log(1e-4, 1e-2)}
    return SecondStage(bore_area=area, oil_length=oil_length, stops=stops, **oil, **rod, **rest)


def _air(of: Drawn, leg: Leg, pressure: float) -> TrappedAir:
    """Air that takes up to a third of the chamber."""
    exponent = of.even(1.0, 1.4)
    volume = of.log(1e-5, 0.3) * leg.bore_area * leg.oil_length
    return TrappedAir(volume=volume * (1.0 + pressure / ATMOSPHERE) ** (1.0 / exponent), exponent=exponent)


def _seals(of: Drawn, load: float) -> SealFriction:
    coulomb, speed = load * of.log(1e-3, 1.0), of.log(1e-3, 0.1)
    static, transition = coulomb * of.even(1.0, 3.0), speed * of.log(1e-3, 0.5)
    return SealFriction(coulomb=coulomb, static=static, stribeck_speed=speed, transition_speed=transition)


def _with_elements(of: Drawn, leg: Leg, pressure: float, load: float) -> Leg:
    """The leg with those elements that are drawn, at least one."""
    line = of.make(Line, volume=LITRES, nominal_flow=FLOWS, nominal_drop=(1e4, 1e7))
    boils = pressure * of.even(-0.5, 0.9) if of.chance(0.2) else -99e3  # the former: at once, or nearly
    stage = of.maybe(0.2, lambda: _stage(of, leg, 1.6))
    found = replace(
        leg,
        yield_valve=of.maybe(0.5, lambda: _valve(of, pressure)),
        vapour_pressure=of.maybe(0.6, lambda: max(boils, -101e3)),
        trapped_air=of.maybe(0.35, lambda: _air(of, leg, pressure)),
        line=of.maybe(0.35, lambda: line),
        seal_friction=of.maybe(0.3, lambda: _seals(of, load)),
        end_stops=_stops(of) if stage is not None or of.chance(0.4) else None,
        second_stage=stage,
        setting_pressure=of.maybe(0.25, lambda: pressure * of.log(0.2, 5.0)),
    )
    return found if found.elements else replace(found, vapour_pressure=-99e3)


def drawn_pump(random: np.random.Generator, pressure: float) -> PumpStation:
    """A pump that holds a pressure [Pa], mostly too small."""
    of = Drawn(random)
    flow, pressure_range = of.log(*FLOWS), pressure * of.log(1e-3, 0.9)
    line: dict[str, Any] = {"line_volume": of.log(1e-4, 0.1), "bulk_modulus": of.log(1e8, 2e9)}
    return PumpStation(flow=flow, pressure=pressure, pressure_range=pressure_range, **line)


def drawn_drive(random: np.random.Generator) -> Drive:
    """A drive that lets oil into columns."""
    of = Drawn(random)
    stroke = of.log(1e-5, 0.02) * (1.0 if of.chance(0.5) else -1.0)
    drives = (
        Held(),
        CubicStep(start=START, end=END, stroke=stroke),
        UniformSpeed(start=START, end=END, stroke=stroke),
        Reciprocating(stroke=abs(stroke), period=of.log(0.01, 0.1)),
    )
    return drives[int(random.integers(len(drives)))]


# --- machines on legs ---


@value
class Upright(Machine):
    """A mass on an upright guide and a leg."""

    def linkage(self) -> Linkage:
        """The mass at 1.6 m over the foot."""
        place = (0.0, 1.6)
        return Linkage(
            bodies={"mass": Body(mass=MASS, inertia=1.0, centre=place)},
            actuators={
                "leg": LinearActuator(foot=GROUND, head="mass", foot_point=(0.0, 0.0), head_point=place)
            },
            slides={"guide": Slide(body="mass", point=place, direction=0.5 * math.pi)},
        )


@value
class CrankOnLeg(Machine):
    """A slider-crank whose crank a leg holds up and swings."""

    def linkage(self) -> Linkage:
        """Crank of 0.5 m, rod of 1.2 m, a leg from the ground to the crank's end."""
        end = (0.4, 0.3)
        slider = (end[0] + math.sqrt(1.2**2 - end[1] ** 2), 0.0)
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
            actuators={
                "leg": LinearActuator(foot=GROUND, head="crank", foot_point=(0.5, -0.7), head_point=end)
            },
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


def on_legs(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """A machine on drawn legs: machines take turns, and both formulations; each on columns, cylinders or both.

    Columns are driven, and cylinders have a pump in some scenes. A pin may have clearance, and a roof presses
    the canopy in the end with a share of the legs' load.
    """
    name = [*MACHINES][i % len(MACHINES)]
    make, pin = MACHINES[name]
    machine, loads = make(), loads_of(name)
    legs: dict[str, Leg] = {leg: drawn_leg(random, *carried) for leg, carried in loads.items()}
    cylinders = [leg for leg in legs.values() if isinstance(leg, HydraulicCylinder)]
    pumped = bool(cylinders) and random.uniform() < 0.4
    pump = drawn_pump(random, cylinders[0].system_pressure) if pumped else None
    drive = drawn_drive(random) if len(cylinders) < len(legs) else Held()
    loose = random.uniform() < 0.4
    share = logarithmic(random, -1.0, 1.5) if random.uniform() < 0.5 else 0.0
    roof = {}
    if share > 0.0 and "canopy" in machine.linkage().bodies:
        force = share * sum(abs(load) for load, _ in loads.values())
        roof = {"roof": pressing_roof(_over_columns(machine), 1e-3, 1e8, force, (0.0, 0.9 * DURATION))}
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


def _over_columns(machine: Machine) -> Vector2:
    """The place of the canopy over its columns."""
    linkage = machine.linkage()
    x = [actuator.head_point[0] for actuator in linkage.actuators.values() if actuator.head == "canopy"]
    return sum(x) / len(x), linkage.points["tip"].point[1]


def oil_open(result: Result) -> float:
    """By how much the oil of a leg does not add up at worst, as a share of it; nan where none is counted.

    The oil of a leg is that of the start, and that from inlets or its drive, less that through valves.
    """
    found: list[float] = []
    for name, model in result.scenario.legs.items():
        if f"{name}.oil" not in result.channels:
            continue
        oil = result[f"{name}.oil"]
        if isinstance(model, HydraulicCylinder):
            got = result[f"{name}.let_in"]
        else:
            assert isinstance(model, OilColumn)  # the only other leg
            drive = result.scenario.drive_of(name)
            got = model.bore_area * np.array([drive.extension(t) for t in result.time.tolist()])
        ways = [f"{name}.{way}" for way in ("yielded", "relieved") if f"{name}.{way}" in result.channels]
        lost: Any = sum(result[way] - result[way][0] for way in ways)
        found.append(float(np.abs(oil - oil[0] - (got - got[0]) + lost).max() / oil[0]))
    return max(found, default=math.nan)
