"""Two stops a rounding size apart are as one: forces are those of the run in which they coincide."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

from support_exudyn import (
    CubicStep,
    Failure,
    OilColumn,
    Result,
    Scenario,
    SolverSettings,
    TableDrive,
    UniformSpeed,
    bore_area,
    simulate,
)
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
