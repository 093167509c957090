"""What happens to the contact within a step that has been tried, and where.

A step is looked at in parts. Over a part the depth is the cubic that fits depth and rate at both ends; where
that leaves in doubt whether something happens, the step is too long, and is made again shorter.
"""

import math

from support_exudyn.formulations.compilation import compiled
from support_exudyn.formulations.compiled.closed_forms.equations import observe, within
from support_exudyn.formulations.compiled.closed_forms.layout import (
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
from support_exudyn.formulations.compiled.depth import (
    CUT,
    CUT_MET,
    CUT_SAMPLES,
    IMPACT,
    NEAR_CUT,
    NOTHING,
    PARTS,
    PARTS_CLOSED,
    SEPARATION,
    SHORT,
    TOO_LONG,
    Found,
    in_contact,
    rise,
)


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
