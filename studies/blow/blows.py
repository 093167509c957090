"""Supports at working pressure under a roof load, struck by blocks: places, blocks, pins, valves."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np

from studies.common.numbers import Found, Number, measured
from studies.common.rise import DEGREES, MeasuredRun, Series, between
from studies.common.support_legs import PAIRS, legs_data, loose_pins, support, support_legs, tight_pins
from support_exudyn import ClearancePin, Line, OilColumn, Result, Scenario, YieldValve, simulate
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


def yield_valve(machine: str) -> YieldValve:
    """The yield valves of a pair of legs of a machine."""
    valve = legs_data().of(machine).cylinder.yield_valve
    assert valve is not None
    return valve


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


# --- measures ---

BEFORE = 4 * PERIOD  # a blow, when all is still at rest [s]
Ran = Mapping[str, tuple[Blow, Result]]


@dataclass(frozen=True)
class Struck:
    """The records of a run from just before the blow on."""

    blow: Blow
    run: MeasuredRun

    def of(self, channel: str) -> Series:
        """A channel from just before the blow on, shape (n,)."""
        inside = between(self.run, self.blow.strike - BEFORE, float(self.run.time[-1]))
        found: Series = self.run[channel][inside]
        return found

    def most(self, channel: str, names: Iterable[str]) -> float:
        """The largest value of a channel of any of some members."""
        return max(float(self.of(channel.format(name)).max()) for name in names)

    def tilt(self) -> float:
        """Largest turn of the canopy from where it was, with its sign [rad]; negative: its tip goes down."""
        turn = self.of("canopy.angle") - self.of("canopy.angle")[0]
        return float(turn[np.argmax(np.abs(turn))])

    def rise(self) -> float:
        """Largest rise of the pressure of any leg above that before the blow [Pa]."""
        courses = [self.of(f"{name}.pressure") for name in PAIRS]
        return max(float((one - one[0]).max()) for one in courses)


# unit, scale from SI, and value in SI, by name
MEASURES: dict[str, tuple[str, float, Callable[[Struck], float]]] = {
    "pressure": ("MPa", 1e-6, lambda struck: struck.most("{}.pressure", PAIRS)),
    "rise": ("MPa", 1e-6, Struck.rise),
    "least_pressure": ("MPa", 1e-6, lambda struck: min(float(struck.of(f"{n}.pressure").min()) for n in PAIRS)),
    "flow": ("l/min", 6e4, lambda struck: struck.most("{}.yield_flow", PAIRS)),
    "volume": ("l", 1e3, lambda struck: sum(float(struck.of(f"{name}.yielded")[-1]) for name in PAIRS)),
    "pin_force": ("kN", 1e-3, lambda struck: struck.most("pin.{}.force", ALL_PINS)),
    "tilt": ("deg", DEGREES, Struck.tilt),
    "block_force": ("kN", 1e-3, lambda struck: struck.most("{}.force", ("block",))),
}
OF_VALVES = ("flow", "volume")


def numbers(ran: Ran) -> list[Number]:
    """All numbers of the study."""
    return [
        measured(measure, name, unit, run, lambda run, b=blow, s=scale, get=get: s * get(Struck(b, run)))  # type: ignore[misc]
        for name, (blow, run) in ran.items()
        for measure, (unit, scale, get) in MEASURES.items()
        if blow.valve or measure not in OF_VALVES
    ]


def ratios(found: Found, measure: str, blows: Iterable[Blow], change: Callable[[Blow], Blow]) -> list[float]:
    """A measure of blows over that of what they are changed into, of those alone that were run both."""
    pairs = [(blow.name, change(blow).name) for blow in blows]
    return [
        found[measure, name].value / found[measure, other].value
        for name, other in pairs
        if name != other and (measure, name) in found and (measure, other) in found
    ]


def strongest_pin(blow: Blow, run: MeasuredRun) -> str:
    """The pin of the linkage whose force is the largest in a blow."""
    return max(ALL_PINS, key=lambda pin: Struck(blow, run).most("pin.{}.force", (pin,)))
