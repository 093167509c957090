"""Machines on hydraulic legs: what stands on drawn legs, and whether their oil is conserved."""

import math
from collections.abc import Callable, Mapping
from functools import cache

import numpy as np

from studies.extremes.drawn_legs import DURATION, Leg, drawn_drive, drawn_leg, drawn_pump
from studies.extremes.ranges import Point
from studies.extremes.scenes import logarithmic, pressing_roof, settings
from support_exudyn import (
    Body,
    Held,
    HydraulicCylinder,
    IdealPin,
    LinearActuator,
    Linkage,
    Machine,
    OilColumn,
    Result,
    Scenario,
    Slide,
    reference_support,
)
from support_exudyn.files.machines import shipped
from support_exudyn.formulations.registry import FormulationName
from support_exudyn.mechanics.hydraulic_legs import static_loads
from support_exudyn.model.linkage import GROUND, pinned
from user_forces.values.value import Vector2, value

RECORDS = 60  # into which a run is cut
STEP = 2e-4  # [s] where steps are chosen
FORMULATIONS: tuple[FormulationName, ...] = ("compiled", "exudyn")
MASS = 16e3  # [kg] of the upright one


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
    """What every actuator of a machine carries at the start [N], < 0 if it is pulled, and its length [m]."""
    linkage = MACHINES[name][0]().linkage()
    loads = static_loads(linkage, (0.0, -9.81))
    return {leg: (load, linkage.actuators[leg].start_length) for leg, load in loads.items()}


# --- scenes ---


def on_legs(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """A machine on drawn legs: machines take turns, and both formulations; each on columns, cylinders or both.

    Columns are driven, and cylinders have a pump in some scenes. A pin may have clearance, and a roof presses
    the canopy in the end with a share of what the legs carry.
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


# --- what is asked of them ---


def oil_open(result: Result) -> float:
    """By how much the oil of a leg does not add up at worst, as a share of it; nan where none is counted.

    What it holds is what it held, and has got by inlets or its drive, less what valves have let out.
    """
    found = [math.nan]
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
        lost = [
            result[f"{name}.{way}"] for way in ("yielded", "relieved") if f"{name}.{way}" in result.channels
        ]
        open_by = oil - oil[0] - (got - got[0]) + sum(one - one[0] for one in lost)
        found.append(float(np.abs(open_by).max() / oil[0]))
    return max(found[1:], default=math.nan)
