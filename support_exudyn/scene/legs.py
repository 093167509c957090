"""Hydraulic legs in the scene: what they are told of the motion, and how they push.

Functions that take `LegArrays | None` do nothing where there are no legs. Numba decides that by the type of the
argument, before it compiles the rest.
"""

from support_exudyn.scene.arrays import SceneArrays, Vector
from support_exudyn.scene.compilation import compiled, once
from support_exudyn.scene.forces import lengthening, push_apart
from support_exudyn.scene.hydraulics.leg import press_all
from support_exudyn.scene.hydraulics.records import LegArrays, Records
from support_exudyn.scene.hydraulics.rest import begin_sides, rest_legs


@compiled
def begin_legs(legs: LegArrays | None) -> None:
    """Write the side of zero on which each gap is at the start of a run."""
    if legs is not None:
        begin_sides(legs.gaps, legs.valves)


@compiled
def tell_legs(scene: SceneArrays, legs: Records) -> None:
    """Write lengths, rates and inlets of all legs into their records."""
    for n in range(legs.size):
        leg = legs[n]
        leg.length, leg.rate, leg.ux, leg.uy = lengthening(scene, leg.foot, leg.head)
        if leg.course < 0:
            continue
        course = scene.courses[leg.course]
        if leg.driven != 0:
            leg.inflow, leg.inflow_rate = course.value, course.rate
        else:
            leg.opening = course.value


@compiled
def press_legs(scene: SceneArrays, legs: LegArrays | None, y: Vector, slope: Vector) -> None:
    """Forces, powers and rates of the states of all legs and of the pump, see `hydraulics.leg`."""
    if legs is not None:
        tell_legs(scene, legs.records)
        press_all(legs, y, slope)
        push_legs(scene, legs.records)
        reach(legs)


@compiled
def push_legs(scene: SceneArrays, legs: Records) -> None:
    """Let the force of each leg act on what its ends are in."""
    for n in range(legs.size):
        leg = legs[n]
        push_apart(scene, leg.foot, leg.head, leg.force * leg.ux, leg.force * leg.uy)


@once
def reach(legs: LegArrays) -> None:
    """Keep how far the gap of each valve with hysteresis has been on the other side since it was forgotten."""
    for k in range(legs.gaps.size):
        gap = legs.gaps[k]
        if gap.valve >= 0 and legs.valves[gap.valve].jumps != 0:
            gap.beyond = max(gap.beyond, -gap.side * gap.now)


@compiled
def press_resting_legs(scene: SceneArrays, legs: LegArrays | None, y: Vector, slope: Vector) -> None:
    """Forces of all legs at rest, see `hydraulics.rest`; their states there into y."""
    if legs is not None:
        tell_legs(scene, legs.records)
        rest_legs(legs, y, slope)
        push_legs(scene, legs.records)
