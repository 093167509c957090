"""What happens in legs within a step: a valve opens or closes, a cavity grows or is filled, a stop is met.

Each is a gap that passes zero, see `hydraulics.records`. The force is continuous there and has a kink; only a
relief valve with hysteresis changes what it does. A step that passes a gap is made again so that it ends there.
Without legs nothing happens, and the code for it is not compiled, see `SceneArrays`.
"""

import math

from support_exudyn.formulations.compiled.step import advance, close_joints, evaluate, within
from support_exudyn.scene.arrays import (
    EVALUATIONS,
    OIL_EVENTS,
    STAGES,
    LegArrays,
    SceneArrays,
    Scratch,
    Vector,
)
from support_exudyn.scene.compilation import compiled
from support_exudyn.scene.hydraulics.flows import OPEN
from support_exudyn.scene.hydraulics.gaps import met
from support_exudyn.scene.hydraulics.records import RELIEF, YIELD
from user_forces.roots import PEAK_LOOKS, Bracket, StepPeak, narrowed, peak_place, peak_with, zero_of

LOOKS = 40  # for a gap, by false position
NONE, GAP, AT_ONCE = range(3)  # what is found


@compiled
def keep_gaps(legs: LegArrays | None) -> None:
    """Keep the gaps as they stand in the scene."""
    if legs is None:
        return
    for n in range(legs.gaps.shape[0]):
        for k in range(legs.gaps.shape[1]):
            legs.before[n, k] = legs.gaps[n, k]


@compiled
def forget_beyond(legs: LegArrays | None) -> None:
    """Begin a step: no gap has been passed."""
    if legs is None:
        return
    for n in range(legs.gaps.shape[0]):
        for k in range(legs.gaps.shape[1]):
            legs.beyond[n, k] = -math.inf


@compiled
def first_gap(legs: LegArrays | None) -> tuple[int, int, int]:
    """What happens first in legs in a step that has been tried: what, leg, gap."""
    what, leg, gap, first = NONE, -1, -1, 2.0
    if legs is None:
        return what, leg, gap
    for n in range(legs.gaps.shape[0]):
        for k in range(legs.gaps.shape[1]):
            side = legs.sides[n, k]
            end, begin, near = legs.gaps[n, k] * side, legs.before[n, k] * side, met(k)
            if side == 0.0:
                continue
            if end >= -near:
                continue
            jumped = min(legs.before[n, k], legs.gaps[n, k]) == OPEN  # where an inlet opens or closes
            if begin <= near or jumped:
                return AT_ONCE, n, k
            at = begin / (begin - end)
            if at < first:
                what, leg, gap, first = GAP, n, k, at
    return what, leg, gap


@compiled
def beyond_at(
    scene: SceneArrays, legs: LegArrays, room: Scratch, n: int, k: int, t: float, h: float, x: float
) -> float:
    """How far a gap of leg n is on the other side at a fraction x of a step of h [s] from t."""
    within(room.path, x, 0, room.probe.size, room.probe)
    close_joints(scene, t + x * h, room.probe, room.right)
    evaluate(scene, t + x * h, room.probe, room.slope, room.right)
    return float(-legs.sides[n, k] * legs.gaps[n, k])


@compiled
def hidden_gap(scene: SceneArrays, legs: LegArrays | None, room: Scratch, t: float, h: float) -> float:
    """The fraction of a step at which a valve would have jumped that has come back by its end; 1 if none has.

    A valve with hysteresis that opens, or closes, stays so: a pressure that is beyond for a moment matters.
    Looked at are gaps that were nearer to zero at a stage of the step than half of the larger one at its ends.
    """
    found = 1.0
    if legs is None:
        return found
    for n in range(legs.gaps.shape[0]):
        for k in (YIELD, RELIEF):
            jumps = legs.records[n].jumps if k == YIELD else legs.records[n].rod_jumps
            end, begin = legs.gaps[n, k] * legs.sides[n, k], legs.before[n, k] * legs.sides[n, k]
            most = legs.beyond[n, k]
            if jumps == 0 or not end >= -met(k) or not max(begin, end) + 2.0 * most > 0.0:
                continue
            peak = StepPeak(-math.inf, 0.0, 0.0, 1.0)
            for look in range(PEAK_LOOKS):
                x = peak_place(peak, look)
                peak = peak_with(peak, look, x, beyond_at(scene, legs, room, n, k, t, h, x))
            found = min(found, peak.at if peak.top > met(k) else 1.0)
            evaluate(scene, t + h, room.end, room.slope, room.right)
    return found


@compiled
def land_on_gap(
    scene: SceneArrays,
    legs: LegArrays | None,
    room: Scratch,
    n: int,
    k: int,
    t: float,
    h: float,
    y: Vector,
    weights: Vector,
    report: Vector,
) -> float:
    """Make a step of h [s] again so that it ends where a gap of leg n passes zero; its length [s].

    By false position, on the side that it passes to.
    """
    if legs is None:
        return h
    bracket, length = Bracket(0.0, h, legs.before[n, k], legs.gaps[n, k]), h
    for _ in range(LOOKS):
        length = zero_of(bracket)
        advance(scene, t, length, y, room.rates, room.end, weights, room.right)
        report[EVALUATIONS] += STAGES - 1
        if abs(legs.gaps[n, k]) <= met(k):
            break
        bracket = narrowed(bracket, length, legs.gaps[n, k])
    return length


@compiled
def pass_gap(legs: LegArrays | None, n: int, k: int, t: float, report: Vector) -> bool:
    """A gap of leg n passes zero at t [s]: note it, change what a valve remembers; whether there is room."""
    if legs is None:
        return False
    i = int(report[OIL_EVENTS])
    if i >= legs.events.shape[0]:
        return False
    legs.sides[n, k] = -legs.sides[n, k]
    leg, opened = legs.records[n], 1.0 if legs.sides[n, k] > 0.0 else 0.0
    if k == YIELD:
        leg.open = opened
    elif k == RELIEF:
        leg.rod_open = opened
    row = legs.events[i]
    row[0], row[1], row[2], row[3] = t, n, k, legs.sides[n, k]
    report[OIL_EVENTS] += 1
    return True
