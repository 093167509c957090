"""Whatever follows time alone, as pieces of polynomials between its breaks: drives, valves.

A drive is asked for its extension at Chebyshev's points of every piece; a piece that a polynomial does not meet is
halved. So any drive is followed as its own, and its speed and acceleration are the derivatives.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev, polynomial

from support_exudyn.formulations.compiled.arrays import COURSE, PIECE, Matrix, Records, Vector
from user_forces.lawful import LawError

DEGREE = 8  # of a piece: powers of the place, from -1 to 1, lose two digits by it
HALVINGS = 24
EXACT = 8.0  # roundings of the largest value that a piece may be off by
ROUGH = 1e-9  # share of it that one may be off by that has been halved so often: it has a kink that nobody told
NODES = chebyshev.chebpts1(DEGREE + 1)
TO_POWERS = np.linalg.inv(polynomial.polyvander(NODES, DEGREE))
BETWEEN = np.array([-0.99, -0.37, 0.03, 0.51, 0.995])  # where a piece is looked at

TimeFunction = Callable[[float], float]


class Courses(NamedTuple):
    """All courses: their pieces with coefficients, and for each segment of time the records that `Scene` takes."""

    pieces: Records
    coefficients: Matrix
    segments: list[Records]


def segment_edges(breaks: Iterable[float], duration: float) -> list[float]:
    """Times [s] between which everything is smooth, from 0 to the end of the run."""
    return [0.0, *sorted({t for t in breaks if 0.0 < t < duration}), duration]


def courses(functions: Sequence[TimeFunction], edges: Sequence[float]) -> Courses:
    """The courses of functions of time [s] that are smooth between the edges.

    Raises LawError if one is not finite, or jumps where it has no break.
    """
    pieces: list[tuple[float, float]] = []
    coefficients: list[Vector] = []
    segments = []
    for begin, end in zip(edges, edges[1:], strict=False):
        segment = np.zeros(len(functions), COURSE)
        for record, function in zip(segment, functions, strict=True):
            record["low"] = len(pieces)
            for piece, powers in _fitted(function, begin, end):
                pieces.append(piece)
                coefficients.append(powers)
            record["high"] = len(pieces)
        segments.append(segment)
    found = np.zeros(len(pieces), PIECE)
    for record, (begin, half) in zip(found, pieces, strict=True):
        record["begin"], record["half"] = begin, half
    table = np.array(coefficients).reshape(len(pieces), DEGREE + 1)
    used = int(np.flatnonzero(table.any(axis=0)).max(initial=0)) + 1
    return Courses(found, np.ascontiguousarray(table[:, :used]), segments)


def _fitted(
    function: TimeFunction, begin: float, end: float
) -> Iterable[tuple[tuple[float, float], Vector]]:
    """The pieces of a function between two times [s], in order: begin and half length, and coefficients."""
    waiting = [(begin, end, 0)]
    while waiting:
        low, high, depth = waiting.pop()
        half = 0.5 * (high - low)
        values = np.array([function(low + half * (x + 1.0)) for x in NODES.tolist()])
        if not np.isfinite(values).all():
            raise LawError(f"a drive or a valve is not finite between {low:.9g} and {high:.9g} s")
        powers = TO_POWERS @ values
        largest = float(np.abs(values).max())
        powers[np.abs(powers) < 4.0 * math.ulp(largest)] = 0.0
        there = np.array([function(low + half * (x + 1.0)) for x in BETWEEN.tolist()])
        wrong = float(np.abs(polynomial.polyval(BETWEEN, powers) - there).max())
        if wrong <= EXACT * (math.ulp(largest) + math.ulp(max(abs(low), abs(high))) * _slope(powers) / half):
            yield (low, half), powers
        elif depth < HALVINGS:
            middle = low + half
            waiting += [(middle, high, depth + 1), (low, middle, depth + 1)]
        elif wrong <= ROUGH * largest:
            yield (low, half), powers
        else:
            raise LawError(
                f"a drive or a valve jumps by {wrong:.3g} near {low:.9g} s; allowed: jumps of the speed at its breaks"
            )


def _slope(powers: Vector) -> float:
    """The largest that the derivative by the place may be."""
    return float(np.abs(powers[1:] * np.arange(1, powers.size)).sum())
