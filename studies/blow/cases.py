"""Supports at working pressure under a roof load, struck by blocks: places, blocks, pins, valves."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

from studies.common.loose_supports import loose_pins, support, tight_pins
from studies.common.support_legs import PAIRS, legs_data, support_legs
from support_exudyn import ClearancePin, Line, OilColumn, Result, Scenario, simulate
from support_exudyn.machines.four_bar_shield import PINS as ALL_PINS
from support_exudyn.machines.four_column_support import HydraulicSupport, Posture
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
STRIKE = 0.05  # when a block strikes [s]
# with which a support comes to rest: restitution of pins, drop of pressure in hoses at 300 l/min [Pa], time [s]
DULL, DROP, UNTIL_REST = 0.05, 5e5, 0.6
AFTER = 0.35  # that is looked at after a blow [s]
PERIOD = 2.5e-4  # between records [s]
GRAVITY = 9.81
CHANNELS = (
    "*_column.pressure", "*_column.force", "*_column.yield_flow", "*_column.yielded", "*_column.cavity",
    "block.force", "canopy.angle", "pin.*.force",
)  # fmt: skip


def _between(a: Vector2, b: Vector2, share: float = 0.5) -> Vector2:
    return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])


def _tail_beam(machine: HydraulicSupport, start: Posture) -> Vector2:
    """Centre of the tail beam, which is a part of the shield."""
    (tail,) = (part for part in machine.parts["shield"] if part.name == TAIL)
    return moved(tail.centre, machine.rear_shield, start.rear_shield, start.shield)


# body that is struck, and where in the start posture, by the name of the place
PLACES: dict[str, tuple[str, Callable[[HydraulicSupport, Posture], Vector2]]] = {
    "tip": ("canopy", lambda machine, start: start.tip),
    "between": ("canopy", lambda machine, start: _between(start.tip, start.ends["front_head"])),
    "over the legs": (
        "canopy",
        lambda machine, start: _between(start.ends["front_head"], start.ends["rear_head"]),
    ),
    "shield": ("shield", lambda machine, start: _between(start.front_shield, start.hinge)),
    "tail beam": ("shield", _tail_beam),
}


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
        """What the study calls it."""
        legs = "valves" if self.valve else "no valves"
        return f"{self.machine}, {self.place}, {self.mass:g} t from {self.height:g} m, {self.pins}, {legs}"

    @property
    def energy(self) -> float:
        """What the block falls with [J]."""
        return 1e3 * self.mass * GRAVITY * self.height

    @property
    def strike(self) -> float:
        """When it strikes a support that stands still [s]."""
        return STRIKE

    def block(self) -> FallingBlock:
        """The block, which starts with a speed, so that all strike at the same time."""
        machine = support(self.machine)
        body, point = PLACES[self.place]
        fast = math.sqrt(2.0 * GRAVITY * self.height)
        return FallingBlock(
            body=body,
            point=point(machine, machine.start()),
            mass=1e3 * self.mass,
            height=fast * STRIKE - 0.5 * GRAVITY * STRIKE**2,
            speed=fast - GRAVITY * STRIKE,
            stiffness=STIFFNESS,
            restitution=RESTITUTION,
        )

    def scenario(self) -> Scenario:
        """The run: at rest under the roof load, until the block strikes."""
        rest = at_rest(self.machine, self.pins)
        legs = support_legs(self.machine, valve=self.valve)
        return Scenario(
            machine=support(self.machine),
            actuators={name: replace(leg, setting_pressure=rest.pressures[name]) for name, leg in legs.items()},
            pins={
                **tight_pins(self.machine, FRICTION, ALL_PINS),
                **{
                    name: replace(pin, eccentricity=rest.eccentricities[name])
                    for name, pin in loose(self.machine, self.pins).items()
                },
            },
            loads={**roof(self.machine), "block": self.block()},
            duration=self.strike + AFTER,
            record_period=PERIOD,
            channels=CHANNELS if self.valve else tuple(one for one in CHANNELS if "yield" not in one),
            formulation="compiled",
            accuracy="draft",
        )


def loose(machine: str, pins: str) -> dict[str, ClearancePin]:
    """The pins that have clearance, concentric; pins: of `PINS`."""
    return loose_pins(machine, CLEARANCE_MM, FRICTION, PINS[pins])


def roof(machine: str) -> dict[str, AppliedForce]:
    """What the roof presses on the canopy over either pair of legs: their setting force."""
    start = support(machine).start()
    leg = legs_data().of(machine).cylinder
    assert leg.setting_pressure is not None
    force = 0.0, -leg.setting_pressure * leg.bore_area
    points = {"front_roof": start.ends["front_head"], "rear_roof": start.ends["rear_head"]}
    return {name: AppliedForce(body="canopy", point=point, full_force=force) for name, point in points.items()}


@dataclass(frozen=True)
class AtRest:
    """How a support stands under the roof load: pressures of the legs [Pa], journals in their bores [m]."""

    pressures: Mapping[str, float]
    eccentricities: Mapping[str, Vector2]


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
def at_rest(machine: str, pins: str) -> AtRest:
    """How a support with these pins stands under the roof load.

    Journals begin where the forces of ideal pins press them, in contacts that hardly give back anything; after
    a while all is at rest.
    """
    run = _under_roof(machine, {}, 1e-3)
    found = loose(machine, pins)
    if found:
        soft = {}
        for name, pin in found.items():
            x, y = (float(run[f"pin.{name}.force_{axis}"][0]) for axis in "xy")
            force = math.hypot(x, y)
            normal: Any = pin.contact.normal
            far = pin.contact.bearing.clearance + normal.resting_depth(force)
            contact = replace(pin.contact, normal=replace(normal, restitution=DULL))
            soft[name] = replace(pin, contact=contact, eccentricity=(-far * x / force, -far * y / force))
        run = _under_roof(machine, soft, UNTIL_REST)
    area = legs_data().of(machine).cylinder.bore_area
    places = {name: (_last(run, name, "x"), _last(run, name, "y")) for name in found}
    return AtRest({name: float(run[f"{name}.force"][-1]) / area for name in PAIRS}, places)


def _last(run: Result, pin: str, axis: str) -> float:
    """Where a journal is in its bore at the end of a run [m]."""
    return float(run[f"pin.{pin}.eccentricity_{axis}"][-1])


def yield_pressure(machine: str) -> float:
    """Pressure at which the valves of a machine's legs open [Pa]."""
    leg = legs_data().of(machine).cylinder
    assert leg.yield_valve is not None
    return leg.yield_valve.opening_pressure


def rated_flow(machine: str) -> float:
    """Rated flow of the valves of a pair of legs [m^3/s]."""
    leg = legs_data().of(machine).cylinder
    assert leg.yield_valve is not None
    return leg.yield_valve.rated_flow


def cases(*, small: bool = False) -> list[Blow]:
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
