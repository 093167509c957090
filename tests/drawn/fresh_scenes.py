"""Scenes of every kind that nobody has seen before, drawn from a seed: what errors are measured on.

Half of them are machines of the field, a tenth of a second or so long, whose clearances, stiffnesses, laws,
damping, friction, starts and drives are drawn from what is physically sensible. The other half are linkages
that are drawn themselves, with records far too coarse. The same seed and number give the same scene.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeVar

import numpy as np

import user_forces as forces
from studies.common import paper_machine
from support_exudyn import (
    ClearancePin,
    CubicStep,
    Drive,
    FallingBlock,
    Held,
    HydraulicCylinder,
    Inlet,
    Machine,
    OilColumn,
    OwnBody,
    RampedOpening,
    Reciprocating,
    Roof,
    Scenario,
    SolverSettings,
    Steady,
    SuddenOpening,
    UniformSpeed,
    bore_area,
    ravn_slider_crank,
    reference_support,
)
from support_exudyn.mechanics.hydraulic_legs import static_loads
from support_exudyn.scenario.scenario_data import Accuracy
from tests.drawn.drawn_linkages import chain_scene, guide_scene, parallelogram_scene
from tests.drawn.fresh_legs import Leg, between, hose, pump, with_elements
from user_forces.normal.hysteresis import REST_VELOCITY
from user_forces.normal.power_laws import PowerLaw

T = TypeVar("T")
LAWS: tuple[type[PowerLaw], ...] = (
    *(forces.LankaraniNikravesh, forces.Exact, forces.HuntCrossley, forces.Gonthier),
    *(forces.Flores, forces.LeeWang, forces.HuGuo),
)
STATIC = 1.3  # times the sliding coefficient, of laws that know both
RUBBING: tuple[Callable[[float], forces.FrictionLaw], ...] = (
    lambda mu: forces.CubicCoulomb(sliding_coefficient=mu),
    lambda mu: forces.Threlfall(sliding_coefficient=mu),
    lambda mu: forces.BrownMcPhee(sliding_coefficient=mu, static_coefficient=STATIC * mu),
    lambda mu: forces.BengisuAkay(sliding_coefficient=mu, static_coefficient=STATIC * mu),
)
SHORTEST = 0.04  # [s] of a run of the support
RECORDS = 200  # of a run
MOST_STEPS = 200_000  # of a run; none of these scenes is worth more
REFERENCE_SHARE = 5  # each fifth scene is also run to the accuracy "reference"
DRAWS = 100  # scenes that do not fit together are drawn again
GRAVITY = (0.0, -9.81)  # [m/s^2]
SPEED_OF_STROKE = 0.3  # [m/s], the fastest that columns extend


@dataclass(frozen=True)
class Fresh:
    """A scene of a seed: its number, kind, and scenario, in which no accuracy is asked for yet."""

    seed: int
    number: int
    kind: str
    scenario: Scenario

    @property
    def accuracies(self) -> tuple[Accuracy, ...]:
        """It is run to these accuracies."""
        share = self.number // 2 % REFERENCE_SHARE == 0
        return ("draft", "standard", "reference") if share else ("draft", "standard")


def fresh(seed: int, number: int, kind: str = "") -> Fresh:
    """The scene of a seed with this number, both from 0 on: machines and linkages in turn, or of this kind."""
    kinds = list(LINKAGES if number % 2 else MACHINES)
    kind = kind or kinds[number // 2 % len(kinds)]
    random = np.random.default_rng([seed, number])
    for _ in range(DRAWS):
        try:
            scenario = KINDS[kind](random)
            scenario.linkage  # noqa: B018  # journals may not fit where they are to start
        except forces.InputError:
            continue
        return Fresh(seed, number, kind, scenario)
    raise RuntimeError(f"seed {seed}, scene {number}: {DRAWS} draws gave no {kind} that fits together")


# --- what is drawn ---


def _pick(random: np.random.Generator, items: Sequence[T]) -> T:
    """Draw one of some items."""
    return items[int(random.integers(len(items)))]


def _some_pin(random: np.random.Generator, rear: float = 0.0) -> str:
    """Draw the name of a pin of the support; with this chance the rear-link pin before all."""
    if rear and random.uniform() < rear:
        return paper_machine.CLEARANCE_PIN
    return _pick(random, list(reference_support().linkage().pins))


def _contact(random: np.random.Generator, size: float, stiffness: float) -> forces.JournalContact:
    """Draw a pin's contact; size and stiffness of its bearing are multiples of those of the support."""
    bearing = forces.JournalBearing(
        bore_radius=paper_machine.BORE_RADIUS * size, clearance=between(random, 1e-4, 3e-3) * size
    )
    law = _pick(random, LAWS)
    exponent = 1.5 if random.uniform() < 0.7 else float(random.uniform(1.0, 2.0))
    normal = law(
        stiffness=stiffness
        * between(random, 0.1, 5.0)
        * paper_machine.stiffness(1.5)
        * 1e-4 ** (1.5 - exponent),
        exponent=exponent,
        restitution=float(random.uniform(0.3, 0.98)),
        rest_velocity=REST_VELOCITY if random.uniform() < 0.6 else between(random, 1e-3, 5e-2),
    )
    return forces.JournalContact(bearing=bearing, normal=normal, friction=_friction(random))


def _friction(random: np.random.Generator) -> forces.FrictionLaw:
    if random.uniform() < 0.4:
        return forces.Frictionless()
    coefficient = float(random.uniform(0.02, 0.4))
    if random.uniform() < 0.6:
        return _pick(random, RUBBING)(coefficient)
    static = between(random, 1e-4, 1e-3)
    return forces.Ambrosio(
        sliding_coefficient=coefficient,
        static_speed=static,
        dynamic_speed=static * between(random, 3.0, 100.0),
    )


def _pin(random: np.random.Generator, size: float = 1.0, stiffness: float = 1.0) -> ClearancePin:
    contact = _contact(random, size, stiffness)
    away = contact.bearing.clearance * float(random.uniform(0.0, 1.0)) if random.uniform() < 0.3 else 0.0
    angle = float(random.uniform(0.0, 2.0 * math.pi))
    return ClearancePin(
        contact=contact,
        bore="first" if random.uniform() < 0.5 else "second",
        eccentricity=(away * math.cos(angle), away * math.sin(angle)),
    )


def _drive(random: np.random.Generator, duration: float) -> Drive:
    """Draw a drive of columns: none, or one that goes as far as the fastest does in that time [s]."""
    far = float(random.uniform(-1.0, 1.0)) * SPEED_OF_STROKE * duration
    begin, end = (share * duration for share in sorted(random.uniform(0.0, 1.0, 2).tolist()))
    drives: tuple[Callable[[], Drive], ...] = (
        Held,
        lambda: CubicStep(stroke=far, start=begin, end=end + 0.2 * duration),
        lambda: UniformSpeed(stroke=0.3 * far, start=begin, end=end + 0.2 * duration),
        lambda: Reciprocating(stroke=0.2 * abs(far), period=duration * float(random.uniform(0.5, 2.0))),
    )
    return _pick(random, drives)()


def _start(random: np.random.Generator, scenario: Scenario) -> Scenario:
    """The scenario, in a quarter of all cases settled at the start, all journals then in the middle."""
    if random.uniform() > 0.25:
        return scenario
    pins = {
        name: replace(pin, eccentricity=(0.0, 0.0)) if isinstance(pin, ClearancePin) else pin
        for name, pin in scenario.pins.items()
    }
    return replace(scenario, pins=pins, start="settled")


def _scene(
    random: np.random.Generator,
    machine: Machine,
    pins: Mapping[str, ClearancePin],
    longest: float,
    **more: object,
) -> Scenario:
    duration = between(random, SHORTEST, longest)
    fields: dict[str, object] = {
        "machine": machine, "pins": pins, "duration": duration, "record_period": duration / RECORDS,
        "drive": _drive(random, duration), "solver": SolverSettings(most_steps=MOST_STEPS),
    }  # fmt: skip
    return _start(random, Scenario(**(fields | more)))  # type: ignore[arg-type]


def _oil(
    random: np.random.Generator,
    bore: tuple[float, float] = (0.15, 0.3),
    length: tuple[float, float] = (0.2, 0.8),
    columns: int = 2,
) -> OilColumn:
    """Draw a column of oil, or so many side by side; diameters of bores and lengths in m."""
    return OilColumn(
        bore_area=bore_area(float(random.uniform(*bore)), columns),
        oil_length=float(random.uniform(*length)),
        bulk_modulus=between(random, 7e8, 2e9),
        line=hose(random),
    )


def _columns(oil: OilColumn) -> dict[str, OilColumn]:
    return {"front_column": oil, "rear_column": oil}


# --- the kinds ---


def _rear_pin(random: np.random.Generator) -> Scenario:
    """A rear pin; a third of these scenes ask for the engine's formulation."""
    scene = _scene(random, reference_support(), {paper_machine.CLEARANCE_PIN: _pin(random)}, 0.4)
    return replace(scene, formulation="exudyn", start="concentric") if random.uniform() < 0.33 else scene


def _any_pin(random: np.random.Generator) -> Scenario:
    name = _some_pin(random)
    return _scene(random, reference_support(), {name: _pin(random)}, 0.12)


def _several_pins(random: np.random.Generator) -> Scenario:
    machine = reference_support()
    names = random.permutation(list(machine.linkage().pins)).tolist()
    chosen = names[: int(random.integers(2, len(names) + 1))]
    return _scene(random, machine, {name: _pin(random) for name in chosen}, 0.08)


def _on_oil(random: np.random.Generator) -> Scenario:
    """Columns of oil; a third of these scenes ask for the engine's formulation."""
    name = _some_pin(random, rear=0.6)
    scene = _scene(random, reference_support(), {name: _pin(random)}, 0.2, actuators=_columns(_oil(random)))
    return replace(scene, formulation="exudyn") if random.uniform() < 0.33 else scene


def _on_cylinders(random: np.random.Generator) -> Scenario:
    duration = between(random, SHORTEST, 0.12)
    begin, end = (duration * float(random.uniform(low, low + 0.5)) for low in (0.0, 0.5))
    ramp = 0.4 * max(end - begin, 0.02)
    extent = float(random.uniform(-1.0, 1.0))
    inlets: tuple[Inlet, ...] = (
        SuddenOpening(start=begin, end=end + 0.02, extent=extent),
        RampedOpening(start=begin, end=end + 0.02, ramp=ramp, extent=extent),
    )
    cylinder = paper_machine.hydraulic_cylinders(_pick(random, inlets))["front_column"]
    cylinder = replace(cylinder, bulk_modulus=between(random, 7e8, 2e9))
    columns: dict[str, HydraulicCylinder] = {"front_column": cylinder, "rear_column": cylinder}
    pins = {paper_machine.CLEARANCE_PIN: _pin(random)} if random.uniform() < 0.8 else {}
    scene = _scene(random, reference_support(), pins, 0.3, actuators=columns, drive=Held())
    return replace(scene, duration=duration, record_period=duration / RECORDS, start="concentric")


def _on_legs(random: np.random.Generator) -> Scenario:
    """Columns of oil, or cylinders on a pump, with valves, hoses, air, seals.

    A third of these scenes ask for the engine's formulation.
    """
    pins = {_some_pin(random, rear=0.6): _pin(random)} if random.uniform() < 0.6 else {}
    loads = static_loads(reference_support().linkage(), GRAVITY)
    columns: dict[str, Leg]
    if random.uniform() < 0.5:
        columns = {name: with_elements(random, _oil(random), load) for name, load in loads.items()}
        scene = _scene(random, reference_support(), pins, 0.15, actuators=columns)
    else:
        base = _on_cylinders(random)
        columns = {name: with_elements(random, leg, loads[name]) for name, leg in base.valved.items()}
        shared = pump(random, base.valved["front_column"].system_pressure) if random.uniform() < 0.7 else None
        scene = replace(base, pins=pins, actuators=columns, pump=shared)
    if random.uniform() < 0.4:
        scene = replace(scene, loads={"roof": _roof(random, scene.duration, sum(loads.values()))})
    return replace(scene, formulation="exudyn") if random.uniform() < 0.33 else scene


def _roof(random: np.random.Generator, duration: float, weight: float) -> Roof:
    """A roof that comes down between both columns, and presses with up to three times the weight [N]."""
    linkage = reference_support().linkage()
    x = [actuator.head_point[0] for actuator in linkage.actuators.values()]
    stiffness, gap = between(random, 1e7, 1e9), 1e-3
    way = gap + weight * float(random.uniform(0.5, 3.0)) / stiffness
    return Roof(
        body="canopy",
        point=(sum(x) / len(x), linkage.points["tip"].point[1]),
        descent=CubicStep(stroke=way, start=0.0, end=0.9 * duration),
        stiffness=stiffness,
        gap=gap,
    )


def _under_block(random: np.random.Generator) -> Scenario:
    """A rock on the canopy, with and without a clearance pin, columns rigid or on oil."""
    machine = reference_support()
    tip = machine.linkage().points["tip"].point
    hinge = machine.start().hinge
    share = float(random.uniform(0.2, 0.8))
    block = FallingBlock(
        body="canopy",
        point=(tip[0] + share * (hinge[0] - tip[0]), tip[1]),
        mass=between(random, 100.0, 3000.0),
        height=float(random.uniform(0.0, 0.05)) + 1e-4,
        speed=float(random.uniform(0.5, 4.0)),
        stiffness=between(random, 1e8, 3e9),
        restitution=float(random.uniform(0.2, 0.9)),
    )
    pins = {_some_pin(random): _pin(random)} if random.uniform() < 0.6 else {}
    columns = _columns(_oil(random)) if random.uniform() < 0.5 else {}
    return replace(
        _scene(random, machine, pins, 0.12, actuators=columns, loads={"rock": block}), start="concentric"
    )


def _tail_beam(random: np.random.Generator) -> Scenario:
    jack = _oil(random, (0.1, 0.18), (0.15, 0.5), 1)
    columns = _columns(_oil(random)) if random.uniform() < 0.5 else {}
    pins = {paper_machine.CLEARANCE_PIN: _pin(random)}
    parts = {"tail_beam": OwnBody(jack=jack)}
    return _scene(random, reference_support(), pins, 0.15, parts=parts, actuators=columns)


def _crank(random: np.random.Generator) -> Scenario:
    """A revolution or less, at 200 to 6000 revolutions a minute; half of these scenes are without weight."""
    speed = 2.0 * math.pi / 60.0 * between(random, 200.0, 6000.0)
    duration = float(random.uniform(0.1, 1.0)) * 2.0 * math.pi / speed
    scene = Scenario(
        machine=replace(ravn_slider_crank(), start_angle=float(random.uniform(0.0, 2.0 * math.pi))),
        pins={"slider_pin": _pin(random, 0.15, 0.1)},
        drive=Steady(rate=speed),
        duration=duration,
        record_period=duration / RECORDS,
        gravity=(0.0, -9.81 if random.uniform() < 0.5 else 0.0),
        solver=SolverSettings(most_steps=MOST_STEPS),
    )
    return replace(scene, formulation="exudyn") if random.uniform() < 0.33 else scene


def _in_space(random: np.random.Generator) -> Scenario:
    name = _some_pin(random, rear=0.5)
    columns = _columns(_oil(random)) if random.uniform() < 0.5 else {}
    return _scene(random, reference_support(), {name: _pin(random)}, 0.08, actuators=columns, dimensions=3)


Kinds = Mapping[str, Callable[[np.random.Generator], Scenario]]
MACHINES: Kinds = {
    "rear pin": _rear_pin,
    "any pin": _any_pin,
    "several pins": _several_pins,
    "oil columns": _on_oil,
    "cylinders": _on_cylinders,
    "hydraulic legs": _on_legs,
    "falling block": _under_block,
    "tail beam": _tail_beam,
    "slider-crank": _crank,
    "space": _in_space,
}
LINKAGES: Kinds = {
    "drawn chain": partial(chain_scene, pin=_pin),
    "drawn guide": partial(guide_scene, pin=_pin, contact=_contact),
    "loose parallelogram": partial(parallelogram_scene, pin=_pin),
}
KINDS: Kinds = {**MACHINES, **LINKAGES}
