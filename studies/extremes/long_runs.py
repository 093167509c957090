"""Do runs stay right for long? Joints, energy and memory over a thousand seconds, of the crank over a hundred.

The reference support raised and lowered by 100 mm every 4 s, with ideal pins, with 1.5 mm in the rear-link pin,
with friction there, and on oil columns; held at rest; and a slider-crank with clearance that turns, which
takes far more steps. A run is measured in the process that calls; for memory that should be a fresh one.
"""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

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
from user_forces.contact_state import PinMemory

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
NUMBER = 8  # [bytes]
IMPACT = 168  # an Onset of four numbers in a list of CPython [bytes]
STATUS = Path("/proc/self/status")


@dataclass(frozen=True)
class LongRun:
    """What a long run came to.

    simulated, wall: times [s]. steps, impacts: numbers. gap_first, gap_last: largest distance of
    what is joined, in the first and the last tenth of the run [m]. gap_slope: of the line through all [m/s].
    energy_first, energy_open: by how much the balance is open after the first tenth and at the end [J].
    turned_over: kinetic, potential and elastic energy, losses and work that changed hands [J].
    memory_slope: of resident memory from a tenth of the run to its end, less what records and impacts take, by
    simulated time [bytes/s]; nan where the system does not tell.
    """

    simulated: float
    wall: float
    steps: int
    impacts: int
    gap_first: float
    gap_last: float
    gap_slope: float
    energy_first: float
    energy_open: float
    turned_over: float
    memory_slope: float

    @property
    def energy_share(self) -> float:
        """By how much the energy balance is open at the end, of what was turned over."""
        return self.energy_open / self.turned_over


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
    memory = [math.nan, math.nan]  # after a tenth, at the end [bytes]

    def watch(share: float) -> None:
        if share >= 1.0 / PARTS and math.isnan(memory[0]):
            memory[0] = resident()
        if share >= 1.0:
            memory[1] = resident()
        progress(share)

    chosen = formulation(scenario.formulation)
    chosen.check(scenario)
    began = time.perf_counter()
    with paused_collector():
        outcome = chosen.run(scenario, watch)
    wall = time.perf_counter() - began
    found = channels(scenario, outcome.trajectory)
    if (failure := result_checks(scenario, outcome, found)) is not None:
        raise SimulationError(failure)
    gaps = joints_apart(scenario, outcome)
    assert gaps is not None  # the motion is recorded
    open_by, _ = energy_open(scenario, found)
    times, tenth = outcome.trajectory.time, scenario.duration / PARTS
    first, last = times <= tenth, times >= scenario.duration - tenth
    begun = [onset.time for pin in outcome.onsets.values() for onset in pin]
    later = sum(t > tenth for t in begun)
    kept = (times.size - first.sum()) * record_bytes(scenario) + later * IMPACT
    return LongRun(
        simulated=scenario.duration,
        wall=wall,
        steps=outcome.counts.steps,
        impacts=len(begun),
        gap_first=float(gaps[first].max()),
        gap_last=float(gaps[last].max()),
        gap_slope=slope(times, gaps),
        energy_first=float(open_by[first][-1]),
        energy_open=float(open_by[-1]),
        turned_over=turned_over(found),
        memory_slope=float(memory[1] - memory[0] - kept) / (scenario.duration - tenth),
    )


def slope(times: Series, values: Series) -> float:
    """The slope of the straight line that fits values best, per second."""
    apart = times - times.mean()
    return float(apart @ values / (apart @ apart))


def record_bytes(scenario: Scenario) -> int:
    """What a record of a scenario in the plane takes while it runs [bytes]."""
    # time and three integrals; position and velocity; what clearance pins remember
    of_pins = len(PinMemory._fields) * len(scenario.clearance_pins)
    return NUMBER * (4 + 6 * len(scenario.linkage.bodies) + of_pins)


def resident() -> float:
    """Memory of this process that is in use now [bytes]; nan where the system does not tell."""
    try:
        lines = STATUS.read_text().splitlines()
    except OSError:
        return math.nan
    sizes = [line.split()[1] for line in lines if line.startswith("VmRSS:")]
    return 1024.0 * float(sizes[0]) if sizes else math.nan
