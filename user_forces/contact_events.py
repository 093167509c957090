"""Where within a step a contact begins, and what to do with the step then.

The depth of a pin is the cubic of `roots`, and the initial impact velocity is its slope where it crosses zero.
"""

import math
from collections.abc import Callable
from enum import Enum
from typing import NamedTuple

from user_forces.contact_state import Onset, PinMemory
from user_forces.roots import DepthPath, first_rise, rate_at, upside_down

# A step that ends within this share of an impact's step from an impact or a separation is taken as ending
# there, and one that starts that close before it as starting there. The force missed or added in between is of
# the order K (v0 share h)^n, a relative 1e-5 of an impact of a hundred steps even for n = 1; the speed is exact
# anyway.
SHARE = 0.001
BEYOND = 0.1  # of that share is a cut step aimed behind the impact or separation, so as not to end before it


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
    impact = 0.0 if start.depth > 0.0 else first_rise(path)
    if impact > 1.0:
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
    again = first_rise(path)
    if start.depth > 0.0 and again <= 1.0:  # it has separated meanwhile
        onset = _onset(path, again, end_time)
        return Verdict(Action.ACCEPT, end._replace(impact_velocity=onset.speed), onset)
    if end.depth <= 0.0:
        separation = first_rise(upside_down(path)) if start.depth > 0.0 else 0.0
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
    return Onset(end_time - (1.0 - fraction) * path.step, max(0.0, rate_at(path, fraction)))
