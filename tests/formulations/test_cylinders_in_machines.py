"""Hydraulic cylinders among clearance pins, rigid actuators and loads; and what runs on them must say."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import (
    Held,
    Inlet,
    RampedOpening,
    Roof,
    Scenario,
    SimulationError,
    SuddenOpening,
    simulate,
)
from tests.cases.cylinder_cases import Ram, lift, on_cylinders, opened
from tests.cases.run_cases import FORCE
from user_forces import value


def test_a_machine_with_closed_valves_stays_where_it_is() -> None:
    result = simulate(on_cylinders(False, duration=1.0))
    for name in ("front_column", "rear_column"):
        # rounding of a length of 1.6 m, over a second; 1e-9 m was asked for
        assert np.ptp(result[f"{name}.length"]) < 1e-12
        assert np.ptp(result[f"{name}.pressure"]) < 1.0  # [Pa]
    np.testing.assert_allclose(result[FORCE], 58778.944, rtol=1e-6)  # as with rigid actuators
    settled = simulate(on_cylinders(True, start="settled", duration=0.3))
    # the journal has sunk, and pressures have changed with the posture
    assert np.ptp(settled["rear_column.length"]) < 1e-10
    assert settled["rear_column.pressure"][0] != pytest.approx(result["rear_column.pressure"][0], rel=1e-6)


def test_energy_adds_up_with_loose_pins_and_valves() -> None:
    scenario = on_cylinders(True, RampedOpening(start=0.1, end=0.3, ramp=0.1), duration=0.35)
    scenario = replace(scenario, solver=replace(scenario.solver, impact_steps=64))
    coarse, fine = (simulate(scenario.refined(n)) for n in (1, 2))
    # the valves turn 100 kJ into heat; impacts and pressures follow to second order
    assert fine.energy_error < 1e-4 * fine["energy.damping_loss"][-1]
    assert fine.energy_error < 0.6 * coarse.energy_error
    assert fine["rear_column.pressure"].max() == pytest.approx(coarse["rear_column.pressure"].max(), rel=0.02)


def test_a_ram_is_set_against_a_roof_with_the_pressure_of_the_pump() -> None:
    # flow ends where the root is steepest: pressure drops of the open valve become zero on both sides
    roof = Roof(body="ram", point=(0.0, 1.6), gap=0.03, stiffness=1e9, descent=Held(), damping=1e-3)
    cylinder = opened(SuddenOpening(start=0.05, end=2.0), damping=5e4)
    scenario = Scenario(
        machine=Ram(), loads={"roof": roof}, actuators={"jack": cylinder}, drive=Held(), duration=1.0, step=5e-4
    )
    result = simulate(scenario)
    # the trapezoidal rule hops about the end by the flow of a step, some 100 Pa
    assert result["jack.pressure"][-1] == pytest.approx(31.5e6, abs=1e3)
    assert result["jack.rod_pressure"][-1] == pytest.approx(0.5e6, abs=1e3)
    assert result["jack.force"][-1] == pytest.approx(31.5e6 * 0.098 - 0.5e6 * 0.03, rel=1e-4)
    assert result.energy_error < 1e-4 * result["energy.work"][-1]


def test_a_piston_at_the_end_of_its_cylinder_stops_the_run() -> None:
    cylinder = opened(SuddenOpening(start=0.0, end=0.4), rod_side_length=0.05)
    with pytest.raises(SimulationError, match=r"jack is extended by 0\.05.*allowed: -0\.5 to 0\.05 m"):
        lift(cylinder, duration=0.5)


@value
class Swelling(Inlet):
    """A valve that opens along a sine and has no break at all."""

    frequency: float

    def opening(self, t: float) -> float:
        return 0.5 * math.sin(2.0 * math.pi * self.frequency * t)

    @property
    def breaks(self) -> tuple[float, ...]:
        return ()

    @property
    def shortest_time(self) -> float:
        return 1.0 / self.frequency


def test_a_valve_without_breaks_is_followed() -> None:
    result = lift(opened(Swelling(frequency=1.0), damping=1e5), duration=0.5)
    moved = result["jack.length"] - result["jack.length"][0]
    # no oil is lost: what has flowed in stands under the piston, but for its compression of 1e-3
    flowed = np.trapezoid(result["jack.flow"], result.time)
    assert moved[-1] == pytest.approx(flowed / 0.098, rel=0.01)
    assert moved[-1] > 0.05
