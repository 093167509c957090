"""Which method makes a step: that of order 5, or the stabilised one where decays are fast."""

import math

from support_exudyn.formulations.compiled.stabilised import (
    AT_FIRST,
    FEWEST_STAGES,
    FIRST_PATIENCE,
    LONGEST_PATIENCE,
    RENEWED,
    ROUNDS,
    STIFF_AT,
    advance_stabilised,
    fastest_decay,
    fit_cubic,
    longest,
    stages_for,
)
from support_exudyn.formulations.compiled.step import advance, fit
from support_exudyn.formulations.compiled.step_control import FASTEST, SAFETY, SLOWEST, factor
from support_exudyn.scene.arrays import (
    EVALUATIONS,
    NOT_A_NUMBER,
    STAGES,
    STIFF,
    SceneArrays,
    Scratch,
    Vector,
)
from support_exudyn.scene.compilation import compiled, once

# With what a run goes on: whether it is in the midst of a segment, time, next step, last error; the fastest
# decay, above 0 while steps are stabilised; steps since it was looked for, and after how many it is; how many
# steps have lately been cut where a law begins or ceases to ask for tension, and for how many more none is
MIDST, AT, NEXT_STEP, LAST_ERROR, DECAY, STIFF_STEPS, PATIENCE, CUT_STEPS, UNCUT, GOING = range(10)


@compiled
def factor_of(error: float, before: float, decay: float) -> float:
    """By which the next step may be longer; of the stabilised method, if there is a decay, of order 2."""
    if not decay > 0.0:
        return factor(error, before)
    if not error < 1e30:
        return SLOWEST
    return float(min(FASTEST, max(SLOWEST, SAFETY * max(error, 1e-9) ** (-1.0 / 3.0))))


@compiled
def leave_stabilised(going: Vector, h: float) -> float:
    """Go on by the explicit method; the step [s] that it takes, at most that of its stability."""
    h = min(h, STIFF_AT / going[DECAY])
    going[DECAY] = going[STIFF_STEPS] = 0.0
    return h


@once
def choose_method(
    scene: SceneArrays,
    room: Scratch,
    going: Vector,
    t: float,
    h: float,
    follow: float,
    y: Vector,
    weights: Vector,
    quiet: bool,
    report: Vector,
) -> float:
    """See which method takes the next step, after one of h [s] without an event or with one; its length [s]."""
    if going[DECAY] > 0.0:
        going[STIFF_STEPS] += 1
        if going[STIFF_STEPS] < RENEWED:
            return min(follow, longest(going[DECAY]))
        going[STIFF_STEPS] = 0.0
        report[EVALUATIONS] += ROUNDS
        decay = fastest_decay(scene, t, y, room.rates, room.along, weights, room.right)
        if not STIFF_AT < follow * decay < math.inf or stages_for(follow * decay) < FEWEST_STAGES:
            return leave_stabilised(going, follow)
        going[DECAY], going[PATIENCE] = decay, FIRST_PATIENCE
        return min(follow, longest(decay))
    going[STIFF_STEPS] += 1
    if not quiet or going[STIFF_STEPS] < going[PATIENCE]:
        return follow
    going[STIFF_STEPS] = 0.0
    report[EVALUATIONS] += ROUNDS
    decay = fastest_decay(scene, t, y, room.rates, room.along, weights, room.right)
    if STIFF_AT / h < decay < math.inf:
        going[DECAY] = decay
        going[PATIENCE] = min(2.0 * going[PATIENCE], LONGEST_PATIENCE)
        return AT_FIRST * h
    return follow


@once
def try_step(
    scene: SceneArrays,
    room: Scratch,
    going: Vector,
    t: float,
    h: float,
    y: Vector,
    weights: Vector,
    report: Vector,
) -> float:
    """Try a step of h [s] from t by the method that is on; its error in units of what is allowed."""
    if going[DECAY] > 0.0:
        report[EVALUATIONS] += stages_for(h * going[DECAY])
        report[STIFF] += 1
        error = advance_stabilised(scene, t, h, going[DECAY], y, room.rates, room.end, weights, room.right)
    else:
        report[EVALUATIONS] += STAGES - 1
        error = advance(scene, t, h, y, room.rates, room.end, weights, room.right)
    report[NOT_A_NUMBER] = 1.0 if math.isnan(error) else 0.0
    return error


@once
def fit_step(room: Scratch, decay: float, h: float, y: Vector) -> None:
    """Write the interpolation over a step of h [s] that has been made by the method of this decay."""
    if decay > 0.0:
        fit_cubic(h, y, room.end, room.rates, room.path)
    else:
        fit(h, y, room.end, room.rates, room.path)


@once
def begin_method(room: Scratch, going: Vector, weights: Vector) -> None:
    """At the start: the explicit method, and some direction in which the fastest decay is looked for."""
    if going[PATIENCE] == 0.0:
        going[PATIENCE] = FIRST_PATIENCE
        for i in range(weights.size):
            room.along[i] = (1.0 + 0.1 * (i % 7)) / weights[i]
