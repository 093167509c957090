"""Hydraulic legs with elements in the scene: what they are told of the motion, and how they push."""

from support_exudyn.formulations.compilation import compiled, once
from support_exudyn.formulations.compiled.arrays import SceneArrays, Vector
from support_exudyn.formulations.compiled.forces import lengthening, push_apart
from support_exudyn.formulations.hydraulics.leg import press_all
from support_exudyn.formulations.hydraulics.rest import rest_legs


@compiled
def tell_legs(scene: SceneArrays) -> None:
    """Write lengths, rates and inlets of all legs into their records."""
    for n in range(scene.legs.size):
        leg = scene.legs[n]
        leg.length, leg.rate, _, _ = lengthening(scene, leg.foot, leg.head)
        if leg.course < 0:
            continue
        course = scene.courses[leg.course]
        if leg.driven != 0:
            leg.inflow, leg.inflow_rate = course.value, course.rate
        else:
            leg.opening = course.value


@compiled
def press_legs(scene: SceneArrays, y: Vector, slope: Vector) -> None:
    """Forces, powers and rates of the states of all legs and of the pump, see `hydraulics.leg`."""
    tell_legs(scene)
    press_all(scene.legs, scene.pumps, scene.gaps, y, slope)
    push_legs(scene)
    reach(scene)


@compiled
def push_legs(scene: SceneArrays) -> None:
    """Let the force of each leg act on what its ends are in."""
    for n in range(scene.legs.size):
        leg = scene.legs[n]
        _, _, ux, uy = lengthening(scene, leg.foot, leg.head)
        push_apart(scene, leg.foot, leg.head, leg.force * ux, leg.force * uy)


@once
def reach(scene: SceneArrays) -> None:
    """Keep how far each gap has been on the other side since it was last forgotten."""
    for n in range(scene.gaps.shape[0]):
        for k in range(scene.gaps.shape[1]):
            beyond = -scene.sides[n, k] * scene.gaps[n, k]
            if beyond > scene.beyond[n, k]:
                scene.beyond[n, k] = beyond


@compiled
def press_resting_legs(scene: SceneArrays, y: Vector, slope: Vector) -> None:
    """Forces of all legs at rest, see `hydraulics.rest`; their states there into y."""
    tell_legs(scene)
    rest_legs(scene.legs, scene.pumps, scene.gaps, y, slope)
    push_legs(scene)
