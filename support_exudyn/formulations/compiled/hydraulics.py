"""Hydraulic legs with elements in the scene: what they are told of the motion, and how they push."""

from support_exudyn.formulations.compilation import compiled, once
from support_exudyn.formulations.compiled.arrays import SceneArrays, Vector
from support_exudyn.formulations.compiled.forces import lengthening, push_apart
from support_exudyn.formulations.hydraulics.leg import press_all

ROUNDS = 40  # of finding where the tube of two stages stands
SHIFT = 1e-9  # [m] over which it is looked how its force changes


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
    for n in range(scene.legs.size):
        leg = scene.legs[n]
        _, _, ux, uy = lengthening(scene, leg.foot, leg.head)
        push_apart(scene, leg.foot, leg.head, leg.force * ux, leg.force * uy)
    reach(scene)


@once
def reach(scene: SceneArrays) -> None:
    """Keep how far each gap has been on the other side since it was last forgotten."""
    for n in range(scene.gaps.shape[0]):
        for k in range(scene.gaps.shape[1]):
            beyond = -scene.sides[n, k] * scene.gaps[n, k]
            if beyond > scene.beyond[n, k]:
                scene.beyond[n, k] = beyond


@compiled
def rest_tubes(scene: SceneArrays, y: Vector, slope: Vector) -> None:
    """Let the tube of each leg of two stages stand where nothing pushes it, by Newton's method, at rest."""
    tell_legs(scene)
    for n in range(scene.legs.size):
        if scene.legs[n].stage < 0:
            continue
        place = scene.legs[n].stage + 1
        y[place + 1] = 0.0
        for _ in range(ROUNDS):
            press_all(scene.legs, scene.pumps, scene.gaps, y, slope)
            pushed = slope[place + 1]
            y[place] += SHIFT
            press_all(scene.legs, scene.pumps, scene.gaps, y, slope)
            rise = (slope[place + 1] - pushed) / SHIFT
            y[place] -= SHIFT
            if not rise < 0.0:
                break
            step = -pushed / rise
            y[place] += step
            if not abs(step) > 1e-14:
                break
