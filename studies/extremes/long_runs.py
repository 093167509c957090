"""Do runs stay right for long? Joints and energy over a thousand seconds, of the crank over a hundred.

The reference support raised and lowered by 100 mm every 4 s, with ideal pins, with 1.5 mm in the rear-link pin,
with friction there, and on oil columns; held at rest; and a slider-crank with clearance that turns, which
takes far more steps.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from studies.common import paper_machine
from studies.slider_crank import run as slider_crank
from support_exudyn import (
    Drive,
    Held,
    Reciprocating,
    Scenario,
    SimulationError,
    SolverSettings,
    Steady,
    reference_support,
)
from support_exudyn.formulations.registry import formulation
from support_exudyn.scenario.recorded_channels import channels
from support_exudyn.scene.contract import Progress, silent
from support_exudyn.simulation.result_checks import energy_open, joints_apart, result_checks, turned_over
from support_exudyn.simulation.single_run import paused_collector

Series = npt.NDArray[np.float64]
STROKE, PERIOD = 0.1, 4.0  # [m], [s]
CLEARANCE_MM = 1.5
CRANK_SPEED = 10.0  # [rad/s]
RECORD_PERIOD = 0.05  # [s]
STEP = 2e-3  # [s]
GROWTH = 8.0
AT_REST = 64.0  # the same where nothing moves
IMPACT_STEPS = 64
MOST_STEPS = 10**9
IDEAL, SMOOTH, DRY, OIL, REST = "ideal pins", "1.5 mm", "friction", "oil columns", "at rest"
CRANK = "crank"
PARTS = 10  # of a run: the first is compared with the last


@dataclass(frozen=True)
class LongRun:
    """What a long run came to.

    simulated, wall: times [s]. steps, impacts: numbers. gap_first, gap_last: largest distance of
    what is joined, in the first and the last tenth of the run [m]. gap_slope: of the line through all [m/s].
    energy_first, energy_share: by how much the energy balance is open after the first tenth and at the end, of
    what was turned over.
    """

    simulated: float
    wall: float
    steps: int
    impacts: int
    gap_first: float
    gap_last: float
    gap_slope: float
    energy_first: float
    energy_share: float


# --- scenes ---


def _support(duration: float, sliding_coefficient: float | None = None, drive: Drive | None = None) -> Scenario:
    loose = {}
    if sliding_coefficient is not None:
        loose[paper_machine.CLEARANCE_PIN] = paper_machine.clearance_joint(CLEARANCE_MM, sliding_coefficient)
    return Scenario(
        machine=reference_support(),
        pins=loose,
        drive=drive or Reciprocating(stroke=STROKE, period=PERIOD),
        duration=duration,
        formulation="exudyn",
        step=STEP,
        record_period=RECORD_PERIOD,
        solver=SolverSettings(
            impact_steps=IMPACT_STEPS,
            growth=GROWTH if drive is None else AT_REST,
            most_steps=MOST_STEPS,
        ),
    )


def _on_oil(duration: float) -> Scenario:
    # without hoses, whose flow takes fourteen times as long to compute
    columns = {name: replace(column, line=None) for name, column in paper_machine.oil_columns().items()}
    return replace(_support(duration, 0.0), actuators=columns, step=0.7 * STEP)  # nothing damps their vibration


def _crank(duration: float) -> Scenario:
    """The slider-crank of the field with a clearance slider pin with friction, turning slowly, with its weight.

    It rattles for seconds and stays closed from then on.
    """
    return replace(
        slider_crank.scenarios()[slider_crank.DRY],
        drive=Steady(rate=CRANK_SPEED),
        duration=duration,
        formulation="exudyn",
        step=STEP,
        record_period=RECORD_PERIOD,
        gravity=(0.0, -9.81),
        solver=SolverSettings(impact_steps=IMPACT_STEPS, growth=GROWTH, most_steps=MOST_STEPS),
    )


SCENES: dict[str, Callable[[float], Scenario]] = {
    IDEAL: _support,
    SMOOTH: lambda duration: _support(duration, 0.0),
    DRY: lambda duration: _support(duration, paper_machine.SLIDING_COEFFICIENT),
    OIL: _on_oil,
    REST: lambda duration: _support(duration, 0.0, Held()),
    CRANK: _crank,
}

DURATIONS = {name: 100.0 if name == CRANK else 1000.0 for name in SCENES}  # [s]


# --- running and measuring ---


def run(scenario: Scenario, progress: Progress = silent) -> LongRun:
    """Run a scenario and measure it.

    Raises SimulationError if it fails or does not stand up to the result checks, as `simulate` does.
    """
    chosen = formulation(scenario.formulation)
    chosen.check(scenario)
    began = time.perf_counter()
    with paused_collector():
        outcome = chosen.run(scenario, progress)
    wall = time.perf_counter() - began
    found = channels(scenario, outcome.trajectory)
    if (failure := result_checks(scenario, outcome, found)) is not None:
        raise SimulationError(failure)
    gaps = joints_apart(scenario, outcome)
    assert gaps is not None  # the motion is recorded
    open_by, _ = energy_open(scenario, found)
    times, tenth = outcome.trajectory.time, scenario.duration / PARTS
    first, last = times <= tenth, times >= scenario.duration - tenth
    return LongRun(
        simulated=scenario.duration,
        wall=wall,
        steps=outcome.counts.steps,
        impacts=sum(map(len, outcome.onsets.values())),
        gap_first=float(gaps[first].max()),
        gap_last=float(gaps[last].max()),
        gap_slope=slope(times, gaps),
        energy_first=float(open_by[first][-1]) / turned_over(found),
        energy_share=float(open_by[-1]) / turned_over(found),
    )


def slope(times: Series, values: Series) -> float:
    """The slope of the straight line that fits values best, per second."""
    apart = times - times.mean()
    return float(apart @ values / (apart @ apart))
