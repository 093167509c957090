"""Roofs: a face of rock over a point or a stretch of a machine, and a roof that follows its reaction curve."""

import math
from abc import ABC
from collections.abc import Mapping
from functools import cached_property
from typing import Annotated, ClassVar, Literal

from pydantic import Field, model_validator
from typing_extensions import Self

from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.drives.table_drive import TableDrive
from support_exudyn.model.loads.load import Load, LoadChannel, StretchLoad, TimeFunction
from user_forces.kernel import kernel, limited
from user_forces.values.units import Metres, Newtons, NewtonsPerMetre, Pascals, SecondsPerMetre
from user_forces.values.value import NonNegative, Positive, Value, Vector2, value

SMALLEST = 1e-300  # only so that nothing is divided by zero
GAUSS = 0.5 / math.sqrt(3.0)  # of the length of an interval, from its middle: two points are exact up to cubics
MOST = 50  # points of a curve, each of which an evaluation of the force goes through


@value
class Descending(Value, ABC):
    """What comes down.

    Arguments:
        descent: how far the face has come down [m] over time.
    """

    descent: Drive

    @property
    def courses(self) -> tuple[TimeFunction, ...]:
        """Way down [m] and speed [m/s] of the face."""
        return self.descent.extension, self.descent.speed

    @property
    def drives(self) -> tuple[Drive, ...]:
        """The only drive is the descent."""
        return (self.descent,)


@value
class Roof(Descending, Load):
    """A rigid, level face of rock above a point of a body, cushioned by what lies between both.

        depth = way down + way up of the point - gap,   where it is > 0
        F = k depth max(0, 1 + b rate),   rate = d depth/dt

    The force pushes the point down, never up, and there is no friction along the face. Crushed rock and timber
    take up and give back k depth^2/2; the term with b is lost, and as it grows from zero with the depth the
    force begins and ends without a jump. k is the stiffness of the cushion alone; nothing limits its force, and
    nothing in it stays deformed. A face that is to press with F on a machine that does not give has to come
    down by gap + F/k.

    Arguments:
        body, point: what it presses on, see `Load`.
        descent: how far the face has come down [m] over time.
        stiffness: k [N/m], > 0.
        gap: between face and point in the start posture [m], >= 0.
        damping: b [s/m], >= 0; a closing speed of 1/b doubles the force.
    """

    stiffness: NewtonsPerMetre[Positive]
    gap: Metres[NonNegative] = 0.0
    damping: SecondsPerMetre[NonNegative] = 0.0

    @staticmethod
    @kernel
    def action(
        t: float,
        x: float,
        y: float,
        vx: float,
        vy: float,
        z: float,
        vz: float,
        down: float,
        speed: float,
        stiffness: float,
        gap: float,
        damping: float,
    ) -> tuple[float, ...]:
        """The force, k depth^2/2, power of the descent and loss (F - k depth) rate; see `ActingLoad`."""
        closed, rate = down + y - gap, speed + vy
        depth = limited(closed, 0.0, math.inf)
        elastic = push = stiffness * depth
        if damping > 0.0:
            push = elastic * limited(1.0 + damping * rate, 0.0, math.inf)
        stored, loss = 0.5 * stiffness * depth * depth, (push - elastic) * rate
        return 0.0, -push, 0.0, stored, push * speed, loss, push, -closed

    channels: ClassVar[Mapping[str, LoadChannel]] = {
        "force": LoadChannel("N", "of the roof, downward"),
        "gap": LoadChannel("m", "between roof and point; negative: depth"),
    }

    @property
    def steepness(self) -> tuple[float, ...]:
        """Steepness [N/m]: none along the face, k against it."""
        return 0.0, self.stiffness, 0.0


@value
class GroundReaction(Load):
    """A roof that pushes a point of a body down by a force which follows from its convergence.

    The convergence is the way down of the point since the start posture, which the roof follows without a gap:
    the force against it is the roof's ground reaction curve. It falls where rock carries the more of itself the
    more it has given, and rises where loose rock grows. The curve goes through given points, joined as those of
    a `TableDrive` are; the force is constant before the first and after the last, and on the way back it is
    what it was on the way down. All that it does to the point counts as work; it stores nothing.

    Arguments:
        body, point: what it presses on, see `Load`.
        convergences: of the points of the curve [m], >= 0, each greater than the one before; two to 50.
        forces: at these, downward [N], >= 0.
        between: how the points are joined: "linear", with kinks of the force at the points, or "smooth".
    """

    convergences: Metres[Annotated[tuple[NonNegative, ...], Field(min_length=2, max_length=MOST)]]
    forces: Newtons[Annotated[tuple[NonNegative, ...], Field(min_length=2, max_length=MOST)]]
    between: Literal["smooth", "linear"] = "smooth"

    @model_validator(mode="after")
    def _is_a_curve(self) -> Self:
        if len(self.convergences) != len(self.forces):
            raise ValueError(
                f"{len(self.convergences)} convergences and {len(self.forces)} forces: allowed: as many of both"
            )
        for n, (before, after) in enumerate(zip(self.convergences, self.convergences[1:], strict=False), 1):
            if after <= before:
                raise ValueError(f"convergences[{n}] = {after} m: allowed: > {before} m, the one before")
        return self

    @cached_property
    def _rise(self) -> TableDrive:
        """What the force gains over the first one, by the convergence in place of the time."""
        gains = tuple(force - self.forces[0] for force in self.forces)
        return TableDrive(times=self.convergences, extensions=gains, between=self.between)

    @cached_property
    def pieces(self) -> tuple[float, ...]:
        """The first force [N], and five numbers of each piece of the curve.

        Where it begins, its length [m], and the coefficients of what it adds [N].
        """
        found = [self.forces[0]]
        for begin, end in zip(self.convergences, self.convergences[1:], strict=False):
            piece = self._rise.cubic(0.5 * (begin + end))
            found += begin, end - begin, piece.a1, piece.a2, piece.a3
        return tuple(found)

    @staticmethod
    @kernel
    def action(
        t: float, x: float, y: float, vx: float, vy: float, z: float, vz: float, *pieces: float
    ) -> tuple[float, ...]:
        """The force, nothing forward and down, all of whose power is work; see `ActingLoad`."""
        push = pieces[0]
        for n in range(len(pieces) // 5):
            share = limited((-y - pieces[5 * n + 1]) / pieces[5 * n + 2], 0.0, 1.0)
            push += share * (pieces[5 * n + 3] + share * (pieces[5 * n + 4] + share * pieces[5 * n + 5]))
        return 0.0, -push, 0.0, 0.0, -push * vy, 0.0, push, -y

    channels: ClassVar[Mapping[str, LoadChannel]] = {
        "force": LoadChannel("N", "of the roof, downward"),
        "convergence": LoadChannel("m", "way down of roof and point since the start posture"),
    }

    @property
    def steepness(self) -> tuple[float, ...]:
        """Steepness [N/m]: none along the face, that of the steepest chord, times 3 of cubics, against it."""
        steepest = max(
            abs(high - low) / (end - begin)
            for low, high, begin, end in zip(
                self.forces, self.forces[1:], self.convergences, self.convergences[1:], strict=False
            )
        )
        return 0.0, steepest * (1.0 if self.between == "linear" else 3.0), 0.0


@value
class BeddedRoof(Descending, StretchLoad):
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

    bedding: Pascals[Positive]
    gaps: Metres[tuple[NonNegative, NonNegative]] = (0.0, 0.0)
    damping: SecondsPerMetre[NonNegative] = 0.0

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

    channels: ClassVar[Mapping[str, LoadChannel]] = {
        "force": LoadChannel("N", "of the roof, downward"),
        "place": LoadChannel("m", "of that force along the stretch, from its first point; 0 apart"),
        "pressed": LoadChannel("m", "length of the stretch that is pressed"),
        "gap_first": LoadChannel("m", "between roof and first point; negative: depth"),
        "gap_second": LoadChannel("m", "between roof and second point; negative: depth"),
    }

    @property
    def steepness(self) -> tuple[float, ...]:
        """k times half the length at either end [N/m]."""
        half = 0.5 * self.bedding * self.length
        return half, half


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
