"""Where within a step a contact begins, and what to do with the step then.

Between the start and the end of a step the depth of a pin is taken as the cubic that fits depth and
rate at both ends. In free flight its error is of fourth order in the step, and the initial impact velocity at
zero depth is its slope where it crosses zero.
"""

import math
from collections.abc import Callable
from enum import Enum
from typing import NamedTuple

from user_forces.contact_state import Onset, PinMemory
from user_forces.roots import bracketed_root

# A step that ends within this share of an impact's step from an impact or a separation is taken as ending
# there, and one that starts that close before it as starting there. The force missed or added in between is of
# the order K (v0 share h)^n, a relative 1e-5 of an impact of a hundred steps even for n = 1; the speed is exact
# anyway.
SHARE = 0.001
BEYOND = 0.1  # of that share is a cut step aimed behind the impact or separation, so as not to end before it
# How far the true course of a depth may be off the cubic, as a share of the change of the rate: its rate, in
# the middle and times four, and the depth, per length of the step. A swing of which the step is a third keeps
# within both.
DOUBT, DOUBT_OF_DEPTH = 0.5, 1.0 / 64.0
# [m] over which no turn of a depth can be told: places of machines are rounded to some 1e-13 m 300 m from the
# origin, and a pin that rests moves less
STILL = 1e-12


class Action(Enum):
    """What to do with a step that has been tried."""

    ACCEPT = "accept"
    REPEAT = "repeat with the new memory"
    CUT = "repeat with a shorter step"


class Verdict(NamedTuple):
    """How a tried step is to be treated, and the memory that goes with it."""

    action: Action
    memory: PinMemory
    onset: Onset | None = None
    step: float = math.inf  # to repeat with, if cut [s]
    landing: float = math.inf  # where steps are to end, if cut [s]


class DepthPath(NamedTuple):
    """Depth over a step as a cubic of the fraction x of the step, from 0 to 1.

    `depth`, `rate`, `may_turn` and `doubt` are compiled too, so they call no other method.
    """

    depth0: float
    rate0: float
    depth1: float
    rate1: float
    step: float

    def depth(self, x: float) -> float:
        """Depth [m] at fraction x."""
        y = 1.0 - x
        return (
            self.depth0 * (1.0 + 2.0 * x) * y * y
            + self.step * self.rate0 * x * y * y
            + self.depth1 * x * x * (3.0 - 2.0 * x)
            - self.step * self.rate1 * x * x * y
        )

    def rate(self, x: float) -> float:
        """Its rate [m/s] at fraction x."""
        return (
            6.0 * x * (1.0 - x) * (self.depth1 - self.depth0) / self.step
            + self.rate0 * (1.0 - x) * (1.0 - 3.0 * x)
            + self.rate1 * x * (3.0 * x - 2.0)
        )

    def turns_up(self) -> float | None:
        """The fraction within the step at which the rate passes zero on its way up; None if it does not."""
        x = self.turn(1.0)
        return x if x <= 1.0 else None

    def turns_down(self) -> float | None:
        """The fraction within the step at which the rate passes zero on its way down; None if it does not."""
        x = self.turn(-1.0)
        return x if x <= 1.0 else None

    def turn(self, sign: float) -> float:
        """The fraction at which the rate passes zero with a slope of this sign; infinite if it does not.

        It is the root of rate0 + slope x + bend x^2.
        """
        bend = 3.0 * (self.rate0 + self.rate1) - 6.0 * (self.depth1 - self.depth0) / self.step
        slope = self.rate1 - self.rate0 - bend
        square = slope * slope - 4.0 * bend * self.rate0
        surely = sign * self.rate0 < 0.0 <= sign * self.rate1
        if not (square > 0.0 or surely):
            return math.inf
        there = sign * math.sqrt(max(0.0, square))  # the slope at the root
        # without cancellation
        if slope * there > 0.0:
            x = -2.0 * self.rate0 / (slope + there)
        else:
            x = (there - slope) / (2.0 * bend) if bend != 0.0 else math.inf
        if surely:  # whatever rounding says
            return min(max(x, 0.0), 1.0)
        return x if 0.0 < x <= 1.0 else math.inf

    def may_turn(self) -> bool:
        """Whether the rate, of one sign at both ends, may pass zero in between, if the pin moves at all.

        The true rate may be off this cubic's by `DOUBT`.
        """
        if self.step * max(abs(self.rate0), abs(self.rate1)) < STILL:
            return False
        sign = -1.0 if self.rate0 + self.rate1 < 0.0 else 1.0
        bend = 3.0 * (self.rate0 + self.rate1) - 6.0 * (self.depth1 - self.depth0) / self.step
        off = DOUBT * (abs(self.rate1 - self.rate0) + abs(bend))
        rate0, rate1, bend = sign * self.rate0, sign * self.rate1, sign * bend
        slope, bend = rate1 - rate0 - bend - off, bend + off
        # the lowest point of rate0 + slope x + bend x^2, if it lies between the ends
        return slope < 0.0 < slope + 2.0 * bend and 4.0 * bend * rate0 <= slope * slope

    def doubt(self) -> float:
        """How far the true depth may be off this cubic [m]: a share of how the rate changes within the step."""
        bend = 3.0 * (self.rate0 + self.rate1) - 6.0 * (self.depth1 - self.depth0) / self.step
        return DOUBT_OF_DEPTH * self.step * (abs(self.rate1 - self.rate0) + abs(bend))

    def crossing(self, a: float, b: float) -> float:
        """The fraction between a and b at which the depth passes zero, its signs there being different."""
        return bracketed_root(self.depth, a, b, xtol=1e-15)


def first_rise(path: DepthPath) -> float | None:
    """Fraction at which a pin that starts the step apart first impacts; None if it does not."""
    if path.depth0 > 0.0:
        return 0.0
    top = path.turns_down()
    if top is not None and path.depth(top) > 0.0:  # perhaps up and down again within the step
        return path.crossing(0.0, top)
    return path.crossing(0.0, 1.0) if path.depth1 > 0.0 else None


def last_return(path: DepthPath) -> float | None:
    """Fraction at which a pin in contact, having separated in the step, makes contact again; else None."""
    if path.depth0 > 0.0 and path.depth1 > 0.0:
        bottom = path.turns_up()
        if bottom is not None and path.depth(bottom) < 0.0:
            return path.crossing(bottom, 1.0)
    return None


def goes_on(start: PinMemory, depth: float, rate: float, step: float) -> bool:
    """Whether in a step from `start` to this depth [m] and rate [m/s] surely nothing has happened to the pin.

    It stayed closed without a dip, or apart without turning back. If not, `judge` says what.
    """
    before = start.rate
    change = 6.0 * (depth - start.depth) / step if step > 0.0 else 3.0 * (before + rate)
    monotone = abs(3.0 * (before + rate) - change) <= abs(rate - before)  # the rate of the cubic
    if start.in_contact:
        return depth > 0.0 and monotone and not before < 0.0 <= rate
    return depth <= 0.0 and start.depth <= 0.0 and monotone and not before > 0.0 > rate


def judge(
    start: PinMemory,
    depth: float,
    rate: float,
    end_time: float,
    step: float,
    impact_step: Callable[[float], float],
) -> Verdict:
    """Whether a tried step may stand, seen from one clearance pin.

    Arguments:
        start: the pin's memory at the start of the step.
        depth, rate: at its end [m], [m/s].
        end_time: end of the step [s].
        step: its length [s].
        impact_step: the length that steps are to have in an impact that begins with a speed [m/s], [s].
    """
    path = DepthPath(start.depth, start.rate, depth, rate, step)
    end = start.moved(depth, rate)
    if start.in_contact:
        return _judge_contact(path, start, end, end_time)
    impact = first_rise(path)
    if impact is None:
        return Verdict(Action.ACCEPT, end)
    onset = _onset(path, impact, end_time)
    shorter = impact_step(onset.speed)
    share = SHARE * min(1.0, shorter / step)  # of this step, which may be far longer than those of the impact
    if impact >= 1.0 - share:
        return Verdict(Action.ACCEPT, end._replace(in_contact=True, impact_velocity=onset.speed), onset)
    if impact > share:
        return _cut(impact, share, path, start, end_time, onset)
    if step > 1.01 * shorter:  # the impact must not begin with a long step
        return Verdict(Action.CUT, start, onset, step=shorter)
    return Verdict(Action.REPEAT, start._replace(in_contact=True, impact_velocity=onset.speed), onset)


def _judge_contact(path: DepthPath, start: PinMemory, end: PinMemory, end_time: float) -> Verdict:
    """Judge a step that a pin begins in contact."""
    again = last_return(path)
    if again is not None:
        onset = _onset(path, again, end_time)
        return Verdict(Action.ACCEPT, end._replace(impact_velocity=onset.speed), onset)
    if end.depth <= 0.0:
        separation = path.crossing(0.0, 1.0) if start.depth > 0.0 else 0.0
        if SHARE < separation < 1.0 - SHARE:  # else the last step would push too long or too hard
            return _cut(separation, SHARE, path, start, end_time)
        return Verdict(Action.ACCEPT, end._replace(in_contact=False, impact_velocity=0.0))
    return Verdict(Action.ACCEPT, end)


def judge_at_ends(start: PinMemory, depth: float, rate: float, end_time: float, step: float) -> Verdict:
    """The verdict without locating anything, as plain recipes do: every step stands.

    An impact or a separation counts from the end of the step in which it happens, so that a contact begins with
    some depth, and with the speed it has there. What impacts and parts within a step is missed.

    Arguments: those of `judge`.
    """
    end = start.moved(depth, rate)
    if start.in_contact:
        if depth > 0.0:
            return Verdict(Action.ACCEPT, end)
        return Verdict(Action.ACCEPT, end._replace(in_contact=False, impact_velocity=0.0))
    if depth <= 0.0:
        return Verdict(Action.ACCEPT, end)
    before = min(start.depth, 0.0)
    onset = Onset(end_time - step * depth / (depth - before), max(0.0, rate))
    return Verdict(Action.ACCEPT, end._replace(in_contact=True, impact_velocity=onset.speed), onset)


def _cut(
    fraction: float,
    share: float,
    path: DepthPath,
    start: PinMemory,
    end_time: float,
    onset: Onset | None = None,
) -> Verdict:
    """Repeat the step so that it ends at a fraction of it, and rather a little later than before."""
    goal = fraction + BEYOND * share
    landing = end_time - (1.0 - goal) * path.step
    # the engine shortens a repeated step to three quarters or less, so a late one is reached in two
    length = (goal if goal <= 0.75 else goal / 2.0) * path.step
    return Verdict(Action.CUT, start, onset, step=length, landing=landing)


def _onset(path: DepthPath, fraction: float, end_time: float) -> Onset:
    return Onset(end_time - (1.0 - fraction) * path.step, max(0.0, path.rate(fraction)))
