"""Hydraulic legs whose elements contradict each other are refused, wherever in a scenario a leg stands."""

from __future__ import annotations

from collections.abc import Callable
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


def on_support(**changes: Any) -> Scenario:
    both = {"front_column": CYLINDER, "rear_column": CYLINDER}
    return Scenario(**({"machine": support(), "duration": 1.0, "drive": Held(), "actuators": both} | changes))


def front(leg: ActuatorModel) -> Scenario:
    return on_support(actuators={"front_column": leg})


PUMP = PumpStation(flow=7.5e-3, pressure=2e6)
STROKE = CubicStep(stroke=-0.1, start=0.1, end=0.6)
NO_OIL = {"front_column": replace(COLUMN, oil_length=0.05)}


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: standing(replace(COLUMN, vapour_pressure=-2e5)),
         r"actuators.leg0\.vapour_pressure = -200000.0 Pa: allowed: > -101325"),
        (lambda: standing(two_bodies(replace(COLUMN, vapour_pressure=-2e5))),
         r"actuators.leg0.drive\.vapour_pressure = -200000.0 Pa: allowed: > -101325"),
        (lambda: standing(replace(COLUMN, second_stage=STAGE)),
         r"actuators.leg0\.end_stops = None: allowed with a second stage"),
        (lambda: standing(replace(CYLINDER, tank_pressure=5e6, yield_valve=relief(3e6))),
         r"tank_pressure = 5000000.0 Pa: .*yield_valve.* 3000000.0 Pa; allowed"),
        (lambda: standing(replace(CYLINDER, tank_pressure=5e6, rod_relief=relief(9e6, 1e6))),
         r"tank_pressure = 5000000.0 Pa: .*rod_relief.* 1000000.0 Pa; allowed"),
        (lambda: replace(PUMP, pressure=1e6, pressure_range=5e6),
         r"pressure_range = 5000000.0 Pa: allowed: < pressure = 1000000.0 Pa"),
        (lambda: standing(replace(CYLINDER, tank_pressure=5e6), pump=PUMP),
         r"pump\.pressure = 2000000.0 Pa: allowed: > actuators\.leg0\.tank"),
        (lambda: on_support(actuators={"middle": COLUMN}),
         r"actuators\.middle.*allowed: front_column, rear_column"),
        (lambda: on_support(actuators=NO_OIL, drive=STROKE), r"oil_length = 0\.05 m.*no oil is left"),
        (lambda: on_support(drives={"front_column": CubicStep()}),
         r"front_column: is a HydraulicCylinder.*front_column\.inlet"),
        (lambda: on_support(drive=CubicStep()), r"drive = CubicStep: nothing follows it.*allowed: Held\(\)"),
        (lambda: front(replace(CYLINDER, oil_length=5.0)), r"oil_length = 5\.0 m: the actuator is .* long"),
        (lambda: front(replace(CYLINDER, system_pressure=1e3)),
         r"system_pressure = 1000\.0 Pa: allowed: > tank_pressure"),
    ],
)  # fmt: skip
def test_legs_that_do_not_fit_each_other_or_the_machine_are_refused(
    make: Callable[[], object], message: str
) -> None:
    with pytest.raises(InputError, match=message):
        make()


def test_legs_at_their_limits_are_taken() -> None:
    standing(replace(COLUMN, vapour_pressure=-99e3))
    standing(replace(CYLINDER, tank_pressure=1e6, rod_relief=relief(9e6, 1e6)), pump=PUMP)


def test_what_would_boil_at_the_start_is_named_with_its_own_pressure() -> None:
    # 20 t on 0.098 m^2: 2.002 MPa under the piston; a column has no rod side
    with pytest.raises(
        InputError, match=r"pushes with 1\.96\de\+05 N, .* piston side would have 2\.002e\+06 Pa"
    ):
        simulate(standing(replace(COLUMN, vapour_pressure=3e6)))
    simulate(standing(replace(COLUMN, vapour_pressure=5e5)))
    with pytest.raises(InputError, match=r"its rod side would have 5e\+05 Pa"):
        simulate(standing(replace(CYLINDER, vapour_pressure=6e5)))


def test_cylinders_follow_no_drive_and_other_actuators_do() -> None:
    assert on_support().driven == ()
    assert not on_support().jumps
    assert on_support(machine=reference_support(), dimensions=3).driven == ()
    mixed = on_support(actuators={"front_column": CYLINDER}, drive=CubicStep())
    assert mixed.driven == ("rear_column",)
    assert mixed.compliant_actuators == ("front_column",)
