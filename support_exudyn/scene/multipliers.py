"""Multipliers of the joints and accelerations of the bodies, from forces and what the joints demand.

Mass matrix M, constraint Jacobian C, applied forces f and what the joints demand, w, give

    C M^-1 C^T L = C M^-1 f - w,    a = M^-1 (f - C^T L)

by factors L D L^T of the square matrix, kept in its envelope: row after row, from its first column on. Indices
are unsigned, since numba asks of all others whether they are negative: that doubles the time of short loops.
"""

import math

import numpy as np

from support_exudyn.mechanics.closing import Conditions
from support_exudyn.scene.arrays import Elimination, Matrix, Records, SceneArrays, Unsigned, Vector
from support_exudyn.scene.compilation import compiled, inlined, often

SETTLED = 1e-13  # share by which moments that depend on accelerations may still change
# Factors lose as many digits as the lightest body is lighter than the heaviest. So little may be left of that.
DIGIT, CLOSE = 1e-15, 1e-13
MOST_ROUNDS = 30
SINGULAR = 1e-11  # share of a row's own square that is left where rows repeat each other: a dead centre
ONE, TWO = np.uint64(1), np.uint64(2)
SIDES = (("body", "x"), ("other", "ox"), ("carrier", "carrier_x"))  # of a row: its body, first coefficient


def elimination_of(rows: Records, lightness: Vector, repeats: bool) -> Elimination:
    """The structure of C M^-1 C^T: which rows share a body, and the envelope of its factors.

    Arguments:
        rows: of all joints, with their bodies.
        lightness: one over masses and inertias (3 bodies,).
        repeats: whether rows repeat others.
    """
    width, names, count = rows.itemsize // 8, list(rows.dtype.names or ()), len(rows)
    sides = [
        (i, int(row[body]), width * i + names.index(start))
        for i, row in enumerate(rows)
        for body, start in SIDES
        if row[body] >= 0
    ]
    by_body = [[(i, place) for i, body, place in sides if body == b] for b in range(lightness.size // 3)]
    pairs = [(i, j) for own in by_body for n, (i, _) in enumerate(own) for j, _ in own[: n + 1]]
    first = np.arange(count)
    for i, j in pairs:
        first[i] = min(first[i], j)
    begins = np.cumsum([0, *(np.arange(count) - first + 1)])
    return Elimination(
        coefficients=rows.view(np.float64).reshape(-1),
        lightness=lightness,
        sides=_unsigned([(3 * body, place) for _, body, place in sides]).reshape(-1, 2),
        side_ends=_unsigned(np.cumsum([sum(n == i for n, _, _ in sides) for i in range(count)])),
        places=_unsigned([place for own in by_body for _, place in own]),
        place_ends=_unsigned(np.cumsum([len(own) for own in by_body])),
        targets=_unsigned([begins[i] + j - first[i] for i, j in pairs]),
        first=_unsigned(first),
        begins=_unsigned(begins[:-1]),
        square=np.zeros(begins[-1]),
        inverse=np.zeros((count, count) if repeats else (0, 0)),
    )


def _unsigned(numbers: object) -> Unsigned:
    return np.array(numbers, np.uint64)


@inlined
def assemble(structure: Elimination) -> None:
    """Write C M^-1 C^T within its envelope, body after body."""
    coefficients, lightness, square = structure.coefficients, structure.lightness, structure.square
    for n in range(square.size):
        square[n] = 0.0
    begin = term = np.uint64(0)
    for b in range(structure.place_ends.size):
        end = structure.place_ends[b]
        for p in range(begin, end):
            at = structure.places[p]
            x, y = lightness[3 * b] * coefficients[at], lightness[3 * b + 1] * coefficients[at + ONE]
            t = lightness[3 * b + 2] * coefficients[at + TWO]
            for q in range(begin, p + ONE):
                at = structure.places[q]
                part = x * coefficients[at] + y * coefficients[at + ONE] + t * coefficients[at + TWO]
                square[structure.targets[term]] += part
                term += ONE
        begin = end


@often
def factor(scene: SceneArrays) -> float:
    """Write C M^-1 C^T as its factors L, and 1 / D on the diagonal; the least share that is left of a row."""
    structure = scene.elimination
    assemble(structure)
    if scene.repeats.shape[0] > 0:
        return invert_repeated(scene)
    square, first, begins = structure.square, structure.first, structure.begins
    least = 1.0
    for i in range(np.uint64(first.size)):
        start = first[i]
        row = begins[i] - start  # its columns stand from here on
        for j in range(start, i):
            other = begins[j] - first[j]
            total = square[row + j]
            for k in range(max(start, first[j]), j):
                total -= square[row + k] * square[other + k]
            square[row + j] = total
        own = left = square[row + i]
        for j in range(start, i):
            total = square[row + j]
            scaled = total * square[begins[j] - first[j] + j]
            square[row + j] = scaled
            left -= total * scaled
        if not left >= least * own:
            least = left / own
        square[row + i] = 1.0 / left
    return least


@often
def divide(scene: SceneArrays, right: Vector) -> None:
    """Solve C M^-1 C^T x = right by the factors; x stands in `right` afterwards."""
    structure = scene.elimination
    if scene.repeats.shape[0] > 0:
        divide_repeated(scene, right)
        return
    square, first, begins = structure.square, structure.first, structure.begins
    count = np.uint64(right.size)
    for i in range(count):
        row = begins[i] - first[i]
        total = right[i]
        for k in range(first[i], i):
            total -= square[row + k] * right[k]
        right[i] = total
    for i in range(count):
        right[i] *= square[begins[i] - first[i] + i]
    for n in range(count):
        m = count - ONE - n
        row = begins[m] - first[m]
        value = right[m]
        for k in range(first[m], m):
            right[k] -= square[row + k] * value


@often
def row_rates(scene: SceneArrays, v: Vector, start: int, rates: Vector) -> None:
    """Write C v for velocities or accelerations that stand in `v` from `start` on."""
    structure, begin, side = scene.elimination, np.uint64(start), np.uint64(0)
    coefficients = structure.coefficients
    for i in range(structure.side_ends.size):
        total = 0.0
        for n in range(side, structure.side_ends[i]):
            k, at = begin + structure.sides[n, 0], structure.sides[n, 1]
            total += coefficients[at] * v[k] + coefficients[at + ONE] * v[k + ONE]
            total += coefficients[at + TWO] * v[k + TWO]
        side = structure.side_ends[i]
        rates[i] = total


@often
def respond(scene: SceneArrays, multipliers: Vector, v: Vector, start: int) -> None:
    """Take M^-1 C^T L off velocities, displacements or accelerations that stand in `v` from `start` on."""
    structure, begin, side = scene.elimination, np.uint64(start), np.uint64(0)
    coefficients, lightness = structure.coefficients, structure.lightness
    for i in range(structure.side_ends.size):
        size = multipliers[i]
        for n in range(side, structure.side_ends[i]):
            b, at = structure.sides[n, 0], structure.sides[n, 1]
            k = begin + b
            v[k] -= lightness[b] * coefficients[at] * size
            v[k + ONE] -= lightness[b + ONE] * coefficients[at + ONE] * size
            v[k + TWO] -= lightness[b + TWO] * coefficients[at + TWO] * size
        side = structure.side_ends[i]


@inlined
def solve(scene: SceneArrays, right: Vector, slope: Vector) -> None:
    """Write multipliers, and accelerations into `slope`, under the forces on the bodies; `right` is scratch."""
    lightness, count = scene.elimination.lightness, 3 * scene.bodies.size
    for n in range(scene.bodies.size):
        body, i, j = scene.bodies[n], 3 * n, count + 3 * n
        slope[j], slope[j + 1] = lightness[i] * body.fx, lightness[i + 1] * body.fy
        slope[j + 2] = lightness[i + 2] * body.m
        body.given = 0.0
    row_rates(scene, slope, count, right)
    for n in range(scene.rows.size):
        right[n] -= scene.rows[n].wanted
    divide(scene, right)
    for n in range(scene.rows.size):
        scene.rows[n].held = right[n]
    respond(scene, right, slope, count)
    for _ in range(1, scene.rounds):
        if not refine(scene, right, slope):
            break


@compiled
def refine(scene: SceneArrays, right: Vector, slope: Vector) -> bool:
    """Correct multipliers and accelerations by what the equations are open by; whether that may help further.

    Beside light bodies the factors lose digits. They contain an inertia `stand_in` for a point mass: a moment,
    from the acceleration before, gives that back.
    """
    lightness, count = scene.elimination.lightness, 3 * scene.bodies.size
    changed = largest = 0.0
    for n in range(scene.bodies.size):
        body, i, j = scene.bodies[n], 3 * n, count + 3 * n
        given = body.stand_in * slope[j + 2]
        changed = max(changed, abs(given - body.given))
        largest = max(largest, abs(given))
        body.given = given
        slope[j], slope[j + 1] = lightness[i] * body.fx, lightness[i + 1] * body.fy
        slope[j + 2] = lightness[i + 2] * (body.m + given)
    for n in range(scene.rows.size):
        right[n] = scene.rows[n].held
    respond(scene, right, slope, count)
    row_rates(scene, slope, count, right)
    for n in range(scene.rows.size):
        right[n] -= scene.rows[n].wanted
    divide(scene, right)
    for n in range(scene.rows.size):
        scene.rows[n].held += right[n]
    respond(scene, right, slope, count)
    return largest == 0.0 or changed > SETTLED * largest


# --- rows that repeat others ---


@compiled
def unpack(structure: Elimination, full: Matrix, own: Vector) -> None:
    """Write C M^-1 C^T in full, and its diagonal."""
    for i in range(own.size):
        for j in range(own.size):
            full[i, j] = 0.0
    for i in range(own.size):
        start = int(structure.first[i])
        for j in range(start, i + 1):
            full[i, j] = full[j, i] = structure.square[int(structure.begins[i]) + j - start]
        own[i] = full[i, i]


@compiled
def invert_repeated(scene: SceneArrays) -> float:
    """Write the inverse of what is left of C M^-1 C^T without the rows that repeat others.

    The method of Gauss and Jordan takes that row next of which the largest share is left. Rows that remain at
    the end give `SceneArrays.repeats`. Returns the least share that was left of a row taken.
    """
    square, repeats, own = scene.elimination.inverse, scene.repeats, scene.spare
    count = own.size
    unpack(scene.elimination, square, own)
    least = 1.0
    for _ in range(count - repeats.shape[0]):
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
                repeats[n, j] = -square[j, i] if own[j] == 0.0 else 0.0
                square[i, j] = square[j, i] = 0.0
            repeats[n, i] = 1.0
            n += 1
    for n in range(repeats.shape[0]):  # perpendicular to each other and of length 1, counted by `counts`
        for k in range(n + 1):
            product = 0.0
            for j in range(count):
                product += repeats[n, j] * repeats[k, j] / scene.counts[j] ** (2 if k == n else 1)
            for j in range(count):
                if k == n:
                    repeats[n, j] /= scene.counts[j] * math.sqrt(product)
                else:
                    repeats[n, j] -= product * repeats[k, j] * scene.counts[j]
    return least


@compiled
def divide_repeated(scene: SceneArrays, right: Vector) -> None:
    """See `divide`, where rows repeat others: of all x that fit the least, counted by `SceneArrays.counts`."""
    inverse, repeats, found, counts = scene.elimination.inverse, scene.repeats, scene.spare, scene.counts
    for i in range(right.size):
        found[i] = 0.0
        for j in range(right.size):
            found[i] += inverse[i, j] * right[j]
    for n in range(repeats.shape[0]):
        product = 0.0
        for i in range(right.size):
            product += repeats[n, i] * found[i] / counts[i]
        for i in range(right.size):
            found[i] -= product * repeats[n, i] * counts[i]
    for i in range(right.size):
        right[i] = found[i]


def rounds_of(held: Conditions) -> int:
    """In how many rounds multipliers and accelerations are solved for, see `refine`."""
    felt = held.kinetics.mass() / held.arms**2
    lost = DIGIT * felt.max() / max(felt.min(), DIGIT * felt.max())  # all of a point mass
    return MOST_ROUNDS if lost >= CLOSE**0.1 else max(1, math.ceil(math.log(CLOSE) / math.log(lost)))
