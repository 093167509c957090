"""The engine holds what a scenario needs and nothing else, and calls Python no more often than needed."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from support_exudyn import (
    ClearancePin,
    CubicStep,
    IdealPin,
    ImpactStand,
    Machine,
    OilColumn,
    OwnBody,
    Scenario,
    SolverSettings,
    Steady,
    bore_area,
    cylinders_and_rods,
    ravn_slider_crank,
    reference_support,
)
from support_exudyn.formulations.redundant.inventory import Inventory, inventory
from support_exudyn.formulations.redundant.scene.scene_builder import build
from support_exudyn.formulations.redundant.space.scene_builder import build as build_in_space
from tests.cases.machine_cases import contact, support
from tests.roof_cases import over_the_canopy
from user_forces import Ambrosio, Frictionless

SUPPORT = support()
PINS = tuple(SUPPORT.linkage().pins)
RISE = CubicStep(stroke=0.01, start=0.0, end=0.1)
OIL = OilColumn(bore_area=bore_area(0.25, 2), oil_length=0.5, bulk_modulus=1.5e9)


def with_clearance(friction: bool = True) -> ClearancePin:
    whole = contact()
    return ClearancePin(contact=whole if friction else replace(whole, friction=Frictionless()))


def scenario(**changes: Any) -> Scenario:
    fields: dict[str, Any] = {"machine": SUPPORT, "duration": 0.1}
    return Scenario(**fields | changes)


ONE_LOOSE = {"rear_base": with_clearance()}
# scenario, functions of Python that compute forces, functions that the engine calls every step
CASES: dict[str, tuple[Scenario, int, int]] = {
    "ideal, held": (scenario(), 0, 2),
    "ideal, driven": (scenario(drive=RISE), 0, 2),
    # before every attempt, after Newton's method where steps may be cut, after the step
    "one clearance pin": (scenario(pins=ONE_LOOSE), 1, 3),
    "all with clearance": (scenario(pins=dict.fromkeys(PINS, with_clearance())), 5, 3),
    "oil, held": (scenario(actuators=dict.fromkeys(SUPPORT.linkage().actuators, OIL)), 0, 2),
    "one column of oil, driven": (scenario(actuators={"front_column": OIL}, drive=RISE), 0, 2),
    "roof": (scenario(loads={"roof": over_the_canopy(0.1)}), 1, 2),
    "slider-crank, turning": (scenario(machine=ravn_slider_crank(), drive=Steady(rate=500.0)), 0, 2),
    "slider-crank, clearance": (
        scenario(machine=ravn_slider_crank(), pins={"slider_pin": with_clearance()}, drive=Steady(rate=500.0)),
        1,
        3,
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_the_engine_calls_python_as_often_as_needed(name: str) -> None:
    one, user_functions, callbacks = CASES[name]
    made = inventory(one)
    assert (made.user_functions, made.callbacks) == (user_functions, callbacks)


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
        callbacks=2,
    )


@pytest.mark.parametrize(
    "machine",
    [SUPPORT, ravn_slider_crank(), ImpactStand(bore_mass=1.0, journal_mass=1.0, speed=0.1)],
    ids=lambda m: type(m).__name__,
)
def test_a_freed_pin_takes_two_equations_and_nothing_else(machine: Machine) -> None:
    held = scenario(machine=machine, gravity=(0.0, 0.0))
    ideal = inventory(held)
    for pin in machine.linkage().pins:
        freed = inventory(replace(held, pins={pin: with_clearance()}))
        same = replace(freed, markers=ideal.markers, user_functions=0, callbacks=ideal.callbacks)
        assert same == replace(ideal, constraints=ideal.constraints - 2)


def in_space(**changes: Any) -> Scenario:
    return scenario(machine=reference_support(), dimensions=3, **changes)


@pytest.mark.parametrize("number", [2, 5, 9])
def test_a_pin_freed_in_space_has_one_connector_whatever_its_sections(number: int) -> None:
    settings = SolverSettings(sections=number)
    held, freed = (inventory(in_space(pins=pins, solver=settings)) for pins in ({}, ONE_LOOSE))
    assert (freed.user_functions, freed.callbacks) == (1, 3)
    # and what repeated its joint's constraints before now has to hold by itself
    assert freed.connectors - held.connectors == freed.objects - held.objects == 1 + 1
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
