"""A roof that lies on a stretch of a machine, as on a bed of springs."""

import math
from collections.abc import Mapping

from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.loads.load import LoadChannel, TimeFunction
from support_exudyn.model.loads.stretch_load import StretchLoad
from user_forces.kernel import kernel, limited
from user_forces.values.units import Metres, Pascals, SecondsPerMetre
from user_forces.values.value import NonNegative, Positive, Vector2, value

SMALLEST = 1e-300  # only so that nothing is divided by zero
GAUSS = 0.5 / math.sqrt(3.0)  # of the length of an interval, from its middle: two points are exact up to cubics


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

    @property
    def courses(self) -> tuple[TimeFunction, ...]:
        """Way down [m] and speed [m/s] of the face."""
        return self.descent.extension, self.descent.speed

    @staticmethod
    @kernel
    def action(
        t: float,
        first: float,
        second: float,
        first_rate: float,
        second_rate: float,
        down: float,
        speed: float,
        length: float,
        bedding: float,
        damping: float,
        *gaps: float,
    ) -> tuple[float, ...]:
        """F1 and F2, energy of the cushion, power of the descent, integral of (q - k depth) rate.

        See `ActingLoad`.
        """
        one, two = down + first - gaps[0], down + second - gaps[1]  # depths at both ends, negative: gaps
        one_rate = two_rate = 0.0
        if damping > 0.0:
            one_rate, two_rate = speed + first_rate, speed + second_rate
        f1, f2 = pressing(one, two, one_rate, two_rate, bedding * length, damping)
        begin, end = positive_part(one, two)
        stored = taken = 0.0
        for side in (-1.0, 1.0):
            s, weight = gauss_point(begin, end, side)
            depth = one + s * (two - one)
            stored += 0.5 * bedding * length * (depth * depth) * weight
            taken += bedding * length * depth * (one_rate + s * (two_rate - one_rate)) * weight
        force = -(f1 + f2)
        place = -f2 / force * length if force > 0.0 else 0.0
        pressed = limited(end - begin, 0.0, math.inf) * length
        loss = -f1 * one_rate - f2 * two_rate - taken if damping > 0.0 else 0.0
        return f1, f2, stored, force * speed, loss, force, place, pressed, -one, -two

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
        one, two = lowest - self.gaps[0], lowest - self.gaps[1]
        return pressing(one, two, 0.0, 0.0, self.bedding * self.length, 0.0)


@kernel
def positive_part(first: float, second: float) -> Vector2:
    """Where what goes evenly from a first number to a second is positive.

    Shares of the way, from one to another; nothing if they are in the wrong order.
    """
    before, after = limited(-first, 0.0, math.inf), limited(-second, 0.0, math.inf)
    begin = before / (before + limited(second, 0.0, math.inf) + SMALLEST)
    return begin, 1.0 - after / (after + limited(first, 0.0, math.inf) + SMALLEST)


@kernel
def gauss_point(begin: float, end: float, side: float) -> Vector2:
    """Gauss's point on a side, -1 or 1, of the middle of an interval, and its weight: exact for cubics."""
    size = limited(end - begin, 0.0, math.inf)
    return 0.5 * (begin + end) + side * GAUSS * size, 0.5 * size


@kernel
def pressing(
    first: float, second: float, first_rate: float, second_rate: float, stiffness: float, damping: float
) -> Vector2:
    """F1 and F2 of a bed, up [N], which are not positive.

    first, second: depths at both ends [m], with their rates [m/s]. stiffness: of the whole stretch [N/m].
    """
    begin, end = positive_part(first, second)
    one, two = 1.0 + damping * first_rate, 1.0 + damping * second_rate
    if damping > 0.0:
        first_growing, last_growing = positive_part(one, two)
        begin = begin if begin > first_growing else first_growing
        end = end if end < last_growing else last_growing
    f1 = f2 = 0.0
    for side in (-1.0, 1.0):
        s, weight = gauss_point(begin, end, side)
        spread = stiffness * (first + s * (second - first))
        if damping > 0.0:
            spread *= one + s * (two - one)
        force = spread * weight
        f1 -= (1.0 - s) * force
        f2 -= s * force
    return f1, f2
