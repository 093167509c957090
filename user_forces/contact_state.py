"""What is known of a contact during a run: its memory, its impacts, and the mass that its steps follow."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt


class InverseMass(NamedTuple):
    """Effective mass for step lengths: velocity of journal against bore = inverse mass times impulse.

    All other clearance joints are open: a contact then moves fastest.

    xx, xy, yy: in the bore's axes [1/kg].
    """

    xx: float
    xy: float
    yy: float

    @staticmethod
    def of(matrix: npt.NDArray[np.float64]) -> InverseMass:
        """From the matrix (2, 2)."""
        return InverseMass(float(matrix[0, 0]), float(matrix[0, 1]), float(matrix[1, 1]))

    def mass(self, x: float, y: float) -> float:
        """Mass [kg] that moves in the direction x, y: 1 / (n W n)."""
        square = x * x + y * y + SMALLEST
        along = self.xx * x * x + 2.0 * self.xy * x * y + self.yy * y * y
        return square / max(along, square / HEAVIEST)

    @property
    def lightest(self) -> float:
        """The least mass [kg] that moves in any direction, a little less for rounding."""
        largest = 0.5 * (self.xx + self.yy + math.hypot(self.xx - self.yy, 2.0 * self.xy))
        return (1.0 - ROUNDING) / max(largest, 1.0 / HEAVIEST)


SMALLEST = 1e-30  # so that nothing is divided by zero [m^2]
ROUNDING = 1e-9  # share
HEAVIEST = 1e15  # [kg], stands for a direction in which the joints leave no motion


class PinMemory(NamedTuple):
    """What a clearance pin remembers from one accepted step to the next."""

    in_contact: bool
    impact_velocity: float  # of the present contact [m/s], see `NormalLaw`
    depth: float  # [m]
    rate: float  # [m/s]
    slip: float = 0.0  # [m/s]
    deflection: float = 0.0  # of the friction law [m]

    def at(self, depth: float, rate: float, slip: float, deflection: float) -> PinMemory:
        """The contact at another depth [m], rate [m/s], slip [m/s] and deflection [m]."""
        all_of_it = self.in_contact, self.impact_velocity, depth, rate, slip, deflection
        return tuple.__new__(PinMemory, all_of_it)  # a step asks; the class itself takes twice as long

    def moved(self, depth: float, rate: float) -> PinMemory:
        """The contact at another depth [m] and rate [m/s]. (`_replace` takes three times as long.)"""
        return self.at(depth, rate, self.slip, self.deflection)

    def slid(self, slip: float, deflection: float) -> PinMemory:
        """The contact with another slip [m/s] and deflection [m]."""
        return self.at(self.depth, self.rate, slip, deflection)


class Onset(NamedTuple):
    """The beginning of a contact, and how it ended.

    If it is not located (`judge_at_ends`): time at which the straight line between the depths at both ends of
    the step passes zero, speed at the end of the step.
    """

    time: float  # [s]
    speed: float  # of approach at zero depth [m/s]
    separation_time: float = (
        math.inf
    )  # [s]; infinite: the surfaces have not separated before the end or the next impact
    separation_velocity: float = 0.0  # at which they leave each other at zero depth [m/s]

    def separated(self, time: float, speed: float) -> Onset:
        """The contact after it has ended at a time [s] at this speed [m/s]."""
        return self._replace(separation_time=time, separation_velocity=max(0.0, speed))
