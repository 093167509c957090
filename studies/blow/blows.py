"""The supports and the blocks that fall on them: places, masses, heights, pins, valves."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

from studies.common.support_legs import PAIRS, legs_data, loose_pins, support, support_legs, tight_pins
from support_exudyn import ClearancePin, Line, OilColumn, Result, Scenario, YieldValve, simulate
from support_exudyn.machines.four_bar_shield import PINS as ALL_PINS
from support_exudyn.machines.four_column_support import HydraulicSupport
from support_exudyn.machines.shield_layout import TAIL
from support_exudyn.model.loads.applied import AppliedForce
from support_exudyn.model.loads.falling_block import FallingBlock
from support_exudyn.model.plane_geometry import moved
from user_forces.values.value import Vector2

MACHINES = ("reference", "zf18000")
# of masses 0.5, 1, 2, 5 t and heights 0.2, 0.5, 1, 2 m the corners and the middle; all else is crossed
MIDDLE = (2.0, 0.5)  # mass [t], height [m]
BLOWS = ((0.5, 0.2), (0.5, 2.0), MIDDLE, (5.0, 0.2), (5.0, 2.0))
CLEARANCE_MM, FRICTION = 1.5, 0.25  # friction in all pins, ideal or not
PINS = {"ideal": (), "one": ("rear_base",), "all": ALL_PINS}  # that have clearance
STIFFNESS, RESTITUTION = 1e9, 0.3  # of rock on steel [N/m^1.5], assumed: 2 t from 0.5 m rest after 10 ms
STRIKE, AFTER = 0.05, 0.35  # when a block strikes, and how long the run goes on [s]
# with which a support comes to rest: restitution of pins, drop of pressure in hoses at 300 l/min [Pa], time [s]
DULL, DROP, UNTIL_REST = 0.05, 5e5, 0.6
PERIOD = 2.5e-4  # between records [s]
BEFORE = 4 * PERIOD  # a blow, when all is still at rest [s]
GRAVITY = 9.81
CHANNELS = (
    "*_column.pressure", "*_column.force", "*_column.yield_flow", "*_column.yielded", "*_column.cavity",
    "block.force", "canopy.angle", "pin.*.force",
)  # fmt: skip


# body that is struck, by the name of the place
PLACES = {
    "tip": "canopy",
    "between": "canopy",
    "over the legs": "canopy",
    "shield": "shield",
    "tail beam": "shield",
}


def place_of(machine: HydraulicSupport, place: str) -> Vector2:
    """Where a block strikes in the start posture [m]; the tail beam, a part of the shield, in its centre."""

    def between(a: Vector2, b: Vector2) -> Vector2:
        return 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])

    start = machine.start()
    front, rear = start.ends["front_head"], start.ends["rear_head"]
    (tail,) = (part for part in machine.parts["shield"] if part.name == TAIL)
    return {
        "tip": start.tip,
        "between": between(start.tip, front),
        "over the legs": between(front, rear),
        "shield": between(start.front_shield, start.hinge),
        "tail beam": moved(tail.centre, machine.rear_shield, start.rear_shield, start.shield),
    }[place]


@dataclass(frozen=True)
class Blow:
    """A block on a support.

    mass: [t]. height: that it falls from [m]. pins: of `PINS`. valve: whether the legs have yield valves.
    """

    machine: str
    place: str
    mass: float
    height: float
    pins: str
    valve: bool

    @property
    def name(self) -> str:
        """The name of the case."""
        legs = "valves" if self.valve else "no valves"
        return f"{self.machine}, {self.place}, {self.mass:g} t from {self.height:g} m, {self.pins}, {legs}"

    @property
    def energy(self) -> float:
        """The energy of the fall [J]."""
        return 1e3 * self.mass * GRAVITY * self.height

    def block(self) -> FallingBlock:
        """The block, which starts with a speed, so that all strike at the same time."""
        fast = math.sqrt(2.0 * GRAVITY * self.height)
        return FallingBlock(
            body=PLACES[self.place],
            point=place_of(support(self.machine), self.place),
            mass=1e3 * self.mass,
            height=fast * STRIKE - 0.5 * GRAVITY * STRIKE**2,
            speed=fast - GRAVITY * STRIKE,
            stiffness=STIFFNESS,
            restitution=RESTITUTION,
        )

    def scenario(self) -> Scenario:
        """The run: at rest under the roof load, until the block strikes."""
        pressures, places = at_rest(self.machine, self.pins)
        legs = support_legs(self.machine, valve=self.valve)
        loose = loose_pins(self.machine, CLEARANCE_MM, FRICTION, PINS[self.pins])
        return Scenario(
            machine=support(self.machine),
            actuators={name: replace(leg, setting_pressure=pressures[name]) for name, leg in legs.items()},
            pins={
                **tight_pins(self.machine, FRICTION, ALL_PINS),
                **{name: replace(pin, eccentricity=places[name]) for name, pin in loose.items()},
            },
            loads={**roof(self.machine), "block": self.block()},
            duration=STRIKE + AFTER,
            record_period=PERIOD,
            channels=CHANNELS if self.valve else tuple(one for one in CHANNELS if "yield" not in one),
            formulation="compiled",
            accuracy="draft",
        )


def roof(machine: str) -> dict[str, AppliedForce]:
    """The roof's load on the canopy over either pair of legs: their setting force."""
    start = support(machine).start()
    leg = legs_data().of(machine).cylinder
    assert leg.setting_pressure is not None
    force = 0.0, -leg.setting_pressure * leg.bore_area
    points = {"front_roof": start.ends["front_head"], "rear_roof": start.ends["rear_head"]}
    return {name: AppliedForce(body="canopy", point=point, full_force=force) for name, point in points.items()}


def _under_roof(machine: str, pins: Mapping[str, ClearancePin], duration: float) -> Result:
    """A support under the roof load, on oil behind hoses whose resistance brings it to rest."""
    leg = legs_data().of(machine).cylinder
    line = Line(volume=2.0 * leg.bore_area * leg.oil_length, nominal_flow=5e-3, nominal_drop=DROP)
    oil = OilColumn(
        bore_area=leg.bore_area, oil_length=leg.oil_length, bulk_modulus=leg.bulk_modulus, line=line
    )
    scenario = Scenario(
        machine=support(machine),
        actuators=dict.fromkeys(PAIRS, oil),
        pins=pins,
        loads=roof(machine),
        start="concentric" if pins else "settled",
        duration=duration,
        formulation="compiled",
    )
    return simulate(scenario)


@cache
def at_rest(machine: str, pins: str) -> tuple[dict[str, float], dict[str, Vector2]]:
    """Pressures of the legs [Pa] and places of the journals in their bores [m], at rest under the roof load.

    Journals begin where the forces of ideal pins hold them, in contacts that hardly give back anything; after a
    while all is at rest.
    """
    run = _under_roof(machine, {}, 1e-3)
    loose = loose_pins(machine, CLEARANCE_MM, FRICTION, PINS[pins])
    if loose:
        soft = {}
        for name, pin in loose.items():
            x, y = (float(run[f"pin.{name}.force_{axis}"][0]) for axis in "xy")
            force = math.hypot(x, y)
            normal: Any = pin.contact.normal
            far = pin.contact.bearing.clearance + normal.resting_depth(force)
            contact = replace(pin.contact, normal=replace(normal, restitution=DULL))
            soft[name] = replace(pin, contact=contact, eccentricity=(-far * x / force, -far * y / force))
        run = _under_roof(machine, soft, UNTIL_REST)

    def last(pin: str, axis: str) -> float:
        return float(run[f"pin.{pin}.eccentricity_{axis}"][-1])

    area = legs_data().of(machine).cylinder.bore_area
    pressures = {name: float(run[f"{name}.force"][-1]) / area for name in PAIRS}
    return pressures, {name: (last(name, "x"), last(name, "y")) for name in loose}


def yield_valve(machine: str) -> YieldValve:
    """The yield valves of a pair of legs of a machine."""
    valve = legs_data().of(machine).cylinder.yield_valve
    assert valve is not None
    return valve


def all_blows(*, small: bool = False) -> list[Blow]:
    """All blows; small: the middle one on the reference support alone, with all places, pins and legs."""
    machines, blows = (MACHINES[:1], (MIDDLE,)) if small else (MACHINES, BLOWS)
    return [
        Blow(machine, place, mass, height, pins, valve)
        for machine in machines
        for place in PLACES
        for mass, height in blows
        for pins in PINS
        for valve in (True, False)
    ]


def middle(machine: str, place: str, pins: str, *, valve: bool = True) -> str:
    """The name of the middle blow."""
    return Blow(machine, place, *MIDDLE, pins, valve).name
