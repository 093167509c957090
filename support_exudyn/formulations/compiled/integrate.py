"""The run: steps of chosen length, cut at impacts and separations, between two breaks of drives and loads."""

from typing import NamedTuple

from support_exudyn.formulations.compiled.events import (
    CUT,
    CUT_MET,
    IMPACT,
    NOTHING,
    SEPARATION,
    SHORT,
    TOO_LONG,
    copy_contacts,
    first_event,
    happen,
    land,
    met_before,
)
from support_exudyn.formulations.compiled.method import (
    choose_method,
    factor_of,
    factor_over_corner,
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
from support_exudyn.formulations.compiled.recording import (
    begin_nodes,
    end_nodes,
    note_peaks,
    write_nodes,
    write_records,
)
from support_exudyn.formulations.compiled.start import begin_run, jump
from support_exudyn.formulations.compiled.step import evaluate
from support_exudyn.scene.arrays import (
    DEAD_CENTRE,
    FINISHED,
    PAUSED,
    STAGES,
    STUCK,
    TOO_MANY_IMPACTS,
    TOO_MANY_OIL_EVENTS,
    TOO_MANY_STEPS,
    SceneArrays,
    Scratch,
    Vector,
)
from support_exudyn.scene.compilation import compiled, entry, once

MOST_CUTS = 150  # of steps cut one after the other where tension begins or ceases; counted threefold
OVERLOOKED = 500.0  # steps for which that is overlooked then
SHORTEN = 0.25  # factor for a step in which too much happens
SMALLEST_STEP = 1e-13  # [s]
# Of the step before an impact is the first in it: forces begin as a broken power of time, over which a long
# step is of low order, so that errors would not fall as the tolerance does
AFTER_IMPACT = 0.01
CLOSE = 1e-12  # [s]: a record that lies so little behind the end of a step belongs to it
LEAST_ERROR = 1e-4  # by which the next step is chosen, at least


class StepEvents(NamedTuple):
    """What happens first in a step.

    contact, what: what happens to which contact, see `events`. x: the fraction of the step at which.
    oil, gap: whether a gap of a leg passes zero, and which, see `oil_events`.
    """

    contact: int
    what: int
    x: float
    oil: int
    gap: int


@entry
def integrate(
    scene: SceneArrays,
    room: Scratch,
    y: Vector,
    begin: float,
    stop: float,
    jumps: Vector,
    most_steps: int,
    pause: int,
) -> int:
    """Integrate from `begin` to `stop` [s], between which all courses are smooth, or resume after a pause.

    Arguments:
        room: with the first step in going.next_step; after a segment or a pause as it was left.
        y: the state at the start; at the end when it returns.
        jumps: of the rates of courses at `begin`; impulses of all rows, against them, stand in `room.impulses`.
        most_steps: before giving up. pause: after so many steps it returns PAUSED, to be called again.

    Returns FINISHED, PAUSED or why the run cannot go on.
    """
    going, report = room.going[0], room.report[0]
    if going.midst == 0.0:
        going.at, going.last_error = begin, LEAST_ERROR
        if report.records == 0.0 and not begin_run(scene, room, y):
            return DEAD_CENTRE
        report.records = max(1.0, report.records)
        jump(scene, room, begin, y, jumps)
        begin_step(scene, room, begin, y)
        copy_contacts(scene.contacts, room.now)
    while going.at < stop:
        if report.steps >= pause:
            going.midst = 1.0
            return PAUSED
        report.steps += 1
        report.stopped_at, report.last_step = going.at, going.next_step
        if report.steps > most_steps:
            return TOO_MANY_STEPS
        if going.next_step < SMALLEST_STEP:
            return STUCK
        code = take_step(scene, room, y, stop)
        if code != FINISHED:
            return code
    going.midst = 0.0
    return FINISHED


@compiled
def begin_step(scene: SceneArrays, room: Scratch, t: float, y: Vector) -> None:
    """Evaluate the state at t [s] from which the next step begins."""
    evaluate(scene, t, y, room.rates[0], room.right)
    begin_nodes(scene, room, t, y)
    keep_gaps(scene.legs)


@once
def take_step(scene: SceneArrays, room: Scratch, y: Vector, stop: float) -> int:
    """Try a step, cut it at the first event, and accept it, or leave a shorter step to try.

    Returns FINISHED, or why the run cannot go on.
    """
    going = room.going[0]
    t, wanted, decay = going.at, going.next_step, going.decay
    h = stop - t if wanted >= 0.999999 * (stop - t) else wanted
    forget_beyond(scene.legs)
    error = try_step(scene, room, t, h, y)
    if not error <= 1.0:
        going.next_step = h * min(factor_of(error, 1.0, decay), 1.0)
        return FINISHED
    copy_contacts(scene.contacts, room.then)
    fit_step(room, decay, h, y)
    if going.uncut > 0.0:  # let contacts be where tension begins, on their side, so that no step beyond is cut
        for n in range(room.now.size):
            if abs(room.now[n].push) > CUT_MET:
                room.now[n].push = CUT_MET if room.now[n].push > 0.0 else -CUT_MET
    n, what, x = first_event(scene, h, room.now, room.then, room.path, room.probe, room.slope)
    oil, gap = first_gap(scene.legs)
    events = StepEvents(n, what, x, oil, gap)
    shorter = shortened(scene, room, events, t, h)
    if shorter > 0.0:
        going.next_step = shorter
        return FINISHED
    if events.oil == AT_ONCE:
        if not pass_gap(scene.legs, room, events.gap, t):
            return TOO_MANY_OIL_EVENTS
        begin_step(scene, room, t, y)
        going.next_step = h
        return FINISHED
    if events.oil == GAP:
        h = land_on_gap(scene, scene.legs, room, events.gap, t, h, y)
        copy_contacts(scene.contacts, room.then)
        fit_step(room, 0.0, h, y)
        n, what, x = first_event(scene, h, room.now, room.then, room.path, room.probe, room.slope)
        if what == TOO_LONG:
            going.next_step = h * SHORTEN
            return FINISHED
        oil = GAP if what == NOTHING else NONE
        events = StepEvents(n, what, x, oil, events.gap)
    follow = wanted if h >= stop - t else h * factor_of(error, going.last_error, decay)
    going.last_error = max(error, LEAST_ERROR)
    return accept(scene, room, events, t, h, follow, y, stop)


@once
def shortened(scene: SceneArrays, room: Scratch, events: StepEvents, t: float, h: float) -> float:
    """The step [s] to try in place of one of h [s] from t in which too much happens; 0: that one stands.

    Events are met by the explicit method.
    """
    hidden = hidden_gap(scene, scene.legs, room, t, h)
    if room.going[0].decay > 0.0 and (events.what != NOTHING or events.oil != NONE or hidden < 1.0):
        return leave_stabilised(room, h)
    if events.what == TOO_LONG:
        return h * SHORTEN
    return h * hidden if hidden < 1.0 and h > SHORT else 0.0


@once
def accept(
    scene: SceneArrays,
    room: Scratch,
    events: StepEvents,
    t: float,
    h: float,
    follow: float,
    y: Vector,
    stop: float,
) -> int:
    """End a step of h [s] from t at its first event, keep what is asked for, and choose the next step.

    If a force has too much of a corner within the step, leave a shorter step to try.

    follow: length of the next step [s] by the error of this one. Returns FINISHED, or why the run cannot go on.
    """
    going, report, now, then = room.going[0], room.report[0], room.now, room.then
    n, what, passes = events.contact, events.what, events.oil == GAP
    was_cut = n >= 0 and now[n].push < 0.0
    if what != NOTHING and events.x < 1.0:
        h, n, what, was_cut = land_on_first(scene, room, events, t, h, was_cut, y)
        fit_step(room, 0.0, h, y)
    last, quiet = h >= stop - t, what == NOTHING and events.oil == NONE
    keep_gaps(scene.legs)
    copy_contacts(then, scene.contacts)
    off = write_nodes(scene, room, t, h)
    if not off <= 1.0:
        begin_step(scene, room, t, y)
        going.next_step = h * factor_over_corner(off)
        return FINISHED
    end_nodes(room)
    note_peaks(scene, room, t, h)
    report.accepted += 1
    report.cuts += what != NOTHING or passes
    count_cuts(room, what)
    write_records(scene, room, t, h, stop + CLOSE if last else t + h)
    copy_contacts(then, scene.contacts)
    going.at = t = stop if last else t + h
    for i in range(y.size):
        y[i] = room.end[i]
    if quiet:
        for i in range(y.size):
            room.rates[0, i] = room.rates[STAGES - 1, i]
        copy_contacts(then, now)
    else:
        code = apply_event(scene, room, events, n, what, was_cut, t, y)
        if code != FINISHED:
            return code
    if what == IMPACT:
        follow *= AFTER_IMPACT
    going.next_step = choose_method(scene, room, t, h, follow, y, quiet)
    return FINISHED


@once
def land_on_first(
    scene: SceneArrays, room: Scratch, events: StepEvents, t: float, h: float, was_cut: bool, y: Vector
) -> tuple[float, int, int, bool]:
    """Make a step of h [s] again so that it ends at the first of what happens to contacts.

    Returns its length [s], the contact, what happens to it, and whether its tension was cut before.
    """
    now, then = room.now, room.then
    n, what, x = events.contact, events.what, events.x
    while True:
        copy_contacts(then, scene.contacts)
        h = land(scene, room, n, t, h, what, x, y)
        copy_contacts(scene.contacts, then)
        m = met_before(n, now, then)
        if m < 0:
            return h, n, what, was_cut
        n, what, x = m, IMPACT if now[m].closed == 0.0 else SEPARATION, 0.5
        was_cut = now[n].push < 0.0


@once
def apply_event(
    scene: SceneArrays, room: Scratch, events: StepEvents, n: int, what: int, was_cut: bool, t: float, y: Vector
) -> int:
    """Resume at t [s], where something has happened to contact n, or a gap of a leg passes zero.

    Returns FINISHED, or why the run cannot go on.
    """
    if events.oil == GAP:
        if not pass_gap(scene.legs, room, events.gap, t):
            return TOO_MANY_OIL_EVENTS
    else:
        # places and factors are those of the last look at the step
        evaluate(scene, t, y, room.slope, room.right)
        if not happen(scene, room, n, what, t, y):
            return TOO_MANY_IMPACTS
    begin_step(scene, room, t, y)
    copy_contacts(scene.contacts, room.now)
    if events.oil != GAP and what == CUT:  # whatever rounding gives
        room.now[n].push = 1e-30 if was_cut else -1e-30
    return FINISHED


@once
def count_cuts(room: Scratch, what: int) -> None:
    """Count the steps that end where tension begins or ceases; if there are too many, overlook it for a while.

    A contact that is pulled out of its bore as fast as its law allows stays where there is no pressure and no
    tension. Steps that ended there would never become long, nor be stabilised. Forces are continuous there, so
    that the error of a step says how much overlooking it matters.
    """
    going = room.going[0]
    going.uncut = max(0.0, going.uncut - 1.0)
    going.cut_steps = going.cut_steps + 3.0 if what == CUT else max(0.0, going.cut_steps - 1.0)
    if going.cut_steps > MOST_CUTS:
        going.cut_steps, going.uncut = 0.0, OVERLOOKED
