"""Where a quantity passes zero or is largest, within a step and elsewhere.

Between the start and the end of a step a depth, or a gap, is taken as the cubic that fits value and rate at
both ends. In free flight its error is of fourth order in the step. Both formulations locate with these kernels.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from user_forces.kernel import kernel

RTOL = 8.881784197001252e-16  # four roundings, the least that is allowed
ROUNDS = 80  # of Newton's method on a cubic, kept by bisection
ROUNDING = 1e-16  # share of a step that is no change any more
# How far the true course of a depth may be off the cubic, as a share of the change of the rate: its rate, in
# the middle and times four, and the depth, per length of the step. A swing of which the step is a third keeps
# within both.
DOUBT, DOUBT_OF_DEPTH = 0.5, 1.0 / 64.0
# [m] over which no turn of a depth can be told: places of machines are rounded to some 1e-13 m 300 m from the
# origin, and a pin that rests moves less
STILL = 1e-12
# Laws have corners, where what limits the damping changes: between the ends of steps a force can be larger than
# at either, by a share of the step and not of its square.
NEAR_PEAK = 0.8  # share of the largest force so far from which a step is looked at more closely
NEAR_TOP = 0.98  # and of which its largest sample is, if the top between two is looked for
PEAK_SAMPLES = 8  # parts of a step between which the force is looked at
PEAK_LOOKS = PEAK_SAMPLES + 25  # until the peak is known to 1e-5 of such a part
GOLDEN = 0.5 * (3.0 - math.sqrt(5.0))  # golden section: share of an interval
NEXT_TO_END, ABOVE = 1e-3, 1e-10  # share of a step; and of a force, that is more than rounding


def bracketed_root(
    function: Callable[[float], float], low: float, high: float, xtol: float = 2e-12, rtol: float = RTOL
) -> float:
    """Root of a function between two places at which its signs differ, by Brent's method.

    Arguments:
        function: continuous, of one number.
        low, high: the places.
        xtol, rtol: allowed error, absolute and relative; rtol at least RTOL.

    Raises ValueError if the signs do not differ.
    """
    from scipy.optimize import brentq  # takes a third of a second to import

    return float(brentq(function, low, high, xtol=xtol, rtol=rtol))


class DepthPath(NamedTuple):
    """Depth [m] over a step as a cubic of the fraction x of the step, from 0 to 1.

    depth0, rate0, depth1, rate1: at its start and its end [m], [m/s]. step: its length [s].
    """

    depth0: float
    rate0: float
    depth1: float
    rate1: float
    step: float


@kernel
def depth_at(path: DepthPath, x: float) -> float:
    """Depth [m] at fraction x."""
    y = 1.0 - x
    return (
        path.depth0 * (1.0 + 2.0 * x) * y * y
        + path.step * path.rate0 * x * y * y
        + path.depth1 * x * x * (3.0 - 2.0 * x)
        - path.step * path.rate1 * x * x * y
    )


@kernel
def rate_at(path: DepthPath, x: float) -> float:
    """Rate of the depth [m/s] at fraction x."""
    return (
        6.0 * x * (1.0 - x) * (path.depth1 - path.depth0) / path.step
        + path.rate0 * (1.0 - x) * (1.0 - 3.0 * x)
        + path.rate1 * x * (3.0 * x - 2.0)
    )


@kernel
def bend_of(path: DepthPath) -> float:
    """The coefficient of x^2 in the rate, rate0 + slope x + bend x^2, slope = rate1 - rate0 - bend [m/s]."""
    return 3.0 * (path.rate0 + path.rate1) - 6.0 * (path.depth1 - path.depth0) / path.step


@kernel
def turn(path: DepthPath, sign: float) -> float:
    """The fraction at which the rate passes zero with a slope of this sign; infinite if it does not."""
    bend = bend_of(path)
    slope = path.rate1 - path.rate0 - bend
    square = slope * slope - 4.0 * bend * path.rate0
    surely = sign * path.rate0 < 0.0 <= sign * path.rate1
    if not (square > 0.0 or surely):
        return math.inf
    there = sign * math.sqrt(max(0.0, square))  # the slope at the root
    # without cancellation
    if slope * there > 0.0:
        x = -2.0 * path.rate0 / (slope + there)
    else:
        x = (there - slope) / (2.0 * bend) if bend != 0.0 else math.inf
    if surely:  # whatever rounding says
        return min(max(x, 0.0), 1.0)
    return x if 0.0 < x <= 1.0 else math.inf


@kernel
def may_turn(path: DepthPath) -> bool:
    """Whether the rate, of one sign at both ends, may pass zero in between, if the pin moves at all.

    The true rate may be off this cubic's by `DOUBT`.
    """
    if path.step * max(abs(path.rate0), abs(path.rate1)) < STILL:
        return False
    sign, bend = (-1.0 if path.rate0 + path.rate1 < 0.0 else 1.0), bend_of(path)
    off = DOUBT * (abs(path.rate1 - path.rate0) + abs(bend))
    rate0, rate1, bend = sign * path.rate0, sign * path.rate1, sign * bend
    slope, bend = rate1 - rate0 - bend - off, bend + off
    # the lowest point of rate0 + slope x + bend x^2, if it lies between the ends
    return slope < 0.0 < slope + 2.0 * bend and 4.0 * bend * rate0 <= slope * slope


@kernel
def doubt(path: DepthPath) -> float:
    """How far the true depth may be off the cubic [m]: a share of how the rate changes within the step."""
    return DOUBT_OF_DEPTH * path.step * (abs(path.rate1 - path.rate0) + abs(bend_of(path)))


@kernel
def crossing(path: DepthPath, low: float, high: float) -> float:
    """The fraction at which the depth passes zero upwards between low and high, where it only rises."""
    at_low, at_high = depth_at(path, low), depth_at(path, high)
    if at_low >= 0.0:
        return low
    x = low + (high - low) * at_low / (at_low - at_high)
    for _ in range(ROUNDS):
        value, slope = depth_at(path, x), path.step * rate_at(path, x)
        if value > 0.0:
            high = x
        else:
            low = x
        following = x - value / slope if slope > 0.0 else high
        if not low <= following <= high:
            following = 0.5 * (low + high)
        if abs(following - x) <= ROUNDING:
            break
        x = following
    return x


@kernel
def first_rise(path: DepthPath) -> float:
    """The first fraction at which the depth passes zero upwards; infinite if it does not."""
    top, bottom = turn(path, -1.0), turn(path, 1.0)
    # it rises from the start or from a bottom on, to a top or to the end, and perhaps once more after that
    low = bottom if path.rate0 < 0.0 or bottom < top else 0.0
    high = top if low < top <= 1.0 else 1.0
    if low <= 1.0 and depth_at(path, low) <= 0.0 < depth_at(path, high):
        return crossing(path, low, high)
    if high < bottom <= 1.0 and depth_at(path, bottom) <= 0.0 < path.depth1:
        return crossing(path, bottom, 1.0)
    return math.inf


@kernel
def upside_down(path: DepthPath) -> DepthPath:
    """The path of the negative depth, which rises where a contact parts."""
    return DepthPath(-path.depth0, -path.rate0, -path.depth1, -path.rate1, path.step)


class Bracket(NamedTuple):
    """Two places between which a function passes zero, and what counts as its values there."""

    low: float
    high: float
    at_low: float
    at_high: float


@kernel
def zero_of(bracket: Bracket) -> float:
    """The place to try next, by false position."""
    low, high, at_low, at_high = bracket
    x = (low * at_high - high * at_low) / (at_high - at_low)
    return x if low < x < high else 0.5 * (low + high)


@kernel
def narrowed(bracket: Bracket, x: float, value: float) -> Bracket:
    """The bracket after a function has this value at x; the end that stays counts by half (Illinois)."""
    low, high, at_low, at_high = bracket
    if (value > 0.0) == (at_low > 0.0):
        return Bracket(x, high, value, 0.5 * at_high)
    return Bracket(low, x, 0.5 * at_low, value)


class StepPeak(NamedTuple):
    """The largest value so far, at a fraction of a step, and the fractions between which more may be."""

    top: float = -math.inf
    at: float = 0.0
    low: float = 0.0
    high: float = 1.0


@kernel
def peak_place(peak: StepPeak, n: int) -> float:
    """The n-th fraction of a step to look at: `PEAK_SAMPLES` parts, then golden section at the largest."""
    if n <= PEAK_SAMPLES:
        return n / PEAK_SAMPLES
    above, below = peak.high - peak.at, peak.at - peak.low
    return peak.at + GOLDEN * above if above > below else peak.at - GOLDEN * below


@kernel
def peak_with(peak: StepPeak, n: int, x: float, value: float) -> StepPeak:
    """The peak after a quantity has been seen to have a value at x, the n-th."""
    top, at, low, high = peak
    if n <= PEAK_SAMPLES:
        if value > top:
            return StepPeak(value, x, max(0.0, x - 1.0 / PEAK_SAMPLES), min(1.0, x + 1.0 / PEAK_SAMPLES))
        return peak
    if value > top:
        return StepPeak(value, x, at, high) if x > at else StepPeak(value, x, low, at)
    return StepPeak(top, at, low, x) if x > at else StepPeak(top, at, x, high)


def has_a_top(size: Callable[[float], float], first: float, last: float) -> bool:
    """Whether a force is larger inside a step than at its ends: where it falls towards the larger one [N]."""
    if last >= first:
        return size(1.0 - NEXT_TO_END) > (1.0 + ABOVE) * last
    return size(NEXT_TO_END) > (1.0 + ABOVE) * first


def peak(size: Callable[[float], float], largest: float) -> float:
    """The largest force [N] so far, a step included; size: the force's magnitude at fractions of the step."""
    found = StepPeak()
    for n in range(PEAK_LOOKS):
        x = peak_place(found, n)
        found = peak_with(found, n, x, size(x))
        if n == PEAK_SAMPLES and found.top <= NEAR_TOP * largest:
            break
    return max(largest, found.top)
