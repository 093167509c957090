"""What both ways of running start from and fill: arrays of one run."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from support_exudyn.formulations.reduced import layout
from support_exudyn.formulations.reduced.coverage import model_of
from support_exudyn.formulations.reduced.drive import Matrix, Vector
from support_exudyn.formulations.reduced.integrate import REPORT
from support_exudyn.formulations.reduced.models import Model
from support_exudyn.formulations.reduced.parameters import error_weights, parameters, segments
from support_exudyn.formulations.time_grid import record_times
from support_exudyn.model.pins import ClearancePin
from support_exudyn.scenario.scenario import Scenario

MOST_TOUCHES = 100_000


@dataclass(frozen=True)
class Outline:
    """A run before it begins; y, memory, rows, onsets, jumps and report are filled by it, see `layout`.

    p: parameters. segments: of the drive. times: of the records [s]. weights: one over the largest error of a
    step, for each component of the state.
    """

    model: Model
    pin: ClearancePin | None
    p: Vector
    segments: Matrix
    times: Vector
    weights: Vector
    y: Vector
    memory: Vector
    rows: Matrix
    onsets: Matrix
    jumps: Matrix
    report: Vector


def outline(scenario: Scenario) -> Outline:
    """The arrays of a scenario's run."""
    model = model_of(scenario)
    machine = scenario.machine
    pin = scenario.clearance_pins.get(model.PIN)
    y = np.zeros(layout.STATES)
    y[layout.FIRST], y[layout.SECOND] = np.add(
        model.start(machine), model.shifted(machine.linkage(), scenario.linkage)
    )
    memory = np.zeros(layout.ALL_MEMORY)
    if pin is not None and pin.contact.bearing.depth(math.hypot(*pin.eccentricity)) > 0.0:
        memory[layout.TOUCHING] = (
            1.0  # pressed in from the start on; the journal does not move in its bore then
        )
    times = record_times(scenario.duration, scenario.record_period)
    drive = segments(scenario.drive, scenario.duration)
    return Outline(
        model=model,
        pin=pin,
        p=parameters(scenario, model.parameters(machine), pin),
        segments=drive,
        times=times,
        weights=_weights(scenario, model, pin) if pin else np.zeros(layout.STATES),
        y=y,
        memory=memory,
        rows=np.zeros((layout.ROWS, times.size)),
        onsets=np.empty((MOST_TOUCHES if pin else 0, 4)),
        jumps=np.zeros((len(drive), layout.JUMP_ROW)),
        report=np.zeros(REPORT),
    )


def _weights(scenario: Scenario, model: Model, pin: ClearancePin) -> Vector:
    machine = scenario.machine
    mass = sum(body.mass for body in machine.linkage().bodies.values())
    fall = float(np.hypot(*scenario.gravity)) + model.fall(machine, scenario.drive.initial_speed)
    clearance = pin.contact.bearing.clearance
    return error_weights(model.reaches(machine), mass, fall, clearance, scenario.solver.tolerance)
