"""Runs of drives through points, beside those of the drives that they stand for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from support_exudyn import CubicStep, TableDrive, UniformSpeed, simulate
from tests.commands import test_scenario_commands
from tests.commands.test_scenario_commands import same

STROKE = CubicStep(stroke=0.02, start=0.02, end=0.08)
BASE = replace(test_scenario_commands.BASE, drive=STROKE, duration=0.1, record_period=1e-3)


def test_a_fine_table_of_a_cubic_step_drives_as_it_does() -> None:
    times = np.linspace(0.02, 0.08, 61)
    points = TableDrive(times=times.tolist(), extensions=[STROKE.extension(t) for t in times.tolist()])
    scenario = replace(BASE, pins={}, step=1e-4)
    one, other = simulate(replace(scenario, drive=points)), simulate(scenario)
    # a smooth table is of second order near the ends, where it rests, and of third elsewhere: its rise differs
    # by the acceleration there, 33 m/s^2, over an interval of 1 ms, squared, over 2: 17 um of 20 mm
    difference = np.abs(one["tip.y"] - other["tip.y"]).max()
    assert difference < 17e-6 * 4.0  # the tip goes up to four times as far as the actuators
    assert difference > 0.0


def test_two_points_drive_as_a_cubic_step_to_the_bit() -> None:
    points = TableDrive(times=(0.02, 0.08), extensions=(0.0, 0.02))
    same(simulate(replace(BASE, drive=points)), simulate(BASE))


def test_two_points_on_a_line_drive_as_uniform_speed_to_the_bit() -> None:
    points = TableDrive(times=(0.02, 0.08), extensions=(0.0, 0.02), between="linear")
    one = simulate(replace(BASE, drive=points))
    other = simulate(replace(BASE, drive=UniformSpeed(stroke=0.02, start=0.02, end=0.08)))
    assert len(one.impulses) == 2
    same(one, other)
