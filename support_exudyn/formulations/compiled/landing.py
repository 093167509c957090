"""A step made again so that it ends where something happens to a contact, and what that changes."""

import math

from support_exudyn.formulations.compiled.events import CUT, CUT_MET, IMPACT, SEPARATION, TOGETHER
from support_exudyn.formulations.compiled.step import advance
from support_exudyn.formulations.compiled.step_control import LANDED, LANDINGS
from support_exudyn.scene.arrays import EVALUATIONS, IMPACTS, STAGES, Matrix, Records, SceneArrays, Vector
from support_exudyn.scene.compilation import compiled, once
from user_forces.roots import Bracket, narrowed, zero_of

FIRST = 1e-3  # of a step: the least that is tried first


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
    scene: SceneArrays,
    n: int,
    t: float,
    h: float,
    what: int,
    x: float,
    start: Records,
    y: Vector,
    k: Matrix,
    end: Vector,
    weights: Vector,
    right: Vector,
    report: Vector,
) -> float:
    """Make a step of h [s] again so that it ends where something happens to a contact; its length [s].

    x: the fraction of the step at which that is expected.

    An impact or a separation is met by Newton's method on the depth at the end of the step. A cut of tension is
    met by false position on `push`: while tension is cut there is no force, steps grow, and would pass over the
    place where the force sets in again.
    """
    pushes = Bracket(0.0, h, float(start[n].push), float(scene.contacts[n].push))
    before, after, length = 0.0, 1.1 * h, max(x, FIRST) * h  # the step made again may differ by its error
    if what == CUT:
        length = zero_of(pushes)
    for tried in range(1, LANDINGS + 1):
        advance(scene, t, length, y, k, end, weights, right)
        report[EVALUATIONS] += STAGES - 1
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
def separate(scene: SceneArrays, n: int, t: float, y: Vector, onsets: Matrix, report: Vector) -> None:
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
def strike(scene: SceneArrays, n: int, t: float, y: Vector, onsets: Matrix, report: Vector) -> bool:
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
def happen(scene: SceneArrays, n: int, what: int, t: float, y: Vector, onsets: Matrix, report: Vector) -> bool:
    """Change what contacts remember as an event of contact n at t [s] does; whether there is room for it.

    Contacts that meet at the same instant within rounding, as both corners of a face do, impact together; those
    that part at the same instant separate together. Rounding then does not decide which of them comes first.
    """
    if what == SEPARATION:
        separate(scene, n, t, y, onsets, report)
    elif what == IMPACT:
        if not strike(scene, n, t, y, onsets, report):
            return False
    else:
        return True
    for m in range(scene.contacts.size):
        other = scene.contacts[m]
        if m == n or abs(other.depth) > TOGETHER:
            continue
        if what == SEPARATION and other.closed != 0.0 and other.rate < 0.0:
            separate(scene, m, t, y, onsets, report)
        together = what == IMPACT and other.closed == 0.0 and other.rate > 0.0
        if together and not strike(scene, m, t, y, onsets, report):
            return False
    return True
