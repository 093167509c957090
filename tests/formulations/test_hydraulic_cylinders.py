"""Hydraulic cylinders against closed forms and against another integrator."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from support_exudyn import ClosedInlet, Held, Inlet, Linkage, RampedOpening, Scenario, SuddenOpening, simulate
from tests.cases.cylinder_cases import GRAVITY, MASS, Ram, lift, opened
from user_forces import value


def test_the_speed_under_an_open_valve_and_the_pressure_after_it() -> None:
    damping, opening = 1e5, 0.6
    cylinder = opened(SuddenOpening(start=0.0, end=1.5, extent=opening), damping=damping)
    result = lift(cylinder, duration=4.0)
    wide = opening * 6e-3 / math.sqrt(1e6)

    def excess(v: float) -> float:
        piston = 31.5e6 - (v * 0.098 / wide) ** 2
        rod = 0.5e6 + (v * 0.03 / wide) ** 2
        return piston * 0.098 - rod * 0.03 - damping * v - MASS * GRAVITY

    speed = brentq(excess, 0.01, 1.0)
    rising = (result.time > 1.2) & (result.time < 1.5)
    # what rings has died out to 1e-4 of the speed
    np.testing.assert_allclose(result["ram.velocity_y"][rising], speed, rtol=1e-3)
    assert result["jack.flow"][rising].mean() == pytest.approx(speed * 0.098, rel=1e-3)
    # at rest again: the oil carries the weight, and the rod side is as much less than the tank's as the
    # actuator has moved on after the valve had closed
    assert result["jack.force"][-1] == pytest.approx(MASS * GRAVITY, rel=1e-3)
    closing = int(np.searchsorted(result.time, 1.5))
    pressures = [result[f"jack.{name}"][[closing, -1]] for name in ("pressure", "rod_pressure")]
    ends = result["jack.length"][[closing, -1]] - 1.6
    for pressure, volumes in zip(pressures, np.array([cylinder.volumes(e) for e in ends]).T, strict=True):
        expected = pressure[0] + 1.5e9 * math.log(volumes[0] / volumes[1])
        assert pressure[1] == pytest.approx(expected, abs=2e3)  # [Pa], of 2e6: second order in the step


@pytest.mark.parametrize(
    ("inlet", "times"),
    [
        pytest.param(SuddenOpening(start=0.02, end=0.15, extent=0.8), (0.02, 0.15), marks=pytest.mark.slow),
        (RampedOpening(start=0.02, end=0.2, ramp=0.05), (0.02, 0.07, 0.15, 0.2)),
        (SuddenOpening(start=0.0, end=0.15, extent=-0.3), (0.15,)),
    ],
)
def test_pressures_and_motion_are_those_of_another_integrator_to_second_order(
    inlet: Inlet, times: tuple[float, ...]
) -> None:
    cylinder = opened(inlet, damping=5e4)
    duration, records = 0.3, np.arange(1, 31) * 0.01

    def rates(t: float, y: np.ndarray) -> list[float]:
        e, v, piston, rod = y
        o = inlet.opening(t)
        above, below = (31.5e6, 0.5e6) if o >= 0.0 else (0.5e6, 31.5e6)

        def flow(drop: float) -> float:
            return abs(o) * 6e-6 * math.copysign(math.sqrt(abs(drop)), drop)

        return [
            v,
            (piston * 0.098 - rod * 0.03 - 5e4 * v) / MASS - GRAVITY,
            1.5e9 / (0.098 * (0.5 + e) + 5e-3) * (flow(above - piston) - 0.098 * v),
            1.5e9 / (0.03 * (1.0 - e) + 3e-3) * (flow(below - rod) + 0.03 * v),
        ]

    state = np.array([0.0, 0.0, (MASS * GRAVITY + 0.5e6 * 0.03) / 0.098, 0.5e6])
    found: list[np.ndarray] = []
    for begin, end in zip((0.0, *times), (*times, duration), strict=True):
        if end == begin:
            continue
        # a tenth of a nanosecond beside the jumps, where the opening is that of the piece
        asked = records[(records > begin + 1e-9) & (records <= end + 1e-9)]
        piece = solve_ivp(
            rates, (begin + 1e-10, end), state, method="Radau", rtol=1e-10, atol=[1e-12, 1e-11, 1e-2, 1e-2],
            t_eval=np.append(asked, end) if asked.size == 0 or asked[-1] < end - 1e-9 else asked,
        )  # fmt: skip
        assert piece.success
        found += list(piece.y.T[: asked.size])
        state = piece.y[:, -1]
    wanted = np.array(found)
    names = ("jack.length", "ram.velocity_y", "jack.pressure", "jack.rod_pressure")

    def error(step: float) -> np.ndarray:
        run = lift(cylinder, duration, step=step, record=0.01)
        values = np.column_stack([run[name][1:] for name in names]) - [1.6, 0.0, 0.0, 0.0]
        return np.asarray(np.abs(values - wanted).max(axis=0) / np.ptp(wanted, axis=0))

    coarse, fine = error(2e-4), error(1e-4)
    # of what each quantity passes through; the rod side starts at the root's steepest point
    assert (fine < [4e-5, 4e-4, 3e-4, 3e-4]).all()
    # 4 for second order, as norm of all: single ones have zeros of their error
    assert 3.0 < np.linalg.norm(coarse) / np.linalg.norm(fine) < 5.5


@value
class ThrownRam(Ram):
    """The ram, already on its way up at the start."""

    speed: float

    def linkage(self) -> Linkage:
        still = super().linkage()
        ram = replace(still.bodies["ram"], velocity=(0.0, self.speed))
        return replace(still, bodies={"ram": ram})


def test_closed_oil_of_an_actuator_that_moves_at_the_start_follows_its_length() -> None:
    cylinder = opened(ClosedInlet())
    before = np.array(cylinder.volumes(0.0))
    pressures = np.array([(MASS * GRAVITY + 0.5e6 * 0.03) / 0.098, 0.5e6])

    def error(step: float) -> float:
        run = simulate(
            Scenario(
                machine=ThrownRam(speed=0.05), actuators={"jack": cylinder}, drive=Held(), duration=0.02,
                step=step, record_period=1e-3,
            )
        )  # fmt: skip
        now = np.array([cylinder.volumes(float(e)) for e in run["jack.length"] - 1.6])
        wanted = pressures + 1.5e9 * np.log(before / now)
        found = np.column_stack([run["jack.pressure"], run["jack.rod_pressure"]])
        return float(np.abs(found - wanted).max())

    coarse, fine = error(2e-4), error(1e-4)
    # 4 for second order; a first step that knew no rate of the pressures would leave 7 kPa, and 2
    assert 3.0 < coarse / fine < 5.5


@value
class Swelling(Inlet):
    """A valve that opens along a sine and has no break at all."""

    frequency: float

    def opening(self, t: float) -> float:
        return 0.5 * math.sin(2.0 * math.pi * self.frequency * t)

    @property
    def breaks(self) -> tuple[float, ...]:
        return ()

    @property
    def shortest_time(self) -> float:
        return 1.0 / self.frequency


def test_a_valve_without_breaks_is_followed() -> None:
    result = lift(opened(Swelling(frequency=1.0), damping=1e5), duration=0.5)
    moved = result["jack.length"] - result["jack.length"][0]
    # no oil is lost: what has flowed in stands under the piston, but for its compression of 1e-3
    flowed = np.trapezoid(result["jack.flow"], result.time)
    assert moved[-1] == pytest.approx(flowed / 0.098, rel=0.01)
    assert moved[-1] > 0.05
