"""Do runs stay right for long? Joints and energy over a thousand seconds, of the crank over a hundred.

The reference support raised and lowered by 100 mm every 4 s, with ideal pins, with 1.5 mm in the rear-link pin,
with friction there, and on oil columns; held at rest; and a slider-crank with clearance that turns, which
takes far more steps.
"""

import time
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from studies.common import paper_machine
from studies.slider_crank import run as slider_crank
from support_exudyn import (
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

STEP = 2e-3  # [s]
GROWTH, AT_REST = 8.0, 64.0  # of steps in flight, and where nothing moves
IDEAL, SMOOTH, DRY, OIL, REST, CRANK = "ideal pins", "1.5 mm", "friction", "oil columns", "at rest", "crank"
DURATIONS = dict.fromkeys((IDEAL, SMOOTH, DRY, OIL, REST), 1000.0) | {CRANK: 100.0}  # [s]
TENTH = 0.1  # of a run: the first is compared with the last


class LongRun(NamedTuple):
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


def scene(name: str, duration: float) -> Scenario:
    """The scene of this name, of so many seconds.

    On oil columns without hoses, whose flow takes fourteen times as long to compute, and at shorter steps, for
    nothing damps the oil's vibration. The slider-crank turns slowly, with its weight: it rattles for seconds
    and stays closed from then on.
    """
    settings: dict[str, Any] = {
        "duration": duration,
        "formulation": "exudyn",
        "step": STEP,
        "record_period": 0.05,
        "solver": SolverSettings(impact_steps=64, growth=AT_REST if name == REST else GROWTH, most_steps=10**9),
    }
    if name == CRANK:
        field_case = slider_crank.scenarios()[slider_crank.DRY]
        return replace(field_case, drive=Steady(rate=10.0), gravity=(0.0, -9.81), **settings)
    if name == OIL:
        columns = {name: replace(column, line=None) for name, column in paper_machine.oil_columns().items()}
        settings |= {"actuators": columns, "step": 0.7 * STEP}
    friction = paper_machine.SLIDING_COEFFICIENT if name == DRY else 0.0
    pin = paper_machine.clearance_joint(paper_machine.CLEARANCE_MM, friction)
    return Scenario(
        machine=reference_support(),
        pins={} if name == IDEAL else {paper_machine.CLEARANCE_PIN: pin},
        drive=Held() if name == REST else Reciprocating(stroke=0.1, period=4.0),
        **settings,
    )


def run(scenario: Scenario, progress: Progress = silent) -> LongRun:
    """Run a scenario and measure it.

    Raises SimulationError if it fails or does not pass the result checks, as `simulate` does.
    """
    chosen = formulation(scenario.formulation)
    chosen.check(scenario)
    began = time.perf_counter()
    with paused_collector():
        outcome = chosen.run(scenario, progress)
    wall = time.perf_counter() - began
    recorded = channels(scenario, outcome.trajectory)
    if (failure := result_checks(scenario, outcome, recorded)) is not None:
        raise SimulationError(failure)
    gaps = joints_apart(scenario, outcome)
    assert gaps is not None  # the motion is recorded
    energy, times = energy_open(scenario, recorded)[0] / turned_over(recorded), outcome.trajectory.time
    first, last = times <= TENTH * scenario.duration, times >= (1.0 - TENTH) * scenario.duration
    return LongRun(
        simulated=scenario.duration,
        wall=wall,
        steps=outcome.counts.steps,
        impacts=sum(map(len, outcome.onsets.values())),
        gap_first=float(gaps[first].max()),
        gap_last=float(gaps[last].max()),
        gap_slope=float(np.polyfit(times - times.mean(), gaps, 1)[0]),
        energy_first=float(energy[first][-1]),
        energy_share=float(energy[-1]),
    )
