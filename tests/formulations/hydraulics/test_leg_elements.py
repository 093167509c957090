"""Elements of hydraulic legs against closed forms."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from support_exudyn import (
    EndStops,
    Result,
    Scenario,
    SolverSettings,
    SuddenOpening,
    simulate,
)
from tests.formulations.hydraulics.leg_cases import (
    COLUMN,
    CYLINDER,
    LENGTH,
    MASS,
    PUMP,
    VAPOUR,
    YIELDING,
    Uprights,
)

FIXED = 1e15  # [kg]: what does not move in a second
WEIGHT = MASS * 9.81
AREA = COLUMN.bore_area


def on(leg: Any, mass: float = MASS, speed: float = 0.0, **changes: Any) -> Scenario:
    settings: dict[str, Any] = {
        "machine": Uprights(masses=(mass,), speed=speed),
        "actuators": {"leg0": leg},
        "duration": 0.1,
        "record_period": 1e-3,
        "formulation": "compiled",
        "solver": SolverSettings(tolerance=1e-10),
    }
    return Scenario(**settings | changes)


def standing(leg: Any, **changes: Any) -> Result:
    """A leg whose ends stay where they are."""
    return simulate(on(leg, mass=FIXED, gravity=(0.0, 0.0), **changes))


def test_filling_through_an_orifice() -> None:
    # dp/dt = B Q/V, Q = Qn sqrt((ps - p)/dpn): the root falls at a constant rate
    leg = replace(CYLINDER, inlet=SuddenOpening(start=0.0, end=1.0), nominal_drop=1e3, vapour_pressure=VAPOUR)
    leg = replace(leg, nominal_flow=1e-4)
    result = standing(leg, duration=0.1)
    volume = leg.bore_area * leg.oil_length + leg.hose_volume
    falls = leg.bulk_modulus * leg.nominal_flow / math.sqrt(leg.nominal_drop) / (2.0 * volume)
    root = math.sqrt(leg.system_pressure - leg.tank_pressure) - falls * result.time
    assert 0.0 < root[-1] < 0.5 * root[0]
    np.testing.assert_allclose(result["leg0.pressure"], leg.system_pressure - root**2, rtol=1e-8)


def test_a_cavity_opens_flies_and_closes() -> None:
    # a spring until p_v is reached; then a throw under weight and suction
    speed = 0.4
    stiffness = COLUMN.bulk_modulus * AREA / COLUMN.oil_length
    rate = math.sqrt(stiffness / MASS)
    way = (WEIGHT / AREA - VAPOUR) * AREA / stiffness
    opens = math.asin(way * rate / speed) / rate
    upward = speed * math.cos(rate * opens)
    pull = 9.81 - VAPOUR * AREA / MASS
    closes = opens + 2.0 * upward / pull
    scene = on(replace(COLUMN, vapour_pressure=VAPOUR), speed=speed, record_period=2e-5)
    result = simulate(scene)
    happened = result.oil_events["leg0"]
    assert [(event.what, event.begins) for event in happened[:2]] == [
        ("piston side filled", False),
        ("piston side filled", True),
    ]
    np.testing.assert_allclose([event.time for event in happened[:2]], [opens, closes], rtol=0.0, atol=1e-9)
    assert result["leg0.cavity"].max() == pytest.approx(AREA * upward**2 / (2.0 * pull), rel=1e-5)
    assert result["leg0.pressure"].min() == VAPOUR


def test_above_its_pressure_a_leg_yields_at_the_speed_of_its_valve() -> None:
    # p = m g/A, v = slope (p - p_open)/A; what rings dies by the valve, k slope/A^2 m a second
    valve = replace(YIELDING, opening_pressure=1.2e6)
    result = simulate(on(replace(COLUMN, yield_valve=valve), duration=2.0, record_period=0.01))
    speed = valve.slope * (WEIGHT / AREA - 1.2e6) / AREA
    np.testing.assert_allclose(result["mass0.velocity_y"][-20:], -speed, rtol=1e-6)
    fallen = LENGTH - result["leg0.length"]
    assert result["leg0.yielded"][-1] == pytest.approx(AREA * fallen[-1], rel=1e-9)


def test_a_leg_rises_as_fast_as_the_pump_gives() -> None:
    flow = 1e-3
    pump = replace(PUMP, flow=flow)
    leg = replace(CYLINDER, inlet=SuddenOpening(start=0.0, end=10.0), damping=3e6)
    result = simulate(on(leg, pump=pump, duration=1.0, record_period=0.01))
    late = slice(-20, None)
    assert (result["pump.pressure"][late] < pump.pressure - pump.pressure_range).all()
    np.testing.assert_allclose(result["pump.flow"][late], flow, rtol=1e-12)
    # what is pumped fills the cylinder, and is compressed there by p/B
    squeezed = np.exp(result["leg0.pressure"][late] / CYLINDER.bulk_modulus)
    speed = flow / squeezed / leg.bore_area
    np.testing.assert_allclose(result["mass0.velocity_y"][late], speed, rtol=1e-4)


def test_a_stop_gives_back_what_its_law_does() -> None:
    # no weight, no oil to speak of: k depth (1 + b rate) on a mass; the speed after it by quadrature,
    # v dv/dx = -w^2 x (1 + b v)
    stops = EndStops(lowest=-1.0, highest=0.001, stiffness=1e9, damping=0.3)
    leg = replace(COLUMN, bulk_modulus=1.0, end_stops=stops)
    speed = 1.0
    scene = on(leg, speed=speed, gravity=(0.0, 0.0), duration=0.02, record_period=1e-4)
    result = simulate(scene)
    b = stops.damping

    def energy(v: float) -> float:
        """-int v/(1 + b v) dv."""
        return (math.log1p(b * v) / b - v) / b

    # the same depth is reached and left: energy(v) - energy(0) is alike on both ways
    back = brentq(lambda v: energy(-v) - energy(speed), 0.0, speed)
    assert -result["mass0.velocity_y"][-1] == pytest.approx(back, rel=1e-6)
