"""What the engine's Newton method is asked for in a run: how close it is to come, and with which Jacobian.

Where it does not converge the engine shortens the step. With friction that is steep against the step nearly
every longer one would fail again, so that the next ones have the length that could be solved, and grow.
"""

import math
from collections.abc import Sequence
from typing import Any

from support_exudyn.scenario.scenario import Scenario
from user_forces.connector.contact_connector import ContactConnector

ROUNDINGS = 10.0  # of a coordinate, by which steep friction scatters: what the method is asked for then
# so many steps of a length before one twice as long is tried
STEPS_TO_GROW = 8
# A step that has been shortened so often is tried with a new Jacobian in every iteration. (From the first
# failure on, longer steps would converge across the whole ramp of friction, and energy would not add up.)
FAILURES_OF_A_STEP = 3
MOST_MORE = 300  # failures than steps without any, by which a run is given up
# so many steps of less than such a share of the longest, as longer ones fail, are a run without end
CRAWL, MOST_CRAWLED = 1e-4, 10_000


class NewtonMethod:
    """The method in a run, and how long steps may be for it.

    Arguments:
        solver: the engine's, of which only what is asked for in the next step is changed.
        settings: of the method, in the engine's words.
        scenario: what is run.
        pins: those with clearance.
        unknowns: their number.
    """

    def __init__(
        self, solver: Any, settings: Any, scenario: Scenario, pins: Sequence[ContactConnector], unknowns: int
    ) -> None:
        self._solver = solver
        self._settings = settings
        self._pins = pins
        self._unknowns = unknowns
        self._size = max(math.hypot(*body.centre) for body in scenario.linkage.bodies.values())  # [m]
        self._straightened = False  # whether a line has ever stood for friction
        self._scatters = False  # whether steep friction does, see `ContactConnector.rounding`
        self._longest = scenario.step  # length of step [s] from which on nothing is limited
        self.length = math.inf  # that has been found to converge where a longer one did not [s]
        self.failures = 0  # in the step that is being tried
        self.more = 0  # failures than steps without any, from 0 on
        self._crawled = 0  # steps of next to no length
        self._solved = 0  # steps of that length in a row

    @property
    def too_many(self) -> bool:
        """Whether steps fail so often that the run is to be given up."""
        return self.more > MOST_MORE or self._crawled > MOST_CRAWLED

    def begin(self, step: float) -> None:
        """Begin to try a step of this length [s]: steep friction comes no closer than rounding lets it."""
        if not (self._straightened or self._scatters):
            return
        rounding = sum(pin.rounding(step, self._size) for pin in self._pins)
        if rounding > 0.0 or self._scatters:
            self._scatters = rounding > 0.0
            asked = max(self._settings.absoluteTolerance, ROUNDINGS * rounding / self._unknowns)
            self._solver.newton.absoluteTolerance = asked

    def failed(self) -> None:
        """Take note of a failure: lines stand for friction from now on, or else steps become shorter."""
        straightened = [pin.straighten() for pin in self._pins]  # all of them
        if any(straightened):
            self._straightened = True
        else:
            self.failures += 1
            self.more += 1
        if self.failures >= FAILURES_OF_A_STEP:
            self._solver.newton.useModifiedNewton = False

    def solved(self, taken: float) -> None:
        """Take note of a solved step of this length [s].

        Where a force has jumped just now, steps are tiny already, and shorter ones meet rounding: nothing is
        learned from them.
        """
        if self.failures:
            if self.failures >= FAILURES_OF_A_STEP:
                self._solver.newton.useModifiedNewton = self._settings.useModifiedNewton
            if not any(pin.impact_steps.begins_with_a_jump for pin in self._pins):
                self.length, self._solved = taken, 0
            self.failures = 0
            return
        if self.more:
            self.more -= 1
        if self.length < math.inf:
            self._crawled += self.length < CRAWL * self._longest
            self._solved += 1
            if self._solved >= STEPS_TO_GROW:
                self.length, self._solved = 2.0 * self.length, 0
            if self.length > self._longest:
                self.length = math.inf
