"""The run: steps of chosen length, cut at impacts and separations, between two breaks of what drives and loads."""

import math

from support_exudyn.formulations.compilation import compiled, entry, once
from support_exudyn.formulations.compiled.arrays import (
    ACCEPTED,
    CLAMPED,
    CUTS,
    DEAD_CENTRE,
    EVALUATIONS,
    FINISHED,
    IMPACTS,
    JUMP_ENERGY,
    LAST_STEP,
    MEMORY,
    NOT_A_NUMBER,
    PAUSED,
    RECORDS,
    STEPS,
    STIFF,
    STOPPED_AT,
    STUCK,
    TOO_MANY_IMPACTS,
    TOO_MANY_STEPS,
    WORK,
    STAGES,
    Matrix,
    Records,
    Scene,
    Scratch,
    Vector,
)
from support_exudyn.formulations.compiled.events import first_event, look
from support_exudyn.formulations.compiled.masses import renew_mass
from support_exudyn.formulations.compiled.motion import SINGULAR, divide, respond
from support_exudyn.formulations.compiled.stabilised import (
    FEWEST_STAGES,
    AT_FIRST,
    FIRST_PATIENCE,
    LONGEST_PATIENCE,
    RENEWED,
    ROUNDS,
    advance_stabilised,
    fastest_decay,
    fit_cubic,
    longest,
    stages_for,
)
from support_exudyn.formulations.compiled.stabilised import STIFF as STIFF_AT
from support_exudyn.formulations.compiled.step import (
    advance,
    close_joints,
    evaluate,
    fit,
    within,
)
from support_exudyn.formulations.peak_force import GOLDEN, NARROWINGS, NEAR_PEAK, NEAR_TOP, PEAK_SAMPLES
from support_exudyn.formulations.compiled.depth import AT_ZERO, CUT, CUT_MET, IMPACT, NOTHING, RETURN, SEPARATION, TOO_LONG
from support_exudyn.formulations.compiled.step_control import (
    CLOSE,
    FASTEST,
    LANDED,
    SAFETY,
    SLOWEST,
    LANDINGS,
    SHORTEN,
    SMALLEST_STEP,
    TURNS,
    crossing,
    factor,
)

# With what a run goes on: whether it is in the midst of a segment, time, next step, last error; the fastest decay,
# above 0 while steps are stabilised; steps since it was looked for, and after how many it is
MIDST, AT, NEXT_STEP, LAST_ERROR, DECAY, STIFF_STEPS, PATIENCE, GOING = range(8)
TOGETHER = 1e3 * AT_ZERO  # depth [m] within which corners that land with the first one land at the same instant
DEPTH_, PUSH_, RATE_ = range(3)  # what is landed on


@compiled
def quantity(scene: Scene, n: int, which: int) -> float:
    """Depth, push or rate of a contact as it stands in the scene."""
    if which == DEPTH_:
        return float(scene.contacts[n].depth)
    return float(scene.contacts[n].push) if which == PUSH_ else float(scene.contacts[n].rate)


@compiled
def copy_contacts(source: Records, target: Records) -> None:
    """Copy all contacts."""
    for n in range(source.size):
        target[n] = source[n]


@once
def land(
    scene: Scene,
    n: int,
    t: float,
    h: float,
    what: int,
    low: float,
    high: float,
    start: Records,
    y: Vector,
    k: Matrix,
    end: Vector,
    weights: Vector,
    right: Vector,
    report: Vector,
) -> float:
    """Make a step of h [s] again so that it ends where something happens to a contact; its length [s].

    An impact or a separation is met by Newton's method on the depth at the end of the step, kept by bisection
    where it was seen. A cut of tension is met by false position (Illinois) on `push`: while tension is cut
    there is no force, steps grow, and one would miss where the force sets in again. Where a contact is pressed
    on again, false position on the rate begins at the guess `high`.
    """
    which, met, looks = DEPTH_, LANDED, LANDINGS
    before, after = low * h, high * h
    length = 0.5 * (before + after)
    at_before, at_after = start[n].depth, quantity(scene, n, DEPTH_)
    if what == CUT:
        which, met = PUSH_, CUT_MET
        at_before, at_after, before, after = start[n].push, quantity(scene, n, PUSH_), 0.0, h
        length = crossing(before, after, at_before, at_after)
    elif what == RETURN:
        which, met, looks = RATE_, 0.0, TURNS
        at_before, at_after, before, after = start[n].rate, quantity(scene, n, RATE_), 0.0, h
        length = high * h
    for tried in range(1, looks + 1):
        advance(scene, t, length, y, k, end, weights, right)
        report[EVALUATIONS] += STAGES - 1
        value = quantity(scene, n, which)
        if abs(value) <= met or tried == looks:
            break
        if which != DEPTH_:
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
        following = length - value / scene.contacts[n].rate
        # the step made again may differ from what was seen by its error, so a little more is allowed
        if not before - 0.1 * h < following < after + 0.1 * h or following <= 0.0:
            following = 0.5 * (before + after)
        if following == length:
            break
        length = following
    return length


@once
def separate(scene: Scene, n: int, t: float, y: Vector, onsets: Matrix, report: Vector) -> None:
    """The surfaces of a contact part at t [s]."""
    contact = scene.contacts[n]
    contact.closed = contact.impact_velocity = 0.0
    for i in range(int(report[IMPACTS]) - 1, -1, -1):
        if onsets[i, 0] == n:
            onsets[i, 3], onsets[i, 4] = t, max(0.0, -contact.rate)
            break
    if contact.state >= 0:
        y[contact.state] = 0.0


@compiled
def strike(scene: Scene, n: int, t: float, y: Vector, onsets: Matrix, report: Vector) -> bool:
    """The surfaces of a contact meet at t [s]; whether there is room to note it."""
    i = int(report[IMPACTS])
    if i >= onsets.shape[0]:
        return False
    contact = scene.contacts[n]
    contact.closed, contact.impact_velocity = 1.0, max(0.0, contact.rate)
    onsets[i, 0], onsets[i, 1], onsets[i, 2] = n, t, contact.impact_velocity
    onsets[i, 3], onsets[i, 4] = math.inf, 0.0
    report[IMPACTS] += 1
    if contact.state >= 0:
        y[contact.state] = 0.0
    return True


@once
def happen(scene: Scene, n: int, what: int, t: float, y: Vector, onsets: Matrix, report: Vector) -> bool:
    """Change what contacts remember as an event of one at t [s] does; whether there is room for it.

    Others that meet at the same instant, as both corners of a face do, impact with it.
    """
    contact = scene.contacts[n]
    if what == SEPARATION:
        separate(scene, n, t, y, onsets, report)
    elif what == RETURN and contact.forgets != 0:
        contact.impact_velocity = 0.0
    elif what == IMPACT:
        if not strike(scene, n, t, y, onsets, report):
            return False
        for m in range(scene.contacts.size):
            other = scene.contacts[m]
            if other.closed == 0.0 and abs(other.depth) <= TOGETHER and other.rate > 0.0:
                if not strike(scene, m, t, y, onsets, report):
                    return False
    return True


@compiled
def size(scene: Scene, n: int) -> float:
    """Magnitude of a contact's force [N] as it stands in the scene."""
    return math.hypot(scene.contacts[n].normal, scene.contacts[n].friction)


@compiled
def peak(scene: Scene, n: int, path: Matrix, last: float, y: Vector, slope: Vector) -> float:
    """The largest force [N] of a contact so far, a step included that ends with the force `last` [N].

    That at points between the ends, and the highest between these, which may be a corner (where what limits
    the damping changes).
    """
    largest = scene.contacts[n].largest
    top, at = 0.0, 0
    for i in range(PEAK_SAMPLES + 1):
        force = last
        if i < PEAK_SAMPLES:
            look(scene, n, i / PEAK_SAMPLES, path, y, slope, True)
            force = size(scene, n)
        if force > top:
            top, at = force, i
    if top <= NEAR_TOP * largest:
        return float(largest)
    low, high = max(0.0, (at - 1) / PEAK_SAMPLES), min(1.0, (at + 1) / PEAK_SAMPLES)
    one, other = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    look(scene, n, one, path, y, slope, True)
    at_one = size(scene, n)
    look(scene, n, other, path, y, slope, True)
    at_other = size(scene, n)
    for _ in range(NARROWINGS):
        top = max(top, at_one, at_other)
        if at_one > at_other:
            high, other, at_other = other, one, at_one
            one = high - GOLDEN * (high - low)
            look(scene, n, one, path, y, slope, True)
            at_one = size(scene, n)
        else:
            low, one, at_one = one, other, at_other
            other = low + GOLDEN * (high - low)
            look(scene, n, other, path, y, slope, True)
            at_other = size(scene, n)
    return float(max(largest, top))


@compiled
def write_record(scene: Scene, t: float, y: Vector, slope: Vector, row: Vector) -> None:
    """Write a record of what has been evaluated at t [s].

    That is the state, accelerations, multipliers, what contacts remember, courses, moments of friction.
    """
    row[0] = t
    i, count = 1, 3 * scene.bodies.size
    for k in range(y.size):
        row[i + k] = y[k]
    i += y.size
    for k in range(count):
        row[i + k] = slope[count + k]
    i += count
    for k in range(scene.rows.size):
        row[i + k] = scene.rows[k].held
    i += scene.rows.size
    for k in range(scene.contacts.size):
        one = scene.contacts[k]
        row[i], row[i + 1], row[i + 2], row[i + 3], row[i + 4] = (
            one.closed,
            one.impact_velocity,
            one.xx,
            one.xy,
            one.yy,
        )
        i += MEMORY
    for k in range(scene.courses.size):
        row[i], row[i + 1] = scene.courses[k].value, scene.courses[k].rate
        i += 2
    for k in range(scene.rubbing.size):
        row[i] = scene.rubbing[k].moment
        i += 1


@compiled
def factor_of(error: float, before: float, decay: float) -> float:
    """By which the next step may be longer; of the stabilised method, if there is a decay, of order 2."""
    if not decay > 0.0:
        return factor(error, before)
    if not error < 1e30:
        return SLOWEST
    return min(FASTEST, max(SLOWEST, SAFETY * max(error, 1e-9) ** (-1.0 / 3.0)))


@compiled
def leave_stabilised(going: Vector, h: float) -> float:
    """Go on by the explicit method; the step [s] that it takes, at most that of its stability."""
    h = min(h, STIFF_AT / going[DECAY])
    going[DECAY] = going[STIFF_STEPS] = 0.0
    return h


@once
def choose_method(
    scene: Scene,
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
def begin_run(scene: Scene, room: Scratch, y: Vector, rows: Matrix) -> bool:
    """Write the first record at 0 s, with the masses that contacts are told then; whether the linkage moves."""
    least = evaluate(scene, 0.0, y, room.slope, room.right)
    for n in range(scene.contacts.size):
        contact = scene.contacts[n]
        if contact.depth > 0.0:
            contact.closed, contact.impact_velocity = 1.0, max(0.0, contact.rate)
    for n in range(scene.contacts.size):
        renew_mass(scene, room, n, y)
    evaluate(scene, 0.0, y, room.slope, room.right)
    write_record(scene, 0.0, y, room.slope, rows[0])
    for n in range(scene.courses.size):
        scene.courses[n].still = 0
    return least > SINGULAR


@compiled
def kinetic_energy(scene: Scene, y: Vector) -> float:
    """Kinetic energy of all bodies [J]."""
    count, total = scene.bodies.size, 0.0
    for n in range(count):
        body, i = scene.bodies[n], 3 * (count + n)
        total += 0.5 * ((y[i] ** 2 + y[i + 1] ** 2) / body.light + y[i + 2] ** 2 / body.light_turn)
    return total


@once
def jump(scene: Scene, room: Scratch, t: float, y: Vector, jumps: Vector, report: Vector) -> None:
    """Change velocities as speeds of drives jump at t [s], jumps by course."""
    jumped = False
    for n in range(jumps.size):
        jumped = jumped or jumps[n] != 0.0
    if not jumped:
        return
    evaluate(scene, t, y, room.slope, room.right)
    for n in range(room.impulses.size):
        room.impulses[n] = 0.0
    for n in range(scene.joints.size):
        joint = scene.joints[n]
        if joint.course >= 0:
            room.impulses[joint.row] = -jumps[joint.course]
    divide(scene, room.impulses)
    before = kinetic_energy(scene, y)
    respond(scene, room.impulses, y, 3 * scene.bodies.size)
    report[JUMP_ENERGY] = kinetic_energy(scene, y) - before
    y[WORK] += report[JUMP_ENERGY]


@entry
def integrate(
    scene: Scene,
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
    """
    states, count = y.size, scene.contacts.size
    right, end, probe, slope, path, k = (
        room.right,
        room.end,
        room.probe,
        room.slope,
        room.path,
        room.rates,
    )
    now, then = room.now, room.then
    h, error_before, t = going[NEXT_STEP], 1e-4, begin
    if going[MIDST] != 0.0:
        t, error_before = going[AT], going[LAST_ERROR]
    else:
        if report[RECORDS] == 0.0 and not begin_run(scene, room, y, rows):
            return DEAD_CENTRE
        report[RECORDS] = max(1.0, report[RECORDS])
        jump(scene, room, t, y, jumps, report)
        evaluate(scene, t, y, k[0], right)
        copy_contacts(scene.contacts, now)
    if going[PATIENCE] == 0.0:
        going[PATIENCE] = FIRST_PATIENCE
        for i in range(states):  # some direction to begin with
            room.along[i] = (1.0 + 0.1 * (i % 7)) / weights[i]
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
        if decay > 0.0:
            error = advance_stabilised(scene, t, h, decay, y, k, end, weights, right)
            report[EVALUATIONS] += stages_for(h * decay)
            report[STIFF] += 1
        else:
            error = advance(scene, t, h, y, k, end, weights, right)
            report[EVALUATIONS] += STAGES - 1
        report[NOT_A_NUMBER] = 1.0 if math.isnan(error) else 0.0
        if not error <= 1.0:
            h *= min(factor_of(error, 1.0, decay), 1.0)
            continue
        copy_contacts(scene.contacts, then)
        if decay > 0.0:
            fit_cubic(h, y, end, k, path)
        else:
            fit(h, y, end, k, path)
        n, what, low, high = first_event(scene, h, now, then, path, probe, slope)
        if decay > 0.0 and what != NOTHING:  # events are met by the explicit method
            h = leave_stabilised(going, h)
            continue
        if what == TOO_LONG:
            h *= SHORTEN
            continue
        follow = wanted if last else h * factor_of(error, error_before, decay)
        error_before = max(error, 1e-4)
        was_cut = n >= 0 and now[n].push < 0.0
        if what != NOTHING and low < 1.0:
            copy_contacts(then, scene.contacts)
            h = land(scene, n, t, h, what, low, high, now, y, k, end, weights, right, report)
            copy_contacts(scene.contacts, then)
            fit(h, y, end, k, path)
            last = h >= stop - t
        copy_contacts(then, scene.contacts)
        for m in range(count):
            if then[m].closed != 0.0:
                first, final = math.hypot(now[m].normal, now[m].friction), size(scene, m)
                if max(first, final) > NEAR_PEAK * then[m].largest:
                    highest = max(first, peak(scene, m, path, final, probe, slope))
                    if highest > then[m].largest:
                        then[m].largest, then[m].largest_at = highest, t + h
            report[CLAMPED] += then[m].push < 0.0
        report[ACCEPTED] += 1
        report[CUTS] += what not in (NOTHING, RETURN)
        until = stop + CLOSE if last else t + h
        written = int(report[RECORDS])
        while written < times.size and times[written] <= until:
            within(path, min(1.0, (times[written] - t) / h), 0, states, probe)
            copy_contacts(then, scene.contacts)
            close_joints(scene, times[written], probe, right)
            evaluate(scene, times[written], probe, slope, right)
            write_record(scene, times[written], probe, slope, rows[written])
            written += 1
        report[RECORDS] = written
        copy_contacts(then, scene.contacts)
        t = stop if last else t + h
        for i in range(states):
            y[i] = end[i]
        if what == NOTHING:
            for i in range(states):
                k[0, i] = k[STAGES - 1, i]
            copy_contacts(then, now)
        else:
            evaluate(scene, t, y, slope, right)  # places and factors are those of what was looked at last
            if not happen(scene, n, what, t, y, onsets, report):
                return TOO_MANY_IMPACTS
            if what in (IMPACT, RETURN):
                renew_masses(scene, room, n, what, t, y, onsets, report)
            evaluate(scene, t, y, k[0], right)
            copy_contacts(scene.contacts, now)
            # whatever rounding says
            if what == RETURN:
                now[n].rate = max(0.0, now[n].rate)
            elif what == CUT:
                now[n].push = 1e-30 if was_cut else -1e-30
        h = choose_method(scene, room, going, t, h, follow, y, weights, what == NOTHING, report)
    going[MIDST], going[NEXT_STEP] = 0.0, h
    return FINISHED


@once
def renew_masses(
    scene: Scene, room: Scratch, n: int, what: int, t: float, y: Vector, onsets: Matrix, report: Vector
) -> None:
    """Renew the mass that the law of a contact is told, and of others that have impacted at the same instant."""
    if what == RETURN:
        if scene.contacts[n].renews != 0:
            renew_mass(scene, room, n, y)
        return
    for i in range(int(report[IMPACTS]) - 1, -1, -1):
        if onsets[i, 1] != t:
            break
        m = int(onsets[i, 0])
        if scene.contacts[m].renews != 0:
            renew_mass(scene, room, m, y)

