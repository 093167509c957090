"""Two stops a rounding size apart are as one: forces are those of the run in which they coincide."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from studies.common.paper_machine import hydraulic_cylinders
from support_exudyn import (
    ClosedInlet,
    CubicStep,
    Failure,
    Held,
    OilColumn,
    Result,
    Scenario,
    SolverSettings,
    TableDrive,
    UniformSpeed,
    bore_area,
    simulate,
)
from support_exudyn.formulations.exudyn.scene.engine_scene import slide
from support_exudyn.formulations.exudyn.scene.scene_builder import build
from support_exudyn.scene.hydraulics.implicit import START_RATE
from tests.cases.run_cases import PIN, loose_support, support

OIL = OilColumn(bore_area=bore_area(0.25, 2), oil_length=0.5, bulk_modulus=1.5e9)
OILS = {"front_column": OIL, "rear_column": OIL}
WEIGHT = 2e5  # [N], of what is carried
BREAK = 0.01  # [s], a record
SHORT: dict[str, Any] = {"duration": 0.03, "record_period": 1e-3}


def cubic(t: float) -> CubicStep:
    return CubicStep(start=t, end=0.025, stroke=0.001)


def uniform(t: float) -> UniformSpeed:
    return UniformSpeed(start=t, end=0.025, stroke=0.001)


def table(t: float, between: Any) -> TableDrive:
    return TableDrive(times=(t, 0.02, 0.025), extensions=(0.0, 0.001, 0.0005), between=between)


# each with something that breaks at a time [s]
SCENES: dict[str, Callable[[float], Scenario]] = {
    "smooth": lambda t: support(drive=cubic(t), **SHORT),
    "struck": lambda t: support(drive=uniform(t), **SHORT),
    "table of lines": lambda t: support(drive=table(t, "linear"), **SHORT),
    "oil": lambda t: support(drive=cubic(t), actuators=OILS, **SHORT),
    "growing steps": lambda t: support(drive=cubic(t), solver=SolverSettings(growth=8), **SHORT),
    "with_clearance": lambda t: loose_support(0.5, 0.25, drive=cubic(t), start="settled", **SHORT),
    "clearance, struck": lambda t: loose_support(0.5, 0.25, drive=uniform(t), start="settled", **SHORT),
    "space": lambda t: support(drive=uniform(t), dimensions=3, **SHORT),
    "clearance in space": lambda t: loose_support(
        0.5, drive=cubic(t), dimensions=3, start="settled", **SHORT | {"duration": 0.015}
    ),
    "compiled": lambda t: loose_support(
        0.5, 0.25, drive=cubic(t), actuators=OILS, formulation="compiled", **SHORT
    ),
    "compiled, struck": lambda t: support(
        drive=uniform(t), drives={"rear_column": table(t, "smooth")}, formulation="compiled", **SHORT
    ),
}
# of the forces: accelerations jump at smooth breaks by 10 m/s^2 and change within 10 ms, so that forces change
# by 1e-3 of the weight if a break moves by 1e-6 s; below it is Newton's method, and rounding in steps of 15 us
AGREE, AND_PER_SECOND = 3e-5, 2e3


@cache
def coinciding(scene: str) -> Result:
    return simulate(SCENES[scene](BREAK))


def apart(one: Result, other: Result) -> float:
    """The largest difference of any force at any record but that of the break, of the weight."""
    np.testing.assert_array_equal(one.time, other.time)
    # a record at a break is of just before it, one behind it of just after
    compared = np.abs(one.time - BREAK) > 1e-9
    names = [name for name in one.channels if name.endswith(".force") and name.count(".") <= 2]
    assert len(names) >= 5
    return max(float(np.abs(one[n] - other[n])[compared].max()) for n in names) / WEIGHT


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("beside", [1e-13, -1e-9, -1e-6])
def test_a_break_just_beside_a_record_is_as_one_on_it(scene: str, beside: float) -> None:
    found = simulate(SCENES[scene](BREAK + beside))
    assert apart(found, coinciding(scene)) < AGREE + AND_PER_SECOND * abs(beside)
    assert found.counts.steps < 1.5 * coinciding(scene).counts.steps + 40


@cache
def dropped(record_period: float) -> Result:
    return simulate(loose_support(0.5, 0.25, duration=0.04, record_period=record_period))


@pytest.mark.parametrize("before", [1e-12, 1e-9, 1e-7])
@pytest.mark.parametrize("event", ["impact", "separation"])
def test_a_touch_or_parting_just_before_a_record(event: str, before: float) -> None:
    # the record is laid just behind where it happens, which the period does not change
    onset = dropped(0.02).onsets[PIN][0]
    at = onset.time if event == "impact" else onset.separation_time
    assert 1e-3 < at < 0.04
    found, beside = dropped(at + before), dropped(at + 2e-6)
    for name in ("pin.front_base.force", "front_column.force", f"pin.{PIN}.force"):
        # forces change within 0.1 ms at the impact, so by a fiftieth of the weight in 2 us
        assert abs(found[name][1] - beside[name][1]) < 0.04 * WEIGHT
    assert not isinstance(found, Failure)


@pytest.mark.parametrize("rest", [1e-9, 1e-6, 1e-3])
def test_a_rest_is_moved_over_by_the_rates(rest: float) -> None:
    scene = build(loose_support(0.5, 0.25, actuators=hydraulic_cylinders(ClosedInlet()), drive=Held(), **SHORT))
    data = scene.mbs.systemData
    numbers = np.random.default_rng(3)
    at = data.GetODE2Coordinates() + 1e-4 * numbers.standard_normal(data.ODE2Size())
    velocity, acceleration = (numbers.standard_normal(at.size) for _ in range(2))
    oil = scene.legs.states().copy()
    assert oil.size > 0
    flow = 1e9 * numbers.standard_normal(oil.size)
    scene.legs.known[START_RATE] = flow
    data.SetODE2Coordinates(at)
    data.SetODE2Coordinates_t(velocity)
    data.SetODE2Coordinates_tt(acceleration)
    slide(scene, rest)
    # what a constant acceleration gives; rounding
    np.testing.assert_allclose(
        data.GetODE2Coordinates(), at + velocity * rest + acceleration * rest**2 / 2.0, rtol=1e-14
    )
    np.testing.assert_allclose(data.GetODE2Coordinates_t(), velocity + acceleration * rest, rtol=1e-14)
    np.testing.assert_allclose(scene.legs.states(), oil + flow * rest, rtol=1e-14)
    # what the pin remembers is of where it is now
    pin = scene.clearance_joints[PIN]
    motion = pin.item.relative()
    (x, y, _), (vx, vy, _) = motion.displacement, motion.velocity
    distance = float(np.hypot(x, y))
    assert pin.kept.depth == pytest.approx(distance - pin.contact.bearing.clearance, abs=1e-13)
    assert pin.kept.rate == pytest.approx((x * vx + y * vy) / distance, rel=1e-9)


@pytest.mark.parametrize("scene", ["smooth", "with_clearance"])
@pytest.mark.parametrize("beside", [-1e-8, 1e-8])
def test_one_rest_is_moved_over_once(scene: str, beside: float, monkeypatch: pytest.MonkeyPatch) -> None:
    # and steps go on from its end, on the grid: else another would be needed to get back to it
    rests: list[float] = []

    def slid(moving: Any, rest: float) -> None:
        rests.append(rest)
        slide(moving, rest)

    monkeypatch.setattr("support_exudyn.formulations.exudyn.solver.solver.slide", slid)
    found, without = (simulate(replace(SCENES[scene](t), duration=0.012)) for t in (BREAK + beside, BREAK))
    assert rests == [pytest.approx(abs(beside), rel=1e-6)]
    assert found.counts.steps == without.counts.steps
