"""What follows when Newton's method does not converge in a step: which length it is given, and which Jacobian.

The engine then shortens the step. With friction that is steep against the step nearly every longer one would
fail again, so that the next ones have the length that could be solved, and grow from there.
"""

from __future__ import annotations

import math

# so many steps of a length before one twice as long is tried
STEPS_TO_GROW = 8
# A step that has been shortened so often is tried with a new Jacobian in every iteration. (From the first
# failure on, longer steps would converge across the whole ramp of friction, and energy would not add up.)
FAILURES_OF_A_STEP = 3
MOST_MORE = 300  # failures than steps without any, by which a run is given up
# so many steps of less than such a share of the longest, as longer ones fail, are a run without end
CRAWL, MOST_CRAWLED = 1e-4, 10_000


class NewtonFailures:
    """How long steps may be for Newton's method.

    Arguments:
        longest: length of step [s] from which on nothing is limited.
    """

    def __init__(self, longest: float) -> None:
        self.longest = longest
        self.length = math.inf  # that has been found to converge where a longer one did not [s]
        self.of_step = 0  # failures in the step that is being tried
        self.more = 0  # failures than steps without any, from 0 on
        self.crawled = 0  # steps of next to no length
        self._solved = 0  # steps of that length in a row

    @property
    def wants_new_jacobians(self) -> bool:
        """Whether the step that is being tried is to have a new Jacobian in every iteration."""
        return self.of_step >= FAILURES_OF_A_STEP

    @property
    def too_many(self) -> bool:
        """Whether steps fail so often that the run is to be given up."""
        return self.more > MOST_MORE or self.crawled > MOST_CRAWLED

    def failed(self) -> None:
        """The step that is being tried has not converged."""
        self.of_step += 1
        self.more += 1

    def solved(self, taken: float, jumps: bool) -> None:
        """A step of this length [s] has been solved; jumps: a force has jumped just now.

        Steps are tiny then already, and shorter ones meet rounding: nothing is learned from them.
        """
        if self.of_step:
            self.of_step = 0
            if not jumps:
                self.length, self._solved = taken, 0
            return
        self.more = max(0, self.more - 1)
        if self.length < math.inf:
            self.crawled += self.length < CRAWL * self.longest
            self._solved += 1
            if self._solved >= STEPS_TO_GROW:
                self.length, self._solved = 2.0 * self.length, 0
            if self.length > self.longest:
                self.length = math.inf
