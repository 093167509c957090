"""Ideal pins as users of Exudyn run them: equal steps, and a solver that is not told of the drive's jumps."""

from __future__ import annotations

from typing import Any

import numpy as np

from studies.benchmarking.peers.bare_scene import ideal_frame
from studies.benchmarking.peers.stock import fixed_steps, solve
from support_exudyn.scenario.scenario import Scenario


def peak_acceleration(scenario: Scenario, step: float, body: str) -> float:
    """Largest angular acceleration of a body that the engine gives at the end of any step [rad/s^2].

    It is the engine's own, of its integrator, not one that follows from the motion.

    Arguments:
        scenario: without loose pins, of rigid columns; its own step and solver are not used.
        step: length of all steps [s].
        body: its name.

    Raises InputError if the scenario is not covered, RuntimeError if the solver gives up.
    """
    frame = ideal_frame(scenario)
    frame.mbs.Assemble()
    turn = frame.first(body) + 2
    found: list[float] = []

    def before_step(mbs: Any, t: float) -> bool:
        found.append(float(mbs.systemData.GetODE2Coordinates_tt()[turn]))
        frame.drive_to(t)
        return True

    frame.mbs.SetPreStepUserFunction(before_step)
    solve(frame, fixed_steps(scenario.duration, step))
    found.append(float(frame.mbs.systemData.GetODE2Coordinates_tt()[turn]))
    return float(np.abs(found).max())
