"""A mass on trapped oil behind a yield valve, struck by a block: peak, flow and times, to nine digits.

The digits of the first case are those of a solution that was made elsewhere.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.optimize import brentq

from support_exudyn import (
    FallingBlock,
    OilColumn,
    Poppet,
    Result,
    Scenario,
    SolverSettings,
    YieldValve,
    bore_area,
    simulate,
)
from tests.formulations.hydraulics.integrated import Block, Stand, Trajectory
from tests.formulations.hydraulics.leg_cases import LENGTH, Uprights

VALVE = YieldValve(opening_pressure=1e7, rated_flow=0.1, rated_overpressure=1e6)  # 1e-7 m^3/s/Pa
LEG = OilColumn(
    bore_area=bore_area(0.4),
    oil_length=1.0,
    bulk_modulus=1.96e9,
    vapour_pressure=0.0,
    yield_valve=VALVE,
)
FINE, COARSE = 1e-5, 1e-4  # [s] between records: where a peak is looked for, and where not


class Struck(NamedTuple):
    """Mass on the leg, mass of the block [kg], its height [m], the face's stiffness [N/m], the valve."""

    mass: float = 1e4
    block: float = 2e3
    height: float = 0.5
    stiffness: float = 1e8
    valve: YieldValve = VALVE


def scene(case: Struck, record: float = COARSE) -> Scenario:
    block = FallingBlock(
        body="mass0",
        point=(0.0, LENGTH),
        mass=case.block,
        height=case.height,
        stiffness=case.stiffness,
        restitution=1.0,
        exponent=1.0,
    )
    end = np.sqrt(2.0 * case.height / 9.81) + 0.03
    return Scenario(
        machine=Uprights(masses=(case.mass,)),
        actuators={"leg0": replace(LEG, yield_valve=case.valve)},
        loads={"block": block},
        duration=float(np.ceil(end / COARSE) * COARSE),
        record_period=record,
        formulation="compiled",
        solver=SolverSettings(tolerance=1e-11),
    )


def by_scipy(case: Struck) -> Trajectory:
    """Without the block, which the program counts among the bodies."""
    alone = replace(scene(case), loads={})
    first = np.floor(np.sqrt(2.0 * case.height / 9.81) / COARSE)
    late = np.arange(first, round(alone.duration / COARSE) + 1)
    return Stand(alone, Block(case.block, case.height, case.stiffness)).run(late * COARSE)


def peak(time: np.ndarray, values: np.ndarray) -> tuple[float, float]:
    """When and how large the largest is, by the polynomial through five records."""
    k = int(values.argmax())
    here = slice(k - 2, k + 3)
    course = Polynomial.fit(time[here] - time[k], values[here] - values[k], 4)
    when = brentq(course.deriv(), time[k - 1] - time[k], time[k + 1] - time[k])
    return float(time[k] + when), float(values[k] + course(when))


def times(result: Result, what: str) -> list[float]:
    return [event.time for event in result.oil_events["leg0"] if event.what == what]


def test_a_struck_leg_yields_as_it_was_found_elsewhere() -> None:
    result = simulate(scene(Struck(), FINE))
    when, largest = peak(result.time, result["leg0.pressure"])
    assert largest == pytest.approx(10608326.2, abs=0.06)
    assert when == pytest.approx(0.332696506, abs=1e-9)
    opened, closed = times(result, "yield valve open")
    assert opened == pytest.approx(0.331221499, abs=1e-9)
    assert closed == pytest.approx(0.337352114, abs=1e-9)
    assert result["leg0.yielded"][-1] == pytest.approx(2.22564578e-4, abs=1e-12)


def test_a_valve_for_40_megapascal_stays_closed() -> None:
    result = simulate(scene(Struck(valve=replace(VALVE, opening_pressure=4e7)), 2.0 * FINE))
    assert peak(result.time, result["leg0.pressure"])[1] == pytest.approx(13153284.1, abs=0.06)
    assert times(result, "yield valve open") == []
    assert result["leg0.yielded"][-1] == 0.0


OTHERS = {
    "heavy mass, small valve": Struck(mass=5e4, valve=replace(VALVE, opening_pressure=5e6, rated_flow=1e-2)),
    "hysteresis": Struck(valve=replace(VALVE, closing_pressure=6e6)),
    "slow poppet": Struck(valve=replace(VALVE, poppet=Poppet(mass=2.0, stiffness=1e6, damping=500.0))),
}


@pytest.mark.parametrize("name", OTHERS)
def test_others_are_as_scipy_finds_them(name: str) -> None:
    case = OTHERS[name]
    result, found = simulate(scene(case)), by_scipy(case)
    begin = int(np.searchsorted(result.time, found.time[0] - 0.5 * COARSE))
    np.testing.assert_allclose(result.time[begin:], found.time, rtol=0.0, atol=1e-12)
    for channel, key in {"pressure": "p", "yielded": "out"}.items():
        ours, theirs = result[f"leg0.{channel}"][begin:], found[f"leg0.{key}"]
        assert np.abs(ours - theirs).max() < 1e-7 * np.ptp(theirs), channel
    assert found["leg0.out"][-1] > 1e-6
    if case.valve.poppet is None:
        theirs = found.switched("leg0.open y")
        np.testing.assert_allclose(times(result, "yield valve open"), theirs, rtol=0.0, atol=2e-9)
