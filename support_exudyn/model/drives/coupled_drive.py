"""A drive that follows another, so that a machine keeps what its two lengths would otherwise leave open."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property

import numpy as np
from pydantic import model_validator

from support_exudyn.model.drives.drive import Drive
from user_forces.values.units import Travel
from user_forces.values.value import InputError, NonNegative, Real, value

DEGREES = (12, 24, 48, 96, 192)  # of polynomials, one after the other until one is good enough
LEFT = 1e-12  # share of the largest coefficient that the last ones may still have
ROUNDING = 1e-15  # [m] below which coefficients are what numbers of metres are rounded by
TAIL = 3  # coefficients that are looked at for it


@value
class CoupledDrive(Drive):
    """Extends as a smooth function of the extension of another drive, which it follows at every instant.

        extension = f(lead's extension), f(0) = 0, speed = f' times the lead's speed

    f is a polynomial in Chebyshev's form, which has no breaks of its own: those of the lead are all.

    Arguments:
        lead: the drive that is followed.
        lowest: smallest extension of the lead for which f is known [m], <= 0; beyond both ends f stays as
            it is there.
        reach: length of that range [m], >= 0.
        coefficients: of Chebyshev's polynomials of 2 (extension - lowest) / reach - 1, constant first [m].
    """

    lead: Drive
    lowest: Travel[Real]
    reach: Travel[NonNegative]
    coefficients: Travel[tuple[Real, ...]]

    @model_validator(mode="after")
    def _holds_the_start(self) -> CoupledDrive:
        if not self.lowest <= 0.0 <= self.lowest + self.reach:
            raise ValueError(
                f"lowest = {self.lowest} m, reach = {self.reach} m: allowed: a range that holds the start, 0"
            )
        if not 1 <= len(self.coefficients) <= DEGREES[-1] + 1:
            raise ValueError(f"coefficients: {len(self.coefficients)} of them; allowed: 1 to {DEGREES[-1] + 1}")
        return self

    def extension(self, t: float) -> float:
        """Extension [m] at time t [s]."""
        return self._follow(self.lead.extension(t))[0]

    def speed(self, t: float) -> float:
        """Speed [m/s] at time t [s]; at a jump the value before it."""
        return self._follow(self.lead.extension(t))[1] * self.lead.speed(t)

    def speed_jump(self, t: float) -> float:
        """Jump of the speed [m/s], which is there where the lead's is."""
        return self._follow(self.lead.extension(t))[1] * self.lead.speed_jump(t)

    @property
    def initial_speed(self) -> float:
        """Speed just after the start [m/s]."""
        return self._follow(self.lead.extension(0.0))[1] * self.lead.initial_speed

    @property
    def breaks(self) -> tuple[float, ...]:
        """The breaks are those of the lead [s]."""
        return self.lead.breaks

    def span(self, duration: float) -> tuple[float, float]:
        """Smallest and largest extension [m] within this time [s]."""
        low, high = self.lead.span(duration)
        turns = [low, high, *(one for one in self._turns if low < one < high)]
        values = [self._follow(one)[0] for one in turns]
        return min(0.0, *values), max(0.0, *values)

    @cached_property
    def _at_start(self) -> float:
        return _series(self.coefficients, self._place(0.0))

    @cached_property
    def _slopes(self) -> tuple[float, ...]:
        """Coefficients of the derivative by the place within the range, from -1 to 1."""
        return tuple(np.polynomial.chebyshev.chebder(np.array(self.coefficients)).tolist())

    @cached_property
    def _turns(self) -> tuple[float, ...]:
        """Extensions of the lead at which this one turns back [m]."""
        if self.reach == 0.0 or not any(self._slopes[1:]):
            return ()
        size = max(map(abs, self._slopes))
        roots = np.polynomial.chebyshev.chebroots(np.array(self._slopes) / size)
        real = roots.real[(np.abs(roots.imag) < 1e-6) & (np.abs(roots.real) <= 1.0)]
        return tuple(self.lowest + 0.5 * self.reach * (one + 1.0) for one in real.tolist())

    def _place(self, extension: float) -> float:
        """Place of an extension of the lead within the range, from -1 to 1."""
        place = 2.0 * (extension - self.lowest) / self.reach - 1.0 if self.reach > 0.0 else 0.0
        return min(1.0, max(-1.0, place))

    def _follow(self, extension: float) -> tuple[float, float]:
        """f of an extension of the lead, and its derivative by that."""
        place = self._place(extension)
        slope = _series(self._slopes, place) * 2.0 / self.reach if self.reach > 0.0 else 0.0
        return _series(self.coefficients, place) - self._at_start, slope


def following(
    lead: Drive, duration: float, length: Callable[[np.ndarray], np.ndarray], size: float = 1.0
) -> CoupledDrive:
    """The drive that extends by `length(extension)` [m] where `lead` extends by `extension` [m].

    duration: of the run [s]: what the lead does within it is covered. length: of extensions in any order, an
    analytic function; as exact as it is computed the coupled drive is. size: of the coordinates from which it
    computes [m].

    Raises InputError if no polynomial follows it: next to a dead centre.
    """
    low, high = lead.span(duration)
    if low == high:
        return CoupledDrive(lead=lead, lowest=low, reach=0.0, coefficients=(0.0,))
    rounding = max(ROUNDING, math.ulp(size))
    for degree in DEGREES:
        coefficients = np.polynomial.Chebyshev.interpolate(length, degree, (low, high)).coef
        if np.abs(coefficients[-TAIL:]).max() <= max(LEFT * np.abs(coefficients[1:]).max(), rounding):
            return CoupledDrive(
                lead=lead, lowest=low, reach=high - low, coefficients=tuple(coefficients.tolist())
            )
    raise InputError(
        f"drive: from {low:.4g} to {high:.4g} m the part that follows it would have to move without bounds; "
        "allowed: strokes that keep away from where the linkage locks"
    )


def _series(coefficients: tuple[float, ...], place: float) -> float:
    """Sum of Chebyshev's polynomials by Clenshaw's recurrence; a solver asks in every step."""
    twice, one, two = 2.0 * place, 0.0, 0.0
    for coefficient in coefficients[:0:-1]:
        one, two = coefficient + twice * one - two, one
    return coefficients[0] + place * one - two
