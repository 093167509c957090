"""What is met just at the start, or by a hair in the midst of a step: valves, stops, cavities."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import (
    EndStops,
    HydraulicCylinder,
    OilColumn,
    Result,
    Scenario,
    SolverSettings,
    YieldValve,
    simulate,
)
from support_exudyn.model.actuators import ActuatorModel
from tests.formulations.hydraulics.leg_cases import Uprights

FORMULATIONS = ("compiled", "exudyn")
COLUMN = OilColumn(bore_area=0.1, oil_length=0.73, bulk_modulus=1.4e9, vapour_pressure=-99e3)
CYLINDER = HydraulicCylinder(
    bore_area=0.1,
    rod_side_area=0.03,
    oil_length=0.73,
    rod_side_length=0.5,
    bulk_modulus=1.4e9,
    system_pressure=28e6,
    nominal_flow=5e-3,
)


def run(leg: ActuatorModel, formulation: str, speed: float, **changes: object) -> Result:
    """Twenty tonnes on a leg that move up at a speed [m/s]."""
    fields: dict[str, object] = {
        "machine": Uprights(masses=(2e4,), speed=speed),
        "actuators": {"leg0": leg},
        "duration": 0.02,
        "record_period": 1e-4,
        "step": 2e-5,
        "formulation": formulation,
        "solver": SolverSettings(tolerance=1e-11 if formulation == "compiled" else 1e-6),
    }
    return simulate(Scenario(**fields | changes))


def told(result: Result) -> list[tuple[str, bool]]:
    return [(event.what, event.begins) for event in result.oil_events["leg0"]]


def jumping(pressure: float) -> YieldValve:
    return YieldValve(
        opening_pressure=pressure, closing_pressure=0.6 * pressure, rated_flow=0.004, rated_overpressure=1e6
    )


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("leg", [COLUMN, CYLINDER], ids=["column", "cylinder"])
@pytest.mark.parametrize("pressure", [7.3e6, 1.234567e7])
def test_a_leg_set_to_the_pressure_of_its_valve_opens_it_at_once(
    pressure: float, leg: OilColumn | HydraulicCylinder, formulation: str
) -> None:
    set_to = replace(leg, setting_pressure=pressure)
    below, exact = (
        run(replace(set_to, yield_valve=jumping(opens)), formulation, -0.3)
        for opens in (pressure * (1.0 - 1e-9), pressure)
    )
    for name in ("leg0.pressure", "leg0.yielded", "leg0.yield_flow"):
        size = np.abs(below[name]).max()
        np.testing.assert_allclose(exact[name][1:], below[name][1:], atol=1e-5 * size, err_msg=name)
    first = exact.oil_events["leg0"][0]
    assert (first.what, first.begins) == ("yield valve open", True)
    assert first.time == pytest.approx(0.0, abs=1e-12)
    # what is told to flow is what has flowed: trapezoids over records of 0.1 ms, ahead of the closing
    time, flow = exact.time[1:], exact["leg0.yield_flow"][1:]
    open_ = time < 0.009
    flowed = np.trapezoid(flow[open_], time[open_])
    yielded = exact["leg0.yielded"][1:][open_]
    assert flowed > 1e-5
    assert flowed == pytest.approx(yielded[-1] - yielded[0], rel=1e-2)


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_a_leg_set_to_the_pressure_of_its_valve_and_let_up_keeps_it_closed(formulation: str) -> None:
    leg = replace(COLUMN, setting_pressure=8e6, yield_valve=jumping(8e6))
    result = run(leg, formulation, 0.3)
    assert [what for what, _ in told(result) if "valve" in what] == []
    assert result["leg0.yielded"].max() == 0.0
    assert result["leg0.yield_flow"].max() == 0.0


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_a_leg_that_starts_on_its_stop_meets_it_again_and_again(formulation: str) -> None:
    on_it, beside = (
        run(replace(COLUMN, end_stops=EndStops(lowest=low, highest=0.5)), formulation, -0.3, duration=0.08)
        for low in (0.0, -1e-9)
    )
    stops = [[event for event in one.oil_events["leg0"] if "stop" in event.what] for one in (on_it, beside)]
    assert len(stops[0]) == len(stops[1]) >= 3
    for one, other in zip(*stops, strict=True):
        assert (one.what, one.begins) == (other.what, other.begins)
        assert one.time == pytest.approx(other.time, abs=1e-7)


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_a_cavity_that_grows_from_the_start_is_told(formulation: str) -> None:
    leg = replace(COLUMN, vapour_pressure=0.0)
    result = run(leg, formulation, 0.3, gravity=(0.0, 0.0))
    assert told(result) == [("piston side filled", False)]
    assert result["leg0.cavity"][-1] == pytest.approx(0.1 * 0.3 * 0.02, rel=1e-6)


@pytest.mark.parametrize("accuracy", ["draft", "standard", 1e-7])
@pytest.mark.parametrize("below", [1e-4, 1e-5, 3e-6])
def test_a_valve_that_is_just_reached_opens_at_any_accuracy(below: float, accuracy: str | float) -> None:
    # without the valve: a mass on a spring, with the weight that it carries and the speed that it has
    speed, mass = -1.0, 1.2e4
    machine = Uprights(masses=(mass,), speed=speed)
    rate = math.sqrt(COLUMN.stiffness(0.0) / mass)
    peak = (mass * 9.81 + abs(speed) * rate * mass) / COLUMN.bore_area
    opens = peak * (1.0 - below)
    valve = YieldValve(
        opening_pressure=opens, closing_pressure=0.5 * peak, rated_flow=0.01, rated_overpressure=2e6
    )
    result = simulate(
        Scenario(
            machine=machine,
            actuators={"leg0": replace(COLUMN, yield_valve=valve)},
            duration=0.03,
            record_period=1e-4,
            accuracy=accuracy,
        )
    )
    assert told(result)[0] == ("yield valve open", True)
    assert result["leg0.yielded"][-1] == pytest.approx(1.57e-4, rel=0.02)
