"""What happens in legs within a step: a valve opens or closes, a cavity grows or is filled, a stop is met.

Each is a gap that passes zero, see `hydraulics.records`. The force is continuous there and has a kink; only a
relief valve with hysteresis changes what it does. A step that passes a gap is made again so that it ends there.
"""

import math

from support_exudyn.formulations.compilation import compiled, once
from support_exudyn.formulations.compiled.arrays import (
    EVALUATIONS,
    OIL_EVENTS,
    STAGES,
    Matrix,
    SceneArrays,
    Scratch,
    Vector,
)
from support_exudyn.formulations.compiled.step import advance, close_joints, evaluate, within
from support_exudyn.formulations.hydraulics.gaps import met
from support_exudyn.formulations.hydraulics.leg import OPEN
from support_exudyn.formulations.hydraulics.records import RELIEF, YIELD

LOOKS = 40  # for a gap, by false position
PARTS, NARROWER = 8, 16  # of a step that are looked at for a highest place; how often it is closed in then
GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)
NONE, GAP, AT_ONCE = range(3)  # what is found


@compiled
def keep_gaps(scene: SceneArrays, kept: Matrix) -> None:
    """Keep the gaps as they stand in the scene."""
    for n in range(kept.shape[0]):
        for k in range(kept.shape[1]):
            kept[n, k] = scene.gaps[n, k]


@once
def forget_beyond(scene: SceneArrays) -> None:
    """Begin a step: no gap has been passed."""
    for n in range(scene.gaps.shape[0]):
        for k in range(scene.gaps.shape[1]):
            scene.beyond[n, k] = -math.inf


@once
def first_gap(scene: SceneArrays, room: Scratch) -> tuple[int, int, int]:
    """What happens first in legs in a step that has been tried: what, leg, gap."""
    what, leg, gap, first = NONE, -1, -1, 2.0
    for n in range(scene.gaps.shape[0]):
        for k in range(scene.gaps.shape[1]):
            side = scene.sides[n, k]
            end, begin, near = scene.gaps[n, k] * side, room.gaps[n, k] * side, met(k)
            if side == 0.0:
                continue
            if end >= -near:
                continue
            jumped = min(room.gaps[n, k], scene.gaps[n, k]) == OPEN  # where an inlet opens or closes
            if begin <= near or jumped:
                return AT_ONCE, n, k
            at = begin / (begin - end)
            if at < first:
                what, leg, gap, first = GAP, n, k, at
    return what, leg, gap


@compiled
def beyond_at(scene: SceneArrays, room: Scratch, n: int, k: int, t: float, h: float, x: float) -> float:
    """How far a gap of leg n is on the other side at a fraction x of a step of h [s] from t."""
    within(room.path, x, 0, room.probe.size, room.probe)
    close_joints(scene, t + x * h, room.probe, room.right)
    evaluate(scene, t + x * h, room.probe, room.slope, room.right)
    return float(-scene.sides[n, k] * scene.gaps[n, k])


@compiled
def farthest(scene: SceneArrays, room: Scratch, n: int, k: int, t: float, h: float) -> float:
    """The fraction of a step at which a gap is farthest on the other side; 1 if it does not get there."""
    best, at = -math.inf, 1.0
    for part in range(1, PARTS):
        value = beyond_at(scene, room, n, k, t, h, part / PARTS)
        if value > best:
            best, at = value, part / PARTS
    low, high = at - 1.0 / PARTS, at + 1.0 / PARTS
    for _ in range(NARROWER):
        one, two = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        if beyond_at(scene, room, n, k, t, h, one) > beyond_at(scene, room, n, k, t, h, two):
            high = two
        else:
            low = one
    at = 0.5 * (low + high)
    return at if beyond_at(scene, room, n, k, t, h, at) > met(k) else 1.0


@once
def hidden_gap(scene: SceneArrays, room: Scratch, t: float, h: float) -> float:
    """The fraction of a step at which a valve would have jumped that has come back by its end; 1 if none has.

    A valve with hysteresis that opens, or closes, stays so: a pressure that is beyond for a moment matters.
    Looked at are gaps that were nearer to zero at a stage of the step than half of the larger one at its ends.
    """
    found = 1.0
    for n in range(scene.gaps.shape[0]):
        for k in (YIELD, RELIEF):
            jumps = scene.legs[n].jumps if k == YIELD else scene.legs[n].rod_jumps
            end, begin = scene.gaps[n, k] * scene.sides[n, k], room.gaps[n, k] * scene.sides[n, k]
            most = scene.beyond[n, k]
            if jumps == 0 or not end >= -met(k) or not max(begin, end) + 2.0 * most > 0.0:
                continue
            found = min(found, farthest(scene, room, n, k, t, h))
            evaluate(scene, t + h, room.end, room.slope, room.right)
    return found


@once
def land_on_gap(
    scene: SceneArrays,
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

    By false position (Illinois), on the side that it passes to.
    """
    before, after = 0.0, h
    at_before, at_after = room.gaps[n, k], scene.gaps[n, k]
    length, near = h, met(k)
    for _ in range(LOOKS):
        length = (before * at_after - after * at_before) / (at_after - at_before)
        if not before < length < after:
            length = 0.5 * (before + after)
        advance(scene, t, length, y, room.rates, room.end, weights, room.right)
        report[EVALUATIONS] += STAGES - 1
        value = scene.gaps[n, k]
        if abs(value) <= near:
            break
        if (value > 0.0) == (at_before > 0.0):
            before, at_before = length, value
            at_after *= 0.5
        else:
            after, at_after = length, value
            at_before *= 0.5
    return length


@once
def pass_gap(scene: SceneArrays, room: Scratch, n: int, k: int, t: float, report: Vector) -> bool:
    """A gap of leg n passes zero at t [s]: note it, change what a valve remembers; whether there is room."""
    i = int(report[OIL_EVENTS])
    if i >= room.oil_events.shape[0]:
        return False
    scene.sides[n, k] = -scene.sides[n, k]
    leg, opened = scene.legs[n], 1.0 if scene.sides[n, k] > 0.0 else 0.0
    if k == YIELD:
        leg.open = opened
    elif k == RELIEF:
        leg.rod_open = opened
    row = room.oil_events[i]
    row[0], row[1], row[2], row[3] = t, n, k, scene.sides[n, k]
    report[OIL_EVENTS] += 1
    return True
