"""The rate of the state, and a step by Dormand and Prince's method of order 5(4), projected onto the joints.

Source: Dormand and Prince, J. Comput. Appl. Math. 6 (1980) 19-26; the interpolation of order 4 is that of
Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section II.6. The projection is that of
Hairer and Wanner, Solving Ordinary Differential Equations II, section VII.2: what a step leaves open of joints,
and of their rates, is closed by the smallest change in the sense of the masses, which is of the size of the
step's error.
"""

import math

import numpy as np

from support_exudyn.scene.arrays import LOSSES, STAGES, Matrix, SceneArrays, Vector
from support_exudyn.scene.compilation import compiled
from support_exudyn.scene.forces import (
    observe,
    powers,
    press,
    press_loads,
    push_contact,
)
from support_exudyn.scene.legs import press_legs
from support_exudyn.scene.motion import (
    SINGULAR,
    divide,
    factor,
    follow_courses,
    hold,
    place,
    rate_of,
    respond,
    solve,
)
from support_exudyn.scene.rubbing import begin_rubbing, rub

NODES = np.array([0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
WEIGHTS = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0],
        [3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0],
        [44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0],
        [35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    ]
)
# difference to the result of fourth order
ERROR = np.array([71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])
# of the interpolation
INNER = np.array(
    [
        -12715105075 / 11282082432,
        0.0,
        87487479700 / 32700410799,
        -10690763975 / 1880347072,
        701980252875 / 199316789632,
        -1453857185 / 822651844,
        69997945 / 29380423,
    ]
)
CLOSED = 1e-13  # [m], [rad]: joints that are open by less are closed, within rounding
ROUNDS = 4  # of the projection


@compiled
def evaluate(scene: SceneArrays, t: float, y: Vector, slope: Vector, right: Vector) -> float:
    """Write the rate of the state y at time t [s] into `slope`; the least share of a row that joints leave.

    right: scratch, one number a row. All that acts, and what joints carry, stands in the scene's records.
    """
    follow_courses(scene, t)
    place(scene, y)
    hold(scene, y)
    least = factor(scene)
    count = scene.bodies.size
    for n in range(count):
        body = scene.bodies[n]
        body.fx, body.fy, body.m = body.weight_x, body.weight_y, 0.0
    for n in range(scene.contacts.size):
        observe(scene, n, y)
        press(scene, n, y, slope)
        push_contact(scene, n)
    # a call costs more than a loop over nothing
    press_legs(scene, scene.legs, y, slope)
    if scene.loads.size > 0:
        press_loads(scene, t, y)
    if scene.rubbing.size > 0:
        begin_rubbing(scene, y)
    solve(scene, right)
    if scene.rubbing.size > 0:
        rub(scene, y, slope, right)
    for n in range(count):
        body, i, j = scene.bodies[n], 3 * n, 3 * (count + n)
        slope[i], slope[i + 1], slope[i + 2] = y[j], y[j + 1], y[j + 2]
        slope[j], slope[j + 1], slope[j + 2] = body.ax, body.ay, body.a
    powers(scene, y, slope)
    return least


@compiled
def close_joints(scene: SceneArrays, t: float, y: Vector, right: Vector) -> None:
    """Close the joints of a state at t [s], and give it rates that keep them so.

    The factors are those of an evaluation near by, but of this state for light bodies, which feel their errors.
    """
    count, rows = 3 * scene.bodies.size, scene.rows.size
    follow_courses(scene, t)
    before = math.inf
    for _ in range(ROUNDS):
        place(scene, y)
        hold(scene, y)
        if scene.rounds > 1:
            factor(scene)
        worst = 0.0
        for k in range(rows):
            right[k] = scene.rows[k].off
            worst = max(worst, abs(right[k]))
        if not CLOSED < worst < before:
            break
        before = worst
        divide(scene, right)
        respond(scene, right, y, 0)
    for _ in range(min(scene.rounds, ROUNDS)):
        for k in range(rows):
            right[k] = rate_of(scene, k, y, count) - scene.rows[k].rate
        divide(scene, right)
        respond(scene, right, y, count)


@compiled
def combine(weights: Vector, k: Matrix, stages: int, count: int, out: Vector) -> None:
    """Write the weighted sum of the rates of so many stages into the first components of `out`."""
    for i in range(count):
        out[i] = weights[0] * k[0, i]
    for j in range(1, stages):
        weight = weights[j]
        for i in range(count):
            out[i] += weight * k[j, i]


@compiled
def advance(
    scene: SceneArrays,
    t: float,
    h: float,
    y: Vector,
    k: Matrix,
    end: Vector,
    weights: Vector,
    right: Vector,
) -> float:
    """Try a step of h [s] from t with k[0] the rate there; its error in units of what is allowed.

    Writes the state at the end into `end` and its rate into k[6]; all that acts then stands in the scene.
    An error that is no number: the linkage cannot close, or a value is none any more.
    """
    size = y.size
    for stage in range(1, STAGES):
        last = stage == STAGES - 1
        count = size if last else size - LOSSES  # no rate depends on losses
        combine(WEIGHTS[stage], k, stage, count, end)
        for i in range(count):
            end[i] = y[i] + h * end[i]
        if last:
            close_joints(scene, t + h, end, right)
        least = evaluate(scene, t + NODES[stage] * h, end, k[stage], right)
        if not least > SINGULAR:
            return math.nan
    square = 0.0
    for i in range(size):
        wrong = 0.0
        for j in range(STAGES):
            wrong += ERROR[j] * k[j, i]
        part = h * wrong * weights[i]
        square += part * part
    return math.sqrt(square / size)


@compiled
def fit(h: float, y: Vector, end: Vector, k: Matrix, path: Matrix) -> None:
    """Write the coefficients of the interpolation over a step of h [s] into `path`, shape (5, states)."""
    combine(INNER, k, STAGES, y.size, path[4])
    for i in range(y.size):
        change = end[i] - y[i]
        bend = h * k[0, i] - change
        path[0, i] = y[i]
        path[1, i] = change
        path[2, i] = bend
        path[3, i] = change - h * k[6, i] - bend
        path[4, i] *= h


@compiled
def within(path: Matrix, x: float, start: int, stop: int, out: Vector) -> None:
    """Write components `start` to `stop` of the state at a fraction x of the step, 0 to 1, into `out`."""
    z = 1.0 - x
    for i in range(start, stop):
        out[i] = path[0, i] + x * (path[1, i] + z * (path[2, i] + x * (path[3, i] + z * path[4, i])))
