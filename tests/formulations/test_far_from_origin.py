"""A machine far from the origin is the same: its numbers differ by what rounding leaves of the coordinates."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from support_exudyn import (
    ClearancePin,
    CubicStep,
    Held,
    OilColumn,
    Result,
    Scenario,
    reference_support,
    simulate,
)
from support_exudyn.files.machines.read import shipped
from tests.cases.run_cases import paper_contact
from user_forces.values.value import Vector2

SHIFTS = [(300.0, 0.0), (0.0, 300.0), (-900.0, 600.0)]
OIL = OilColumn(bore_area=0.1, oil_length=0.5, bulk_modulus=1.5e9)
RISE = CubicStep(start=0.0, end=0.05, stroke=0.005)


def shifted(machine: Any, by: Vector2) -> Any:
    """A support elsewhere: all places are moved."""

    def place(point: Vector2) -> Vector2:
        return point[0] + by[0], point[1] + by[1]

    changed: dict[str, Any] = {"start_hinge_height": machine.start_hinge_height + by[1]}
    for field in dataclasses.fields(machine):
        item = getattr(machine, field.name)
        if field.name == "parts":
            changed["parts"] = {
                name: tuple(replace(part, centre=place(part.centre)) for part in parts)
                for name, parts in item.items()
            }
        elif isinstance(item, tuple) and len(item) == 2 and all(isinstance(x, float) for x in item):
            changed[field.name] = place(item)
    return replace(machine, **changed)


def with_clearance(**more: Any) -> dict[str, ClearancePin]:
    return {"rear_base": ClearancePin(contact=paper_contact(1.5, 0.0), **more)}


SCENES: dict[str, Callable[[Any], Scenario]] = {
    "settled": lambda m: Scenario(machine=m, pins=with_clearance(), start="settled", drive=RISE, duration=0.05),
    "settled, at rest": lambda m: Scenario(machine=m, pins=with_clearance(), start="settled", duration=0.02),
    "settled on oil": lambda m: Scenario(
        machine=m, actuators=dict.fromkeys(("front_column", "rear_column"), OIL), start="settled", duration=0.02
    ),
    "eccentric": lambda m: Scenario(machine=m, pins=with_clearance(eccentricity=(0.0, -0.001)), duration=0.02),
    "compiled": lambda m: Scenario(machine=m, pins=with_clearance(), formulation="compiled", duration=0.02),
    "space": lambda m: Scenario(machine=m, drive=Held(), dimensions=3, start="settled", duration=0.005),
}


def apart(near: Result, far: Result, by: Vector2) -> tuple[float, float]:
    """By how much forces differ in the mean over time, of their largest, and places of the tip at most [m]."""
    # constraints of ideal pins show the rounding of places over the square of the short steps at impacts
    pins = near.scenario.clearance_pins or near.scenario.linkage.pins
    forces = [f"pin.{name}.force" for name in pins if f"pin.{name}.force" in near.channels]
    forces = forces or [f"pin.{name}_left.force" for name in pins]  # in space
    largest = max(float(np.abs(near[name]).max()) for name in forces)
    force = max(float(np.abs(near[name] - far[name]).mean()) for name in forces) / largest
    tip = [np.abs(far[f"tip.{axis}"] - d - near[f"tip.{axis}"]).max() for axis, d in zip("xy", by, strict=True)]
    return force, float(max(tip))


@pytest.mark.parametrize("name", SCENES)
def test_a_support_is_the_same_elsewhere(name: str) -> None:
    near = simulate(SCENES[name](reference_support()))
    for by in SHIFTS:
        force, tip = apart(near, simulate(SCENES[name](shifted(reference_support(), by))), by)
        assert force < 1e-5, by  # coordinates of a kilometre are rounded by 1e-13 m, contacts have 1e10 N/m
        assert tip < 1e-10, by


def test_the_ram_of_a_two_leg_shield_follows_its_leg_elsewhere() -> None:
    def scene(by: Vector2) -> Scenario:
        return Scenario(
            machine=shifted(shipped("two_leg_shield").machine, by), drive=RISE, start="settled", duration=0.05
        )

    near = simulate(scene((0.0, 0.0)))
    for by in SHIFTS:
        force, tip = apart(near, simulate(scene(by)), by)
        assert force < 1e-2, by  # in the first short step of the drive constraints show their rounding
        assert tip < 1e-10, by
