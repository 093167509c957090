"""The run of a support with a clearance pin: steps of chosen length, cut at impacts and separations."""

import math

import numpy as np

from support_exudyn.formulations.compilation import compiled, entry
from support_exudyn.formulations.compiled.closed_forms.equations import (
    STAGES,
    advance,
    evaluate,
    fit,
    freeze_inverse_mass,
    impact_velocity,
    move_with_the_drive,
    within,
)
from support_exudyn.formulations.compiled.closed_forms.events import event
from support_exudyn.formulations.compiled.closed_forms.layout import (
    ASKED_DEPTH,
    BEGIN,
    CLOSED,
    CONTACT,
    DEPTH,
    END,
    FORGETS,
    IMPACT_VELOCITY,
    JUMP,
    NEARNESS,
    PUSH,
    RATE,
    RENEWS,
    SINE,
    STATES,
    SWIFTNESS,
    Matrix,
    Vector,
)
from support_exudyn.formulations.compiled.closed_forms.records import peak, record, size
from support_exudyn.formulations.compiled.closed_forms.support import jump
from support_exudyn.formulations.compiled.depth import (
    CUT,
    CUT_MET,
    IMPACT,
    NOTHING,
    RETURN,
    SEPARATION,
    TOO_LONG,
)
from support_exudyn.formulations.compiled.step_control import (
    CLOSE,
    LANDED,
    LANDINGS,
    SHORTEN,
    SMALLEST_STEP,
    TURNS,
    crossing,
    factor,
)

FINISHED, STUCK, TOO_MANY_STEPS, TOO_MANY_IMPACTS, DEAD_CENTRE, PAUSED = range(6)
# what is reported of a run
STEPS, EVALUATIONS, LARGEST, STOPPED_AT, IMPACTS, JUMPS, LAST_STEP, NOT_A_NUMBER, RECORDS = range(9)
ACCEPTED, CUTS, CLAMPED = range(9, 12)  # steps: accepted, cut to end at an event, that end in tension
LARGEST_AT, REPORT = range(12, 14)  # end of the step with the largest force [s]
# With what a run goes on after a pause: whether it is in the midst of a segment, time [s], next step [s], last
# error, and of the last step's end the rate of the state and the contact
MIDST, AT, NEXT_STEP, LAST_ERROR, RATES = range(5)
CONTEXT = RATES + STATES
GOING = CONTEXT + CONTACT

SMALLEST_SINE = 0.01  # of the angles that vanish at a dead centre: nearer to it the run is given up
SHARE_OF_WAY = 0.5  # of the way to a dead centre is the longest step, so that none is stepped over


@compiled
def land(
    p: Vector,
    segment: Vector,
    memory: Vector,
    t: float,
    h: float,
    what: int,
    low: float,
    high: float,
    start: Vector,
    y: Vector,
    k: Matrix,
    end: Vector,
    contact: Vector,
    weights: Vector,
    report: Vector,
) -> float:
    """Make a step of h [s] again so that it ends where something happens, see `event`; its length [s].

    An impact or separation is met by Newton's method on the depth at the end of the step, kept by bisection
    where it was seen. A cut of tension is met by false position (Illinois) on PUSH: while tension is cut there
    is no force, steps grow, and one would miss where the force sets in again. Where a contact is pressed on
    again, false position on the rate begins at the guess `high`. One loop for all, so that a step is compiled
    into it once.

    Arguments:
        start: the contact at the start of the step; `contact` is that at its end.
    """
    quantity, met, looks = DEPTH, LANDED, LANDINGS
    if what == CUT:
        quantity, met = PUSH, CUT_MET
    elif what == RETURN:
        quantity, met, looks = RATE, 0.0, TURNS
    before, after, at_before, at_after = 0.0, h, start[quantity], contact[quantity]
    if what == CUT:
        length = crossing(before, after, at_before, at_after)
    elif what == RETURN:
        length = high * h
    else:
        before, after = low * h, high * h
        length = 0.5 * (before + after)
    for n in range(1, looks + 1):
        advance(p, segment, memory, t, length, y, k, end, contact, weights)
        report[EVALUATIONS] += STAGES - 1
        value = contact[quantity]
        if abs(value) <= met or n == looks:
            break
        if what in (CUT, RETURN):
            keep = 0.5 if what == CUT else 1.0
            if (value < 0.0) == (at_before < 0.0):
                before, at_before = length, value
                at_after *= keep
            else:
                after, at_after = length, value
                at_before *= keep
            length = crossing(before, after, at_before, at_after)
            continue
        if (value > 0.0) == (what == IMPACT):
            after = max(length, before)
        else:
            before = min(length, after)
        following = length - value / contact[RATE]
        # the step made again may differ from what was seen by its error, so a little more is allowed
        if not before - 0.1 * h < following < after + 0.1 * h or following <= 0.0:
            following = 0.5 * (before + after)
        if following == length:
            break
        length = following
    return length


@compiled
def happen(p: Vector, what: int, t: float, rate: float, memory: Vector, onsets: Matrix, report: Vector) -> bool:
    """Change the memory as an event at t [s] at a rate of depth [m/s] does; whether there is room for it."""
    if what == SEPARATION or (what == RETURN and p[FORGETS] != 0.0):
        memory[IMPACT_VELOCITY] = 0.0
    n = int(report[IMPACTS])
    if what == SEPARATION:
        memory[CLOSED] = 0.0
        onsets[n - 1, 2], onsets[n - 1, 3] = t, max(0.0, -rate)
    elif what == IMPACT:
        if n >= onsets.shape[0]:
            return False
        memory[CLOSED], memory[IMPACT_VELOCITY] = 1.0, max(0.0, rate)
        onsets[n, 0], onsets[n, 1], onsets[n, 2], onsets[n, 3] = t, memory[IMPACT_VELOCITY], math.inf, 0.0
        report[IMPACTS] += 1
    return True


@compiled
def write_records(
    segment: Vector,
    memory: Vector,
    t: float,
    h: float,
    until: float,
    path: Matrix,
    times: Vector,
    rows: Matrix,
    y: Vector,
    report: Vector,
) -> None:
    """Write the records within a step of h [s] from t, up to `until` [s]; y is overwritten."""
    n = int(report[RECORDS])
    while n < times.size and times[n] <= until:
        within(path, min(1.0, (times[n] - t) / h), y)
        record(segment, memory, times[n], y, rows, n)
        n += 1
    report[RECORDS] = n


@entry
def integrate(
    p: Vector,
    segment: Vector,
    times: Vector,
    weights: Vector,
    going: Vector,
    most_steps: int,
    pause: int,
    y: Vector,
    memory: Vector,
    rows: Matrix,
    onsets: Matrix,
    jumps: Matrix,
    report: Vector,
) -> int:
    """Run to the end of a segment of the drive, from its start or from a pause; FINISHED, or why not.

    Arguments:
        p: parameters. segment: of the drive. See `layout` for both.
        times: of the records [s], from 0.
        weights: one over the largest error of a step, for each component.
        going: zeros with the first step in NEXT_STEP; after a segment or a pause as it was left.
        most_steps: before giving up. pause: after so many steps it returns PAUSED, to be called again.
        y, memory: state and memory at the start; at the end when it returns.
        rows, onsets, jumps, report: are filled.
    """
    k, path = np.empty((STAGES, STATES)), np.empty((5, STATES))
    end, probe, near = np.empty(STATES), np.empty(STATES), np.empty(NEARNESS)
    now, then, there = np.empty(CONTACT), np.empty(CONTACT), np.empty(CONTACT)
    h, error_before = going[NEXT_STEP], 1e-4
    t, stop = segment[BEGIN], segment[END]
    if going[MIDST] != 0.0:
        t, error_before = going[AT], going[LAST_ERROR]
        for i in range(STATES):
            k[0, i] = going[RATES + i]
        for i in range(CONTACT):
            now[i] = going[CONTEXT + i]
    else:
        if report[RECORDS] == 0.0:
            # a drive that moves from the start on without a jump has been moving for long
            if segment[JUMP] == 0.0:
                move_with_the_drive(p, segment, 0.0, y)
            freeze_inverse_mass(p, segment, memory, 0.0, y)
            record(segment, memory, 0.0, y, rows, int(report[RECORDS]))
            report[RECORDS] = 1.0
        if segment[JUMP] != 0.0:
            jump(p, segment, y, jumps, int(report[JUMPS]))
            report[JUMPS] += 1
        evaluate(p, segment, memory, t, y, k[0], now)
    while t < stop:
        if report[STEPS] >= pause:
            going[MIDST], going[AT], going[NEXT_STEP], going[LAST_ERROR] = 1.0, t, h, error_before
            for i in range(STATES):
                going[RATES + i] = k[0, i]
            for i in range(CONTACT):
                going[CONTEXT + i] = now[i]
            return PAUSED
        report[STEPS] += 1
        report[STOPPED_AT], report[LAST_STEP] = t, h
        if report[STEPS] > most_steps:
            return TOO_MANY_STEPS
        if h < SMALLEST_STEP:
            return STUCK
        wanted = h
        last = h >= 0.999999 * (stop - t)
        if last:
            h = stop - t
        error = advance(p, segment, memory, t, h, y, k, end, then, weights)
        report[EVALUATIONS] += STAGES - 1
        report[NOT_A_NUMBER] = 1.0 if math.isnan(error) else 0.0
        if not error <= 1.0:
            h *= min(factor(error, 1.0), 1.0)
            continue
        impact_velocity(p, segment, t + h, end, near)
        if near[SINE] < SMALLEST_SINE:
            return DEAD_CENTRE
        fit(h, y, end, k, path)
        what, low, high = event(p, segment, memory, t, h, now, then, path, probe, there)
        if what == TOO_LONG or h * near[SWIFTNESS] > SHARE_OF_WAY:
            h *= SHORTEN
            continue
        follow = wanted if last else h * factor(error, error_before)
        error_before = max(error, 1e-4)
        was_cut = now[PUSH] < 0.0
        if what != NOTHING and low < 1.0:
            h = land(p, segment, memory, t, h, what, low, high, now, y, k, end, then, weights, report)
            fit(h, y, end, k, path)
            last = h >= stop - t
        if memory[CLOSED] != 0.0:
            first, final = size(now), size(then)
            highest, at = peak(p, segment, memory, t, h, path, report[LARGEST], first, final, probe, there)
            if highest > report[LARGEST]:
                report[LARGEST], report[LARGEST_AT] = highest, at
        report[ACCEPTED] += 1
        memory[ASKED_DEPTH] = 0.0
        report[CUTS] += what not in (NOTHING, RETURN)
        report[CLAMPED] += then[PUSH] < 0.0
        until = stop + CLOSE if last else t + h
        write_records(segment, memory, t, h, until, path, times, rows, probe, report)
        t = stop if last else t + h
        for i in range(STATES):
            y[i] = end[i]
        if what == NOTHING:
            for i in range(STATES):
                k[0, i] = k[STAGES - 1, i]
            for i in range(CONTACT):
                now[i] = then[i]
        else:
            if not happen(p, what, t, then[RATE], memory, onsets, report):
                return TOO_MANY_IMPACTS
            if p[RENEWS] != 0.0 and what in (IMPACT, RETURN):
                freeze_inverse_mass(p, segment, memory, t, y)
            evaluate(p, segment, memory, t, y, k[0], now)
            # whatever rounding says
            if what == RETURN:
                now[RATE] = max(0.0, now[RATE])
            elif what == CUT:
                now[PUSH] = 1e-30 if was_cut else -1e-30
        h = follow
    going[MIDST], going[NEXT_STEP] = 0.0, h
    return FINISHED
