"""What happens to the contact within a step that has been tried, and where.

Between two points of a step the depth is the cubic that fits depth and rate at both.
"""

from __future__ import annotations

import math

from support_exudyn.compiled import compiled
from support_exudyn.reduced.drive import Matrix, Vector
from support_exudyn.reduced.equations import observe
from support_exudyn.reduced.layout import BY_DEPTH, CLEARANCE, DEPTH, OFFSET_X, OFFSET_Y, PUSH, RATE, TOUCHING
from support_exudyn.reduced.runge_kutta import within

# RETURN: pressed on again without having parted. CUT: the law begins or ceases to ask for tension
NOTHING, TOUCH, PARTING, RETURN, CUT, TOO_LONG = range(6)
SAMPLES = 8  # of a cubic, when a change of sign is looked for
PARTS = 4  # of a step in free flight
SHORT = 1e-9  # [s]: a contact that ends within so short a step is let go at its end
CUT_MET = 1e-9  # PUSH, of the order of 1, at which a cut of tension is met; the force has only a kink there
AT_ZERO = 1e-13  # depth [m] that is a touch or parting just made; those are met to a tenth of it
Found = tuple[int, float, float]  # what, and fractions of the step between which it happens


@compiled
def cubic(d0: float, r0: float, d1: float, r1: float, h: float, x: float) -> float:
    """Depth [m] at fraction x of a time h [s] from depths [m] and rates [m/s] at both ends."""
    z = 1.0 - x
    return d0 * (1.0 + 2.0 * x) * z * z + h * r0 * x * z * z + d1 * x * x * (3.0 - 2.0 * x) - h * r1 * x * x * z


@compiled
def turning_point(d0: float, r0: float, d1: float, r1: float, h: float) -> float:
    """Fraction at which the cubic's rate passes zero, its signs at both ends being different."""
    low, high = 0.0, 1.0
    for _ in range(30):
        x = 0.5 * (low + high)
        slope = (
            6.0 * x * (1.0 - x) * (d1 - d0) / h + r0 * (1.0 - x) * (1.0 - 3.0 * x) + r1 * x * (3.0 * x - 2.0)
        )
        if (slope > 0.0) == (r0 > 0.0):
            low = x
        else:
            high = x
    return 0.5 * (low + high)


@compiled
def parting(d0: float, r0: float, d1: float, r1: float, h: float) -> Found:
    """The first way out of a contact that is open at the end of a step."""
    inside = 0.0 if d0 > AT_ZERO or r0 < 0.0 else -1.0
    for n in range(1, SAMPLES + 1):
        x = n / SAMPLES
        if cubic(d0, r0, d1, r1, h, x) > 0.0:
            inside = x
        elif inside >= 0.0:
            return PARTING, inside, x
    return (PARTING, 1.0, 1.0) if h <= SHORT else (TOO_LONG, 0.0, 0.0)


@compiled
def in_contact(by_depth: bool, d0: float, r0: float, d1: float, r1: float, h: float) -> Found:
    """What happens in a step that begins in contact."""
    if d1 <= 0.0:
        return parting(d0, r0, d1, r1, h)
    if r0 < 0.0 < r1:
        x = turning_point(d0, r0, d1, r1, h)
        if cubic(d0, r0, d1, r1, h, x) <= 0.0:
            return PARTING, 0.0, x
        if by_depth:
            return RETURN, x, x
    return NOTHING, 1.0, 1.0


@compiled
def rise(d0: float, r0: float, d1: float, r1: float, h: float) -> Found:
    """The first touch of a journal that is free at the start of a part of a step; fractions of that part."""
    top = 1.0
    if d1 <= 0.0:
        if not r0 > 0.0 > r1:
            return NOTHING, 1.0, 1.0
        top = turning_point(d0, r0, d1, r1, h)
        if cubic(d0, r0, d1, r1, h, top) <= 0.0:
            return NOTHING, 1.0, 1.0
    low = 0.0
    apart = d0 < -AT_ZERO or r0 > 0.0  # else the surfaces have just parted and must be seen apart first
    for n in range(1, SAMPLES + 1):
        x = top * n / SAMPLES
        if cubic(d0, r0, d1, r1, h, x) > 0.0:
            return (TOUCH, low, x) if apart or h <= SHORT else (TOO_LONG, 0.0, 0.0)
        low, apart = x, True
    return TOUCH, low, top


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
    part = 1.0 / PARTS
    d0, r0 = min(start[DEPTH], 0.0), start[RATE]
    for n in range(PARTS):
        if n + 1 < PARTS:
            x = (n + 1) * part
            within(path, x, y)
            observe(p, segment, memory, t + x * h, y, there)
            d1, r1 = there[DEPTH], there[RATE]
        else:
            d1, r1 = end[DEPTH], end[RATE]
        what, low, high = rise(d0, r0, d1, r1, part * h)
        if what == TOO_LONG:
            return TOO_LONG, 0.0, 0.0
        if what == TOUCH:
            return TOUCH, (n + low) * part, (n + high) * part
        d0, r0 = d1, r1
    return NOTHING, 1.0, 1.0


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
    if memory[TOUCHING] != 0.0:
        # a step that begins on a cut and ends beyond it only grazes it; landing would go back to its start
        if abs(start[PUSH]) > CUT_MET and (start[PUSH] < 0.0) != (end[PUSH] < 0.0):
            return CUT, 0.0, 1.0
        depth = max(start[DEPTH], 0.0)
        return in_contact(p[BY_DEPTH] != 0.0, depth, start[RATE], end[DEPTH], end[RATE], h)
    return in_flight(p, segment, memory, t, h, start, end, path, y, there)
