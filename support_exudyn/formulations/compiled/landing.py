"""A step made again so that it ends where something happens to a contact."""

from support_exudyn.formulations.compiled.depth import CUT, CUT_MET, IMPACT, TOGETHER
from support_exudyn.formulations.compiled.step import advance
from support_exudyn.formulations.compiled.step_control import LANDED, LANDINGS, crossing
from support_exudyn.scene.arrays import (
    EVALUATIONS,
    STAGES,
    Matrix,
    Records,
    SceneArrays,
    Vector,
)
from support_exudyn.scene.compilation import compiled, once


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
    there is no force, steps grow, and one would miss where the force sets in again.
    """
    met = CUT_MET if what == CUT else LANDED
    before, after = low * h, high * h
    length = 0.5 * (before + after)
    at_before, at_after = start[n].push, float(scene.contacts[n].push)
    if what == CUT:
        before, after = 0.0, h
        length = crossing(before, after, at_before, at_after)
    for tried in range(1, LANDINGS + 1):
        advance(scene, t, length, y, k, end, weights, right)
        report[EVALUATIONS] += STAGES - 1
        value = float(scene.contacts[n].push if what == CUT else scene.contacts[n].depth)
        if abs(value) <= met or tried == LANDINGS:
            break
        if what == CUT:
            if (value < 0.0) == (at_before < 0.0):
                before, at_before = length, value
                at_after *= 0.5
            else:
                after, at_after = length, value
                at_before *= 0.5
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
