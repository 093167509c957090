"""Hydraulic legs whose elements contradict each other are refused, wherever in a scenario a leg stands."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from support_exudyn import (
    CubicStep,
    CylinderAndRod,
    Held,
    OilColumn,
    PumpStation,
    Scenario,
    YieldValve,
    reference_support,
    simulate,
)
from support_exudyn.model.actuators import ActuatorModel
from tests.cases.machine_cases import support
from tests.formulations.hydraulics.leg_cases import COLUMN, CYLINDER, STAGE, Uprights
from user_forces import InputError

MASS = 2e4  # [kg] on a leg


def two_bodies(drive: OilColumn) -> CylinderAndRod:
    return CylinderAndRod(
        cylinder_mass=100.0,
        cylinder_centre=0.4,
        cylinder_inertia=10.0,
        rod_mass=80.0,
        rod_centre=0.4,
        rod_inertia=9.0,
        drive=drive,
    )


def standing(leg: ActuatorModel, **changes: Any) -> Scenario:
    return Scenario(machine=Uprights(masses=(MASS,)), actuators={"leg0": leg}, duration=0.02, **changes)


def relief(opening: float, closing: float | None = None) -> YieldValve:
    return YieldValve(
        opening_pressure=opening, rated_flow=0.004, rated_overpressure=1e6, closing_pressure=closing
    )


@pytest.mark.parametrize(
    ("leg", "where"),
    [(lambda one: one, "actuators.leg0"), (two_bodies, "actuators.leg0.drive")],
    ids=["column", "drive of two bodies"],
)
def test_columns_are_looked_at_wherever_they_stand(leg: Any, where: str) -> None:
    with pytest.raises(InputError, match=rf"{where}\.vapour_pressure = -200000.0 Pa: allowed: > -101325"):
        standing(leg(replace(COLUMN, vapour_pressure=-2e5)))
    with pytest.raises(InputError, match=rf"{where}\.end_stops = None: allowed with a second stage"):
        standing(leg(replace(COLUMN, second_stage=STAGE)))
    standing(leg(replace(COLUMN, vapour_pressure=-99e3)))


@pytest.mark.parametrize(
    ("valve", "name", "down_to"),
    [
        ({"yield_valve": relief(3e6)}, "yield_valve", 3e6),
        ({"rod_relief": relief(9e6, 1e6)}, "rod_relief", 1e6),
    ],
)
def test_no_valve_lets_oil_in_from_the_tank(valve: dict[str, YieldValve], name: str, down_to: float) -> None:
    with pytest.raises(InputError, match=rf"tank_pressure = 5000000.0 Pa: .*{name}.* {down_to} Pa; allowed"):
        standing(replace(CYLINDER, tank_pressure=5e6, **valve))
    standing(replace(CYLINDER, tank_pressure=down_to, **valve))


def test_a_pump_has_more_pressure_than_its_range_and_the_tank() -> None:
    with pytest.raises(InputError, match=r"pressure_range = 5000000.0 Pa: allowed: < pressure = 1000000.0 Pa"):
        PumpStation(flow=7.5e-3, pressure=1e6, pressure_range=5e6)
    pump = PumpStation(flow=7.5e-3, pressure=2e6)
    with pytest.raises(InputError, match=r"pump\.pressure = 2000000.0 Pa: allowed: > actuators\.leg0\.tank"):
        standing(replace(CYLINDER, tank_pressure=5e6), pump=pump)
    standing(replace(CYLINDER, tank_pressure=1e6), pump=pump)


def test_what_would_boil_at_the_start_is_named_with_its_own_pressure() -> None:
    # 20 t on 0.098 m^2: 2.002 MPa under the piston; a column has no rod side
    with pytest.raises(
        InputError, match=r"pushes with 1\.96\de\+05 N, .* piston side would have 2\.002e\+06 Pa"
    ):
        simulate(standing(replace(COLUMN, vapour_pressure=3e6)))
    simulate(standing(replace(COLUMN, vapour_pressure=5e5)))
    with pytest.raises(InputError, match=r"its rod side would have 5e\+05 Pa"):
        simulate(standing(replace(CYLINDER, vapour_pressure=6e5)))


def on_support(**changes: Any) -> Scenario:
    both = {"front_column": CYLINDER, "rear_column": CYLINDER}
    return Scenario(**({"machine": support(), "duration": 1.0, "drive": Held(), "actuators": both} | changes))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"actuators": {"middle": COLUMN}}, r"actuators\.middle.*allowed: front_column, rear_column"),
        (
            {
                "actuators": {"front_column": replace(COLUMN, oil_length=0.05)},
                "drive": CubicStep(stroke=-0.1, start=0.1, end=0.6),
            },
            r"oil_length = 0\.05 m.*no oil is left",
        ),
        (
            {"drives": {"front_column": CubicStep()}},
            r"front_column: is a HydraulicCylinder.*front_column\.inlet",
        ),
        ({"drive": CubicStep()}, r"drive = CubicStep: nothing follows it.*allowed: Held\(\)"),
        (
            {"actuators": {"front_column": replace(CYLINDER, oil_length=5.0)}},
            r"oil_length = 5\.0 m: the actuator is .* long",
        ),
        (
            {"actuators": {"front_column": replace(CYLINDER, system_pressure=1e3)}},
            r"system_pressure = 1000\.0 Pa: allowed: > tank_pressure",
        ),
    ],
)
def test_legs_that_do_not_fit_their_machine_are_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        on_support(**changes)


def test_cylinders_follow_no_drive_and_other_actuators_do() -> None:
    assert on_support().driven == ()
    assert not on_support().jumps
    assert on_support(machine=reference_support(), dimensions=3).driven == ()
    mixed = on_support(actuators={"front_column": CYLINDER}, drive=CubicStep())
    assert mixed.driven == ("rear_column",)
    assert mixed.compliant_actuators == ("front_column",)
