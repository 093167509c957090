"""Motion of joints and points, and what forces do to the coordinates; compiled, for every stage of a step.

All functions of this file work on these arrays:

    links (n, 3): number of the carrier (-1: ground), joint from the carrier's joint, at the start [m]
    points (p, 3): number of the link (-1: ground), point from its joint, at the start [m]
    actuators (c, 4): bulk modulus times area [N], oil length [m], damping time [s], natural length [m]
    drive (c, 5): a time [s], and coefficients of the cubic by which the actuator extends after it [m/s^k]
    work (n + p, 9): of joints, then of points: the quantities below

Points come in pairs: first bore and journal of each clearance pin, then foot and head of each actuator.
"""

import math

from support_exudyn.formulations.compilation import entry
from support_exudyn.formulations.tree.branches import Matrix

# columns of `work`; of points only the first five. FORCE: moment on the coordinate [N m]
X, Y, SPEED_X, SPEED_Y, SPIN, TURN, COS, SIN, FORCE, WIDTH = range(10)


@entry
def move(links: Matrix, points: Matrix, work: Matrix, state: tuple[float, ...]) -> None:
    """Write where all joints and points are and how they move; forces become zero."""
    n = links.shape[0]
    for i in range(n):
        carrier = int(links[i, 0])
        x, y = links[i, 1], links[i, 2]
        vx = vy = spin = turn = 0.0
        if carrier >= 0:
            c, s = work[carrier, COS], work[carrier, SIN]
            turn, spin = work[carrier, TURN], work[carrier, SPIN]
            dx, dy = c * x - s * y, s * x + c * y
            x, y = work[carrier, X] + dx, work[carrier, Y] + dy
            vx, vy = work[carrier, SPEED_X] - spin * dy, work[carrier, SPEED_Y] + spin * dx
        turn += state[i]
        work[i, X], work[i, Y], work[i, SPEED_X], work[i, SPEED_Y] = x, y, vx, vy
        work[i, SPIN], work[i, TURN] = spin + state[n + i], turn
        work[i, COS], work[i, SIN], work[i, FORCE] = math.cos(turn), math.sin(turn), 0.0
    for k in range(points.shape[0]):
        link, row = int(points[k, 0]), n + k
        x, y = points[k, 1], points[k, 2]
        if link < 0:
            work[row, X], work[row, Y] = x, y
        else:
            c, s, spin = work[link, COS], work[link, SIN], work[link, SPIN]
            dx, dy = c * x - s * y, s * x + c * y
            work[row, X], work[row, Y] = work[link, X] + dx, work[link, Y] + dy
            work[row, SPEED_X], work[row, SPEED_Y] = (
                work[link, SPEED_X] - spin * dy,
                work[link, SPEED_Y] + spin * dx,
            )
            work[row, SPIN] = spin


@entry
def load(links: Matrix, work: Matrix, link: int, x: float, y: float, fx: float, fy: float) -> None:
    """Add the moments that a force [N] on a link at a point of space [m] has about all joints below it."""
    while link >= 0:
        work[link, FORCE] += (x - work[link, X]) * fy - (y - work[link, Y]) * fx
        link = int(links[link, 0])


@entry
def push(
    links: Matrix, points: Matrix, work: Matrix, pair: int, x: float, y: float, fx: float, fy: float
) -> None:
    """Add a force [N] on the second body of a pair of points and its reverse on the first, both at x, y [m]."""
    load(links, work, int(points[2 * pair + 1, 0]), x, y, fx, fy)
    load(links, work, int(points[2 * pair, 0]), x, y, -fx, -fy)


@entry
def evaluate(
    links: Matrix, points: Matrix, actuators: Matrix, drive: Matrix, work: Matrix, t: float, *state: float
) -> None:
    """Motion and forces of actuators at t [s] in a state: all coordinates [rad], then all rates [rad/s]."""
    move(links, points, work, state)
    pins = points.shape[0] // 2 - actuators.shape[0]
    for c in range(actuators.shape[0]):
        after = t - drive[c, 0]
        extension = drive[c, 1] + after * (drive[c, 2] + after * (drive[c, 3] + after * drive[c, 4]))
        speed = drive[c, 2] + after * (2.0 * drive[c, 3] + after * 3.0 * drive[c, 4])
        pair = pins + c
        foot = links.shape[0] + 2 * pair
        head = foot + 1
        dx, dy = work[head, X] - work[foot, X], work[head, Y] - work[foot, Y]
        length = math.sqrt(dx * dx + dy * dy)
        ux, uy = dx / length, dy / length
        rate = (work[head, SPEED_X] - work[foot, SPEED_X]) * ux + (
            work[head, SPEED_Y] - work[foot, SPEED_Y]
        ) * uy
        compression = actuators[c, 3] + extension - length + actuators[c, 2] * (speed - rate)
        force = actuators[c, 0] / (actuators[c, 1] + extension) * compression
        # a force along the line through both points may act anywhere on it
        push(links, points, work, pair, work[foot, X], work[foot, Y], force * ux, force * uy)
