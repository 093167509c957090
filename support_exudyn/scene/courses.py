"""Whatever follows time alone, as pieces of polynomials between its breaks: drives, valves.

A drive is asked for its extension at Chebyshev's points of every piece; a piece that a polynomial does not meet
is halved. So any drive is followed as its own, and its speed and acceleration are the derivatives.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.loads.load import TimeFunction
from support_exudyn.scene.arrays import COURSE, PIECE, Matrix, Records, Vector
from user_forces.lawful import LawError

DEGREE = 8  # of a piece: powers of the place, from -1 to 1, lose two digits by it
HALVINGS = 24
EXACT = 16.0  # roundings of the function's largest value that a piece may be off by
ROUGH = 1e-9  # share of it that one may be off by that has been halved so often: it has a kink that nobody told
NODES = chebyshev.chebpts1(DEGREE + 1)
# the polynomial through values there, as Chebyshev's series: by sums of cosines, which lose no digits
TO_SERIES = 2.0 / (DEGREE + 1) * np.cos(np.outer(np.arange(DEGREE + 1), np.arccos(NODES)))
TO_SERIES[0] /= 2.0
# the powers of the place in each of Chebyshev's polynomials, in columns
TO_POWERS = np.zeros((DEGREE + 1, DEGREE + 1))
for _n in range(DEGREE + 1):
    TO_POWERS[: _n + 1, _n] = chebyshev.cheb2poly(np.eye(_n + 1)[_n])
BETWEEN = np.array([-0.99, -0.37, 0.03, 0.51, 0.995])  # where a piece is looked at
SERIES_BETWEEN = chebyshev.chebvander(BETWEEN, DEGREE)


class Courses(NamedTuple):
    """All courses: their pieces with coefficients; the records of `SceneArrays` for each segment of time."""

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
    sizes = [_size(function, edges) for function in functions]
    for begin, end in pairwise(edges):
        segment = np.zeros(len(functions), COURSE)
        for record, function, size in zip(segment, functions, sizes, strict=True):
            record["low"] = len(pieces)
            for piece, powers in _fitted(function, begin, end, size):
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


def _size(function: TimeFunction, edges: Sequence[float]) -> float:
    """The largest value of a function, as far as it shows at a few times of every segment."""
    spans = pairwise(edges)
    return max(
        abs(function(low + 0.5 * (high - low) * (x + 1.0))) for low, high in spans for x in NODES.tolist()
    )


def _fitted(
    function: TimeFunction, begin: float, end: float, size: float
) -> Iterator[tuple[tuple[float, float], Vector]]:
    """The pieces of a function between two times [s], in order: begin and half length, and coefficients.

    size: of its largest value.
    """
    waiting = [(begin, end, 0)]
    while waiting:
        low, high, depth = waiting.pop()
        half = 0.5 * (high - low)
        values = np.array([function(low + half * (x + 1.0)) for x in NODES.tolist()])
        if not np.isfinite(values).all():
            raise LawError(f"a drive or a valve is not finite between {low:.9g} and {high:.9g} s")
        series = TO_SERIES @ values
        rounding = math.ulp(max(size, float(np.abs(values).max())))
        series[np.abs(series) < rounding] = 0.0
        there = np.array([function(low + half * (x + 1.0)) for x in BETWEEN.tolist()])
        wrong = float(np.abs(SERIES_BETWEEN @ series - there).max())
        steepest = float((np.abs(series) * np.arange(series.size) ** 2).sum()) / half
        powers = TO_POWERS @ series
        if wrong <= EXACT * (rounding + math.ulp(high) * steepest):
            yield (low, half), powers
        elif depth < HALVINGS:
            middle = low + half
            waiting += [(middle, high, depth + 1), (low, middle, depth + 1)]
        elif wrong <= ROUGH * size:
            yield (low, half), powers
        else:
            raise LawError(
                f"a drive or a valve jumps by {wrong:.3g} near {low:.9g} s; allowed: jumps of the speed at its "
                "breaks"
            )


def extension_of(drive: Drive) -> TimeFunction:
    """The extension of a drive; raises LawError where that is no number."""

    def asked(t: float) -> float:
        found = drive.extension(t)
        if not math.isfinite(found):
            raise LawError(f"{type(drive).__name__} has an extension of {found:g} at {t:.9g} s")
        return found

    return asked
