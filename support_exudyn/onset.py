"""Where within a step a contact begins, and what to do with the step then.

Between the start and the end of a step the depth of a pin is taken as the cubic that fits depth and
rate at both ends. In free flight its error is of fourth order in the step, and the approach speed at
zero depth is its slope where it crosses zero.
"""

from __future__ import annotations

import math
from enum import Enum
from typing import NamedTuple

from scipy.optimize import brentq

# A step that ends within this share of its length from an onset is taken as ending there, and one that
# starts that close before it as starting there. The force missed or added in between is of the order
# K (v0 share h)^1.5, a relative 1e-6 of an impact that lasts ten steps; the speed is exact anyway.
SHARE = 0.05


class PinMemory(NamedTuple):
    """What a clearance pin remembers from one accepted step to the next."""

    in_contact: bool
    approach_speed: float  # of the contact going on [m/s]
    depth: float  # [m]
    rate: float  # [m/s]


class Onset(NamedTuple):
    """The beginning of a contact."""

    time: float  # [s]
    speed: float  # of approach at zero depth [m/s]


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


class DepthPath(NamedTuple):
    """Depth over a step as a cubic of the fraction x of the step, from 0 to 1."""

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

    def turning_point(self) -> float:
        """The fraction at which the rate passes zero, its signs at both ends being different."""
        return float(brentq(self.rate, 0.0, 1.0, xtol=1e-12))

    def crossing(self, a: float, b: float) -> float:
        """The fraction between a and b at which the depth passes zero, its signs there being different."""
        return float(brentq(self.depth, a, b, xtol=1e-15))


def first_rise(path: DepthPath) -> float | None:
    """Fraction at which a pin that starts the step apart first touches; None if it does not."""
    if path.depth0 > 0.0:
        return 0.0
    if path.depth1 > 0.0:
        return path.crossing(0.0, 1.0)
    if path.rate0 > 0.0 > path.rate1:  # up and down again within the step
        top = path.turning_point()
        if path.depth(top) > 0.0:
            return path.crossing(0.0, top)
    return None


def last_return(path: DepthPath) -> float | None:
    """Fraction at which a pin in contact, having parted within the step, touches again; None if not."""
    if path.depth0 > 0.0 and path.depth1 > 0.0 and path.rate0 < 0.0 < path.rate1:
        bottom = path.turning_point()
        if path.depth(bottom) < 0.0:
            return path.crossing(bottom, 1.0)
    return None


def judge(
    start: PinMemory, depth: float, rate: float, end_time: float, step: float, impact_step: float
) -> Verdict:
    """Whether a tried step may stand, seen from one clearance pin.

    Arguments:
        start: the pin's memory at the start of the step.
        depth, rate: at its end [m], [m/s].
        end_time: end of the step [s].
        step: its length [s].
        impact_step: the length that steps are to have in an impact [s].
    """
    path = DepthPath(start.depth, start.rate, depth, rate, step)
    if start.in_contact:
        again = last_return(path)
        if again is not None:
            onset = _onset(path, again, end_time)
            return Verdict(Action.ACCEPT, PinMemory(True, onset.speed, depth, rate), onset)
        if depth <= 0.0:
            return Verdict(Action.ACCEPT, PinMemory(False, 0.0, depth, rate))
        return Verdict(Action.ACCEPT, PinMemory(True, start.approach_speed, depth, rate))

    touch = first_rise(path)
    if touch is None:
        return Verdict(Action.ACCEPT, PinMemory(False, 0.0, depth, rate))
    onset = _onset(path, touch, end_time)
    if touch >= 1.0 - SHARE:
        return Verdict(Action.ACCEPT, PinMemory(True, onset.speed, depth, rate), onset)
    if touch <= SHARE and step > 1.01 * impact_step:  # the impact must not begin with a long step
        return Verdict(Action.CUT, start, onset, impact_step)
    if touch <= SHARE:
        return Verdict(Action.REPEAT, PinMemory(True, onset.speed, start.depth, start.rate), onset)
    # the engine shortens a repeated step to three quarters or less, so a late onset is reached in two
    share = touch if touch <= 0.75 else touch / 2.0
    return Verdict(Action.CUT, start, onset, share * step)


def _onset(path: DepthPath, fraction: float, end_time: float) -> Onset:
    return Onset(end_time - (1.0 - fraction) * path.step, max(0.0, path.rate(fraction)))
