"""A column of oil behind a line: no jump, relaxation and damping against closed forms and the linear system."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
import pytest
from scipy.linalg import expm

from support_exudyn import (
    Body,
    Drive,
    Held,
    Line,
    LinearActuator,
    Linkage,
    Machine,
    OilColumn,
    Result,
    Scenario,
    Slide,
    SolverSettings,
    simulate,
)
from support_exudyn.model.linkage import GROUND
from user_forces import InputError, value

TIGHT = {"compiled": SolverSettings(tolerance=1e-10), "exudyn": SolverSettings()}
FORMULATIONS = tuple(TIGHT)
AREA, LENGTH, MODULUS = 0.1, 0.5, 1.5e9
LINE = Line(volume=0.02, nominal_flow=200e-3 / 60.0, nominal_drop=1e6)
OIL = OilColumn(bore_area=AREA, oil_length=LENGTH, bulk_modulus=MODULUS, line=LINE)
CHAMBER = AREA * LENGTH


@value
class Carried(Machine):
    """A body on an upright guide over one actuator, which may move at the start."""

    mass: float
    speed: float = 0.0

    def linkage(self) -> Linkage:
        body = Body(mass=self.mass, inertia=1.0, centre=(0.0, 1.0), velocity=(0.0, self.speed))
        return Linkage(
            bodies={"body": body},
            actuators={
                "jack": LinearActuator(foot=GROUND, head="body", foot_point=(0.0, 0.0), head_point=(0.0, 1.0))
            },
            slides={"guide": Slide(body="body", point=(0.0, 1.0), direction=0.5 * math.pi)},
        )


def carried(formulation: str, machine: Machine, oil: OilColumn, drive: Drive, duration: float) -> Result:
    """A run without weight."""
    return simulate(
        Scenario(
            machine=machine,
            actuators={"jack": oil},
            drive=drive,
            duration=duration,
            gravity=(0.0, 0.0),
            formulation=formulation,
            step=2e-5,
            record_period=1e-4,
            solver=TIGHT[formulation],
        )
    )


def linear_system(mass: float) -> npt.NDArray[np.float64]:
    """Rates of place, speed, and oil that has come out of the line into the column."""
    inflow = MODULUS / LINE.resistance * (1.0 / CHAMBER + 1.0 / LINE.volume)
    force = MODULUS * AREA / CHAMBER
    return np.array(
        [
            [0.0, 1.0, 0.0],
            [-force * AREA / mass, 0.0, force / mass],
            [MODULUS * AREA / (LINE.resistance * CHAMBER), 0.0, -inflow],
        ]
    )


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("mass", [300.0, 3000.0])  # w times the time of the line: 11 and 3.6
def test_a_line_damps_as_the_linear_system_says(formulation: str, mass: float) -> None:
    speed, duration = 1e-3, 0.1
    result = carried(formulation, Carried(mass=mass, speed=speed), OIL, Held(), duration)
    system = linear_system(mass)
    expected = np.array([expm(system * t)[0, 1] * speed for t in result.time])
    # second order in the steps of the engine, of phase at 1000 rad/s: measured 2e-3
    np.testing.assert_allclose(
        result["body.y"] - 1.0, expected, atol=(1e-6 if formulation == "compiled" else 5e-3) * expected.max()
    )
    rates = np.linalg.eigvals(system)
    swing = rates[np.argmax(rates.imag)]
    ratio = -swing.real / abs(swing)
    assert ratio > 0.005
    # logarithmic decrement of the speed, over the maxima after the first swings
    v = result["body.velocity_y"]
    tops = np.flatnonzero((v[1:-1] > v[:-2]) & (v[1:-1] > v[2:])) + 1
    heights = np.array([_top(v[n - 1 : n + 2]) for n in tops])
    found = np.log(heights[0] / heights[-1]) / (heights.size - 1)
    assert found / math.hypot(found, 2.0 * math.pi) == pytest.approx(ratio, rel=0.02)  # by parabolas
    assert result.energy_error < 1e-3 * 0.5 * mass * speed**2


def _top(three: npt.NDArray[np.float64]) -> float:
    """Height of the parabola through three values."""
    a, b, c = three.tolist()
    return float(b - (a - c) ** 2 / (8.0 * (a - 2.0 * b + c)))


def test_who_asks_for_the_damping_time_is_told_of_the_line() -> None:
    with pytest.raises(InputError, match=r"OilColumn\.damping_time = 0\.001.*allowed: a line"):
        OilColumn(bore_area=AREA, oil_length=LENGTH, bulk_modulus=MODULUS, damping_time=1e-3)
