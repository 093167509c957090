"""Places and velocities of points, what the joints demand, and forces on bodies."""

import math

from support_exudyn.scene.arrays import ACTUATOR, CRANK, GEAR, PIN, SceneArrays, Vector
from support_exudyn.scene.compilation import inlined


@inlined
def follow_courses(scene: SceneArrays, t: float) -> None:
    """Write value, rate and second derivative of all time courses at t [s]."""
    for n in range(scene.courses.size):
        one = scene.courses[n]
        low, high = one.low, one.high - 1
        while low < high:
            middle = (low + high + 1) // 2
            if scene.pieces[middle].begin <= t:
                low = middle
            else:
                high = middle - 1
        piece = scene.pieces[low]
        x = (t - piece.begin) / piece.half - 1.0
        value = rate = bend = 0.0
        for k in range(scene.coefficients.shape[1] - 1, -1, -1):
            bend = bend * x + 2.0 * rate
            rate = rate * x + value
            value = value * x + scene.coefficients[low, k]
        one.value, one.rate, one.bend = value, rate / piece.half, bend / (piece.half * piece.half)
        if one.still != 0:
            one.rate, one.bend = one.rate - one.jump, 0.0


@inlined
def place(scene: SceneArrays, y: Vector) -> None:
    """Write directions of bodies, and places and velocities of all points."""
    count = scene.bodies.size
    for n in range(count):
        body = scene.bodies[n]
        body.c, body.s = math.cos(y[3 * n + 2]), math.sin(y[3 * n + 2])
    for n in range(scene.points.size):
        point = scene.points[n]
        k = point.body
        if k < 0:
            continue
        body = scene.bodies[k]
        i, j = 3 * k, 3 * (count + k)
        rx = body.c * point.arm_x - body.s * point.arm_y
        ry = body.s * point.arm_x + body.c * point.arm_y
        spin = y[j + 2]
        point.rx, point.ry = rx, ry
        point.x, point.y = body.x0 + y[i] + rx, body.y0 + y[i + 1] + ry
        point.vx, point.vy = y[j] - spin * ry, y[j + 1] + spin * rx


@inlined
def spin_of(scene: SceneArrays, y: Vector, body: int) -> float:
    """Angular velocity of a body [rad/s]."""
    return float(y[3 * (scene.bodies.size + body) + 2]) if body >= 0 else 0.0


@inlined
def turn_of(y: Vector, body: int) -> float:
    """Turn of a body since the start [rad]."""
    return float(y[3 * body + 2]) if body >= 0 else 0.0


@inlined
def hold(scene: SceneArrays, y: Vector) -> None:
    """Write the rows of all joints, what C a has to be, what is left of the positions, and rates to have."""
    for n in range(scene.joints.size):
        joint = scene.joints[n]
        row = scene.rows[joint.row]
        if joint.kind == CRANK:
            row.t = 1.0
            row.wanted = row.rate = 0.0
            row.off = turn_of(y, joint.first)
            if joint.course >= 0:
                course = scene.courses[joint.course]
                row.wanted, row.rate = course.bend, course.rate
                row.off -= course.value
            continue
        if joint.kind == GEAR:
            row.t, row.ot = 1.0, -joint.ratio
            row.wanted = row.rate = 0.0
            carrier = turn_of(y, row.carrier)
            row.carrier_t = joint.ratio - 1.0
            row.off = turn_of(y, joint.second) - carrier - joint.ratio * (turn_of(y, joint.first) - carrier)
            continue
        first, second = scene.points[joint.first], scene.points[joint.second]
        one, two = spin_of(scene, y, first.body), spin_of(scene, y, second.body)
        # what turning does to the acceleration of the second point against the first
        cx = two * two * second.rx - one * one * first.rx
        cy = two * two * second.ry - one * one * first.ry
        dx, dy = second.x - first.x, second.y - first.y
        if joint.kind == PIN:
            other = scene.rows[joint.row + 1]
            row.x, row.t, row.ox, row.ot = 1.0, -second.ry, -1.0, first.ry
            other.y, other.t, other.oy, other.ot = 1.0, second.rx, -1.0, -first.rx
            row.wanted, other.wanted = cx, cy
            row.off, other.off = dx, dy
            row.rate = other.rate = 0.0
            continue
        vx, vy = second.vx - first.vx, second.vy - first.vy
        if joint.kind == ACTUATOR:
            length = math.sqrt(dx * dx + dy * dy)
            ux, uy = dx / length, dy / length
            rate = ux * vx + uy * vy
            value = goal = bend = 0.0
            if joint.course >= 0:
                course = scene.courses[joint.course]
                value, goal, bend = course.value, course.rate, course.bend
            row.wanted = bend - (vx * vx + vy * vy - rate * rate) / length + ux * cx + uy * cy
            row.off, row.rate = length - joint.length - value, goal
            carried = 0.0
        else:  # SLIDE: second is the body's point, first the carrier's, on the line
            angle = joint.angle + turn_of(y, first.body)
            ax, ay = math.cos(angle), math.sin(angle)
            ux, uy = -ay, ax
            along = ax * dx + ay * dy
            row.off, row.rate = ux * dx + uy * dy, 0.0
            row.wanted = 2.0 * one * (ax * vx + ay * vy) + one * one * row.off + ux * cx + uy * cy
            carried = along
            if joint.conditions == 2:
                other = scene.rows[joint.row + 1]
                other.t, other.ot, other.wanted, other.rate = 1.0, -1.0, 0.0, 0.0
                other.off = turn_of(y, second.body) - turn_of(y, first.body)
        row.x, row.y, row.t = ux, uy, second.rx * uy - second.ry * ux
        row.ox, row.oy, row.ot = -ux, -uy, first.ry * ux - first.rx * uy - carried


@inlined
def push(scene: SceneArrays, body: int, fx: float, fy: float, moment: float) -> None:
    """Add a force [N] at the centre of mass of a body and a moment [N m] to what acts on it."""
    if body >= 0:
        one = scene.bodies[body]
        one.fx += fx
        one.fy += fy
        one.m += moment


@inlined
def push_point(scene: SceneArrays, point: int, fx: float, fy: float) -> None:
    """Add a force [N] at a point to what acts on its body."""
    at = scene.points[point]
    push(scene, at.body, fx, fy, at.rx * fy - at.ry * fx)
