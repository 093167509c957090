"""The engine holds what a scenario needs and nothing else: counted from the linkage, and in the engine."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Literal

import pytest

from support_exudyn import (
    ClearancePin,
    CubicStep,
    Held,
    IdealPin,
    ImpactStand,
    Linkage,
    Load,
    Machine,
    OilColumn,
    OwnBody,
    Scenario,
    SolverSettings,
    Steady,
    UniformSpeed,
    bore_area,
    cylinders_and_rods,
    ravn_slider_crank,
    reference_support,
)
from support_exudyn.formulations.redundant.inventory import Inventory, inventory
from support_exudyn.formulations.redundant.scene.scene_builder import build
from support_exudyn.formulations.redundant.space.scene_builder import build as build_in_space
from support_exudyn.model.linkage import GROUND
from tests.cases.machine_cases import contact, support
from tests.roof_cases import Branching, Ram, over_the_canopy, over_the_ram
from user_forces import Ambrosio, Frictionless

SUPPORT = support()
PINS = tuple(SUPPORT.linkage().pins)
RISE = CubicStep(stroke=0.01, start=0.0, end=0.1)
OIL = OilColumn(bore_area=bore_area(0.25, 2), oil_length=0.5, bulk_modulus=1.5e9)
EQUATIONS = {"pin": 2, "actuator": 1, "crank": 1, "slide": 2}  # of an ideal one in the plane


def with_clearance(friction: bool = True) -> ClearancePin:
    whole = contact()
    return ClearancePin(contact=whole if friction else replace(whole, friction=Frictionless()))


def scenario(**changes: Any) -> Scenario:
    """Without result checks where not everything is recorded: it would have energies followed all the same."""
    fields: dict[str, Any] = {"machine": SUPPORT, "duration": 0.1}
    if "channels" in changes:
        fields["solver"] = SolverSettings(result_checks=False)
    return Scenario(**fields | changes)


def test_an_audit_has_energies_followed_whatever_is_recorded() -> None:
    driven = Scenario(machine=SUPPORT, duration=0.1, drive=RISE, channels=NO_ENERGY)
    assert inventory(driven).callbacks == inventory(replace(driven, channels=("*",))).callbacks == 2


def places(
    linkage: Linkage, weighed: bool, clearance_joints: Mapping[str, Any], loads: Mapping[str, Load]
) -> int:
    """Markers: one for each place on a body that something acts on, two more of its own for a clearance pin."""
    found: set[tuple[str, Any]] = set()
    for name, pin in linkage.pins.items():
        if name not in clearance_joints:
            found |= {(pin.first, pin.first_point), (pin.second, pin.second_point)}
    for actuator in linkage.actuators.values():
        found |= {(actuator.foot, actuator.foot_point), (actuator.head, actuator.head_point)}
    for slide in linkage.slides.values():
        found |= {(slide.body, slide.point), (GROUND, slide.point)}
    for load in loads.values():
        found |= {(load.body, load.point), (GROUND, load.point)}
    if weighed:
        found |= {(name, body.centre) for name, body in linkage.bodies.items()}
    # every crank has its angle, and all share the coordinate that is held against
    angles = len(linkage.cranks) + bool(linkage.cranks)
    return len(found) + 2 * len(clearance_joints) + angles


def touches_ground(linkage: Linkage) -> bool:
    ends = {end for pin in linkage.pins.values() for end in (pin.first, pin.second)}
    ends |= {end for actuator in linkage.actuators.values() for end in (actuator.foot, actuator.head)}
    return GROUND in ends or bool(linkage.slides)


def counted(one: Scenario, user_functions: int, callbacks: int) -> Inventory:
    """What the linkage says; the last two follow from what moves and what is asked for."""
    linkage, free = one.linkage, one.clearance_pins
    numbers = {
        "pin": len(linkage.pins) - len(free),
        "actuator": len(linkage.actuators) - len(one.oil_columns),
        "crank": len(linkage.cranks),
        "slide": len(linkage.slides),
    }
    bodies = len(linkage.bodies)
    connectors = sum(map(len, (linkage.pins, linkage.actuators, linkage.cranks, linkage.slides, one.loads)))
    weighed = any(one.gravity)
    return Inventory(
        coordinates=3 * bodies,
        constraints=sum(EQUATIONS[kind] * number for kind, number in numbers.items()),
        bodies=bodies,
        nodes=bodies + bool(linkage.cranks),
        objects=bodies + connectors + (touches_ground(linkage) or bool(one.loads)),
        connectors=connectors,
        markers=places(linkage, weighed, free, one.loads),
        loads=bodies if weighed else 0,
        sensors=0,
        user_functions=user_functions,
        callbacks=callbacks,
    )


TRAPEZOIDAL = SolverSettings(integrator="trapezoidal", constraint_index=2)
SYMBOLIC = SolverSettings(backend="symbolic")
STAND = ImpactStand(bore_mass=1.0, journal_mass=1.0, speed=0.1)
ONE_LOOSE = {"rear_base": with_clearance()}
NO_ENERGY = ("tip.*", "pin.*")
# scenario, functions of Python that compute forces, functions that the engine calls every step
CASES: dict[str, tuple[Scenario, int, int]] = {
    "ideal, held": (scenario(), 0, 0),
    "ideal, driven: the length of actuators, energies": (scenario(drive=RISE), 0, 2),
    "ideal, driven, no energies": (scenario(drive=RISE, channels=NO_ENERGY), 0, 1),
    "ideal, driven, energies that need no integral": (scenario(drive=RISE, channels=("energy.kinetic",)), 0, 1),
    "ideal, speed jumps": (scenario(drive=UniformSpeed(stroke=0.01, start=0.02, end=0.1)), 0, 2),
    "ideal, drive that does not move": (scenario(drive=CubicStep(stroke=0.0)), 0, 0),
    "no gravity": (scenario(gravity=(0.0, 0.0)), 0, 0),
    "ideal, steps that grow": (scenario(solver=SolverSettings(growth=8)), 0, 2),
    # before every attempt, after Newton's method, after the step
    "one clearance pin": (scenario(pins=ONE_LOOSE), 1, 3),
    "one clearance pin, no friction": (scenario(pins={"rear_base": with_clearance(friction=False)}), 1, 3),
    "one clearance pin, symbolic": (scenario(pins=ONE_LOOSE, solver=SYMBOLIC), 0, 3),
    "two clearance pins": (scenario(pins=dict.fromkeys(PINS[:2], with_clearance())), 2, 3),
    "all with clearance": (scenario(pins=dict.fromkeys(PINS, with_clearance())), 5, 3),
    "all with clearance, no friction, no gravity": (
        scenario(pins=dict.fromkeys(PINS, with_clearance(friction=False)), gravity=(0.0, 0.0)),
        5,
        3,
    ),
    "oil, held: losses": (scenario(actuators=dict.fromkeys(SUPPORT.linkage().actuators, OIL)), 0, 1),
    "oil, held, no energies": (
        scenario(actuators=dict.fromkeys(SUPPORT.linkage().actuators, OIL), channels=NO_ENERGY),
        0,
        0,
    ),
    "one column of oil, driven": (scenario(actuators={"front_column": OIL}, drive=RISE), 0, 2),
    # the engine follows the roof by itself; energies remain
    "roof": (scenario(loads={"roof": over_the_canopy(0.1)}), 0, 1),
    "roof, no energies": (scenario(loads={"roof": over_the_canopy(0.1)}, channels=NO_ENERGY), 0, 0),
    "roof in the heads of actuators, clearance": (
        scenario(
            loads={"roof": over_the_canopy(0.1, point=SUPPORT.linkage().actuators["front_column"].head_point)},
            pins=ONE_LOOSE,
        ),
        1,
        3,
    ),
    "roof that Python lowers": (
        scenario(loads={"roof": over_the_canopy(0.1, descent=Branching(speed_down=0.1))}, channels=NO_ENERGY),
        1,
        0,
    ),
    "two roofs on a ram": (
        scenario(machine=Ram(), loads={"one": over_the_ram(), "other": over_the_ram(gap=0.1)}),
        0,
        1,
    ),
    "slider-crank, held": (scenario(machine=ravn_slider_crank(), drive=Held()), 0, 0),
    # the engine follows the drive by itself; energies remain
    "slider-crank, turning": (scenario(machine=ravn_slider_crank(), drive=Steady(rate=500.0)), 0, 1),
    "slider-crank, swinging, no energies": (
        scenario(machine=ravn_slider_crank(), drive=RISE, channels=("pin.*", "*.angle")),
        0,
        0,
    ),
    "slider-crank, constraints of velocities": (
        scenario(machine=ravn_slider_crank(), drive=Steady(rate=500.0), solver=TRAPEZOIDAL),
        0,
        2,
    ),
    "slider-crank, clearance": (
        scenario(machine=ravn_slider_crank(), pins={"slider_pin": with_clearance()}, drive=Steady(rate=500.0)),
        1,
        3,
    ),
    "impact stand": (scenario(machine=STAND, pins={"pin": with_clearance()}, gravity=(0.0, 0.0)), 1, 3),
    "impact stand, ideal": (scenario(machine=STAND, gravity=(0.0, 0.0)), 0, 0),
    "impact stand, weighed": (scenario(machine=STAND), 0, 0),
}


@pytest.mark.parametrize("name", CASES)
def test_there_is_what_the_linkage_needs(name: str) -> None:
    one, user_functions, callbacks = CASES[name]
    assert inventory(one) == counted(one, user_functions, callbacks)


def test_the_support_in_plain_numbers() -> None:
    # four bodies; five pins at two places each, two actuators at two places each, four weights: nothing
    # coincides
    assert inventory(scenario()) == Inventory(
        coordinates=12,
        constraints=12,  # 5 pins of 2, 2 actuators of 1
        bodies=4,
        nodes=4,
        objects=12,  # ground, 4 bodies, 5 pins, 2 actuators
        connectors=7,
        markers=18,
        loads=4,
        sensors=0,
        user_functions=0,
        callbacks=0,
    )


def test_what_meets_in_a_point_shares_a_marker() -> None:
    # slider: weight, guide and pin in its centre are one; both centres of the stand: pin and weight
    assert inventory(CASES["slider-crank, held"][0]).markers == 2 + 2 + 2 + 2 + 1 + 2
    assert inventory(CASES["impact stand, weighed"][0]).markers == 2


@pytest.mark.parametrize("machine", [SUPPORT, ravn_slider_crank(), STAND], ids=lambda m: type(m).__name__)
def test_a_freed_pin_takes_two_equations_and_nothing_else(machine: Machine) -> None:
    held = scenario(machine=machine, gravity=(0.0, 0.0))
    ideal = inventory(held)
    for pin in machine.linkage().pins:
        freed = inventory(replace(held, pins={pin: with_clearance()}))
        same = replace(freed, markers=ideal.markers, user_functions=0, callbacks=0)
        assert same == replace(ideal, constraints=ideal.constraints - 2)


def in_space(**changes: Any) -> Scenario:
    return scenario(machine=reference_support(), dimensions=3, **changes)


def test_bodies_in_space_have_seven_coordinates() -> None:
    one = in_space()
    found, bodies = inventory(one), len(one.space.bodies)
    assert (found.bodies, found.nodes, found.loads) == (bodies, bodies, bodies)
    assert found.coordinates == 7 * bodies
    assert found.objects == bodies + found.connectors + 1  # the ground
    assert (found.user_functions, found.callbacks) == (0, 0)


@pytest.mark.parametrize("number", [2, 5, 9])
@pytest.mark.parametrize("backend", ["python", "symbolic"])
def test_a_pin_freed_in_space_has_a_connector_and_if_symbolic_one_for_each_section(
    number: int, backend: Literal["python", "symbolic"]
) -> None:
    settings = SolverSettings(sections=number, backend=backend)
    held, freed = (inventory(in_space(pins=pins, solver=settings)) for pins in ({}, ONE_LOOSE))
    symbolic = backend == "symbolic"
    assert (freed.user_functions, freed.callbacks) == (0 if symbolic else 1, 3)
    more = freed.connectors - held.connectors
    assert (
        more == (number if symbolic else 1) + 1
    )  # and what repeated its joint's constraints before now has to hold by itself
    assert freed.objects - held.objects == more
    assert freed.constraints < held.constraints
    assert freed.coordinates == held.coordinates


TAIL = {"tail_beam": OwnBody(jack=replace(OIL, bore_area=0.01))}
RUBBING = {"front_base": IdealPin(friction=Ambrosio(sliding_coefficient=0.25), radius=0.05)}
BODIES = ("RigidBody2D", "RigidBody")  # the engine's names
LEVELS: dict[str, dict[str, Any]] = {
    "ideal": {},
    "no gravity": {"gravity": (0.0, 0.0)},
    "with_clearance": {"pins": ONE_LOOSE},
    "all with clearance": {"pins": dict.fromkeys(PINS, with_clearance())},
    "oil": {"actuators": dict.fromkeys(("front_column", "rear_column"), OIL)},
    "two bodies": {"actuators": cylinders_and_rods()},
    "two bodies on oil": {"actuators": cylinders_and_rods(OIL)},
    "tail beam": {"parts": {"tail_beam": OwnBody()}},
    "tail beam on oil": {"parts": TAIL},
    "all": {"pins": dict.fromkeys(PINS, with_clearance()), "actuators": cylinders_and_rods(OIL), "parts": TAIL},
    "settled": {"pins": ONE_LOOSE, "start": "settled"},
}
LOADED: dict[str, dict[str, Any]] = {"roof": {"loads": {"roof": over_the_canopy(0.1)}, "pins": ONE_LOOSE}}
IN_BOTH = [(name, dimensions) for name in LEVELS for dimensions in (2, 3)]


@pytest.mark.parametrize(("name", "dimensions"), [*IN_BOTH, ("roof", 2), ("rubbing", 2)])
def test_nothing_in_the_engine_is_left_unused(name: str, dimensions: int) -> None:
    fields = (LEVELS | LOADED).get(name, {"pins": RUBBING})
    one = scenario(machine=reference_support(), dimensions=dimensions, **fields)
    scene: Any = build_in_space(one) if dimensions == 3 else build(one)
    try:
        mbs, data = scene.mbs, scene.mbs.systemData
        objects = [mbs.GetObject(n) for n in range(data.NumberOfObjects())]
        markers = [mbs.GetMarker(n) for n in range(data.NumberOfMarkers())]
        loads = [mbs.GetLoad(n) for n in range(data.NumberOfLoads())]
        used = {int(number) for item in objects for number in item.get("markerNumbers", ())}
        used |= {int(load["markerNumber"]) for load in loads}
        assert used == set(range(len(markers)))
        nodes = {int(item["nodeNumber"]) for item in objects if item["objectType"] in BODIES}
        nodes |= {int(marker["nodeNumber"]) for marker in markers if "nodeNumber" in marker}
        assert nodes == set(range(data.NumberOfNodes()))
        on = {int(marker["bodyNumber"]) for marker in markers if "bodyNumber" in marker}
        bodies = {n for n, item in enumerate(objects) if not {"markerNumbers", "nodeNumbers"} & item.keys()}
        assert nodes >= {int(n) for item in objects for n in item.get("nodeNumbers", ())}
        assert on == bodies if any(one.gravity) else on <= bodies
        assert data.NumberOfSensors() == 0
        acting = len(one.space.bodies if dimensions == 3 else one.linkage.bodies)
        assert len(loads) == (acting if any(one.gravity) else 0)
    finally:
        scene.release()
