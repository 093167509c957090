"""Scenes of every kind in the compiled and in the Exudyn formulation: as near as the engine's steps go.

The engine runs with two steps. At second order the finer run is off by a third of what both differ by; at the
first, behind jumps and with friction in ideal pins, by as much.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any, NamedTuple

import numpy as np
import pytest

from studies.common.paper_machine import oil_columns
from support_exudyn import (
    AppliedForce,
    BeddedRoof,
    BushingPin,
    ClearancePin,
    CubicStep,
    Drive,
    Held,
    IdealPin,
    OwnBody,
    Reciprocating,
    Result,
    Scenario,
    SolverSettings,
    Steady,
    SuddenOpening,
    TableDrive,
    TorsionSpring,
    UniformSpeed,
    cylinders_and_rods,
    simulate,
)
from support_exudyn.files.machines.read import read_machine
from tests.cases.cylinder_cases import on_cylinders
from tests.cases.guide_cases import FreePair, slider_crank
from tests.cases.law_cases import LUGRE, cylinder_law
from tests.cases.run_cases import PIN, loose_slider_crank, loose_support, paper_contact, support
from tests.formulations import test_guide_clearance as guides
from tests.formulations import test_slots_and_gears as slots
from tests.formulations.test_detailed_supports import SOFT
from tests.formulations.test_falling_block import block, on_the_held
from tests.formulations.test_springs import FREE
from tests.linkage_cases import CrankRocker
from tests.roof_cases import GAP, over_the_canopy, pressed_support
from user_forces import Ambrosio, Johnson, KelvinVoigt, Stribeck, value


@value
class Swaying(Drive):
    """A drive in and out: stroke (1 - cos(rate t)) / 2."""

    stroke: float
    rate: float

    def extension(self, t: float) -> float:
        return 0.5 * self.stroke * (1.0 - math.cos(self.rate * t))

    def speed(self, t: float) -> float:
        return 0.5 * self.stroke * self.rate * math.sin(self.rate * t)

    @property
    def breaks(self) -> tuple[float, ...]:
        return ()

    def span(self, duration: float) -> tuple[float, float]:
        return 0.0, self.stroke


RUBBING = IdealPin(friction=Ambrosio(sliding_coefficient=0.25), radius=0.0655)
BUSHING = BushingPin(stiffness=(5e8, 8e8), damping=(1e5, 2e5), rotational_stiffness=1e4)
RISE = CubicStep(start=0.01, end=0.06, stroke=0.01)
JUMP = UniformSpeed(start=0.02, end=0.06, stroke=0.01)
TABLE = TableDrive(times=(0.0, 0.03, 0.05), extensions=(0.0, 0.004, 0.001))
PRESS = AppliedForce(body="canopy", point=(0.5, 3.0), full_force=(1e4, -1e5), start=0.01, end=0.04)
BED = BeddedRoof(
    body="canopy",
    points=((0.77, 1.993), (2.77, 1.993)),
    bedding=5e8,
    gaps=(0.001, 0.003),
    descent=CubicStep(stroke=0.006, start=0.0, end=0.05),
    damping=2.0,
)
PINS = tuple(support().linkage.pins)


def loose(*names: str, friction: float = 0.1) -> dict[str, Any]:
    return dict.fromkeys(names, ClearancePin(contact=paper_contact(1.0, friction)))


def with_lugre() -> dict[str, Any]:
    return {PIN: ClearancePin(contact=replace(paper_contact(1.0, 0.0), friction=LUGRE))}


def dropped(**laws: Any) -> Scenario:
    """The support falls through its clearance pin and bounces."""
    pin = ClearancePin(contact=replace(paper_contact(1.5, 0.0), **laws))
    return support(pins={PIN: pin}, drive=Held(), duration=0.03)


def loose_everywhere() -> Scenario:
    """The slider-crank with clearance in the guide and in two pins."""
    pin = ClearancePin.simple(clearance=2e-4, bore_radius=0.01, stiffness=1e8, restitution=0.6, friction=0.1)
    scene = slider_crank(1e8, 0.004, Ambrosio(sliding_coefficient=0.2, dynamic_speed=0.05))
    return replace(scene, pins={"slider_pin": pin, "crank_pin": pin})


SCENES: dict[str, Callable[[], Scenario]] = {
    # friction
    "LuGre": lambda: support(pins=with_lugre(), drive=Held(), duration=0.03),
    "LuGre, settled": lambda: support(pins=with_lugre(), drive=RISE, start="settled", duration=0.05),
    "friction in ideal pins": lambda: support(pins=dict.fromkeys(PINS, RUBBING), drive=RISE, duration=0.08),
    "friction beside a loose pin": lambda: support(
        pins={**dict.fromkeys(PINS, RUBBING), **loose(PIN)}, drive=Held(), duration=0.03
    ),
    # other laws: one that pulls and is cut, one of a line contact, friction with two coefficients
    "a dashpot": lambda: dropped(normal=KelvinVoigt(stiffness=1e9, damping=5e4)),
    "a line contact": lambda: dropped(normal=cylinder_law(Johnson)),
    "Stribeck": lambda: dropped(friction=Stribeck(static_coefficient=0.3, sliding_coefficient=0.2)),
    # pins
    "bushing": lambda: support(pins={PIN: BUSHING}, drive=RISE, duration=0.08),
    "bushing, settled": lambda: support(pins={PIN: BUSHING}, drive=RISE, start="settled", duration=0.05),
    "bushing and a loose pin": lambda: support(
        pins={"front_base": BUSHING, **loose(PIN)}, drive=Held(), duration=0.03
    ),
    "two loose pins": lambda: support(pins=loose(PIN, "shield_canopy"), drive=Held(), duration=0.025),
    "three loose pins, settled": lambda: support(
        pins=loose(PIN, "shield_canopy", "front_shield"), drive=RISE, start="settled", duration=0.03
    ),
    "other loose pin": lambda: support(pins=loose("front_base"), drive=Held(), duration=0.03),
    "friction, bore in the link": lambda: support(
        pins={PIN: ClearancePin(contact=paper_contact(1.0, 0.25), bore="second")}, drive=Held(), duration=0.04
    ),
    "pins of a slider-crank": lambda: loose_slider_crank(1e-3, 0.1, gravity=(300.0, -981.0)),
    # guides and gears
    "slot that turns": lambda: Scenario(machine=slots.SlottedLever(), drive=Steady(rate=20.0), duration=0.2),
    "slot and pins with clearance": lambda: loose_everywhere(),
    "slot between bodies": lambda: Scenario(
        machine=slots.ScotchYoke(), drive=Reciprocating(stroke=1.0, period=0.2), duration=0.2
    ),
    "gears": lambda: Scenario(
        machine=slots.GearPair(), drive=Reciprocating(stroke=1.0, period=0.2), duration=0.2
    ),
    "slot with clearance": lambda: slider_crank(1e9, 0.008, Ambrosio(sliding_coefficient=0.05)),
    "pin in a slot": lambda: guides.pair(FreePair(turns=True), guides.AS_PIN, 0.0045),
    # loads
    "roof": lambda: pressed_support(
        over_the_canopy(GAP + 0.001, start=0.0, end=0.05), actuators=oil_columns(), duration=0.06
    ),
    "roof over a loose pin": lambda: pressed_support(
        over_the_canopy(GAP + 0.001, start=0.0, end=0.05), pins=loose(PIN), start="settled", duration=0.06
    ),
    "bed of rock": lambda: pressed_support(
        BED, actuators=oil_columns(), start="settled", duration=0.06, record_period=1e-3
    ),
    "falling block": lambda: on_the_held(block(height=0.005), duration=0.05),
    "falling block over a loose pin": lambda: on_the_held(
        block(height=0.005), pins=loose(PIN), start="settled", duration=0.04
    ),
    "applied force": lambda: support(loads={"press": PRESS}, drive=RISE, duration=0.08),
    "springs": lambda: Scenario(machine=FREE, duration=0.2),
    "torsion spring": lambda: Scenario(
        machine=CrankRocker(angle=0.3, speed=5.0),
        loads={"twist": TorsionSpring(body="rocker", other="coupler", stiffness=20.0)},
        duration=0.2,
    ),
    # actuators
    "oil, struck": lambda: loose_support(actuators=oil_columns(), drive=JUMP, duration=0.04),
    "oil that flows from the start": lambda: loose_support(
        actuators=oil_columns(), drive=Steady(rate=0.05), duration=0.02
    ),
    "cylinders": lambda: on_cylinders(False, SuddenOpening(start=0.01, end=0.1, extent=0.5), duration=0.05),
    "cylinders, clearance, settled": lambda: on_cylinders(
        True, SuddenOpening(start=0.01, end=0.1, extent=0.5), start="settled", duration=0.04
    ),
    "oil": lambda: support(actuators=oil_columns(), drive=RISE, duration=0.08),
    "oil, settled": lambda: loose_support(actuators=oil_columns(), drive=RISE, start="settled", duration=0.05),
    "oil under one end": lambda: support(
        actuators={"rear_column": oil_columns()["rear_column"]}, drive=RISE, duration=0.08
    ),
    "actuators of two bodies": lambda: loose_support(actuators=cylinders_and_rods(), drive=RISE, duration=0.03),
    "tail beam on a jack": lambda: support(parts={"tail_beam": OwnBody()}, drive=RISE, duration=0.08),
    "tail beam on a soft jack": lambda: loose_support(
        parts=SOFT, actuators=oil_columns(), drive=RISE, start="settled", duration=0.05
    ),
    # drives
    "up and down": lambda: loose_support(1.0, drive=Reciprocating(stroke=0.02, period=0.1), duration=0.04),
    "moved from the start": lambda: support(drive=Steady(rate=-0.2), duration=0.1),
    "two drives": lambda: support(drive=RISE, drives={"rear_column": TABLE}, duration=0.08),
    "two drives, clearance": lambda: loose_support(drive=RISE, drives={"rear_column": TABLE}, duration=0.03),
    "table": lambda: support(drive=TABLE, duration=0.08),
    "a drive of one's own": lambda: support(drive=Swaying(stroke=0.01, rate=40.0), duration=0.1),
    "a drive that jumps": lambda: support(drive=JUMP, drives={"rear_column": RISE}, duration=0.08),
    "a drive that jumps, clearance": lambda: loose_support(
        drive=JUMP, drives={"rear_column": RISE}, start="settled", duration=0.04
    ),
    "two-leg shield": lambda: Scenario(
        machine=read_machine("two_leg_shield").machine, drive=RISE, pins=loose("front_base"), duration=0.03
    ),
    "a crank that is held": lambda: loose_slider_crank(
        2e-3, 0.1, drive=Held(), gravity=(300.0, -981.0), record_period=1e-4
    ),
    "crank": lambda: Scenario(machine=CrankRocker(driven=True), drive=Steady(rate=20.0), duration=0.2),
}
STEP = 1e-4  # [s]
STEPS = {
    "a crank that is held": 1e-5,
    "friction in ideal pins": 5e-4,
    "slot with clearance": 1e-5,
    "slot and pins with clearance": 1e-5,
    "pins of a slider-crank": 1e-6,
    "pin in a slot": 2e-5,
}


class Runs(NamedTuple):
    """By the compiled formulation; by the engine with a step and half of it."""

    ours: Result
    coarse: Result
    fine: Result


@cache
def runs(scene: str) -> Runs:
    scenario = replace(SCENES[scene](), formulation="exudyn", step=STEPS.get(scene, STEP))
    scenario = replace(scenario, record_period=min(1e-3, scenario.duration / 20.0))
    engine = replace(scenario, solver=replace(scenario.solver, impact_steps=256))
    ours = replace(scenario, formulation="compiled", solver=SolverSettings(tolerance=1e-9))
    return Runs(simulate(ours), simulate(engine), simulate(engine.refined(2)))


# of the largest value in a unit: Newton's tolerance
ROUNDING = 1e-5
STILL = 1e-3  # largest value in a unit, below which nothing moves


def spread(one: Result, other: Result, name: str) -> float:
    """Root mean square of the difference of a channel."""
    return float(np.sqrt(np.mean((one[name] - other[name]) ** 2)))


@pytest.mark.parametrize("scene", SCENES)
def test_channels_are_those_of_the_engine(scene: str) -> None:
    ours, coarse, fine = runs(scene)
    assert [(n, c.unit, c.meaning) for n, c in ours.channels.items()] == [
        (n, c.unit, c.meaning) for n, c in fine.channels.items()
    ]
    np.testing.assert_array_equal(ours.time, fine.time)
    sizes: dict[str, float] = {}  # largest value in each unit
    for channel in fine.channels.values():
        sizes[channel.unit] = max(sizes.get(channel.unit, STILL), float(np.abs(channel.values).max()))
    for name, channel in fine.channels.items():
        if name == "energy.balance":  # nothing but errors
            continue
        steps, size = spread(coarse, fine, name), sizes[channel.unit]
        assert steps < 2e-3 * size, name  # else the test says little
        assert spread(ours, fine, name) <= steps + ROUNDING * size, name


@pytest.mark.parametrize("scene", SCENES)
def test_impacts_and_impulses_are_those_of_the_engine(scene: str) -> None:
    ours, coarse, fine = runs(scene)
    assert set(ours.onsets) == set(fine.onsets)
    for name, onsets in fine.onsets.items():
        assert len(ours.onsets[name]) == len(onsets) == len(coarse.onsets[name])
        fastest = max((one.speed for one in onsets), default=0.0)
        for mine, right, rough in zip(ours.onsets[name], onsets, coarse.onsets[name], strict=True):
            assert abs(mine.time - right.time) <= abs(rough.time - right.time) + 1e-7
            assert abs(mine.speed - right.speed) <= abs(rough.speed - right.speed) + 1e-5 * fastest
        off = abs(coarse.largest_force[name] / max(fine.largest_force[name], 1.0) - 1.0)
        assert ours.largest_force[name] == pytest.approx(
            fine.largest_force[name], rel=2.0 * off + 1e-5, abs=1e-3
        )
    assert len(ours.impulses) == len(fine.impulses)
    for struck, theirs in zip(ours.impulses, fine.impulses, strict=True):
        assert struck.time == theirs.time
        assert struck.actuators == pytest.approx(theirs.actuators, rel=1e-4)
        assert struck.energy == pytest.approx(theirs.energy, rel=1e-4)


@pytest.mark.parametrize("scene", SCENES)
def test_energies_add_up(scene: str) -> None:
    ours, _, fine = runs(scene)
    turned = max(float(np.ptp(ours[f"energy.{kind}"])) for kind in ("kinetic", "potential", "work"))
    assert ours.energy_error <= 1e-5 * max(turned, 1e-3)
    # of the engine's steps, at the first order behind jumps
    assert fine.energy_error <= 1e-3 * max(turned, 1e-3)


@pytest.mark.parametrize("scene", ["up and down", "oil, settled"])
def test_runs_to_an_accuracy_agree_within_what_they_say(scene: str) -> None:
    one, other = (
        simulate(replace(SCENES[scene](), formulation=name), accuracy="standard")
        for name in ("exudyn", "compiled")
    )
    assert one.met
    assert other.met
    ours, theirs = one.numbers(), other.numbers()
    assert set(ours) == set(theirs)
    within = [
        abs(ours[name].value - theirs[name].value) <= ours[name].error + theirs[name].error for name in ours
    ]
    # an estimate covers 95 of 100; those of a scene hang together
    assert np.mean(within) >= 0.9
    for pin in one.scenario.linkage.pins:
        for word in ("mean", "std", "largest"):
            name = f"pin.{pin}.force.{word}"
            # each may be off by a thousandth
            assert ours[name].value == pytest.approx(theirs[name].value, rel=2e-3), name
