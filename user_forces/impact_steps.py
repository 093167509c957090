"""How finely a contact is stepped: short steps from an impact on, until what swings in it has become small."""

import math
from collections.abc import Callable

from user_forces.normal.law import NormalLaw

# An impact that does not part is over after so many swings in a row, deep and back, that were small: by less
# than this share of the depth. (With a tenth of it the rise takes a third more steps and no number changes.)
SMALL_SWINGS = 4
LIVELY = 0.5
# A contact at rest whose depth changes in a step by more than this share of it is in an impact again.
QUIET = 0.08
# One that does not swing (a damped contact under load creeps) is over after so many undamped durations;
# a free impact that delivers a restitution of 0.03 has separated after five.
DURATIONS = 20
# Steps after the separation that are as short as those of the impact: generalised alpha carries a share of old
# accelerations on, and a long step would turn what is left of the impact's last ones into speed.
STEPS_APART = 4
# A force that jumps at the impact is met with steps that begin this many times halved and then double: the
# first step after a jump sees about half of it. (One more, and Newton's method meets rounding on the support.)
HALVINGS = 6
# A swing of what friction holds, to one side and back, takes this part of the steps of an impact: 16 of 512. A
# tenth of the loss in stick-slip is gone with a fifth of that; with all of it, 1e-3.
OF_A_SWING = 1.0 / 32.0
ROUNDING = 1e-12  # of squares of speeds, as a share
GROWTH = 1.5  # of the speed that is in an impact, at which its steps are chosen anew


class ImpactSteps:
    """Length of the steps of one clearance pin.

    Arguments:
        law: the pin's normal law.
        number: of steps in an undamped impact, see SolverSettings.
    """

    def __init__(self, law: NormalLaw, number: int) -> None:
        self._law, self._energy = law, law.elastic_energy
        self.number = number
        self.step = math.inf  # largest length of the next step [s]; infinite if there is no impact
        self._length = math.inf  # of steps in the impact going on [s]; infinite: there is none
        self._speed = 0.0  # for which it was chosen [m/s]
        self._halvings = 0
        self._steps = 0  # in contact since the impact began
        self._steps_apart = 0
        self._small_swings = 0
        self._opening = False
        self._deepest = 0.0  # since the last swing [m]
        # the deepest in this impact, and what is stored there: all shallower ones store less
        self._known_depth = self._known_energy = 0.0  # [m], [J]
        self._depth = 0.0  # at the end of the last step [m]

    @property
    def begins_with_a_jump(self) -> bool:
        """Whether the force has jumped at an impact just now: steps are shorter than those of the impact."""
        return self._halvings > 0

    def swing_step(self, time: float) -> float:
        """Largest step [s] for what swings with one over this angular frequency [s].

        A power of two, so that steps stay the same while the load changes a little.
        """
        longest = math.pi * time / (OF_A_SWING * self.number)
        return math.ldexp(0.5, math.frexp(longest)[1]) if longest < math.inf else math.inf

    def length(self, speed: float, mass: float) -> float:
        """Length of the steps in an impact of this speed [m/s] and mass [kg], [s]."""
        return self._law.impact_time(speed, mass) / self.number

    def impact(self, depth: float, rate: float, mass: float) -> None:
        """The surfaces have been in contact at the end of the last step; state and effective mass then."""
        self.begin(depth, rate, mass)
        if self._law.initial_force(self._speed, mass) > 0.0:
            self._set(self._length, HALVINGS)

    def _set(self, length: float, halvings: int = 0) -> None:
        """Let steps have a length [s], halved so often."""
        self._length, self._halvings = length, halvings
        self.step = math.ldexp(length, -halvings)

    def begin(self, depth: float, rate: float, mass: float) -> None:
        """From now on the depth swings: after an impact, or when the drive's speed jumps under a closed pin."""
        self._steps = self._steps_apart = self._small_swings = 0
        self._opening, self._deepest, self._depth = False, depth, depth
        self._known_depth = self._known_energy = 0.0
        self._choose(depth, rate, mass)

    def follow(
        self, depth: float, rate: float, mass: float, find_mass: Callable[[], float] | None = None
    ) -> None:
        """A step has been accepted, without an impact at its end; state and effective mass at its end.

        find_mass: tells the mass where the one given is but the least that it may be; seldom asked.
        """
        if self._halvings:
            self._set(self._length, self._halvings - 1)
        before, self._depth = self._depth, depth
        if self._length == math.inf:
            if depth > 0.0 and abs(depth - before) > QUIET * depth:  # no longer calm
                self.begin(depth, rate, find_mass() if find_mass else mass)
            return
        if depth <= 0.0:
            self._steps_apart += 1
            if self._steps_apart > STEPS_APART:
                self._set(math.inf)
            return
        if depth > self._deepest:
            self._deepest = depth
        if rate < 0.0:
            self._opening = True
        elif self._opening:
            self._swung(depth)
        self._steps += 1
        if self._small_swings >= SMALL_SWINGS or self._steps > DURATIONS * self.number:
            self._set(math.inf)
        elif self._is_faster(depth, rate, mass):
            if find_mass is None:
                self._choose(depth, rate, mass)
            elif self._is_faster(depth, rate, there := find_mass()):
                self._choose(depth, rate, there)

    def _swung(self, depth: float) -> None:
        """The depth is at its smallest: a swing is complete."""
        lively = self._deepest - depth > LIVELY * self._deepest
        self._small_swings = 0 if lively else self._small_swings + 1
        if lively:
            self._steps = 0
        self._opening, self._deepest = False, depth

    def _is_faster(self, depth: float, rate: float, mass: float) -> bool:
        """Whether the energy is that of a speed for which steps are to be chosen anew; every step asks."""
        if depth > self._known_depth:
            self._known_depth, self._known_energy = depth, self._energy(depth)
        limit = GROWTH * self._speed
        if rate * rate + 2.0 * self._known_energy / mass <= (1.0 - ROUNDING) * limit * limit:
            return False
        return self._energy_speed(depth, rate, mass) > limit

    def _choose(self, depth: float, rate: float, mass: float) -> None:
        self._speed = self._energy_speed(depth, rate, mass)
        self._set(self.length(self._speed, mass), self._halvings)

    def _energy_speed(self, depth: float, rate: float, mass: float) -> float:
        """Speed [m/s] of a free body that has all the energy that is in the contact now."""
        stored = self._energy(depth) if depth > 0.0 else 0.0
        return math.sqrt(rate * rate + 2.0 * stored / mass)
