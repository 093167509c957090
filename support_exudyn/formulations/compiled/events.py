"""What happens to contacts within a step that has been tried, and where.

A step is looked at in parts. Over a part a depth is the cubic that fits depth and rate at both ends; where that
leaves in doubt whether something happens, the step is too long, and is made again shorter.
"""

import math

from support_exudyn.formulations.compiled.depth import (
    CUT,
    CUT_MET,
    CUT_SAMPLES,
    IMPACT,
    NEAR_CUT,
    NOTHING,
    PARTS,
    SEPARATION,
    SHORT,
    TOO_LONG,
    Found,
    in_contact,
    rise,
)
from support_exudyn.formulations.compiled.step import within
from support_exudyn.scene.arrays import Matrix, Records, SceneArrays, Vector
from support_exudyn.scene.compilation import compiled, once
from support_exudyn.scene.forces import observe, press


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
        return NOTHING, 1.0, 1.0
    if math.hypot(two.x - one.x, two.y - one.y) > one.clearance:
        return TOO_LONG, 0.0, 0.0
    d0, r0 = min(one.depth, 0.0), one.rate
    for part in range(PARTS):
        d1, r1 = two.depth, two.rate
        if part + 1 < PARTS:
            look(scene, n, (part + 1) / PARTS, path, y, slope, False)
            d1, r1 = scene.contacts[n].depth, scene.contacts[n].rate
        what, low, high = rise(d0, r0, d1, r1, h / PARTS)
        if what == TOO_LONG:
            return TOO_LONG, 0.0, 0.0
        if what == IMPACT:
            return IMPACT, (part + low) / PARTS, (part + high) / PARTS
        d0, r0 = d1, r1
    return NOTHING, 1.0, 1.0


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
    if cut_twice(scene, n, h, start, end, path, y, slope):
        return TOO_LONG, 0.0, 0.0
    what, low, high = in_contact(max(one.depth, 0.0), one.rate, two.depth, two.rate, h)
    if what == TOO_LONG:
        return TOO_LONG, 0.0, 0.0
    # a step that begins on a cut and ends beyond it only grazes it; landing would go back to its start
    if abs(one.push) > CUT_MET and (one.push < 0.0) != (two.push < 0.0):
        # a separation may be first
        if what == SEPARATION and h > SHORT:
            return TOO_LONG, 0.0, 0.0
        if what != SEPARATION:
            return CUT, 0.0, 1.0
    return what, low, high


@once
def first_event(
    scene: SceneArrays, h: float, start: Records, end: Records, path: Matrix, y: Vector, slope: Vector
) -> tuple[int, int, float, float]:
    """The contact to which something happens first in a step, what, and between which fractions.

    start, end: all contacts there. y, slope: scratch.
    """
    first, happens, low, high = -1, NOTHING, 1.0, 2.0
    for n in range(scene.contacts.size):
        if start[n].closed == 0.0:
            what, begin, stop = in_flight(scene, n, h, start, end, path, y, slope)
        else:
            what, begin, stop = closed(scene, n, h, start, end, path, y, slope)
        if what == TOO_LONG:
            return n, TOO_LONG, 0.0, 0.0
        if what != NOTHING and stop < high:
            first, happens, low, high = n, what, begin, stop
    return first, happens, low, high
