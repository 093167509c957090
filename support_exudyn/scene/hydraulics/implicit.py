"""States of hydraulic legs at the end of a step, by the trapezoidal rule.

z1 = z0 + h/2 (f(z0) + f(z1)),   with the lengths and rates that both ends of the step have

It is of second order, damps nothing that it need not, stays finite however stiff a valve, a stop or a poppet
is, and keeps sums that the rates keep, such as that of all oil. What is only booked follows from the rest.
"""

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.scene.compilation import compiled, entry
from support_exudyn.scene.hydraulics.leg import press_all
from support_exudyn.scene.hydraulics.records import Matrix, Records

Places = npt.NDArray[np.int64]
ROUNDS, HALVINGS = 60, 12  # of Newton's method; of a step of it that makes nothing better
SHIFT = 1e-7  # of what a state is of, over which rates are differenced
FOUND = 1e-10  # the same, by which a state changes when it has been found: the next change would be its square
SOLVED = 1e-15  # the same, of what is left of the equations, with which there is nothing to solve


@compiled
def fill_rest(
    h: float,
    weights: Series,
    y0: Series,
    rates0: Series,
    y: Series,
    slope: Series,
    places: Places,
    rows: Matrix,
) -> float:
    """Write what is left of the equations into the last column of `rows`; the most of it, by weights."""
    most, m = 0.0, rows.shape[0]
    for i in range(m):
        k = places[i]
        rows[i, m] = y0[k] + 0.5 * h * (rates0[k] + slope[k]) - y[k]
        left = abs(rows[i, m]) * weights[k]
        if not left <= most:
            most = left
    return float(most)


@compiled
def eliminate(rows: Matrix) -> None:
    """Solve rows[:, :m] x = rows[:, m] by Gauss's elimination with pivots; x is written into rows[:, 0]."""
    m = rows.shape[0]
    for i in range(m):
        best = i
        for k in range(i + 1, m):
            if abs(rows[k, i]) > abs(rows[best, i]):
                best = k
        for j in range(i, m + 1):
            rows[i, j], rows[best, j] = rows[best, j], rows[i, j]
        for k in range(i + 1, m):
            factor = rows[k, i] / rows[i, i]
            for j in range(i, m + 1):
                rows[k, j] -= factor * rows[i, j]
    for i in range(m - 1, -1, -1):
        for j in range(i + 1, m):
            rows[i, m] -= rows[i, j] * rows[j, m]
        rows[i, m] /= rows[i, i]
    for i in range(m):
        rows[i, 0] = rows[i, m]


@compiled
def linearise(
    legs: Records,
    pumps: Records,
    gaps: Matrix,
    h: float,
    weights: Series,
    y: Series,
    slope: Series,
    places: Places,
    rows: Matrix,
) -> None:
    """Write 1 - h/2 df/dz into the columns of `rows` but the last, by differences."""
    m = rows.shape[0]
    for i in range(m):
        rows[i, m] = slope[places[i]]
    for j in range(m):
        kept = y[places[j]]
        y[places[j]] = kept + SHIFT / weights[places[j]]
        shift = y[places[j]] - kept
        press_all(legs, pumps, gaps, y, slope)
        y[places[j]] = kept
        for i in range(m):
            rate = (slope[places[i]] - rows[i, m]) / shift
            rows[i, j] = (1.0 if i == j else 0.0) - 0.5 * h * rate
    for i in range(m):
        slope[places[i]] = rows[i, m]


@entry
def advance_legs(
    legs: Records,
    pumps: Records,
    gaps: Matrix,
    h: float,
    weights: Series,
    y0: Series,
    rates0: Series,
    y: Series,
    slope: Series,
    places: Places,
    rows: Matrix,
) -> bool:
    """Find the states of all legs, and of their pump, at the end of a step of h [s]; whether they were found.

    By Newton's method; where a whole step of it makes nothing better, by a part of it. With h = 0 the states
    are those of the start. Records tell lengths, rates and inlets at the end, and take what follows.

    Arguments:
        legs, pumps, gaps: see `press_all`.
        weights: one over what each state is of.
        y0, rates0: states and their rates at the start. y, slope: those at the end, which are written.
        places: of the m states that are solved for, then of those that are only booked.
        rows: room, shape (m, m + 1).
    """
    m = rows.shape[0]
    for i in range(y.size):
        y[i] = y0[i]
    press_all(legs, pumps, gaps, y, slope)
    if h == 0.0:
        return True
    left = fill_rest(h, weights, y0, rates0, y, slope, places, rows)
    found = left <= SOLVED
    for _ in range(ROUNDS):
        if found:
            break
        linearise(legs, pumps, gaps, h, weights, y, slope, places, rows)
        fill_rest(h, weights, y0, rates0, y, slope, places, rows)
        eliminate(rows)
        change = 0.0
        for i in range(m):
            size = abs(rows[i, 0]) * weights[places[i]]
            y[places[i]] += rows[i, 0]
            if not size <= change:
                change = size
        found, share = change <= FOUND, 1.0
        press_all(legs, pumps, gaps, y, slope)
        then = fill_rest(h, weights, y0, rates0, y, slope, places, rows)
        for _ in range(HALVINGS):
            if found or then < left:
                break
            share *= 0.5
            for i in range(m):
                y[places[i]] -= share * rows[i, 0]
            press_all(legs, pumps, gaps, y, slope)
            then = fill_rest(h, weights, y0, rates0, y, slope, places, rows)
        left = then
    for i in range(m, y.size):
        k = places[i]
        y[k] = y0[k] + 0.5 * h * (rates0[k] + slope[k])
    return found
