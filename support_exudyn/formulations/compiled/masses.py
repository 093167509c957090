"""How easily journals move against their bores at an instant, with what else is pressed.

`mechanics.pressed_pins` says the same of numpy's matrices; here it is compiled, for every impact of a run asks.
"""

import math

from support_exudyn.formulations.compilation import compiled, once
from support_exudyn.formulations.compiled.arrays import Matrix, SceneArrays, Scratch, Vector
from support_exudyn.formulations.compiled.forces import axes_of
from support_exudyn.formulations.compiled.motion import divide, rate_of, respond
from support_exudyn.mechanics.pressed_pins import GIVES, NEAR, SAME


@compiled
def row_of(scene: SceneArrays, n: int, ux: float, uy: float, out: Vector) -> None:
    """Write what a contact's eccentricity, or its slip, along a direction gains by velocities of all bodies."""
    for i in range(out.size):
        out[i] = 0.0
    contact = scene.contacts[n]
    bore, journal = scene.points[contact.first], scene.points[contact.second]
    if journal.body >= 0:
        i = 3 * journal.body
        out[i] += ux
        out[i + 1] += uy
        out[i + 2] += journal.rx * uy - journal.ry * ux
    if bore.body >= 0:
        i = 3 * bore.body
        rx, ry = bore.rx, bore.ry
        if contact.slot != 0:  # what of the guide is there now
            rx, ry = rx + journal.x - bore.x, ry + journal.y - bore.y
        out[i] -= ux
        out[i + 1] -= uy
        out[i + 2] -= rx * uy - ry * ux


@compiled
def answer(scene: SceneArrays, row: Vector, right: Vector, out: Vector) -> None:
    """Write the velocities of all bodies by an impulse along a row; rows and factors are those of now."""
    for n in range(scene.bodies.size):
        body, i = scene.bodies[n], 3 * n
        out[i], out[i + 1], out[i + 2] = (
            body.light * row[i],
            body.light * row[i + 1],
            body.light_turn * row[i + 2],
        )
    for k in range(scene.rows.size):
        right[k] = rate_of(scene, k, out, 0)
    divide(scene, right)
    respond(scene, right, out, 0)


@once
def is_pressed(scene: SceneArrays, n: int) -> bool:
    """Whether a contact's surfaces overlap, or touch."""
    contact = scene.contacts[n]
    return bool(contact.depth > -NEAR * contact.clearance)


@compiled
def solved(square: Matrix, right: Matrix, count: int, columns: int) -> None:
    """Solve square x = right in place, of a semidefinite matrix with ones on its diagonal (k, k).

    By Cholesky's method; what depends on the rows before is left out, which changes nothing of a right side
    that lies in its range. Only so many rows and columns are looked at.
    """
    for i in range(count):
        for j in range(i + 1):
            total = square[i, j]
            for k in range(j):
                total -= square[i, k] * square[j, k]
            if j < i:
                square[i, j] = total / square[j, j] if square[j, j] > 0.0 else 0.0
            elif total > SAME:
                square[i, i] = math.sqrt(total)
            else:
                for k in range(i):
                    square[i, k] = 0.0
                square[i, i] = 0.0
    for c in range(columns):
        for i in range(count):
            if square[i, i] == 0.0:
                right[i, c] = 0.0
                continue
            total = right[i, c]
            for k in range(i):
                total -= square[i, k] * right[k, c]
            right[i, c] = total / square[i, i]
        for i in range(count - 1, -1, -1):
            if square[i, i] == 0.0:
                continue
            total = right[i, c]
            for k in range(i + 1, count):
                total -= square[k, i] * right[k, c]
            right[i, c] = total / square[i, i]


@compiled
def renew_mass(scene: SceneArrays, room: Scratch, n: int, v: Vector) -> None:
    """Remember how easily a journal moves against its bore now, held by what else is pressed.

    Arguments:
        v: the state, whose velocities tell which corners land at once.
    """
    count = scene.contacts.size
    rows, answers, gram, square, sides, sizes = (
        room.lines,
        room.answers,
        room.gram,
        room.square,
        room.sides,
        room.sizes,
    )
    contact = scene.contacts[n]
    row_of(scene, n, 1.0, 0.0, rows[0])
    row_of(scene, n, 0.0, 1.0, rows[1])
    used = 2
    for m in range(count):
        if m != n and is_pressed(scene, m):
            other = scene.contacts[m]
            row_of(scene, m, other.nx, other.ny, rows[used])
            used += 1
    for k in range(used):
        answer(scene, rows[k], room.right, answers[k])
    for i in range(used):
        for j in range(used):
            total = 0.0
            for k in range(3 * scene.bodies.size):
                total += rows[i, k] * answers[j, k]
            gram[i, j] = total
    xx, xy, yy = gram[0, 0], gram[0, 1], gram[1, 1]
    moving = 0
    for k in range(2, used):
        if gram[k, k] > 0.0:
            sizes[moving] = math.sqrt(gram[k, k])
            for j in range(rows.shape[1]):
                rows[2 + moving, j] = rows[k, j]
            for j in range(used):
                gram[2 + moving, j] = gram[k, j]
            for j in range(used):
                gram[j, 2 + moving] = gram[j, k]
            moving += 1
    for i in range(moving):
        for j in range(moving):
            square[i, j] = gram[2 + i, 2 + j] / (sizes[i] * sizes[j])
        sides[i, 0], sides[i, 1] = gram[0, 2 + i] / sizes[i], gram[1, 2 + i] / sizes[i]
    solved(square, sides, moving, 2)
    keep = 1.0 - GIVES
    for i in range(moving):
        one, two = gram[0, 2 + i] / sizes[i], gram[1, 2 + i] / sizes[i]
        xx -= keep * one * sides[i, 0]
        xy -= keep * one * sides[i, 1]
        yy -= keep * two * sides[i, 1]
    c, s = axes_of(scene, n)
    contact.xx = c * c * xx + 2.0 * c * s * xy + s * s * yy
    contact.xy = (c * c - s * s) * xy + c * s * (yy - xx)
    contact.yy = s * s * xx - 2.0 * c * s * xy + c * c * yy
    if contact.slot != 0 and moving > 0:
        mass = mass_together(scene, room, n, v, moving)
        if mass > 0.0:
            contact.yy = 1.0 / mass


@once
def mass_together(scene: SceneArrays, room: Scratch, n: int, v: Vector, moving: int) -> float:
    """The mass of a corner that impacts with others, see `pressed_pins.struck_together`; 0: none does."""
    contact = scene.contacts[n]
    coordinates = 3 * scene.bodies.size
    rows, gram, square, right, sizes = room.lines, room.gram, room.square, room.sides, room.sizes
    nx, ny = contact.nx, contact.ny
    closing = 0.0
    for i in range(coordinates):
        closing += (nx * rows[0, i] + ny * rows[1, i]) * v[coordinates + i]
    own = nx * nx * gram[0, 0] + 2.0 * nx * ny * gram[0, 1] + ny * ny * gram[1, 1]
    if not (closing > 0.0 < own):
        return 0.0
    sizes[0] = math.sqrt(own)
    others = 0.0
    right[0, 0] = closing / sizes[0]
    square[0, 0] = 1.0
    for i in range(moving):
        sizes[1 + i] = math.sqrt(gram[2 + i, 2 + i])
        speed = 0.0
        for j in range(coordinates):
            speed += rows[2 + i, j] * v[coordinates + j]
        others += max(speed, 0.0)
        right[1 + i, 0] = max(speed, 0.0) / sizes[1 + i]
        square[1 + i, 0] = square[0, 1 + i] = (nx * gram[0, 2 + i] + ny * gram[1, 2 + i]) / (
            sizes[0] * sizes[1 + i]
        )
    if others == 0.0:
        return 0.0
    for i in range(moving):
        for j in range(moving):
            square[1 + i, 1 + j] = gram[2 + i, 2 + j] / (sizes[1 + i] * sizes[1 + j])
    solved(square, right, moving + 1, 1)
    return float(right[0, 0] / sizes[0] / closing)
