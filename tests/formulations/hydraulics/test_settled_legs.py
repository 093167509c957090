"""Legs that start settled under a load: lines, valves and tubes are at rest, or valves open at once."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import GroundReaction, OilColumn, Result, Scenario, YieldValve, reference_support, simulate
from support_exudyn.scenario.solver_settings import SolverSettings
from tests.roof_cases import DAMPED, ON_OIL, OVER_THE_COLUMNS

FORMULATIONS = ("exudyn", "compiled")
# how the roof's force falls as it comes down, so that more oil that gives has less to carry
ROOF = GroundReaction(
    body="canopy",
    point=OVER_THE_COLUMNS,
    convergences=(0.0, 0.002, 0.005, 0.02),
    forces=(4e5, 2.5e5, 1e5, 6e4),
    between="linear",
)
VALVE = YieldValve(opening_pressure=1.2e6, rated_flow=1e-4, rated_overpressure=1e5, closing_pressure=1e6)


def settled(columns: dict[str, OilColumn], formulation: str) -> Result:
    scene = Scenario(
        machine=reference_support(), loads={"roof": ROOF}, actuators=columns, start="settled",
        duration=0.02, step=2.5e-4, formulation=formulation, solver=SolverSettings(tolerance=1e-9),
    )  # fmt: skip
    return simulate(scene)


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_a_line_has_the_pressure_of_its_leg(formulation: str) -> None:
    result = settled(DAMPED, formulation)
    for name in DAMPED:
        assert result[f"{name}.line_pressure"][0] == pytest.approx(result[f"{name}.pressure"][0], rel=1e-11)
        np.testing.assert_allclose(result[f"{name}.flow"], 0.0, atol=1e-12)
    assert np.ptp(result["roof.force"]) < 1e-9 * result["roof.force"][0]
    # as columns that give as much by themselves
    fuller = {
        name: replace(oil, bulk_modulus=oil.bulk_modulus / (1.0 + 0.1 / (oil.bore_area * oil.oil_length)))
        for name, oil in ON_OIL.items()
    }
    alike = settled(fuller, formulation)
    assert alike["roof.force"][0] == pytest.approx(result["roof.force"][0], rel=1e-9)
    stiffer = settled(ON_OIL, formulation)
    assert stiffer["roof.force"][0] > 1.1 * result["roof.force"][0]


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_a_valve_whose_opening_pressure_the_load_exceeds_is_open(formulation: str) -> None:
    result = settled({name: replace(oil, yield_valve=VALVE) for name, oil in DAMPED.items()}, formulation)
    pressure, flow = result["front_column.pressure"], result["front_column.yield_flow"]
    assert pressure[0] > 1.25 * VALVE.opening_pressure
    # open, the valve lets out in proportion to what is above the closing pressure
    np.testing.assert_allclose(flow, 1e-4 / 1e5 * (pressure - 1e6), rtol=1e-9)
    assert pressure[-1] < pressure[0] - 1e4
