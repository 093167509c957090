"""What happens to the contact within a step that has been tried, and where.

A step is looked at in parts. Over a part the depth is the cubic that fits depth and rate at both ends; where
that leaves in doubt whether something happens, the step is too long, and is made again shorter.
"""

import math

from support_exudyn.formulations.compilation import compiled
from support_exudyn.formulations.contact_events import DepthPath
from support_exudyn.formulations.reduced.equations import observe, within
from support_exudyn.formulations.reduced.layout import (
    CLEARANCE,
    CLOSED,
    DEPTH,
    OFFSET_X,
    OFFSET_Y,
    PUSH,
    RATE,
    RENEWS,
    Matrix,
    Vector,
)

# RETURN: pressed on again without having separated. CUT: the law begins or ceases to ask for tension
NOTHING, IMPACT, SEPARATION, RETURN, CUT, TOO_LONG = range(6)
SAMPLES = 8  # of a cubic, when a change of sign is looked for
PARTS = 4  # of a step in free flight
PARTS_CLOSED = 1  # of a step in contact
SHORT = 1e-9  # [s]: in so short a step what cannot be told apart is taken as it ends
CUT_MET = 1e-9  # PUSH, of the order of 1, at which a cut of tension is met; the force has only a kink there
NEAR_CUT = 0.5  # PUSH below which a step is looked at for two cuts,
CUT_SAMPLES = 4  # in so many parts
AT_ZERO = 1e-13  # depth [m] that is an impact or separation just made; those are met to a tenth of it
Found = tuple[int, float, float]  # what, and fractions of the step between which it happens


# the one cubic of all formulations, compiled
depth_of, rate_of = compiled(DepthPath.depth), compiled(DepthPath.rate)
may_turn, doubt_of = compiled(DepthPath.may_turn), compiled(DepthPath.doubt)


@compiled
def turning_point(path: DepthPath) -> float:
    """Fraction at which the cubic's rate passes zero, its signs at both ends being different.

    By bisection, which never gives the start itself: a step that ends there would have no length.
    """
    low, high = 0.0, 1.0
    for _ in range(30):
        x = 0.5 * (low + high)
        if (rate_of(path, x) > 0.0) == (path.rate0 > 0.0):
            low = x
        else:
            high = x
    return 0.5 * (low + high)


@compiled
def separation(path: DepthPath) -> Found:
    """The first way out of a contact that is open at the end of a part."""
    inside = 0.0 if path.depth0 > AT_ZERO or path.rate0 < 0.0 else -1.0
    for n in range(1, SAMPLES + 1):
        x = n / SAMPLES
        if depth_of(path, x) > 0.0:
            inside = x
        elif inside >= 0.0:
            return SEPARATION, inside, x
    return (SEPARATION, 1.0, 1.0) if path.step <= SHORT else (TOO_LONG, 0.0, 0.0)


@compiled
def in_contact(renews: bool, d0: float, r0: float, d1: float, r1: float, h: float) -> Found:
    """What happens in a part that begins in contact.

    Arguments:
        renews: something changes where a contact is pressed on again.
        d0, r0, d1, r1: depth [m] and rate [m/s] at both ends.
        h: length of the part [s].
    """
    path = DepthPath(d0, r0, d1, r1, h)
    turns = r0 < 0.0 <= r1
    if h > SHORT and not turns and not r0 > 0.0 > r1:
        lowest = min(d0, d1) - h * max(abs(r0), abs(r1))
        if (renews or lowest <= 0.0 < d1) and may_turn(path):
            return TOO_LONG, 0.0, 0.0
    if d1 <= 0.0:
        return separation(path)
    if turns:
        x = turning_point(path)
        lowest = depth_of(path, x)
        if h > SHORT and abs(lowest) < doubt_of(path):
            return TOO_LONG, 0.0, 0.0
        if lowest <= 0.0:
            return SEPARATION, 0.0, x
        if renews:
            return RETURN, x, x
    return NOTHING, 1.0, 1.0


@compiled
def rise(d0: float, r0: float, d1: float, r1: float, h: float) -> Found:
    """The first impact of a journal that is free at the start of a part of a step; fractions of that part."""
    path, top = DepthPath(d0, r0, d1, r1, h), 1.0
    if d1 <= 0.0:
        if not r0 > 0.0 > r1:
            unseen = h > SHORT and max(d0, d1) + h * max(abs(r0), abs(r1)) > 0.0 and not r0 < 0.0 < r1
            unclear = unseen and may_turn(path)
            return (TOO_LONG, 0.0, 0.0) if unclear else (NOTHING, 1.0, 1.0)
        top = turning_point(path)
        highest = depth_of(path, top)
        if h > SHORT and abs(highest) < doubt_of(path):
            return TOO_LONG, 0.0, 0.0
        if highest <= 0.0:
            return NOTHING, 1.0, 1.0
    low = 0.0
    apart = d0 < -AT_ZERO or r0 > 0.0  # else the surfaces have just separated and must be seen apart first
    for n in range(1, SAMPLES + 1):
        x = top * n / SAMPLES
        if depth_of(path, x) > 0.0:
            return (IMPACT, low, x) if apart or h <= SHORT else (TOO_LONG, 0.0, 0.0)
        low, apart = x, True
    return IMPACT, low, top


@compiled
def look(
    p: Vector,
    segment: Vector,
    memory: Vector,
    t: float,
    h: float,
    x: float,
    path: Matrix,
    y: Vector,
    out: Vector,
) -> None:
    """Write the contact at a fraction x of a step into `out`; y is overwritten."""
    within(path, x, y)
    observe(p, segment, memory, t + x * h, y, out)


@compiled
def in_flight(
    p: Vector,
    segment: Vector,
    memory: Vector,
    t: float,
    h: float,
    start: Vector,
    end: Vector,
    path: Matrix,
    y: Vector,
    there: Vector,
) -> Found:
    """What happens in a step that begins apart. start, end: the contact there; y, there: are overwritten."""
    moved = math.hypot(end[OFFSET_X] - start[OFFSET_X], end[OFFSET_Y] - start[OFFSET_Y])
    if moved > p[CLEARANCE]:
        return TOO_LONG, 0.0, 0.0
    d0, r0 = min(start[DEPTH], 0.0), start[RATE]
    for n in range(PARTS):
        d1, r1 = end[DEPTH], end[RATE]
        if n + 1 < PARTS:
            look(p, segment, memory, t, h, (n + 1) / PARTS, path, y, there)
            d1, r1 = there[DEPTH], there[RATE]
        what, low, high = rise(d0, r0, d1, r1, h / PARTS)
        if what == TOO_LONG:
            return TOO_LONG, 0.0, 0.0
        if what == IMPACT:
            return IMPACT, (n + low) / PARTS, (n + high) / PARTS
        d0, r0 = d1, r1
    return NOTHING, 1.0, 1.0


@compiled
def closed(
    p: Vector,
    segment: Vector,
    memory: Vector,
    t: float,
    h: float,
    start: Vector,
    end: Vector,
    path: Matrix,
    y: Vector,
    there: Vector,
) -> Found:
    """What happens in a step that begins in contact, see `in_flight` for the arguments."""
    renews = p[RENEWS] != 0.0
    d0, r0, push = max(start[DEPTH], 0.0), start[RATE], start[PUSH]
    # a step that begins on a cut and ends beyond it only grazes it; landing would go back to its start
    crosses = abs(push) > CUT_MET
    for n in range(PARTS_CLOSED):
        d1, r1, push_then = end[DEPTH], end[RATE], end[PUSH]
        if n + 1 < PARTS_CLOSED:
            look(p, segment, memory, t, h, (n + 1) / PARTS_CLOSED, path, y, there)
            d1, r1, push_then = there[DEPTH], there[RATE], there[PUSH]
        what, low, high = in_contact(renews, d0, r0, d1, r1, h / PARTS_CLOSED)
        if what == TOO_LONG:
            return TOO_LONG, 0.0, 0.0
        if crosses and (push < 0.0) != (push_then < 0.0):
            # where it is pressed on again the law asks for no tension, so that comes later; a separation may be
            # first
            if what == SEPARATION and h > SHORT:
                return TOO_LONG, 0.0, 0.0
            if what != SEPARATION:
                return CUT, n / PARTS_CLOSED, (n + 1) / PARTS_CLOSED
        if what != NOTHING:
            return what, (n + low) / PARTS_CLOSED, (n + high) / PARTS_CLOSED
        d0, r0, push, crosses = d1, r1, push_then, True
    return NOTHING, 1.0, 1.0


@compiled
def cut_twice(
    p: Vector,
    segment: Vector,
    memory: Vector,
    t: float,
    h: float,
    start: Vector,
    end: Vector,
    path: Matrix,
    y: Vector,
    there: Vector,
) -> bool:
    """Whether the law asks for tension in the midst of a step, but not at its ends, or the reverse."""
    if h <= SHORT or min(start[PUSH], end[PUSH]) > NEAR_CUT:
        return False
    if abs(start[PUSH]) <= CUT_MET or (start[PUSH] < 0.0) != (end[PUSH] < 0.0):
        return False
    for n in range(1, CUT_SAMPLES):
        look(p, segment, memory, t, h, n / CUT_SAMPLES, path, y, there)
        if there[DEPTH] > 0.0 and (there[PUSH] < 0.0) != (start[PUSH] < 0.0):
            return True
    return False


@compiled
def event(
    p: Vector,
    segment: Vector,
    memory: Vector,
    t: float,
    h: float,
    start: Vector,
    end: Vector,
    path: Matrix,
    y: Vector,
    there: Vector,
) -> Found:
    """The first thing that happens to the contact in a step, see `in_flight` for the arguments."""
    if memory[CLOSED] == 0.0:
        return in_flight(p, segment, memory, t, h, start, end, path, y, there)
    if cut_twice(p, segment, memory, t, h, start, end, path, y, there):
        return TOO_LONG, 0.0, 0.0
    return closed(p, segment, memory, t, h, start, end, path, y, there)
