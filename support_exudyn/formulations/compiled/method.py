"""Which method makes a step: that of order 5, or the stabilised one where decays are fast."""

import math

from support_exudyn.formulations.compiled.stabilised import (
    AT_FIRST,
    PATIENCE,
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
    DECAY,
    EVALUATIONS,
    EXPLICIT_STEP,
    NOT_A_NUMBER,
    STAGES,
    STIFF,
    STIFF_STEPS,
    SceneArrays,
    Scratch,
    Vector,
)
from support_exudyn.scene.compilation import compiled, once


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
    scene: SceneArrays, room: Scratch, t: float, h: float, follow: float, y: Vector, quiet: bool
) -> float:
    """Choose the method of the next step, after one of h [s]; its length [s].

    follow: that length by the error of the last step. quiet: whether the last step ended without an event.
    """
    going = room.going
    going[STIFF_STEPS] += 1
    decay = going[DECAY]
    stabilised = decay > 0.0
    if stabilised and follow * (STAGES - 1) < going[EXPLICIT_STEP] * stages_for(follow * decay):
        return leave_stabilised(going, follow)  # the explicit method needs fewer evaluations
    if going[STIFF_STEPS] < (RENEWED if stabilised else PATIENCE) or not (stabilised or quiet):
        return min(follow, longest(decay)) if stabilised else follow
    going[STIFF_STEPS] = 0.0
    room.report[EVALUATIONS] += ROUNDS
    decay = fastest_decay(scene, t, y, room.rates, room.along, room.weights, room.right)
    if stabilised:
        if not STIFF_AT < follow * decay < math.inf:
            return leave_stabilised(going, follow)
        follow = min(follow, longest(decay))
    elif STIFF_AT < max(h, follow) * decay < math.inf:
        going[EXPLICIT_STEP], follow = h, AT_FIRST * h
    else:
        return follow
    going[DECAY] = decay
    return follow


@once
def try_step(scene: SceneArrays, room: Scratch, t: float, h: float, y: Vector) -> float:
    """Try a step of h [s] from t by the method that is on; its error in units of what is allowed."""
    decay, report = room.going[DECAY], room.report
    if decay > 0.0:
        report[EVALUATIONS] += stages_for(h * decay)
        report[STIFF] += 1
        error = advance_stabilised(scene, t, h, decay, y, room.rates, room.end, room.weights, room.right)
    else:
        report[EVALUATIONS] += STAGES - 1
        error = advance(scene, t, h, y, room.rates, room.end, room.weights, room.right)
    report[NOT_A_NUMBER] = 1.0 if math.isnan(error) else 0.0
    return error


@once
def fit_step(room: Scratch, decay: float, h: float, y: Vector) -> None:
    """Write the interpolation over a step of h [s] that has been made by the method of this decay."""
    if decay > 0.0:
        fit_cubic(h, y, room.end, room.rates, room.path)
    else:
        fit(h, y, room.end, room.rates, room.path)
