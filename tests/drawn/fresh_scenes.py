"""Scenes of every kind that nobody has seen before, drawn from a seed: what errors are measured on.

Half of them are machines of the field, a tenth of a second or so long, whose clearances, stiffnesses, laws,
damping, friction, starts and drives are drawn from what is physically sensible. The other half are linkages
that are drawn themselves, with records far too coarse. The same seed and number give the same scene.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeVar

import numpy as np

import user_forces as forces
from studies.common import paper_machine
from studies.extremes.drawn import Draw
from studies.extremes.legs import LINE, Leg, drawn_pump, leg_heads, pressing_roof, with_elements
from support_exudyn import (
    ClearancePin,
    CubicStep,
    Drive,
    FallingBlock,
    Held,
    HydraulicCylinder,
    Inlet,
    Line,
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
from tests.drawn.drawn_linkages import chain_scene, guide_scene, parallelogram_scene
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
DRAWS = 100  # scenes that do not fit together are drawn again
GRAVITY = (0.0, -9.81)  # [m/s^2]
SPEED_OF_STROKE = 0.3  # [m/s], the fastest that columns extend


@dataclass(frozen=True)
class Fresh:
    """A scene of a seed: its kind and its scenario, in which no accuracy is asked for yet."""

    kind: str
    scenario: Scenario


def fresh(seed: int, number: int) -> Fresh:
    """The scene of a seed with this number, both from 0 on: machines and linkages in turn."""
    kinds = list(LINKAGES if number % 2 else MACHINES)
    kind = kinds[number // 2 % len(kinds)]
    of = Draw(np.random.default_rng([seed, number]), sensible=True)
    for _ in range(DRAWS):
        try:
            scenario = KINDS[kind](of)
            scenario.linkage  # noqa: B018  # journals may not fit where they are to start
        except forces.InputError:
            continue
        return Fresh(kind, scenario)
    raise RuntimeError(f"seed {seed}, scene {number}: {DRAWS} draws gave no {kind} that fits together")


# --- what is drawn ---


def _some_pin(of: Draw, rear: float = 0.0) -> str:
    """Draw the name of a pin of the support; with this chance the rear-link pin before all."""
    if rear and of.chance(rear):
        return paper_machine.CLEARANCE_PIN
    return of.pick(list(reference_support().linkage().pins))


def _contact(of: Draw, size: float, stiffness: float) -> forces.JournalContact:
    """Draw a pin's contact; size and stiffness of its bearing are multiples of those of the support."""
    bearing = forces.JournalBearing(
        bore_radius=paper_machine.BORE_RADIUS * size, clearance=of.log(1e-4, 3e-3) * size
    )
    law = of.pick(LAWS)
    exponent = 1.5 if of.chance(0.7) else of.even(1.0, 2.0)
    normal = law(
        stiffness=stiffness * of.log(0.1, 5.0) * paper_machine.stiffness(1.5) * 1e-4 ** (1.5 - exponent),
        exponent=exponent,
        restitution=of.even(0.3, 0.98),
        rest_velocity=REST_VELOCITY if of.chance(0.6) else of.log(1e-3, 5e-2),
    )
    return forces.JournalContact(bearing=bearing, normal=normal, friction=_friction(of))


def _friction(of: Draw) -> forces.FrictionLaw:
    if of.chance(0.4):
        return forces.Frictionless()
    coefficient = of.even(0.02, 0.4)
    if of.chance(0.6):
        return of.pick(RUBBING)(coefficient)
    static = of.log(1e-4, 1e-3)
    return forces.Ambrosio(
        sliding_coefficient=coefficient,
        static_speed=static,
        dynamic_speed=static * of.log(3.0, 100.0),
    )


def _pin(of: Draw, size: float = 1.0, stiffness: float = 1.0) -> ClearancePin:
    contact = _contact(of, size, stiffness)
    away = contact.bearing.clearance * of.even(0.0, 1.0) if of.chance(0.3) else 0.0
    angle = of.even(0.0, 2.0 * math.pi)
    return ClearancePin(
        contact=contact,
        bore="first" if of.chance(0.5) else "second",
        eccentricity=(away * math.cos(angle), away * math.sin(angle)),
    )


def _drive(of: Draw, duration: float) -> Drive:
    """Draw a drive of columns: none, or one that goes as far as the fastest does in that time [s]."""
    far = of.even(-1.0, 1.0) * SPEED_OF_STROKE * duration
    begin, end = (share * duration for share in sorted((of.even(0.0, 1.0), of.even(0.0, 1.0))))
    drives: tuple[Callable[[], Drive], ...] = (
        Held,
        lambda: CubicStep(stroke=far, start=begin, end=end + 0.2 * duration),
        lambda: UniformSpeed(stroke=0.3 * far, start=begin, end=end + 0.2 * duration),
        lambda: Reciprocating(stroke=0.2 * abs(far), period=duration * of.even(0.5, 2.0)),
    )
    return of.pick(drives)()


def _scene(of: Draw, pins: Mapping[str, ClearancePin], longest: float, **more: object) -> Scenario:
    """A scene of the support of up to so many seconds.

    In a quarter of all cases it is settled at the start, all journals then in the middle.
    """
    duration = of.log(SHORTEST, longest)
    fields: dict[str, object] = {
        "machine": reference_support(), "pins": pins, "duration": duration, "record_period": duration / RECORDS,
        "drive": _drive(of, duration), "solver": SolverSettings(most_steps=MOST_STEPS),
    }  # fmt: skip
    scenario = Scenario(**(fields | more))  # type: ignore[arg-type]
    if of.even(0.0, 1.0) > 0.25:
        return scenario
    middle = {name: replace(pin, eccentricity=(0.0, 0.0)) for name, pin in scenario.clearance_pins.items()}
    return replace(scenario, pins={**scenario.pins, **middle}, start="settled")


def _third_on_engine(of: Draw, scene: Scenario) -> Scenario:
    """The scene; a third of them ask for the engine's formulation."""
    return replace(scene, formulation="exudyn") if of.chance(0.33) else scene


def _oil(
    of: Draw,
    bore: tuple[float, float] = (0.15, 0.3),
    length: tuple[float, float] = (0.2, 0.8),
    columns: int = 2,
) -> OilColumn:
    """Draw a column of oil, or so many side by side; diameters of bores and lengths in m."""
    return OilColumn(
        bore_area=bore_area(of.even(*bore), columns),
        oil_length=of.even(*length),
        bulk_modulus=of.log(7e8, 2e9),
        line=Line(**of.sizes(LINE)),
    )


def _columns(of: Draw) -> dict[str, OilColumn]:
    return dict.fromkeys(("front_column", "rear_column"), _oil(of))


# --- the kinds ---


def _rear_pin(of: Draw) -> Scenario:
    scene = _third_on_engine(of, _scene(of, {paper_machine.CLEARANCE_PIN: _pin(of)}, 0.4))
    return replace(scene, start="concentric") if scene.formulation == "exudyn" else scene


def _any_pin(of: Draw) -> Scenario:
    return _scene(of, {_some_pin(of): _pin(of)}, 0.12)


def _several_pins(of: Draw) -> Scenario:
    names = of.random.permutation(list(reference_support().linkage().pins)).tolist()
    chosen = names[: int(of.random.integers(2, len(names) + 1))]
    return _scene(of, {name: _pin(of) for name in chosen}, 0.08)


def _on_oil(of: Draw) -> Scenario:
    name = _some_pin(of, rear=0.6)
    return _third_on_engine(of, _scene(of, {name: _pin(of)}, 0.2, actuators=_columns(of)))


def _on_cylinders(of: Draw) -> Scenario:
    duration = of.log(SHORTEST, 0.12)
    begin, end = (duration * of.even(low, low + 0.5) for low in (0.0, 0.5))
    ramp = 0.4 * max(end - begin, 0.02)
    extent = of.even(-1.0, 1.0)
    inlets: tuple[Inlet, ...] = (
        SuddenOpening(start=begin, end=end + 0.02, extent=extent),
        RampedOpening(start=begin, end=end + 0.02, ramp=ramp, extent=extent),
    )
    cylinder = paper_machine.hydraulic_cylinders(of.pick(inlets))["front_column"]
    cylinder = replace(cylinder, bulk_modulus=of.log(7e8, 2e9))
    columns: dict[str, HydraulicCylinder] = {"front_column": cylinder, "rear_column": cylinder}
    pins = {paper_machine.CLEARANCE_PIN: _pin(of)} if of.chance(0.8) else {}
    scene = _scene(of, pins, 0.3, actuators=columns, drive=Held())
    return replace(scene, duration=duration, record_period=duration / RECORDS, start="concentric")


def _on_legs(of: Draw) -> Scenario:
    """Columns of oil, or cylinders on a pump, with valves, hoses, air, seals."""
    pins = {_some_pin(of, rear=0.6): _pin(of)} if of.chance(0.6) else {}
    loads = static_loads(reference_support().linkage(), GRAVITY)
    columns: dict[str, Leg]
    if of.chance(0.5):
        columns = {name: with_elements(of, _oil(of), load) for name, load in loads.items()}
        scene = _scene(of, pins, 0.15, actuators=columns)
    else:
        base = _on_cylinders(of)
        columns = {name: with_elements(of, leg, loads[name]) for name, leg in base.valved.items()}
        shared = drawn_pump(of, base.valved["front_column"].system_pressure) if of.chance(0.7) else None
        scene = replace(base, pins=pins, actuators=columns, pump=shared)
    if of.chance(0.4):
        scene = replace(scene, loads={"roof": _roof(of, scene.duration, sum(loads.values()))})
    return _third_on_engine(of, scene)


def _roof(of: Draw, duration: float, weight: float) -> Roof:
    """A roof that comes down between both columns, and loads it with up to three times the weight [N]."""
    stiffness, machine = of.log(1e7, 1e9), reference_support()
    force, span = weight * of.even(0.5, 3.0), (0.0, 0.9 * duration)
    return pressing_roof(machine, leg_heads(machine), 1e-3, stiffness, force, span)


def _under_block(of: Draw) -> Scenario:
    """A rock on the canopy, with and without a clearance pin, columns rigid or on oil."""
    machine = reference_support()
    tip = machine.linkage().points["tip"].point
    hinge = machine.start().hinge
    share = of.even(0.2, 0.8)
    block = FallingBlock(
        body="canopy",
        point=(tip[0] + share * (hinge[0] - tip[0]), tip[1]),
        mass=of.log(100.0, 3000.0),
        height=of.even(0.0, 0.05) + 1e-4,
        speed=of.even(0.5, 4.0),
        stiffness=of.log(1e8, 3e9),
        restitution=of.even(0.2, 0.9),
    )
    pins = {_some_pin(of): _pin(of)} if of.chance(0.6) else {}
    columns = _columns(of) if of.chance(0.5) else {}
    scene = _scene(of, pins, 0.12, actuators=columns, loads={"rock": block})
    return replace(scene, start="concentric")


def _tail_beam(of: Draw) -> Scenario:
    jack = _oil(of, (0.1, 0.18), (0.15, 0.5), 1)
    columns = _columns(of) if of.chance(0.5) else {}
    pins = {paper_machine.CLEARANCE_PIN: _pin(of)}
    parts = {"tail_beam": OwnBody(jack=jack)}
    return _scene(of, pins, 0.15, parts=parts, actuators=columns)


def _crank(of: Draw) -> Scenario:
    """A revolution or less, at 200 to 6000 revolutions a minute; half of these scenes are without weight."""
    speed = 2.0 * math.pi / 60.0 * of.log(200.0, 6000.0)
    duration = of.even(0.1, 1.0) * 2.0 * math.pi / speed
    scene = Scenario(
        machine=replace(ravn_slider_crank(), start_angle=of.even(0.0, 2.0 * math.pi)),
        pins={"slider_pin": _pin(of, 0.15, 0.1)},
        drive=Steady(rate=speed),
        duration=duration,
        record_period=duration / RECORDS,
        gravity=(0.0, -9.81 if of.chance(0.5) else 0.0),
        solver=SolverSettings(most_steps=MOST_STEPS),
    )
    return _third_on_engine(of, scene)


def _in_space(of: Draw) -> Scenario:
    name = _some_pin(of, rear=0.5)
    columns = _columns(of) if of.chance(0.5) else {}
    return _scene(of, {name: _pin(of)}, 0.08, actuators=columns, dimensions=3)


Kinds = Mapping[str, Callable[[Draw], Scenario]]
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
