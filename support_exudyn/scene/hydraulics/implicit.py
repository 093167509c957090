"""Legs in steps of a given length: their states at the end of a step, and whether something happens in it.

z1 = z0 + h/2 (f(z0) + f(z1)),   with the lengths and rates that both ends of the step have

The trapezoidal rule is of second order, damps nothing that it need not, stays finite however stiff a valve, a
stop or a poppet is, and keeps sums that the rates keep, such as that of all oil. Integrals follow from the
rest.
"""

import math

import numpy as np
import numpy.typing as npt

from support_exudyn.scene.compilation import compiled, entry
from support_exudyn.scene.hydraulics.leg import powers_of, press_all, press_leg
from support_exudyn.scene.hydraulics.records import LegArrays, Matrix, Vector

Places = npt.NDArray[np.int64]
NEWTON_ROUNDS, HALVINGS = 60, 12  # of Newton's method; of a step of it that makes nothing better
SHIFT = 1e-7  # of what a state is of, over which rates are differenced
CONVERGED = 1e-10  # the same, by which a state changes in the last round: the next change would be its square
SOLVED = 1e-15  # the same, of the residual, with which there is nothing to solve
AHEAD = 1e-5  # of a step, over which gaps are differenced
# rows of what is known of the states: one over what each is of, values and rates at both ends, room
WEIGHT, START, START_RATE, END, END_RATE, LATER, LATER_RATE, KNOWN = range(8)


@compiled
def fill_residual(h: float, known: Matrix, places: Places, rows: Matrix) -> float:
    """Write the residual of the rule into the last column of `rows`; its largest, by weights."""
    most, m = 0.0, rows.shape[0]
    for i in range(m):
        k = places[i]
        rows[i, m] = known[START, k] + 0.5 * h * (known[START_RATE, k] + known[END_RATE, k]) - known[END, k]
        left = abs(rows[i, m]) * known[WEIGHT, k]
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
def press_some(legs: LegArrays, n: int, y: Vector, slope: Vector) -> None:
    """Evaluate leg n as `press_leg` does, or for n < 0 all legs and their pump as `press_all` does."""
    if n >= 0:
        press_leg(legs, n, y, slope)
    else:
        press_all(legs, y, slope)


@compiled
def linearise(legs: LegArrays, n: int, h: float, known: Matrix, places: Places, rows: Matrix) -> None:
    """Write 1 - h/2 df/dz into the columns of `rows` but the last, by differences."""
    m, y, slope = rows.shape[0], known[END], known[END_RATE]
    for i in range(m):
        rows[i, m] = slope[places[i]]
    for j in range(m):
        kept = y[places[j]]
        y[places[j]] = kept + SHIFT / known[WEIGHT, places[j]]
        shift = y[places[j]] - kept
        press_some(legs, n, y, slope)
        y[places[j]] = kept
        for i in range(m):
            rate = (slope[places[i]] - rows[i, m]) / shift
            rows[i, j] = (1.0 if i == j else 0.0) - 0.5 * h * rate
    for i in range(m):
        slope[places[i]] = rows[i, m]


@compiled
def advance_legs(legs: LegArrays, n: int, h: float, known: Matrix, places: Places, rows: Matrix) -> bool:
    """Solve for the states of legs, and of their pump, at the end of a step of h [s]; whether it converged.

    By Newton's method; where a whole step of it makes nothing better, by a part of it. With h = 0 the states
    are those of the start. Records have lengths, rates and inlets of the end, and take what follows.

    Arguments:
        legs, n: which legs, see `press_some`.
        known: shape (KNOWN, states); the rows END and END_RATE are written.
        places: of the m states that are solved for, then of the integrals.
        rows: room, shape (m, m + 1).
    """
    m, y, slope = rows.shape[0], known[END], known[END_RATE]
    for i in range(places.size):
        y[places[i]] = known[START, places[i]]
    press_some(legs, n, y, slope)
    if h == 0.0:
        return True
    left = fill_residual(h, known, places, rows)
    converged = left <= SOLVED
    for _ in range(NEWTON_ROUNDS):
        if converged:
            break
        linearise(legs, n, h, known, places, rows)
        fill_residual(h, known, places, rows)
        eliminate(rows)
        change = 0.0
        for i in range(m):
            size = abs(rows[i, 0]) * known[WEIGHT, places[i]]
            y[places[i]] += rows[i, 0]
            if not size <= change:
                change = size
        converged, share = change <= CONVERGED, 1.0
        press_some(legs, n, y, slope)
        then = fill_residual(h, known, places, rows)
        for _ in range(HALVINGS):
            if converged or then < left:
                break
            share *= 0.5
            for i in range(m):
                y[places[i]] -= share * rows[i, 0]
            press_some(legs, n, y, slope)
            then = fill_residual(h, known, places, rows)
        left = then
    for i in range(m, places.size):
        k = places[i]
        y[k] = known[START, k] + 0.5 * h * (known[START_RATE, k] + slope[k])
    return converged


@entry
def pull_of_leg(
    legs: LegArrays,
    h: float,
    known: Matrix,
    places: Places,
    rows: Matrix,
    n: int,
    together: bool,
    length: float,
    rate: float,
) -> float:
    """Force [N] with which leg n pulls its ends together at the end of a step of h [s]; no number if unsolved.

    Arguments:
        together: whether the states of all legs are solved for, as with a pump, or those of leg n alone.
        length, rate: of the leg at the end of the step [m], [m/s]. Others: see `advance_legs`.
    """
    legs.records[n].length, legs.records[n].rate = length, rate
    if not advance_legs(legs, -1 if together else n, h, known, places, rows):
        return math.nan
    return float(-legs.records[n].force)


@entry
def passes_gap(legs: LegArrays, h: float, known: Matrix) -> bool:
    """Whether a gap may pass zero in a step of h [s] that has been solved; writes the rates of all gaps.

    A gap may pass zero if it is beyond at the end, or if it comes nearer at the start and leaves at the end.
    """
    ahead = AHEAD * h
    for n in range(legs.records.size):
        leg = legs.records[n]
        leg.kept_length, leg.kept_inflow = leg.length, leg.inflow
        leg.length += ahead * leg.rate
        leg.inflow += ahead * leg.inflow_rate
    for i in range(known.shape[1]):
        known[LATER, i] = known[END, i] + ahead * known[END_RATE, i]
    press_all(legs, known[LATER], known[LATER_RATE])
    for n in range(legs.records.size):
        leg = legs.records[n]
        leg.length, leg.inflow = leg.kept_length, leg.kept_inflow
    for k in range(legs.gaps.size):
        legs.gaps[k].rate = legs.gaps[k].now
    press_all(legs, known[END], known[END_RATE])
    passes = False
    for k in range(legs.gaps.size):
        gap = legs.gaps[k]
        gap.rate = (gap.rate - gap.now) / ahead
        turns = gap.side * gap.rate_before < 0.0 and gap.side * gap.rate > 0.0
        passes = passes or (gap.side != 0.0 and (-gap.side * gap.now > gap.near or turns))
    return passes


@entry
def powers_of_legs(legs: LegArrays) -> tuple[float, float, float]:
    """Powers as by `powers_of`, from Python."""
    return powers_of(legs)
