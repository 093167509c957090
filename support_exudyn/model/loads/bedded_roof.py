"""A roof that lies on a stretch of a machine, as on a bed of springs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from user_forces.expressions.scalar import maximum, minimum, sqrt

from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.loads.load import LoadChannel, Powers
from support_exudyn.model.loads.stretch_load import LoadedStretch, StretchLoad
from user_forces.values.units import Metres, Pascals, SecondsPerMetre
from user_forces.values.value import NonNegative, Positive, Vector2, value

SMALLEST = 1e-300  # only so that nothing is divided by zero
GAUSS = 0.5 / sqrt(3.0)  # of the length of an interval, from its middle: two points are exact up to cubics


@value
class BeddedRoof(StretchLoad):
    """A rigid face of rock over a stretch of a body, cushioned all along by what lies between both.

        depth(s) = way down of the face + way up of the body at s - gap(s),   where it is > 0
        q(s) = k depth max(0, 1 + b rate)   [N/m],   rate = d depth/dt

    s runs along the stretch, and the gap goes evenly from that at the first point to that at the second. The
    force is the integral of q over that part of the stretch which is pressed: as body and face are straight,
    depth and rate are linear in s, the part is known, and the integral is exact. It pushes down, never up, with
    no friction along the face. The cushion takes up and gives back the integral of k depth^2/2; the term with b
    is lost.

    A roof over single points is a `Roof` for each of them, all with the same descent.

    Arguments:
        body, points: what it lies on, see `StretchLoad`.
        descent: how far the face has come down [m] over time.
        bedding: k, force per length of the stretch and depth [N/m^2], > 0.
        gaps: between face and body at both points in the start posture [m], >= 0.
        damping: b [s/m], >= 0; a closing speed of 1/b doubles the force.
    """

    descent: Drive
    bedding: Pascals[Positive]
    gaps: Metres[tuple[NonNegative, NonNegative]] = (0.0, 0.0)
    damping: SecondsPerMetre[NonNegative] = 0.0

    def forces(self, at: LoadedStretch) -> Vector2:
        """F1 and F2, up [N], which are not positive."""
        depths, rates = self._depths(at), self._rates(at)
        found = self._pressed_part(depths)
        if self.damping > 0.0:
            found = found.within(_positive_part(*self._growths(rates)))
        first = second = 0.0
        for s, weight in found.points():
            force = self._spread(s, depths, rates) * weight
            first, second = first - (1.0 - s) * force, second - s * force
        return first, second

    def _spread(self, s: float, depths: Vector2, rates: Vector2) -> float:
        """Force per share of the stretch [N] at a share s of it that is pressed."""
        elastic = self.bedding * self.length * _between(s, depths)
        return elastic if self.damping == 0.0 else elastic * _between(s, self._growths(rates))

    def _growths(self, rates: Vector2) -> Vector2:
        """1 + b rate at both ends."""
        first, second = rates
        return 1.0 + self.damping * first, 1.0 + self.damping * second

    def _depths(self, at: LoadedStretch) -> Vector2:
        """The depth at both ends, negative while there is a gap [m]."""
        down = self.descent.extension(at.time)
        return down + at.first - self.gaps[0], down + at.second - self.gaps[1]

    def _rates(self, at: LoadedStretch) -> Vector2:
        """Rates of the depth at both ends [m/s]; without damping the descent need not know its speed."""
        if self.damping == 0.0:
            return 0.0, 0.0
        speed = self.descent.speed(at.time)
        return speed + at.first_rate, speed + at.second_rate

    def _pressed_part(self, depths: Vector2) -> Pressed:
        return _positive_part(*depths)

    def stored(self, at: LoadedStretch) -> float:
        """Integral of k depth^2/2 [J]."""
        depths = self._depths(at)
        return sum(
            0.5 * self.bedding * self.length * _between(s, depths) ** 2 * weight
            for s, weight in self._pressed_part(depths).points()
        )

    def powers(self, at: LoadedStretch) -> Powers:
        """The force times the speed of the descent, and the integral of (q - k depth) rate [W]."""
        first, second = self.forces(at)
        return Powers(-(first + second) * self.descent.speed(at.time), self._lost(at))

    def _lost(self, at: LoadedStretch) -> float:
        """The force times the rate, less what the cushion takes up [W]."""
        if self.damping == 0.0:
            return 0.0
        depths, rates = self._depths(at), self._rates(at)
        first, second = self.forces(at)
        taken: float = 0.0
        for s, weight in self._pressed_part(depths).points():
            elastic = self.bedding * self.length * _between(s, depths)
            taken = taken + elastic * _between(s, rates) * weight
        return -first * rates[0] - second * rates[1] - taken

    @property
    def channels(self) -> Mapping[str, LoadChannel]:
        """The channels are force, place, pressed length and the gaps at both ends."""
        return {
            "force": LoadChannel("N", "of the roof, downward"),
            "place": LoadChannel("m", "of that force along the stretch, from its first point; 0 apart"),
            "pressed": LoadChannel("m", "length of the stretch that is pressed"),
            "gap_first": LoadChannel("m", "between roof and first point; negative: depth"),
            "gap_second": LoadChannel("m", "between roof and second point; negative: depth"),
        }

    def observed(self, at: LoadedStretch) -> Mapping[str, float]:
        """Force [N]; place, pressed length and gaps [m]."""
        first, second = self.forces(at)
        force, depths = -(first + second), self._depths(at)
        return {
            "force": force,
            "place": -second / force * self.length if force > 0.0 else 0.0,
            "pressed": self._pressed_part(depths).size * self.length,
            "gap_first": -depths[0],
            "gap_second": -depths[1],
        }

    @property
    def drives(self) -> tuple[Drive, ...]:
        """The only drive is the descent."""
        return (self.descent,)

    @property
    def steepness(self) -> Vector2:
        """k times half the length at either end [N/m]."""
        half = 0.5 * self.bedding * self.length
        return half, half

    def largest(self, duration: float) -> Vector2:
        """F1 and F2 at the lowest place of the face [N], without damping."""
        lowest = self.descent.span(duration)[1]
        depths = lowest - self.gaps[0], lowest - self.gaps[1]
        first = second = 0.0
        for s, weight in self._pressed_part(depths).points():
            force = self.bedding * self.length * _between(s, depths) * weight
            first, second = first - (1.0 - s) * force, second - s * force
        return first, second


class Pressed(NamedTuple):
    """A part of a stretch, from one share of its length to another; nothing if they are in the wrong order."""

    begin: float
    end: float

    @property
    def size(self) -> float:
        """Its share of the stretch."""
        return maximum(0.0, self.end - self.begin)

    def within(self, other: Pressed) -> Pressed:
        """What both have in common."""
        return Pressed(maximum(self.begin, other.begin), minimum(self.end, other.end))

    def points(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Gauss's two points, as shares of the stretch, and their weights: exact for cubics."""
        size, middle = self.size, 0.5 * (self.begin + self.end)
        return (middle - GAUSS * size, 0.5 * size), (middle + GAUSS * size, 0.5 * size)


def _positive_part(first: float, second: float) -> Pressed:
    """Where what goes evenly from a first number to a second is positive."""
    before, after = maximum(0.0, -first), maximum(0.0, -second)
    begin = before / (before + maximum(0.0, second) + SMALLEST)
    return Pressed(begin, 1.0 - after / (after + maximum(0.0, first) + SMALLEST))


def _between(s: float, ends: Vector2) -> float:
    """What goes evenly from one number to another, at a share of the way."""
    return ends[0] + s * (ends[1] - ends[0])
