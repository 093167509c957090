"""A drive through given points: measured or planned displacement of an actuator over time."""

from __future__ import annotations

from bisect import bisect_left
from functools import cached_property
from itertools import pairwise
from typing import Annotated, Literal, NamedTuple

from pydantic import Field, model_validator

from support_exudyn.model.drives.drive import Drive
from user_forces.values.units import Seconds, Travel
from user_forces.values.value import NonNegative, Real, value

MOST_POINTS = 1_000_000


class Cubic(NamedTuple):
    """a0 + a1 x + a2 x^2 + a3 x^3 [m], x = (t - begin)/length, both in s."""

    begin: float
    length: float
    a0: float
    a1: float
    a2: float
    a3: float


@value
class TableDrive(Drive):
    """Through given points, at rest before the first and after the last.

    "smooth": cubics between the points that neither overshoot them nor jump in speed (Fritsch and Butland's,
    known as PCHIP, of the points with the rest before and after them); the acceleration may jump at points. Two
    points make a `CubicStep`.
    "linear": constant speed between the points, which jumps at them, with an impulse as `UniformSpeed` has.

    Arguments:
        times: of the points [s], >= 0, each later than the one before; two at least.
        extensions: at these times [m], of cranks the angles [rad]; the first is 0, for extension counts from
            the start posture.
        between: how the points are joined.

    Source: F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304.
    """

    times: Seconds[Annotated[tuple[NonNegative, ...], Field(min_length=2, max_length=MOST_POINTS)]]
    extensions: Travel[Annotated[tuple[Real, ...], Field(min_length=2, max_length=MOST_POINTS)]]
    between: Literal["smooth", "linear"] = "smooth"

    @model_validator(mode="after")
    def _is_a_table(self) -> TableDrive:
        if len(self.times) != len(self.extensions):
            raise ValueError(
                f"{len(self.times)} times and {len(self.extensions)} extensions: allowed: as many of both"
            )
        for n, (before, after) in enumerate(pairwise(self.times), 1):
            if after <= before:
                raise ValueError(f"times[{n}] = {after} s: allowed: > {before} s, the one before")
        if self.extensions[0] != 0.0:
            raise ValueError(
                f"extensions[0] = {self.extensions[0]} m: allowed: 0, for extension counts from the start "
                "posture"
            )
        return self

    def extension(self, t: float) -> float:
        """Extension [m] at time t [s]."""
        n = self._piece(t)
        if n in (0, len(self.times)) or t == self.times[n]:
            return self.extensions[min(n, len(self.times) - 1)]  # which the way below would miss by rounding
        begin, length, low, slope, _, _ = self.cubic(t)
        x, rise = (t - begin) / length, self.extensions[n] - low
        if self.between == "linear":
            return low + rise * x
        bent = x * (1.0 - x) * (slope * (1.0 - x) - length * self._slopes[n] * x)
        return low + rise * x * x * (3.0 - 2.0 * x) + bent

    def speed(self, t: float) -> float:
        """Speed [m/s] at time t [s]; at a jump the value before it."""
        n = self._piece(t)
        if n in (0, len(self.times)):
            return 0.0
        if self.between == "linear":
            return self._secants[n - 1]
        begin, length, low, slope, _, _ = self.cubic(t)
        x, rise = (t - begin) / length, self.extensions[n] - low
        bent = slope / length * (1.0 - x) * (1.0 - 3.0 * x) + self._slopes[n] * x * (3.0 * x - 2.0)
        return rise * 6.0 * x * (1.0 - x) / length + bent

    def speed_jump(self, t: float) -> float:
        """Jump of the speed at a time [s], in m/s; 0 everywhere if the points are joined smoothly."""
        return self._jumps.get(t, 0.0)

    @cached_property
    def breaks(self) -> tuple[float, ...]:
        """The points [s]; where they are joined by lines those at which the speed jumps."""
        return tuple(self._jumps) if self.between == "linear" else self.times

    def span(self, duration: float) -> tuple[float, float]:
        """Smallest and largest extension [m] within this time [s]."""
        reached = [self.extensions[0], *self.extensions[: self._piece(duration)], self.extension(duration)]
        return min(reached), max(reached)  # between two points it only rises or only falls

    def cubic(self, t: float) -> Cubic:
        """The polynomial of the piece that a time [s] lies in; constant before and after all of them."""
        n = self._piece(t)
        if n in (0, len(self.times)):
            return Cubic(0.0, 1.0, self.extensions[min(n, len(self.times) - 1)], 0.0, 0.0, 0.0)
        begin, low = self.times[n - 1], self.extensions[n - 1]
        length, rise = self.times[n] - begin, self.extensions[n] - low
        if self.between == "linear":
            return Cubic(begin, length, low, rise, 0.0, 0.0)
        first, last = length * self._slopes[n - 1], length * self._slopes[n]
        return Cubic(begin, length, low, first, 3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise)

    def _piece(self, t: float) -> int:
        """Number of points that lie before a time [s]."""
        return bisect_left(self.times, t)

    @cached_property
    def _secants(self) -> tuple[float, ...]:
        """Mean speed of every piece [m/s]."""
        points = pairwise(zip(self.times, self.extensions, strict=True))
        return tuple((high - low) / (end - begin) for (begin, low), (end, high) in points)

    @cached_property
    def _slopes(self) -> tuple[float, ...]:
        """Speed at every point of a smooth drive [m/s]: weighted harmonic means, 0 at extremes and ends."""
        found = [0.0]
        for n, (before, after) in enumerate(pairwise(self._secants)):
            left, right = self.times[n + 1] - self.times[n], self.times[n + 2] - self.times[n + 1]
            first, last = 2.0 * right + left, right + 2.0 * left
            turns = before * after <= 0.0
            found.append(0.0 if turns else (first + last) / (first / before + last / after))
        return (*found, 0.0)

    @cached_property
    def _jumps(self) -> dict[float, float]:
        """Jumps of the speed [m/s] by their times [s], where there are any."""
        if self.between == "smooth":
            return {}
        speeds = (0.0, *self._secants, 0.0)
        jumps = zip(self.times, speeds, speeds[1:], strict=False)
        return {t: after - before for t, before, after in jumps if after != before}
