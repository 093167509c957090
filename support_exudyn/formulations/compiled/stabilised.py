"""Long steps where friction, oil or a dashpot is steep: the Runge-Kutta-Chebyshev method of order 2.

A step of s stages is stable for decays up to about 0.65 s^2 / h, where Dormand and Prince's method of six
stages takes 3.3 / h. It is taken where that one's steps are as short as its stability asks for and not its
accuracy: the fastest decay is measured now and then, by the power method.

Source: Sommeijer, Shampine and Verwer, RKC: an explicit solver for parabolic PDEs, J. Comput. Appl. Math. 88
(1998) 315-326.
"""

import math

from support_exudyn.formulations.compiled.step import close_joints, evaluate
from support_exudyn.scene.arrays import STAGES, Matrix, SceneArrays, Vector
from support_exudyn.scene.compilation import compiled
from support_exudyn.scene.motion import SINGULAR

DAMPING = 2.0 / 13.0
STABLE = 1.54  # (s^2 - 1) that a product of step and fastest decay asks for, over it
MOST_STAGES = 200
# step times fastest decay beyond which the explicit method is held up by its stability, not its error
STIFF_AT = 1.5
PATIENCE = 50  # steps of the explicit method after which that is looked for
AT_FIRST = 2.0  # times as long is the first step of this method as those before: it damps what they leave
STRICTER = 4.0  # times that errors count: those of order 2 remain, those of order 5 are below what is allowed
MARGIN = 1.2  # on the fastest decay that has been measured
STRAIGHT = 0.5  # cosine between a state's way and its way back, from which on that is a decay
SHIFT = 1e-2  # of the error that a step may have, over which rates are compared: far more than rounding
ROUNDS = 3  # of looking for the fastest decay, each along what the one before has shown
RENEWED = 25  # steps after which it is looked for again, and whether the method is of use


@compiled
def stages_for(product: float) -> int:
    """How many stages a step takes whose length times the fastest decay is this product."""
    return min(MOST_STAGES, 1 + int(math.sqrt(1.0 + STABLE * product)))


@compiled
def longest(decay: float) -> float:
    """The longest step [s] for a fastest decay [1/s]."""
    return ((MOST_STAGES - 1.0) ** 2 - 1.0) / (STABLE * decay)


@compiled
def square_of(direction: Vector, weights: Vector) -> float:
    """Square of the length of a direction, in units of what a step may err by."""
    square = 0.0
    for i in range(direction.size):
        square += (direction[i] * weights[i]) ** 2
    return square


@compiled
def fastest_decay(
    scene: SceneArrays, t: float, y: Vector, k: Matrix, along: Vector, weights: Vector, right: Vector
) -> float:
    """The fastest decay [1/s] of a state whose rate is k[0], by the power method from a direction `along`.

    0 if what changes fastest does not go back along its own direction: that is a swing, or a state that another
    one moves, which this method does not help. k[1] and k[2] are overwritten, `along` is the direction found;
    where it is none, at the start or after a search that came to nothing, any direction takes its place.
    """
    found = back = 0.0
    if not square_of(along, weights) > 0.0:
        for i in range(y.size):
            along[i] = (1.0 + 0.1 * (i % 7)) / weights[i]
    for _ in range(ROUNDS):
        size = square_of(along, weights)
        if not size > 0.0:
            return found
        share = SHIFT / math.sqrt(size)
        for i in range(y.size):
            k[1, i] = y[i] + share * along[i]
        evaluate(scene, t, k[1], k[2], right)
        before, size, back = size, 0.0, 0.0
        for i in range(y.size):
            change = k[2, i] - k[0, i]
            back -= change * along[i] * weights[i] * weights[i]
            size += (change * weights[i]) ** 2
            along[i] = change
        found = math.sqrt(size) / SHIFT
        back /= math.sqrt(before * size) if size > 0.0 else 1.0
    return MARGIN * found if back > STRAIGHT else 0.0


@compiled
def advance_stabilised(
    scene: SceneArrays,
    t: float,
    h: float,
    decay: float,
    y: Vector,
    k: Matrix,
    end: Vector,
    weights: Vector,
    right: Vector,
) -> float:
    """Try a step of h [s] from t with k[0] the rate there; its error in units of what is allowed.

    Writes the state at the end into `end` and its rate into the last row of k; other rows are overwritten.
    """
    s = max(2, stages_for(h * decay))
    w0 = 1.0 + DAMPING / (s * s)
    # Chebyshev's polynomials and both derivatives at w0, up to the last
    before, now, slope_before, slope, bend_before, bend = 1.0, w0, 0.0, 1.0, 0.0, 0.0
    for _ in range(2, s + 1):
        before, now, slope_before, slope, bend_before, bend = (
            now,
            2.0 * w0 * now - before,
            slope,
            2.0 * w0 * slope - slope_before + 2.0 * now,
            bend,
            2.0 * w0 * bend - bend_before + 4.0 * slope,
        )
    w1 = slope / bend
    b_before = b_now = 1.0 / (4.0 * w0 * w0)  # b0 = b1 = b2
    first = w1 * b_now
    older, newer, rate = k[1], k[2], k[3]
    for i in range(y.size):
        older[i], newer[i] = y[i], y[i] + first * h * k[0, i]
    c_older, c_newer = 0.0, first
    before, now, slope_before, slope, bend_before, bend = 1.0, w0, 0.0, 1.0, 0.0, 0.0
    for _ in range(2, s + 1):
        part = 1.0 - b_now * now  # a of the stage before
        before, now, slope_before, slope, bend_before, bend = (
            now,
            2.0 * w0 * now - before,
            slope,
            2.0 * w0 * slope - slope_before + 2.0 * now,
            bend,
            2.0 * w0 * bend - bend_before + 4.0 * slope,
        )
        b = bend / (slope * slope)
        mu, nu, weight = 2.0 * b * w0 / b_now, -b / b_before, 2.0 * b * w1 / b_now
        if not evaluate(scene, t + c_newer * h, newer, rate, right) > SINGULAR:
            return math.nan
        for i in range(y.size):
            older[i] = (
                (1.0 - mu - nu) * y[i] + mu * newer[i] + nu * older[i] + weight * h * (rate[i] - part * k[0, i])
            )
        older, newer = newer, older
        c_older, c_newer = c_newer, mu * c_newer + nu * c_older + weight * (1.0 - part)
        b_before, b_now = b_now, b
    for i in range(y.size):
        end[i] = newer[i]
    close_joints(scene, t + h, end, right)
    if not evaluate(scene, t + h, end, k[STAGES - 1], right) > SINGULAR:
        return math.nan
    square = 0.0
    for i in range(y.size):
        # of the end before joints were closed: by how much they are, no shorter step makes less
        wrong = 0.8 * (y[i] - newer[i]) + 0.4 * h * (k[0, i] + k[STAGES - 1, i])
        square += (wrong * weights[i]) ** 2
    return STRICTER * math.sqrt(square / y.size)


@compiled
def fit_cubic(h: float, y: Vector, end: Vector, k: Matrix, path: Matrix) -> None:
    """Write the cubic through states and rates at both ends as the coefficients of `step.fit`."""
    for i in range(y.size):
        change = end[i] - y[i]
        bend = h * k[0, i] - change
        path[0, i], path[1, i], path[2, i] = y[i], change, bend
        path[3, i], path[4, i] = change - h * k[STAGES - 1, i] - bend, 0.0
