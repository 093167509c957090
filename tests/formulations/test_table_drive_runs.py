"""Runs of drives through points, beside those of the drives that they stand for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from studies.common.paper_machine import clearance_joint, oil_columns
from support_exudyn import CubicStep, SolverSettings, TableDrive, UniformSpeed, simulate
from tests.commands import test_scenario_commands
from tests.commands.test_scenario_commands import same

STROKE = CubicStep(stroke=0.02, start=0.02, end=0.08)
BASE = replace(test_scenario_commands.BASE, drive=STROKE, duration=0.1, record_period=1e-3)
POINTS = TableDrive(times=(0.0, 0.03, 0.07), extensions=(0.0, 0.01, 0.002))
COMPILED = replace(BASE, formulation="compiled", solver=SolverSettings(tolerance=1e-6))


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


def test_a_line_from_the_start_on_begins_with_an_impulse() -> None:
    points = TableDrive(times=(0.0, 0.08), extensions=(0.0, 0.02), between="linear")
    scenario = replace(BASE, pins={}, duration=0.05)
    one = simulate(replace(scenario, drive=points))
    other = simulate(replace(scenario, drive=UniformSpeed(stroke=0.02, start=0.0, end=0.08)))
    assert [impulse.time for impulse in one.impulses] == [0.0]
    same(one, other)


def test_the_compiled_formulation_follows_a_table() -> None:
    pins = {"rear_base": clearance_joint(1.5, 0.0)}
    oil = oil_columns()
    scenario = replace(BASE, formulation="compiled", actuators=oil, drive=POINTS, duration=0.06, pins=pins)
    one = simulate(scenario)
    other = simulate(replace(scenario, formulation="exudyn", step=1e-4))
    # until the journal makes contact both integrate the same smooth motion: errors of second order at 0.1 ms
    before = one.time < one.onsets["rear_base"][0].time - 1e-3
    assert np.abs(one["tip.y"] - other["tip.y"])[before].max() < 1e-6


def test_two_points_on_a_line_drive_the_compiled_support_as_uniform_speed_to_the_bit() -> None:
    points = TableDrive(times=(0.02, 0.08), extensions=(0.0, 0.02), between="linear")
    one = simulate(replace(COMPILED, drive=points))
    other = simulate(replace(COMPILED, drive=UniformSpeed(stroke=0.02, start=0.02, end=0.08)))
    assert len(one.impulses) == 2
    same(one, other)


def test_compiled_and_redundant_formulations_follow_a_table_alike() -> None:
    ideal = replace(BASE, pins={}, drive=POINTS)
    one = simulate(replace(ideal, formulation="compiled"))
    other, finer = simulate(replace(ideal, step=1e-4)), simulate(replace(ideal, step=5e-5))
    for name in ("tip.y", "pin.rear_base.force"):
        error = np.abs(other[name] - finer[name]).max()
        # the redundant one's own error, by halving its steps: of second order, 4/3 of what that changes; times
        # 2 for the maximum over records, and rounding
        assert np.abs(one[name] - other[name]).max() <= 8.0 / 3.0 * error + 1e-9 * np.abs(one[name]).max()
