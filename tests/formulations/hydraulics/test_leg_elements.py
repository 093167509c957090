"""Elements of hydraulic legs against closed forms."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from support_exudyn import (
    EndStops,
    Result,
    Scenario,
    SolverSettings,
    SuddenOpening,
    TrappedAir,
    UniformSpeed,
    simulate,
)
from tests.formulations.hydraulics.leg_cases import (
    AIR,
    COLUMN,
    CYLINDER,
    LENGTH,
    LINE,
    MASS,
    PUMP,
    SEALS,
    VAPOUR,
    YIELDING,
    Uprights,
)

FIXED = 1e15  # [kg]: what does not move in a second
WEIGHT = MASS * 9.81
ATMOSPHERE = 101325.0
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


def test_a_line_relaxes_into_the_column() -> None:
    # two chambers and a resistance: 1/(R C1) + 1/(R C2), C = V/B; the drive has stopped after a millisecond
    drive = UniformSpeed(start=0.0, end=1e-3, stroke=1e-4)
    result = standing(replace(COLUMN, line=LINE), drive=drive, duration=0.004, record_period=1e-4)
    b, rest = COLUMN.bulk_modulus, AREA * (COLUMN.oil_length + 1e-4)
    rate = b / LINE.resistance * (1.0 / LINE.volume + 1.0 / rest)
    late = result.time >= 1e-3 - 1e-9
    drop = (result["leg0.line_pressure"] - result["leg0.pressure"])[late]
    t = result.time[late] - 1e-3
    np.testing.assert_allclose(drop[:10] / drop[0], np.exp(-rate * t[:10]), rtol=1e-7)
    assert rate * t[-1] > 3.0


def air_of(pressure: float, air: TrappedAir) -> float:
    return air.volume * (ATMOSPHERE / (pressure + ATMOSPHERE)) ** (1.0 / air.exponent)


@pytest.mark.parametrize("exponent", [1.0, 1.4])
def test_air_is_an_isothermal_or_adiabatic_spring(exponent: float) -> None:
    # stiff oil; k = A^2 n (p + pa)/V_air; a ten-thousandth of the air's length is linear to 1e-7
    air = replace(AIR, exponent=exponent)
    still = WEIGHT / AREA
    stiffness = AREA**2 * exponent * (still + ATMOSPHERE) / air_of(still, air)
    oil = 1e14 * AREA / COLUMN.oil_length
    wanted = math.sqrt(stiffness * oil / (stiffness + oil) / MASS)
    leg = replace(COLUMN, bulk_modulus=1e14, trapped_air=air)
    turns = 2.0 * math.pi / wanted
    result = simulate(on(leg, speed=1e-6, duration=3.0 * turns, record_period=turns / 100))
    swing = result["leg0.length"] - LENGTH
    np.testing.assert_allclose(swing, 1e-6 / wanted * np.sin(wanted * result.time), atol=3e-4 * 1e-6 / wanted)


def test_a_blow_on_air_turns_where_the_energy_is_used_up() -> None:
    # stiff oil, n = 1.4; m v^2/2 + m g x = work on the air between both volumes
    leg = replace(COLUMN, bulk_modulus=1e15, trapped_air=AIR)
    still, speed = WEIGHT / AREA, 0.2
    start = air_of(still, AIR)

    def pressure(volume: float) -> float:
        return (AIR.volume / volume) ** AIR.exponent * ATMOSPHERE - ATMOSPHERE

    def left(volume: float) -> float:
        work = quad(pressure, volume, start, epsabs=1e-9, epsrel=1e-12)[0]
        return 0.5 * MASS * speed**2 + WEIGHT * (start - volume) / AREA - work

    smallest = brentq(left, 1e-3 * start, 0.99 * start)
    result = simulate(on(leg, speed=-speed, duration=0.02, record_period=1e-5))
    assert result["leg0.pressure"].max() == pytest.approx(pressure(smallest), rel=2e-5)


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


def test_a_leg_on_seals_creeps_at_the_speed_of_their_stiction() -> None:
    # pushed by more than the load, but by less than F_s: F(v) = excess; oil as soft as air
    much = replace(AIR, volume=10.0, exponent=1.0)
    soft = replace(COLUMN, trapped_air=much, oil_length=60.0)
    leg = replace(soft, setting_pressure=(WEIGHT + 0.4 * SEALS.static) / AREA, seal_friction=SEALS)
    result = simulate(on(leg, duration=0.3))
    excess = result["leg0.pressure"][-1] * AREA - WEIGHT

    def left(v: float) -> float:
        bump = (SEALS.static - SEALS.coulomb) * math.exp(-((v / SEALS.stribeck_speed) ** 2))
        return (SEALS.coulomb + bump) * math.tanh(v / SEALS.transition_speed) - excess

    speed = brentq(left, 0.0, SEALS.transition_speed)
    assert result["mass0.velocity_y"][-1] == pytest.approx(speed, rel=1e-3)


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
