"""Oil columns and hydraulic cylinders in machines, settled and in space: closed forms and balances."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from studies.common import paper_machine
from support_exudyn import (
    CheckValve,
    Drive,
    GroundReaction,
    OilColumn,
    PumpStation,
    RampedOpening,
    Result,
    Scenario,
    SimulationError,
    SuddenOpening,
    UniformSpeed,
    YieldValve,
    bore_area,
    reference_support,
    simulate,
)
from support_exudyn.scenario.solver_settings import SolverSettings
from tests.cases.cylinder_cases import lift, on_cylinders, opened
from tests.cases.run_cases import FORCE
from tests.formulations.hydraulics.leg_cases import Uprights
from tests.roof_cases import DAMPED, ON_OIL, OVER_THE_COLUMNS

MASS, GRAVITY = 3000.0, 9.81


def pushed(oil: OilColumn, drive: Drive, step: float = 1e-4, duration: float = 0.3) -> Result:
    return simulate(
        Scenario(
            machine=Uprights(masses=(MASS,)),
            actuators={"leg0": oil},
            drive=drive,
            duration=duration,
            step=step,
            record_period=1e-3,
        )
    )


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


def test_a_sudden_start_follows_the_closed_form_of_an_oscillator() -> None:
    # so long a cushion that its stiffness stays 1e8 N/m while 2.5 mm are let in
    oil = OilColumn(bore_area=1.0, oil_length=2000.0, bulk_modulus=2e11)
    w = math.sqrt(1e8 / MASS)
    speed = 0.01
    result = pushed(oil, UniformSpeed(stroke=speed, start=0.05, end=1.05), step=5e-5)
    t = result.time - 0.05
    # u'' + w^2 u = 0, u(0) = 0, u'(0) = speed
    expected = MASS * GRAVITY + np.where(t > 1e-9, 1e8 * speed / w * np.sin(w * t), 0.0)
    # second order: 180 rad/s and 5e-5 s leave 4e-4, most of it as phase after 0.25 s
    largest = np.abs(expected - MASS * GRAVITY).max()
    np.testing.assert_allclose(result["leg0.force"], expected, atol=1e-3 * largest)
    assert result.impulses == ()


def test_a_piston_at_the_end_of_its_cylinder_stops_the_run() -> None:
    cylinder = opened(SuddenOpening(start=0.0, end=0.4), rod_side_length=0.05)
    with pytest.raises(SimulationError, match=r"leg0 is extended by 0\.05.*allowed: -0\.5 to 0\.05 m"):
        lift(cylinder, duration=0.5)


@pytest.mark.parametrize(
    ("bore", "length", "published"), [(0.4, 3.0, 16.8), (0.5, 3.0, 26.2), (0.5, 3.55, 22.2), (0.6, 4.5, 25.1)]
)
def test_the_published_stiffness_of_four_shields_follows_from_one_bulk_modulus(
    bore: float, length: float, published: float
) -> None:
    legs = OilColumn(bore_area=bore_area(bore, number=2), oil_length=length, bulk_modulus=1.96e9)
    assert legs.stiffness(0.0) / (1e3 * 9.81 / 1e-3) == pytest.approx(published, rel=5e-3)  # t/mm


# --- settled under a load ---


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


# --- in space, where each is one of a pair ---


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
