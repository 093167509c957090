"""The entry of the reduced formulation: scenario in, result out."""

from __future__ import annotations

import time
from typing import NamedTuple

import numpy as np

from support_exudyn.errors import Failure, SimulationError
from support_exudyn.impulse import Impulse
from support_exudyn.linkages.hydraulic_support import Posture
from support_exudyn.onset import Onset
from support_exudyn.reduced import layout
from support_exudyn.reduced.channels import channels
from support_exudyn.reduced.coverage import PIN, check
from support_exudyn.reduced.ideal import run_ideal
from support_exudyn.reduced.integrate import (
    DEAD_CENTRE,
    EVALUATIONS,
    FINISHED,
    JUMPS,
    LARGEST,
    LAST_STEP,
    NOT_A_NUMBER,
    REPORT,
    STEPS,
    STOPPED_AT,
    STUCK,
    TOO_MANY_STEPS,
    TOO_MANY_TOUCHES,
    TOUCHES,
    integrate,
)
from support_exudyn.reduced.parameters import error_weights, parameters, record_times, segments
from support_exudyn.reduced.posture import Vector
from support_exudyn.reduced.result import ReducedResult
from support_exudyn.reduced.runge_kutta import Matrix
from support_exudyn.scenario import Scenario
from user_forces.values import InputError

MOST_STEPS = 5_000_000
MOST_TOUCHES = 100_000
FIRST_STEP = 1e-5  # [s]
CLOSES = "Look whether the posture is near a dead centre, or the pin is pressed far out of its place."


class _Run(NamedTuple):
    """Arrays of a run, filled by the compiled functions, see `layout` and `integrate`."""

    y: Vector
    memory: Vector
    rows: Matrix
    onsets: Matrix
    jumps: Matrix
    report: Vector


def simulate_reduced(scenario: Scenario, tolerance: float = 1e-7) -> ReducedResult:
    """Run a scenario of a hydraulic support with its two free coordinates alone.

    Arguments:
        scenario: machine HydraulicSupport, drive Held, CubicStep or UniformSpeed, start "concentric", all
            pins ideal but "rear_base", which may be loose. `step` and `solver` are not used.
        tolerance: largest error of a step, as a share of the clearance, > 0 and <= 1e-2. Ideal pins need
            none: their posture is exact.

    Raises InputError if the scenario is not covered, SimulationError if it cannot be finished.
    """
    began = time.perf_counter()
    machine = check(scenario)
    if not 0.0 < tolerance <= 1e-2:
        raise InputError(f"tolerance = {tolerance}: allowed: > 0 and <= 0.01")
    start = machine.start()
    pin = scenario.clearance_pins.get(PIN)
    numbers = parameters(scenario, machine, start, pin)
    drive = segments(scenario.drive, scenario.duration)
    times = record_times(scenario.duration, scenario.record_period)
    run = _begin(start, times.size, len(drive), MOST_TOUCHES if pin else 0)
    if pin is None:
        code = run_ideal(numbers, drive, times, run.y, run.rows, run.jumps, run.report)
    else:
        weights = error_weights(scenario, start, pin.contact.bearing.clearance, tolerance)
        code = integrate(numbers, drive, times, weights, FIRST_STEP, MOST_STEPS, *run)
    if code == FINISHED and not np.isfinite(run.rows.sum()):
        code, run.report[NOT_A_NUMBER] = STUCK, 1.0
    if code != FINISHED:
        raise SimulationError(_failure(code, run))
    touches = run.onsets[: int(run.report[TOUCHES])].tolist()
    return ReducedResult(
        scenario=scenario,
        channels=channels(machine, start, run.rows, pin is not None),
        onsets={PIN: tuple(Onset(*touch) for touch in touches)} if pin else {},
        largest_force={PIN: float(run.report[LARGEST])} if pin else {},
        impulses=tuple(_impulse(row) for row in run.jumps[: int(run.report[JUMPS])].tolist()),
        steps=int(run.report[STEPS]),
        evaluations=int(run.report[EVALUATIONS]),
        wall_time=time.perf_counter() - began,
    )


def _begin(start: Posture, records: int, parts: int, touches: int) -> _Run:
    y = np.zeros(layout.STATES)
    y[layout.CANOPY], y[layout.LINK] = start.canopy, start.rear_link
    return _Run(
        y=y,
        memory=np.zeros(layout.MEMORY),
        rows=np.zeros((layout.ROWS, records)),
        onsets=np.empty((touches, 2)),
        jumps=np.zeros((parts, layout.JUMP_ROW)),
        report=np.zeros(REPORT),
    )


def _impulse(row: list[float]) -> Impulse:
    columns = {"front_column": row[layout.FRONT_IMPULSE], "rear_column": row[layout.REAR_IMPULSE]}
    return Impulse(row[layout.JUMP_TIME], columns, row[layout.JUMP_ENERGY])


def _failure(code: int, run: _Run) -> Failure:
    """Why a run stopped."""
    report = run.report
    state = {
        "step": float(report[LAST_STEP]),
        "canopy.turn": float(run.y[layout.CANOPY]),
        "canopy.angular_velocity": float(run.y[layout.CANOPY_RATE]),
        "rear_link.turn": float(run.y[layout.LINK]),
        "rear_link.angular_velocity": float(run.y[layout.LINK_RATE]),
        "touches": float(report[TOUCHES]),
    }
    if code == TOO_MANY_STEPS:
        reason, advice = f"more than {MOST_STEPS} steps", "Allow a larger tolerance, or a shorter duration."
    elif code == TOO_MANY_TOUCHES:
        reason, advice = f"more than {MOST_TOUCHES} touches", "Look at the contact law: nothing comes to rest."
    elif code == DEAD_CENTRE:
        reason, advice = "the linkage is at a dead centre", CLOSES
    elif report[NOT_A_NUMBER] or not run.onsets.size:
        reason, advice = "the linkage cannot close, or a value is no longer a finite number", CLOSES
    else:
        reason, advice = "the step became too short", "Allow a larger tolerance."
    return Failure(reason, advice, float(report[STOPPED_AT]), state)
