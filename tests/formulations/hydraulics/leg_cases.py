"""Scenes of masses on legs: every element alone, and all together."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from support_exudyn import (
    Body,
    CheckValve,
    CubicStep,
    EndStops,
    HydraulicCylinder,
    Line,
    LinearActuator,
    Linkage,
    Machine,
    OilColumn,
    Poppet,
    PumpStation,
    RampedOpening,
    Scenario,
    SealFriction,
    SecondStage,
    Slide,
    SuddenOpening,
    TrappedAir,
    UniformSpeed,
    YieldValve,
)
from support_exudyn.model.linkage import GROUND
from user_forces import value

LENGTH = 1.6  # of a leg at the start [m]
MASS = 16000.0  # [kg]


@value
class Uprights(Machine):
    """Masses on upright guides, side by side, each on a leg.

    Arguments:
        masses: [kg]. speed: with which all start upward [m/s].
    """

    masses: tuple[float, ...] = (MASS,)
    speed: float = 0.0

    def linkage(self) -> Linkage:
        places = {f"{n}": (2.0 * n, LENGTH) for n in range(len(self.masses))}
        return Linkage(
            bodies={
                f"mass{n}": Body(mass=self.masses[int(n)], inertia=1.0, centre=at, velocity=(0.0, self.speed))
                for n, at in places.items()
            },
            actuators={
                f"leg{n}": LinearActuator(foot=GROUND, head=f"mass{n}", foot_point=(at[0], 0.0), head_point=at)
                for n, at in places.items()
            },
            slides={
                f"guide{n}": Slide(body=f"mass{n}", point=at, direction=0.5 * math.pi)
                for n, at in places.items()
            },
        )


COLUMN = OilColumn(bore_area=0.098, oil_length=0.5, bulk_modulus=1.5e9)
CYLINDER = HydraulicCylinder(
    bore_area=0.098,
    rod_side_area=0.03,
    oil_length=0.5,
    rod_side_length=1.0,
    bulk_modulus=1.5e9,
    system_pressure=31.5e6,
    tank_pressure=0.5e6,
    nominal_flow=6e-3,
    hose_volume=5e-3,
    rod_side_hose_volume=3e-3,
    damping=2e4,
)
YIELDING = YieldValve(opening_pressure=8e6, rated_flow=4e-3, rated_overpressure=1e6)
WITH_HYSTERESIS = replace(YIELDING, closing_pressure=5e6)
RELIEVING = replace(YIELDING, opening_pressure=6e6, closing_pressure=4e6)
WITH_POPPET = replace(YIELDING, poppet=Poppet(mass=0.5, stiffness=2e6, damping=300.0))
WIDE_AND_SLOW = YieldValve(
    opening_pressure=4e6,
    rated_flow=4e-2,
    rated_overpressure=1e6,
    poppet=Poppet(mass=5.0, stiffness=1e5, damping=200.0),
)
AIR = TrappedAir(volume=2e-3)
LINE = Line(volume=4e-3, nominal_flow=5e-3, nominal_drop=2e6)
SEALS = SealFriction(coulomb=1.5e4, static=2.5e4, stribeck_speed=0.05, transition_speed=0.02)
STOPS = EndStops(lowest=-0.004, highest=0.003, stiffness=2e9, damping=0.4)
WIDE = replace(STOPS, lowest=-0.4, highest=0.4)
STAGE = SecondStage(
    bore_area=0.06,
    oil_length=0.4,
    stops=EndStops(lowest=-0.003, highest=0.5),
    tube_mass=600.0,
    nominal_flow=8e-3,
    rod_side_area=0.012,
    rod_side_length=0.5,
    damping=3e4,
)
CHECK = CheckValve(pilot_ratio=4.0, pilot_range=3e6, cracking_pressure=0.3e6)
VAPOUR = -99e3
UP = SuddenOpening(start=0.01, end=0.06, extent=0.6)
UP_SLOWLY = RampedOpening(start=0.01, end=0.06, ramp=0.02)
DOWN = SuddenOpening(start=0.02, end=0.06, extent=-0.5)
LIFT = CubicStep(start=0.01, end=0.05, stroke=0.01)
SUDDEN_LIFT = UniformSpeed(start=0.01, end=0.06, stroke=0.01)


def scene(leg: Any, speed: float = 0.0, duration: float = 0.08, **changes: Any) -> Scenario:
    """A mass on a leg, thrown up or down."""
    machine = Uprights(speed=speed)
    return Scenario(
        machine=machine, actuators={"leg0": leg}, duration=duration, record_period=duration / 80, **changes
    )


def on_column(speed: float = 0.0, **elements: Any) -> Scenario:
    drive = elements.pop("drive", None)
    return scene(replace(COLUMN, **elements), speed, **({} if drive is None else {"drive": drive}))


def on_cylinder(speed: float = 0.0, **elements: Any) -> Scenario:
    return scene(replace(CYLINDER, **elements), speed)


def two_on_a_pump(inlet: Any, pump: PumpStation, **elements: Any) -> Scenario:
    """A heavy and a light mass, on legs that share a pump."""
    leg = replace(CYLINDER, inlet=inlet, **elements)
    return Scenario(
        machine=Uprights(masses=(MASS, 4000.0)),
        actuators={"leg0": leg, "leg1": replace(leg, nominal_flow=2e-3)},
        pump=pump,
        duration=0.08,
        record_period=1e-3,
    )


PUMP = PumpStation(flow=5e-3, pressure=25e6, pressure_range=2e6, line_volume=5e-3)

CASES: dict[str, Scenario] = {
    "column, plain": on_column(-0.2, drive=LIFT),
    "column, yield valve": on_column(-0.6, yield_valve=YIELDING),
    "column, hysteresis": on_column(-0.6, yield_valve=WITH_HYSTERESIS),
    "column, poppet": on_column(-0.6, yield_valve=WITH_POPPET),
    "column, drained by its poppet": on_column(-0.6, yield_valve=WIDE_AND_SLOW),
    "column, cavity": on_column(0.4, vapour_pressure=VAPOUR),
    "column, air": on_column(-0.2, trapped_air=AIR),
    "column, line": on_column(-0.2, line=LINE, drive=LIFT),
    "column, line and jump": on_column(0.0, line=LINE, drive=SUDDEN_LIFT),
    "column, drive": on_column(0.1, vapour_pressure=VAPOUR, drive=SUDDEN_LIFT),
    "column, seals": on_column(0.05, seal_friction=SEALS),
    "column, stops": on_column(0.5, end_stops=STOPS),
    "column, two stages": on_column(-0.2, second_stage=STAGE, end_stops=WIDE),
    "column, setting": on_column(0.0, setting_pressure=4e6),
    "column, everything": on_column(
        -0.6,
        yield_valve=WITH_HYSTERESIS, vapour_pressure=VAPOUR, trapped_air=AIR, line=LINE, seal_friction=SEALS,
        end_stops=STOPS, second_stage=STAGE, setting_pressure=3e6, drive=LIFT,
    ),
    "cylinder, plain": on_cylinder(-0.2, inlet=UP),
    "cylinder, pulled": on_cylinder(0.3, inlet=DOWN),
    "cylinder, yield valve": on_cylinder(-0.6, yield_valve=YIELDING),
    "cylinder, hysteresis": on_cylinder(-0.6, yield_valve=WITH_HYSTERESIS),
    "cylinder, poppet": on_cylinder(-0.6, yield_valve=WITH_POPPET),
    "cylinder, drained by its poppet": on_cylinder(-0.6, yield_valve=WIDE_AND_SLOW),
    "cylinder, relief": on_cylinder(0.6, rod_relief=RELIEVING),
    "cylinder, cavity": on_cylinder(0.4, vapour_pressure=VAPOUR),
    "cylinder, air": on_cylinder(0.4, trapped_air=AIR, vapour_pressure=VAPOUR),
    "cylinder, line": on_cylinder(-0.2, line=LINE, inlet=UP),
    "cylinder, seals": on_cylinder(0.05, seal_friction=SEALS),
    "cylinder, stops": on_cylinder(0.5, end_stops=STOPS),
    "cylinder, two stages": on_cylinder(-0.2, second_stage=STAGE, end_stops=STOPS, inlet=UP_SLOWLY),
    "cylinder, lowered in two stages": on_cylinder(
        0.0, second_stage=STAGE, end_stops=replace(STOPS, lowest=-5e-4), inlet=DOWN
    ),
    "cylinder, setting": on_cylinder(0.0, setting_pressure=4e6),
    "cylinder, check valve": on_cylinder(0.2, check_valve=CHECK, inlet=UP),
    "cylinder, check valve released": on_cylinder(0.0, check_valve=CHECK, inlet=DOWN),
    "cylinder, check valve and line": on_cylinder(-0.2, check_valve=CHECK, line=LINE, inlet=UP_SLOWLY),
    "cylinder, released to the line": on_cylinder(0.0, check_valve=CHECK, line=LINE, inlet=DOWN),
    "cylinder, everything": on_cylinder(
        -0.6,
        yield_valve=WITH_HYSTERESIS, vapour_pressure=VAPOUR, trapped_air=AIR, line=LINE, seal_friction=SEALS,
        end_stops=STOPS, second_stage=STAGE, setting_pressure=3e6, check_valve=CHECK,
        rod_relief=replace(YIELDING, opening_pressure=6e6), inlet=UP,
    ),
    "two on a pump": two_on_a_pump(UP, PUMP),
    "two on a pump, lowered": two_on_a_pump(DOWN, PUMP, check_valve=CHECK),
    "two on a pump, with lines": two_on_a_pump(UP_SLOWLY, PUMP, line=LINE, check_valve=CHECK, trapped_air=AIR),
}  # fmt: skip
