"""What happens to contacts within a step that has been tried, where, and the step made again to end there.

A step is looked at in parts. Over a part a depth is the cubic of `roots`; where that leaves in doubt whether
something happens, the step is too long, and is made again shorter.
"""

import math

from support_exudyn.formulations.compiled.step import advance, within
from support_exudyn.scene.arrays import STAGES, Matrix, Records, SceneArrays, Scratch, Vector
from support_exudyn.scene.compilation import compiled, once
from support_exudyn.scene.forces import observe, press
from user_forces.roots import Bracket, DepthPath, depth_at, doubt, first_rise, may_turn, narrowed, turn, zero_of

# CUT: the law begins or ceases to ask for tension
NOTHING, IMPACT, SEPARATION, CUT, TOO_LONG = range(5)
PARTS = 4  # of a step in free flight
SHORT = 1e-9  # [s]: in so short a step what cannot be told apart is taken as it ends
SEEN = 0.125  # of a part: what has just happened is not over in less
CUT_MET = 1e-9  # PUSH, of the order of 1, at which a cut of tension is met; the force has only a kink there
NEAR_CUT = 0.5  # PUSH below which a step is looked at for two cuts,
CUT_SAMPLES = 4  # in so many parts
AT_ZERO = 1e-13  # depth [m] that is an impact or separation just made; those are met to a tenth of it
TOGETHER = 10.0 * AT_ZERO  # depth [m] within which contacts meet or part at the same instant
FIRST = 1e-3  # of a step: the least that is tried first to land on an event
LANDED = 1e-14  # depth [m] at which an impact or separation is met; rounding of the posture is some 1e-16
LANDINGS = 12
Found = tuple[int, float]  # what, and the fraction of the step at which it happens


@compiled
def passes(what: int, path: DepthPath) -> Found:
    """Whether a depth that begins a part below zero passes zero upwards; an event of this kind happens then.

    Of a contact that may part, the path of the negative depth. Fractions are those of the part.
    """
    clear, top = path.step > SHORT, 1.0
    if path.depth1 <= 0.0:
        if not path.rate0 > 0.0 > path.rate1:
            reach = path.step * max(abs(path.rate0), abs(path.rate1))
            unseen = max(path.depth0, path.depth1) + reach > 0.0 and not path.rate0 < 0.0 < path.rate1
            return (TOO_LONG, 0.0) if clear and unseen and may_turn(path) else (NOTHING, 1.0)
        top = turn(path, -1.0)
        highest = depth_at(path, top)
        if clear and abs(highest) < doubt(path):
            return TOO_LONG, 0.0
        if highest <= 0.0:
            return NOTHING, 1.0
    x = min(first_rise(path), top)
    # the reverse has just happened, and must be seen first
    just = path.depth0 >= -AT_ZERO and path.rate0 <= 0.0
    return (TOO_LONG, 0.0) if clear and just and x < SEEN else (what, x)


@compiled
def look(scene: SceneArrays, n: int, x: float, path: Matrix, y: Vector, slope: Vector, forced: bool) -> None:
    """Let a contact stand in the scene as it is at a fraction x of a step; y and slope are overwritten.

    forced: with its force. Directions and points of its two bodies alone are those of that instant then.
    """
    contact = scene.contacts[n]
    count = scene.bodies.size
    for point in (scene.points[contact.first], scene.points[contact.second]):
        k = point.body
        if k < 0:
            continue
        i, j = 3 * k, 3 * (count + k)
        within(path, x, i, i + 3, y)
        within(path, x, j, j + 3, y)
        body = scene.bodies[k]
        c, s = math.cos(y[i + 2]), math.sin(y[i + 2])
        body.c, body.s = c, s
        rx, ry = c * point.arm_x - s * point.arm_y, s * point.arm_x + c * point.arm_y
        point.rx, point.ry = rx, ry
        point.x, point.y = body.x0 + y[i] + rx, body.y0 + y[i + 1] + ry
        point.vx, point.vy = y[j] - y[j + 2] * ry, y[j + 1] + y[j + 2] * rx
    observe(scene, n, y)
    if forced:
        if contact.state >= 0:
            within(path, x, contact.state, contact.state + 1, y)
        press(scene, n, y, slope)


@once
def in_flight(
    scene: SceneArrays, n: int, h: float, start: Records, end: Records, path: Matrix, y: Vector, slope: Vector
) -> Found:
    """What happens to a contact in a step that begins apart. start, end: all contacts there."""
    one, two = start[n], end[n]
    fastest = max(math.hypot(one.vx, one.vy), math.hypot(two.vx, two.vy))
    if max(one.depth, two.depth) < -h * fastest and h * fastest < one.clearance:
        return NOTHING, 1.0
    if math.hypot(two.x - one.x, two.y - one.y) > one.clearance:
        return TOO_LONG, 0.0
    d0, r0 = min(one.depth, 0.0), one.rate
    for part in range(PARTS):
        d1, r1 = two.depth, two.rate
        if part + 1 < PARTS:
            look(scene, n, (part + 1) / PARTS, path, y, slope, False)
            d1, r1 = scene.contacts[n].depth, scene.contacts[n].rate
        what, x = passes(IMPACT, DepthPath(d0, r0, d1, r1, h / PARTS))
        if what == TOO_LONG:
            return TOO_LONG, 0.0
        if what == IMPACT:
            return IMPACT, (part + x) / PARTS
        d0, r0 = d1, r1
    return NOTHING, 1.0


@once
def cut_twice(
    scene: SceneArrays, n: int, h: float, start: Records, end: Records, path: Matrix, y: Vector, slope: Vector
) -> bool:
    """Whether the law asks for tension in the midst of a step, but not at its ends, or the reverse."""
    before, after = start[n].push, end[n].push
    if h <= SHORT or min(before, after) > NEAR_CUT:
        return False
    if abs(before) <= CUT_MET or (before < 0.0) != (after < 0.0):
        return False
    for part in range(1, CUT_SAMPLES):
        look(scene, n, part / CUT_SAMPLES, path, y, slope, True)
        if scene.contacts[n].depth > 0.0 and (scene.contacts[n].push < 0.0) != (before < 0.0):
            return True
    return False


@once
def closed(
    scene: SceneArrays, n: int, h: float, start: Records, end: Records, path: Matrix, y: Vector, slope: Vector
) -> Found:
    """What happens in a step that begins in contact, see `in_flight` for the arguments."""
    one, two = start[n], end[n]
    if max(one.depth, one.rate, two.depth) <= 0.0:  # it touches without depth at the start, and leaves
        return SEPARATION, 1.0
    if cut_twice(scene, n, h, start, end, path, y, slope):
        return TOO_LONG, 0.0
    what, x = passes(SEPARATION, DepthPath(min(-one.depth, 0.0), -one.rate, -two.depth, -two.rate, h))
    if what == TOO_LONG:
        return TOO_LONG, 0.0
    # a step that begins on a cut and ends beyond it only grazes it; landing would go back to its start
    if abs(one.push) > CUT_MET and (one.push < 0.0) != (two.push < 0.0):
        # a separation may be first
        if what == SEPARATION and h > SHORT:
            return TOO_LONG, 0.0
        if what != SEPARATION:
            return CUT, zero_of(Bracket(0.0, 1.0, one.push, two.push))
    return what, x


@once
def first_event(
    scene: SceneArrays, h: float, start: Records, end: Records, path: Matrix, y: Vector, slope: Vector
) -> tuple[int, int, float]:
    """The contact to which something happens first in a step, what, and at which fraction.

    start, end: all contacts there. y, slope: scratch.
    """
    first, happens, at = -1, NOTHING, 2.0
    for n in range(scene.contacts.size):
        if start[n].closed == 0.0:
            what, x = in_flight(scene, n, h, start, end, path, y, slope)
        else:
            what, x = closed(scene, n, h, start, end, path, y, slope)
        if what == TOO_LONG:
            return n, TOO_LONG, 0.0
        if what != NOTHING and x < at:
            first, happens, at = n, what, x
    return first, happens, at


# --- steps made again ---


@compiled
def copy_contacts(source: Records, target: Records) -> None:
    """Copy all contacts."""
    for n in range(source.size):
        target[n] = source[n]


@compiled
def met_before(n: int, start: Records, end: Records) -> int:
    """Another contact that has met or parted in a step that ends where something happens to contact n; else -1.

    When it happens is only known to a share of the longer step, so that the later one may be landed on first.
    """
    for m in range(end.size):
        apart = start[m].closed == 0.0
        if m != n and ((apart and end[m].depth > TOGETHER) or (not apart and end[m].depth < -TOGETHER)):
            return m
    return -1


@once
def land(
    scene: SceneArrays, room: Scratch, n: int, t: float, h: float, what: int, x: float, y: Vector
) -> float:
    """Make a step of h [s] again so that it ends where something happens to a contact; its length [s].

    x: the fraction of the step at which that is expected.

    An impact or a separation is met by Newton's method on the depth at the end of the step. A cut of tension is
    met by false position on `push`: while tension is cut there is no force, steps grow, and would pass over the
    place where the force sets in again.
    """
    pushes = Bracket(0.0, h, float(room.now[n].push), float(scene.contacts[n].push))
    before, after, length = 0.0, 1.1 * h, max(x, FIRST) * h  # the step made again may differ by its error
    if what == CUT:
        length = zero_of(pushes)
    for tried in range(1, LANDINGS + 1):
        advance(scene, t, length, y, room.rates, room.end, room.weights, room.right)
        room.report[0].evaluations += STAGES - 1
        contact = scene.contacts[n]
        value = float(contact.push if what == CUT else contact.depth)
        if abs(value) <= (CUT_MET if what == CUT else LANDED) or tried == LANDINGS:
            break
        if what == CUT:
            pushes = narrowed(pushes, length, value)
            length = zero_of(pushes)
            continue
        if (value > 0.0) == (what == IMPACT):
            after = length
        else:
            before = length
        following = length - value / contact.rate
        if not before < following < after:
            following = 0.5 * (before + after)
        if following == length:
            break
        length = following
    return length


@compiled
def separate(scene: SceneArrays, room: Scratch, n: int, t: float, y: Vector) -> None:
    """The surfaces of a contact part at t [s]."""
    contact, onsets = scene.contacts[n], room.onsets
    contact.closed = contact.impact_velocity = 0.0
    for i in range(int(room.report[0].impacts) - 1, -1, -1):
        if onsets[i, 0] == n:
            onsets[i, 3], onsets[i, 4] = t, max(0.0, -contact.rate)
            break
    if contact.state >= 0:
        y[contact.state] = 0.0


@compiled
def strike(scene: SceneArrays, room: Scratch, n: int, t: float, y: Vector) -> bool:
    """The surfaces of a contact meet at t [s]; whether there is room to note it."""
    i, onsets = int(room.report[0].impacts), room.onsets
    if i >= onsets.shape[0]:
        return False
    contact = scene.contacts[n]
    contact.closed, contact.impact_velocity = 1.0, max(0.0, contact.rate)
    onsets[i, 0], onsets[i, 1], onsets[i, 2] = n, t, contact.impact_velocity
    onsets[i, 3], onsets[i, 4] = math.inf, 0.0
    room.report[0].impacts += 1
    if contact.state >= 0:
        y[contact.state] = 0.0
    return True


@once
def happen(scene: SceneArrays, room: Scratch, n: int, what: int, t: float, y: Vector) -> bool:
    """Change what contacts remember as an event of contact n at t [s] does; whether there is room for it.

    Contacts that meet at the same instant within rounding, as both corners of a face do, impact together; those
    that part at the same instant separate together. Rounding then does not decide which of them comes first.
    """
    if what == SEPARATION:
        separate(scene, room, n, t, y)
    elif what == IMPACT:
        if not strike(scene, room, n, t, y):
            return False
    else:
        return True
    for m in range(scene.contacts.size):
        other = scene.contacts[m]
        if m == n or abs(other.depth) > TOGETHER:
            continue
        if what == SEPARATION and other.closed != 0.0 and other.rate < 0.0:
            separate(scene, room, m, t, y)
        together = what == IMPACT and other.closed == 0.0 and other.rate > 0.0
        if together and not strike(scene, room, m, t, y):
            return False
    return True
