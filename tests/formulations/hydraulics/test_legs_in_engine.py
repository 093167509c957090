"""Hydraulic legs in the engine, against the compiled formulation."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import Held, RampedOpening, Result, Scenario, SolverSettings, simulate
from support_exudyn.model.hydraulics.elements import EndStops
from support_exudyn.model.hydraulics.valves import YieldValve
from tests.cases.cylinder_cases import opened
from tests.formulations.hydraulics import leg_cases

CYLINDER = opened(RampedOpening(start=0.02, end=0.15, ramp=0.02, extent=1.0), damping=5e4)
CHANNELS = ("leg0.length", "mass0.velocity_y", "leg0.pressure", "leg0.rod_pressure")
YIELDS = YieldValve(opening_pressure=3e6, rated_flow=2e-2, rated_overpressure=1e6)
CASES = {
    "plain": CYLINDER,
    "yields": replace(CYLINDER, yield_valve=YIELDS),
    "hysteresis": replace(CYLINDER, yield_valve=replace(YIELDS, closing_pressure=2.5e6, rated_flow=1e-2)),
    "boils": replace(CYLINDER, vapour_pressure=-9e4),
    "line": replace(leg_cases.COLUMN, line=leg_cases.LINE),
    "line, jump": replace(leg_cases.COLUMN, line=leg_cases.LINE),
    "stops": replace(CYLINDER, end_stops=EndStops(lowest=-0.01, highest=0.01, stiffness=3e8)),
}


DRIVES = {"line": leg_cases.LIFT, "line, jump": leg_cases.SUDDEN_LIFT}  # of columns; cylinders follow none
QUIET = ("plain", "line", "line, jump")  # with no element that could open, fill or be met


def lift(name: str, formulation: str, step: float = 4e-4) -> Result:
    settings = SolverSettings(tolerance=1e-9) if formulation == "compiled" else SolverSettings()
    return simulate(
        Scenario(
            machine=leg_cases.Uprights(),
            actuators={"leg0": CASES[name]},
            drive=DRIVES.get(name, Held()),
            duration=0.3,
            step=step,
            record_period=0.01,
            formulation=formulation,
            solver=settings,
        )
    )


def error(run: Result, wanted: Result) -> float:
    known = [name for name in CHANNELS if name in wanted.channels]
    parts = [np.abs(run[name] - wanted[name]).max() / np.ptp(wanted[name]) for name in known]
    return float(np.linalg.norm(parts))


@pytest.mark.parametrize("name", CASES)
def test_legs_are_those_of_the_compiled_formulation_to_second_order(name: str) -> None:
    wanted = lift(name, "compiled")
    step = 1e-4 if name in QUIET else 2e-4  # nothing limits what rings there
    coarse, fine = (lift(name, "exudyn", step=size) for size in (2.0 * step, step))
    assert error(fine, wanted) < 1e-3
    assert 3.3 < error(coarse, wanted) / error(fine, wanted) < 4.7
    if name not in QUIET:
        events, known = fine.oil_events["leg0"], wanted.oil_events["leg0"]
        assert known
        assert [one[1:] for one in events] == [one[1:] for one in known]
        np.testing.assert_allclose([e.time for e in events], [e.time for e in known], atol=2e-5)
    assert np.abs(fine["energy.balance"]).max() < 1e-5 * fine["energy.work"].max()
