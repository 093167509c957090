"""Friction in ideal pins and guides. It depends on the forces that they carry, and these on it: both are solved
together, by fixed-point iteration with Aitken's relaxation.

Source: Kuettler and Wall, Comput. Mech. 43 (2008) 61-72, for the relaxation.
"""

import math

from support_exudyn.scene.arrays import BLOCK, BOLT, SceneArrays, Vector
from support_exudyn.scene.compilation import call_law, compiled, once
from support_exudyn.scene.motion import SETTLED, push, push_point, solve, spin_of, turn_of
from user_forces.journal import end_loads, larger_load

RUBBINGS = 30  # rounds at most
JAMMED = 1e-6  # share that is still open after all rounds, from which on friction and force have no solution
LEAST_RELAXED, MOST_RELAXED = 0.05, 20.0


@once
def begin_rubbing(scene: SceneArrays, y: Vector) -> None:
    """Write the direction and the speed along guides, and apply the friction of the evaluation before."""
    for n in range(scene.rubbing.size):
        one = scene.rubbing[n]
        if not math.isfinite(one.force):  # of a trial that was too long
            one.force = one.moment = 0.0
        if one.kind != BOLT:
            angle = one.angle + turn_of(y, one.other)
            first, second = scene.points[one.first], scene.points[one.second]
            one.ax, one.ay = math.cos(angle), math.sin(angle)
            one.speed = one.ax * (second.vx - first.vx) + one.ay * (second.vy - first.vy)
        apply(scene, n, one.force, one.moment)


@compiled
def apply(scene: SceneArrays, n: int, force: float, moment: float) -> None:
    """Add a friction force [N] along a guide and a moment [N m] to what acts on both bodies."""
    one = scene.rubbing[n]
    if one.kind != BOLT:
        push_point(scene, one.second, force * one.ax, force * one.ay)
        push_point(scene, one.first, -force * one.ax, -force * one.ay)
    push(scene, one.body, 0.0, 0.0, moment)
    push(scene, one.other, 0.0, 0.0, -moment)


@compiled
def rubbed(scene: SceneArrays, y: Vector, n: int, normal: float) -> float:
    """Friction force [N] of the law under a normal force [N], at the slip that stands in the record."""
    one = scene.rubbing[n]
    deflection = y[one.state] if one.state >= 0 else 0.0
    constants = scene.constants[one.constants :]
    return float(call_law(one.law, normal, 0.0, one.slip, 0.0, deflection, constants, scene.out))


@compiled
def friction_force(scene: SceneArrays, y: Vector, n: int) -> float:
    """Friction force [N] under what the joint carries now, see `IdealGuide`; writes slip and lever."""
    one = scene.rubbing[n]
    held, spin = scene.rows[one.row].held, spin_of(scene, y, one.body) - spin_of(scene, y, one.other)
    if one.kind == BOLT:
        one.lever, one.slip = one.radius, one.radius * spin
        return rubbed(scene, y, n, math.hypot(held, scene.rows[one.row + 1].held))
    one.lever = -one.radius if held > 0.0 else one.radius
    one.slip = one.speed + one.lever * spin
    if one.kind != BLOCK:
        return rubbed(scene, y, n, abs(held))
    across, twist = -held, -scene.rows[one.row + 1].held
    larger = larger_load(across, twist, one.half_length)
    ratio = rubbed(scene, y, n, larger) / larger if larger > 0.0 else 0.0
    first, second = end_loads(across, twist, ratio, one.half_length, one.half_height)
    return rubbed(scene, y, n, first) + rubbed(scene, y, n, second)


@once
def rub(scene: SceneArrays, y: Vector, slope: Vector, right: Vector) -> None:
    """Solve for friction and the forces of all joints together; write the rates of states of friction laws."""
    relaxed = 1.0
    for k in range(RUBBINGS):
        changed = largest = bend = square = 0.0
        for n in range(scene.rubbing.size):
            one = scene.rubbing[n]
            force = friction_force(scene, y, n)
            left = force - one.force
            bend += one.left * (left - one.left)
            square += (left - one.left) * (left - one.left)
            one.left = left
            changed, largest = max(changed, abs(left)), max(largest, abs(force))
            if one.state >= 0:
                slope[one.state] = scene.out[0]
        if not changed > SETTLED * largest:
            break
        if k > 0 and square > 0.0:
            relaxed = min(max(abs(relaxed * bend / square), LEAST_RELAXED), MOST_RELAXED)
        for n in range(scene.rubbing.size):
            one = scene.rubbing[n]
            force = one.force + relaxed * one.left
            moment = one.lever * force
            apply(scene, n, force - one.force, moment - one.moment)
            one.force, one.moment = force, moment
        solve(scene, right)
    if changed > JAMMED * largest:
        scene.bodies[0].a = math.nan  # the step is not accepted
