"""The entry: scenario in, result out."""

from __future__ import annotations

import time
from typing import Literal, overload

from support_exudyn.channels import channels
from support_exudyn.errors import Failure, SimulationError
from support_exudyn.provenance import provenance
from support_exudyn.recorder import Recorder
from support_exudyn.result import Result
from support_exudyn.scenario import Scenario
from support_exudyn.scene import build
from support_exudyn.settle import settle
from support_exudyn.solver import Progress, Run


def _no_progress(share: float) -> None:
    del share


@overload
def simulate(scenario: Scenario, *, progress: Progress = ..., throw: Literal[True] = ...) -> Result: ...
@overload
def simulate(scenario: Scenario, *, progress: Progress = ..., throw: bool) -> Result | Failure: ...


def simulate(scenario: Scenario, *, progress: Progress = _no_progress, throw: bool = True) -> Result | Failure:
    """Run a scenario.

    Arguments:
        scenario: machine, pins, drive, start and accuracy.
        progress: called now and then with the share that is done, 0 to 1.
        throw: what to do if the run cannot be finished: raise SimulationError, or return its Failure
            (for sweeps, where one failed run is a row and not the end).

    Returns:
        Result with all channels, onsets, counts, energy and provenance.
    """
    began = time.perf_counter()
    try:
        scene = build(scenario)
        if scenario.start == "settled":
            settle(scene)
        recorder = Recorder(scene)
        run = Run(scene, recorder, progress)
        counts = run.go()
    except SimulationError as error:
        if throw:
            raise
        return error.failure
    return Result(
        scenario=scenario,
        channels=channels(scene, recorder.history()),
        onsets={name: tuple(pin.onsets) for name, pin in scene.loose_pins.items()},
        largest_force={name: pin.largest_force for name, pin in scene.loose_pins.items()},
        impulses=tuple(run.impulses),
        counts=counts,
        wall_time=time.perf_counter() - began,
        provenance=provenance(),
    )
