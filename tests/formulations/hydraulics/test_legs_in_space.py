"""Hydraulic legs with elements in space, where each is one of a pair, against the plane."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from studies.common import paper_machine
from support_exudyn import (
    CheckValve,
    PumpStation,
    RampedOpening,
    Result,
    Scenario,
    YieldValve,
    reference_support,
    simulate,
)

INLET = RampedOpening(start=0.02, end=0.12, ramp=0.03)


@cache
def _rise(dimensions: int) -> Result:
    columns = {
        name: replace(
            column,
            vapour_pressure=-99e3,
            check_valve=CheckValve(),
            yield_valve=YieldValve(opening_pressure=40e6, rated_flow=0.0167, rated_overpressure=4e6),
        )
        for name, column in paper_machine.hydraulic_cylinders(INLET).items()
    }
    return simulate(
        Scenario(
            machine=reference_support(),
            actuators=columns,
            pump=PumpStation(flow=7.5e-3, pressure=31.5e6),
            duration=0.14,
            step=2.5e-4,
            record_period=1e-3,
            dimensions=dimensions,
        )
    )


@pytest.mark.parametrize("side", ["left", "right"])
def test_both_sides_do_what_the_pair_does_in_the_plane(side: str) -> None:
    space, plane = _rise(3), _rise(2)
    for row in ("front_column", "rear_column"):
        for what in ("pressure", "rod_pressure", "length"):
            expected = plane[f"{row}.{what}"]
            np.testing.assert_allclose(space[f"{row}_{side}.{what}"], expected, rtol=1e-6, atol=20.0)
        for what in ("oil", "let_in", "flow"):  # each side has half of it
            expected = 0.5 * plane[f"{row}.{what}"]
            found = space[f"{row}_{side}.{what}"]
            np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-6 * np.abs(expected).max())
    np.testing.assert_allclose(space["front_column.force"], plane["front_column.force"], rtol=1e-5, atol=1.0)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_oil_and_energy_add_up_in_the_engine(dimensions: int) -> None:
    run = _rise(dimensions)
    name = "front_column_left" if dimensions == 3 else "front_column"
    open_oil = run[f"{name}.oil"] - run[f"{name}.let_in"]
    assert np.abs(open_oil - open_oil[0]).max() < 1e-10 * open_oil[0]
    assert np.abs(run["energy.balance"]).max() < 1e-4 * run["energy.work"][-1]
