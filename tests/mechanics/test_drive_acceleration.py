"""Second derivatives of drives against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from support_exudyn import CubicStep, Drive, Held, Reciprocating, Steady, TableDrive, UniformSpeed
from support_exudyn.mechanics.drive_acceleration import accelerations


def rate(drive: Drive, *times: float) -> list[float]:
    return accelerations(drive, np.array(times), 10.0).tolist()


def test_a_cubic_step_is_accelerated_along_a_straight_line() -> None:
    drive = CubicStep(stroke=0.5, start=3.0, end=5.0)
    wanted = [0.5 * (6.0 - 12.0 * x) / 4.0 for x in (0.25, 0.5, 0.9)]
    assert rate(drive, 3.5, 4.0, 4.8) == pytest.approx(wanted, abs=1e-9)
    assert rate(drive, 0.0, 1.0, 6.0) == pytest.approx([0.0] * 3, abs=1e-9)


def test_at_a_break_it_is_the_value_before() -> None:
    drive = CubicStep(stroke=0.5, start=3.0, end=5.0)
    last = -0.5 * 6.0 / 4.0
    assert rate(drive, 3.0, 5.0) == pytest.approx([0.0, last], abs=1e-9)
    # a record may miss a break by rounding
    assert rate(drive, 3.0 + 4e-16, 5.0 + 1e-15, 5.0 - 1e-15) == pytest.approx([0.0, last, last], abs=1e-9)
    # just after it
    assert rate(drive, 3.0 + 1e-7) == pytest.approx([-last], rel=1e-3)
    # what begins at the start has not begun there
    assert rate(CubicStep(start=0.0, end=1.0), 0.0) == [0.0]


@pytest.mark.parametrize(
    "drive", [UniformSpeed(), TableDrive(times=(0.0, 1.0), extensions=(0.0, 0.1), between="linear")]
)
def test_a_jump_of_the_speed_is_no_acceleration(drive: Drive) -> None:
    times = sorted({*drive.breaks, *(t + h for t in drive.breaks for h in (1e-8, 1e-5, 0.1)), 0.0})
    assert rate(drive, *times) == pytest.approx([0.0] * len(times), abs=1e-7)


def test_what_swings_is_accelerated_from_the_start_on() -> None:
    drive, w = Reciprocating(stroke=0.2, period=0.5), 4.0 * math.pi
    times = (0.01, 0.1, 0.3, 7.77)
    assert rate(drive, *times) == pytest.approx([0.1 * w * w * math.cos(w * t) for t in times], rel=1e-9)
    assert rate(Steady(rate=100.0), 0.0, 1.0) == pytest.approx([0.0, 0.0], abs=1e-7)
    assert rate(Held(), 0.0, 1.0) == [0.0, 0.0]
