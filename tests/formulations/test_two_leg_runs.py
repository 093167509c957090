"""Runs of the two-leg shield: the canopy keeps level, forces are those of statics."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from support_exudyn import CubicStep, Held, Result, Scenario, simulate
from support_exudyn.files.machines.read import read_machine
from support_exudyn.machines.check import check_machine
from support_exudyn.postprocessing.pytest_plugin import SimulateCached

DATA = read_machine("two_leg_shield")
MACHINE: Any = DATA.machine
RISE = Scenario(machine=MACHINE, drive=CubicStep(stroke=1.15, start=0.1, end=2.1), duration=2.4, step=1e-3)


@pytest.fixture(scope="module")
def rise(simulate_cached: SimulateCached) -> Result:
    return simulate_cached(RISE)


def test_the_canopy_keeps_level_while_the_leg_is_driven(rise: Result) -> None:
    # the ram's curve is right to 1e-12 m; the solver closes joints within some 1e-12 m
    assert np.abs(rise["canopy.angle"]).max() < 1e-10
    assert rise["tip.y"][-1] - rise["tip.y"][0] == pytest.approx(1.1919, abs=1e-4)
    assert np.ptp(rise["tip.x"]) < 0.0125


@pytest.mark.parametrize("at", [0, -1])
def test_at_rest_forces_are_those_of_the_check(rise: Result, at: int) -> None:
    station = check_machine(DATA, 1.15).ways[0].moved[at]
    for pin, force in station.forces.pins.items():
        got = np.array([rise[f"pin.{pin}.force_x"][at], rise[f"pin.{pin}.force_y"][at]])
        # the solver's tolerance, 1e-8 of 1e5 N, and what is left of the ramp's end
        assert got == pytest.approx(force, abs=1.0), pin
    for column, push in station.forces.actuators.items():
        assert rise[f"{column}.force"][at] == pytest.approx(push, abs=1.0)


def test_the_ram_is_as_long_as_closed_form_says(rise: Result) -> None:
    leg = rise["leg.length"] - rise["leg.length"][0]
    some = np.arange(0, leg.size, 100)
    expected = rise["ram.length"][0] + MACHINE.level_ram(leg[some])
    # the solver closes joints within some 1e-12 m
    assert rise["ram.length"][some] == pytest.approx(expected, abs=1e-10)


def test_it_runs_in_space() -> None:
    still = replace(RISE, drive=Held(), dimensions=3, duration=0.02)
    result = simulate(still)
    flat = simulate(replace(still, dimensions=2))
    # both sides bear half; the solver's tolerance
    assert 2.0 * result["leg_left.force"][-1] == pytest.approx(flat["leg.force"][-1], rel=1e-6)
    assert 2.0 * result["ram_right.force"][-1] == pytest.approx(flat["ram.force"][-1], rel=1e-6)
