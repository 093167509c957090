"""The run: steps of chosen length, cut at impacts and separations, between two breaks of drives and loads."""

from support_exudyn.formulations.compiled.beginning import begin_run, jump
from support_exudyn.formulations.compiled.events import (
    CUT,
    CUT_MET,
    IMPACT,
    NOTHING,
    SEPARATION,
    SHORT,
    TOO_LONG,
    first_event,
)
from support_exudyn.formulations.compiled.landing import copy_contacts, happen, land, met_before
from support_exudyn.formulations.compiled.method import (
    AT,
    CUT_STEPS,
    DECAY,
    LAST_ERROR,
    MIDST,
    NEXT_STEP,
    UNCUT,
    choose_method,
    factor_of,
    fit_step,
    leave_stabilised,
    try_step,
)
from support_exudyn.formulations.compiled.oil_events import (
    AT_ONCE,
    GAP,
    NONE,
    first_gap,
    forget_beyond,
    hidden_gap,
    keep_gaps,
    land_on_gap,
    pass_gap,
)
from support_exudyn.formulations.compiled.recording import begin_nodes, note_peaks, write_nodes, write_records
from support_exudyn.formulations.compiled.step import evaluate
from support_exudyn.formulations.compiled.step_control import AFTER_IMPACT, CLOSE, SHORTEN, SMALLEST_STEP
from support_exudyn.scene.arrays import (
    ACCEPTED,
    CUTS,
    DEAD_CENTRE,
    FINISHED,
    LAST_STEP,
    PAUSED,
    RECORDS,
    STAGES,
    STEPS,
    STOPPED_AT,
    STUCK,
    TOO_MANY_IMPACTS,
    TOO_MANY_OIL_EVENTS,
    TOO_MANY_STEPS,
    Matrix,
    Records,
    SceneArrays,
    Scratch,
    Vector,
)
from support_exudyn.scene.compilation import entry, once

MOST_CUTS = 150  # of steps cut one after the other where tension begins or ceases; counted threefold
OVERLOOKED = 500.0  # steps for which that is overlooked then


@once
def land_on_first(
    scene: SceneArrays,
    room: Scratch,
    n: int,
    t: float,
    h: float,
    what: int,
    x: float,
    was_cut: bool,
    y: Vector,
    weights: Vector,
    report: Vector,
) -> tuple[float, int, int, bool]:
    """Make a step of h [s] again so that it ends at the first of what happens to contacts.

    Returns its length [s], the contact, what happens to it, and whether its tension was cut before.
    """
    now, then = room.now, room.then
    while True:
        copy_contacts(then, scene.contacts)
        h = land(scene, n, t, h, what, x, now, y, room.rates, room.end, weights, room.right, report)
        copy_contacts(scene.contacts, then)
        m = met_before(n, now, then)
        if m < 0:
            return h, n, what, was_cut
        n, what, x = m, IMPACT if now[m].closed == 0.0 else SEPARATION, 0.5
        was_cut = now[n].push < 0.0


@once
def take_up(
    scene: SceneArrays,
    room: Scratch,
    n: int,
    what: int,
    was_cut: bool,
    passes: bool,
    leg: int,
    gap: int,
    t: float,
    y: Vector,
    onsets: Matrix,
    report: Vector,
) -> int:
    """Take up the run at t [s], where something has happened to contact n, or a gap of a leg passes zero.

    Returns FINISHED, or why the run cannot go on.
    """
    now, rates, right = room.now, room.rates, room.right
    if passes:
        if not pass_gap(scene.legs, leg, gap, t, report):
            return TOO_MANY_OIL_EVENTS
    else:
        evaluate(scene, t, y, room.slope, right)  # places and factors are those of what was looked at last
        if not happen(scene, n, what, t, y, onsets, report):
            return TOO_MANY_IMPACTS
    evaluate(scene, t, y, rates[0], right)
    copy_contacts(scene.contacts, now)
    keep_gaps(scene.legs)
    # whatever rounding says
    if not passes and what == CUT:
        now[n].push = 1e-30 if was_cut else -1e-30
    return FINISHED


@once
def count_cuts(going: Vector, what: int) -> None:
    """Count the steps that end where tension begins or ceases; if there are too many, overlook it for a while.

    A contact that is pulled out of its bore as fast as its law allows stays where there is no pressure and no
    tension. Steps that ended there would never become long, nor be stabilised. Forces are continuous there, so
    that the error of a step says how much overlooking it matters.
    """
    going[UNCUT] = max(0.0, going[UNCUT] - 1.0)
    going[CUT_STEPS] = going[CUT_STEPS] + 3.0 if what == CUT else max(0.0, going[CUT_STEPS] - 1.0)
    if going[CUT_STEPS] > MOST_CUTS:
        going[CUT_STEPS], going[UNCUT] = 0.0, OVERLOOKED


@once
def overlook_cuts(contacts: Records) -> None:
    """Let contacts be where tension begins, on their side of it, so that a step beyond is not cut."""
    for n in range(contacts.size):
        if abs(contacts[n].push) > CUT_MET:
            contacts[n].push = CUT_MET if contacts[n].push > 0.0 else -CUT_MET


@entry
def integrate(
    scene: SceneArrays,
    begin: float,
    stop: float,
    jumps: Vector,
    times: Vector,
    weights: Vector,
    going: Vector,
    most_steps: int,
    pause: int,
    y: Vector,
    room: Scratch,
    rows: Matrix,
    nodes: Matrix,
    onsets: Matrix,
    report: Vector,
) -> int:
    """Run from `begin` to `stop` [s], between which all courses are smooth, or go on after a pause.

    Arguments:
        jumps: of the rates of courses at `begin`; impulses of all rows, against them, stand in `room.impulses`.
        times: of the records [s], from 0.
        weights: one over the largest error of a step, for each component.
        going: with the first step in NEXT_STEP; after a segment or a pause as it was left.
        most_steps: before giving up. pause: after so many steps it returns PAUSED, to be called again.
        y: the state at the start; at the end when it returns.
        room: after a pause as it was left.
        rows, onsets, report: are filled.
        nodes: of the steps since the last pause, four each, with room for all until the next and one row more.
    """
    right, end, k, now, then = room.right, room.end, room.rates, room.now, room.then
    h, error_before, t = going[NEXT_STEP], 1e-4, begin
    if going[MIDST] != 0.0:
        t, error_before = going[AT], going[LAST_ERROR]
    else:
        if report[RECORDS] == 0.0 and not begin_run(scene, room, y, rows):
            return DEAD_CENTRE
        report[RECORDS] = max(1.0, report[RECORDS])
        jump(scene, room, t, y, jumps, report)
        evaluate(scene, t, y, k[0], right)
        keep_gaps(scene.legs)
        copy_contacts(scene.contacts, now)
        begin_nodes(scene, t, y, k[0], nodes, report)
    while t < stop:
        if report[STEPS] >= pause:
            going[MIDST], going[AT], going[NEXT_STEP], going[LAST_ERROR] = 1.0, t, h, error_before
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
        decay = going[DECAY]
        forget_beyond(scene.legs)
        error = try_step(scene, room, going, t, h, y, weights, report)
        if not error <= 1.0:
            h *= min(factor_of(error, 1.0, decay), 1.0)
            continue
        copy_contacts(scene.contacts, then)
        fit_step(room, decay, h, y)
        if going[UNCUT] > 0.0:
            overlook_cuts(now)
        n, what, x = first_event(scene, h, now, then, room.path, room.probe, room.slope)
        oil, leg, gap = first_gap(scene.legs)
        hidden = hidden_gap(scene, scene.legs, room, t, h)
        # events are met by the explicit method
        if decay > 0.0 and (what != NOTHING or oil != NONE or hidden < 1.0):
            h = leave_stabilised(going, h)
            continue
        if what == TOO_LONG or (hidden < 1.0 and h > SHORT):
            h *= SHORTEN if what == TOO_LONG else hidden
            continue
        if oil == AT_ONCE:
            if not pass_gap(scene.legs, leg, gap, t, report):
                return TOO_MANY_OIL_EVENTS
            evaluate(scene, t, y, k[0], right)
            begin_nodes(scene, t, y, k[0], nodes, report)
            keep_gaps(scene.legs)
            continue
        if oil == GAP:
            h = land_on_gap(scene, scene.legs, room, leg, gap, t, h, y, weights, report)
            copy_contacts(scene.contacts, then)
            fit_step(room, 0.0, h, y)
            last = h >= stop - t
            n, what, x = first_event(scene, h, now, then, room.path, room.probe, room.slope)
            if what == TOO_LONG:
                h *= SHORTEN
                continue
            if what != NOTHING:
                oil = NONE
        follow = wanted if last else h * factor_of(error, error_before, decay)
        error_before = max(error, 1e-4)
        was_cut = n >= 0 and now[n].push < 0.0
        if what != NOTHING and x < 1.0:
            h, n, what, was_cut = land_on_first(scene, room, n, t, h, what, x, was_cut, y, weights, report)
            fit_step(room, 0.0, h, y)
            last = h >= stop - t
        keep_gaps(scene.legs)
        copy_contacts(then, scene.contacts)
        write_nodes(scene, room, t, h, nodes, report)
        note_peaks(scene, room, t, h, report)
        report[ACCEPTED] += 1
        report[CUTS] += what != NOTHING or oil == GAP
        count_cuts(going, what)
        write_records(scene, room, t, h, stop + CLOSE if last else t + h, times, rows, report)
        copy_contacts(then, scene.contacts)
        t = stop if last else t + h
        for i in range(y.size):
            y[i] = end[i]
        if what == NOTHING and oil == NONE:
            for i in range(y.size):
                k[0, i] = k[STAGES - 1, i]
            copy_contacts(then, now)
        else:
            code = take_up(scene, room, n, what, was_cut, oil == GAP, leg, gap, t, y, onsets, report)
            if code != FINISHED:
                return code
            begin_nodes(scene, t, y, k[0], nodes, report)
        if what == IMPACT:
            follow *= AFTER_IMPACT
        h = choose_method(scene, room, going, t, h, follow, y, weights, what == NOTHING and oil == NONE, report)
    going[MIDST], going[NEXT_STEP] = 0.0, h
    return FINISHED
