"""What the engine's Newton method is asked for in a run: how close it is to come, and with which Jacobian."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from support_exudyn.formulations.redundant.clearance.clearance_pin import LoosePin
from support_exudyn.formulations.redundant.solver.newton_failures import NewtonFailures
from support_exudyn.scenario.scenario import Scenario

ROUNDINGS = 10.0  # of a coordinate, by which steep friction scatters: what the method is asked for then


class NewtonMethod:
    """The method in a run.

    Arguments:
        solver: the engine's, of which only what is asked for in the next step is changed.
        settings: of the method, in the engine's words.
        scenario: what is run.
        pins: those with clearance.
        unknowns: their number.
    """

    def __init__(
        self, solver: Any, settings: Any, scenario: Scenario, pins: Sequence[LoosePin], unknowns: int
    ) -> None:
        self._solver = solver
        self._settings = settings
        self._pins = pins
        self._unknowns = unknowns
        self._size = max(math.hypot(*body.centre) for body in scenario.linkage.bodies.values())  # [m]
        self._scatters = False  # whether steep friction does, see `LoosePin.rounding`
        self.failures = NewtonFailures(scenario.step)

    def begin(self, step: float) -> None:
        """A step of this length [s] is tried: steep friction comes no closer than rounding lets it."""
        rounding = sum(pin.rounding(step, self._size) for pin in self._pins)
        if rounding > 0.0 or self._scatters:
            self._scatters = rounding > 0.0
            asked = max(self._settings.absoluteTolerance, ROUNDINGS * rounding / self._unknowns)
            self._solver.newton.absoluteTolerance = asked

    def failed(self) -> None:
        """It has not converged: lines stand for friction from now on, or else steps become shorter."""
        straightened = [pin.straighten() for pin in self._pins]
        if not any(straightened):
            self.failures.failed()
        if self.failures.wants_new_jacobians:
            self._solver.newton.useModifiedNewton = False

    def solved(self, taken: float) -> None:
        """A step of this length [s] has been solved."""
        if self.failures.wants_new_jacobians:
            self._solver.newton.useModifiedNewton = self._settings.useModifiedNewton
        self.failures.solved(taken, any(pin.impact.begins_with_a_jump for pin in self._pins))
