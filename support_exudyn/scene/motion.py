"""Where points are, what joints demand, and the accelerations of all bodies.

Mass matrix M, constraint Jacobian C, applied forces f and what drives demand, w, give

    C M^-1 C^T L = C M^-1 f - w,    a = M^-1 (f - C^T L)

by factors L D L^T of the square matrix, within the envelope that the order of the rows leaves.
"""

import math

import numpy as np

from support_exudyn.mechanics.closing import Conditions
from support_exudyn.scene.arrays import ACTUATOR, CRANK, GEAR, PIN, SceneArrays, Vector
from support_exudyn.scene.compilation import compiled, inlined

SETTLED = 1e-13  # share by which moments that depend on accelerations may still change
# Factors lose as many digits as the lightest body is lighter than the heaviest. So little may be left of that.
DIGIT, CLOSE = 1e-15, 1e-13
MOST_ROUNDS = 30
ONE, TWO = np.uint64(1), np.uint64(2)  # of indices without a sign, see `arrays.PAIR`
SINGULAR = 1e-11  # share of a row's own square that is left where rows repeat each other: a dead centre


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


@compiled
def factor(scene: SceneArrays) -> float:
    """Write C M^-1 C^T as its factors L, and 1 / D on the diagonal; the least share that is left of a row."""
    count, square, numbers = np.uint64(scene.rows.size), scene.square, scene.row_numbers
    for i in range(count):
        for j in range(np.uint64(scene.rows[i].first), i + ONE):
            square[i, j] = 0.0
    for n in range(scene.pairs.size):
        pair = scene.pairs[n]
        body, k, m = scene.bodies[pair.body], pair.one, pair.two
        moving = numbers[k] * numbers[m] + numbers[k + ONE] * numbers[m + ONE]
        turning = numbers[k + TWO] * numbers[m + TWO]
        square[pair.i, pair.j] += body.light * moving + body.light_turn * turning
    if scene.repeats.shape[0] > 0:
        return invert_repeated(scene)
    least = 1.0
    for i in range(count):
        first = np.uint64(scene.rows[i].first)
        for j in range(first, i):
            total = square[i, j]
            for k in range(max(first, np.uint64(scene.rows[j].first)), j):
                total -= square[i, k] * square[j, k]
            square[i, j] = total
        own = left = square[i, i]
        for j in range(first, i):
            total = square[i, j]
            square[i, j] = total * square[j, j]
            left -= total * square[i, j]
        share = left / own
        if not share > least:
            least = share
        square[i, i] = 1.0 / left
    return least


@compiled
def invert_repeated(scene: SceneArrays) -> float:
    """Write in place of C M^-1 C^T, some of whose rows repeat others, the inverse of what is left without them.

    The method of Gauss and Jordan takes that row next of which the largest share is left. Rows that remain at
    the end give `SceneArrays.repeats`. Returns the least share that was left of a row taken.
    """
    count, repeats = scene.rows.size, scene.repeats.shape[0]
    square, own = scene.square, scene.spare
    for i in range(count):
        for j in range(scene.rows[i].first, i):
            square[j, i] = square[i, j]
        for j in range(scene.rows[i].first):
            square[i, j] = square[j, i] = 0.0
        own[i] = square[i, i]
    least = 1.0
    for _ in range(count - repeats):
        best, most = -1, 0.0
        for i in range(count):
            if own[i] > 0.0 and square[i, i] > most * own[i]:
                best, most = i, square[i, i] / own[i]
        if best < 0:
            return 0.0
        least = min(least, most)
        own[best] = 0.0
        pivot, square[best, best] = square[best, best], 1.0
        for j in range(count):
            square[best, j] /= pivot
        for i in range(count):
            if i != best:
                factor, square[i, best] = square[i, best], 0.0
                for j in range(count):
                    square[i, j] -= factor * square[best, j]
    n = 0
    for i in range(count):
        if own[i] > 0.0:
            for j in range(count):
                scene.repeats[n, j] = -square[j, i] if own[j] == 0.0 else 0.0
                square[i, j] = square[j, i] = 0.0
            scene.repeats[n, i] = 1.0
            n += 1
    for n in range(repeats):  # perpendicular to each other and of length 1, counted by `counts`
        for k in range(n + 1):
            product = 0.0
            for j in range(count):
                product += scene.repeats[n, j] * scene.repeats[k, j] / scene.counts[j] ** (2 if k == n else 1)
            for j in range(count):
                if k == n:
                    scene.repeats[n, j] /= scene.counts[j] * math.sqrt(product)
                else:
                    scene.repeats[n, j] -= product * scene.repeats[k, j] * scene.counts[j]
    return least


@compiled
def divide_repeated(scene: SceneArrays, right: Vector) -> None:
    """See `divide`, where rows repeat others: of all x that fit the least, counted by `SceneArrays.counts`."""
    found, counts = scene.spare, scene.counts
    for i in range(right.size):
        found[i] = 0.0
        for j in range(right.size):
            found[i] += scene.square[i, j] * right[j]
    for n in range(scene.repeats.shape[0]):
        product = 0.0
        for i in range(right.size):
            product += scene.repeats[n, i] * found[i] / counts[i]
        for i in range(right.size):
            found[i] -= product * scene.repeats[n, i] * counts[i]
    for i in range(right.size):
        right[i] = found[i]


@inlined
def divide(scene: SceneArrays, right: Vector) -> None:
    """Solve C M^-1 C^T x = right by the factors; x stands in `right` afterwards."""
    if scene.repeats.shape[0] > 0:
        divide_repeated(scene, right)
        return
    count, square = np.uint64(scene.rows.size), scene.square
    for i in range(count):
        total = right[i]
        for k in range(np.uint64(scene.rows[i].first), i):
            total -= square[i, k] * right[k]
        right[i] = total
    for i in range(count):
        right[i] *= square[i, i]
    for n in range(count):
        m = count - ONE - n
        value = right[m]
        for k in range(np.uint64(scene.rows[m].first), m):
            right[k] -= square[m, k] * value


@inlined
def rate_of(scene: SceneArrays, row: int, v: Vector, start: int) -> float:
    """What a row makes of velocities that stand in `v` from `start` on."""
    one = scene.rows[row]
    total = 0.0
    if one.body >= 0:
        i = start + 3 * one.body
        total += one.x * v[i] + one.y * v[i + 1] + one.t * v[i + 2]
    if one.other >= 0:
        i = start + 3 * one.other
        total += one.ox * v[i] + one.oy * v[i + 1] + one.ot * v[i + 2]
    if one.carrier >= 0:
        total += one.carrier_t * v[start + 3 * one.carrier + 2]
    return float(total)


@compiled
def respond(scene: SceneArrays, multipliers: Vector, v: Vector, start: int) -> None:
    """Take M^-1 C^T L off the velocities or displacements that stand in `v` from `start` on."""
    for n in range(scene.rows.size):
        row = scene.rows[n]
        size = multipliers[n]
        if row.body >= 0:
            body, i = scene.bodies[row.body], start + 3 * row.body
            v[i] -= body.light * row.x * size
            v[i + 1] -= body.light * row.y * size
            v[i + 2] -= body.light_turn * row.t * size
        if row.other >= 0:
            body, i = scene.bodies[row.other], start + 3 * row.other
            v[i] -= body.light * row.ox * size
            v[i + 1] -= body.light * row.oy * size
            v[i + 2] -= body.light_turn * row.ot * size
        if row.carrier >= 0:
            v[start + 3 * row.carrier + 2] -= scene.bodies[row.carrier].light_turn * row.carrier_t * size


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


@inlined
def miss(scene: SceneArrays, right: Vector) -> None:
    """Write by how much the accelerations of the bodies miss what the joints demand."""
    for n in range(scene.rows.size):
        row = scene.rows[n]
        total = -row.wanted
        if row.body >= 0:
            body = scene.bodies[row.body]
            total += row.x * body.ax + row.y * body.ay + row.t * body.a
        if row.other >= 0:
            body = scene.bodies[row.other]
            total += row.ox * body.ax + row.oy * body.ay + row.ot * body.a
        if row.carrier >= 0:
            total += row.carrier_t * scene.bodies[row.carrier].a
        right[n] = total


@inlined
def take(scene: SceneArrays, n: int, size: float) -> None:
    """Take M^-1 C^T L off the accelerations of the bodies, for a multiplier of one row."""
    row = scene.rows[n]
    if row.body >= 0:
        body = scene.bodies[row.body]
        body.ax -= body.light * row.x * size
        body.ay -= body.light * row.y * size
        body.a -= body.light_turn * row.t * size
    if row.other >= 0:
        body = scene.bodies[row.other]
        body.ax -= body.light * row.ox * size
        body.ay -= body.light * row.oy * size
        body.a -= body.light_turn * row.ot * size
    if row.carrier >= 0:
        body = scene.bodies[row.carrier]
        body.a -= body.light_turn * row.carrier_t * size


@inlined
def solve(scene: SceneArrays, right: Vector) -> None:
    """Write multipliers and accelerations under the forces that act on the bodies; `right` is overwritten."""
    for n in range(scene.bodies.size):
        body = scene.bodies[n]
        body.ax, body.ay, body.a = body.light * body.fx, body.light * body.fy, body.light_turn * body.m
        body.given = 0.0
    miss(scene, right)
    divide(scene, right)
    for n in range(scene.rows.size):
        scene.rows[n].held = right[n]
        take(scene, n, right[n])
    for _ in range(1, scene.rounds):
        if not refine(scene, right):
            break


@compiled
def refine(scene: SceneArrays, right: Vector) -> bool:
    """Correct multipliers and accelerations by what the equations are open by; whether that may help further.

    Beside light bodies the factors lose digits. They contain an inertia `stand_in` for a point mass: a moment,
    from the acceleration before, gives that back.
    """
    changed = largest = 0.0
    for n in range(scene.bodies.size):
        body = scene.bodies[n]
        given = body.stand_in * body.a
        changed = max(changed, abs(given - body.given))
        largest = max(largest, abs(given))
        body.given = given
        body.ax, body.ay = body.light * body.fx, body.light * body.fy
        body.a = body.light_turn * (body.m + given)
    for n in range(scene.rows.size):
        take(scene, n, scene.rows[n].held)
    miss(scene, right)
    divide(scene, right)
    for n in range(scene.rows.size):
        scene.rows[n].held += right[n]
        take(scene, n, right[n])
    return largest == 0.0 or changed > SETTLED * largest


def rounds_of(held: Conditions) -> int:
    """In how many rounds multipliers and accelerations are solved for, see `refine`."""
    felt = held.kinetics.mass() / held.arms**2
    lost = DIGIT * felt.max() / max(felt.min(), DIGIT * felt.max())  # all of a point mass
    return MOST_ROUNDS if lost >= CLOSE**0.1 else max(1, math.ceil(math.log(CLOSE) / math.log(lost)))
