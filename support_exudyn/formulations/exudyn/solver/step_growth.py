"""How far steps may grow while a motion is smooth.

What a longer step loses is seen from how much accelerations change over it. Two cases matter. A vibration
that a step cannot follow is damped out and lost with all of its force, which is about the masses times what
accelerations change by. In a smooth motion the local error is the step squared times that change, far less.
Steps grow twofold while the change is small, and halve at once when it is not.
"""

import math

from support_exudyn.formulations.exudyn.scene.engine_scene import EngineScene
from support_exudyn.mechanics.trajectory import Series

# Largest change of accelerations over a step, as a share of what the bodies have, or of gravity if that is
# more. Vibrations of that share of the load are lost. With three times as much the support's pin with friction
# begins to shake too late in the rise: its link's acceleration then spreads 2 % less.
SMOOTH = 5e-4
# Steps grow after so many in a row with a change below this share of the largest: a change of the step size
# disturbs the constraint forces of index 3 for a few steps, and growing in vain would disturb them again.
CALM_STEPS = 4
CALM = 0.25


class StepGrowth:
    """Length of the steps while nothing is in an impact.

    Arguments:
        step: the shortest and the first [s].
        longest: [s].
        mass: of all coordinates, shape (n,) [kg], [kg m^2].
        weight: gravity by the measure `norm` [kg^0.5 m/s^2].
    """

    def __init__(self, step: float, longest: float, mass: Series, weight: float) -> None:
        self._step = step
        self._longest = max(step, longest)
        self._mass = mass
        self._weight = weight
        self._last: Series | None = None
        self._calm = 0  # steps in a row
        self.size = step

    def restart(self) -> None:
        """The motion is not smooth now."""
        self.size = self._step
        self._calm = 0
        self._last = None

    def follow(self, taken: float, acceleration: Series) -> None:
        """Take note of an accepted step of this length [s], with these accelerations (n,) at its end."""
        last, self._last = self._last, acceleration
        if last is None:
            return
        change = self.norm(acceleration - last)
        allowed = SMOOTH * max(self._weight, self.norm(acceleration))
        self._calm = self._calm + 1 if change < CALM * allowed else 0
        if change > allowed:
            self.size = max(self._step, 0.5 * taken)
        elif self._calm >= CALM_STEPS:
            self.size = min(max(self._step, 2.0 * taken), self._longest)
            self._calm = 0

    def norm(self, acceleration: Series) -> float:
        """Root of the sum of mass times acceleration squared: one measure for metres and radians."""
        return math.sqrt(float(self._mass @ (acceleration * acceleration)))


def step_growth(scene: EngineScene) -> StepGrowth:
    """How the steps of a scene grow."""
    scenario = scene.scenario
    step = min(scenario.step, scenario.recorded_every)
    longest = scenario.solver.growth * scenario.step
    mass = sum(item.body.mass for item in scene.bodies.values())
    return StepGrowth(step, longest, scene.coordinate_masses(), math.sqrt(mass) * math.hypot(*scenario.gravity))
