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
from support_exudyn.scene.arrays import STAGES, SceneArrays, Scratch, Vector
from support_exudyn.scene.compilation import compiled, once

SAFETY, SLOWEST, FASTEST = 0.9, 0.2, 8.0  # change of the step: margin, smallest and largest factor
STEADY = 0.04  # weight of the last error in the choice of a step (Gustafsson), against hunting
ORDER = 0.2 - 0.75 * STEADY


@compiled
def factor_of(error: float, before: float, decay: float) -> float:
    """By which the next step may be longer than one with this error, in units of what is allowed.

    before: the error before. decay: above 0 of the stabilised method, which is of order 2.
    """
    if not error < 1e30:
        return SLOWEST
    if not decay > 0.0:
        wanted: float = SAFETY * max(error, 1e-9) ** -ORDER * before**STEADY
    else:
        wanted = SAFETY * max(error, 1e-9) ** (-1.0 / 3.0)
    return float(min(FASTEST, max(SLOWEST, wanted)))


@compiled
def factor_over_corner(error: float) -> float:
    """By which a step is shorter that is made again because of a corner within it: an error of order 2."""
    return max(SLOWEST, SAFETY / math.sqrt(error)) if error < 1e30 else SLOWEST


@compiled
def leave_stabilised(room: Scratch, h: float) -> float:
    """Go on by the explicit method; the step [s] that it takes, at most that of its stability."""
    going = room.going[0]
    h = min(h, STIFF_AT / going.decay)
    going.decay = going.stiff_steps = 0.0
    return h


@once
def choose_method(
    scene: SceneArrays, room: Scratch, t: float, h: float, follow: float, y: Vector, quiet: bool
) -> float:
    """Choose the method of the next step, after one of h [s]; its length [s].

    follow: that length by the error of the last step. quiet: whether the last step ended without an event.
    """
    going = room.going[0]
    going.stiff_steps += 1
    decay = going.decay
    stabilised = decay > 0.0
    if stabilised and follow * (STAGES - 1) < going.explicit_step * stages_for(follow * decay):
        return leave_stabilised(room, follow)  # the explicit method needs fewer evaluations
    if going.stiff_steps < (RENEWED if stabilised else PATIENCE) or not (stabilised or quiet):
        return min(follow, longest(decay)) if stabilised else follow
    going.stiff_steps = 0.0
    room.report[0].evaluations += ROUNDS
    decay = fastest_decay(scene, t, y, room.rates, room.along, room.weights, room.right)
    if stabilised:
        if not STIFF_AT < follow * decay < math.inf:
            return leave_stabilised(room, follow)
        follow = min(follow, longest(decay))
    elif STIFF_AT < max(h, follow) * decay < math.inf:
        going.explicit_step, follow = h, AT_FIRST * h
    else:
        return follow
    going.decay = decay
    return follow


@once
def try_step(scene: SceneArrays, room: Scratch, t: float, h: float, y: Vector) -> float:
    """Try a step of h [s] from t by the method that is on; its error in units of what is allowed."""
    decay, report = room.going[0].decay, room.report[0]
    if decay > 0.0:
        report.evaluations += stages_for(h * decay)
        report.stiff += 1
        error = advance_stabilised(scene, t, h, decay, y, room.rates, room.end, room.weights, room.right)
    else:
        report.evaluations += STAGES - 1
        error = advance(scene, t, h, y, room.rates, room.end, room.weights, room.right)
    report.not_a_number = 1.0 if math.isnan(error) else 0.0
    return error


@once
def fit_step(room: Scratch, decay: float, h: float, y: Vector) -> None:
    """Write the interpolation over a step of h [s] that has been made by the method of this decay."""
    if decay > 0.0:
        fit_cubic(h, y, room.end, room.rates, room.path)
    else:
        fit(h, y, room.end, room.rates, room.path)
