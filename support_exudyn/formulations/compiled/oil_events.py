"""What happens in legs within a step: a valve opens or closes, a cavity grows or is filled, a stop is met.

Each is a gap that passes zero, see `hydraulics.records`. The force is continuous there and has a kink; only a
relief valve with hysteresis changes what it does. A step that passes a gap is made again so that it ends there.
Without legs nothing happens, and the code for it is not compiled, see `SceneArrays`.
"""

import math

from support_exudyn.formulations.compiled.step import advance, close_joints, evaluate, within
from support_exudyn.model.hydraulics.valves import SHUT
from support_exudyn.scene.arrays import STAGES, SceneArrays, Scratch, Vector
from support_exudyn.scene.compilation import compiled
from support_exudyn.scene.hydraulics.records import LegArrays
from user_forces.roots import PEAK_LOOKS, Bracket, StepPeak, narrowed, peak_place, peak_with, zero_of

LOOKS = 40  # for a gap, by false position
NONE, GAP, AT_ONCE = range(3)  # what is found


@compiled
def keep_gaps(legs: LegArrays | None) -> None:
    """Keep the gaps as they stand in the scene."""
    if legs is not None:
        for k in range(legs.gaps.size):
            legs.gaps[k].before = legs.gaps[k].now


@compiled
def forget_beyond(legs: LegArrays | None) -> None:
    """Begin a step: no gap has been passed."""
    if legs is not None:
        for k in range(legs.gaps.size):
            legs.gaps[k].beyond = -math.inf


@compiled
def first_gap(legs: LegArrays | None) -> tuple[int, int]:
    """What happens first in legs in a step that has been tried: what, and which gap."""
    what, first_of_all, first = NONE, -1, 2.0
    if legs is None:
        return what, first_of_all
    for k in range(legs.gaps.size):
        gap = legs.gaps[k]
        end, begin = gap.now * gap.side, gap.before * gap.side
        if gap.side == 0.0 or end >= -gap.near:
            continue
        jumped = min(gap.before, gap.now) == SHUT  # where an inlet opens or closes
        if begin <= gap.near or jumped:
            return AT_ONCE, k
        at = begin / (begin - end)
        if at < first:
            what, first_of_all, first = GAP, k, at
    return what, first_of_all


@compiled
def beyond_at(
    scene: SceneArrays, legs: LegArrays, room: Scratch, k: int, t: float, h: float, x: float
) -> float:
    """How far a gap is on the other side at a fraction x of a step of h [s] from t."""
    within(room.path, x, 0, room.probe.size, room.probe)
    close_joints(scene, t + x * h, room.probe, room.right)
    evaluate(scene, t + x * h, room.probe, room.slope, room.right)
    return float(-legs.gaps[k].side * legs.gaps[k].now)


@compiled
def hidden_gap(scene: SceneArrays, legs: LegArrays | None, room: Scratch, t: float, h: float) -> float:
    """The fraction of a step at which a valve would have jumped that has come back by its end; 1 if none has.

    A valve with hysteresis that opens, or closes, stays so: a pressure that is beyond for a moment matters.
    Looked at are gaps that were nearer to zero at a stage of the step than half of the larger one at its ends.
    """
    found = 1.0
    if legs is None:
        return found
    for k in range(legs.gaps.size):
        gap = legs.gaps[k]
        if gap.valve < 0 or legs.valves[gap.valve].jumps == 0:
            continue
        end, begin, most = gap.now * gap.side, gap.before * gap.side, gap.beyond
        if not end >= -gap.near or not max(begin, end) + 2.0 * most > 0.0:
            continue
        peak = StepPeak(-math.inf, 0.0, 0.0, 1.0)
        for look in range(PEAK_LOOKS):
            x = peak_place(peak, look)
            peak = peak_with(peak, look, x, beyond_at(scene, legs, room, k, t, h, x))
        found = min(found, peak.at if peak.top > gap.near else 1.0)
        evaluate(scene, t + h, room.end, room.slope, room.right)
    return found


@compiled
def land_on_gap(
    scene: SceneArrays, legs: LegArrays | None, room: Scratch, k: int, t: float, h: float, y: Vector
) -> float:
    """Make a step of h [s] again so that it ends where a gap of a leg passes zero; its length [s].

    By false position, on the side that it passes to.
    """
    if legs is None:
        return h
    bracket, length = Bracket(0.0, h, legs.gaps[k].before, legs.gaps[k].now), h
    for _ in range(LOOKS):
        length = zero_of(bracket)
        advance(scene, t, length, y, room.rates, room.end, room.weights, room.right)
        room.report[0].evaluations += STAGES - 1
        if abs(legs.gaps[k].now) <= legs.gaps[k].near:
            break
        bracket = narrowed(bracket, length, legs.gaps[k].now)
    return length


@compiled
def pass_gap(legs: LegArrays | None, room: Scratch, k: int, t: float) -> bool:
    """A gap passes zero at t [s]: note it, change what a valve remembers; whether there is room."""
    if legs is None:
        return False
    i, gap = int(room.report[0].oil_events), legs.gaps[k]
    if i >= room.oil_events.shape[0]:
        return False
    gap.side = -gap.side
    if gap.valve >= 0:
        legs.valves[gap.valve].memory = 1.0 if gap.side > 0.0 else 0.0
    row = room.oil_events[i]
    row[0], row[1], row[2] = t, k, gap.side
    room.report[0].oil_events += 1
    return True
