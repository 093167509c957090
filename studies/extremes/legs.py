"""Machines on hydraulic legs, drawn with all their elements."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

from studies.extremes.drawn import Draw, Span
from support_exudyn import (
    Body,
    CheckValve,
    ClearancePin,
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
    PlanarLinkage,
    Poppet,
    PumpStation,
    RampedOpening,
    Reciprocating,
    Roof,
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

Leg = OilColumn | HydraulicCylinder
LEAST = 1e4  # [N], the least load that a leg is made for
BOILING, NO_BOILING = -99e3, -101e3  # gauge pressures [Pa] at which oil boils, and that no oil reaches
DURATION, RECORDS = 0.06, 60  # [s] of a run, and its records
START, END = 0.1 * DURATION, 0.6 * DURATION  # [s] between which valves are open and drives move
STEP = 2e-4  # [s] where steps are chosen
FORMULATIONS: tuple[FormulationName, ...] = ("compiled", "exudyn")

LITRES = Span(1e-5, 1e-2, (3e-3, 3e-2))  # [m^3]
FLOWS = Span(1e-5, 1e-1, (3e-3, 3e-2))  # [m^3/s]
DROPS = Span(1e5, 1e7, (1e5, 1e6))  # [Pa]
DAMPINGS = Span(1.0, 1e6, (1e3, 1e5))  # [N s/m]
ROD_LENGTHS = Span(0.01, 1.0, (0.2, 0.5))  # [m]
STROKE_ENDS = Span(1e-5, 0.2, (1e-4, 0.1))  # [m]
SHARES = {  # of the pressure, the opening pressure, the load, its speed, the chamber and the bore's area
    "opening": Span(0.3, 10.0, (1.05, 3.0)),
    "closing": Span(0.3, 1.0, (0.8, 0.95), even=True),
    "setting": Span(0.2, 5.0, (0.9, 1.2)),
    "coulomb": Span(1e-3, 1.0, (5e-3, 0.1)),
    "static": Span(1.0, 3.0, (1.0, 1.5), even=True),
    "transition": Span(1e-3, 0.5, (0.05, 0.5)),
    "air": Span(1e-5, 0.3, (1e-3, 3e-2)),
    "stage_area": Span(0.3, 0.9, (0.4, 0.8), even=True),
    "stage_length": Span(0.01, 0.9, (0.1, 0.5)),
    "pump_range": Span(1e-3, 0.9, (0.05, 0.3)),
}
STRIBECK_SPEED = Span(1e-3, 0.1, (5e-3, 5e-2))  # [m/s]
PUMP_FLOW, PUMP_LINE = Span(1e-5, 1e-1, (2e-3, 2e-2)), Span(1e-4, 0.1, (5e-3, 5e-2))  # [m^3/s], [m^3]
VALVE = {"rated_flow": Span(1e-6, 1e-1, (1e-3, 2e-2)), "rated_overpressure": Span(1e4, 1e7, (1e6, 1e7))}
LINE = {"volume": LITRES, "nominal_flow": FLOWS, "nominal_drop": Span(1e4, 1e7, (3e5, 3e6))}
POPPET = {
    "mass": Span(0.01, 10.0, (0.1, 1.0)),
    "stiffness": Span(1e4, 1e8, (1e5, 1e6)),
    "damping": Span(1.0, 1e4, (60.0, 600.0)),
}
STOP = {"stiffness": Span(1e7, 1e11, (1e8, 3e9)), "damping": Span(0.01, 10.0, (0.05, 1.0))}
CYLINDER = {
    "nominal_flow": FLOWS, "nominal_drop": DROPS, "hose_volume": LITRES, "rod_side_hose_volume": LITRES,
    "damping": DAMPINGS,
}  # fmt: skip
STAGE_OIL = {"tube_mass": Span(1.0, 1e3, (20.0, 200.0)), "nominal_flow": FLOWS, "nominal_drop": DROPS}
STAGE_ROD = {"rod_side_length": ROD_LENGTHS, "damping": DAMPINGS, "release": Span(1e-4, 1e-2, (1e-3, 1e-2))}


# --- elements ---


def drawn_leg(of: Draw, load: float, length: float) -> Leg:
    """A leg that carries a load [N] on a length [m]: a column, or a cylinder, as most that are pulled."""
    is_cylinder = of.chance(0.9 if load < 0.0 else 0.5)
    load = max(LEAST, abs(load))
    pressure = of.log(2e5, 3e7)
    column = OilColumn(
        bore_area=load / pressure, oil_length=length * of.log(0.01, 0.9), bulk_modulus=of.log(3e7, 2e10)
    )
    return with_elements(of, _cylinder(of, column, pressure) if is_cylinder else column, load)


def _cylinder(of: Draw, column: OilColumn, pressure: float) -> HydraulicCylinder:
    """A cylinder with the oil of a column."""
    tank = pressure * of.even(0.0, 0.5) if of.chance(0.5) else 0.0
    check = CheckValve(
        pilot_ratio=of.log(0.5, 10.0),
        pilot_range=pressure * of.log(1e-3, 1.0),
        cracking_pressure=pressure * of.log(1e-3, 0.3),
    )
    return HydraulicCylinder(
        bore_area=column.bore_area,
        oil_length=column.oil_length,
        bulk_modulus=column.bulk_modulus,
        tank_pressure=tank,
        rod_side_area=column.bore_area * of.even(0.05, 0.9),
        rod_side_length=of.size(ROD_LENGTHS),
        system_pressure=tank + pressure * of.log(0.5, 10.0),
        **of.sizes(CYLINDER),
        inlet=_inlet(of),
        check_valve=of.maybe(0.4, lambda: check),
        rod_relief=of.maybe(0.3, lambda: _valve(of, pressure, with_poppet=False)),
    )


def _inlet(of: Draw) -> Inlet:
    """An inlet that stays closed, opens at once or in a ramp."""
    extent, kind = of.even(-1.0, 1.0), of.even(0.0, 1.0)
    if kind < 0.2:
        return ClosedInlet()
    if kind < 0.6:
        return SuddenOpening(start=START, end=END, extent=extent)
    return RampedOpening(start=START, end=END, ramp=of.log(1e-4, 0.5 * (END - START)), extent=extent)


def _valve(of: Draw, pressure: float, with_poppet: bool = True) -> YieldValve:
    """A valve that opens at some share of a pressure [Pa]; it closes at another, has a poppet, or neither."""
    opening = pressure * of.size(SHARES["opening"])
    valve = YieldValve(opening_pressure=opening, **of.sizes(VALVE))
    kind = of.even(0.0, 1.0)
    if kind < 0.35:
        return replace(valve, closing_pressure=opening * of.size(SHARES["closing"]))
    return replace(valve, poppet=Poppet(**of.sizes(POPPET))) if kind < 0.7 and with_poppet else valve


def _stops(of: Draw) -> EndStops:
    """Ends of a stroke; in every fifth that need not be sensible there is next to no room."""
    lowest, highest = 0.0, 1e-9
    if not of.chance(0.0 if of.sensible else 0.2):
        lowest, highest = -of.size(STROKE_ENDS), of.size(STROKE_ENDS)
    return EndStops(lowest=lowest, highest=highest, **of.sizes(STOP))


def _air(of: Draw, leg: Leg, pressure: float) -> TrappedAir:
    """Air that takes up to a third of the chamber."""
    exponent = of.even(1.0, 1.4)
    volume = of.size(SHARES["air"]) * leg.bore_area * leg.oil_length
    return TrappedAir(volume=volume * (1.0 + pressure / ATMOSPHERE) ** (1.0 / exponent), exponent=exponent)


def _seals(of: Draw, load: float) -> SealFriction:
    """Friction of seals, of some share of a load [N]."""
    coulomb, speed = load * of.size(SHARES["coulomb"]), of.size(STRIBECK_SPEED)
    return SealFriction(
        coulomb=coulomb,
        static=coulomb * of.size(SHARES["static"]),
        stribeck_speed=speed,
        transition_speed=speed * of.size(SHARES["transition"]),
    )


def with_elements(of: Draw, leg: Leg, load: float) -> Leg:
    """The leg with those elements that are drawn, at least one; load: that it carries at the start [N]."""
    pressure = load / leg.bore_area
    line = Line(**of.sizes(LINE))
    boils = pressure * of.even(-0.5, 0.9) if of.chance(0.0 if of.sensible else 0.2) else BOILING
    stage = of.maybe(
        0.2,
        lambda: SecondStage(
            bore_area=leg.bore_area * of.size(SHARES["stage_area"]),
            oil_length=1.6 * of.size(SHARES["stage_length"]),
            stops=_stops(of),
            **of.sizes(STAGE_OIL),
            rod_side_area=leg.bore_area * of.even(0.0, 0.2),
            **of.sizes(STAGE_ROD),
        ),
    )
    made = replace(
        leg,
        yield_valve=of.maybe(0.5, lambda: _valve(of, pressure)),
        vapour_pressure=of.maybe(0.6, lambda: max(boils, NO_BOILING)),
        trapped_air=of.maybe(0.35, lambda: _air(of, leg, pressure)),
        line=of.maybe(0.35, lambda: line),
        seal_friction=of.maybe(0.3, lambda: _seals(of, load)),
        end_stops=_stops(of) if stage is not None or of.chance(0.4) else None,
        second_stage=stage,
        setting_pressure=of.maybe(0.25, lambda: pressure * of.size(SHARES["setting"])),
    )
    return made if made.elements else replace(made, vapour_pressure=BOILING)


def drawn_pump(of: Draw, pressure: float) -> PumpStation:
    """A pump that holds a pressure [Pa], mostly too small unless it is to be sensible."""
    return PumpStation(
        pressure=pressure,
        flow=of.size(PUMP_FLOW),
        pressure_range=pressure * of.size(SHARES["pump_range"]),
        line_volume=of.size(PUMP_LINE),
        bulk_modulus=of.log(1e8, 2e9),
    )


def pressing_roof(
    machine: Machine,
    ends: Sequence[float],
    gap: float,
    stiffness: float,
    force: float,
    span: tuple[float, float],
) -> Roof:
    """A roof that closes a gap [m] over the canopy and then loads it with a force [N].

    It lies in the middle of several places [m] along the canopy. stiffness: [N/m]. span: start and end of its
    descent [s].
    """
    place = sum(ends) / len(ends), machine.linkage().points["tip"].point[1]
    descent = CubicStep(stroke=gap + force / stiffness, start=span[0], end=span[1])
    return Roof(body="canopy", point=place, gap=gap, stiffness=stiffness, damping=0.0, descent=descent)


def leg_heads(machine: Machine) -> list[float]:
    """Where the legs carry the canopy, along it [m]."""
    actuators = machine.linkage().actuators.values()
    return [actuator.head_point[0] for actuator in actuators if actuator.head == "canopy"]


# --- machines on legs ---


def upright() -> Machine:
    """A mass of 16 t on an upright guide and a leg, 1.6 m over the foot."""
    place = (0.0, 1.6)
    leg = LinearActuator(foot=GROUND, head="mass", foot_point=(0.0, 0.0), head_point=place)
    drawing = Linkage(
        bodies={"mass": Body(mass=16e3, inertia=1.0, centre=place)},
        actuators={"leg": leg},
        slides={"guide": Slide(body="mass", point=place, direction=0.5 * math.pi)},
    )
    return PlanarLinkage(drawing=drawing)


def crank_on_leg() -> Machine:
    """A slider-crank of 0.5 m and 1.2 m whose crank a leg from the ground holds up and swings."""
    end = (0.4, 0.3)
    slider = (end[0] + math.sqrt(1.2**2 - end[1] ** 2), 0.0)
    leg = LinearActuator(foot=GROUND, head="crank", foot_point=(0.5, -0.7), head_point=end)
    drawing = Linkage(
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
    return PlanarLinkage(drawing=drawing)


MACHINES: Mapping[str, tuple[Callable[[], Machine], str]] = {  # and the pin that gets clearance in some scenes
    "upright mass": (upright, ""),
    "reference support": (reference_support, "rear_base"),
    "two-leg shield": (lambda: shipped("two_leg_shield").machine, "rear_base"),
    "slider-crank on a leg": (crank_on_leg, "slider_pin"),
}


@cache
def loads_of(name: str) -> dict[str, tuple[float, float]]:
    """The load of every actuator of a machine at the start [N], < 0 if it is pulled, and its length [m]."""
    linkage = MACHINES[name][0]().linkage()
    loads = static_loads(linkage, (0.0, -9.81))
    return {leg: (load, linkage.actuators[leg].start_length) for leg, load in loads.items()}


def _drive(of: Draw) -> Drive:
    """A drive that lets oil into columns."""
    stroke = of.log(1e-5, 0.02) * (1.0 if of.chance(0.5) else -1.0)
    period = of.log(0.01, 0.1)
    return of.pick((
        Held(),
        CubicStep(start=START, end=END, stroke=stroke),
        UniformSpeed(start=START, end=END, stroke=stroke),
        Reciprocating(stroke=abs(stroke), period=period),
    ))  # fmt: skip


def on_legs(clearance_pin: ClearancePin, i: int, of: Draw) -> Scenario:
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
    drive = _drive(of) if len(cylinders) < len(legs) else Held()
    loose = of.chance(0.4)
    share = of.log(0.1, 10.0**1.5) if of.chance(0.5) else 0.0
    roof: dict[str, Any] = {}
    if share > 0.0 and "canopy" in machine.linkage().bodies:
        force = share * sum(abs(load) for load, _ in loads.values())
        roof = {"roof": pressing_roof(machine, leg_heads(machine), 1e-3, 1e8, force, (0.0, 0.9 * DURATION))}
    return Scenario(
        machine=machine,
        pins={pin: clearance_pin if loose else IdealPin()} if pin else {},
        actuators=legs,
        pump=pump,
        drive=drive,
        loads=roof,
        duration=DURATION,
        step=STEP,
        record_period=DURATION / RECORDS,
        formulation=FORMULATIONS[i // len(MACHINES) % 2],
    )
