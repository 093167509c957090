"""What happens in legs within a step: a valve opens or closes, a cavity grows or is filled, a stop is met.

Each is a gap that passes zero, see `hydraulics.records`. The force is continuous there and has a kink; only a
relief valve with hysteresis changes what it does. A step that passes a gap is made again so that it ends there.
"""

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
from support_exudyn.formulations.compiled.step import advance
from support_exudyn.formulations.hydraulics.leg import OPEN
from support_exudyn.formulations.hydraulics.records import LOW, RELIEF, YIELD

MET_PRESSURE, MET_LENGTH = 0.01, 1e-13  # [Pa], [m] from zero at which a gap is met
LOOKS = 40  # for a gap, by false position
NONE, GAP, AT_ONCE, TOO_FAR = range(4)  # what is found


@compiled
def met(k: int) -> float:
    """How near to zero a gap is met."""
    return MET_LENGTH if k >= LOW and k <= LOW + 3 else MET_PRESSURE


@once
def begin_gaps(scene: SceneArrays) -> None:
    """At the start: on which side of zero each gap is, 0 for those that a leg does not have."""
    for n in range(scene.gaps.shape[0]):
        for k in range(scene.gaps.shape[1]):
            gap = scene.gaps[n, k]
            scene.sides[n, k] = 0.0 if gap == 0.0 else (1.0 if gap > 0.0 else -1.0)


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
            scene.beyond[n, k] = 0.0


@once
def first_gap(scene: SceneArrays, room: Scratch) -> tuple[int, int, int]:
    """What happens first in legs in a step that has been tried: what, leg, gap.

    A gap with hysteresis that has been passed in between, but not at the end, asks for a shorter step.
    """
    what, leg, gap, first = NONE, -1, -1, 2.0
    for n in range(scene.gaps.shape[0]):
        for k in range(scene.gaps.shape[1]):
            side = scene.sides[n, k]
            end, begin, near = scene.gaps[n, k] * side, room.gaps[n, k] * side, met(k)
            if side == 0.0:
                continue
            if end >= -near:
                jumps = (k == YIELD and scene.legs[n].jumps != 0) or (
                    k == RELIEF and scene.legs[n].rod_jumps != 0
                )
                if jumps and scene.beyond[n, k] > near:
                    return TOO_FAR, n, k
                continue
            jumped = min(room.gaps[n, k], scene.gaps[n, k]) == OPEN  # where an inlet opens or closes
            if begin <= near or jumped:
                return AT_ONCE, n, k
            at = begin / (begin - end)
            if at < first:
                what, leg, gap, first = GAP, n, k, at
    return what, leg, gap


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
