"""What is known of a contact while a run goes on: its effective mass, its memory, its first impacts."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from user_forces.expressions.scalar import maximum
from user_forces.normal.law import Impact


class InverseMass(NamedTuple):
    """How easily the journal moves against the bore: velocity = inverse mass times impulse, a symmetric matrix.

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
        """Mass [kg] that moves in the direction x, y: 1 / (n W n). Takes numbers or expressions."""
        square = x * x + y * y + SMALLEST
        along = self.xx * x * x + 2.0 * self.xy * x * y + self.yy * y * y
        return square / maximum(along, square / HEAVIEST)

    @property
    def lightest(self) -> float:
        """The least mass [kg] that moves in any direction, a little less for rounding."""
        largest = 0.5 * (self.xx + self.yy + math.hypot(self.xx - self.yy, 2.0 * self.xy))
        return (1.0 - ROUNDING) / max(largest, 1.0 / HEAVIEST)

    def mixed(self, other: InverseMass, x: float) -> InverseMass:
        """The matrix at a fraction x of the way to another, by a straight line."""
        return InverseMass(*((1.0 - x) * one + x * its for one, its in zip(self, other, strict=True)))

    def turned(self, angle: float) -> InverseMass:
        """The matrix in axes against which its own are turned by an angle [rad]."""
        c, s = math.cos(angle), math.sin(angle)
        xx, xy, yy = self
        cross = c * s * (xx - yy) + (c * c - s * s) * xy
        both = 2.0 * c * s * xy
        return InverseMass(c * c * xx + s * s * yy - both, cross, s * s * xx + c * c * yy + both)


SMALLEST = 1e-30  # so that nothing is divided by zero [m^2]
ROUNDING = 1e-9  # share
HEAVIEST = 1e15  # [kg], stands for a direction in which the joints leave no motion


class PinMemory(NamedTuple):
    """What a clearance pin remembers from one accepted step to the next."""

    in_contact: bool
    impact_velocity: float  # of the contact going on [m/s], see Impact
    depth: float  # [m]
    rate: float  # [m/s]
    slip: float = 0.0  # [m/s]
    deflection: float = 0.0  # of the friction law [m]
    inverse_mass_xx: float = 1.0  # [1/kg], see InverseMass
    inverse_mass_xy: float = 0.0
    inverse_mass_yy: float = 1.0

    def at(self, depth: float, rate: float, slip: float, deflection: float) -> PinMemory:
        """The contact at another depth [m], rate [m/s], slip [m/s] and deflection [m]."""
        in_contact, impact_velocity, _, _, _, _, xx, xy, yy = self
        all_of_it = in_contact, impact_velocity, depth, rate, slip, deflection, xx, xy, yy
        return tuple.__new__(PinMemory, all_of_it)  # a step asks; the class itself takes twice as long

    @property
    def inverse_mass(self) -> InverseMass:
        """Inverse effective mass of the journal when the contact began, or was last pressed on again; see
        `pressed`.

        The law goes by it until it is renewed, so what other pins do meanwhile changes no force at a stroke.
        """
        return InverseMass(self.inverse_mass_xx, self.inverse_mass_xy, self.inverse_mass_yy)

    def with_inverse_mass(self, inverse_mass: InverseMass) -> PinMemory:
        """The contact with another inverse effective mass."""
        return self._replace(
            inverse_mass_xx=inverse_mass.xx, inverse_mass_xy=inverse_mass.xy, inverse_mass_yy=inverse_mass.yy
        )

    def moved(self, depth: float, rate: float) -> PinMemory:
        """The contact at another depth [m] and rate [m/s]. (`_replace` takes three times as long.)"""
        return self.at(depth, rate, self.slip, self.deflection)

    def slid(self, slip: float, deflection: float) -> PinMemory:
        """The contact with another slip [m/s] and deflection [m]."""
        return self.at(self.depth, self.rate, slip, deflection)

    def impact(self, x: float, y: float) -> Impact | None:
        """What the laws are told at an eccentricity x, y [m]; None while the surfaces are apart."""
        return Impact(self.impact_velocity, self.inverse_mass.mass(x, y)) if self.in_contact else None


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
